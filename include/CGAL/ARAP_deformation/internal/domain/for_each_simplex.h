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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_FOR_EACH_SIMPLEX_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_FOR_EACH_SIMPLEX_H

#include <CGAL/license/ARAP_deformation.h>

#include <algorithm>
#include <iterator>

namespace CGAL {
namespace ARAP {
namespace internal {

// Calls f(s, simplex_vertices(s)) for each simplex of a whole domain: at the corner of smallest
// index, whose own order of the corners may begin elsewhere, unlike barycentric coordinates. Leaves
// out cells that are none, as they have too few corners, or more than four among tetrahedra.
template <typename Domain, typename Function>
void for_each_simplex(const Domain& domain, const Function& f)
{
  for(const auto& v : domain.vertices())
    domain.for_each_incident_simplex(v, [&](const auto& s, const auto& corners) {
      const bool is_first = std::none_of(
        std::begin(corners), std::end(corners),
        [&, index = domain.index(v)](const auto& w) { return domain.index(w) < index; });
      const auto n = std::distance(std::begin(corners), std::end(corners));
      if(is_first && (Domain::dimension == 3 ? n == 4 : n >= 3))
        f(s, domain.simplex_vertices(s));
    });
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_FOR_EACH_SIMPLEX_H
