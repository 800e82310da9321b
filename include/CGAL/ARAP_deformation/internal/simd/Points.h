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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_POINTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_POINTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {
inline namespace CGAL_ARAP_SIMD {

// Points as kernels read them, where they stand. The fourth lane may hold anything: it is the
// number after the point.
class Points
{
public:
  Points(const Array<Coordinates>& points)
    : m_numbers(points.empty() ? nullptr : points.front().data())
  {}

  CGAL_ARAP_ALWAYS_INLINE Double4 operator[](int v) const
  {
    return Double4::load(m_numbers + 3 * static_cast<std::ptrdiff_t>(v));
  }

private:
  const double* m_numbers;
};

} // namespace CGAL_ARAP_SIMD
} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_POINTS_H
