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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_SETS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_SETS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/internal/energy/simplex_weights.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>

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
  Index_lists neighbours;
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
  Index_lists corners;
  std::vector<int> first_weight;
  std::vector<double> weights;

  int size() const { return corners.size(); }
  int number_of_corners(int s) const { return corners.begin[s + 1] - corners.begin[s]; }

  // the weight of the edge between two corners of s, given by their places in corners.items
  double weight(int s, int place, int other) const
  {
    const int n = number_of_corners(s);
    const auto [a, b] = std::minmax({place - corners.begin[s], other - corners.begin[s]});
    return weights[first_weight[s] + a * (2 * n - a - 1) / 2 + b - a - 1];
  }

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
  const int n = region.number_of_centres;
  const Index_lists places = places_of(simplices.corners, n); // the corners at each centre
  const std::vector<int> simplex_of_place = list_of_each(simplices.corners);

  // the neighbours of the centres, with the sum of the weights of all simplices at the edge, block
  // after block
  using Neighbour = std::pair<int, double>;
  std::vector<std::vector<Neighbour>> blocks(n / default_block_size + 1);
  Stars stars;
  stars.neighbours.begin.resize(n + 1);
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour>& block = blocks[begin / default_block_size];
    for(std::size_t i = begin; i < end; ++i)
    {
      const auto size = static_cast<std::ptrdiff_t>(block.size());
      for(int k = places.begin[i]; k < places.begin[i + 1]; ++k)
      {
        const int place = places.items[k], s = simplex_of_place[place];
        for(int other = simplices.corners.begin[s]; other < simplices.corners.begin[s + 1]; ++other)
          if(other != place)
            block.emplace_back(simplices.corners.items[other], simplices.weight(s, place, other));
      }
      stars.neighbours.begin[i + 1] = sort_and_add_up(block.begin() + size, block.end());
      block.resize(static_cast<std::size_t>(size + stars.neighbours.begin[i + 1]));
    }
  });
  std::partial_sum(stars.neighbours.begin.begin(), stars.neighbours.begin.end(),
                   stars.neighbours.begin.begin());
  stars.neighbours.items.resize(stars.neighbours.begin.back());
  stars.weights.resize(stars.neighbours.begin.back());
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    auto neighbour = blocks[begin / default_block_size].begin();
    for(std::size_t i = begin; i < end; ++i)
      for(int e = stars.neighbours.begin[i]; e < stars.neighbours.begin[i + 1]; ++e, ++neighbour)
      {
        const auto& [j, w] = *neighbour;
        stars.neighbours.items[e] = j;
        stars.weights[e] =
          weight.edge_weight(Edge_set::star, region.indices[i], region.indices[j], w);
      }
    std::vector<Neighbour>().swap(blocks[begin / default_block_size]);
  });
  return stars;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_SETS_H
