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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_INSERTIONS_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_INSERTIONS_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/session/Insertions.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
void Insertions::add(std::uint64_t insertion, std::size_t place)
{
  m_insertions.emplace_back(insertion, place);
}

CGAL_ARAP_INLINE_FUNCTION
std::vector<std::size_t> Insertions::places_in_order()
{
  if(!std::is_sorted(m_insertions.begin(), m_insertions.end()))
    std::sort(m_insertions.begin(), m_insertions.end());
  std::vector<std::size_t> places;
  places.reserve(m_insertions.size());
  for(const auto& insertion : m_insertions)
    places.push_back(insertion.second);
  return places;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_INSERTIONS_IMPL_H
