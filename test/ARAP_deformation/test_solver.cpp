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

// The solver: three columns at once, against a dense solution; refusal of what is not positive
// definite; one analysis for several matrices of one pattern.

#include "include/check.h"

#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

using CGAL::ARAP::Coordinates;
using CGAL::ARAP::Sparse_matrix;

std::mt19937 random_engine(5);
std::uniform_real_distribution<double> entry(-1, 1);

// the Laplacian of a grid graph with random weights, plus `shift` times the identity
Sparse_matrix grid_laplacian(int side, double shift)
{
  std::vector<Eigen::Triplet<double>> entries;
  const auto connect = [&](int i, int j) {
    const double w = 1.5 + entry(random_engine);
    entries.emplace_back(i, i, w);
    entries.emplace_back(j, j, w);
    entries.emplace_back((std::max)(i, j), (std::min)(i, j), -w);
  };
  for(int i = 0; i < side; ++i)
    for(int j = 0; j < side; ++j)
    {
      if(i + 1 < side) connect(i * side + j, (i + 1) * side + j);
      if(j + 1 < side) connect(i * side + j, i * side + j + 1);
    }
  for(int i = 0; i < side * side; ++i)
    entries.emplace_back(i, i, shift);
  Sparse_matrix a(side * side, side * side);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

void check_solution(CGAL::ARAP::Multifrontal_cholesky_solver& solver, const Sparse_matrix& a)
{
  const auto n = std::size_t(a.rows());
  Eigen::MatrixXd b =
    Eigen::MatrixXd::NullaryExpr(a.rows(), 3, [] { return entry(random_engine); });
  std::vector<Coordinates> x(n);
  for(std::size_t k = 0; k < n; ++k)
    x[k] = {b(k, 0), b(k, 1), b(k, 2)};
  CHECK(solver.solve(n, x.data()));
  const Eigen::MatrixXd expected =
    Eigen::MatrixXd(a).selfadjointView<Eigen::Lower>().ldlt().solve(b);
  double error = 0;
  for(std::size_t k = 0; k < n; ++k)
    for(int c = 0; c < 3; ++c)
      error = larger(error, std::abs(x[k][c] - expected(k, c)));
  CHECK_AT_MOST(error, 1e-10 * expected.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
}

int main()
{
  CGAL::ARAP::Multifrontal_cholesky_solver solver;
  for(int side : {1, 2, 5, 17})
  {
    const Sparse_matrix a = grid_laplacian(side, 0.01), same_pattern = grid_laplacian(side, 0.5);
    CHECK(solver.analyze(a));
    CHECK(solver.factorize(a));
    check_solution(solver, a);
    check_solution(solver, a);
    CHECK(solver.factorize(same_pattern));
    check_solution(solver, same_pattern);

    // has no factor, and leaves this one alone
    const CGAL::ARAP::Multifrontal_cholesky_solver copy(solver);
    CGAL::ARAP::Multifrontal_cholesky_solver moved(std::move(solver));
    check_solution(moved, same_pattern);
    solver = CGAL::ARAP::Multifrontal_cholesky_solver(copy);

    CHECK(moved.analyze(a));
    CHECK(!moved.factorize(grid_laplacian(side, -1)));
    CHECK(moved.factorize(a)); // a failure is not the end
    check_solution(moved, a);
  }
  return checks_result();
}
