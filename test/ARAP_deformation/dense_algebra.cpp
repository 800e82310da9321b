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

#include "include/dense_algebra.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

Eigen::MatrixXd dense_solution(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  return a.partialPivLu().solve(b);
}

bool is_invertible(const Eigen::MatrixXd& a)
{
  const Eigen::VectorXd pivots = a.partialPivLu().matrixLU().diagonal().cwiseAbs();
  return pivots.minCoeff() > 1e-14 * pivots.maxCoeff();
}

bool is_positive_definite(const Eigen::MatrixXd& a)
{
  return Eigen::LLT<Eigen::MatrixXd>(a).info() == Eigen::Success;
}

Matrix_of_long_doubles least_squares(const Matrix_of_long_doubles& a,
                                     const Matrix_of_long_doubles& b)
{
  return a.householderQr().solve(b);
}

template class Eigen::JacobiSVD<Eigen::Matrix3d>;
template class Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
template class Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>>;
