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

#ifndef CGAL_ARAP_DEFORMATION_EIGEN_CHOLESKY_SOLVER_H
#define CGAL_ARAP_DEFORMATION_EIGEN_CHOLESKY_SOLVER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Unshared_ptr.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <Eigen/SparseCholesky>

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationSolvers
/// \brief Eigen's sparse Cholesky factorization \f$P A P^T = L L^T\f$ with the ordering AMD.
///
/// Eigen computes the factor; the substitution is our own: one sweep forth and one back over the
/// factor serve the three columns of the right-hand side together, where Eigen takes one of each
/// per column. One thread. `Multifrontal_cholesky_solver` is faster; this one is a library's.
///
/// A copy has nothing analyzed; a move keeps the factor.
///
/// \cgalModels{ARAPSparseSolver}
class Eigen_cholesky_solver
{
public:
  /// constructs a solver that has nothing analyzed.
  Eigen_cholesky_solver() = default;

  /// computes the ordering and the pattern of the factor, which depend on the pattern of `a` only.
  bool analyze(const Sparse_matrix& a)
  {
    m_cholesky = std::make_unique<Cholesky>();
    m_cholesky->analyzePattern(a);
    return m_cholesky->info() == Eigen::Success;
  }

  /// computes the factor; `a` has the pattern of the last `analyze()`. Returns `false` if `a` is
  /// not positive definite.
  bool factorize(const Sparse_matrix& a)
  {
    m_cholesky->factorize(a);
    if(m_cholesky->info() != Eigen::Success)
      return false;
    // Eigen lets pivots pass that are not numbers
    const auto& factor = m_cholesky->matrixL().nestedExpression();
    for(int j = 0; j < factor.cols(); ++j)
      if(!std::isfinite(factor.valuePtr()[factor.outerIndexPtr()[j]]))
        return false;
    return true;
  }

  /// replaces the `n` rows of `x` by the solution of \f$A X = x\f$, where `n` is the size of the
  /// factorized matrix. Time: two sweeps over the factor.
  bool solve(std::size_t n, Coordinates* x)
  {
    const auto& factor = m_cholesky->matrixL().nestedExpression();
    const int* begin = factor.outerIndexPtr();
    const int* row = factor.innerIndexPtr();
    const double* value = factor.valuePtr();
    const int* position = m_cholesky->permutationP().indices().data();

    m_permuted.resize(n);
    for(std::size_t k = 0; k < n; ++k)
      m_permuted[position[k]] = x[k];

    // the first entry of each column is the diagonal
    for(std::size_t j = 0; j < n; ++j)
    {
      const Coordinates y = internal::scaled(m_permuted[j], 1 / value[begin[j]]);
      m_permuted[j] = y;
      for(int k = begin[j] + 1; k < begin[j + 1]; ++k)
        internal::add(m_permuted[row[k]], -value[k], y);
    }
    for(std::size_t j = n; j-- > 0;)
    {
      Coordinates y = m_permuted[j];
      for(int k = begin[j] + 1; k < begin[j + 1]; ++k)
        internal::add(y, -value[k], m_permuted[row[k]]);
      m_permuted[j] = internal::scaled(y, 1 / value[begin[j]]);
    }

    for(std::size_t k = 0; k < n; ++k)
      x[k] = m_permuted[position[k]];
    return true;
  }

  /// returns the size of the factor, its indices included. Each solution reads it twice.
  std::size_t factor_bytes() const
  {
    const auto entries = m_cholesky->matrixL().nestedExpression().nonZeros();
    return static_cast<std::size_t>(entries) * (sizeof(double) + sizeof(int));
  }

private:
  using Cholesky = Eigen::SimplicialLLT<Sparse_matrix, Eigen::Lower>;

  internal::Unshared_ptr<Cholesky> m_cholesky; // Eigen's solvers cannot be moved, nor copied
  std::vector<Coordinates> m_permuted;
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_EIGEN_CHOLESKY_SOLVER_H
