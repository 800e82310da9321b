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
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_substitution.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Unshared_ptr.h>
#include <CGAL/ARAP_deformation/internal/cholesky/fill_reducing_order.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationSolvers
/// \brief the factorization of `Multifrontal_cholesky_solver`, of which the factor is stored, and
/// substituted with, in single precision: for large regions, half the memory of the factor.
///
/// The minimizers do not depend on the accuracy of solutions: what they solve for is the next step,
/// from the forces at the present positions, which are computed in double precision. So they go to
/// the same minimum; an iterate of `Minimizer::local_global` is that of other solvers to the
/// accuracy of a solution. Its relative error is about \f$10^{-7}\f$ times the square root of the
/// condition number of the matrix in the norm of the energy, and up to that number itself in
/// others: ask `check_sparse_solver()` for residuals of at most 0.02, and not for rounding errors.
///
/// Where the matrix is conditioned so badly that the steps would suffer, or its entries are out of
/// the range of the numbers, the factor is computed once more, and kept in double precision
/// instead: `factorize()` refines the solution for a random right-hand side three times, and asks
/// that each correction is at most a tenth of the one before, measured by the energy.
///
/// There are no borders: each change of the control vertices needs another factorization.
///
/// A copy has the same ordering and nothing analyzed; a move keeps the factor.
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

  /// computes the ordering and the pattern of the factor, which depend on the pattern of `a` only.
  bool analyze(const Sparse_matrix& a)
  {
    m_state.reset(); // its memory is of use
    m_state = std::make_unique<State>(a, m_ordering);
    return true;
  }

  /// computes the factor; `a` has the pattern of the last `analyze()`. Returns `false`, after a
  /// second attempt in double precision, if `a` is not positive definite.
  bool factorize(const Sparse_matrix& a)
  {
    State& state = *m_state;
    state.double_factor = {};
    if(state.single_factor.compute(state.cholesky, a) && is_accurate(a))
      return true;
    state.single_factor = {};
    return state.double_factor.compute(state.cholesky, a);
  }

  /// returns whether the factor is in single precision, and `false` if there is none.
  bool is_single_precision() const { return m_state && m_state->single_factor.values; }

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
    const double largest = largest_entry(n, x);
    m_state->single_factor.solve(m_state->cholesky.structure(), x,
                                 largest > 1e-300 && std::isfinite(largest) ? largest : 1);
    return true;
  }

  /// returns the size of the factor, its indices included. Each solution reads it twice.
  /// \pre A matrix was analyzed.
  std::size_t factor_bytes() const
  {
    return m_state->cholesky.structure().number_of_bytes(is_single_precision() ? sizeof(float)
                                                                               : sizeof(double));
  }

private:
  template <typename Number>
  struct Factor
  {
    // has no values if it fails
    bool compute(const internal::Supernodal_cholesky& cholesky, const Sparse_matrix& a)
    {
      std::unique_ptr<Number[]> computed = std::move(values);
      if(!cholesky.factorize(a, computed))
        return false;
      values = std::move(computed);
      return true;
    }

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

  static double largest_entry(std::size_t n, const Coordinates* x)
  {
    std::vector<double> largest(n / internal::default_block_size + 1, 0);
    internal::for_each_block(n, [&](std::size_t begin, std::size_t end) {
      double most = 0;
      for(std::size_t v = begin; v < end; ++v)
        for(double entry : x[v])
          most = (std::max)(most, std::abs(entry));
      largest[begin / internal::default_block_size] = most;
    });
    return *std::max_element(largest.begin(), largest.end());
  }

  // Refining the solution for a random right-hand side is a power iteration: what is left over is
  // where the factor is worst, however little there was of it.
  bool is_accurate(const Sparse_matrix& a)
  {
    using Columns = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>;
    std::vector<Coordinates> residual_rows(static_cast<std::size_t>(a.rows())), step_rows;
    Columns residual(residual_rows.data()->data(), a.rows(), 3);
    std::minstd_rand random(1);
    for(Coordinates& row : residual_rows)
      for(double& entry : row)
        entry = static_cast<double>(random()) / static_cast<double>(random.max()) - 0.5;
    double first = 0, last = 0;
    for(int k = 0; k < 4; ++k)
    {
      step_rows = residual_rows;
      solve(step_rows.size(), step_rows.data());
      const Columns step(step_rows.data()->data(), a.rows(), 3);
      const double energy = residual.cwiseProduct(step).sum();
      if(k == 0)
        first = energy;
      else if(!(energy <= 1e-2 * last + 1e-24 * first))
        return false;
      last = energy;
      residual.noalias() -= a.selfadjointView<Eigen::Lower>() * step;
    }
    return first > 0; // or it has left the range of the numbers
  }

  Fill_reducing_ordering m_ordering = Fill_reducing_ordering::minimum_degree;
  internal::Unshared_ptr<State> m_state;
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_SINGLE_PRECISION_CHOLESKY_SOLVER_H
