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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_DENSE_CHOLESKY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_DENSE_CHOLESKY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <cmath>
#include <cstddef>

// Dense Cholesky factorization of the columns of one supernode, and the dense product that goes
// with it. Matrices are stored column by column.

namespace CGAL {
namespace ARAP {
namespace internal {

// C := C - A B^T for a tile of C in registers, with 4 `Fours` rows and `Columns` columns. A and B
// have `depth` columns and the same stride.
template <int Fours, int Columns>
CGAL_ARAP_ALWAYS_INLINE void subtract_tile(double* c, std::ptrdiff_t c_stride, const double* a,
                                           const double* b, std::ptrdiff_t stride, int depth)
{
  Double4 sum[std::size_t(Columns)][std::size_t(Fours)];
  for(int j = 0; j < Columns; ++j)
    for(int i = 0; i < Fours; ++i)
      sum[j][i] = Double4::load(c + j * c_stride + 4 * i);
  for(int k = 0; k < depth; ++k, a += stride, b += stride)
  {
    Double4 column[std::size_t(Fours)];
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
CGAL_ARAP_ALWAYS_INLINE void subtract_row_product(double* c, std::ptrdiff_t c_stride,
                                                  const double* a, const double* b,
                                                  std::ptrdiff_t stride, int depth)
{
  double sum[std::size_t(Columns)];
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
CGAL_ARAP_ALWAYS_INLINE void subtract_columns(int rows, double* c, std::ptrdiff_t c_stride,
                                              const double* a, const double* b,
                                              std::ptrdiff_t stride, int depth)
{
  int i = 0;
  for(; i + 8 <= rows; i += 8)
    subtract_tile<2, Columns>(c + i, c_stride, a + i, b, stride, depth);
  for(; i + 4 <= rows; i += 4)
    subtract_tile<1, Columns>(c + i, c_stride, a + i, b, stride, depth);
  for(; i < rows; ++i)
    subtract_row_product<Columns>(c + i, c_stride, a + i, b, stride, depth);
}

// Factors the first `Columns` columns of `panel`, which hold a symmetric matrix with `rows` more
// rows below. The diagonal is replaced by its reciprocals.
template <int Columns>
CGAL_ARAP_ALWAYS_INLINE void factor_columns(int rows, double* panel, std::ptrdiff_t stride)
{
  double l[std::size_t(Columns)][std::size_t(Columns)], reciprocal[std::size_t(Columns)];
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
    Double4 entry[std::size_t(Columns)];
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

// factor_panel() with at most so many columns at a time
template <int most>
struct Factor_panel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(double* panel, int width, int height)
  {
    int j = 0;
    for(; j + most <= width; j += most)
      run_columns<most>(panel, j, height);
    if constexpr(most > 2)
      switch(width - j)
      {
      case 2: return run_columns<2>(panel, j, height);
      case 3: return run_columns<3>(panel, j, height);
      }
    if(j < width)
      run_columns<1>(panel, j, height);
  }

private:
  template <int Columns>
  CGAL_ARAP_ALWAYS_INLINE static void run_columns(double* panel, int first, int height)
  {
    const std::ptrdiff_t stride = height;
    double* const columns = panel + first * stride + first;
    subtract_columns<Columns>(height - first, columns, stride, panel + first, panel + first,
                              stride, first);
    factor_columns<Columns>(height - first - Columns, columns, stride);
  }
};

// subtract_square() with at most so many columns at a time
template <int most>
struct Subtract_square
{
  // so many entries of A fit into the second-level cache
  static constexpr int rows_at_once = 192, depth_at_once = 128;

  CGAL_ARAP_ALWAYS_INLINE static void run(double* u, std::ptrdiff_t u_stride, int n, int first,
                                          int last, const double* a, int width,
                                          std::ptrdiff_t stride)
  {
    for(int k = 0; k < width; k += depth_at_once)
    {
      const int depth = width - k < depth_at_once ? width - k : depth_at_once;
      for(int i = 0; i < n; i += rows_at_once)
      {
        const int end = n - i < rows_at_once ? n : i + rows_at_once;
        for(int j = first; j < end && j < last; j += most)
        {
          const int begin = i < j ? j : i;
          run_columns(last - j, end - begin, u + j * u_stride + begin, u_stride,
                      a + k * stride + begin, a + k * stride + j, stride, depth);
        }
      }
    }
  }

private:
  // with as many columns as there are, but at most `most`
  CGAL_ARAP_ALWAYS_INLINE static void
  run_columns(int columns, int rows, double* u, std::ptrdiff_t u_stride, const double* a,
              const double* b, std::ptrdiff_t stride, int depth)
  {
    if constexpr(most > 2)
      switch(columns)
      {
      case 2: return subtract_columns<2>(rows, u, u_stride, a, b, stride, depth);
      case 3: return subtract_columns<3>(rows, u, u_stride, a, b, stride, depth);
      }
    if(columns < most)
      return subtract_columns<1>(rows, u, u_stride, a, b, stride, depth);
    subtract_columns<most>(rows, u, u_stride, a, b, stride, depth);
  }
};

// Factors the first `width` columns of a matrix with `height` rows, whose upper part is symmetric
// and given by its lower triangle. The diagonal is replaced by its reciprocals, which are NaN where
// the matrix is not positive definite.
inline void factor_panel(double* panel, int width, int height)
{
  run_kernel<Factor_panel<4>, Factor_panel<plain_columns>>(panel, width, height);
}

// U := U - A A^T in the columns from `first` to before `last` of the lower triangle of U. A has n
// rows and `width` columns; `first` is a multiple of four. Entries of U above the diagonal may
// change too.
inline void subtract_square(double* u, std::ptrdiff_t u_stride, int n, int first, int last,
                            const double* a, int width, std::ptrdiff_t stride)
{
  run_kernel<Subtract_square<4>, Subtract_square<plain_columns>>(u, u_stride, n, first, last, a,
                                                                 width, stride);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_DENSE_CHOLESKY_H
