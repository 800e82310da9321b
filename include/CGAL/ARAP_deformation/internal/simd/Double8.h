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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_DOUBLE8_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_DOUBLE8_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

namespace CGAL {
namespace ARAP {
namespace internal {
inline namespace CGAL_ARAP_SIMD {

// Two SIMD vectors of four numbers, for long chains of dependent operations: the processor
// interleaves two chains.
struct Double8
{
  static constexpr int size = 8;

  Double4 low, high;

  CGAL_ARAP_ALWAYS_INLINE static Double8 all(double a)
  { return {Double4::all(a), Double4::all(a)}; }
  CGAL_ARAP_ALWAYS_INLINE static Double8 zero() { return all(0); }

  friend CGAL_ARAP_ALWAYS_INLINE Double8 operator+(const Double8& a, const Double8& b)
  { return {a.low + b.low, a.high + b.high}; }
  friend CGAL_ARAP_ALWAYS_INLINE Double8 operator-(const Double8& a, const Double8& b)
  { return {a.low - b.low, a.high - b.high}; }
  friend CGAL_ARAP_ALWAYS_INLINE Double8 operator*(const Double8& a, const Double8& b)
  { return {a.low * b.low, a.high * b.high}; }
  friend CGAL_ARAP_ALWAYS_INLINE Double8 operator/(const Double8& a, const Double8& b)
  { return {a.low / b.low, a.high / b.high}; }

  friend CGAL_ARAP_ALWAYS_INLINE Double8 multiply_add(const Double8& a, const Double8& b,
                                                      const Double8& c)
  { return {multiply_add(a.low, b.low, c.low), multiply_add(a.high, b.high, c.high)}; }
  friend CGAL_ARAP_ALWAYS_INLINE Double8 multiply_subtract(const Double8& a, const Double8& b,
                                                           const Double8& c)
  { return {multiply_subtract(a.low, b.low, c.low), multiply_subtract(a.high, b.high, c.high)}; }

  friend CGAL_ARAP_ALWAYS_INLINE Double8 abs(const Double8& a)
  { return {abs(a.low), abs(a.high)}; }
  friend CGAL_ARAP_ALWAYS_INLINE Double8 scale_to_one(const Double8& a)
  { return {scale_to_one(a.low), scale_to_one(a.high)}; }
};

// Eight truth values.
struct Bool8
{
  Bool4 low, high;

  friend CGAL_ARAP_ALWAYS_INLINE Bool8 operator&(const Bool8& a, const Bool8& b)
  { return {a.low & b.low, a.high & b.high}; }
  friend CGAL_ARAP_ALWAYS_INLINE Bool8 operator|(const Bool8& a, const Bool8& b)
  { return {a.low | b.low, a.high | b.high}; }
  friend CGAL_ARAP_ALWAYS_INLINE bool are_all(const Bool8& a) { return are_all(a.low & a.high); }

  CGAL_ARAP_ALWAYS_INLINE bool operator[](int k) const { return k < 4 ? low[k] : high[k - 4]; }
};

CGAL_ARAP_ALWAYS_INLINE Bool8 operator<(const Double8& a, const Double8& b)
{ return {a.low < b.low, a.high < b.high}; }

CGAL_ARAP_ALWAYS_INLINE Double8 select(const Bool8& condition, const Double8& a, const Double8& b)
{ return {select(condition.low, a.low, b.low), select(condition.high, a.high, b.high)}; }

} // namespace CGAL_ARAP_SIMD
} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_DOUBLE8_H
