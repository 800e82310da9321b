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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_MATRIX_3X3_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_MATRIX_3X3_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

namespace CGAL {
namespace ARAP {
namespace internal {
inline namespace CGAL_ARAP_SIMD {

// The columns of a 3 x 3 matrix, for products with vectors. The fourth lane of a column, and so of
// a product, may hold anything.
struct Matrix_columns
{
  Double4 x, y, z;

  CGAL_ARAP_ALWAYS_INLINE static Matrix_columns of(const Matrix_3x3& m)
  {
    const Double4 row_0 = Double4::load(m.data()), row_1 = Double4::load(m.data() + 3);
    const Double4 row_2 = Double4::load(m.data() + 5); // with the number before it
    const Double4 even = shuffle<0, 4, 2, 6>(row_0, row_1), odd = shuffle<1, 5, 3, 7>(row_0, row_1);
    return {shuffle<0, 1, 5, 5>(even, row_2), shuffle<0, 1, 6, 6>(odd, row_2),
            shuffle<2, 3, 7, 7>(even, row_2)};
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

// The rows of a 3 x 3 matrix, to which products are added. The fourth lane of a row may hold
// anything.
struct Matrix_rows
{
  Double4 x, y, z;

  CGAL_ARAP_ALWAYS_INLINE static Matrix_rows zero()
  {
    return {Double4::zero(), Double4::zero(), Double4::zero()};
  }

  CGAL_ARAP_ALWAYS_INLINE static Matrix_rows of(const Matrix_3x3& m)
  {
    const Double4 last = Double4::load(m.data() + 5); // with the number before it
    return {Double4::load(m.data()), Double4::load(m.data() + 3), shuffle<1, 2, 3, 3>(last, last)};
  }

  // adds a m
  CGAL_ARAP_ALWAYS_INLINE void add_product(const Double4& a, const Matrix_rows& m)
  {
    x = multiply_add(a, m.x, x);
    y = multiply_add(a, m.y, y);
    z = multiply_add(a, m.z, z);
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

CGAL_ARAP_ALWAYS_INLINE Matrix_columns columns_of(const Matrix_rows& m)
{
  Double4 x = m.x, y = m.y, z = m.z, any = m.z;
  transpose(x, y, z, any);
  return {x, y, z};
}

// the sums of the first three lanes of a, b and c; the fourth lane may hold anything
CGAL_ARAP_ALWAYS_INLINE Double4 sums_of_lanes(const Double4& a, const Double4& b, const Double4& c)
{
  Double4 x = a, y = b, z = c, any = c;
  transpose(x, y, z, any);
  return x + y + z;
}

} // namespace CGAL_ARAP_SIMD
} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_MATRIX_3X3_H
