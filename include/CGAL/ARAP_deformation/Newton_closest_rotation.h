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

#ifndef CGAL_ARAP_DEFORMATION_NEWTON_CLOSEST_ROTATION_H
#define CGAL_ARAP_DEFORMATION_NEWTON_CLOSEST_ROTATION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Wide_rotation_kernel.h>
#include <CGAL/ARAP_deformation/internal/wide_vector.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {

class Newton_closest_rotation
{
public:
  /// computes `rotations[k]`, the rotation closest to `covariances[k]`, for `k` in `[0, n)`.
  void operator()(std::size_t n, const Matrix_3x3* covariances, Matrix_3x3* rotations) const
  {
    internal::run_kernel<internal::Wide_rotation_kernel>(n, covariances, rotations);
  }
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_NEWTON_CLOSEST_ROTATION_H
