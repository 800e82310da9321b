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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZE_LOCAL_GLOBAL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZE_LOCAL_GLOBAL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/dot_product.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The iteration of the paper (Section 3): fit the rotations to the positions, then solve for the
// free positions that minimize the energy with these rotations. Instead of L x = b the equation
// L dx = b - L x is solved, whose right-hand side is minus half the gradient, so that the fixed
// point does not depend on the accuracy of the factor. The energy never rises, whatever the solver
// returns: a step by which it would is shortened, or the run fails.
inline Status minimize_local_global(Minimization& run)
{
  Array<Coordinates> step;
  const auto force_along_step = [&] { return dot_product(run.force(), step); };
  const auto add_step = [&](double factor) { // and returns what the force is along the step
    return sum_over_blocks(step.size(), [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      for(std::size_t v = begin; v < end; ++v)
      {
        add(run.x[v], factor, step[v]);
        sum += dot(run.force()[v], step[v]);
      }
      return sum;
    });
  };
  run.evaluate();
  for(auto status = run.next_iterate();;)
  {
    if(status)
      return *status;
    double force_before = 0;
    {
      Scoped_seconds global(run.report.seconds.global_steps);
      if(!run.solve(step))
        return Status::solver_failed;
      force_before = add_step(1);
    }
    double t = 1; // the share of the step that is taken; less only if the solver is a bad one
    // no step follows the last one
    bool has_force = run.report.iterations + 1 < run.options.iterations;
    run.evaluate(has_force);
    const bool is_wrong = run.is_far_higher();
    for(; t > 0 && run.is_higher(); run.evaluate())
    {
      const double shorter = t < 0.05 || !(force_before > 0) ? 0 : 0.5 * t;
      if(shorter == 0 && (is_wrong || run.is_uphill(force_before)))
        return Status::solver_failed;
      add_step(shorter - t); // back, if rounding errors are all that is left
      t = shorter;
      has_force = true;
    }
    if(t == 0)
      run.keep_energy();
    const auto force_after = [&] {
      if(!has_force)
        run.evaluate_without_fit();
      return force_along_step();
    };
    status = run.next_iterate(run.decrease([&] { return t * force_before; },
                                           [&] { return t * force_after(); }));
  }
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZE_LOCAL_GLOBAL_H
