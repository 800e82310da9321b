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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGULATION_CACHES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGULATION_CACHES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// The base classes of vertices and cells determine which of these members exist.

template <typename Cell>
using Call_subdomain_index = decltype(std::declval<const Cell&>().subdomain_index());

template <typename Cell>
using Call_invalidate_circumcenter = decltype(std::declval<Cell&>().invalidate_circumcenter());

template <typename Cell>
using Call_invalidate_weighted_circumcenter_cache =
  decltype(std::declval<Cell&>().invalidate_weighted_circumcenter_cache());

template <typename Cell>
using Call_reset_cache_validity = decltype(std::declval<Cell&>().reset_cache_validity());

// whether the subdomain index of a cell, if it has one, does not denote the outside
template <typename Cell>
bool is_in_a_subdomain([[maybe_unused]] const Cell& cell)
{
  if constexpr(is_valid<Call_subdomain_index, Cell>)
    return cell.subdomain_index() != std::decay_t<Call_subdomain_index<Cell>>();
  else
    return true;
}

template <typename Cell>
constexpr bool has_caches = is_valid<Call_invalidate_circumcenter, Cell> ||
                            is_valid<Call_invalidate_weighted_circumcenter_cache, Cell> ||
                            is_valid<Call_reset_cache_validity, Cell>;

// invalidates the data that a cell has cached from the points of its vertices
template <typename Cell>
void invalidate_caches([[maybe_unused]] Cell& cell)
{
  if constexpr(is_valid<Call_invalidate_circumcenter, Cell>)
    cell.invalidate_circumcenter();
  if constexpr(is_valid<Call_invalidate_weighted_circumcenter_cache, Cell>)
    cell.invalidate_weighted_circumcenter_cache();
  if constexpr(is_valid<Call_reset_cache_validity, Cell>)
    cell.reset_cache_validity();
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGULATION_CACHES_H
