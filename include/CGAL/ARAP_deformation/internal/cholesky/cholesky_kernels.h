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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_CHOLESKY_KERNELS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_CHOLESKY_KERNELS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <cmath>
#include <cstddef>

// Dense Cholesky factorization of the columns of one supernode. Matrices are stored column by
// column.

namespace CGAL {
namespace ARAP {
namespace internal {

// C := C - A B^T for a tile of C in registers: 4 `Fours` rows, `Columns` columns. A and B have
// `depth` columns and one stride.
template <int Fours, int Columns>
CGAL_ARAP_ALWAYS_INLINE void subtract_tile(double* c, std::size_t c_stride, const double* a,
                                           const double* b, std::size_t stride, int depth)
{
  Double4 sum[Columns][Fours];
  for(int j = 0; j < Columns; ++j)
    for(int i = 0; i < Fours; ++i)
      sum[j][i] = Double4::load(c + j * c_stride + 4 * i);
  for(int k = 0; k < depth; ++k, a += stride, b += stride)
  {
    Double4 column[Fours];
    for(int i = 0; i < Fours; ++i)
      column[i] = Double4::load(a + 4 * i);
    for(int j = 0; j < Columns; ++j)
    {
      const Double4 factor = Double4::all(b[j]);
      for(int i = 0; i < Fours; ++i)
        sum[j][i] = negative_multiply_add(column[i], factor, sum[j][i]);
    }
  }
  for(int j = 0; j < Columns; ++j)
    for(int i = 0; i < Fours; ++i)
      sum[j][i].store(c + j * c_stride + 4 * i);
}

// The same for one row.
template <int Columns>
CGAL_ARAP_ALWAYS_INLINE void subtract_row_product(double* c, std::size_t c_stride, const double* a,
                                                  const double* b, std::size_t stride, int depth)
{
  double sum[Columns];
  for(int j = 0; j < Columns; ++j)
    sum[j] = c[j * c_stride];
  for(int k = 0; k < depth; ++k, a += stride, b += stride)
    for(int j = 0; j < Columns; ++j)
      sum[j] -= *a * b[j];
  for(int j = 0; j < Columns; ++j)
    c[j * c_stride] = sum[j];
}

// C := C - A B^T for any number of rows and a few columns.
template <int Columns>
CGAL_ARAP_ALWAYS_INLINE void subtract_columns(int rows, double* c, std::size_t c_stride,
                                              const double* a, const double* b, std::size_t stride,
                                              int depth)
{
  int i = 0;
  for(; i + 8 <= rows; i += 8)
    subtract_tile<2, Columns>(c + i, c_stride, a + i, b, stride, depth);
  for(; i + 4 <= rows; i += 4)
    subtract_tile<1, Columns>(c + i, c_stride, a + i, b, stride, depth);
  for(; i < rows; ++i)
    subtract_row_product<Columns>(c + i, c_stride, a + i, b, stride, depth);
}

// The first `Columns` columns of `panel` hold a symmetric matrix with `rows` more rows below;
// factors them. In place of the diagonal its reciprocals are stored.
template <int Columns>
CGAL_ARAP_ALWAYS_INLINE void factor_columns(int rows, double* panel, std::size_t stride)
{
  double l[Columns][Columns], reciprocal[Columns];
  for(int j = 0; j < Columns; ++j)
  {
    for(int i = j; i < Columns; ++i)
    {
      double entry = panel[j * stride + i];
      for(int k = 0; k < j; ++k)
        entry -= l[i][k] * l[j][k];
      l[i][j] = i == j ? std::sqrt(entry) : entry * reciprocal[j];
      if(i == j)
        reciprocal[j] = 1 / l[j][j];
      panel[j * stride + i] = i == j ? reciprocal[j] : l[i][j];
    }
  }
  double* below = panel + Columns;
  int i = 0;
  for(; i + 4 <= rows; i += 4)
  {
    Double4 entry[Columns];
    for(int j = 0; j < Columns; ++j)
    {
      entry[j] = Double4::load(below + j * stride + i);
      for(int k = 0; k < j; ++k)
        entry[j] = negative_multiply_add(Double4::all(l[j][k]), entry[k], entry[j]);
      entry[j] = entry[j] * Double4::all(reciprocal[j]);
      entry[j].store(below + j * stride + i);
    }
  }
  for(; i < rows; ++i)
    for(int j = 0; j < Columns; ++j)
    {
      double entry = below[j * stride + i];
      for(int k = 0; k < j; ++k)
        entry -= l[j][k] * below[k * stride + i];
      below[j * stride + i] = entry * reciprocal[j];
    }
}

// The columns of a supernode, which have been assembled, become those of the factor.
struct Factor_panel
{
  template <int Columns>
  CGAL_ARAP_ALWAYS_INLINE static void run(double* panel, int first, int height)
  {
    const std::size_t stride = static_cast<std::size_t>(height);
    double* const columns = panel + first * stride + first;
    subtract_columns<Columns>(height - first, columns, stride, panel + first, panel + first,
                              stride, first);
    factor_columns<Columns>(height - first - Columns, columns, stride);
  }

  CGAL_ARAP_ALWAYS_INLINE static void run(double* panel, int width, int height)
  {
    int j = 0;
    for(; j + 4 <= width; j += 4)
      run<4>(panel, j, height);
    switch(width - j)
    {
    case 1: return run<1>(panel, j, height);
    case 2: return run<2>(panel, j, height);
    case 3: return run<3>(panel, j, height);
    }
  }
};

// U := U - A A^T, of which the lower triangle counts, for the `n` rows of A below the triangle of a
// supernode.
struct Subtract_square
{
  // of A, so many numbers stay in the cache nearest to the registers but one
  static constexpr int rows_at_once = 192, depth_at_once = 128;

  CGAL_ARAP_ALWAYS_INLINE static void run(double* u, int n, const double* a, int width,
                                          std::size_t stride)
  {
    const std::size_t u_stride = static_cast<std::size_t>(n);
    for(int k = 0; k < width; k += depth_at_once)
    {
      const int depth = width - k < depth_at_once ? width - k : depth_at_once;
      for(int i = 0; i < n; i += rows_at_once)
      {
        const int end = n - i < rows_at_once ? n : i + rows_at_once;
        for(int j = 0; j < end; j += 4)
        {
          const int begin = i < j ? j : i;
          subtract_up_to_four_columns(n - j, end - begin, u + j * u_stride + begin, u_stride,
                                      a + k * stride + begin, a + k * stride + j, stride, depth);
        }
      }
    }
  }

private:
  // with as many columns as there are, but not more than four
  CGAL_ARAP_ALWAYS_INLINE static void
  subtract_up_to_four_columns(int columns, int rows, double* u, std::size_t u_stride,
                              const double* a, const double* b, std::size_t stride, int depth)
  {
    switch(columns)
    {
    case 1: return subtract_columns<1>(rows, u, u_stride, a, b, stride, depth);
    case 2: return subtract_columns<2>(rows, u, u_stride, a, b, stride, depth);
    case 3: return subtract_columns<3>(rows, u, u_stride, a, b, stride, depth);
    default: return subtract_columns<4>(rows, u, u_stride, a, b, stride, depth);
    }
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_CHOLESKY_KERNELS_H
