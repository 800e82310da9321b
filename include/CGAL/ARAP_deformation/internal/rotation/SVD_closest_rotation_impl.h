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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_SVD_CLOSEST_ROTATION_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_SVD_CLOSEST_ROTATION_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/internal/rotation/Svd_rotation.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {

CGAL_ARAP_INLINE_FUNCTION
void SVD_closest_rotation::operator()(std::size_t n, const Matrix_3x3* covariances,
                                      Matrix_3x3* rotations) const
{
  for(std::size_t k = 0; k < n; ++k)
    rotations[k] = internal::Svd_rotation::closest(covariances[k]);
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_SVD_CLOSEST_ROTATION_IMPL_H
