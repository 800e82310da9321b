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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_PAGED_INDEX_MAP_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_PAGED_INDEX_MAP_H

#include <CGAL/license/ARAP_deformation.h>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// A map from the indices 0, 1, ... of a mesh to int. It takes memory for pages of indices that were
// written, and next to none for those below, so that its cost follows the region of interest and
// not the mesh.
class Paged_index_map
{
public:
  static constexpr int none = -1;

  int operator[](std::size_t index) const
  {
    const std::size_t page = index / page_size;
    return page < m_pages.size() && m_pages[page] ? (*m_pages[page])[index % page_size] : none;
  }

  // allocates what set(index, ...) needs
  void reserve(std::size_t index)
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

  void set(std::size_t index, int value)
  {
    reserve(index);
    (*m_pages[index / page_size])[index % page_size] = value;
  }

private:
  static constexpr std::size_t page_size = 512;
  using Page = std::array<int, page_size>;

  std::vector<std::unique_ptr<Page>> m_pages;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_PAGED_INDEX_MAP_H
