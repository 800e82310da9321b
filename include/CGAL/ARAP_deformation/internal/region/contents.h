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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_CONTENTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_CONTENTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace ARAP {
namespace internal {

// half the sum of the cross products around a polygon of n corners
template <typename Corner>
Coordinates vector_area(std::size_t n, const Corner& corner)
{
  Coordinates area = {0, 0, 0};
  for(std::size_t k = 1; k + 1 < n; ++k)
    add(area, 0.5, cross(difference(corner(k), corner(0)), difference(corner(k + 1), corner(0))));
  return area;
}

// the volume of a tetrahedron, negative if it is inverted
template <typename Corner>
double signed_volume(const Corner& corner)
{
  const auto edge = [&](std::size_t k) { return difference(corner(k), corner(0)); };
  return dot(edge(3), cross(edge(1), edge(2))) / 6;
}

// the same, but 0 where it is no more than rounding errors, also those of coordinates
template <typename Corner>
double rounded_volume(const Corner& corner)
{
  std::array<double, 3> length;
  double largest = largest_absolute_value(corner(0));
  for(std::size_t k = 0; k < 3; ++k)
  {
    const Coordinates edge = difference(corner(k + 1), corner(0));
    length[k] = std::sqrt(dot(edge, edge));
    largest = (std::max)(largest, largest_absolute_value(corner(k + 1)));
  }
  const auto [a, b, c] = length;
  const double error = 2 * std::numeric_limits<double>::epsilon() * largest; // of an edge
  const double volume = signed_volume(corner);
  return std::abs(volume) <= (1e-12 * a * b * c + error * (a * b + b * c + c * a)) / 6 ? 0 : volume;
}

// whether one of two tetrahedra is the other one inside out
template <typename Corner, typename Other>
bool is_inverted(const Corner& corner, const Other& other)
{
  const double a = signed_volume(corner), b = signed_volume(other); // their product may underflow
  const bool is_suspect = a < 0 ? b > 0 : a > 0 && b < 0;
  return is_suspect && rounded_volume(corner) != 0 && rounded_volume(other) != 0;
}

// the area or volume of simplex s of the rest shape
inline double content_of(const Region& region, int s)
{
  const Index_range corners = region.corners_of(s);
  const auto corner = [&](std::size_t k) { return region.rest[corners[k]]; };
  if(region.dimension == 3)
    return std::abs(signed_volume(corner));
  const Coordinates area = vector_area(static_cast<std::size_t>(corners.size()), corner);
  return std::hypot(area[0], area[1], area[2]); // squares may underflow
}

// the share of each center in the area or volume of its simplices
inline Array<double> contents_at_centers(const Region& region)
{
  Array<double> contents(region.number_of_centers, 0);
  for(int s = 0; s < region.number_of_simplices(); ++s)
  {
    const double share = content_of(region, s) / region.corners_of(s).size();
    for(int v : region.corners_of(s))
      if(v < region.number_of_centers)
        contents[v] += share;
  }
  return contents;
}

// The same as the inertia of centers. Thin simplices give their corners next to none, so that any
// force would throw them away: a center has at least 1e-6 of the square, or the cube, over the
// longest edge of its simplices.
inline Array<double> inertia_at_centers(const Region& region)
{
  Array<double> inertia = contents_at_centers(region);
  for(int s = 0; s < region.number_of_simplices(); ++s)
  {
    const Index_range corners = region.corners_of(s);
    const auto n = static_cast<std::size_t>(corners.size());
    double longest = 0; // squared
    const auto look_at = [&](std::size_t k, std::size_t l) {
      const Coordinates edge = difference(region.rest[corners[k]], region.rest[corners[l]]);
      longest = (std::max)(longest, dot(edge, edge));
    };
    for(std::size_t k = 0; k < n; ++k)
      look_at(k, (k + 1) % n);
    if(region.dimension == 3) // the other two edges
    {
      look_at(0, 2);
      look_at(1, 3);
    }
    const double least = 1e-6 * longest * (region.dimension == 3 ? std::sqrt(longest) : 1);
    for(int v : corners)
      if(v < region.number_of_centers)
        inertia[v] = (std::max)(inertia[v], least);
  }
  return inertia;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_CONTENTS_H
