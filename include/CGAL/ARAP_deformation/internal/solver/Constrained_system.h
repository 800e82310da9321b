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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_CONSTRAINED_SYSTEM_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_CONSTRAINED_SYSTEM_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Quasidefinite_factor.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/region/Diagnosis.h>
#include <CGAL/ARAP_deformation/internal/solver/Hard_rows.h>
#include <CGAL/ARAP_deformation/internal/solver/Laplacian.h>
#include <CGAL/ARAP_deformation/internal/solver/Linear_solver.h>

#include <memory>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// The linear system of the global step, for all movable vertices of a region: its matrix is the
// Laplacian L with the rows B of the constraints and their weights M,
//   A = L + B^T M B,
// in which the rows and columns of fixed vertices are replaced by diagonal entries, and the
// right-hand side of a fixed vertex is zero. The first order and pattern are those of the free
// vertices, which makes the factor small. Where others are free later, and a border does not
// suffice, they become those of the region, whatever is fixed, and serve from then on.
//
// The factor serves for other constraints too, if they differ at few vertices: these become a
// border of the matrix A' of the factor,
//   [ A'   B ] [ x ]   [ f ]
//   [ B^T  D ] [ z ] = [ g ].
// A vertex that was free and is fixed is kept where it is by a multiplier, with a column of B that
// is a unit vector. One that was fixed and is free is a further unknown, whose column has its
// entries of A. One whose row of A differs, because of the rows of the constraints, is both.
//
// Hard rows are multipliers of the border, too. Where there is none, or it would be too large, they
// are eliminated: with S = B A^-1 B^T, a solution is  x = y - A^-1 B^T S^-1 B y,  y = A^-1 f.
class Constrained_system
{
public:
  explicit Constrained_system(std::unique_ptr<Linear_solver> prototype)
    : m_prototype(std::move(prototype))
  {}

  // The order is kept if the pattern is.
  void set_laplacian(Laplacian laplacian)
  {
    if(!has_pattern(laplacian.matrix, m_laplacian.matrix))
      m_solver.reset();
    m_laplacian = std::move(laplacian);
    m_has_factor = false;
  }

  const Laplacian& laplacian() const { return m_laplacian; }

  void release_factor()
  {
    m_solver.reset();
    m_has_factor = false;
  }

  // Makes the factor serve for these constraints. Returns what makes the system singular, if
  // anything: where only the solver finds that, there is no factor afterwards. Adds what it did:
  // the order, the factor, the border.
  Diagnosis prepare(const Constraints& constraints, Stages& stages);

  // Replaces the right-hand side x, one row for each movable vertex, zero where it is fixed, by the
  // solution, which has these values of the hard rows, or zero.
  bool solve(Array<Coordinates>& x, const Array<Coordinates>& values = {});

  // Moves the free vertices of x to where the hard rows have these values, the shortest way in the
  // metric of the matrix.
  bool meet(const Array<Coordinates>& values, Array<Coordinates>& x);

  // the Laplacian with such rows
  Sparse_matrix with_rows(const Weighted_rows& rows) const;

  const Hard_rows& hard_rows() const { return m_hard_rows; }

private:
  int find_singular_vertex(const Constraints& constraints) const;
  Constraints without_hard_rows(const Constraints& constraints) const;
  bool border_or_eliminate(const Constraints& constraints);
  bool set_border(const Constraints& constraints, bool are_hard_rows_bordered);
  bool eliminate_hard_rows();
  bool factorize(const Constraints& constraints, Stages& stages);
  bool solve_matrix(Array<Coordinates>& x, const Array<Coordinates>& values);

  Laplacian m_laplacian;
  std::unique_ptr<Linear_solver> m_prototype; // nothing is analyzed
  std::unique_ptr<Linear_solver> m_solver;    // has an order, if there is one
  bool m_has_factor = false;
  Constraints m_factorized;                   // the constraints of the factor, without hard rows
  // the vertices with entries beside the diagonal in the pattern that the solver knows; empty if it
  // serves only once
  Array<char> m_is_coupled;
  // the vertices whose unknowns are in the border, and those that it keeps where they are
  Array<int> m_further_unknowns, m_multipliers;
  Hard_rows m_hard_rows;
  bool m_are_hard_rows_bordered = false;
  Quasidefinite_factor m_eliminated; // of S, if they are not
  Array<Coordinates> m_bordered;     // scratch
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_CONSTRAINED_SYSTEM_H
