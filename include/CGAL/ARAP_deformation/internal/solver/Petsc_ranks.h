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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_PETSC_RANKS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_PETSC_RANKS_H

#include <CGAL/license/ARAP_deformation.h>

#if defined(CGAL_LINKED_WITH_PETSC) || defined(DOXYGEN_RUNNING)

#include <petscksp.h>

#include <chrono>
#include <thread>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

inline bool is_petsc_success(PetscErrorCode code) { return code == 0; }

// The processes that run the program, and MPI and PETSc for as long as this object lives. Whoever
// started them ends them. PETSc prints no errors: its functions return them.
class Petsc_ranks
{
public:
  enum Task { end, create, destroy, factorize, solve };

  // what is to be done with which linear system, for which the others have the same number
  struct Command
  {
    int task, number;
    double tolerance;
  };

  Petsc_ranks()
  {
    int is_mpi_there = 0;
    MPI_Initialized(&is_mpi_there);
    PetscBool is_petsc_there = PETSC_FALSE;
    PetscInitialized(&is_petsc_there);
    if(!is_mpi_there)
    {
      int provided = 0;
      MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
      m_has_started_mpi = true;
    }
    if(!is_petsc_there)
    {
      for(const auto& [option, value] : {std::pair("-no_signal_handler", "1"),
                                         std::pair("-skip_petscrc", "1"),
                                         // a quarter less memory and time than without, on surfaces
                                         std::pair("-arap_pc_hypre_boomeramg_agg_nl", "1"),
                                         std::pair("-arap_pc_hypre_boomeramg_P_max", "4")})
        PetscOptionsSetValue(nullptr, option, value);
      m_has_started_petsc =
        is_petsc_success(PetscInitialize(nullptr, nullptr, nullptr, nullptr));
    }
    m_is_running = is_petsc_there || m_has_started_petsc;
    if(m_is_running)
      PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
    MPI_Comm_dup(MPI_COMM_WORLD, &m_world); // no messages but ours
    MPI_Comm_rank(m_world, &m_rank);
    MPI_Comm_size(m_world, &m_size);
  }

  Petsc_ranks(const Petsc_ranks&) = delete;
  Petsc_ranks& operator=(const Petsc_ranks&) = delete;

  ~Petsc_ranks()
  {
    if(m_rank == 0)
      send({end, 0, 0});
    if(m_is_running)
      PetscPopErrorHandler();
    MPI_Comm_free(&m_world);
    if(m_has_started_petsc)
      PetscFinalize();
    if(m_has_started_mpi)
      MPI_Finalize();
  }

  bool is_running() const { return m_is_running; }
  MPI_Comm world() const { return m_world; }
  int rank() const { return m_rank; }
  int size() const { return m_size; }
  int new_number() { return m_last_number++; }

  // rank 0: tells the others what to do
  void send(Command command)
  {
    MPI_Request request;
    MPI_Ibcast(&command, sizeof(command), MPI_BYTE, 0, m_world, &request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
  }

  // The others: the next command. Waits without keeping a processor busy, which MPI does not; rank
  // 0 may need it.
  Command receive() const
  {
    Command command = {end, 0, 0};
    MPI_Request request;
    MPI_Ibcast(&command, sizeof(command), MPI_BYTE, 0, m_world, &request);
    int is_there = 0;
    MPI_Test(&request, &is_there, MPI_STATUS_IGNORE);
    for(std::chrono::microseconds pause(10); !is_there; )
    {
      std::this_thread::sleep_for(pause);
      if(pause < std::chrono::milliseconds(1))
        pause *= 2;
      MPI_Test(&request, &is_there, MPI_STATUS_IGNORE);
    }
    return command;
  }

  // whether it is true on all ranks
  bool is_everywhere(bool is_here) const
  {
    int result = is_here;
    MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_INT, MPI_MIN, m_world);
    return result != 0;
  }

private:
  MPI_Comm m_world = MPI_COMM_NULL;
  int m_rank = 0, m_size = 1, m_last_number = 0;
  bool m_has_started_mpi = false, m_has_started_petsc = false, m_is_running = false;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_LINKED_WITH_PETSC

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_PETSC_RANKS_H
