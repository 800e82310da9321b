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

#ifndef CGAL_ARAP_DEFORMATION_SPARSE_LINEAR_ALGEBRA_ADAPTOR_H
#define CGAL_ARAP_DEFORMATION_SPARSE_LINEAR_ALGEBRA_ADAPTOR_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Unshared_ptr.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationSolvers
/// \brief makes a solver of any model of CGAL's concept `SparseLinearAlgebraWithFactorTraits_d`,
/// as it is.
///
/// That concept has no separate analysis and one column for each call: a factorization costs the
/// ordering again, and each solution three calls. The matrix has both triangles, so that solvers
/// for general matrices such as `Eigen::SparseLU` work too. It depends on the model whether a
/// matrix that is not positive definite is detected.
///
/// A copy has the same preparation and nothing factorized; a move keeps the factor.
///
/// \tparam SparseLinearAlgebra a model of `SparseLinearAlgebraWithFactorTraits_d`, for example
///         `CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>`. It need
///         be neither copied nor moved.
///
/// \cgalModels{ARAPSparseSolver}
template <typename SparseLinearAlgebra>
class Sparse_linear_algebra_adaptor
{
public:
  /// the type of the solver that is adapted.
  using Sparse_linear_algebra = SparseLinearAlgebra;

  /// constructs a solver that has nothing factorized.
  Sparse_linear_algebra_adaptor() = default;

  /// constructs a solver that has nothing factorized, and calls `prepare` for each object of
  /// `SparseLinearAlgebra` that it or a copy of it makes: to set a tolerance, for instance.
  explicit Sparse_linear_algebra_adaptor(std::function<void(SparseLinearAlgebra&)> prepare)
    : m_prepare(std::move(prepare))
  {}

  /// makes an object of `SparseLinearAlgebra`; all else is left to `factorize()`.
  bool analyze(const Sparse_matrix&)
  {
    m_state.emplace();
    if(m_prepare)
      m_prepare(m_state->solver);
    return true;
  }

  /// factorizes `a`. Returns `false` if the solver does.
  bool factorize(const Sparse_matrix& a)
  {
    // some models refer to the matrix while they solve: it is kept until the next is factorized
    auto matrix = std::make_unique<Matrix>(static_cast<int>(a.rows()));
    for(int k = 0; k < a.outerSize(); ++k)
      for(Sparse_matrix::InnerIterator entry(a, k); entry; ++entry)
      {
        const auto row = static_cast<std::size_t>(entry.row());
        const auto column = static_cast<std::size_t>(entry.col());
        const NT value = static_cast<NT>(entry.value());
        matrix->set_coef(row, column, value, true);
        if(row != column)
          matrix->set_coef(column, row, value, true);
      }
    const bool is_factorized = m_state->solver.factor(*matrix, m_state->denominator);
    m_state->matrix = std::move(matrix);
    return is_factorized;
  }

  /// replaces the `n` rows of `x` by the solution of \f$A X = x\f$, one column after the other.
  /// Returns `false` if the solver does, or if a number is not finite.
  bool solve(std::size_t n, Coordinates* x)
  {
    Vector right_hand_side(n), solution(n);
    for(std::size_t c = 0; c < 3; ++c)
    {
      for(std::size_t k = 0; k < n; ++k)
      {
        right_hand_side[static_cast<int>(k)] = static_cast<NT>(x[k][c]);
        solution[static_cast<int>(k)] = NT(0);
      }
      if(!m_state->solver.linear_solver(right_hand_side, solution))
        return false;
      for(std::size_t k = 0; k < n; ++k)
      {
        x[k][c] = static_cast<double>(solution[static_cast<int>(k)] / m_state->denominator);
        if(!internal::is_finite(x[k][c]))
          return false;
      }
    }
    return true;
  }

private:
  using NT = typename SparseLinearAlgebra::NT;
  using Matrix = typename SparseLinearAlgebra::Matrix;
  using Vector = typename SparseLinearAlgebra::Vector;

  struct State
  {
    std::unique_ptr<Matrix> matrix; // outlives the solver
    SparseLinearAlgebra solver;
    NT denominator = NT(1); // of the solutions
  };

  std::function<void(SparseLinearAlgebra&)> m_prepare;
  internal::Unshared_ptr<State> m_state; // need not be movable itself
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_SPARSE_LINEAR_ALGEBRA_ADAPTOR_H
