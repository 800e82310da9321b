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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_VECTOR_KERNELS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_VECTOR_KERNELS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {
inline namespace CGAL_ARAP_SIMD {

// adds the dot product of f and h, n numbers each, to *sum
struct Add_dot_product
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const double* f, const float* h, std::size_t n,
                                          double* sum)
  {
    Double4 even = Double4::zero(), odd = Double4::zero();
    std::size_t k = 0;
    for(; k + 8 <= n; k += 8)
    {
      even = multiply_add(Double4::load(f + k), Double4::load(h + k), even);
      odd = multiply_add(Double4::load(f + k + 4), Double4::load(h + k + 4), odd);
    }
    const Double4 both = even + odd;
    double total = (both[0] + both[1]) + (both[2] + both[3]);
    for(; k < n; ++k)
      total += f[k] * h[k];
    *sum += total;
  }
};

// adds a h to p, n numbers each
struct Add_multiple
{
  CGAL_ARAP_ALWAYS_INLINE static void run(double a, const float* h, std::size_t n, double* p)
  {
    const Double4 factor = Double4::all(a);
    std::size_t k = 0;
    for(; k + 4 <= n; k += 4)
      multiply_add(factor, Double4::load(h + k), Double4::load(p + k)).store(p + k);
    for(; k < n; ++k)
      p[k] += a * h[k];
  }
};

} // namespace CGAL_ARAP_SIMD
} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_VECTOR_KERNELS_H
