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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_PARALLEL_LARGEST_ENTRY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_PARALLEL_LARGEST_ENTRY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// the larger of two numbers, or NaN if one of them is
inline double larger_or_nan(double a, double b)
{
  return is_nan(b) || (b > a && !is_nan(a)) ? b : a;
}

// the largest absolute value of a coordinate of n points, or NaN if there is one
inline double largest_entry(const Coordinates* points, std::size_t n)
{
  std::vector<double> of_blocks(n / default_block_size + 1, 0);
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    double largest = 0;
    for(std::size_t v = begin; v < end; ++v)
      for(double entry : points[v])
        largest = larger_or_nan(largest, std::abs(entry));
    of_blocks[begin / default_block_size] = largest;
  });
  double largest = 0;
  for(double of_block : of_blocks)
    largest = larger_or_nan(largest, of_block);
  return largest;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_PARALLEL_LARGEST_ENTRY_H
