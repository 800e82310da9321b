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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SIMPLEX_WEIGHTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SIMPLEX_WEIGHTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/concepts/concept_checks.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

template <std::size_t N>
std::array<Coordinates, N> corner_points(const Region& region, const std::array<int, N>& corners)
{
  std::array<Coordinates, N> points;
  for(std::size_t k = 0; k < N; ++k)
    points[k] = region.rest[corners[k]];
  return points;
}

// The doubled area, relative to the squared sides: the same, but for rounding, for each order of
// the corners.
inline double relative_area(const std::array<Coordinates, 3>& triangle)
{
  const Coordinates a = difference(triangle[1], triangle[0]),
                    b = difference(triangle[2], triangle[0]),
                    c = difference(triangle[2], triangle[1]), normal = cross(a, b);
  const double squared_sides = dot(a, a) + dot(b, b) + dot(c, c);
  return squared_sides > 0 ? std::hypot(normal[0], normal[1], normal[2]) / squared_sides : 0;
}

// The weights of a polygon are the average over all its triangulations, in which no corner is
// special. A polygon with m + 2 corners has Cat(m) triangulations, the m-th Catalan number, so that
// the triangle (a, b, c) is in the fraction
//   Cat(b - a - 1) Cat(c - b - 1) Cat(n - c + a - 1) / Cat(n - 2)
// of those of a polygon with n corners. Cat(m) / 4^m is used instead, which does not overflow.
//
// The share of a triangle falls to nothing where its corners come to lie on a line: it has no part
// in the area that the energy is an integral over, and would be infinitely stiff. It falls
// gradually, or a rounding error would decide. If the polygon has no other triangles, all keep
// their shares.
template <typename EdgeWeight>
void compute_polygon_weights(const EdgeWeight& weight, const Region& region, int s, double* weights)
{
  const int n = region.number_of_corners(s);
  const int* corners = region.corners_of(s);
  std::vector<double> scaled_catalan(n - 1, 1);
  for(int m = 0; m + 2 < n; ++m)
    scaled_catalan[m + 1] = scaled_catalan[m] * (2 * m + 1) / (2 * (m + 2));
  const auto pair = [n](int a, int b) { return a * (2 * n - a - 1) / 2 + b - a - 1; };
  std::fill(weights, weights + n * (n - 1) / 2, 0.0);
  const auto for_each_triangle = [&](const auto& f) {
    for(int a = 0; a < n; ++a)
      for(int b = a + 1; b < n; ++b)
        for(int c = b + 1; c < n; ++c)
          f(a, b, c, corner_points<3>(region, {corners[a], corners[b], corners[c]}));
  };
  constexpr double next_to_nothing = 1e-6;
  double largest_area = 0;
  for_each_triangle([&](int, int, int, const auto& triangle) {
    if(largest_area < next_to_nothing)
      largest_area = (std::max)(largest_area, relative_area(triangle));
  });
  const double smallest_share = (std::max)(0.0, 1 - largest_area / next_to_nothing);
  for_each_triangle([&](int a, int b, int c, const auto& triangle) {
    const double area = (std::min)(relative_area(triangle) / next_to_nothing, 1.0);
    const double share = (std::max)(area * area, smallest_share);
    const double fraction = share * scaled_catalan[b - a - 1] * scaled_catalan[c - b - 1] *
                            scaled_catalan[n - c + a - 1] / (4 * scaled_catalan[n - 2]);
    const std::array<double, 3> w = weight.simplex_weights(triangle);
    weights[pair(a, b)] += fraction * w[0];
    weights[pair(a, c)] += fraction * w[1];
    weights[pair(b, c)] += fraction * w[2];
  });
}

// The weights that the model gives for the shape of simplex s: of the edges between all pairs of
// corners, (0, 1), (0, 2), ..., (1, 2), ...
template <typename EdgeWeight>
void compute_simplex_weights(const EdgeWeight& weight, const Region& region, int s, double* weights)
{
  const int* c = region.corners_of(s);
  if(region.dimension == 3)
  {
    // ARAP_deformation does not compile with a domain of tetrahedra and without these weights
    if constexpr(is_valid<Call_tetrahedron_weights, EdgeWeight>)
    {
      const std::array<double, 6> w =
        weight.simplex_weights(corner_points<4>(region, {c[0], c[1], c[2], c[3]}));
      std::copy(w.begin(), w.end(), weights);
    }
  }
  else if(region.number_of_corners(s) == 3)
  {
    const std::array<double, 3> w =
      weight.simplex_weights(corner_points<3>(region, {c[0], c[1], c[2]}));
    std::copy(w.begin(), w.end(), weights);
  }
  else
    compute_polygon_weights(weight, region, s, weights);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SIMPLEX_WEIGHTS_H
