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
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Calls f(s, simplex_vertices(s)) for each simplex of a whole domain: at the corner of smallest
// index, whose own order of the corners may begin elsewhere, unlike barycentric coordinates. Leaves
// out cells that are none, as they have too few corners, or more than four among tetrahedra. A
// face that comes to that corner twice, along a bridge to a hole, counts once.
template <typename Domain, typename Function>
void for_each_simplex(const Domain& domain, const Function& f)
{
  using Simplex = typename Domain::simplex_descriptor;
  for(const auto& v : domain.vertices())
  {
    std::vector<Simplex> repeated;
    domain.for_each_incident_simplex(v, [&](const Simplex& s, const auto& corners) {
      const auto index = domain.index(v);
      std::ptrdiff_t n = 0, number_of_visits = 0;
      bool is_first = true;
      for(const auto& w : corners)
      {
        ++n;
        number_of_visits += domain.index(w) == index;
        is_first = is_first && !(domain.index(w) < index);
      }
      if(!is_first || (Domain::dimension == 3 ? n != 4 : n < 3))
        return;
      if(number_of_visits > 1)
      {
        if(std::find(repeated.begin(), repeated.end(), s) != repeated.end())
          return;
        repeated.push_back(s);
      }
      f(s, domain.simplex_vertices(s));
    });
  }
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_FOR_EACH_SIMPLEX_H
