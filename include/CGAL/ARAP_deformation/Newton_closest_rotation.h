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

/// \ingroup PkgARAPDeformationRotations
/// \brief the rotation closest to a matrix, by Newton's method from the previous rotation, eight
/// matrices at a time.
///
/// One step has an error of the seventh or higher order in the angle from the previous rotation to
/// the result; a second one is made only where that is not enough, above about a hundredth of a
/// radian. A positive definite Hessian of the trace of \f$R^T C\f$ at the result proves that it is
/// the closest rotation. What is not settled so after four steps, such as matrices of rank one,
/// for which the closest rotation is not unique, gets the result of `SVD_closest_rotation`, as do
/// the previous rotations that are none get the identity in their place. The results are as exact
/// as those of `SVD_closest_rotation`.
///
/// With AVX2, for which processors are asked at run time, this is some twenty times faster than
/// `SVD_closest_rotation` where the rotations change by less than a hundredth of a radian, and ten
/// times from any other start.
///
/// The result for a matrix is a function of this matrix and its previous rotation, to the last bit:
/// it does not depend on the others, nor on how the arrays are cut into calls.
///
/// \cgalModels{ARAPClosestRotation_3}
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
