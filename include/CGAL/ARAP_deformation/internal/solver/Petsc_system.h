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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_PETSC_SYSTEM_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_PETSC_SYSTEM_H

#include <CGAL/license/ARAP_deformation.h>

#if defined(CGAL_LINKED_WITH_PETSC) || defined(DOXYGEN_RUNNING)

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/cholesky/may_be_positive_definite.h>
#include <CGAL/ARAP_deformation/internal/solver/Petsc_ranks.h>

#include <Eigen/SparseCore>

#include <petscksp.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <type_traits>

namespace CGAL {
namespace ARAP {
namespace internal {

static_assert(std::is_same<PetscScalar, double>::value && sizeof(PetscInt) == sizeof(int),
              "PETSc must be built for real numbers in double precision, with indices of 32 bits");

// What a rank has of a linear system whose rows are distributed in blocks. All ranks call the same
// functions in the same order; rank 0 gives the matrix and the columns, the others nothing.
class Petsc_system
{
public:
  // A tolerance of zero: by a Cholesky factorization. Else by conjugate gradients.
  Petsc_system(const Petsc_ranks& ranks, double tolerance)
    : m_ranks(ranks), m_tolerance(tolerance)
  {}

  Petsc_system(const Petsc_system&) = delete;
  Petsc_system& operator=(const Petsc_system&) = delete;
  ~Petsc_system() { clear(); }

  // forgets the last matrix
  void clear()
  {
    KSPDestroy(&m_iteration);
    MatDestroy(&m_factor);
    clear_matrix();
  }

  // The first matrix is analyzed, too; the next ones have its pattern. False, on all ranks, if one
  // of them fails.
  bool factorize(const Sparse_matrix* a)
  {
    constexpr PetscInt largest_workspace = 1000; // in percent of what MUMPS has estimated
    bool is_done = false;
    // of conjugate gradients nothing serves again; after an error of MUMPS PETSc would keep the
    // last factor without a word
    if(m_tolerance > 0 || mumps_error() < 0)
      clear();
    while(true)
    {
      is_done = distribute(a) && (m_tolerance > 0 ? set_up_iteration() : set_up_factor());
      if(!(m_tolerance > 0))
        clear_matrix();
      const int error = mumps_error(); // -17 and -20: of what is sent and received
      const bool is_workspace_too_small = error == -8 || error == -9 || error == -17 ||
                                          error == -20;
      if(is_done || !is_workspace_too_small || m_workspace >= largest_workspace)
        break;
      m_workspace = (std::min)(2 * m_workspace, largest_workspace);
      MatDestroy(&m_factor);
    }
    if(!is_done)
      clear();
    return is_done;
  }

