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

inline std::string simplex_name(const Region& region, int simplex)
{
  std::string name = region.dimension == 3 ? "the tetrahedron" : "the face";
  for(int k = 0; k < region.number_of_corners(simplex); ++k)
    name += (k == 0 ? " with the vertices " : ", ") +
            std::to_string(region.indices[region.corners_of(simplex)[k]]);
  return name;
}

// what a message ends with if there are parts that nothing holds
inline std::string about_unconstrained_components(const std::vector<std::size_t>& parts)
{
  if(parts.empty())
    return std::string();
  return "; what nothing holds stays where it is: " +
         (parts.size() == 1 ? std::string("the part")
                            : std::to_string(parts.size()) + " parts, the first one") +
         " of " + vertex_name(parts.front());
}

// The sentence for a status that is about a vertex, a simplex, or the whole (an empty `what`).
inline Outcome outcome(Status status, const std::string& what = std::string())
{
  const auto about = [status, &what](const std::string& rest) {
    return Outcome(status, what + rest);
  };
  switch(status)
  {
  case Status::not_run: return Outcome();
  case Status::success: return about("everything is ready to deform");
  case Status::converged: return about("the energy is as close to its minimum as was asked for");
  case Status::iteration_limit: return about("all iterations that were asked for were run");
  case Status::stopped: return about("the visitor stopped the run and kept the last iterate");
  case Status::cancelled: return about("the visitor cancelled the run and nothing was changed");
  case Status::invalid_option: return about("an option is out of its range");
  case Status::in_a_run:
    return about("a visitor must not change the object whose run it is visiting");
  case Status::not_a_control_vertex:
    return about(" is not a control vertex and has no target; insert it as a control vertex first");
  case Status::invalid_weight:
    return about(" was given a weight for its target that is negative or not a number");
  case Status::not_a_simplex:
    return about(" is at a face or cell that is neither a polygon nor a tetrahedron with different "
                 "corners that exist");
  case Status::no_tetrahedron:
    return about("there is no tetrahedron with a volume to embed points in");
  case Status::no_simplex:
    return about("no vertex of the region of interest has a simplex in the domain: nothing ties "
                 "them together");
  case Status::non_finite_point:
    return about(" has a coordinate that is infinite or not a number");
  case Status::non_finite_weight:
    return about(" has edges whose weights are not finite");
  case Status::no_fixed_vertex:
    return about(" is free, but no chain of edges with a non-zero weight ties it to a vertex that "
                 "is fixed or pulled to a target; hold a vertex of its component");
  case Status::singular_matrix:
    return what.empty()
      ? about("the matrix of the system is not positive definite and cannot be factorized")
      : about(" makes the system singular: the weights of its edges do not add up to a positive "
              "finite number");
  case Status::solver_failed: return about("the solver failed to solve the factorized system");
  case Status::non_finite_energy:
    return about("the energy overflowed: the targets are too far away for the arithmetic, or their "
                 "weights too large");
  }
  return Outcome(status, to_string(status));
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_H
