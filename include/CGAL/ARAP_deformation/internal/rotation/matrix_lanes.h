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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_MATRIX_LANES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_MATRIX_LANES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/simd/Double8.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

namespace CGAL {
namespace ARAP {
namespace internal {

// 3 x 3 matrices, one in each lane, row by row.
template <typename Entry>
struct Matrix_lanes
{
  Entry entries[9];

  CGAL_ARAP_ALWAYS_INLINE const Entry& operator()(int row, int column) const
  { return entries[3 * row + column]; }
  CGAL_ARAP_ALWAYS_INLINE Entry& operator()(int row, int column)
  { return entries[3 * row + column]; }
};

// Vectors, one in each lane.
template <typename Number>
struct Vector_lanes
{
  Number x, y, z;

  friend CGAL_ARAP_ALWAYS_INLINE Number dot(const Vector_lanes& a, const Vector_lanes& b)
  { return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z)); }
  friend CGAL_ARAP_ALWAYS_INLINE Vector_lanes scaled(const Number& a, const Vector_lanes& b)
  { return {a * b.x, a * b.y, a * b.z}; }
  // a b + c
  friend CGAL_ARAP_ALWAYS_INLINE Vector_lanes multiply_add(const Number& a, const Vector_lanes& b,
                                                           const Vector_lanes& c)
  { return {multiply_add(a, b.x, c.x), multiply_add(a, b.y, c.y), multiply_add(a, b.z, c.z)}; }
};

template <typename Number>
struct Symmetric_matrix_lanes
{
  using Vectors = Vector_lanes<Number>;

  Number xx, yy, zz, yz, xz, xy;

  friend CGAL_ARAP_ALWAYS_INLINE Vectors operator*(const Symmetric_matrix_lanes& m,
                                                   const Vectors& a)
  {
    return {multiply_add(m.xx, a.x, multiply_add(m.xy, a.y, m.xz * a.z)),
            multiply_add(m.xy, a.x, multiply_add(m.yy, a.y, m.yz * a.z)),
            multiply_add(m.xz, a.x, multiply_add(m.yz, a.y, m.zz * a.z))};
  }
  friend CGAL_ARAP_ALWAYS_INLINE Symmetric_matrix_lanes adjugate(const Symmetric_matrix_lanes& m)
  {
    return {multiply_subtract(m.yy, m.zz, m.yz * m.yz),
            multiply_subtract(m.xx, m.zz, m.xz * m.xz),
            multiply_subtract(m.xx, m.yy, m.xy * m.xy),
            multiply_subtract(m.xy, m.xz, m.xx * m.yz),
            multiply_subtract(m.xy, m.yz, m.yy * m.xz),
            multiply_subtract(m.xz, m.yz, m.zz * m.xy)};
  }
};

// No loop over the matrices: compilers would not keep them in registers.
CGAL_ARAP_ALWAYS_INLINE Matrix_lanes<Double4> load_four(const Matrix_3x3* m)
{
  const double *a = m[0].data(), *b = m[1].data(), *c = m[2].data(), *d = m[3].data();
  Matrix_lanes<Double4> result =
    {{Double4::load(a), Double4::load(b), Double4::load(c), Double4::load(d),
      Double4::load(a + 4), Double4::load(b + 4), Double4::load(c + 4), Double4::load(d + 4),
      Double4::of(a[8], b[8], c[8], d[8])}};
  Double4* e = result.entries;
  transpose(e[0], e[1], e[2], e[3]);
  transpose(e[4], e[5], e[6], e[7]);
  return result;
}

CGAL_ARAP_ALWAYS_INLINE void store_four(const Matrix_lanes<Double4>& from, Matrix_3x3* m)
{
  double *a = m[0].data(), *b = m[1].data(), *c = m[2].data(), *d = m[3].data();
  Double4 a0 = from.entries[0], b0 = from.entries[1], c0 = from.entries[2], d0 = from.entries[3];
  Double4 a4 = from.entries[4], b4 = from.entries[5], c4 = from.entries[6], d4 = from.entries[7];
  transpose(a0, b0, c0, d0);
  transpose(a4, b4, c4, d4);
  a0.store(a);
  b0.store(b);
  c0.store(c);
  d0.store(d);
  a4.store(a + 4);
  b4.store(b + 4);
  c4.store(c + 4);
  d4.store(d + 4);
  a[8] = from.entries[8][0];
  b[8] = from.entries[8][1];
  c[8] = from.entries[8][2];
  d[8] = from.entries[8][3];
}

template <typename Number>
CGAL_ARAP_ALWAYS_INLINE Matrix_lanes<Number> load_lanes(const Matrix_3x3* m)
{
  const Matrix_lanes<Double4> low = load_four(m);
  if constexpr(Number::size == 4)
    return low;
  else
  {
    const Matrix_lanes<Double4> high = load_four(m + 4);
    Matrix_lanes<Number> result;
    for(int k = 0; k < 9; ++k)
      result.entries[k] = {low.entries[k], high.entries[k]};
    return result;
  }
}

template <typename Number>
CGAL_ARAP_ALWAYS_INLINE void store_lanes(const Matrix_lanes<Number>& from, Matrix_3x3* m)
{
  if constexpr(Number::size == 4)
    store_four(from, m);
  else
  {
    Matrix_lanes<Double4> low, high;
    for(int k = 0; k < 9; ++k)
    {
      low.entries[k] = from.entries[k].low;
      high.entries[k] = from.entries[k].high;
    }
    store_four(low, m);
    store_four(high, m + 4);
  }
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_MATRIX_LANES_H
