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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_WEIGHTED_EDGE_SETS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_WEIGHTED_EDGE_SETS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_weight_model.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// All that computes weights: from a region and a model of weights to the edge sets of an energy.

template <std::size_t N>
std::array<Coordinates, N> corner_points(const Region& region, const std::array<int, N>& corners)
{
  std::array<Coordinates, N> points;
  for(std::size_t k = 0; k < N; ++k)
    points[k] = region.rest[corners[k]];
  return points;
}

inline std::array<double, 3> triangle_weights(const Edge_weight_model& model, const Region& region,
                                              int a, int b, int c)
{
  return model.triangle(corner_points<3>(region, {a, b, c}),
                        {region.indices[a], region.indices[b], region.indices[c]});
}

// The doubled area, relative to the squared sides: the same, but for rounding, for each order of
// the corners.
inline double relative_area(const std::array<Coordinates, 3>& triangle)
{
  const Coordinates a = difference(triangle[1], triangle[0]),
                    b = difference(triangle[2], triangle[0]),
                    c = difference(triangle[2], triangle[1]);
  const double squared_sides = dot(a, a) + dot(b, b) + dot(c, c);
  if(!(squared_sides > 0))
    return 0;
  Coordinates normal = cross(a, b);
  for(double& x : normal)
    x /= squared_sides; // before it is squared, which could underflow
  return std::sqrt(dot(normal, normal));
}

// The weights of a polygon are the average over all its triangulations, in which no corner is
// special. A polygon with m + 2 corners has Cat(m) triangulations, the m-th Catalan number, so that
// the triangle (a, b, c) is in the fraction
//   Cat(b - a - 1) Cat(c - b - 1) Cat(n - c + a - 1) / Cat(n - 2)
// of those of a polygon with n corners. Cat(m) / 4^m is used instead, which does not overflow.
//
// The share of a triangle falls to zero as its corners come to lie on a line: it has no part in the
// area that the energy is an integral over, and would be infinitely stiff. It falls gradually, or a
// rounding error would decide. If the polygon has no other triangles, all keep their shares.
//
// A polygon with more corners than `most_corners_of_all` has too many triangles. It has the average
// of the n triangulations that are fans, in which no corner is special either.
constexpr int most_corners_of_all = 64;

inline void compute_polygon_weights(const Edge_weight_model& model, const Region& region, int s,
                                    double* weights)
{
  const Index_range corners = region.corners_of(s);
  const int n = corners.size();
  Array<double> scaled_catalan(n - 1, 1);
  for(int m = 0; m + 2 < n; ++m)
    scaled_catalan[m + 1] = scaled_catalan[m] * (2 * m + 1) / (2 * (m + 2));
  const auto weight = [n, weights](int a, int b) -> double& {
    std::tie(a, b) = std::minmax({a, b});
    return weights[a * (2 * n - a - 1) / 2 + b - a - 1];
  };
  std::fill(weights, weights + n * (n - 1) / 2, 0.0);
  const auto for_each_triangle = [&](const auto& f) { // with the fraction that it is in
    for(int a = 0; a < n; ++a)
      if(n > most_corners_of_all)
        for(int k = 1; k + 1 < n; ++k)
          f(a, (a + k) % n, (a + k + 1) % n, 1.0 / n);
      else
        for(int b = a + 1; b < n; ++b)
          for(int c = b + 1; c < n; ++c)
            f(a, b, c, scaled_catalan[b - a - 1] * scaled_catalan[c - b - 1] *
                         scaled_catalan[n - c + a - 1] / (4 * scaled_catalan[n - 2]));
  };
  const auto area = [&](int a, int b, int c) {
    return relative_area(
      corner_points<3>(region, {corners.first[a], corners.first[b], corners.first[c]}));
  };
  constexpr double negligible = 1e-3; // above the rounding errors of float points
  double largest_area = 0;
  for_each_triangle([&](int a, int b, int c, double) {
    if(largest_area < negligible) // more is not asked for
      largest_area = (std::max)(largest_area, area(a, b, c));
  });
  const double smallest_share = (std::max)(0.0, 1 - largest_area / negligible);
  for_each_triangle([&](int a, int b, int c, double fraction) {
    const double relative_area = (std::min)(area(a, b, c) / negligible, 1.0);
    fraction *= (std::max)(relative_area * relative_area, smallest_share);
    if(fraction == 0) // its weights may be infinite
      return;
    const std::array<double, 3> w =
      triangle_weights(model, region, corners.first[a], corners.first[b], corners.first[c]);
    weight(a, b) += fraction * w[0];
    weight(a, c) += fraction * w[1];
    weight(b, c) += fraction * w[2];
  });
}

