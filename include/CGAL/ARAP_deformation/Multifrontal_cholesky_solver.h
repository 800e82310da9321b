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

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Fill_reducing_ordering.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Bordered_substitution.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Unshared_ptr.h>
#include <CGAL/ARAP_deformation/internal/cholesky/fill_reducing_order.h>

#include <Eigen/Core>

#include <cstddef>
#include <memory>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationSolvers
/// \brief a sparse Cholesky factorization \f$P A P^T = L L^T\f$ by the multifrontal method,
/// parallel over the subtrees of the elimination tree: the default.
///
/// Factorization and substitution go over the dense blocks of the factor, its supernodes. The three
/// columns of a right-hand side are solved for together. What can be done at the same time is,
/// where programs are linked with TBB, and the result is the same to the last bit for any number of
/// threads. The ordering is Eigen's, or that of METIS (see `Fill_reducing_ordering`).
///
/// A copy has the same ordering and nothing analyzed; a move keeps the factor.
///
/// \cgalModels{ARAPSparseSolver}
class Multifrontal_cholesky_solver
{
public:
  /// constructs a solver that has nothing analyzed.
  Multifrontal_cholesky_solver() = default;

  /// constructs a solver that has nothing analyzed, and orders as told.
  explicit Multifrontal_cholesky_solver(Fill_reducing_ordering ordering) : m_ordering(ordering) {}

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
    m_state->substitution.remove_border();
    return m_state->cholesky.factorize(a, m_state->values);
  }

  /// gives the matrix a border, or takes it away if `b` has no columns.
  ///
  /// What is solved from now on is the symmetric system
  /// \f[ \begin{pmatrix} A & B \\ B^T & D \end{pmatrix} \begin{pmatrix} x \\ z \end{pmatrix}
  /// = \begin{pmatrix} f \\ g \end{pmatrix}, \f] without another factorization of \f$A\f$.
  /// Time: for each column of `b` the part of the factor that the elimination tree reaches from
  /// its entries.
  /// \param b the columns of the border, as many rows as \f$A\f$; all entries are stored
  /// \param d a symmetric matrix, of which the lower triangle is read
  /// \return `false` if the bordered matrix cannot be solved safely, or has more negative
  /// eigenvalues than `d` has zeros on its diagonal; there is no border then.
  bool set_border(const Sparse_matrix& b, const Eigen::MatrixXd& d)
  {
    return m_state->substitution.set_border(m_state->cholesky.structure(), m_state->values.get(), b,
                                            d);
  }

  /// replaces the `n` rows of `x` by the solution of \f$A X = x\f$, where `n` is the size of the
  /// factorized matrix, its border included. Time: two sweeps over the factor.
  bool solve(std::size_t n, Coordinates* x)
  {
    m_state->substitution.solve(m_state->cholesky.structure(), m_state->values.get(), n, x);
    return true;
  }

  /// returns the size of the factor, its indices included. Each solution reads it twice.
  /// \pre A matrix was analyzed.
  std::size_t factor_bytes() const { return m_state->cholesky.structure().number_of_bytes(); }

private:
  struct State
  {
    State(const Sparse_matrix& a, Fill_reducing_ordering ordering)
      : cholesky(a, internal::fill_reducing_order(a, ordering))
    {}

    internal::Supernodal_cholesky cholesky;
    std::unique_ptr<double[]> values;
    internal::Bordered_substitution substitution;
  };

  Fill_reducing_ordering m_ordering = Fill_reducing_ordering::minimum_degree;
  internal::Unshared_ptr<State> m_state;
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_MULTIFRONTAL_CHOLESKY_SOLVER_H
