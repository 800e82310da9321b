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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDER_KERNELS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDER_KERNELS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Rows of four columns of the border's W = L^-1 P B, and of what goes with them.
struct Border_rows
{
  const double* border;
  double* other;
  int size;
};

// sums[l] := the sum of border[l] * other, row by row
struct Multiply_border
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const std::vector<Border_rows>& rows, double* sums)
  {
    Double4 sum[4] = {Double4::zero(), Double4::zero(), Double4::zero(), Double4::zero()};
    for(const Border_rows& r : rows)
      for(int k = 0; k < r.size; ++k)
      {
        const Double4 other = Double4::load(r.other + 4 * k);
        for(int l = 0; l < 4; ++l)
          sum[l] = multiply_add(Double4::all(r.border[4 * k + l]), other, sum[l]);
      }
    for(int l = 0; l < 4; ++l)
      sum[l].store(sums + 4 * l);
  }
};

// other := other - the sum of border[l] * factors[l], row by row
struct Subtract_border
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const std::vector<Border_rows>& rows,
                                          const double* factors)
  {
    for(const Border_rows& r : rows)
      for(int k = 0; k < r.size; ++k)
      {
        Double4 other = Double4::load(r.other + 4 * k);
        for(int l = 0; l < 4; ++l)
          other = negative_multiply_add(Double4::all(r.border[4 * k + l]),
                                        Double4::load(factors + 4 * l), other);
        other.store(r.other + 4 * k);
      }
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDER_KERNELS_H
