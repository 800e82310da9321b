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

#ifndef CGAL_ARAP_DEFORMATION_TEST_ROWS_H
#define CGAL_ARAP_DEFORMATION_TEST_ROWS_H

// Right-hand sides and solutions of three columns, row by row.

#include <CGAL/ARAP_deformation/flat_types.h>

#include <Eigen/Core>

#include <cstddef>
#include <random>
#include <vector>

using Rows = std::vector<CGAL::ARAP::Coordinates>;
using Row_major = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

// the largest magnitude of its entries, or what is not a number if one of them is
template <typename Matrix>
double largest_entry(const Matrix& m)
{
  return m.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
}

// others with each call, from -size to size
inline Rows random_rows(std::size_t n, double size = 1)
{
  static std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-size, size);
  Rows rows(n);
  for(CGAL::ARAP::Coordinates& row : rows)
    for(double& entry : row)
      entry = number(random);
  return rows;
}

// the same as a matrix, without a copy
inline Eigen::Map<const Row_major> as_matrix(const Rows& rows)
{
  return {rows.data()->data(), static_cast<Eigen::Index>(rows.size()), 3};
}

inline Eigen::Map<Row_major> as_matrix(Rows& rows)
{
  return {rows.data()->data(), static_cast<Eigen::Index>(rows.size()), 3};
}

#endif // CGAL_ARAP_DEFORMATION_TEST_ROWS_H
