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

#ifndef CGAL_ARAP_DEFORMATION_SVD_CLOSEST_ROTATION_H
#define CGAL_ARAP_DEFORMATION_SVD_CLOSEST_ROTATION_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationRotations
/// \brief the rotation closest to a matrix, by its singular value decomposition.
///
/// With \f$C = U \Sigma V^T\f$ the closest rotation is \f$U V^T\f$, where the sign of the column of
/// \f$U\f$ with the smallest singular value is such that the determinant is \f$+1\f$ (Equation (6)
/// of \cgalCite{Sorkine2007AsRigidAs}, whose \f$S\f$ is \f$C^T\f$). The decomposition is computed
/// by one-sided Jacobi rotations, which are accurate for small singular values too. Where the
/// closest rotation is not unique the choice is fixed: for a matrix of rank one the smallest
/// rotation among the closest ones, for the zero matrix the identity. A matrix
/// with an infinite or NaN entry counts as the zero matrix.
///
/// \cgalModels{ARAPClosestRotation}
class SVD_closest_rotation
{
public:
  /// computes `rotations[k]`, the rotation closest to `covariances[k]`, for `k` in `[0, n)`.
  void operator()(std::size_t n, const Matrix_3x3* covariances, Matrix_3x3* rotations) const;
};

} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/rotation/SVD_closest_rotation_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_SVD_CLOSEST_ROTATION_H