// The weights that the model gives for the shape of simplex s: of the edges between all pairs of
// corners, (0, 1), (0, 2), ..., (1, 2), ...
inline void compute_simplex_weights(const Edge_weight_model& model, const Region& region, int s,
                                    double* weights)
{
  const Index_range c = region.corners_of(s);
  const auto copy = [weights](const auto& w) { std::copy(w.begin(), w.end(), weights); };
  if(region.dimension == 3)
    copy(model.tetrahedron(corner_points<4>(region, {c[0], c[1], c[2], c[3]})));
  else if(c.size() == 3)
    copy(triangle_weights(model, region, c[0], c[1], c[2]));
  else
    compute_polygon_weights(model, region, s, weights);
}

// the simplices of a region, with the weights that the model gives for their shapes
inline Simplices weighted_simplices(const Edge_weight_model& model, const Region& region)
{
  Simplices simplices;
  simplices.corners = {region.first_corner, region.corners};
  simplices.first_weight.reserve(region.first_corner.size());
  std::size_t number_of_weights = 0;
  for(int s = 0; s < region.number_of_simplices(); ++s)
  {
    simplices.first_weight.push_back(to_index(number_of_weights));
    const auto k = static_cast<std::size_t>(region.corners_of(s).size());
    number_of_weights += k * (k - 1) / 2;
  }
  simplices.weights = Array<double>(to_index(number_of_weights));
  for_each_block(simplices.first_weight.size(), [&](std::size_t begin, std::size_t end) {
    for(std::size_t s = begin; s < end; ++s)
      compute_simplex_weights(model, region, static_cast<int>(s),
                              simplices.weights.data() + simplices.first_weight[s]);
  });
  return simplices;
}

// the index of a simplex whose weights are not finite, or -1
inline int find_non_finite_simplex(const Simplices& simplices)
{
  for(std::size_t k = 0; k < simplices.weights.size(); ++k)
    if(!is_finite(simplices.weights[k]))
      return static_cast<int>(std::upper_bound(simplices.first_weight.begin(),
                                               simplices.first_weight.end(), static_cast<int>(k)) -
                              simplices.first_weight.begin()) - 1;
  return -1;
}

// the same simplices with the weights that the model gives edges in simplices
inline Simplices simplex_edge_sets(const Edge_weight_model& model, Simplices simplices,
                                   const Region& region)
{
  bool are_of_shapes = model.are_of_shapes();
  double* w = simplices.weights.data(); // in the order of the visit
  simplices.for_each_edge([&](int, int i, int j, double sum) {
    *w = model.edge(Edge_set::simplex, region.indices[i], region.indices[j], sum);
    are_of_shapes &= *w++ == sum;
  });
  simplices.is_sum_of_squares = are_of_shapes || simplices.are_sums_of_squares();
  return simplices;
}

// one edge set for each center: its edges to its neighbors, in the order of their numbers
inline Stars star_edge_sets(const Edge_weight_model& model, const Simplices& simplices,
                            const Region& region)
{
  const auto n = static_cast<std::size_t>(region.number_of_centers);
  const Index_lists places = // the corners at each center
    places_of(simplices.corners.items, region.number_of_centers);
  const Array<int> simplex_of_place = list_of_each(simplices.corners.begin);

  // the neighbors of a center, with the sum of the weights of all simplices at the edge
  using Neighbor = std::pair<int, double>;
  const auto find_neighbors = [&](std::size_t i, std::vector<Neighbor>& neighbors) {
    neighbors.clear();
    for(int k = places.begin[i]; k < places.begin[i + 1]; ++k)
    {
      const int place = places.items[k], s = simplex_of_place[place];
      for(int other = simplices.corners.begin[s]; other < simplices.corners.begin[s + 1]; ++other)
        if(other != place)
          neighbors.emplace_back(simplices.corners.items[other],
                                 simplices.weight(s, place, other));
    }
    neighbors.resize(
      static_cast<std::size_t>(sort_and_add_up(neighbors.begin(), neighbors.end())));
  };

  // Found twice: to keep them in between saves a little time, but takes more memory than the stars,
  // and the C library does not give back what other threads have allocated.
  Stars stars;
  stars.neighbors.begin.resize(n + 1);
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> neighbors;
    for(std::size_t i = begin; i < end; ++i)
    {
      find_neighbors(i, neighbors);
      stars.neighbors.begin[i + 1] = static_cast<int>(neighbors.size());
    }
  });
  add_up(stars.neighbors.begin);
  stars.neighbors.items = Array<int>(stars.neighbors.begin.back());
  stars.weights = Array<double>(stars.neighbors.begin.back());
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> neighbors;
    for(std::size_t i = begin; i < end; ++i)
    {
      find_neighbors(i, neighbors);
      int e = stars.neighbors.begin[i];
      for(const auto& [j, w] : neighbors)
      {
        stars.neighbors.items[e] = j;
        stars.weights[e++] = model.edge(Edge_set::star, region.indices[i], region.indices[j], w);
      }
    }
  });
  return stars;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_WEIGHTED_EDGE_SETS_H
