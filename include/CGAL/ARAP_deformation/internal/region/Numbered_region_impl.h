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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_NUMBERED_REGION_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_NUMBERED_REGION_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/region/Numbered_region.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
void Numbered_region::add_movable(std::size_t index)
{
  numbers.set(index, movable_without_number);
  flat.indices.push_back(index);
  ++flat.number_of_movable_vertices;
}

CGAL_ARAP_INLINE_FUNCTION
int Numbered_region::number(std::size_t index)
{
  int n = numbers[index];
  if(n == movable_without_number)
  {
    n = m_number_of_found++;
    numbers.set(index, n);
    flat.indices[n] = index;
  }
  else if(n == Paged_index_map::none)
  {
    n = static_cast<int>(flat.indices.size());
    numbers.set(index, n);
    flat.indices.push_back(index);
  }
  return n;
}

CGAL_ARAP_INLINE_FUNCTION
bool Numbered_region::add_corner(int v, int corner)
{
  if(corner < v)
  {
    flat.corners.resize(static_cast<std::size_t>(flat.first_corner.back()));
    return false;
  }
  flat.corners.push_back(corner);
  return true;
}

// whether there are as many corners as the dimension asks for, all different
inline bool is_simplex(const int* begin, const int* end, int dimension, bool are_polygons_allowed)
{
  const auto n = end - begin;
  if(are_polygons_allowed ? n < 3 : n != dimension + 1)
    return false;
  if(n <= 4)
  {
    for(const int* a = begin; a != end; ++a)
      if(std::find(a + 1, end, *a) != end)
        return false;
    return true;
  }
  std::vector<int> sorted(begin, end);
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

CGAL_ARAP_INLINE_FUNCTION
void Numbered_region::add_simplex(bool are_polygons_allowed)
{
  const int* const begin = flat.corners.data() + flat.first_corner.back();
  const int* const end = flat.corners.data() + flat.corners.size();
  if(are_polygons_allowed && end - begin > most_corners)
    m_refusal = Status::too_many_corners;
  m_is_refused |= m_refusal == Status::too_many_corners ||
                  !is_simplex(begin, end, flat.dimension, are_polygons_allowed);
  flat.first_corner.push_back(to_index(flat.corners.size()));
}

CGAL_ARAP_INLINE_FUNCTION
void Numbered_region::shrink()
{
  flat.indices.shrink_to_fit();
  flat.first_corner.shrink_to_fit();
  flat.corners.shrink_to_fit();
  first_simplex.shrink_to_fit();
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_NUMBERED_REGION_IMPL_H
