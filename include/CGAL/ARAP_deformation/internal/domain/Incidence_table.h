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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_INCIDENCE_TABLE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_INCIDENCE_TABLE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Index_lists.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The incident simplices of each vertex 0, 1, ..., for complexes that do not store them. Linear
// time and memory.
class Incidence_table
{
public:
  // Each simplex of an array is a range of integers. Corners that are not vertices are ignored.
  template <typename SimplexRange>
  Incidence_table(std::size_t number_of_vertices, const SimplexRange& simplices)
    : m_simplices(lists_of_pairs(to_index(number_of_vertices), [&](const auto& f) {
        for(std::size_t s = 0; s < simplices.size(); ++s)
          for(auto corner : simplices[s])
            if(const std::size_t v = static_cast<std::size_t>(corner); v < number_of_vertices)
              f(static_cast<int>(v), static_cast<int>(s));
      }))
  {}

  bool is_isolated(std::size_t v) const { return simplices_at(v).size() == 0; }

  template <typename Function>
  void for_each_simplex_at(std::size_t v, const Function& f) const
  {
    const Index_range simplices = simplices_at(v);
    for(const int* s = simplices.begin(); s != simplices.end(); ++s)
      if(s == simplices.begin() || *s != s[-1]) // else v is a repeated corner
        f(static_cast<std::size_t>(*s));
  }

private:
  Index_range simplices_at(std::size_t v) const { return m_simplices.list(static_cast<int>(v)); }

  Index_lists m_simplices; // at each vertex
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_INCIDENCE_TABLE_H
