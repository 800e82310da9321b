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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_CHOSEN_MODELS_H
#define CGAL_ARAP_DEFORMATION_DEMO_CHOSEN_MODELS_H

// Solver and rotation fitting chosen at run time, so that a single instantiation of the
// deformation suffices.

#include "Command_line.h"

#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#ifdef CGAL_LINKED_WITH_CHOLMOD
#include <CGAL/ARAP_deformation/Cholmod_solver.h>
#endif

#include <cstddef>
#include <functional>
#include <type_traits>
#include <variant>

namespace CGAL::ARAP::demo {

class Chosen_solver
{
public:
  explicit Chosen_solver(Solver_choice choice)
  {
    switch(choice)
    {
    case Solver_choice::automatic: break;
    case Solver_choice::single_precision:
      m_solver = Multifrontal_cholesky_solver(Factor_precision::single_precision);
      break;
    case Solver_choice::eigen: m_solver = Eigen_LDLT_solver(); break;
#ifdef CGAL_LINKED_WITH_CHOLMOD
    case Solver_choice::cholmod: m_solver = Cholmod_solver(); break;
#endif
    }
  }

  bool analyze(const Sparse_matrix& a)
  {
    return std::visit([&](auto& solver) { return solver.analyze(a); }, m_solver);
  }

  bool factorize(const Sparse_matrix& a)
  {
    return std::visit([&](auto& solver) { return solver.factorize(a); }, m_solver);
  }

  bool solve(std::size_t n, Coordinates* x)
  {
    return std::visit([&](auto& solver) { return solver.solve(n, x); }, m_solver);
  }

  // those of others have no border that is not empty
  bool set_border(const Sparse_matrix& b, const Dense_matrix& d)
  {
    auto* solver = std::get_if<Multifrontal_cholesky_solver>(&m_solver);
    return solver ? solver->set_border(b, d) : b.cols() == 0;
  }

private:
  std::variant<Multifrontal_cholesky_solver, Eigen_LDLT_solver
#ifdef CGAL_LINKED_WITH_CHOLMOD
               , Cholmod_solver
#endif
               > m_solver;
};

using Chosen_rotation = std::function<void(std::size_t, const Matrix_3x3*, Matrix_3x3*)>;

inline Chosen_rotation chosen_rotation(Rotation_choice choice)
{
  if(choice == Rotation_choice::svd)
    return SVD_closest_rotation();
  return Newton_closest_rotation();
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_CHOSEN_MODELS_H
