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
#include <CGAL/ARAP_deformation/Cholmod_solver.h>
#include <CGAL/ARAP_deformation/Petsc_solver.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <variant>

namespace CGAL::ARAP::demo {

// the processes of which the solver computes with several: one, unless it is PETSc's
class Chosen_processes
{
public:
#ifdef CGAL_LINKED_WITH_PETSC
  explicit Chosen_processes(Solver_choice choice)
  {
    if(choice == Solver_choice::petsc || choice == Solver_choice::petsc_cg)
      m_petsc.emplace();
  }

  // as Petsc_environment::serve()
  bool serve() const { return m_petsc && m_petsc->serve(); }

  const Petsc_environment& petsc() const { return *m_petsc; }

private:
  std::optional<Petsc_environment> m_petsc;
#else
  explicit Chosen_processes(Solver_choice) {}
  bool serve() const { return false; }
#endif
};

class Chosen_solver
{
public:
  Chosen_solver(Solver_choice choice, [[maybe_unused]] const Chosen_processes& processes)
  {
    switch(choice)
    {
    case Solver_choice::single_precision:
      m_solver = Multifrontal_cholesky_solver(Factor_precision::single_precision);
      break;
    case Solver_choice::eigen: m_solver = Eigen_LDLT_solver(); break;
#ifdef CGAL_LINKED_WITH_CHOLMOD
    case Solver_choice::cholmod: m_solver = Cholmod_solver(); break;
#endif
#ifdef CGAL_LINKED_WITH_PETSC
    case Solver_choice::petsc: m_solver = Petsc_solver(processes.petsc()); break;
    case Solver_choice::petsc_cg:
      m_solver = Petsc_solver(processes.petsc(), Petsc_method::conjugate_gradients);
      break;
#endif
    default: break; // automatic: what it is constructed as
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

  // those of Eigen and PETSc have no border that is not empty
  bool set_border(const Sparse_matrix& b, const Dense_matrix& d)
  {
#ifdef CGAL_LINKED_WITH_CHOLMOD
    if(auto* solver = std::get_if<Cholmod_solver>(&m_solver))
      return solver->set_border(b, d);
#endif
    auto* solver = std::get_if<Multifrontal_cholesky_solver>(&m_solver);
    return solver ? solver->set_border(b, d) : b.cols() == 0;
  }

private:
  std::variant<Multifrontal_cholesky_solver, Eigen_LDLT_solver
#ifdef CGAL_LINKED_WITH_CHOLMOD
               , Cholmod_solver
#endif
#ifdef CGAL_LINKED_WITH_PETSC
               , Petsc_solver
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
