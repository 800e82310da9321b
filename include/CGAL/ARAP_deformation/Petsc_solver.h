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

#ifndef CGAL_ARAP_DEFORMATION_PETSC_SOLVER_H
#define CGAL_ARAP_DEFORMATION_PETSC_SOLVER_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#if defined(CGAL_LINKED_WITH_PETSC) || defined(DOXYGEN_RUNNING)

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Unshared_ptr.h>
#include <CGAL/ARAP_deformation/internal/solver/Petsc_ranks.h>
#include <CGAL/ARAP_deformation/internal/solver/Petsc_system.h>
#include <CGAL/assertions.h>

#include <cstddef>
#include <map>
#include <memory>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationSolvers
/// \brief MPI and PETSc, for the programs that use `Petsc_solver`.
///
/// A program that `mpirun` starts as several processes deforms on one of them, that of rank 0; the
/// others keep parts of the matrices and their factors, and compute with them:
/// \code{.cpp}
/// int main()
/// {
///   const CGAL::ARAP::Petsc_environment petsc;
///   if(petsc.serve())
///     return 0; // a process that served rank 0, which has ended
///   ... // what the program does, once
/// }
/// \endcode
/// A program that is started alone has rank 0 only. OpenMPI binds processes to processors; with its
/// option `--bind-to none` the threads of rank 0 have more than one.
///
/// Starts MPI and PETSc, unless the program has, and ends what it started with the last copy of the
/// environment and the last solver made with it. MPI cannot be started again after that: keep the
/// environment as long as the program may need one, and copy it where another is needed. PETSc
/// reads the options in the environment variable `PETSC_OPTIONS`, for solvers those with the prefix
/// `arap_`, as in `-arap_pc_hypre_boomeramg_strong_threshold 0.5`. It prints no errors and takes no
/// signals.
class Petsc_environment
{
public:
  /// starts MPI and PETSc, unless they have been started. All processes must do this.
  Petsc_environment() : m_ranks(std::make_shared<internal::Petsc_ranks>()) {}

  /// returns `false` at once in the process of rank 0. In others does what the solvers there need,
  /// and returns `true` when the environment and the solvers of rank 0 are gone. If memory runs out
  /// here and the other processes cannot be told, the program ends: they would wait forever.
  bool serve() const noexcept
  {
    using Ranks = internal::Petsc_ranks;
    if(m_ranks->rank() == 0)
      return false;
    std::map<int, internal::Petsc_system> systems;
    Ranks::Command command;
    while((command = m_ranks->receive()).task != Ranks::end)
      switch(command.task)
      {
      case Ranks::create:
        systems.try_emplace(command.number, *m_ranks, command.tolerance);
        break;
      case Ranks::destroy: systems.erase(command.number); break;
      case Ranks::factorize: systems.at(command.number).factorize(nullptr); break;
      case Ranks::solve: systems.at(command.number).solve(nullptr); break;
      }
    return true;
  }

  /// returns the number of processes.
  int number_of_ranks() const { return m_ranks->size(); }

private:
  friend class Petsc_solver;
  std::shared_ptr<internal::Petsc_ranks> m_ranks;
};

/// \ingroup PkgARAPDeformationSolvers
/// \brief How a `Petsc_solver` solves.
enum class Petsc_method
{
  /// By a Cholesky factorization, of MUMPS.
  cholesky,
  /// By conjugate gradients, whose preconditioner is algebraic multigrid: BoomerAMG of hypre, or
  /// GAMG of PETSc if that was built without hypre. Needs memory in proportion to the number of
  /// rows.
  conjugate_gradients
};

/// \ingroup PkgARAPDeformationSolvers
/// \brief solvers of PETSc, whose matrices and factors are distributed over the memory of several
/// processes.
///
/// Needs PETSc, a build of it with MUMPS for real numbers with indices of 32 bits; programs that
/// use it are linked with the CMake target `CGAL::Petsc_support`, which defines
/// `CGAL_LINKED_WITH_PETSC`; without that this header has nothing.
/// `include(ARAP_deformation/cmake/CGAL_Petsc_support.cmake)` defines the target; an installed
/// package does not have it. The processes are those of a `Petsc_environment`.
///
/// No two calls of the solvers of a program may overlap: PETSc is not thread-safe.
///
/// A matrix is refused if an entry is not finite or one on the diagonal is not positive, and where
/// MUMPS finds a pivot that is not positive. A solution fails where conjugate gradients do not
/// reach their tolerance.
///
/// A copy has the same method and nothing analyzed; a move keeps the factor.
///
/// \cgalModels{ARAPSparseSolver}
class Petsc_solver
{
public:
  /// constructs a solver that has nothing analyzed, in the process of rank 0.
  ///
  /// \param environment the processes
  /// \param method how it solves
  /// \param tolerance of conjugate gradients, between 0 and 1: the error of a solution relative to
  ///        it, both in the norm of the matrix, as the preconditioner estimates it. A step of
  ///        local/global then misses the share `tolerance`\f$^2\f$ of what the exact step gains
  ///        with these rotations. The default, which misses a ten-thousandth, is what the
  ///        minimizers need: smaller ones take longer, and no fewer iterations.
  explicit Petsc_solver(const Petsc_environment& environment,
                        Petsc_method method = Petsc_method::cholesky, double tolerance = 1e-2)
    : m_ranks(environment.m_ranks), m_tolerance(method == Petsc_method::cholesky ? 0 : tolerance)
  {
    CGAL_precondition(m_ranks->rank() == 0);
    CGAL_precondition(method == Petsc_method::cholesky || (0 < tolerance && tolerance < 1));
  }

  /// forgets the last matrix. The pattern of `a` is analyzed with the first factorization. Returns
  /// `false` if PETSc could not be started.
  bool analyze(const Sparse_matrix&)
  {
    m_state.reset();
    if(m_ranks->is_running())
      m_state.emplace(m_ranks, m_tolerance);
    return m_ranks->is_running();
  }

  /// computes the factor, or the levels of the multigrid; `a` has the pattern of the last
  /// `analyze()`. Returns `false` if `a` is refused, or if memory runs out. (If PETSc itself
  /// runs out of memory in only some of the processes, the others may hang.)
  bool factorize(const Sparse_matrix& a)
  {
    m_state->send(Task::factorize);
    return m_state->system.factorize(&a);
  }

  /// replaces the `n` rows of `x` by the solution of \f$A X = x\f$. Returns `false` if it fails.
  bool solve(std::size_t n, Coordinates* x)
  {
    if(n == 0)
      return true;
    m_state->send(Task::solve);
    return m_state->system.solve(x);
  }

private:
  using Task = internal::Petsc_ranks;

  // rank 0's part of a system, and its name for the others
  struct State
  {
    State(const std::shared_ptr<internal::Petsc_ranks>& ranks_, double tolerance_)
      : ranks(ranks_), number(ranks->new_number()), tolerance(tolerance_),
        system(*ranks, tolerance)
    {
      send(Task::create);
    }

    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { send(Task::destroy); }

    void send(int task) const { ranks->send({task, number, tolerance}); }

    std::shared_ptr<internal::Petsc_ranks> ranks;
    int number;
    double tolerance;
    internal::Petsc_system system;
  };

  std::shared_ptr<internal::Petsc_ranks> m_ranks;
  double m_tolerance; // 0 for a factorization
  internal::Unshared_ptr<State> m_state;
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_LINKED_WITH_PETSC

#endif // CGAL_ARAP_DEFORMATION_PETSC_SOLVER_H
