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

#ifndef CGAL_ARAP_DEFORMATION_FLAT_TYPES_H
#define CGAL_ARAP_DEFORMATION_FLAT_TYPES_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <Eigen/SparseCore>
#if !EIGEN_VERSION_AT_LEAST(3, 4, 0)
#error "CGAL/ARAP_deformation needs Eigen 3.4 or newer."
#endif
#endif

#include <array>

// Programs that are linked with the compiled core need Eigen only where they use its matrices.
namespace Eigen {
template <typename, int, int, int, int, int>
class Matrix;
template <typename, int, typename>
class SparseMatrix;
} // namespace Eigen

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationTypes
/// the %Cartesian coordinates \f$(x, y, z)\f$ of a point or vector.
using Coordinates = std::array<double, 3>;

/// \ingroup PkgARAPDeformationTypes
/// a 3 x 3 matrix in row-major order: entry \f$(r, c)\f$ is element `3 * r + c`.
using Matrix_3x3 = std::array<double, 9>;

/// \ingroup PkgARAPDeformationTypes
/// a symmetric sparse matrix: `Eigen::SparseMatrix<double>`. Only the lower triangle is stored, by
/// columns, with ascending rows.
using Sparse_matrix = Eigen::SparseMatrix<double, 0, int>;

/// \ingroup PkgARAPDeformationTypes
/// a dense matrix: `Eigen::MatrixXd`.
using Dense_matrix = Eigen::Matrix<double, -1, -1, 0, -1, -1>;

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_FLAT_TYPES_H
