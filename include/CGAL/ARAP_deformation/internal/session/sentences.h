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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

inline std::string vertex_name(std::size_t index)
{
  return "vertex " + std::to_string(index);
}

inline std::string control_point_name(Control_point point)
{
  return "control point " + std::to_string(point.number());
}

inline std::string simplex_name(const Region& region, int simplex)
{
  std::string name = region.dimension == 3 ? "the tetrahedron" : "the face";
  for(int k = 0; k < region.number_of_corners(simplex); ++k)
    name += (k == 0 ? " with the vertices " : ", ") +
            std::to_string(region.indices[region.corners_of(simplex)[k]]);
  return name;
}

// the end of a message if there are unconstrained components, given by their smallest vertices
inline std::string about_unconstrained_components(const std::vector<std::size_t>& parts)
{
  if(parts.empty())
    return std::string();
  return "; left in place: " +
         (parts.size() == 1
            ? std::string("the unconstrained component")
            : std::to_string(parts.size()) + " unconstrained components, the first that") +
         " of " + vertex_name(parts.front());
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

// The outcome for a status; `what` names the vertex or the simplex concerned, or is empty.
inline Outcome outcome(Status status, const std::string& what = std::string())
{
  const auto about = [status, &what](const std::string& rest) {
    return Outcome(status, what + rest);
  };
  switch(status)
  {
  case Status::not_run: return Outcome();
  case Status::success: return about("everything is ready to deform");
  case Status::converged:
    return about("the estimated gap of the energy to its minimum is within the tolerance");
  case Status::iteration_limit: return about("the maximum number of iterations was run");
  case Status::stopped: return about("the visitor stopped the run; the last iterate was kept");
  case Status::cancelled: return about("the visitor cancelled the run; nothing was changed");
  case Status::invalid_option:
    return about("the option bending_length or smoothing_length is more than a million times the "
                 "size of what can move");
  case Status::in_a_run:
    return about("a visitor must not change the object that it is visiting");
  case Status::foreign_state:
    return about("the state is of another object; nothing was changed");
  case Status::not_a_control_vertex:
    return about(" is not a control vertex and has no target; insert it as a control vertex first");
  case Status::invalid_weight:
    return about(" was given a target weight that is negative or not a number");
  case Status::invalid_stiffness:
    return about(" has a stiffness that is negative, infinite or not a number");
  case Status::invalid_rotation:
    return about(" was given a target rotation that is not a rotation: its columns must have "
                 "length 1, be orthogonal, and be right-handed");
  case Status::invalid_coordinates:
    return about(" needs barycentric coordinates that are finite and add up to one, one for each "
                 "corner of its simplex");
  case Status::dependent_target:
    return about(": its position is determined by other hard targets; erase one of them, or give "
                 "it a finite weight");
  case Status::too_many_control_points:
    return about("there are more than 3000 hard control points; give them finite weights");
  case Status::not_a_simplex:
    return about(" is incident to a face that is not a polygon, or to a cell that is not a "
                 "tetrahedron: the number of corners is wrong, or a corner is repeated or missing");
  case Status::too_many_corners:
    return about(" is incident to a face with more than " + std::to_string(most_corners) +
                 " corners; triangulate it, with "
                 "CGAL::Polygon_mesh_processing::triangulate_face() for instance");
  case Status::no_tetrahedron:
    return about("there is no tetrahedron with a volume to embed points in");
  case Status::no_simplex:
    return about("no vertex of the region of interest has an incident simplex in the domain");
  case Status::non_finite_point:
    return about(" has a coordinate that is infinite or not a number");
  case Status::non_finite_weight:
    return about(" has edges whose weights are not finite");
  case Status::no_fixed_vertex:
    return about(" is free, but no path of edges with non-zero weights connects it to a vertex "
                 "that is fixed or has a target; fix a vertex of its component");
  case Status::singular_matrix:
    return what.empty()
      ? about("the matrix of the system is not positive definite and cannot be factorized")
      : about(" makes the system singular: the sum of the weights of its edges is not positive and "
              "finite");
  case Status::solver_failed: return about("the solver failed to solve the factorized system");
  case Status::non_finite_energy:
    return about("the energy overflowed: the targets are too far away, or their weights too large");
  }
  return Outcome(status, to_string(status));
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_H
