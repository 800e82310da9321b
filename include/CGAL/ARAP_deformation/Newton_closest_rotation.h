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

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationRotations
/// \brief the rotation closest to a matrix, by Newton's method from the previous rotation, eight
/// matrices at a time where the processor has AVX2.
///
/// One step is exact up to rounding if the previous rotation is less than about a fiftieth of a
/// radian away; otherwise a second one follows. A Hessian of the trace of \f$R^T C\f$ that is
/// safely definite proves that the result is the closest rotation, for negative determinants too.
/// If four steps do not reach that, as for matrices of rank one, whose closest rotation is not
/// unique, or with infinite or NaN entries, the result is that of `SVD_closest_rotation`. A
/// previous matrix that is no rotation counts as the identity.
///
/// The results are as accurate as those of `SVD_closest_rotation`. With AVX2, which is detected at
/// run time, they take a twenty-fifth of its time if the rotations have changed little, and a
/// fifteenth otherwise.
///
/// The result for a matrix depends only on this matrix and its previous rotation, to the last bit,
/// and not on the other matrices, nor on how the arrays are divided into calls.
///
/// \cgalModels{ARAPClosestRotation}
class Newton_closest_rotation
{
public:
  /// computes `rotations[k]`, the rotation closest to `covariances[k]`, for `k` in `[0, n)`.
  void operator()(std::size_t n, const Matrix_3x3* covariances, Matrix_3x3* rotations) const;
};

} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/rotation/Newton_closest_rotation_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_NEWTON_CLOSEST_ROTATION_H
