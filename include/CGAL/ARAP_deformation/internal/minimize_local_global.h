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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZE_LOCAL_GLOBAL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZE_LOCAL_GLOBAL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Default_visitor.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/gap_estimate.h>
#include <CGAL/ARAP_deformation/internal/Rigidity_energy.h>
#include <CGAL/ARAP_deformation/internal/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The iteration of the paper (Section 3): fit the rotations to the positions, then solve for the
// positions of the first `number_of_free_vertices` vertices that minimize the energy with these
// rotations. The solver holds the factorized Laplacian L of these vertices. Instead of L x = b the
// equation L dx = b - L x is solved, whose right-hand side is minus half the gradient, so that the
// fixed point does not depend on the accuracy of the factor.
//
// `observe(k, E_k)` is called after iteration k, and after the initial evaluation with k = 0. Its
// type is erased: what a mesh and its visitor are makes no difference here, and costs no compile
// time.
using Observer = std::function<Visitor_action(unsigned int, double)>;

template <typename ClosestRotation, typename Solver>
Status minimize_local_global(Rigidity_energy& energy, const ClosestRotation& closest_rotation,
                             Solver& solver, std::size_t number_of_free_vertices,
                             const Options& options, const Observer& observe,
                             std::vector<Coordinates>& x, std::vector<Matrix_3x3>& rotations,
                             Report& report)
{
  std::vector<Coordinates> force, step;
  std::vector<double> decreases;
  report.energy_scale = energy.scale();
  for(;; ++report.iterations)
  {
    {
      Scoped_seconds local(report.seconds.local_steps);
      report.energy.push_back(energy.evaluate(closest_rotation, x, rotations, force));
    }
    if(!std::isfinite(report.energy.back()))
      return Status::non_finite_energy;
    const bool is_nothing_free = number_of_free_vertices == 0; // then there is nothing to solve
    report.estimated_relative_gap =
      is_nothing_free ? 0 : estimate_relative_gap(report.energy.back(), decreases,
                                                  energy.rounding_error_of_zero(x));

    switch(observe(report.iterations, report.energy.back()))
    {
    case Visitor_action::stop: return Status::stopped;
    case Visitor_action::cancel: return Status::cancelled;
    case Visitor_action::proceed: break;
    }
    if(is_nothing_free ||
       (options.tolerance > 0 && report.estimated_relative_gap <= options.tolerance))
      return Status::converged;
    if(report.iterations == options.iterations)
      return Status::iteration_limit;

    Scoped_seconds global(report.seconds.global_steps);
    step.assign(force.begin(), force.begin() + number_of_free_vertices);
    if(!solver.solve(number_of_free_vertices, step.data()))
      return Status::solver_failed;
    double decrease = 0;
    for(std::size_t v = 0; v < number_of_free_vertices; ++v)
    {
      decrease += dot(force[v], step[v]);
      add(x[v], 1, step[v]);
    }
    // Near the minimum the local step that follows gains as much again in the soft modes, which
    // are the last to converge. The difference of two energies would be lost in rounding.
    decreases.push_back(2 * decrease);
  }
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZE_LOCAL_GLOBAL_H
