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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_IS_FINITE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_IS_FINITE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>

#include <cstdint>
#include <cstring>

namespace CGAL {
namespace ARAP {
namespace internal {

// These look at the bits, since -ffast-math takes std::isfinite() to be true and std::isnan() to be
// false.

constexpr std::uint64_t bits_of_infinity = 0x7ff0000000000000;

inline std::uint64_t bits_of_magnitude(double x)
{
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof(bits));
  return bits & ~(std::uint64_t(1) << 63);
}

inline bool is_finite(double x) { return bits_of_magnitude(x) < bits_of_infinity; }
inline bool is_nan(double x) { return bits_of_magnitude(x) > bits_of_infinity; }

inline bool is_finite(const Coordinates& a)
{
  return is_finite(a[0]) && is_finite(a[1]) && is_finite(a[2]);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_IS_FINITE_H
