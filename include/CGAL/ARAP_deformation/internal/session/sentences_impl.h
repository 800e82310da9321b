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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/session/sentences.h>
#include <CGAL/ARAP_deformation/internal/solver/Hard_rows.h>

#include <cstddef>
#include <string>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
std::string vertex_name(std::size_t index)
{
  return "vertex " + std::to_string(index);
}

CGAL_ARAP_INLINE_FUNCTION
std::string control_point_name(Control_point point)
{
  return "control point " + std::to_string(point.number());
}

CGAL_ARAP_INLINE_FUNCTION
std::string simplex_name(const Region& region, int simplex)
{
  std::string name = region.dimension == 3 ? "the tetrahedron" : "the face";
  const char* before = " with the vertices ";
  for(int v : region.corners_of(simplex))
    name += std::exchange(before, ", ") + std::to_string(region.indices[v]);
  return name;
}

CGAL_ARAP_INLINE_FUNCTION
std::string about_unconstrained_components(const std::vector<std::size_t>& parts)
{
  if(parts.empty())
    return std::string();
  return "; left in place: " +
         (parts.size() == 1
            ? std::string("the unconstrained component")
            : std::to_string(parts.size()) + " unconstrained components, the first that") +
         " of " + vertex_name(parts.front());
}

// what a run left behind, and whether its end may be no minimum
inline std::string about_end(const Report& report)
{
  const auto number_of = [](unsigned int n, const std::string& what) {
    return n == 0 ? std::string()
                  : "; left on the way: " + std::to_string(n) + ' ' + what + (n > 1 ? "s" : "");
  };
  std::string text = number_of(report.saddles_left, "saddle point") +
                     number_of(report.plateaus_left, "plateau");
  if(report.end == End::flat)
    text += "; there is still a direction of negative curvature, but following it lowered the "
            "energy by next to nothing";
  if(report.end == End::undecided)
    text += "; it was not decided whether this is a minimum or a saddle point";
  return text;
}

inline std::string about_nothing_free(bool is_region_empty)
{
  return std::string("nothing is free to move: ") +
         (is_region_empty ? "the region of interest is empty"
                          : "every vertex of the region of interest is fixed");
}

// the end of a message if there are control vertices without incident simplices
inline std::string about_isolated_controls(const std::vector<std::size_t>& vertices)
{
  if(vertices.empty())
    return std::string();
  return "; " + vertex_name(vertices.front()) +
         (vertices.size() == 1 ? std::string()
                               : " and " + std::to_string(vertices.size() - 1) + " more") +
         ": a control vertex without an incident simplex moves nothing else";
}

CGAL_ARAP_INLINE_FUNCTION
void add_remarks(Outcome& result, const Report& report, const Options& options,
                 bool is_region_empty, bool has_no_control,
                 const std::vector<std::size_t>& isolated_controls)
{
  if(report.free_vertices == 0) // rotations that are to be smooth may still have changed
    result.message = (result.status == Status::converged ? std::string() : result.message + "; ") +
                     about_nothing_free(is_region_empty);
  else if(has_no_control)
    result.message += "; there is no control vertex";
  if(report.free_vertices > 0 && options.initial_guess == Initial_guess::laplacian &&
     report.initial_guess != Initial_guess::laplacian)
    result.message += "; there was no Laplacian initial guess of use, and the run started from the "
                      "current positions";
  result.message += about_end(report) + about_isolated_controls(isolated_controls) +
                    about_unconstrained_components(report.unconstrained_components);
}

// the sentence for a status, or what follows the name of the vertex or the simplex concerned
inline const char* sentence(Status status, const std::string& what)
{
  switch(status)
  {
  case Status::not_run: return "nothing was run yet";
  case Status::success: return "everything is ready to deform";
  case Status::converged:
    return "converged: the estimated gap of the energy to its minimum is within the tolerance";
  case Status::iteration_limit: return "the maximum number of iterations was reached";
  case Status::stopped: return "the visitor stopped the run; the last iterate was kept";
  case Status::cancelled: return "the visitor cancelled the run; nothing was changed";
  case Status::invalid_option:
    return "the option bending_length or smoothing_length is more than a million times the size of "
           "what can move";
  case Status::in_a_run:
    return "a visitor, function or map that a run calls must not change the object";
  case Status::foreign_state:
    return "the state is of another object; nothing was changed";
  case Status::not_a_control_vertex:
    return " is not a control vertex and has no target; insert it as a control vertex first";
  case Status::invalid_weight:
    return " was given a target weight that is negative or not a number";
  case Status::invalid_stiffness:
    return " has a stiffness that is negative, infinite or not a number";
  case Status::undeclared_map:
    return "cells are simplices, but stiffness or groups are a generic function object or vector, "
           "whose keys are vertices; wrap the function object in of_simplices() or give its "
           "parameter a type; instead of a vector, pass a map with simplices as keys";
  case Status::invalid_rotation:
    return " was given a target rotation that is not a rotation: its columns must have "
           "length 1, be orthogonal, and be right-handed; of points with two coordinates it must "
           "turn their plane into itself";
  case Status::invalid_coordinates:
    return " needs barycentric coordinates that are finite and add up to one, one for each "
           "corner of its simplex";
  case Status::dependent_target:
    return ": its position is determined by other hard targets, or all its corners are fixed; "
           "erase one of these targets, insert its corners in the region, or give it a finite "
           "weight";
  case Status::too_many_control_points:
    static_assert(Hard_rows::most_rows == 3000, "said here");
    return "there are more than 3000 hard control points; give them finite weights";
  case Status::not_a_simplex:
    return " is incident to a face that is not a polygon, or to a cell that is not a "
           "tetrahedron: the number of corners is wrong, or a corner is repeated or missing";
  case Status::too_many_corners:
    static_assert(most_corners == 2048, "said here");
    return " is incident to a face with more than 2048 corners; triangulate it, with "
           "CGAL::Polygon_mesh_processing::triangulate_face() for instance";
  case Status::no_tetrahedron:
    return "there is no tetrahedron with a volume to embed points in";
  case Status::no_simplex:
    return "no vertex of the region of interest has an incident simplex in the domain";
  case Status::non_finite_point:
    return " has a coordinate that is infinite or not a number";
  case Status::non_finite_weight:
    return " has edges whose weights are not finite";
  case Status::no_fixed_vertex:
    return " is free, but no path of edges with non-zero weights connects it to a vertex "
           "that is fixed or has a target of positive weight; fix a vertex of its component";
  case Status::singular_matrix:
    return what.empty()
      ? "the matrix of the system is not positive definite and cannot be factorized"
      : " makes the system singular: the sum of the weights of its edges is not positive and "
        "finite";
  case Status::solver_failed: return "the solver failed to solve the factorized system";
  case Status::non_finite_energy:
    return "the energy overflowed: the targets are too far away, or their weights too large";
  }
  return to_string(status);
}

CGAL_ARAP_INLINE_FUNCTION
Outcome outcome(Status status, const std::string& what)
{
  return Outcome(status, what + sentence(status, what));
}

CGAL_ARAP_INLINE_FUNCTION
Outcome outcome_of_vertex(Status status, std::size_t index, const char* what)
{
  return outcome(status, what + vertex_name(index));
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_IMPL_H
