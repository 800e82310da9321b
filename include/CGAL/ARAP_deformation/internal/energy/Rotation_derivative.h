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

#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// How the closest rotation R follows a covariance S. Of the rotation exp(w) R the product with S
// is, to second order,  tr(R^T S) + a w - w K w / 2  with the axis a of the skew part of S R^T,
// which is zero for the closest one, and K = tr(Y) I - Y, Y the symmetric part. So a change dS, by
// which the axis becomes a(dS R^T), turns R by w = K^-1 a.
class Rotation_derivative
{
public:
  Rotation_derivative() = default; // R does not follow

  Rotation_derivative(const Matrix_3x3& covariance, const Matrix_3x3& rotation)
  {
    const Matrix m = map(covariance) * map(rotation).transpose();
    const Matrix y = 0.5 * (m + m.transpose());
    Eigen::SelfAdjointEigenSolver<Matrix> solver;
    solver.computeDirect(y.trace() * Matrix::Identity() - y);
    // Where it is next to zero another rotation is as close, and R jumps: the energy has a kink.
    const double largest = solver.eigenvalues()[2], least = 1e-6 * largest;
    if(largest > 0)
      m_inverse = solver.eigenvectors() *
                  solver.eigenvalues().cwiseMax(least).cwiseInverse().asDiagonal() *
                  solver.eigenvectors().transpose();
  }

  // the change of R that a change of the covariance makes
  Matrix_3x3 operator()(const Matrix_3x3& change, const Matrix_3x3& rotation) const
  {
    const Matrix m = map(change) * map(rotation).transpose();
    const Eigen::Vector3d axis(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
    const Eigen::Vector3d w = m_inverse * axis;
    Matrix_3x3 result;
    for(std::size_t c = 0; c < 3; ++c)
    {
      const Coordinates column = cross({w[0], w[1], w[2]},
                                       {rotation[c], rotation[3 + c], rotation[6 + c]});
      for(std::size_t r = 0; r < 3; ++r)
        result[3 * r + c] = column[r];
    }
    return result;
  }

private:
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

  static Eigen::Map<const Matrix> map(const Matrix_3x3& m)
  {
    return Eigen::Map<const Matrix>(m.data());
  }

  Matrix m_inverse = Matrix::Zero(); // of K
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ROTATION_DERIVATIVE_H
