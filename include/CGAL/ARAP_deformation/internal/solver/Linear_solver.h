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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_LINEAR_SOLVER_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_LINEAR_SOLVER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/solver/sparse_solver_requirements.h>

#include <cstddef>
#include <memory>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// A model of ARAPSparseSolver as the numeric core calls it, which is not a template.
class Linear_solver
{
public:
  virtual ~Linear_solver() = default;
  virtual std::unique_ptr<Linear_solver> copy() const = 0;
  virtual bool analyze(const Sparse_matrix& a) = 0;
  virtual bool factorize(const Sparse_matrix& a) = 0;
  virtual bool solve(std::size_t n, Coordinates* x) = 0;
  // false where the model has no borders
  virtual bool set_border(const Sparse_matrix& b, const Dense_matrix& d) = 0;
  virtual bool can_have_border() const = 0;
};

template <typename Solver>
class Linear_solver_of : public Linear_solver
{
public:
  explicit Linear_solver_of(const Solver& solver) : m_solver(solver) {}
  explicit Linear_solver_of(Solver&& solver) : m_solver(std::move(solver)) {}

  std::unique_ptr<Linear_solver> copy() const override
  {
    return std::make_unique<Linear_solver_of>(m_solver);
  }

  bool analyze(const Sparse_matrix& a) override { return m_solver.analyze(a); }
  bool factorize(const Sparse_matrix& a) override { return m_solver.factorize(a); }
  bool solve(std::size_t n, Coordinates* x) override { return m_solver.solve(n, x); }

  bool set_border(const Sparse_matrix& b, const Dense_matrix& d) override
  {
    if constexpr(internal::can_have_border<Solver>)
      return m_solver.set_border(b, d);
    else
      return false;
  }

  bool can_have_border() const override { return internal::can_have_border<Solver>; }

private:
  Solver m_solver;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_LINEAR_SOLVER_H
