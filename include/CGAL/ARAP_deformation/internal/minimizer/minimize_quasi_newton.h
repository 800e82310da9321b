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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZE_QUASI_NEWTON_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZE_QUASI_NEWTON_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/minimizer/End_examiner.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Quasi_newton_memory.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// Moves the first points of x to before + ratio (x - before), as many as `before` has.
inline void shorten(double ratio, const Array<Coordinates>& before,
                    Array<Coordinates>& x)
{
  for_each_block(before.size(), [&](std::size_t begin, std::size_t end) {
    for(std::size_t v = begin; v < end; ++v)
      for(std::size_t k = 0; k < 3; ++k)
        x[v][k] = before[v][k] + ratio * (x[v][k] - before[v][k]);
  });
}

// When a coarse metric is built: not in the first iterations, which may be all, as of a frame;
// afterwards, where the last one no longer fits. Other numbers gained nothing on armadillos of
// 26,002 and 104,002 vertices.
class Coarse_schedule
{
public:
  bool is_due(unsigned int iterations, double trust)
  {
    if(iterations < m_next || (m_is_built && trust >= 0.4))
      return false;
    m_is_built = true;
    m_next = iterations + 4;
    return true;
  }

  void restart() { m_is_built = false; } // the last one is gone, or of no use

private:
  unsigned int m_next = 5;
  bool m_is_built = false;
};

// L-BFGS with a multiple of the inverse Laplacian for the initial inverse Hessian (Liu, Bouaziz and
// Kavan 2017), which a coarse metric completes on large shapes. An iteration costs what one of
// local/global does, one local step and one solution, unless its step has to be shortened, which
// costs a local step each time and is rare. Where shortening does not help, or the model is of no
// use, the local/global step is taken, and the memory starts afresh. That step lowers the energy,
// or the solver has failed. It also starts afresh with each coarse metric, and where what seemed to
// be the end of the run was none.
inline Status minimize_quasi_newton(Minimization& run)
{
  Quasi_newton_memory memory(run.number_of_vertices);
  Array<Coordinates> d, next_d, before(run.number_of_vertices);
  double t = 0; // the share of the last step that was taken, 0 before the first one

  Coarse_schedule schedule;
  End_examiner examine_end(run);
  run.evaluate();
  for(auto status = run.next_iterate();;)
  {
    if(status == Status::converged)
    {
      schedule.restart();
      memory = Quasi_newton_memory(run.number_of_vertices); // the look needs memory of its own
      for(Array<Coordinates>* const vector : {&d, &next_d, &before})
        Array<Coordinates>().swap(*vector);
      status = examine_end();
      before.resize(run.number_of_vertices);
      t = 0;
    }
    if(status)
      return *status;
    bool is_safe; // whether this is the step of local/global
    double slope;
    {
      Scoped_seconds global(run.report.seconds.global_steps);
      if(!run.solve(next_d) || !memory.set_next_force(run.force()))
        return Status::solver_failed;
      if(t > 0)
        memory.remember(t, run.force(), d, next_d, run.diameter, run.force_error);
      if(schedule.is_due(run.report.iterations, memory.trust()) &&
         !memory.set_coarse_metric(run.build_coarse_metric(), run.force()))
        return Status::solver_failed;
      d.swap(next_d);
      is_safe = memory.is_empty() && !memory.has_coarse_metric();
      slope = memory.move(run.force(), d, run.x, before);
    }
    const auto replace = [&] {
      schedule.restart();
      is_safe = true;
      slope = memory.move_by(d, before, run.x);
      t = 1;
    };
    double decrease = 0;
    bool is_wrong = false; // whether the step of local/global rises far
    t = 1;
    if(!is_safe && (!(slope > 0) || memory.went_too_far(run.diameter)))
      replace();
    for(;;)
    {
      run.evaluate();
      decrease = run.decrease([&] { return t * slope; },
                              [&] { return t * memory.slope(run.force()); });
      if(!run.is_higher() && (is_safe || decrease >= 2e-4 * t * slope)) // the Armijo condition
        break;
      is_wrong |= is_safe && t == 1 && run.is_far_higher();
      if(is_safe && (t < 0.05 || !(slope > 0)))
      {
        if(is_wrong || run.is_uphill(slope))
          return Status::solver_failed;
        shorten(0, before, run.x); // rounding errors are all that is left
        run.evaluate();
        run.keep_energy();
        t = decrease = 0;
        break;
      }
      const double parabola = slope * t / (2 * slope * t - decrease); // its minimum
      const double ratio = (std::max)(0.1, (std::min)(0.5, parabola));
      t *= ratio;
      if(t < 0.05 && !is_safe)
        replace();
      else
        shorten(ratio, before, run.x);
    }
    status = run.next_iterate(decrease);
  }
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZE_QUASI_NEWTON_H
