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

#ifndef CGAL_ARAP_DEFORMATION_CHOLMOD_SOLVER_H
#define CGAL_ARAP_DEFORMATION_CHOLMOD_SOLVER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>

#if __has_include(<cholmod.h>)
#include <cholmod.h>
#else
#include <suitesparse/cholmod.h>
#endif

#include <cstddef>
#include <memory>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationSolvers
/// \brief CHOLMOD's sparse Cholesky factorization: of supernodes where it pays, with the ordering
/// that CHOLMOD finds best.
///
/// Needs CHOLMOD, of SuiteSparse, and its library. It runs on the BLAS it is built with, whose
/// threads may make results differ in the last bits from run to run.
///
/// \cgalModels{ARAPSparseSolver}
class Cholmod_solver
{
public:
  /// constructs a solver that has nothing analyzed.
  Cholmod_solver() = default;

  /// moves, with the factor.
  Cholmod_solver(Cholmod_solver&&) = default;

  /// moves, with the factor.
  Cholmod_solver& operator=(Cholmod_solver&&) = default;

  /// constructs a solver that has nothing analyzed: factors are not copied.
  Cholmod_solver(const Cholmod_solver&) {}

  /// makes this a solver that has nothing analyzed: factors are not copied.
  Cholmod_solver& operator=(const Cholmod_solver&)
  {
    m_state.reset();
    return *this;
  }

  /// computes the ordering and the pattern of the factor, which depend on the pattern of `a` only.
  /// Returns `false` if memory runs out.
  bool analyze(const Sparse_matrix& a)
  {
    m_state = std::make_unique<State>();
    cholmod_sparse matrix = view(a);
    m_state->factor = cholmod_analyze(&matrix, &m_state->common);
    return m_state->factor != nullptr;
  }

  /// computes the factor; `a` has the pattern of the last `analyze()`. Returns `false` if `a` is
  /// not positive definite, or if memory runs out.
  bool factorize(const Sparse_matrix& a)
  {
    cholmod_sparse matrix = view(a);
    return cholmod_factorize(&matrix, m_state->factor, &m_state->common)
        && m_state->common.status == CHOLMOD_OK
        && cholmod_rcond(m_state->factor, &m_state->common) > 0; // 0 for pivots that are no numbers
  }

  /// replaces the `n` rows of `x` by the solution of \f$A X = x\f$, where `n` is the size of the
  /// factorized matrix. Returns `false` if memory runs out.
  bool solve(std::size_t n, Coordinates* x)
  {
    if(!m_state->reserve_right_hand_side(n))
      return false;
    double* right_hand_side = static_cast<double*>(m_state->right_hand_side->x);
    for(std::size_t k = 0; k < n; ++k)
      for(std::size_t c = 0; c < 3; ++c)
        right_hand_side[c * n + k] = x[k][c];
    if(!cholmod_solve2(CHOLMOD_A, m_state->factor, m_state->right_hand_side, nullptr,
                       &m_state->solution, nullptr, &m_state->workspace[0], &m_state->workspace[1],
                       &m_state->common))
      return false;
    const double* solution = static_cast<const double*>(m_state->solution->x);
    for(std::size_t k = 0; k < n; ++k)
      for(std::size_t c = 0; c < 3; ++c)
        x[k][c] = solution[c * n + k];
    return true;
  }

private:
  // what CHOLMOD owns
  struct State
  {
    State()
    {
      cholmod_start(&common);
      common.print = 0;       // return values say all
      common.final_asis = 0;  // where there are no supernodes L L^T, which notices negative pivots
      common.final_ll = 1;
    }

    ~State()
    {
      cholmod_free_dense(&right_hand_side, &common);
      cholmod_free_dense(&solution, &common);
      cholmod_free_dense(&workspace[0], &common);
      cholmod_free_dense(&workspace[1], &common);
      cholmod_free_factor(&factor, &common);
      cholmod_finish(&common);
    }

    State(const State&) = delete;
    State& operator=(const State&) = delete;

    bool reserve_right_hand_side(std::size_t n)
    {
      if(right_hand_side == nullptr || right_hand_side->nrow != n)
      {
        cholmod_free_dense(&right_hand_side, &common);
        right_hand_side = cholmod_allocate_dense(n, 3, n, CHOLMOD_REAL, &common);
      }
      return right_hand_side != nullptr;
    }

    cholmod_common common;
    cholmod_factor* factor = nullptr;
    cholmod_dense* right_hand_side = nullptr;
    cholmod_dense* solution = nullptr;
    cholmod_dense* workspace[2] = {nullptr, nullptr};
  };

  // `a` as CHOLMOD sees it, which does not change it
  static cholmod_sparse view(const Sparse_matrix& a)
  {
    cholmod_sparse matrix = {};
    matrix.nrow = static_cast<std::size_t>(a.rows());
    matrix.ncol = static_cast<std::size_t>(a.cols());
    matrix.nzmax = static_cast<std::size_t>(a.nonZeros());
    matrix.p = const_cast<int*>(a.outerIndexPtr());
    matrix.i = const_cast<int*>(a.innerIndexPtr());
    matrix.x = const_cast<double*>(a.valuePtr());
    matrix.stype = -1; // the lower triangle
    matrix.itype = CHOLMOD_INT;
    matrix.xtype = CHOLMOD_REAL;
    matrix.dtype = CHOLMOD_DOUBLE;
    matrix.sorted = 1;
    matrix.packed = 1;
    return matrix;
  }

  std::unique_ptr<State> m_state;
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CHOLMOD_SOLVER_H
