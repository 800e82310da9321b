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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_PAGED_INDEX_MAP_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_PAGED_INDEX_MAP_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/region/Paged_index_map.h>

#include <cstddef>
#include <memory>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
void Paged_index_map::reserve(std::size_t index)
{
  const std::size_t page = index / page_size;
  if(page >= m_pages.size())
    m_pages.resize(page + 1);
  if(!m_pages[page])
  {
    m_pages[page] = std::make_unique<Page>();
    m_pages[page]->fill(none);
  }
}

CGAL_ARAP_INLINE_FUNCTION
void Paged_index_map::set(std::size_t index, int value)
{
  reserve(index);
  (*m_pages[index / page_size])[index % page_size] = value;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_PAGED_INDEX_MAP_IMPL_H
