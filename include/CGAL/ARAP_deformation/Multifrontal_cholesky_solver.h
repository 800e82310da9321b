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

#ifndef CGAL_ARAP_DEFORMATION_MULTIFRONTAL_CHOLESKY_SOLVER_H
#define CGAL_ARAP_DEFORMATION_MULTIFRONTAL_CHOLESKY_SOLVER_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Fill_reducing_ordering.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Unshared_ptr.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationSolvers
/// \brief The numbers in which `Multifrontal_cholesky_solver` stores a factor.
enum class Factor_precision
{
  /// Double precision. The default.
  double_precision,
  /// Single precision: half the memory, and faster iterations on large regions.
  single_precision
};

/// \ingroup PkgARAPDeformationSolvers
/// \brief a sparse Cholesky factorization \f$P A P^T = L L^T\f$ by the multifrontal method,
/// parallel over the subtrees of the elimination tree: the default \cgalCite{Liu1992Multifrontal}.
///
/// Factorization and substitution work on dense blocks of the factor, its supernodes, and solve for
/// the three columns of a right-hand side together. In programs that are linked with TBB they run
/// in parallel; the result is the same to the last bit for any number of threads.
///
/// ### Single Precision ###
///
/// The minimizers do not depend on the accuracy of solutions: they solve for the next step, from
/// the forces at the current positions, which are computed in double precision. So a factor in
/// single precision leads to the same minimum, and an iterate of `Minimizer::local_global` differs
/// from that of other solvers by the error of a solution. The relative error is about \f$10^{-7}\f$
/// times the square root of the condition number of the matrix in the norm of the energy, and up to
/// that number itself in other norms: with `check_sparse_solver()`, allow residuals of 0.02.
///
/// If the matrix is so ill-conditioned that the steps would suffer, or if an entry of its diagonal
/// is not between 1e-15 and 1e15, `factorize()` computes the factor in double precision instead. It
/// finds out the former by refining the solution for a random right-hand side three times: in the
/// norm of the energy, each correction must be at most a tenth of the one before.
///
/// A copy has the same ordering and precision, and nothing analyzed; a move keeps the factor.
///
/// \cgalModels{ARAPSparseSolver}
class Multifrontal_cholesky_solver
{
public:
  /// constructs a solver that has nothing analyzed, with the default ordering and precision.
  Multifrontal_cholesky_solver() = default;

  /// constructs a solver that has nothing analyzed.
  explicit Multifrontal_cholesky_solver(
    Fill_reducing_ordering ordering,
    Factor_precision precision = Factor_precision::double_precision)
    : m_ordering(ordering), m_precision(precision)
  {}

  /// constructs a solver with the default ordering that has nothing analyzed.
  explicit Multifrontal_cholesky_solver(Factor_precision precision)
    : Multifrontal_cholesky_solver(Fill_reducing_ordering::minimum_degree, precision)
  {}

  /// computes the ordering and the pattern of the factor, which depend on the pattern of `a` only.
  bool analyze(const Sparse_matrix& a);

  /// computes the factor; `a` has the pattern of the last `analyze()`. Returns `false` if `a` is
  /// not positive definite.
  bool factorize(const Sparse_matrix& a);

  /// gives the matrix a border, or removes it if `b` has no columns.
  ///
  /// `solve()` then solves the symmetric system
  /// \f[ \begin{pmatrix} A & B \\ B^T & D \end{pmatrix} \begin{pmatrix} x \\ z \end{pmatrix}
  /// = \begin{pmatrix} f \\ g \end{pmatrix}, \f] without another factorization of \f$A\f$. This
  /// takes the time of a forward substitution for each column of `b`, restricted to the part of the
  /// factor that the elimination tree reaches from the entries of the column.
  ///
  /// A row of the border is a multiplier if its diagonal entry in `d` is zero or negative: zero for
  /// a constraint, \f$-1/w\f$ for a penalty of weight \f$w\f$.
  /// \param b the columns of the border, with as many rows as \f$A\f$; all entries are stored
  /// \param d a symmetric matrix, of which the lower triangle is read
  /// \return `false` if the bordered system cannot be solved safely, or if the bordered matrix does
  /// not have exactly as many negative eigenvalues as there are multipliers; there is no border
  /// then.
  bool set_border(const Sparse_matrix& b, const Dense_matrix& d);

  /// replaces the `n` rows of `x` by the solution of \f$A X = x\f$, where `n` is the size of the
  /// factorized matrix, its border included. Time: two sweeps over the factor.
  bool solve(std::size_t n, Coordinates* x);

  /// returns whether the factor is in single precision; `false` if there is none.
  bool is_single_precision() const;

  /// returns the size of the factor, including its indices. Each solution reads it twice.
  /// \pre A matrix was analyzed.
  std::size_t factor_bytes() const;

private:
  struct State;

  Fill_reducing_ordering m_ordering = Fill_reducing_ordering::minimum_degree;
  Factor_precision m_precision = Factor_precision::double_precision;
  internal::Unshared_ptr<State> m_state;
};

} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/cholesky/Multifrontal_cholesky_solver_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_MULTIFRONTAL_CHOLESKY_SOLVER_H
