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
#include <CGAL/ARAP_deformation/internal/cholesky/packed_values.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <cstddef>
#include <cstdint>

// Substitution with the supernodes of one block, for four right-hand sides side by side. The values
// are read once, in the order in which they stand (packed_values.h), a few columns together, so
// that each row of the vector is read and written once for all of them. Vectors are arrays of
// numbers, four for each row: an array of Vector4 would have one alignment in the code that
// allocates it and another in the AVX2 kernels.

namespace CGAL {
namespace ARAP {
namespace internal {

// Asks for values that far ahead, or behind. An address outside of the array does no harm.
template <int distance, typename Number>
CGAL_ARAP_ALWAYS_INLINE void prefetch(const Number* values)
{
#if defined(__GNUC__)
  __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(values)
                                                   + std::uintptr_t(distance)));
#else
  static_cast<void>(values);
#endif
}

constexpr int bytes_ahead = 4096; // what is read in the time that main memory takes to answer

// Solves with the triangle of `Width` columns, whose first is that of the vector, and subtracts
// their multiples from `own` rows that follow and from those listed. Returns where their values
// end.
template <int Width>
struct Forward_columns
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static const Number* run(const Number* values, int own, const int* rows,
                                                   int below, Number* column, Number* vector)
  {
    using Row = Vector4<Number>;
    Row right[std::size_t(Width)], x[std::size_t(Width)];
    for(int j = 0; j < Width; ++j)
      right[j] = Row::load(column + 4 * j);
    for(int i = 0; i < Width; ++i)
    {
      x[i] = Row::all(*values++) * right[0];
      for(int j = 1; j <= i; ++j)
        x[i] = multiply_add(Row::all(*values++), right[j], x[i]);
      x[i].store(column + 4 * i);
    }
    column += 4 * Width;
    for(int k = 0; k < own; ++k, values += Width)
      subtract(values, x, column + 4 * k);
    for(int k = 0; k < below; ++k, values += Width)
      subtract(values, x, vector + 4 * std::ptrdiff_t(rows[k]));
    return values;
  }

private:
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void subtract(const Number* values, const Vector4<Number>* x,
                                               Number* row)
  {
    using Row = Vector4<Number>;
    prefetch<bytes_ahead>(values);
    Row sum = Row::load(row);
    for(int j = 0; j < Width; ++j)
      sum = negative_multiply_add(Row::all(values[j]), x[j], sum);
    sum.store(row);
  }
};

// The same with the transposed columns, from where their values end to where they begin.
template <int Width>
struct Backward_columns
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static const Number* run(const Number* values, int own, const int* rows,
                                                   int below, Number* column, Number* vector)
  {
    using Row = Vector4<Number>;
    Row sum[std::size_t(Width)], right[std::size_t(Width)];
    for(int j = 0; j < Width; ++j)
      sum[j] = Row::zero();
    for(int k = below; k-- > 0;)
      add(values -= Width, vector + 4 * std::ptrdiff_t(rows[k]), sum);
    for(int k = own; k-- > 0;)
      add(values -= Width, column + 4 * (Width + k), sum);
    for(int i = 0; i < Width; ++i)
      right[i] = Row::load(column + 4 * i) - sum[i];
    values -= Width * (Width + 1) / 2;
    for(int j = 0; j < Width; ++j)
    {
      Row x = Row::all(values[j * (j + 3) / 2]) * right[j];
      for(int i = j + 1; i < Width; ++i)
        x = multiply_add(Row::all(values[i * (i + 1) / 2 + j]), right[i], x);
      x.store(column + 4 * j);
    }
    return values;
  }

private:
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void add(const Number* values, const Number* row,
                                          Vector4<Number>* sum)
  {
    using Row = Vector4<Number>;
    prefetch<-bytes_ahead>(values);
    const Row x = Row::load(row);
    for(int j = 0; j < Width; ++j)
      sum[j] = multiply_add(Row::all(values[j]), x, sum[j]);
  }
};

// Columns<width>::run(arguments...) for a width of columns_together()
template <template <int> class Columns, typename Number, typename... Arguments>
CGAL_ARAP_ALWAYS_INLINE const Number* run_columns(int width, const Number* values,
                                                  Arguments... arguments)
{
  switch(width)
  {
  case 1: return Columns<1>::run(values, arguments...);
  case 2: return Columns<2>::run(values, arguments...);
  case 3: return Columns<3>::run(values, arguments...);
  case 4: return Columns<4>::run(values, arguments...);
  default: return Columns<most_columns_together>::run(values, arguments...);
  }
}

// L y = x with the columns of some supernodes of one block
struct Forward_supernodes
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void run(const Supernodal_structure& structure, int begin, int end,
                                          const Number* values, Number* vector)
  {
    for(int k = begin; k < end; ++k)
    {
      const Supernodal_structure::Supernode& s = structure.supernodes()[k];
      const Number* next = values + s.values;
      for(int j = 0, width = 0; j < s.width; j += width)
      {
        width = columns_together(s.width - j);
        next = run_columns<Forward_columns>(width, next, s.width - j - width, structure.rows(s),
                                            s.below, vector + 4 * std::ptrdiff_t(s.first + j),
                                            vector);
      }
    }
  }
};

// L^T x = y with the same
struct Backward_supernodes
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void run(const Supernodal_structure& structure, int begin, int end,
                                          const Number* values, Number* vector)
  {
    for(int k = end; k-- > begin;)
    {
      const Supernodal_structure::Supernode& s = structure.supernodes()[k];
      const Number* next = values + (s.values + Supernodal_structure::size(s));
      for(int j = s.width; j > 0;)
      {
        const int width = last_columns_together(j);
        j -= width;
        next = run_columns<Backward_columns>(width, next, s.width - j - width, structure.rows(s),
                                             s.below, vector + 4 * std::ptrdiff_t(s.first + j),
                                             vector);
      }
    }
  }
};

template <typename Number>
void run_forward(const Supernodal_structure& structure, int begin, int end, const Number* values,
                 Number* vector)
{
  run_kernel<Forward_supernodes>(structure, begin, end, values, vector);
}

template <typename Number>
void run_backward(const Supernodal_structure& structure, int begin, int end, const Number* values,
                  Number* vector)
{
  run_kernel<Backward_supernodes>(structure, begin, end, values, vector);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUBSTITUTION_KERNELS_H
