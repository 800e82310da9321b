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

#ifndef CGAL_ARAP_DEFORMATION_EIGEN_SPARSE_SOLVER_H
#define CGAL_ARAP_DEFORMATION_EIGEN_SPARSE_SOLVER_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Unshared_ptr.h>
#include <CGAL/ARAP_deformation/internal/cholesky/may_be_positive_definite.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>

namespace Eigen {
template <typename Matrix, typename Ordering>
class SparseLU;
template <typename Matrix, typename Ordering>
class SparseQR;
} // namespace Eigen

namespace CGAL {
namespace ARAP {

namespace internal {

// an Eigen solver that counts iterations is iterative
template <typename EigenSolver, typename = void>
constexpr bool is_iterative = false;
template <typename EigenSolver>
constexpr bool
  is_iterative<EigenSolver, std::void_t<decltype(std::declval<EigenSolver>().iterations())>> = true;

// the pivots of Eigen's factorizations L D L^T
template <typename EigenSolver, typename = void>
constexpr bool has_pivots = false;
template <typename EigenSolver>
constexpr bool
  has_pivots<EigenSolver, std::void_t<decltype(std::declval<EigenSolver>().vectorD())>> = true;

// whether an ordering or a preconditioner is content with one triangle of a symmetric matrix
template <typename Part, typename = void>
constexpr bool is_for_triangle = false;
template <typename Part> // orderings, and Eigen::IncompleteCholesky
constexpr bool is_for_triangle<Part, std::void_t<typename Part::PermutationType>> = true;
template <typename Scalar>
constexpr bool is_for_triangle<Eigen::DiagonalPreconditioner<Scalar>> = true;
template <>
inline constexpr bool is_for_triangle<Eigen::IdentityPreconditioner> = true;

// Eigen's solvers for symmetric matrices have the triangle that they read as second argument.
template <typename EigenSolver>
constexpr bool reads_lower_triangle_only = false;
template <template <typename, int, typename...> class EigenSolver, typename Matrix,
          typename... Parts>
constexpr bool reads_lower_triangle_only<EigenSolver<Matrix, Eigen::Lower, Parts...>> =
  (is_for_triangle<Parts> && ...);

// These have no info() before they have a factor.
template <typename EigenSolver>
constexpr bool reports_analysis = true;
template <typename Matrix, typename Ordering>
constexpr bool reports_analysis<Eigen::SparseLU<Matrix, Ordering>> = false;
template <typename Matrix, typename Ordering>
constexpr bool reports_analysis<Eigen::SparseQR<Matrix, Ordering>> = false;

} // namespace internal

/// \ingroup PkgARAPDeformationSolvers
/// \brief any solver of Eigen that can solve for symmetric matrices, direct or iterative.
///
/// A solver that reads the lower triangle only, as `Eigen::SimplicialLLT<Sparse_matrix,
/// Eigen::Lower>`, gets the matrix as it is. All others, as `Eigen::SparseLU`, or those with a
/// preconditioner for general matrices, get a copy with both triangles. Solvers for general
/// matrices may factorize what is not positive definite.
///
/// A matrix is refused if an entry is not finite or one on the diagonal is not positive, if Eigen
/// reports a failure, and if there are pivots and one of them is not positive. An iterative solver
/// that does not reach its tolerance fails. If its tolerance is loose the deformation still
/// converges to the same shape: what is solved for are corrections. It may need more iterations.
///
/// A copy has the same preparation and nothing analyzed; a move keeps the factor.
///
/// \tparam EigenSolver a solver for a `Sparse_matrix` with the functions `analyzePattern()`,
///         `factorize()`, `solve()` and `info()` of Eigen's sparse solvers
///
/// \cgalModels{ARAPSparseSolver}
///
/// \sa `Eigen_LDLT_solver`
/// \sa `Eigen_conjugate_gradient_solver`
template <typename EigenSolver>
class Eigen_sparse_solver
{
public:
  /// Eigen's solver.
  using Eigen_solver = EigenSolver;

  /// constructs a solver that has nothing analyzed.
  Eigen_sparse_solver() = default;

  /// constructs a solver that has nothing analyzed, and calls `prepare` for each object of
  /// `EigenSolver` that it or a copy of it makes: to set a tolerance, for instance.
  explicit Eigen_sparse_solver(std::function<void(EigenSolver&)> prepare)
    : m_prepare(std::move(prepare))
  {}

  /// lets Eigen analyze the pattern of `a`.
  bool analyze(const Sparse_matrix& a)
  {
    m_state.emplace();
    if(m_prepare)
      m_prepare(m_state->solver);
    m_state->solver.analyzePattern(keep(a));
    if constexpr(internal::reports_analysis<EigenSolver>)
      return m_state->solver.info() == Eigen::Success;
    else
      return true;
  }

  /// factorizes `a`, or prepares an iteration. Returns `false` if `a` is refused.
  bool factorize(const Sparse_matrix& a)
  {
    if(!internal::may_be_positive_definite(a))
      return false;
    m_state->solver.factorize(keep(a));
    return m_state->solver.info() == Eigen::Success && has_positive_pivots(m_state->solver);
  }

  /// replaces the `n` rows of `x` by the solution of \f$A X = x\f$. Returns `false` if Eigen
  /// reports a failure, or if a number is not finite.
  bool solve(std::size_t n, Coordinates* x)
  {
    if(n == 0)
      return true;
    Eigen::Map<Row_major> rows(x->data(), static_cast<Eigen::Index>(n), 3);
    m_state->right_hand_side = rows;
    m_state->solution = m_state->solver.solve(m_state->right_hand_side);
    rows = m_state->solution;
    return m_state->solver.info() == Eigen::Success &&
           std::all_of(x, x + n, [](const Coordinates& p) { return internal::is_finite(p); });
  }

private:
  using Row_major = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  struct State
  {
    Sparse_matrix matrix; // as the solver reads it; iterative ones refer to it; outlives the solver
    EigenSolver solver;
    Columns right_hand_side, solution;
  };

  const Sparse_matrix& keep(const Sparse_matrix& a)
  {
    if constexpr(!internal::reads_lower_triangle_only<EigenSolver>)
      return m_state->matrix = a.selfadjointView<Eigen::Lower>();
    else if constexpr(internal::is_iterative<EigenSolver>)
      return m_state->matrix = a;
    else
      return a;
  }

  static bool has_positive_pivots(const EigenSolver& solver)
  {
    if constexpr(internal::has_pivots<EigenSolver>)
      return (solver.vectorD().array() > 0).all();
    else
      return true;
  }

  std::function<void(EigenSolver&)> m_prepare;
  internal::Unshared_ptr<State> m_state; // Eigen's solvers cannot be moved
};

/// \ingroup PkgARAPDeformationSolvers
/// \brief Eigen's factorization \f$P A P^T = L D L^T\f$ with the ordering AMD.
using Eigen_LDLT_solver = Eigen_sparse_solver<Eigen::SimplicialLDLT<Sparse_matrix, Eigen::Lower>>;

/// \ingroup PkgARAPDeformationSolvers
/// \brief Eigen's conjugate gradients with the diagonal as preconditioner.
///
/// Needs no memory for a factor. The tolerance of the relative residual is that of Eigen, the
/// machine precision, unless the solver is constructed with a function that sets another.
using Eigen_conjugate_gradient_solver =
  Eigen_sparse_solver<Eigen::ConjugateGradient<Sparse_matrix, Eigen::Lower>>;

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_EIGEN_SPARSE_SOLVER_H
