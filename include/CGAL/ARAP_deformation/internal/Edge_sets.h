// Copyright (c) 2026  The ARAP_deformation authors.
// All rights reserved.
//
// This file is part of CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later OR LicenseRef-Commercial
//
// Author(s)     : The ARAP_deformation authors

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_EDGE_SETS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_EDGE_SETS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Region.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// an edge (i, j) with its weight and its vector p_i - p_j in the rest shape
struct Weighted_edge
{
  int i, j;
  double weight;
  Coordinates rest;
};

// the edges of all edge sets: those of set u are edges[begin[u]] to edges[begin[u + 1] - 1]
struct Edge_sets
{
  std::vector<int> begin = {0};
  std::vector<Weighted_edge> edges;

  int size() const { return static_cast<int>(begin.size()) - 1; }
};

// calls f(s, i, j, w) for each edge (i, j) of each simplex s of the region with its weight w there
template <typename EdgeWeight, std::size_t N, typename Function>
void for_each_simplex_edge(const EdgeWeight& weight, const Region<N>& region, const Function& f)
{
  for(std::size_t s = 0; s < region.simplices.size(); ++s)
  {
    const auto& simplex = region.simplices[s];
    std::array<Coordinates, N> points;
    for(std::size_t a = 0; a < N; ++a)
      points[a] = region.rest[simplex[a]];
    const auto weights = weight.simplex_weights(points);
    auto w = weights.begin();
    for(std::size_t a = 0; a < N; ++a)
      for(std::size_t b = a + 1; b < N; ++b, ++w)
        f(static_cast<int>(s), simplex[a], simplex[b], *w);
  }
}

// the index of a simplex whose weights are not finite, or -1
template <typename EdgeWeight, std::size_t N>
int find_bad_simplex(const EdgeWeight& weight, const Region<N>& region)
{
  int bad = -1;
  for_each_simplex_edge(weight, region, [&bad](int s, int, int, double w) {
    if(bad < 0 && !std::isfinite(w))
      bad = s;
  });
  return bad;
}

// one edge set for each simplex
template <typename EdgeWeight, std::size_t N>
Edge_sets simplex_edge_sets(const EdgeWeight& weight, const Region<N>& region)
{
  constexpr int edges_per_simplex = N * (N - 1) / 2;
  Edge_sets sets;
  sets.edges.reserve(region.simplices.size() * edges_per_simplex);
  for_each_simplex_edge(weight, region, [&](int, int i, int j, double w) {
    sets.edges.push_back({i, j, weight.edge_weight(Edge_set::simplex, w),
                          difference(region.rest[i], region.rest[j])});
  });
  sets.begin.resize(region.simplices.size() + 1);
  for(std::size_t s = 0; s < region.simplices.size(); ++s)
    sets.begin[s + 1] = sets.begin[s] + edges_per_simplex;
  return sets;
}

// one edge set for each centre: its edges to its neighbours, in the order of their numbers
template <typename EdgeWeight, std::size_t N>
Edge_sets star_edge_sets(const EdgeWeight& weight, const Region<N>& region)
{
  // the neighbours of centre i, each with one weight for each simplex at the edge, will be
  // neighbours[first[i]] to neighbours[first[i + 1] - 1]
  using Neighbour = std::pair<int, double>;
  std::vector<int> first(region.number_of_centres + 1, 0);
  for(const auto& simplex : region.simplices)
    for(int i : simplex)
      if(i < region.number_of_centres)
        first[i + 1] += static_cast<int>(N) - 1;
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Neighbour> neighbours(first.back());
  std::vector<int> next(first.begin(), first.end() - 1);
  for_each_simplex_edge(weight, region, [&](int, int i, int j, double w) {
    if(i < region.number_of_centres) neighbours[next[i]++] = {j, w};
    if(j < region.number_of_centres) neighbours[next[j]++] = {i, w};
  });

  Edge_sets sets;
  sets.begin.reserve(first.size());
  sets.edges.reserve(neighbours.size() / (N - 1));
  for(int i = 0; i < region.number_of_centres; ++i)
  {
    const auto end = neighbours.begin() + first[i + 1];
    std::sort(neighbours.begin() + first[i], end);
    for(auto it = neighbours.begin() + first[i]; it != end;)
    {
      const int j = it->first;
      double sum = 0;
      for(; it != end && it->first == j; ++it)
        sum += it->second;
      sets.edges.push_back({i, j, weight.edge_weight(Edge_set::star, sum),
                            difference(region.rest[i], region.rest[j])});
    }
    sets.begin.push_back(static_cast<int>(sets.edges.size()));
  }
  return sets;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_EDGE_SETS_H
