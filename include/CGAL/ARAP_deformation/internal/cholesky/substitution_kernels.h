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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUBSTITUTION_KERNELS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUBSTITUTION_KERNELS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <cstddef>

// Substitution with the supernodes of one block, for four right-hand sides side by side. The values
// of a supernode are read once, a few columns together, so that each row of the vector is read and
// written once for all of them. Vectors are arrays of numbers, four for each row: an array of
// Vector4 would have one alignment in the code that allocates it and another in the AVX2 kernels.
// The diagonal is stored as its reciprocals.

namespace CGAL {
namespace ARAP {
namespace internal {

// `Width` columns, whose first is that of the vector: solves with their triangle and subtracts
// their multiples from `own` rows that follow and from those listed.
template <int Width>
struct Forward_columns
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void run(const Number* values, std::ptrdiff_t stride, int own,
                                          const int* rows, int below, Number* column,
                                          Number* vector)
  {
    using Row = Vector4<Number>;
    Row x[std::size_t(Width)];
    for(int j = 0; j < Width; ++j)
    {
      Row sum = Row::load(column + 4 * j);
      for(int i = 0; i < j; ++i)
        sum = negative_multiply_add(Row::all(values[i * stride + j]), x[i], sum);
      x[j] = sum * Row::all(values[j * stride + j]);
      x[j].store(column + 4 * j);
    }
    values += Width;
    column += 4 * Width;
    for(int k = 0; k < own; ++k)
    {
      Row sum = Row::load(column + 4 * k);
      for(int j = 0; j < Width; ++j)
        sum = negative_multiply_add(Row::all(values[j * stride + k]), x[j], sum);
      sum.store(column + 4 * k);
    }
    values += own;
    for(int k = 0; k < below; ++k)
    {
      Number* const row = vector + 4 * std::ptrdiff_t(rows[k]);
      Row sum = Row::load(row);
      for(int j = 0; j < Width; ++j)
        sum = negative_multiply_add(Row::all(values[j * stride + k]), x[j], sum);
      sum.store(row);
    }
  }
};

// The same with the transposed columns.
template <int Width>
struct Backward_columns
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void run(const Number* values, std::ptrdiff_t stride, int own,
                                          const int* rows, int below, Number* column,
                                          Number* vector)
  {
    using Row = Vector4<Number>;
    Row sum[std::size_t(Width)];
    for(int j = 0; j < Width; ++j)
      sum[j] = Row::zero();
    const Number* const lower = values + Width + own;
    for(int k = 0; k < below; ++k)
    {
      const Row x = Row::load(vector + 4 * std::ptrdiff_t(rows[k]));
      for(int j = 0; j < Width; ++j)
        sum[j] = multiply_add(Row::all(lower[j * stride + k]), x, sum[j]);
    }
    for(int k = 0; k < own; ++k)
    {
      const Row x = Row::load(column + 4 * (Width + k));
      for(int j = 0; j < Width; ++j)
        sum[j] = multiply_add(Row::all(values[j * stride + Width + k]), x, sum[j]);
    }
    for(int j = Width; j-- > 0;)
    {
      const Row x = (Row::load(column + 4 * j) - sum[j])
                      * Row::all(values[j * stride + j]);
      x.store(column + 4 * j);
      for(int i = 0; i < j; ++i)
        sum[i] = multiply_add(Row::all(values[i * stride + j]), x, sum[i]);
    }
  }
};

// how many of the remaining columns of a supernode are worked on together: 1 to 4, or 8
CGAL_ARAP_ALWAYS_INLINE int columns_at_once(int remaining, int most)
{
  return remaining >= most ? most : remaining > 4 ? 4 : remaining;
}

// Columns<width>::run(arguments...) for a width of columns_at_once()
template <template <int> class Columns, int most, typename... Arguments>
CGAL_ARAP_ALWAYS_INLINE void run_columns(int width, Arguments... arguments)
{
  static_assert(most == 2 || most == 4 || most == 8, "a case for each width");
  if constexpr(most == 8)
    if(width == 8)
      return Columns<8>::run(arguments...);
  if constexpr(most >= 4)
    switch(width)
    {
    case 3: return Columns<3>::run(arguments...);
    case 4: return Columns<4>::run(arguments...);
    }
  if(width == 1)
    return Columns<1>::run(arguments...);
  Columns<2>::run(arguments...);
}

// Prefetches the values of a supernode, or the first of them.
template <typename Number>
CGAL_ARAP_ALWAYS_INLINE void prefetch(const Supernodal_structure::Supernode& s,
                                      const Number* values)
{
#if defined(__GNUC__)
  constexpr std::size_t line = 64 / sizeof(Number), most = 64 * line;
  const std::size_t size = Supernodal_structure::size(s);
  const Number* const begin = values + s.values;
  for(std::size_t k = 0; k < size && k < most; k += line)
    __builtin_prefetch(begin + k);
#else
  static_cast<void>(s);
  static_cast<void>(values);
#endif
}

// L y = x with the columns of some supernodes of one block, `most` columns at a time
template <int most>
struct Forward_supernodes
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void run(const Supernodal_structure& structure, int begin, int end,
                                          const Number* values, Number* vector)
  {
    for(int k = begin; k < end; ++k)
    {
      const Supernodal_structure::Supernode& s = structure.supernodes()[k];
      if(k + 1 < end)
        prefetch(structure.supernodes()[k + 1], values);
      const std::ptrdiff_t stride = s.width + s.below;
      const Number* const first = values + s.values;
      for(int j = 0, width = 0; j < s.width; j += width)
      {
        width = columns_at_once(s.width - j, most);
        run_columns<Forward_columns, most>(width, first + j * stride + j, stride,
                                           s.width - j - width, structure.rows(s), s.below,
                                           vector + 4 * std::ptrdiff_t(s.first + j), vector);
      }
    }
  }
};

// L^T x = y with the same
template <int most>
struct Backward_supernodes
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void run(const Supernodal_structure& structure, int begin, int end,
                                          const Number* values, Number* vector)
  {
    for(int k = end; k-- > begin;)
    {
      const Supernodal_structure::Supernode& s = structure.supernodes()[k];
      if(k > begin)
        prefetch(structure.supernodes()[k - 1], values);
      const std::ptrdiff_t stride = s.width + s.below;
      const Number* const first = values + s.values;
      for(int j = s.width; j > 0;)
      {
        const int remainder = j % most; // the widths of the way forward, backward
        const int width = remainder == 0 ? most : remainder > 4 ? remainder - 4 : remainder;
        j -= width;
        run_columns<Backward_columns, most>(width, first + j * stride + j, stride,
                                            s.width - j - width, structure.rows(s), s.below,
                                            vector + 4 * std::ptrdiff_t(s.first + j), vector);
      }
    }
  }
};

// With AVX2, eight columns at a time leave enough registers for the rest.
template <typename Number>
void run_forward(const Supernodal_structure& structure, int begin, int end, const Number* values,
                 Number* vector)
{
  run_kernel<Forward_supernodes<8>, Forward_supernodes<plain_columns>>(structure, begin, end,
                                                                       values, vector);
}

template <typename Number>
void run_backward(const Supernodal_structure& structure, int begin, int end, const Number* values,
                  Number* vector)
{
  run_kernel<Backward_supernodes<8>, Backward_supernodes<plain_columns>>(structure, begin, end,
                                                                         values, vector);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUBSTITUTION_KERNELS_H