  // replaces the rows of x, on rank 0, by those of the solution
  bool solve(Coordinates* x)
  {
    scatter(x);
    const bool is_done =
      m_ranks.is_everywhere(m_tolerance > 0 ? iterate() : substitute());
    gather(x);
    return is_done;
  }

private:
  // Rank 0 has the lower triangle by columns, which is the upper one by rows, as MUMPS reads it.
  // Conjugate gradients need all entries of a row. No rank has more than its rows twice, but for
  // the matrix that rank 0 is given.
  bool distribute(const Sparse_matrix* a)
  {
    const bool is_full = m_tolerance > 0;
    Array<PetscInt> begins; // on rank 0: where each row begins, if it has all its entries
    const PetscInt* begin = nullptr;
    bool is_good = attempt([&] {
      m_first_rows.assign(std::size_t(m_ranks.size()) + 1, 0);
      if(a == nullptr)
        return true;
      if(is_full)
        begins = row_begins(*a);
      begin = is_full ? begins.data() : a->outerIndexPtr();
      split_rows(static_cast<PetscInt>(a->rows()), begin);
      return may_be_positive_definite(*a);
    });
    if(!is_good)
      return false;
    MPI_Bcast(m_first_rows.data(), m_ranks.size() + 1, MPI_INT, 0, m_ranks.world());

    const PetscInt m = number_of_rows();
    is_good = attempt([&] {
      m_begins.assign(std::size_t(m) + 1, 0);
      return true;
    });
    if(!is_good)
      return false;
    for(int rank = 1; a != nullptr && rank < m_ranks.size(); ++rank)
      send(begin + m_first_rows[rank], number_of_rows(rank) + 1, MPI_INT, rank);
    if(a == nullptr)
      receive(m_begins.data(), m + 1, MPI_INT);
    else
      std::copy_n(begin, m + 1, m_begins.begin());
    const PetscInt offset = m_begins[0];
    for(PetscInt& k : m_begins)
      k -= offset;

    Array<PetscInt> columns; // of another rank
    Array<double> values;
    Array<PetscInt> next;    // scratch of full_rows()
    is_good = attempt([&] {
      if(is_full || a == nullptr)
      {
        m_columns.resize(std::size_t(m_begins[m]));
        m_values.resize(std::size_t(m_begins[m]));
      }
      for(int rank = 0; is_full && a != nullptr && rank < m_ranks.size(); ++rank)
        next.resize((std::max)(next.size(), std::size_t(number_of_rows(rank))));
      for(int rank = 1; is_full && a != nullptr && rank < m_ranks.size(); ++rank)
      {
        const auto size = std::size_t(begin[m_first_rows[rank + 1]] - begin[m_first_rows[rank]]);
        columns.resize((std::max)(columns.size(), size));
        values.resize((std::max)(values.size(), size));
      }
      return true;
    });
    if(!is_good)
      return false;
    for(int rank = 1; a != nullptr && rank < m_ranks.size(); ++rank)
    {
      const PetscInt first = begin[m_first_rows[rank]];
      const PetscInt size = begin[m_first_rows[rank + 1]] - first;
      if(is_full)
        full_rows(*a, begin, rank, next.data(), columns.data(), values.data());
      send(is_full ? columns.data() : a->innerIndexPtr() + first, size, MPI_INT, rank);
      send(is_full ? values.data() : a->valuePtr() + first, size, MPI_DOUBLE, rank);
    }
    if(a == nullptr)
    {
      receive(m_columns.data(), m_begins[m], MPI_INT);
      receive(m_values.data(), m_begins[m], MPI_DOUBLE);
    }
    else if(is_full)
      full_rows(*a, begin, 0, next.data(), m_columns.data(), m_values.data());
    const bool is_in_place = a != nullptr && !is_full;
    return make_matrix(is_in_place ? const_cast<PetscInt*>(a->innerIndexPtr()) : m_columns.data(),
                       is_in_place ? const_cast<double*>(a->valuePtr()) : m_values.data());
  }

  // One rank reads the arrays in place, several copy them.
  bool make_matrix(PetscInt* columns, double* values)
  {
    const PetscInt m = number_of_rows(), n = m_first_rows.back();
    PetscInt* const begins = m_begins.data();
    const bool is_single = m_ranks.size() == 1, is_full = m_tolerance > 0;
    const bool is_made = m_ranks.is_everywhere(is_petsc_success(
      is_full ? is_single
        ? MatCreateSeqAIJWithArrays(m_ranks.world(), m, n, begins, columns, values, &m_matrix)
        : MatCreateMPIAIJWithArrays(m_ranks.world(), m, m, n, n, begins, columns, values, &m_matrix)
      : is_single
        ? MatCreateSeqSBAIJWithArrays(m_ranks.world(), 1, m, n, begins, columns, values, &m_matrix)
        : MatCreateMPISBAIJWithArrays(m_ranks.world(), 1, m, m, n, n, begins, columns, values,
                                      &m_matrix)) &&
      is_petsc_success(MatSetOption(m_matrix, MAT_SPD, PETSC_TRUE)) &&
      is_petsc_success(MatSetOptionsPrefixFactor(m_matrix, "arap_")));
    if(!is_single)
      clear_rows();
    return is_made;
  }

  bool set_up_factor()
  {
    MatFactorInfo info;
    MatFactorInfoInitialize(&info);
    if(m_factor == nullptr)
    {
      const bool is_analyzed =
        is_petsc_success(MatGetFactor(m_matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &m_factor)) &&
        m_factor != nullptr &&
        is_petsc_success(MatMumpsSetIcntl(m_factor, 14, m_workspace)) &&
        is_petsc_success(MatCholeskyFactorSymbolic(m_factor, m_matrix, nullptr, &info)) &&
        has_factor();
      if(!m_ranks.is_everywhere(is_analyzed))
        return false;
    }
    PetscInt negative_pivots = 1;
    const bool is_factorized =
      is_petsc_success(MatCholeskyFactorNumeric(m_factor, m_matrix, &info)) && has_factor() &&
      is_petsc_success(MatMumpsGetInfog(m_factor, 12, &negative_pivots)) && negative_pivots == 0;
    return m_ranks.is_everywhere(is_factorized) && allocate_columns();
  }

  bool has_factor() const
  {
    MatFactorError error = MAT_FACTOR_OTHER;
    return is_petsc_success(MatFactorGetError(m_factor, &error)) && error == MAT_FACTOR_NOERROR;
  }

