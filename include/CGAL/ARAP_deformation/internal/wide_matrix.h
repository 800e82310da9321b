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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_WIDE_MATRIX_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_WIDE_MATRIX_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/wide_vector.h>

namespace CGAL {
namespace ARAP {
namespace internal {

// The columns of a 3 x 3 matrix, side by side: what is needed to multiply a vector from the left.
struct Matrix_columns
{
  Double4 x, y, z;

  CGAL_ARAP_ALWAYS_INLINE static Matrix_columns of(const Matrix_3x3& m)
  {
    return {Double4::of(m[0], m[3], m[6]), Double4::of(m[1], m[4], m[7]),
            Double4::of(m[2], m[5], m[8])};
  }
};

// a - m b
CGAL_ARAP_ALWAYS_INLINE Double4 subtract_product(const Double4& a, const Matrix_columns& m,
                                                 const Double4& b)
{
  return negative_multiply_add(Double4::all(b[2]), m.z,
         negative_multiply_add(Double4::all(b[1]), m.y,
         negative_multiply_add(Double4::all(b[0]), m.x, a)));
}

// The rows of a 3 x 3 matrix, side by side, to which outer products are added.
struct Matrix_rows
{
  Double4 x, y, z;

  CGAL_ARAP_ALWAYS_INLINE static Matrix_rows zero()
  {
    return {Double4::zero(), Double4::zero(), Double4::zero()};
  }

  // adds a b^T
  CGAL_ARAP_ALWAYS_INLINE void add_outer_product(const Double4& a, const Double4& b)
  {
    x = multiply_add(Double4::all(a[0]), b, x);
    y = multiply_add(Double4::all(a[1]), b, y);
    z = multiply_add(Double4::all(a[2]), b, z);
  }

  CGAL_ARAP_ALWAYS_INLINE void store(Matrix_3x3& m) const
  {
    x.store(m.data()); // the fourth number of each row is overwritten by the next one
    y.store(m.data() + 3);
    m[6] = z[0];
    m[7] = z[1];
    m[8] = z[2];
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_WIDE_MATRIX_H
