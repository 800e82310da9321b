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

#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cmath>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The iteration of minimize_local_global() in the order of CGAL's class: each iteration first
// solves for the positions with the current rotations, and then fits the rotations to them.
// It ends when the energy changes by less than the tolerance, relative to itself. The first
// iteration is not tested, as in CGAL's class: the rotations before it were not fitted to the
// targets.
inline Status minimize_global_local(Minimization& run)
{
  Report& report = run.report;
  report.energy.push_back(run.evaluate_without_fit());
  Array<Coordinates> step;
  while(report.iterations < run.options.iterations)
  {
    if(!is_finite(report.energy.back()))
      return Status::non_finite_energy;
    if(!run.is_nothing_free())
    {
      Scoped_seconds global(report.seconds.global_steps);
      if(!run.solve(step))
        return Status::solver_failed;
      for(std::size_t v = 0; v < step.size(); ++v)
        add(run.x[v], 1, step[v]);
    }
    report.energy.push_back(run.evaluate());
    ++report.iterations;
    const double now = report.energy.back(), before = report.energy[report.iterations - 1];
    if(run.options.tolerance > 0 && report.iterations > 1 &&
       std::abs((before - now) / now) < run.options.tolerance)
      return Status::converged;
  }
  return is_finite(report.energy.back()) ? Status::iteration_limit
                                             : Status::non_finite_energy;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZE_GLOBAL_LOCAL_H
