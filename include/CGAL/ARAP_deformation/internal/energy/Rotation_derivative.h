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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ROTATION_DERIVATIVE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ROTATION_DERIVATIVE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// How the closest rotation R follows a covariance S. Of the rotation exp(w) R the product with S
// is, to second order,  tr(R^T S) + a w - w K w / 2  with the axis a of the skew part of S R^T,
// which is zero for the closest one, and K = tr(Y) I - Y, Y the symmetric part. So a change dS, by
// which the axis becomes a(dS R^T), turns R by w = K^-1 a. Only the eigenvectors are Eigen's: its
// products of matrices would take half a second to compile.
class Rotation_derivative
{
public:
  Rotation_derivative() = default; // R does not follow

  Rotation_derivative(const Matrix_3x3& covariance, const Matrix_3x3& rotation)
  {
    const Matrix_3x3 m = product_with_transpose(covariance, rotation);
    Eigen::Matrix3d k;
    for(int r = 0; r < 3; ++r)
      for(int c = 0; c < 3; ++c)
        k(r, c) = (r == c ? m[0] + m[4] + m[8] : 0) -
                  0.5 * (m[static_cast<std::size_t>(3 * r + c)] +
                         m[static_cast<std::size_t>(3 * c + r)]);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(k);
    // Where it is next to zero another rotation is as close, and R jumps: the energy has a kink.
    const double largest = solver.eigenvalues()[2], least = 1e-6 * largest;
    for(int j = 0; j < 3 && largest > 0; ++j)
    {
      const auto vector = solver.eigenvectors().col(j);
      const Coordinates axis = {vector[0], vector[1], vector[2]};
      add_product(m_inverse, scaled(axis, 1 / (std::max)(solver.eigenvalues()[j], least)), axis);
    }
  }

  // the change of R that a change of the covariance makes
  Matrix_3x3 operator()(const Matrix_3x3& change, const Matrix_3x3& rotation) const
  {
    const Coordinates w =
      product(m_inverse, axial_vector(product_with_transpose(change, rotation)));
    Matrix_3x3 result;
    for(std::size_t c = 0; c < 3; ++c)
    {
      const Coordinates column = cross(w, {rotation[c], rotation[3 + c], rotation[6 + c]});
      for(std::size_t r = 0; r < 3; ++r)
        result[3 * r + c] = column[r];
    }
    return result;
  }

private:
  Matrix_3x3 m_inverse{}; // of K
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ROTATION_DERIVATIVE_H
