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

#include "include/compiled_solvers.h"

#include <CGAL/ARAP_deformation/Cholmod_solver.h>
#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>

#include <memory>

namespace {

template <typename Solver>
auto compiled(const Solver& solver = Solver())
{
  return std::make_unique<CGAL::ARAP::internal::Linear_solver_of<Solver>>(solver);
}

} // namespace

Compiled_LDLT_solver::Compiled_LDLT_solver()
  : Compiled_solver(compiled<CGAL::ARAP::Eigen_LDLT_solver>())
{}

Compiled_conjugate_gradients::Compiled_conjugate_gradients(double tolerance)
  : Compiled_solver(compiled(CGAL::ARAP::Eigen_conjugate_gradient_solver(
      [tolerance](auto& gradients) { gradients.setTolerance(tolerance); })))
{}

#ifdef CGAL_LINKED_WITH_CHOLMOD
Compiled_cholmod_solver::Compiled_cholmod_solver()
  : Compiled_solver(compiled<CGAL::ARAP::Cholmod_solver>())
{}
#endif
