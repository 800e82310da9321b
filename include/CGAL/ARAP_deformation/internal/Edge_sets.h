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
#include <CGAL/ARAP_deformation/internal/simplex_weights.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>

#include <algorithm>
#include <cmath>
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
template <typename Function>
void for_each_simplex_edge(const Simplex_weights& weights, const Region& region, const Function& f)
{
  auto w = weights.begin();
  for(int s = 0; s < region.number_of_simplices(); ++s)
  {
    const int* corners = region.corners_of(s);
    for(int a = 0; a < region.number_of_corners(s); ++a)
      for(int b = a + 1; b < region.number_of_corners(s); ++b, ++w)
        f(s, corners[a], corners[b], *w);
  }
}

// the index of a simplex whose weights are not finite, or -1
inline int find_non_finite_simplex(const Simplex_weights& weights, const Region& region)
{
  int bad = -1;
  for_each_simplex_edge(weights, region, [&bad](int s, int, int, double w) {
    if(bad < 0 && !std::isfinite(w))
      bad = s;
  });
  return bad;
}

// one edge set for each simplex
template <typename EdgeWeight>
Edge_sets simplex_edge_sets(const EdgeWeight& weight, const Simplex_weights& weights,
                            const Region& region)
{
  Edge_sets sets;
  sets.begin.reserve(region.number_of_simplices() + 1);
  sets.edges.reserve(weights.size());
  for(int s = 0; s < region.number_of_simplices(); ++s)
  {
    const int n = region.number_of_corners(s);
    sets.begin.push_back(sets.begin.back() + n * (n - 1) / 2);
  }
  for_each_simplex_edge(weights, region, [&](int, int i, int j, double w) {
    sets.edges.push_back({i, j, weight.edge_weight(Edge_set::simplex, region.indices[i],
                                                   region.indices[j], w),
                          difference(region.rest[i], region.rest[j])});
  });
  return sets;
}

// one edge set for each centre: its edges to its neighbours, in the order of their numbers
template <typename EdgeWeight>
Edge_sets star_edge_sets(const EdgeWeight& weight, const Simplex_weights& weights,
                         const Region& region)
{
  // the neighbours of centre i, each with one weight for each simplex at the edge, will be
  // neighbours[first[i]] to neighbours[first[i + 1] - 1]
  using Neighbour = std::pair<int, double>;
  std::vector<int> first(region.number_of_centres + 1, 0);
  for(int s = 0; s < region.number_of_simplices(); ++s)
    for(int k = region.first_corner[s]; k < region.first_corner[s + 1]; ++k)
      if(const int i = region.corners[k]; i < region.number_of_centres)
        first[i + 1] += region.number_of_corners(s) - 1;
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Neighbour> neighbours(first.back());
  std::vector<int> next(first.begin(), first.end() - 1);
  for_each_simplex_edge(weights, region, [&](int, int i, int j, double w) {
    if(i < region.number_of_centres) neighbours[next[i]++] = {j, w};
    if(j < region.number_of_centres) neighbours[next[j]++] = {i, w};
  });

  Edge_sets sets;
  sets.begin.reserve(first.size());
  sets.edges.reserve(neighbours.size() / 2);
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
      sets.edges.push_back({i, j, weight.edge_weight(Edge_set::star, region.indices[i],
                                                     region.indices[j], sum),
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
