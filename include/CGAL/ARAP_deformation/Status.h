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

#ifndef CGAL_ARAP_DEFORMATION_STATUS_H
#define CGAL_ARAP_DEFORMATION_STATUS_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <string>
#include <utility>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationRun
/// the result of a call. \ref ARAPDeformation_Errors tells what to do about each of them.
enum class Status
{
  not_run,              ///< the call was not made yet
  success,              ///< a call that does not iterate succeeded
  converged,            ///< the estimated relative gap to the minimum is within the tolerance
  iteration_limit,      ///< the maximum number of iterations was reached, or, in a look at the
                        ///< second derivative, all but one
  stopped,              ///< a visitor stopped the run; the last iterate was kept
  cancelled,            ///< a visitor cancelled the run; nothing was changed
  invalid_option,       ///< an option is out of range
  in_a_run,             ///< a visitor, or another function that a run calls, tried to change the
                        ///< object
  foreign_state,        ///< the state to restore is of another object
  invalid_stiffness,    ///< the stiffness of a cell is negative, infinite or not a number
  undeclared_map,       ///< cells are simplices, and their stiffness or groups are given by
                        ///< a generic function object without `of_simplices()`, or by a vector
                        ///< where simplices are not numbers
  invalid_rotation,     ///< the rotation of a control vertex is not a rotation, or leaves the plane
  not_a_control_vertex, ///< a target or its weight was set for neither a control vertex nor
                        ///< a control point
  invalid_weight,       ///< the weight of a target is negative or not a number, or infinite where
                        ///< the target is a set
  invalid_coordinates,  ///< barycentric coordinates are not finite, or do not add up to one, or are
                        ///< not as many as the simplex has corners
  dependent_target,     ///< other hard targets determine where a hard control point is
  too_many_control_points, ///< there are more than 3000 hard control points
  not_a_simplex,        ///< a face in or next to the region is not a polygon, or a cell there not
                        ///< a tetrahedron, or the simplex of a new control point does not exist
  too_many_corners,     ///< a face in or next to the region has more than 2048 corners
  no_tetrahedron,       ///< there is no tetrahedron with a volume to embed points in
  no_simplex,           ///< no vertex of the region of interest has an incident simplex
  non_finite_point,     ///< a coordinate or a target is infinite or not a number
  non_finite_weight,    ///< the weight of an edge is infinite or not a number
  no_fixed_vertex,      ///< no vertex of the region is fixed or has a target of positive weight;
                        ///< for `Surface_mesh_deformation`, and where a hard control point has
                        ///< corners in no other, one unconstrained component is enough
  singular_matrix,      ///< the matrix of the system is not positive definite
  solver_failed,        ///< the solver could not solve with the matrix that it had factorized, or
                        ///< its solution made the energy rise by more than a hundredth, or led
                        ///< uphill
  non_finite_energy     ///< the energy overflowed during the run
};

/// \ingroup PkgARAPDeformationRun
/// returns whether `status` is a success: `Status::success`, `Status::converged`,
/// `Status::iteration_limit` or `Status::stopped`.
inline bool succeeded(Status status)
{
  return status == Status::success || status == Status::converged ||
         status == Status::iteration_limit || status == Status::stopped;
}

/// \ingroup PkgARAPDeformationRun
/// returns the name of the enumerator `status`.
inline const char* to_string(Status status)
{
  switch(status)
  {
  case Status::not_run: return "not_run";
  case Status::success: return "success";
  case Status::converged: return "converged";
  case Status::iteration_limit: return "iteration_limit";
  case Status::stopped: return "stopped";
  case Status::cancelled: return "cancelled";
  case Status::invalid_option: return "invalid_option";
  case Status::in_a_run: return "in_a_run";
  case Status::foreign_state: return "foreign_state";
  case Status::not_a_control_vertex: return "not_a_control_vertex";
  case Status::invalid_weight: return "invalid_weight";
  case Status::invalid_stiffness: return "invalid_stiffness";
  case Status::undeclared_map: return "undeclared_map";
  case Status::invalid_rotation: return "invalid_rotation";
  case Status::invalid_coordinates: return "invalid_coordinates";
  case Status::dependent_target: return "dependent_target";
  case Status::too_many_control_points: return "too_many_control_points";
  case Status::not_a_simplex: return "not_a_simplex";
  case Status::too_many_corners: return "too_many_corners";
  case Status::no_tetrahedron: return "no_tetrahedron";
  case Status::no_simplex: return "no_simplex";
  case Status::non_finite_point: return "non_finite_point";
  case Status::non_finite_weight: return "non_finite_weight";
  case Status::no_fixed_vertex: return "no_fixed_vertex";
  case Status::singular_matrix: return "singular_matrix";
  case Status::solver_failed: return "solver_failed";
  case Status::non_finite_energy: return "non_finite_energy";
  }
  return "unknown";
}

/// \ingroup PkgARAPDeformationRun
/// \brief a status, and a message that tells what happened to which vertex, simplex or option.
///
/// It converts to `true` if `succeeded(status)`.
struct Outcome
{
  Status status = Status::not_run; ///< the status.
  /// the message; empty if a function of `CGAL::ARAP_deformation` other than a run, `preprocess()`
  /// or `set_options()` succeeds.
  std::string message = "nothing was run yet";

  /// constructs the outcome of a call that was not made yet.
  Outcome() = default;

  /// constructs an outcome from a status and a message.
  Outcome(Status status_, std::string message_)
    : status(status_), message(std::move(message_))
  {}

  /// returns `succeeded(status)`.
  explicit operator bool() const { return succeeded(status); }
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_STATUS_H
