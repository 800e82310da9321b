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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_ROTATION_VECTORS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_ROTATION_VECTORS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cmath>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// the axis of a rotation times its angle, which is at most pi
inline Coordinates rotation_vector(const Matrix_3x3& m)
{
  const Coordinates axis = axial_vector(m); // times 2 sin of the angle
  const double sine = 0.5 * std::sqrt(dot(axis, axis)), cosine = 0.5 * (m[0] + m[4] + m[8] - 1);
  const double angle = std::atan2(sine, cosine);
  if(sine > 1e-6)
    return scaled(axis, 0.5 * angle / sine);
  if(cosine > 0)
    return scaled(axis, 0.5);
  // next to a half turn m + m^T = 4 a a^T - 2 I: the longest column of a a^T is along the axis a,
  // or opposite
  const std::size_t k = m[0] >= m[4] && m[0] >= m[8] ? 0 : m[4] >= m[8] ? 1 : 2;
  Coordinates column = {m[k] + m[3 * k], m[3 + k] + m[3 * k + 1], m[6 + k] + m[3 * k + 2]};
  column[k] += 2;
  return scaled(column, std::copysign(angle, dot(column, axis)) / std::sqrt(dot(column, column)));
}

inline Matrix_3x3 rotation_of_vector(const Coordinates& v)
{
  const double angle = std::sqrt(dot(v, v));
  const double s = angle > 1e-8 ? std::sin(angle) / angle : 1;
  const double c = angle > 1e-4 ? (1 - std::cos(angle)) / (angle * angle) : 0.5;
  const auto [x, y, z] = v;
  return {1 - c * (y * y + z * z), c * x * y - s * z,       c * x * z + s * y,
          c * x * y + s * z,       1 - c * (x * x + z * z), c * y * z - s * x,
          c * x * z - s * y,       c * y * z + s * x,       1 - c * (x * x + y * y)};
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_ROTATION_VECTORS_H
