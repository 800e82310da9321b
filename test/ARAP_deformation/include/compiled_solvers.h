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

#ifndef CGAL_ARAP_DEFORMATION_TEST_COMPILED_SOLVERS_H
#define CGAL_ARAP_DEFORMATION_TEST_COMPILED_SOLVERS_H

// Solvers of other libraries for tests of something else: what takes long to compile, and to run
// where it is not optimized, is linked with the tests.

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/solver/Linear_solver.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

class Compiled_solver
{
public:
  Compiled_solver(const Compiled_solver& other) : m_solver(other.m_solver->copy()) {}
  Compiled_solver(Compiled_solver&&) = default;
  Compiled_solver& operator=(Compiled_solver other)
  {
    m_solver = std::move(other.m_solver);
    return *this;
  }

  bool analyze(const CGAL::ARAP::Sparse_matrix& a) { return m_solver->analyze(a); }
  bool factorize(const CGAL::ARAP::Sparse_matrix& a) { return m_solver->factorize(a); }
  bool solve(std::size_t n, CGAL::ARAP::Coordinates* x) { return m_solver->solve(n, x); }

protected:
  using Any_solver = CGAL::ARAP::internal::Linear_solver;
  explicit Compiled_solver(std::unique_ptr<Any_solver> solver) : m_solver(std::move(solver)) {}
  std::unique_ptr<Any_solver> m_solver;
};

// CGAL::ARAP::Eigen_LDLT_solver
struct Compiled_LDLT_solver : Compiled_solver
{
  Compiled_LDLT_solver();
};

// CGAL::ARAP::Eigen_conjugate_gradient_solver
struct Compiled_conjugate_gradients : Compiled_solver
{
  explicit Compiled_conjugate_gradients(
    double tolerance = std::numeric_limits<double>::epsilon()); // Eigen's default
};

#ifdef CGAL_LINKED_WITH_CHOLMOD
// CGAL::ARAP::Cholmod_solver
struct Compiled_cholmod_solver : Compiled_solver
{
  Compiled_cholmod_solver();

  bool set_border(const CGAL::ARAP::Sparse_matrix& b, const CGAL::ARAP::Dense_matrix& d)
  {
    return m_solver->set_border(b, d);
  }
};
#endif

#endif // CGAL_ARAP_DEFORMATION_TEST_COMPILED_SOLVERS_H
