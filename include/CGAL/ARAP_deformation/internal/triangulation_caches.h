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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_TRIANGULATION_CACHES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_TRIANGULATION_CACHES_H

#include <CGAL/license/ARAP_deformation.h>

#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// The vertices and cells of triangulations have what their base classes give them: what is there is
// found out by overloads, of which the first whose expression is valid is taken.
template <int n> struct Preference : Preference<n - 1> {};
template <> struct Preference<0> {};

template <typename Bare_point, typename Point>
Bare_point bare_point(const Point& point)
{
  if constexpr(std::is_same_v<Bare_point, Point>)
    return point;
  else
    return point.point();
}

template <typename Point, typename Bare_point>
Point with_weight_of(const Point& point, const Bare_point& place)
{
  if constexpr(std::is_same_v<Bare_point, Point>)
    return place;
  else
    return Point(place, point.weight());
}

template <typename Cell>
auto is_in_a_subdomain(const Cell& cell, Preference<1>)
  -> decltype(cell.subdomain_index() != std::decay_t<decltype(cell.subdomain_index())>())
{
  return cell.subdomain_index() != std::decay_t<decltype(cell.subdomain_index())>();
}

template <typename Cell>
bool is_in_a_subdomain(const Cell&, Preference<0>) { return true; }

// whether the subdomain index of a cell, if it has one, does not stand for the outside
template <typename Cell>
bool is_in_a_subdomain(const Cell& cell)
{
  return is_in_a_subdomain(cell, Preference<1>());
}

template <typename Cell>
auto invalidate_circumcenter(Cell& cell, Preference<2>)
  -> decltype(cell.invalidate_weighted_circumcenter_cache())
{
  cell.invalidate_weighted_circumcenter_cache();
}

template <typename Cell>
auto invalidate_circumcenter(Cell& cell, Preference<1>) -> decltype(cell.invalidate_circumcenter())
{
  cell.invalidate_circumcenter();
}

template <typename Cell>
void invalidate_circumcenter(Cell&, Preference<0>) {}

template <typename Cell>
auto invalidate_quality(Cell& cell, Preference<1>) -> decltype(cell.reset_cache_validity())
{
  cell.reset_cache_validity();
}

template <typename Cell>
void invalidate_quality(Cell&, Preference<0>) {}

// marks what a cell has computed from the points of its vertices as out of date
template <typename Cell>
void invalidate_caches(Cell& cell)
{
  invalidate_circumcenter(cell, Preference<2>());
  invalidate_quality(cell, Preference<1>());
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_TRIANGULATION_CACHES_H
