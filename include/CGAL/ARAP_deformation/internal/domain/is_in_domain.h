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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_IS_IN_DOMAIN_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_IS_IN_DOMAIN_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Domain>
using Call_is_vertex = decltype(std::declval<const Domain&>().is_vertex(
  std::declval<typename Domain::vertex_descriptor>()));

// whether v is a vertex of the domain, as far as it can tell
template <typename Domain>
bool is_vertex_of([[maybe_unused]] const Domain& domain,
                  [[maybe_unused]] const typename Domain::vertex_descriptor& v)
{
  if constexpr(is_valid<Call_is_vertex, Domain>)
    return domain.is_vertex(v);
  else
    return true;
}

template <typename Domain>
using Call_is_simplex = decltype(std::declval<const Domain&>().is_simplex(
  std::declval<typename Domain::simplex_descriptor>()));

// whether s is a simplex of the domain, as far as it can tell
template <typename Domain>
bool is_simplex_of([[maybe_unused]] const Domain& domain,
                   [[maybe_unused]] const typename Domain::simplex_descriptor& s)
{
  if constexpr(is_valid<Call_is_simplex, Domain>)
    return domain.is_simplex(s);
  else
    return true;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_IS_IN_DOMAIN_H
