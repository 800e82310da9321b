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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_ROTATION_MATRIX_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_ROTATION_MATRIX_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <CGAL/number_utils.h>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Rotation>
using Call_to_rotation_matrix = decltype(std::declval<const Rotation&>().toRotationMatrix());

template <typename Matrix>
using Call_entry = decltype(double(std::declval<const Matrix&>()(0, 0)));

// of Eigen, with a size that is known
template <typename Matrix>
using Call_2x2 = std::enable_if_t<0 <= Matrix::ColsAtCompileTime && Matrix::ColsAtCompileTime < 3>;

template <typename Transformation>
using Call_m = decltype(std::declval<const Transformation&>().m(0, 0));

// A rotation of Eigen (a quaternion, an angle and axis, a matrix), a transformation of CGAL, or
// nine numbers, as nine numbers.
template <typename Rotation>
Matrix_3x3 rotation_matrix(const Rotation& rotation)
{
  if constexpr(std::is_convertible_v<Rotation, Matrix_3x3>)
    return rotation;
  else if constexpr(is_valid<Call_to_rotation_matrix, Rotation>)
    return rotation_matrix(rotation.toRotationMatrix());
  else
  {
    constexpr bool has_entries = is_valid<Call_entry, Rotation>;
    static_assert(!is_valid<Call_2x2, Rotation>, "a rotation must have 3 rows and 3 columns");
    static_assert(has_entries || is_valid<Call_m, Rotation>,
                  "a rotation must be a quaternion or matrix as Eigen's, a CGAL "
                  "Aff_transformation_3, or an ARAP::Matrix_3x3");
    Matrix_3x3 matrix{};
    for(int r = 0; r < 3; ++r)
      for(int c = 0; c < 3; ++c)
        if constexpr(has_entries)
          matrix[static_cast<std::size_t>(3 * r + c)] = double(rotation(r, c));
        else if constexpr(is_valid<Call_m, Rotation>)
          matrix[static_cast<std::size_t>(3 * r + c)] = CGAL::to_double(rotation.m(r, c));
    return matrix;
  }
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_ROTATION_MATRIX_H
