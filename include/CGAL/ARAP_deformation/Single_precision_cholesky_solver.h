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

#ifndef CGAL_ARAP_DEFORMATION_SINGLE_PRECISION_CHOLESKY_SOLVER_H
#define CGAL_ARAP_DEFORMATION_SINGLE_PRECISION_CHOLESKY_SOLVER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Fill_reducing_ordering.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Supernodal_cholesky.h>
#include <CGAL/ARAP_deformation/internal/Supernodal_substitution.h>
#include <CGAL/ARAP_deformation/internal/Unshared_ptr.h>
#include <CGAL/ARAP_deformation/internal/fill_reducing_order.h>
#include <CGAL/ARAP_deformation/internal/parallel.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationSolvers
/// \brief the factorization of `Multifrontal_cholesky_solver`, of which the factor is stored, and
/// substituted with, in single precision: for large regions, half the memory of the factor.
///
/// A solution has a relative error of about \f$10^{-7}\f$ times the condition number of the matrix.
/// The minimizers do not depend on it: what they solve for is the next step, from the forces at the
/// present positions, which are computed in double precision. So they go to the same minimum; an
/// iterate of `Minimizer::local_global` is that of other solvers to the accuracy of a solution.
///
/// Where the matrix is conditioned so badly that the steps would suffer, the factor is computed
/// once more, and kept in double precision instead: `factorize()` tries the factor on a random
/// right-hand side, and asks that one step of iterative refinement changes the solution by at most
/// a hundredth.
///
/// There are no borders: each change of the control vertices needs another factorization.
///
/// \cgalModels{ARAPSparseSolver}
class Single_precision_cholesky_solver
{
public:
  /// constructs a solver that has nothing analyzed.
  Single_precision_cholesky_solver() = default;

  /// constructs a solver that has nothing analyzed, and orders as told.
  explicit Single_precision_cholesky_solver(Fill_reducing_ordering ordering)
    : m_ordering(ordering)
  {}

  /// moves, with the factor.
  Single_precision_cholesky_solver(Single_precision_cholesky_solver&&) = default;

  /// moves, with the factor.
  Single_precision_cholesky_solver& operator=(Single_precision_cholesky_solver&&) = default;

  /// constructs a solver with the same ordering that has nothing analyzed: factors are not copied.
  Single_precision_cholesky_solver(const Single_precision_cholesky_solver&) = default;

  /// makes this a solver with the same ordering that has nothing analyzed: factors are not copied.
  Single_precision_cholesky_solver& operator=(const Single_precision_cholesky_solver&) = default;

  /// computes the ordering and the pattern of the factor, which depend on the pattern of `a` only.
  bool analyze(const Sparse_matrix& a)
  {
    m_state.reset(); // its memory is of use
    m_state = std::make_unique<State>(a, m_ordering);
    return true;
  }

  /// computes the factor; `a` has the pattern of the last `analyze()`. Returns `false` if `a` is
  /// not positive definite.
  bool factorize(const Sparse_matrix& a)
  {
    m_state->double_factor.values.reset();
    if(m_state->cholesky.factorize(a, m_state->single_factor.values) && is_accurate(a))
      return true;
    m_state->single_factor.values.reset();
    return m_state->cholesky.factorize(a, m_state->double_factor.values);
  }

  /// returns `false` if the last matrix was conditioned too badly for single precision.
  bool is_single_precision() const { return m_state->single_factor.values != nullptr; }

  /// replaces the `n` rows of `x` by the solution of \f$A X = x\f$, where `n` is the size of the
  /// factorized matrix. Time: two sweeps over the factor.
  bool solve(std::size_t n, Coordinates* x)
  {
    if(!is_single_precision())
    {
      m_state->double_factor.solve(m_state->cholesky.structure(), x, 1);
      return true;
    }
    // small and large right-hand sides would leave the range of the numbers
    const double norm = std::sqrt(squared_norm(n, x));
    m_state->single_factor.solve(m_state->cholesky.structure(), x,
                                 norm > 0 && std::isfinite(norm) ? norm : 1);
    return true;
  }

  /// returns the size of the factor, its indices included. Each solution reads it twice.
  std::size_t factor_bytes() const
  {
    return m_state->cholesky.structure().number_of_bytes(is_single_precision() ? sizeof(float)
                                                                               : sizeof(double));
  }

private:
  template <typename Number>
  struct Factor
  {
    // The right-hand side is divided by the scale meanwhile.
    void solve(const internal::Supernodal_structure& structure, Coordinates* x, double scale)
    {
      substitution.forward(structure, values.get(), x, 1 / scale);
      substitution.backward(structure, values.get(), x, scale);
    }

    std::unique_ptr<Number[]> values;
    internal::Supernodal_substitution<Number> substitution;
  };

  struct State
  {
    State(const Sparse_matrix& a, Fill_reducing_ordering ordering)
      : cholesky(a, internal::fill_reducing_order(a, ordering))
    {}

    internal::Supernodal_cholesky cholesky;
    Factor<float> single_factor;
    Factor<double> double_factor; // at most one of them has values
  };

  static double squared_norm(std::size_t n, const Coordinates* x)
  {
    return internal::sum_over_blocks(n, [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      for(std::size_t v = begin; v < end; ++v)
        sum += internal::dot(x[v], x[v]);
      return sum;
    });
  }

  // In the solution for a random right-hand side those modes prevail for which the factor is worst.
  bool is_accurate(const Sparse_matrix& a)
  {
    using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
    const std::size_t n = static_cast<std::size_t>(a.rows());
    std::minstd_rand random(1);
    std::vector<Coordinates> b(n), x;
    for(Coordinates& row : b)
      for(double& entry : row)
        entry = static_cast<double>(random()) / static_cast<double>(random.max()) - 0.5;
    x = b;
    solve(n, x.data());
    Eigen::Map<Columns>(b.data()->data(), a.rows(), 3) -=
      a.selfadjointView<Eigen::Lower>() * Eigen::Map<Columns>(x.data()->data(), a.rows(), 3);
    solve(n, b.data());
    return squared_norm(n, b.data()) < 1e-4 * squared_norm(n, x.data()); // which may have left the range
  }

  Fill_reducing_ordering m_ordering = Fill_reducing_ordering::minimum_degree;
  internal::Unshared_ptr<State> m_state;
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_SINGLE_PRECISION_CHOLESKY_SOLVER_H
