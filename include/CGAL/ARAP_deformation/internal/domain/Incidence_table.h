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

#include <cstddef>
#include <numeric>
#include <vector>

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
    : m_begin(number_of_vertices + 1, 0)
  {
    for_each_corner(simplices, [this](std::size_t, std::size_t v) { ++m_begin[v + 1]; });
    std::partial_sum(m_begin.begin(), m_begin.end(), m_begin.begin());
    m_simplices.resize(m_begin.back());
    std::vector<std::size_t> next(m_begin.begin(), m_begin.end() - 1);
    for_each_corner(simplices, [&](std::size_t s, std::size_t v) { m_simplices[next[v]++] = s; });
  }

  std::size_t number_of_vertices() const { return m_begin.size() - 1; }

  bool is_isolated(std::size_t v) const { return m_begin[v] == m_begin[v + 1]; }

  template <typename Function>
  void for_each_simplex_at(std::size_t v, const Function& f) const
  {
    for(std::size_t k = m_begin[v]; k < m_begin[v + 1]; ++k)
      if(k == m_begin[v] || m_simplices[k] != m_simplices[k - 1]) // else v is a repeated corner
        f(m_simplices[k]);
  }

private:
  template <typename SimplexRange, typename Function>
  void for_each_corner(const SimplexRange& simplices, const Function& f) const
  {
    for(std::size_t s = 0; s < simplices.size(); ++s)
      for(auto corner : simplices[s])
        if(const std::size_t v = static_cast<std::size_t>(corner); v < number_of_vertices())
          f(s, v);
  }

  // the simplices at vertex v are m_simplices[m_begin[v]] to m_simplices[m_begin[v + 1] - 1]
  std::vector<std::size_t> m_begin, m_simplices;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_INCIDENCE_TABLE_H