  // of its last call, the same on all ranks; 0 if there is none
  PetscInt mumps_error() const
  {
    PetscInt error = 0;
    if(m_factor != nullptr)
      MatMumpsGetInfog(m_factor, 1, &error);
    return error;
  }

  bool substitute()
  {
    const PetscInt m = number_of_rows(), n = m_first_rows.back();
    double* const b = m_columns_of_x.data();
    double* const x = b + 3 * std::size_t(m);
    Mat right_hand_side = nullptr, solution = nullptr;
    const bool is_solved =
      is_petsc_success(MatCreateDense(m_ranks.world(), m, PETSC_DECIDE, n, 3, b,
                                      &right_hand_side)) &&
      is_petsc_success(MatCreateDense(m_ranks.world(), m, PETSC_DECIDE, n, 3, x, &solution)) &&
      is_petsc_success(MatMatSolve(m_factor, right_hand_side, solution)) && has_factor();
    MatDestroy(&right_hand_side);
    MatDestroy(&solution);
    return is_solved;
  }

  // The tolerance is for the error of the solution in the norm of the matrix, as the preconditioner
  // estimates it.
  bool set_up_iteration()
  {
    PC preconditioner = nullptr;
    return m_ranks.is_everywhere(
      is_petsc_success(KSPCreate(m_ranks.world(), &m_iteration)) &&
      is_petsc_success(KSPSetOptionsPrefix(m_iteration, "arap_")) &&
      is_petsc_success(KSPSetType(m_iteration, KSPCG)) &&
      is_petsc_success(KSPSetNormType(m_iteration, KSP_NORM_NATURAL)) &&
      is_petsc_success(KSPSetTolerances(m_iteration, m_tolerance, 1e-300, PETSC_DEFAULT, 1000)) &&
      is_petsc_success(KSPSetOperators(m_iteration, m_matrix, m_matrix)) &&
      is_petsc_success(KSPGetPC(m_iteration, &preconditioner)) &&
#ifdef PETSC_HAVE_HYPRE
      is_petsc_success(PCSetType(preconditioner, PCHYPRE)) &&
      is_petsc_success(PCHYPRESetType(preconditioner, "boomeramg")) &&
#else
      is_petsc_success(PCSetType(preconditioner, PCGAMG)) &&
#endif
      is_petsc_success(KSPSetFromOptions(m_iteration)) &&
      is_petsc_success(KSPSetUp(m_iteration))) && allocate_columns();
  }

  bool iterate()
  {
    const PetscInt m = number_of_rows(), n = m_first_rows.back();
    double* const b = m_columns_of_x.data();
    double* const x = b + 3 * std::size_t(m);
    bool is_solved = true;
    for(std::size_t c = 0; c < 3 && is_solved; ++c)
    {
      Vec right_hand_side = nullptr, solution = nullptr;
      KSPConvergedReason reason = KSP_DIVERGED_NULL;
      is_solved =
        is_petsc_success(VecCreateMPIWithArray(m_ranks.world(), 1, m, n, b + c * std::size_t(m),
                                               &right_hand_side)) &&
        is_petsc_success(VecCreateMPIWithArray(m_ranks.world(), 1, m, n, x + c * std::size_t(m),
                                               &solution)) &&
        is_petsc_success(KSPSolve(m_iteration, right_hand_side, solution)) &&
        is_petsc_success(KSPGetConvergedReason(m_iteration, &reason)) && reason > 0;
      VecDestroy(&right_hand_side);
      VecDestroy(&solution);
    }
    return is_solved;
  }

  bool allocate_columns()
  {
    return attempt([&] {
      const auto m = static_cast<std::size_t>(number_of_rows());
      m_columns_of_x.resize(6 * m);
      m_rows_of_x.resize(m_ranks.rank() == 0 ? 0 : m);
      return true;
    });
  }

  // rank 0 sends each rank its rows of x, of which that makes columns
  void scatter(Coordinates* x)
  {
    const PetscInt m = number_of_rows();
    for(int rank = 1; x != nullptr && rank < m_ranks.size(); ++rank)
      send(x + m_first_rows[rank], 3 * number_of_rows(rank), MPI_DOUBLE, rank);
    if(x == nullptr)
      receive(m_rows_of_x.data(), 3 * m, MPI_DOUBLE);
    const Coordinates* const rows = x == nullptr ? m_rows_of_x.data() : x;
    for(std::size_t k = 0; k < std::size_t(m); ++k)
      for(std::size_t c = 0; c < 3; ++c)
        m_columns_of_x[c * std::size_t(m) + k] = rows[k][c];
  }

