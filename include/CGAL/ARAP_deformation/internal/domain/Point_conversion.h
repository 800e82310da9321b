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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_POINT_CONVERSION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_POINT_CONVERSION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>

#include <CGAL/number_utils.h>

#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// constructs a point from its coordinates, without rounding if the point accepts their type
template <typename Point, typename FT>
Point construct_point(const FT& x, const FT& y, const FT& z)
{
  if constexpr(std::is_constructible_v<Point, FT, FT, FT>)
    return Point(x, y, z);
  else // std::array, which accepts only its own type
  {
    using Coordinate = std::decay_t<decltype(std::declval<const Point&>()[0])>;
    return Point{static_cast<Coordinate>(x), static_cast<Coordinate>(y),
                 static_cast<Coordinate>(z)};
  }
}

// A base of the domains: the point functions of ARAPDomain, for any type with operator[] and a
// constructor from three coordinates.
template <typename Point>
struct Point_conversion
{
  static Coordinates coordinates(const Point& point)
  {
    return {CGAL::to_double(point[0]), CGAL::to_double(point[1]), CGAL::to_double(point[2])};
  }

  static Point make_point(const Coordinates& c) { return construct_point<Point>(c[0], c[1], c[2]); }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_POINT_CONVERSION_H
