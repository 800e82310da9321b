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


#ifndef CGAL_ARAP_DEFORMATION_DEMO_RESULT_QUALITY_H
#define CGAL_ARAP_DEFORMATION_DEMO_RESULT_QUALITY_H

// What a deformation has done to a shape: functions of the rest points, the deformed points, and
// triangles or tetrahedra as arrays of indices of points.

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/Kernel_traits.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// The area of a triangle.
template <typename Point>
double size_of(const std::array<int, 3>& t, const std::vector<Point>& points)
{
  return std::sqrt(CGAL::squared_area(points[t[0]], points[t[1]], points[t[2]]));
}

// The volume of a tetrahedron, negative if it is inverted.
template <typename Point>
double size_of(const std::array<int, 4>& t, const std::vector<Point>& points)
{
  return CGAL::volume(points[t[0]], points[t[1]], points[t[2]], points[t[3]]);
}

template <std::size_t N, typename Point>
double total_size(const std::vector<std::array<int, N>>& simplices,
                  const std::vector<Point>& points)
{
  double sum = 0;
  for(const auto& simplex : simplices)
    sum += std::abs(size_of(simplex, points));
  return sum;
}

// Whether each side of a triangle is that of another one, in the other direction.
inline bool is_closed(const std::vector<std::array<int, 3>>& triangles)
{
  std::vector<std::pair<int, int>> sides, opposite;
  for(const auto& t : triangles)
    for(int k = 0; k < 3; ++k)
    {
      sides.emplace_back(t[k], t[(k + 1) % 3]);
      opposite.emplace_back(t[(k + 1) % 3], t[k]);
    }
  std::sort(sides.begin(), sides.end());
  std::sort(opposite.begin(), opposite.end());
  return sides == opposite;
}

// The volume that closed triangles enclose, negative if they are oriented inwards.
template <typename Point>
double enclosed_volume(const std::vector<std::array<int, 3>>& triangles,
                       const std::vector<Point>& points)
{
  double sum = 0;
  if(!triangles.empty())
    for(const auto& t : triangles)
      sum += CGAL::volume(points[triangles[0][0]], points[t[0]], points[t[1]], points[t[2]]);
  return sum;
}

// What can be measured at each vertex.
enum class Vertex_measure
{
  edge_error, // the relative root mean square error of the lengths of the edges
  size,       // the relative change of the area, or volume, of the simplices
  angle,      // the largest change of an angle between two edges, in degrees
  spike       // how much further the vertex is from the mean of its neighbours, in edge lengths
};

template <std::size_t N, typename Point>
std::vector<double> measure_at_vertices(Vertex_measure measure,
                                        const std::vector<std::array<int, N>>& simplices,
                                        const std::vector<Point>& rest_points,
                                        const std::vector<Point>& points)
{
  using Vector = typename CGAL::Kernel_traits<Point>::Kernel::Vector_3;
  const auto length = [](const Vector& v) { return std::sqrt(v.squared_length()); };
  const std::size_t n = points.size();
  std::vector<double> result(n, 0.), weights(n, 0.), rest_weights(n, 0.);
  std::vector<Vector> sums(n, Vector(0, 0, 0)), rest_sums = sums;
  for(const auto& simplex : simplices)
    for(std::size_t i = 0; i < N; ++i)
    {
      const int v = simplex[i];
      if(measure == Vertex_measure::size)
      {
        result[v] += size_of(simplex, points) - size_of(simplex, rest_points);
        weights[v] += std::abs(size_of(simplex, rest_points));
      }
      for(std::size_t j = 0; j < N; ++j)
      {
        const Vector e = rest_points[simplex[j]] - rest_points[v],
                     f = points[simplex[j]] - points[v];
        if(measure == Vertex_measure::edge_error)
        {
          result[v] += std::pow(length(f) - length(e), 2);
          weights[v] += e.squared_length();
        }
        sums[v] += f;
        rest_sums[v] += e;
        if(measure == Vertex_measure::spike)
        {
          weights[v] += length(f);
          rest_weights[v] += length(e);
        }
        for(std::size_t k = 0; k < j && i != j && measure == Vertex_measure::angle; ++k)
          if(k != i)
            result[v] = (std::max)(result[v], std::abs(
              CGAL::approximate_angle(f, points[simplex[k]] - points[v]) -
              CGAL::approximate_angle(e, rest_points[simplex[k]] - rest_points[v])));
      }
    }
  for(std::size_t v = 0; v < n; ++v)
    if(measure == Vertex_measure::edge_error)
      result[v] = weights[v] > 0 ? std::sqrt(result[v] / weights[v]) : 0;
    else if(measure == Vertex_measure::size)
      result[v] = weights[v] > 0 ? result[v] / weights[v] : 0;
    else if(measure == Vertex_measure::spike && weights[v] > 0 && rest_weights[v] > 0)
      result[v] = length(sums[v]) / weights[v] - length(rest_sums[v]) / rest_weights[v];
  return result;
}

// What is measured of the whole shape.
struct Quality
{
  double area_change = 0;              // relative, of a surface or of the boundary of a volume
  std::optional<double> volume_change; // relative, unless a surface is open
  double largest_angle_change = 0;     // in degrees
  double largest_spike = 0;
};

// `triangles` are those of a surface, or of the boundary of tetrahedra.
template <std::size_t N, typename Point>
Quality quality(const std::vector<std::array<int, N>>& simplices,
                const std::vector<std::array<int, 3>>& triangles,
                const std::vector<Point>& rest_points, const std::vector<Point>& points)
{
  Quality result;
  if(const double area = total_size(triangles, rest_points); area > 0)
    result.area_change = total_size(triangles, points) / area - 1;
  if(const double volume = enclosed_volume(triangles, rest_points);
     volume != 0 && is_closed(triangles))
    result.volume_change = enclosed_volume(triangles, points) / volume - 1;
  const auto largest = [&](Vertex_measure measure) {
    const auto values = measure_at_vertices(measure, simplices, rest_points, points);
    return values.empty() ? 0. : *std::max_element(values.begin(), values.end());
  };
  result.largest_angle_change = largest(Vertex_measure::angle);
  result.largest_spike = largest(Vertex_measure::spike);
  return result;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_RESULT_QUALITY_H
