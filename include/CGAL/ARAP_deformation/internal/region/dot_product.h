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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_DOT_PRODUCT_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_DOT_PRODUCT_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// of as many points as the shorter one has
inline double dot_product(const Array<Coordinates>& a, const Array<Coordinates>& b)
{
  return sum_over_blocks((std::min)(a.size(), b.size()), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for(std::size_t v = begin; v < end; ++v)
      sum += dot(a[v], b[v]);
    return sum;
  });
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_DOT_PRODUCT_H