  void gather(Coordinates* x)
  {
    const PetscInt m = number_of_rows();
    const double* const solution = m_columns_of_x.data() + 3 * std::size_t(m);
    Coordinates* const rows = x == nullptr ? m_rows_of_x.data() : x;
    for(std::size_t k = 0; k < std::size_t(m); ++k)
      for(std::size_t c = 0; c < 3; ++c)
        rows[k][c] = solution[c * std::size_t(m) + k];
    for(int rank = 1; x != nullptr && rank < m_ranks.size(); ++rank)
      MPI_Recv(x + m_first_rows[rank], 3 * number_of_rows(rank), MPI_DOUBLE, rank, 0,
               m_ranks.world(), MPI_STATUS_IGNORE);
    if(x == nullptr)
      MPI_Send(rows, 3 * m, MPI_DOUBLE, 0, 0, m_ranks.world());
  }

  // rows for all ranks, of about as many entries each
  void split_rows(PetscInt n, const PetscInt* begin)
  {
    const int size = m_ranks.size();
    for(int rank = 1; rank < size; ++rank)
    {
      const auto entries = static_cast<PetscInt>(1.0 * begin[n] * rank / size);
      m_first_rows[rank] =
        static_cast<PetscInt>(std::lower_bound(begin, begin + n, entries) - begin);
    }
    m_first_rows[size] = n;
  }

  // where the rows begin, if each has all its entries
  static Array<PetscInt> row_begins(const Sparse_matrix& a)
  {
    Array<PetscInt> begin(static_cast<int>(a.rows()) + 1);
    for(int column = 0; column < a.outerSize(); ++column)
      for(Sparse_matrix::InnerIterator entry(a, column); entry; ++entry)
      {
        ++begin[entry.row() + 1];
        if(entry.row() != column)
          ++begin[column + 1];
      }
    add_up(begin);
    return begin;
  }

  // all entries of the rows of a rank, with ascending columns; allocates nothing
  void full_rows(const Sparse_matrix& a, const PetscInt* begin, int rank, PetscInt* next,
                 PetscInt* columns, double* values) const
  {
    const PetscInt first = m_first_rows[rank], last = m_first_rows[rank + 1];
    std::copy(begin + first, begin + last, next);
    const auto add = [&](PetscInt row, PetscInt column, double value) {
      if(row < first || row >= last)
        return;
      const PetscInt k = next[row - first]++ - begin[first];
      columns[k] = column;
      values[k] = value;
    };
    for(int column = 0; column < last; ++column)
      for(Sparse_matrix::InnerIterator entry(a, column); entry; ++entry)
      {
        add(static_cast<PetscInt>(entry.row()), column, entry.value());
        if(entry.row() != column)
          add(column, static_cast<PetscInt>(entry.row()), entry.value());
      }
  }

  PetscInt number_of_rows(int rank) const { return m_first_rows[rank + 1] - m_first_rows[rank]; }
  PetscInt number_of_rows() const { return number_of_rows(m_ranks.rank()); }

  // f() may throw where memory runs out, or there are too many entries: false, on all ranks
  template <typename F>
  bool attempt(const F& f) const
  {
    bool is_done = false;
    try
    {
      is_done = f();
    }
    catch(const std::bad_alloc&) {}
    catch(const std::length_error&) {}
    return m_ranks.is_everywhere(is_done);
  }

  template <typename T>
  void send(const T* begin, PetscInt size, MPI_Datatype type, int rank) const
  {
    MPI_Send(begin, size, type, rank, 0, m_ranks.world());
  }

  template <typename T>
  void receive(T* begin, PetscInt size, MPI_Datatype type) const
  {
    MPI_Recv(begin, size, type, 0, 0, m_ranks.world(), MPI_STATUS_IGNORE);
  }

  void clear_rows()
  {
    m_begins = Array<PetscInt>();
    m_columns = Array<PetscInt>();
    m_values = Array<double>();
  }

  void clear_matrix()
  {
    MatDestroy(&m_matrix);
    clear_rows();
  }

  const Petsc_ranks& m_ranks;
  const double m_tolerance;
  PetscInt m_workspace = 30; // of MUMPS, in percent beyond what it estimates
  Array<PetscInt> m_first_rows; // of each rank, and the number of all
  Array<PetscInt> m_begins, m_columns; // of this rank's rows
  Array<double> m_values;
  Mat m_matrix = nullptr, m_factor = nullptr;
  KSP m_iteration = nullptr;
  Array<double> m_columns_of_x; // the right-hand side, and the solution
  Array<Coordinates> m_rows_of_x; // rank 0 has them already
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_LINKED_WITH_PETSC

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_PETSC_SYSTEM_H
