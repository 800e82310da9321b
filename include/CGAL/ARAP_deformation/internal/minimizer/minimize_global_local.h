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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZE_GLOBAL_LOCAL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZE_GLOBAL_LOCAL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The iteration of minimize_local_global() in another order: each iteration first solves for the
// positions with the rotations that it is given, and then fits the rotations to them. It ends when
// the energy changes by less than `tolerance` of itself; the first iteration is not asked, as in
// CGAL's class, since the energy before it has rotations that were not fitted to the targets.
template <typename ClosestRotation, typename Solver>
Status minimize_global_local(Deformation_energy& energy, const ClosestRotation& closest_rotation,
                             Solver& solver, std::size_t number_of_free_vertices,
                             unsigned int iterations, double tolerance,
                             std::vector<Coordinates>& x, std::vector<Matrix_3x3>& rotations,
                             Report& report)
{
  std::vector<Coordinates> force, step;
  Bounding_box box;
  box.include(x);
  report.energy_scale = energy.scale(box);
  report.rounding_level = energy.rounding_level(box);
  {
    Scoped_seconds local(report.seconds.local_steps);
    report.energy.push_back(energy.evaluate(x, rotations, force));
  }
  while(report.iterations < iterations)
  {
    if(!std::isfinite(report.energy.back()))
      return Status::non_finite_energy;
    if(number_of_free_vertices > 0)
    {
      Scoped_seconds global(report.seconds.global_steps);
      step.assign(force.begin(), force.begin() + number_of_free_vertices);
      if(!solver.solve(number_of_free_vertices, step.data()))
        return Status::solver_failed;
      for(std::size_t v = 0; v < number_of_free_vertices; ++v)
        add(x[v], 1, step[v]);
    }
    {
      Scoped_seconds local(report.seconds.local_steps);
      report.energy.push_back(energy.evaluate(closest_rotation, x, rotations, force));
    }
    ++report.iterations;
    if(tolerance > 0 && report.iterations > 1)
    {
      const double now = report.energy.back(), before = report.energy[report.iterations - 1];
      if(std::abs((before - now) / now) < tolerance)
        return Status::converged;
    }
  }
  return std::isfinite(report.energy.back()) ? Status::iteration_limit
                                             : Status::non_finite_energy;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZE_GLOBAL_LOCAL_H
