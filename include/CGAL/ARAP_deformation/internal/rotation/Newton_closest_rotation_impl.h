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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_NEWTON_CLOSEST_ROTATION_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_NEWTON_CLOSEST_ROTATION_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/internal/rotation/Newton_rotation_kernel.h>
#include <CGAL/ARAP_deformation/internal/simd/Double8.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {

CGAL_ARAP_INLINE_FUNCTION
void Newton_closest_rotation::operator()(std::size_t n, const Matrix_3x3* covariances,
                                         Matrix_3x3* rotations) const
{
  using Kernel = internal::Newton_rotation_kernel<internal::Double8>;
  using Plain_kernel = internal::Newton_rotation_kernel<internal::Double4>; // compiles faster
  internal::run_kernel<Kernel, Plain_kernel>(n, covariances, rotations);
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_NEWTON_CLOSEST_ROTATION_IMPL_H
