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
#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <CGAL/number_type_basic.h>

#include <tuple>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Point>
using Ambient_dimension_of = std::integral_constant<int, Point::Ambient_dimension::value>;
template <typename Point>
using Tuple_size_of = std::integral_constant<int, std::tuple_size<Point>::value>;
template <typename Point>
using Eigen_size_of = std::integral_constant<int, Point::SizeAtCompileTime>;

// the number of coordinates of a point of CGAL, of a std::array, of a vector of Eigen or of any
// other type, which is constructed from them
template <typename Point>
constexpr int number_of_coordinates()
{
  if constexpr(is_valid<Ambient_dimension_of, Point>)
    return Ambient_dimension_of<Point>::value;
  else if constexpr(is_valid<Tuple_size_of, Point>)
    return Tuple_size_of<Point>::value;
  else if constexpr(is_valid<Eigen_size_of, Point>)
    return Eigen_size_of<Point>::value;
  else
    return !std::is_constructible_v<Point, double, double, double> &&
           std::is_constructible_v<Point, double, double> ? 2 : 3;
}

template <typename Point>
using Field_of = typename Point::R::FT;

// constructs a point from its coordinates, without rounding if the point accepts their type
template <typename Point, typename... FT>
Point construct_from_coordinates(const FT&... coordinates)
{
  if constexpr(is_valid<Field_of, Point>) // integers would do for a homogeneous one
    return Point(typename Point::R::FT(coordinates)...);
  else if constexpr(std::is_constructible_v<Point, const FT&...>)
    return Point(coordinates...);
  else // std::array, which accepts only its own type
  {
    using Coordinate = std::decay_t<decltype(std::declval<const Point&>()[0])>;
    return Point{static_cast<Coordinate>(coordinates)...};
  }
}

// constructs a point; one in the plane leaves out z
template <bool is_planar, typename Point, typename FT>
Point construct_point(const FT& x, const FT& y, const FT& z)
{
  if constexpr(is_planar)
    return construct_from_coordinates<Point>(x, y);
  else
    return construct_from_coordinates<Point>(x, y, z);
}

// p + t, for a vector with as many coordinates
template <bool is_planar, typename Point, typename Vector>
Point translated(const Point& p, const Vector& t)
{
  if constexpr(is_planar)
    return construct_from_coordinates<Point>(p[0] + t[0], p[1] + t[1]);
  else
    return construct_from_coordinates<Point>(p[0] + t[0], p[1] + t[1], p[2] + t[2]);
}

// the coordinates of a point or a vector; in the plane it need not have z, which is 0
template <bool is_planar, typename Vector>
Coordinates coordinates_of(const Vector& v)
{
  double z = 0;
  if constexpr(!is_planar)
    z = CGAL::to_double(v[2]);
  return {CGAL::to_double(v[0]), CGAL::to_double(v[1]), z};
}

// A base of the domains: the point functions of ARAPDomain, for any type with operator[] and a
// constructor from three coordinates, or from two: such points are in the plane z = 0.
template <typename Point>
struct Point_conversion
{
  static constexpr bool is_planar = number_of_coordinates<Point>() == 2;
  static_assert(is_planar || number_of_coordinates<Point>() == 3,
                "the points of a shape must have three coordinates, or two in the plane");

  static Coordinates coordinates(const Point& point) { return coordinates_of<is_planar>(point); }

  static Point make_point(const Coordinates& c)
  {
    return construct_point<is_planar, Point>(c[0], c[1], c[2]);
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_POINT_CONVERSION_H
