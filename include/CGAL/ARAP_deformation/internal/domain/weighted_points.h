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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_WEIGHTED_POINTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_WEIGHTED_POINTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Point>
using Construct_weighted = decltype(Point(std::declval<const Point&>().point(),
                                          std::declval<const Point&>().weight()));

// the point without the weight that it may have
template <typename Point>
auto bare_point(const Point& point)
{
  if constexpr(is_valid<Construct_weighted, Point>)
    return point.point();
  else
    return point;
}

template <typename Point>
using Bare_point_of = decltype(bare_point(std::declval<const Point&>()));

// another place, with the weight of the point if it has one
template <typename Point>
Point with_weight_of(const Point& point, const Bare_point_of<Point>& place)
{
  if constexpr(is_valid<Construct_weighted, Point>)
    return Point(place, point.weight());
  else
    return place;
}

// a point, with the weight of the one in its place before if points have weights
template <typename Point, typename Old>
decltype(auto) with_weight_of_old(const Point& point, [[maybe_unused]] const Old& old)
{
  if constexpr(is_valid<Construct_weighted, Point>)
    return with_weight_of(Point(old()), bare_point(point));
  else
    return (point); // no copy
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_WEIGHTED_POINTS_H
