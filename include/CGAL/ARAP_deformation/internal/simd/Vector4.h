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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_VECTOR4_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_VECTOR4_H

#include <CGAL/license/ARAP_deformation.h>

#include <cmath>
#include <cstring>

// Functions that must be inlined: only then are they compiled for the instruction set of the
// caller.
#if defined(__GNUC__) && !defined(CGAL_ARAP_NO_VECTOR_EXTENSIONS) // a test does without
#define CGAL_ARAP_HAS_VECTOR_EXTENSIONS
#define CGAL_ARAP_ALWAYS_INLINE __attribute__((always_inline)) inline
#define CGAL_ARAP_SIMD with_vector_extensions
#else
#define CGAL_ARAP_ALWAYS_INLINE inline
#define CGAL_ARAP_SIMD without_vector_extensions
#endif

namespace CGAL {
namespace ARAP {
namespace internal {
inline namespace CGAL_ARAP_SIMD { // in one program, both may be there

#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS)
template <typename Number>
struct Lanes_of;

template <>
struct Lanes_of<double> { using type = double __attribute__((vector_size(32))); };

template <>
struct Lanes_of<float> { using type = float __attribute__((vector_size(16))); };
#endif

// A SIMD vector of four numbers. Compilers map it to the registers of the processor: for double one
// of AVX, two of SSE2, NEON or WebAssembly. (Without alignas(), g++ would align it for the
// instruction set of the program, which is not enough for kernels that are chosen at run time.)
template <typename Number>
struct alignas(4 * sizeof(Number)) Vector4
{
  static constexpr int size = 4;

#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS)
  using Lanes = typename Lanes_of<Number>::type;
  Lanes lanes;

  CGAL_ARAP_ALWAYS_INLINE static Vector4 of(Number a, Number b, Number c, Number d = 0)
  { return {Lanes{a, b, c, d}}; }

  friend CGAL_ARAP_ALWAYS_INLINE Vector4 operator+(const Vector4& a, const Vector4& b)
  { return {a.lanes + b.lanes}; }
  friend CGAL_ARAP_ALWAYS_INLINE Vector4 operator-(const Vector4& a, const Vector4& b)
  { return {a.lanes - b.lanes}; }
  friend CGAL_ARAP_ALWAYS_INLINE Vector4 operator*(const Vector4& a, const Vector4& b)
  { return {a.lanes * b.lanes}; }
  friend CGAL_ARAP_ALWAYS_INLINE Vector4 operator/(const Vector4& a, const Vector4& b)
  { return {a.lanes / b.lanes}; }

  // a b + c, fused where the processor can: in one expression, or clang does not fuse it
  friend CGAL_ARAP_ALWAYS_INLINE Vector4 multiply_add(const Vector4& a, const Vector4& b,
                                                      const Vector4& c)
  { return {a.lanes * b.lanes + c.lanes}; }
  friend CGAL_ARAP_ALWAYS_INLINE Vector4 negative_multiply_add(const Vector4& a, const Vector4& b,
                                                               const Vector4& c)
  { return {c.lanes - a.lanes * b.lanes}; }
  friend CGAL_ARAP_ALWAYS_INLINE Vector4 multiply_subtract(const Vector4& a, const Vector4& b,
                                                           const Vector4& c)
  { return {a.lanes * b.lanes - c.lanes}; }
#else
  Number lanes[4];

  static Vector4 of(Number a, Number b, Number c, Number d = 0) { return {{a, b, c, d}}; }

  friend Vector4 operator+(const Vector4& a, const Vector4& b)
  {
    return {{a.lanes[0] + b.lanes[0], a.lanes[1] + b.lanes[1],
             a.lanes[2] + b.lanes[2], a.lanes[3] + b.lanes[3]}};
  }
  friend Vector4 operator-(const Vector4& a, const Vector4& b)
  {
    return {{a.lanes[0] - b.lanes[0], a.lanes[1] - b.lanes[1],
             a.lanes[2] - b.lanes[2], a.lanes[3] - b.lanes[3]}};
  }
  friend Vector4 operator*(const Vector4& a, const Vector4& b)
  {
    return {{a.lanes[0] * b.lanes[0], a.lanes[1] * b.lanes[1],
             a.lanes[2] * b.lanes[2], a.lanes[3] * b.lanes[3]}};
  }
  friend Vector4 operator/(const Vector4& a, const Vector4& b)
  {
    return {{a.lanes[0] / b.lanes[0], a.lanes[1] / b.lanes[1],
             a.lanes[2] / b.lanes[2], a.lanes[3] / b.lanes[3]}};
  }
  friend Vector4 multiply_add(const Vector4& a, const Vector4& b, const Vector4& c)
  { return a * b + c; }
  friend Vector4 negative_multiply_add(const Vector4& a, const Vector4& b, const Vector4& c)
  { return c - a * b; }
  friend Vector4 multiply_subtract(const Vector4& a, const Vector4& b, const Vector4& c)
  { return a * b - c; }
#endif

  // by way of memory, of which g++ makes one instruction where there is one; of(a, a, a, a) is
  // taken apart into halves before it is known what the caller is compiled for
  CGAL_ARAP_ALWAYS_INLINE static Vector4 all(Number a)
  {
    const Number four[4] = {a, a, a, a};
    return load(four);
  }

  CGAL_ARAP_ALWAYS_INLINE static Vector4 zero() { return all(0); }

  // four numbers in a row, at any address, which may be of another precision
  template <typename Other>
  CGAL_ARAP_ALWAYS_INLINE static Vector4 load(const Other* p)
  {
#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS)
    typename Lanes_of<Other>::type others;
    std::memcpy(&others, p, sizeof(others));
    return {__builtin_convertvector(others, Lanes)};
#else
    return {{static_cast<Number>(p[0]), static_cast<Number>(p[1]), static_cast<Number>(p[2]),
             static_cast<Number>(p[3])}};
#endif
  }

  CGAL_ARAP_ALWAYS_INLINE void store(Number* p) const { std::memcpy(p, &lanes, sizeof(lanes)); }

  CGAL_ARAP_ALWAYS_INLINE Number operator[](int k) const { return lanes[k]; }
};

using Double4 = Vector4<double>;

// Four truth values side by side: what comparisons return.
struct alignas(32) Bool4
{
#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS)
  using Lanes = long long __attribute__((vector_size(32))); // all bits set, or none
  Lanes lanes;

  friend CGAL_ARAP_ALWAYS_INLINE Bool4 operator&(const Bool4& a, const Bool4& b)
  { return {a.lanes & b.lanes}; }
  friend CGAL_ARAP_ALWAYS_INLINE Bool4 operator|(const Bool4& a, const Bool4& b)
  { return {a.lanes | b.lanes}; }
#else
  long long lanes[4];

  friend Bool4 operator&(const Bool4& a, const Bool4& b)
  {
    return {{a.lanes[0] & b.lanes[0], a.lanes[1] & b.lanes[1],
             a.lanes[2] & b.lanes[2], a.lanes[3] & b.lanes[3]}};
  }
  friend Bool4 operator|(const Bool4& a, const Bool4& b)
  {
    return {{a.lanes[0] | b.lanes[0], a.lanes[1] | b.lanes[1],
             a.lanes[2] | b.lanes[2], a.lanes[3] | b.lanes[3]}};
  }
#endif

  CGAL_ARAP_ALWAYS_INLINE bool operator[](int k) const { return lanes[k] != 0; }

  friend CGAL_ARAP_ALWAYS_INLINE bool are_all(const Bool4& a)
  { return (a.lanes[0] & a.lanes[1] & a.lanes[2] & a.lanes[3]) != 0; }
};

CGAL_ARAP_ALWAYS_INLINE Bool4 operator<(const Double4& a, const Double4& b)
{
#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS)
  return {reinterpret_cast<Bool4::Lanes>(a.lanes < b.lanes)};
#else
  Bool4 result;
  for(int k = 0; k < 4; ++k)
    result.lanes[k] = -(a.lanes[k] < b.lanes[k]);
  return result;
#endif
}

// in each lane a where the condition holds, b elsewhere
CGAL_ARAP_ALWAYS_INLINE Double4 select(const Bool4& condition, const Double4& a, const Double4& b)
{
#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS)
  return {condition.lanes ? a.lanes : b.lanes};
#else
  Double4 result;
  for(int k = 0; k < 4; ++k)
    result.lanes[k] = condition[k] ? a.lanes[k] : b.lanes[k];
  return result;
#endif
}

// The absolute values.
CGAL_ARAP_ALWAYS_INLINE Double4 abs(const Double4& a)
{
#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS)
  const long long magnitude = 0x7fffffffffffffff;
  const Bool4::Lanes mask = {magnitude, magnitude, magnitude, magnitude};
  return {reinterpret_cast<Double4::Lanes>(reinterpret_cast<Bool4::Lanes>(a.lanes) & mask)};
#else
  Double4 result;
  for(int k = 0; k < 4; ++k)
    result.lanes[k] = std::abs(a.lanes[k]);
  return result;
#endif
}

// The powers of two that scale the positive numbers a to [1, 2), from the bits of the exponent,
// which is faster than a division. Not for denormal or infinite numbers.
CGAL_ARAP_ALWAYS_INLINE Double4 scale_to_one(const Double4& a)
{
  const long long exponent_bits = 0x7ff0000000000000, twice_the_bias = 0x7fe0000000000000;
#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS)
  const Bool4::Lanes mask = {exponent_bits, exponent_bits, exponent_bits, exponent_bits};
  const Bool4::Lanes bias = {twice_the_bias, twice_the_bias, twice_the_bias, twice_the_bias};
  const Bool4::Lanes exponents = reinterpret_cast<Bool4::Lanes>(a.lanes) & mask;
  return {reinterpret_cast<Double4::Lanes>(bias - exponents)};
#else
  long long bits[4];
  std::memcpy(bits, a.lanes, sizeof(bits));
  for(long long& lane : bits)
    lane = twice_the_bias - (lane & exponent_bits);
  Double4 result;
  std::memcpy(result.lanes, bits, sizeof(bits));
  return result;
#endif
}

// the lanes i, j, k, l of a and b: 0 to 3 are those of a, 4 to 7 those of b
template <int i, int j, int k, int l>
CGAL_ARAP_ALWAYS_INLINE Double4 shuffle(const Double4& a, const Double4& b)
{
#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS) && (defined(__clang__) || __GNUC__ >= 12)
  return {__builtin_shufflevector(a.lanes, b.lanes, i, j, k, l)};
#elif defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS)
  return {__builtin_shuffle(a.lanes, b.lanes, Bool4::Lanes{i, j, k, l})};
#else
  return Double4::of(i < 4 ? a[i % 4] : b[i % 4], j < 4 ? a[j % 4] : b[j % 4],
                     k < 4 ? a[k % 4] : b[k % 4], l < 4 ? a[l % 4] : b[l % 4]);
#endif
}

// makes rows of columns
CGAL_ARAP_ALWAYS_INLINE void transpose(Double4& a, Double4& b, Double4& c, Double4& d)
{
  const Double4 ab_even = shuffle<0, 4, 2, 6>(a, b), ab_odd = shuffle<1, 5, 3, 7>(a, b);
  const Double4 cd_even = shuffle<0, 4, 2, 6>(c, d), cd_odd = shuffle<1, 5, 3, 7>(c, d);
  a = shuffle<0, 1, 4, 5>(ab_even, cd_even);
  b = shuffle<0, 1, 4, 5>(ab_odd, cd_odd);
  c = shuffle<2, 3, 6, 7>(ab_even, cd_even);
  d = shuffle<2, 3, 6, 7>(ab_odd, cd_odd);
}

} // namespace CGAL_ARAP_SIMD
} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_VECTOR4_H
