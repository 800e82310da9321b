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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_CLOSEST_ROTATIONS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_CLOSEST_ROTATIONS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>

#include <cstddef>
#include <functional>

namespace CGAL {
namespace ARAP {
namespace internal {

// Replaces n rotations by those closest to n covariances: a model of ARAPClosestRotation as the
// numeric core calls it, which is not a template.
using Closest_rotations =
  std::function<void(std::size_t n, const Matrix_3x3* covariances, Matrix_3x3* rotations)>;

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_CLOSEST_ROTATIONS_H
