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

// Weights, solver and rotation fitting chosen at run time, so that a single instantiation of the
// deformation suffices.

#include "Command_line.h"

#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#ifdef CGAL_LINKED_WITH_CHOLMOD
#include <CGAL/ARAP_deformation/Cholmod_solver.h>
#endif

#include <array>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <variant>

namespace CGAL::ARAP::demo {

// edge weights chosen at run time, so that a single instantiation of the deformation suffices
class Chosen_weight
{
public:
  explicit Chosen_weight(Weight_choice choice)
  {
    switch(choice)
    {
    case Weight_choice::safe_cotangent: break;
    case Weight_choice::cotangent: m_weight = Cotangent_weight(); break;
    case Weight_choice::clamped_cotangent: m_weight = Clamped_cotangent_weight(); break;
    case Weight_choice::uniform: m_weight = Uniform_weight(); break;
    }
  }

  template <std::size_t N>
  auto simplex_weights(const std::array<Coordinates, N>& simplex) const
  {
    return std::visit([&](const auto& w) { return w.simplex_weights(simplex); }, m_weight);
  }

  double edge_weight(Edge_set edge_set, std::size_t i, std::size_t j, double sum) const
  {
    return std::visit([&](const auto& w) { return w.edge_weight(edge_set, i, j, sum); }, m_weight);
  }

private:
  std::variant<Safe_cotangent_weight, Cotangent_weight,
               Clamped_cotangent_weight, Uniform_weight> m_weight;
};

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
