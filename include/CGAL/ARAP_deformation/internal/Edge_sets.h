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
#include <CGAL/ARAP_deformation/internal/Groups.h>
#include <CGAL/ARAP_deformation/internal/Region.h>
#include <CGAL/ARAP_deformation/internal/parallel.h>
#include <CGAL/ARAP_deformation/internal/simplex_weights.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The edge sets that are stars: the neighbours of each centre, and the weights of the edges to
// them.
struct Stars
{
  Groups neighbours;
  std::vector<double> weights; // for each item of `neighbours`

  int size() const { return neighbours.size(); }

  // the place of the neighbour j of i
  int find(int i, int j) const
  {
    const auto begin = neighbours.items.begin() + neighbours.begin[i];
    const auto end = neighbours.items.begin() + neighbours.begin[i + 1];
    const auto found = std::find(begin, end, j);
    CGAL_assertion(found != end);
    return static_cast<int>(found - neighbours.items.begin());
  }

  // calls f(i, j, w) for each edge (i, j) of the star of i with its weight w
  template <typename Function>
  void for_each_edge(const Function& f) const
  {
    for(int i = 0; i < size(); ++i)
      for(int e = neighbours.begin[i]; e < neighbours.begin[i + 1]; ++e)
        f(i, neighbours.items[e], weights[e]);
  }
};

// The edge sets that are simplices: the corners of each, and the weights of the edges between all
// pairs of them, in the order (0, 1), (0, 2), ..., (1, 2), ...
struct Simplices
{
  Groups corners;
  std::vector<int> first_weight;
  std::vector<double> weights;

  int size() const { return corners.size(); }
  int number_of_corners(int s) const { return corners.begin[s + 1] - corners.begin[s]; }

  // calls f(s, i, j, w) for each edge (i, j) of each simplex s with its weight w, which f may
  // change
  template <typename Function>
  void for_each_edge(const Function& f) const { visit_edges(*this, f); }
  template <typename Function>
  void for_each_edge(const Function& f) { visit_edges(*this, f); }

private:
  template <typename Self, typename Function>
  static void visit_edges(Self& self, const Function& f)
  {
    for(int s = 0; s < self.size(); ++s)
    {
      auto* w = self.weights.data() + self.first_weight[s];
      for(int a = self.corners.begin[s]; a < self.corners.begin[s + 1]; ++a)
        for(int b = a + 1; b < self.corners.begin[s + 1]; ++b, ++w)
          f(s, self.corners.items[a], self.corners.items[b], *w);
    }
  }
};

// the simplices of a region, with the weights that the model gives for their shapes
template <typename EdgeWeight>
Simplices weighted_simplices(const EdgeWeight& weight, const Region& region)
{
  Simplices simplices;
  simplices.corners = {region.first_corner, region.corners};
  simplices.first_weight.reserve(region.number_of_simplices());
  int number_of_weights = 0;
  for(int s = 0; s < region.number_of_simplices(); ++s)
  {
    simplices.first_weight.push_back(number_of_weights);
    number_of_weights += region.number_of_corners(s) * (region.number_of_corners(s) - 1) / 2;
  }
  simplices.weights.resize(number_of_weights);
  for_each_block(simplices.size(), [&](std::size_t begin, std::size_t end) {
    for(std::size_t s = begin; s < end; ++s)
      compute_simplex_weights(weight, region, static_cast<int>(s),
                              simplices.weights.data() + simplices.first_weight[s]);
  });
  return simplices;
}

// the index of a simplex whose weights are not finite, or -1
inline int find_non_finite_simplex(const Simplices& simplices)
{
  for(std::size_t k = 0; k < simplices.weights.size(); ++k)
    if(!std::isfinite(simplices.weights[k]))
      return static_cast<int>(std::upper_bound(simplices.first_weight.begin(),
                                               simplices.first_weight.end(), static_cast<int>(k)) -
                              simplices.first_weight.begin()) - 1;
  return -1;
}

// the same simplices with the weights that the model gives edges in simplices
template <typename EdgeWeight>
Simplices simplex_edge_sets(const EdgeWeight& weight, Simplices simplices, const Region& region)
{
  simplices.for_each_edge([&](int, int i, int j, double& w) {
    w = weight.edge_weight(Edge_set::simplex, region.indices[i], region.indices[j], w);
  });
  return simplices;
}

// one edge set for each centre: its edges to its neighbours, in the order of their numbers
template <typename EdgeWeight>
Stars star_edge_sets(const EdgeWeight& weight, const Simplices& simplices, const Region& region)
{
  // first the neighbours of each centre with one weight for each simplex at the edge
  const int n = region.number_of_centres;
  using Neighbour = std::pair<int, double>;
  std::vector<int> first(n + 1, 0);
  for(int s = 0; s < simplices.size(); ++s)
    for(int k = simplices.corners.begin[s]; k < simplices.corners.begin[s + 1]; ++k)
      if(const int i = simplices.corners.items[k]; i < n)
        first[i + 1] += simplices.number_of_corners(s) - 1;
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Neighbour> neighbours(first.back());
  std::vector<int> next(first.begin(), first.end() - 1);
  simplices.for_each_edge([&](int, int i, int j, double w) {
    if(i < n) neighbours[next[i]++] = {j, w};
    if(j < n) neighbours[next[j]++] = {i, w};
  });

  // then one for all of them: of centre i there are sizes[i]
  std::vector<int>& sizes = next;
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
    {
      Neighbour* const star = neighbours.data() + first[i];
      sizes[i] = sort_and_add_up(star, neighbours.data() + first[i + 1]);
      for(int k = 0; k < sizes[i]; ++k)
        star[k].second = weight.edge_weight(Edge_set::star, region.indices[i],
                                            region.indices[star[k].first], star[k].second);
    }
  });

  Stars stars;
  stars.neighbours.begin.resize(n + 1);
  std::partial_sum(sizes.begin(), sizes.end(), stars.neighbours.begin.begin() + 1);
  stars.neighbours.items.resize(stars.neighbours.begin.back());
  stars.weights.resize(stars.neighbours.begin.back());
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    for(std::size_t i = begin; i < end; ++i)
      for(int k = 0; k < sizes[i]; ++k)
      {
        const Neighbour& neighbour = neighbours[first[i] + k];
        stars.neighbours.items[stars.neighbours.begin[i] + k] = neighbour.first;
        stars.weights[stars.neighbours.begin[i] + k] = neighbour.second;
      }
  });
  return stars;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_EDGE_SETS_H
