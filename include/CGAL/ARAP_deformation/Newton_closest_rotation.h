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
#include <CGAL/ARAP_deformation/internal/rotation/Newton_rotation_kernel.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationRotations
/// \brief the rotation closest to a matrix, by Newton's method from the previous rotation, eight
/// matrices at a time where the processor has AVX2.
///
/// One step is exact up to rounding where the previous rotation is less than about a fiftieth of a
/// radian away, and a second one otherwise. That the Hessian of the trace of \f$R^T C\f$ is safely
/// definite proves that the result is the closest rotation, for negative determinants too. Where
/// four steps do not lead to that, as for matrices of rank one, whose closest rotation is not
/// unique, the result is that of `SVD_closest_rotation`. A previous matrix that is no rotation is
/// taken for the identity.
///
/// The results are as exact as those of `SVD_closest_rotation`. Where the processor has AVX2, which
/// is found out at run time, they come some 25 times faster if the rotations have changed little,
/// and ten times faster from any others.
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
    using Kernel = internal::Newton_rotation_kernel<internal::Double8>;
    using Plain_kernel = internal::Newton_rotation_kernel<internal::Double4>; // compiles faster
    internal::run_kernel<Kernel, Plain_kernel>(n, covariances, rotations);
  }
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_NEWTON_CLOSEST_ROTATION_H
