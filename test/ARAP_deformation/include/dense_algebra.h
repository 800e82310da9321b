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

#ifndef CGAL_ARAP_DEFORMATION_TEST_DENSE_ALGEBRA_H
#define CGAL_ARAP_DEFORMATION_TEST_DENSE_ALGEBRA_H

// Factorizations of Eigen, each of which takes seconds to compile: once, in dense_algebra.cpp.

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/OrderingMethods>
#include <Eigen/SVD>
#include <Eigen/SparseLU>

using Matrix_of_long_doubles = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

// x with a x = b, by Gaussian elimination
Eigen::MatrixXd dense_solution(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// whether a is far from singular
bool is_invertible(const Eigen::MatrixXd& a);

// whether a symmetric matrix is
bool is_positive_definite(const Eigen::MatrixXd& a);

// x with the smallest || a x - b ||, column by column
Matrix_of_long_doubles least_squares(const Matrix_of_long_doubles& a,
                                     const Matrix_of_long_doubles& b);

// those of the package and of CGAL's class
extern template class Eigen::JacobiSVD<Eigen::Matrix3d>;
extern template class Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
extern template class Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>>;

#endif // CGAL_ARAP_DEFORMATION_TEST_DENSE_ALGEBRA_H
