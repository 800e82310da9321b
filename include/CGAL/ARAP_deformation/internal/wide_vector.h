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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_WIDE_VECTOR_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_WIDE_VECTOR_H

#include <CGAL/license/ARAP_deformation.h>

#include <cstring>

// Code that the compiler is to put into its caller whatever it thinks of that: only so is it
// compiled for the instruction set of the caller.
#if defined(__GNUC__)
#define CGAL_ARAP_ALWAYS_INLINE __attribute__((always_inline)) inline
#else
#define CGAL_ARAP_ALWAYS_INLINE inline
#endif

// Whether there is something to choose at run time: x86 that is not compiled for AVX2 anyway.
#if defined(__GNUC__) && defined(__x86_64__) && \
    !(defined(__AVX2__) && defined(__FMA__))
#define CGAL_ARAP_HAS_DISPATCH
#endif

namespace CGAL {
namespace ARAP {
namespace internal {

// Four numbers side by side, on which the operations are done at once. The compilers make of it
// what the processor has: one register of AVX, two of SSE2, NEON or WebAssembly. (Without alignas()
// g++ aligns by what the program is compiled for, which is not enough for what is chosen later.)
struct alignas(32) Double4
{
#if defined(__GNUC__)
  using Lanes = double __attribute__((vector_size(32)));
  Lanes lanes;

  CGAL_ARAP_ALWAYS_INLINE static Double4 of(double a, double b, double c, double d = 0)
  { return {Lanes{a, b, c, d}}; }

  friend CGAL_ARAP_ALWAYS_INLINE Double4 operator+(const Double4& a, const Double4& b)
  { return {a.lanes + b.lanes}; }
  friend CGAL_ARAP_ALWAYS_INLINE Double4 operator-(const Double4& a, const Double4& b)
  { return {a.lanes - b.lanes}; }
  friend CGAL_ARAP_ALWAYS_INLINE Double4 operator*(const Double4& a, const Double4& b)
  { return {a.lanes * b.lanes}; }
  friend CGAL_ARAP_ALWAYS_INLINE Double4 operator/(const Double4& a, const Double4& b)
  { return {a.lanes / b.lanes}; }

  // a b + c and c - a b, fused where the processor can: in one expression, or clang does not fuse it
  friend CGAL_ARAP_ALWAYS_INLINE Double4 multiply_add(const Double4& a, const Double4& b,
                                                      const Double4& c)
  { return {a.lanes * b.lanes + c.lanes}; }
  friend CGAL_ARAP_ALWAYS_INLINE Double4 negative_multiply_add(const Double4& a, const Double4& b,
                                                               const Double4& c)
  { return {c.lanes - a.lanes * b.lanes}; }
#else
  double lanes[4];

  static Double4 of(double a, double b, double c, double d = 0) { return {{a, b, c, d}}; }

  friend Double4 operator+(const Double4& a, const Double4& b)
  {
    return {{a.lanes[0] + b.lanes[0], a.lanes[1] + b.lanes[1],
             a.lanes[2] + b.lanes[2], a.lanes[3] + b.lanes[3]}};
  }
  friend Double4 operator-(const Double4& a, const Double4& b)
  {
    return {{a.lanes[0] - b.lanes[0], a.lanes[1] - b.lanes[1],
             a.lanes[2] - b.lanes[2], a.lanes[3] - b.lanes[3]}};
  }
  friend Double4 operator*(const Double4& a, const Double4& b)
  {
    return {{a.lanes[0] * b.lanes[0], a.lanes[1] * b.lanes[1],
             a.lanes[2] * b.lanes[2], a.lanes[3] * b.lanes[3]}};
  }
  friend Double4 operator/(const Double4& a, const Double4& b)
  {
    return {{a.lanes[0] / b.lanes[0], a.lanes[1] / b.lanes[1],
             a.lanes[2] / b.lanes[2], a.lanes[3] / b.lanes[3]}};
  }
  friend Double4 multiply_add(const Double4& a, const Double4& b, const Double4& c)
  { return a * b + c; }
  friend Double4 negative_multiply_add(const Double4& a, const Double4& b, const Double4& c)
  { return c - a * b; }
#endif

  // by way of memory, of which g++ makes one instruction where there is one; of(a, a, a, a) is
  // taken apart into halves before it is known what the caller is compiled for
  CGAL_ARAP_ALWAYS_INLINE static Double4 all(double a)
  {
    const double four[4] = {a, a, a, a};
    return load(four);
  }
  CGAL_ARAP_ALWAYS_INLINE static Double4 zero() { return all(0); }

  // four numbers in a row, at any address
  CGAL_ARAP_ALWAYS_INLINE static Double4 load(const double* p)
  {
    Double4 a;
    std::memcpy(&a.lanes, p, sizeof(a.lanes));
    return a;
  }

  CGAL_ARAP_ALWAYS_INLINE void store(double* p) const { std::memcpy(p, &lanes, sizeof(lanes)); }

  CGAL_ARAP_ALWAYS_INLINE double operator[](int k) const { return lanes[k]; }

  // (d, a, b, c) of (a, b, c, d)
  CGAL_ARAP_ALWAYS_INLINE Double4 turned() const
  {
#if defined(__clang__)
    return {__builtin_shufflevector(lanes, lanes, 3, 0, 1, 2)};
#elif defined(__GNUC__)
    using Places = long long __attribute__((vector_size(32)));
    return {__builtin_shuffle(lanes, Places{3, 0, 1, 2})};
#else
    return of(lanes[3], lanes[0], lanes[1], lanes[2]);
#endif
  }
};

#ifdef CGAL_ARAP_HAS_DISPATCH
inline bool has_avx2()
{
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}

template <typename Kernel, typename... Arguments>
__attribute__((target("avx2,fma"))) void run_with_avx2(const Arguments&... arguments)
{
  Kernel::run(arguments...);
}
#endif

// Calls Kernel::run(arguments...) in a version for the widest registers of this processor that are
// of use. Kernel::run() is static and void, and like all that it calls CGAL_ARAP_ALWAYS_INLINE;
// lambda expressions would not be.
template <typename Kernel, typename... Arguments>
void run_kernel(const Arguments&... arguments)
{
#ifdef CGAL_ARAP_HAS_DISPATCH
  if(has_avx2())
    return run_with_avx2<Kernel>(arguments...);
#endif
  Kernel::run(arguments...);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_WIDE_VECTOR_H
