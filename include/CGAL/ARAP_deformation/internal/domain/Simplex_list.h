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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_SIMPLEX_LIST_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_SIMPLEX_LIST_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/domain/for_each_simplex.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The simplices of a whole domain, as the indices of their corners.
template <typename Domain>
class Simplex_list
{
public:
  using Simplex = std::vector<std::size_t>;

  explicit Simplex_list(const Domain& domain)
  {
    for_each_simplex(domain, [&](const auto&, const auto& corners) {
      Simplex simplex;
      for(const auto& v : corners)
        simplex.push_back(domain.index(v));
      m_simplices.push_back(std::move(simplex));
    });
  }

  const std::vector<Simplex>& simplices() const { return m_simplices; }

  // the faces of a surface, or of the boundary of tetrahedra: the triangles of only one of them
  std::vector<Simplex> faces() const
  {
    if(Domain::dimension == 2)
      return m_simplices;
    std::vector<std::array<std::size_t, 3>> all;
    for(const Simplex& s : m_simplices)
      for(std::size_t k = 0; k < 4; ++k)
      {
        all.push_back({s[(k + 1) % 4], s[(k + 2) % 4], s[(k + 3) % 4]});
        std::sort(all.back().begin(), all.back().end());
      }
    std::sort(all.begin(), all.end());
    std::vector<Simplex> result;
    for(auto face = all.begin(); face != all.end();)
    {
      const auto end = std::upper_bound(face, all.end(), *face);
      if(end - face == 1)
        result.emplace_back(face->begin(), face->end());
      face = end;
    }
    return result;
  }

private:
  std::vector<Simplex> m_simplices;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_SIMPLEX_LIST_H
