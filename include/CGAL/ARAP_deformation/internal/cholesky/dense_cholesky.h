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

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <algorithm>
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

// Factors the first `width` columns of a matrix, with at most so many columns at a time.
template <int most>
struct Factor_columns
{
  CGAL_ARAP_ALWAYS_INLINE static void run(double* panel, std::ptrdiff_t stride, int width,
                                          int height)
  {
    int j = 0;
    for(; j + most <= width; j += most)
      run_columns<most>(panel, stride, j, height);
    if constexpr(most > 2)
      switch(width - j)
      {
      case 2: return run_columns<2>(panel, stride, j, height);
      case 3: return run_columns<3>(panel, stride, j, height);
      }
    if(j < width)
      run_columns<1>(panel, stride, j, height);
  }

private:
  template <int Columns>
  CGAL_ARAP_ALWAYS_INLINE static void run_columns(double* panel, std::ptrdiff_t stride, int first,
                                                  int height)
  {
    double* const columns = panel + first * stride + first;
    subtract_columns<Columns>(height - first, columns, stride, panel + first, panel + first,
                              stride, first);
    factor_columns<Columns>(height - first - Columns, columns, stride);
  }
};

// U := U - A B^T, with at most so many columns of U at a time. Column j of U is only needed from
// row j - `above` on.
template <int most>
struct Subtract_product
{
  CGAL_ARAP_ALWAYS_INLINE static void run(double* u, std::ptrdiff_t u_stride, int rows, int columns,
                                          int above, const double* a, const double* b,
                                          std::ptrdiff_t stride, int depth)
  {
    for(int j = 0; j < columns && j < above + rows; j += most)
    {
      const int begin = j < above ? 0 : j - above;
      run_columns(columns - j, rows - begin, u + j * u_stride + begin, u_stride, a + begin, b + j,
                  stride, depth);
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

inline void subtract_product(double* u, std::ptrdiff_t u_stride, int rows, int columns, int above,
                             const double* a, const double* b, std::ptrdiff_t stride, int depth)
{
  run_kernel<Subtract_product<4>, Subtract_product<plain_columns>>(u, u_stride, rows, columns,
                                                                   above, a, b, stride, depth);
}

// Two blocks of so many entries of A fit into the second-level cache.
inline constexpr int rows_at_once = 192, depth_at_once = 128;

// U := U - A A^T in the columns from `first` to before `last` of the lower triangle of U. A has n
// rows and `width` columns; `first` is a multiple of four. Entries of U above the diagonal may
// change too. Large matrices are divided into blocks, which are copied: the columns of A lie in as
// many pages of memory. Different columns of blocks are tasks.
inline void subtract_square(double* u, std::ptrdiff_t u_stride, int n, int first, int last,
                            const double* a, int width, std::ptrdiff_t stride)
{
  const auto depth = [&](int k) { return (std::min)(depth_at_once, width - k); };
  const auto entry = [&](int i, int j) { return u + j * u_stride + i; };
  if(n - first <= rows_at_once)
  {
    for(int k = 0; k < width; k += depth_at_once)
      subtract_product(entry(first, first), u_stride, n - first, last - first, 0,
                       a + k * stride + first, a + k * stride + first, stride, depth(k));
    return;
  }
  const auto copy = [&](int i, int k, Array<double>& block) {
    block.resize(static_cast<std::size_t>(rows_at_once * depth_at_once));
    for(int c = 0; c < depth(k); ++c)
      std::copy_n(a + (k + c) * stride + i, (std::min)(rows_at_once, n - i),
                  block.data() + c * rows_at_once);
  };
  for_each_block(static_cast<std::size_t>(last - first), [&](std::size_t begin, std::size_t end) {
    const int j = first + static_cast<int>(begin), columns = static_cast<int>(end - begin);
    Array<double> block, other_block;
    for(int k = 0; k < width; k += depth_at_once)
    {
      copy(j, k, block);
      for(int i = j; i < n; i += rows_at_once)
      {
        if(i > j)
          copy(i, k, other_block);
        subtract_product(entry(i, j), u_stride, (std::min)(rows_at_once, n - i), columns, i - j,
                         i > j ? other_block.data() : block.data(), block.data(), rows_at_once,
                         depth(k));
      }
    }
  }, rows_at_once);
}

// Factors the first `width` columns of a matrix with `height` rows, whose upper part is symmetric
// and given by its lower triangle. The diagonal is replaced by its reciprocals. Where the matrix is
// not positive definite, the first that is no pivot is not a positive finite number.
inline void factor_panel(double* panel, int width, int height)
{
  constexpr int columns_at_once = 64; // these are read again for each four of them
  const std::ptrdiff_t stride = height;
  for(int k = 0; k < width; k += columns_at_once)
  {
    double* const block = panel + k * (stride + 1);
    const int columns = (std::min)(columns_at_once, width - k);
    run_kernel<Factor_columns<4>, Factor_columns<plain_columns>>(block, stride, columns,
                                                                 height - k);
    if(k + columns < width)
      subtract_square(block + columns * (stride + 1), stride, height - k - columns, 0,
                      width - k - columns, block + columns, columns, stride);
  }
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_DENSE_CHOLESKY_H
