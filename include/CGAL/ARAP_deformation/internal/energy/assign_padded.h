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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ASSIGN_PADDED_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ASSIGN_PADDED_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Points, with a fourth coordinate that is zero, so that each is loaded at once.
inline void assign_padded(std::vector<Double4>& padded, const std::vector<Coordinates>& points)
{
  padded.resize(points.size());
  for_each_block(points.size(), [&](std::size_t begin, std::size_t end) {
    for(std::size_t k = begin; k < end; ++k)
      padded[k] = Double4::of(points[k][0], points[k][1], points[k][2]);
  }, 16 * default_block_size);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ASSIGN_PADDED_H
