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

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#if defined(CGAL_LINKED_WITH_CHOLMOD) || defined(DOXYGEN_RUNNING)

#include <CGAL/ARAP_deformation/Fill_reducing_ordering.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Bordered_substitution.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Unshared_ptr.h>
#include <CGAL/ARAP_deformation/internal/cholesky/packed_values.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>

#include <Eigen/Core>

#if __has_include(<cholmod.h>)
#include <cholmod.h>
#else
#include <suitesparse/cholmod.h>
#endif

#include <cstddef>
#include <new>
#include <stdexcept>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationSolvers
/// \brief CHOLMOD's supernodal Cholesky factorization.
///
/// CHOLMOD computes the factor; the substitution, and the order of its values in memory, are those
/// of `Multifrontal_cholesky_solver`.
///
/// Needs CHOLMOD, a library of SuiteSparse, and the macro `CGAL_LINKED_WITH_CHOLMOD`, without which
/// this header has nothing; the CMake target `CGAL::Cholmod_support` has both. CHOLMOD calls the
/// BLAS it is built with, whose threads may make results differ in the last bits from run to run.
///
/// A copy has the same ordering and nothing analyzed; a move keeps the factor.
///
/// \cgalModels{ARAPSparseSolver}
class Cholmod_solver
{
public:
  /// constructs a solver that has nothing analyzed.
  Cholmod_solver() = default;

  /// constructs a solver with an ordering that has nothing analyzed.
  explicit Cholmod_solver(Fill_reducing_ordering ordering) : m_ordering(ordering) {}

  /// computes the ordering and the pattern of the factor, which depend on the pattern of `a` only.
  /// \throws std::length_error if the factor has more than 2,147,483,647 entries
  bool analyze(const Sparse_matrix& a)
  {
    m_state.emplace(m_ordering);
    cholmod_sparse matrix = view(a);
    return m_state->analyze(matrix);
  }

  /// computes the factor; `a` has the pattern of the last `analyze()`. Returns `false` if `a` is
  /// not positive definite.
  bool factorize(const Sparse_matrix& a)
  {
    cholmod_sparse matrix = view(a);
    return m_state->factorize(matrix);
  }

  /// gives the matrix a border, or removes it if `b` has no columns, as
  /// `Multifrontal_cholesky_solver::set_border()` does.
  bool set_border(const Sparse_matrix& b, const Dense_matrix& d)
  {
    return m_state->substitution.set_border(m_state->structure, m_state->values.data(), b, d);
  }

  /// replaces the `n` rows of `x` by the solution of \f$A X = x\f$, where `n` is the size of the
  /// factorized matrix, its border included. Time: two sweeps over the factor.
  bool solve(std::size_t n, Coordinates* x)
  {
    m_state->substitution.solve(m_state->structure, m_state->values.data(), n, x);
    return true;
  }

  /// returns the size of the factor, its indices included. Each solution reads it twice.
  /// \pre A matrix was analyzed.
  std::size_t factor_bytes() const { return m_state->structure.number_of_bytes(); }

private:
  // what CHOLMOD owns, and the substitution
  struct State
  {
    explicit State(Fill_reducing_ordering ordering)
    {
      cholmod_start(&common);
      common.print = 0;
      common.supernodal = CHOLMOD_SUPERNODAL;
      common.nmethods = 1;
      common.method[0].ordering = ordering == Fill_reducing_ordering::nested_dissection
                                    ? CHOLMOD_METIS : CHOLMOD_AMD; // which it takes without METIS
    }

    ~State()
    {
      cholmod_free_factor(&factor, &common);
      cholmod_finish(&common);
    }

    State(const State&) = delete;
    State& operator=(const State&) = delete;

    bool analyze(cholmod_sparse& matrix)
    {
      factor = cholmod_analyze(&matrix, &common);
      throw_if_too_large();
      if(factor == nullptr)
        return false;
      const auto supernode = static_cast<const int*>(factor->super);
      const auto rows_begin = static_cast<const int*>(factor->pi);
      const auto rows = static_cast<const int*>(factor->s);
      const auto order = static_cast<const int*>(factor->Perm);
      internal::Supernodes supernodes;
      supernodes.columns.assign(supernode, supernode + factor->nsuper + 1);
      supernodes.rows_begin.assign(1, 0);
      for(std::size_t s = 0; s < factor->nsuper; ++s)
      {
        supernodes.rows.insert(supernodes.rows.end(), rows + rows_begin[s] + supernodes.width(s),
                               rows + rows_begin[s + 1]);
        supernodes.rows_begin.push_back(supernodes.rows.size());
      }
      structure = internal::Supernodal_structure(supernodes,
                                                 internal::Array<int>(order, order + factor->n));
      return true;
    }

    bool factorize(cholmod_sparse& matrix)
    {
      substitution.remove_border();
      const bool is_factorized = cholmod_factorize(&matrix, factor, &common);
      throw_if_too_large();
      if(!is_factorized || common.status != CHOLMOD_OK)
        return false;
      pack();
      // frees the values that CHOLMOD has; its pattern stays
      return cholmod_change_factor(CHOLMOD_PATTERN, 1, 1, 1, 1, factor, &common)
          && internal::has_positive_diagonal(structure, values.data()); // CHOLMOD accepts NaN
    }

    // what says nothing of the matrix
    void throw_if_too_large() const
    {
      if(common.status == CHOLMOD_OUT_OF_MEMORY)
        throw std::bad_alloc();
      if(common.status == CHOLMOD_TOO_LARGE)
        throw std::length_error("Cholmod_solver: the factor has more entries than int can count");
    }

    void pack()
    {
      values.resize(structure.values_size());
      const auto begin = static_cast<const int*>(factor->px);
      internal::for_each_block(factor->nsuper, [&](std::size_t first, std::size_t last) {
        for(std::size_t k = first; k < last; ++k)
        {
          const auto& s = structure.supernodes()[structure.numbers()[k]];
          double* const columns = static_cast<double*>(factor->x) + begin[k];
          for(int j = 0; j < s.width; ++j)
          {
            double& diagonal = columns[j * (s.width + s.below + 1)];
            diagonal = 1 / diagonal;
          }
          internal::pack_values(s, columns, values.data());
        }
      });
    }

    cholmod_common common;
    cholmod_factor* factor = nullptr;
    internal::Supernodal_structure structure;
    internal::Array<double> values;
    internal::Bordered_substitution<double> substitution;
  };

  // `a` as a matrix of CHOLMOD, which does not change it
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

  Fill_reducing_ordering m_ordering = Fill_reducing_ordering::minimum_degree;
  internal::Unshared_ptr<State> m_state;
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_LINKED_WITH_CHOLMOD

#endif // CGAL_ARAP_DEFORMATION_CHOLMOD_SOLVER_H
