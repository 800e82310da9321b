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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_LEAVE_SADDLE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_LEAVE_SADDLE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Second_look.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>
#include <cstdio>
#include <cstdlib>

namespace CGAL {
namespace ARAP {
namespace internal {

// Moves x along a direction, of at least as many points, to where the energy is lower, as far as it
// goes on falling, but for rounding. Lengths are of the largest shift of a coordinate. Returns whether
// there is such a point; if not x is where it was.
inline bool descend_along(Minimization& run, const std::vector<Coordinates>& direction,
                          double first_length, double longest)
{
  double largest = 0;
  for(std::size_t v = 0; v < run.number_of_vertices; ++v)
    for(double entry : direction[v])
      largest = (std::max)(largest, std::abs(entry));
  if(!(largest > 0) || !std::isfinite(largest))
    return false;
  const std::vector<Coordinates> before = run.x;
  const double start = run.report.energy.back(),
               resolution = energy_resolution(start, run.report);
  const auto energy_at = [&](double length) {
    for_each_block(run.number_of_vertices, [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v)
      {
        run.x[v] = before[v];
        add(run.x[v], length / largest, direction[v]);
      }
    });
    return run.evaluate();
  };
  double best = start - 4 * resolution, length = 0;
  for(double trial = first_length; trial > 1e-5 * std::abs(first_length) || trial < 0; )
  {
    const double energy = energy_at(trial);
    if(energy < best)
    {
      best = energy;
      length = trial;
      if(std::abs(trial) >= longest)
        break;
      trial *= 2;
    }
    else if(length != 0)
      break;
    else if(std::abs(trial) > 1e-4 * std::abs(first_length))
      trial *= 0.25;
    else
      break;
  }
  if(length != 0)
    energy_at(length);
  else
  {
    run.x = before;
    run.evaluate();
  }
  return length != 0;
}

// Looks at the second derivative where a run would end with `Status::converged`, and leaves the
// place if it is no minimum, or one that is further away than it seemed. Returns a status if the run
// is over.
inline std::optional<Status> leave_saddle(Minimization& run, int number_of_looks)
{
  using Finding = Second_look::Finding;
  static const bool is_debug = std::getenv("ENDS_DEBUG") != nullptr;
  static const int cap = std::getenv("ENDS_CAP") ? std::atoi(std::getenv("ENDS_CAP")) : 200;
  static const double noise = std::getenv("ENDS_NOISE") ? std::atof(std::getenv("ENDS_NOISE")) : 1e-3;
  if(cap == 0 || number_of_looks > 10 || !run.has_second_derivative() || run.is_at_zero())
    return Status::converged;
  const double unit = run.tolerated_decrease();
  Second_look look(run);
  Finding finding = look.begin(noise * unit);
  int steps = 0;
  for(; finding == Finding::nothing_yet && steps < cap; ++steps)
  {
    if(const auto status = run.look_on())
      return status;
    finding = look.step();
  }
  run.clear_second_derivative();
  if(is_debug)
    std::fprintf(stderr, "  look %d at %u: E %.6g steps %d finding %d curvature %.3g residual %.3g gap/tol %.3g (%.3g)\n",
      number_of_looks, run.report.iterations, run.value(), steps, int(finding), look.curvature(), look.residual(),
      look.force_along_solution() / unit, look.decrease() / unit);
  if(finding == Finding::failure)
    return Status::converged;
  const double before = run.report.energy.back();
  if(finding == Finding::negative_curvature)
  {
    const double sign = look.force_along_direction() < 0 ? -1 : 1;
    if(!descend_along(run, look.direction(), sign * 0.01 * run.diameter, run.diameter) &&
       !descend_along(run, look.direction(), -sign * 0.01 * run.diameter, run.diameter))
      return Status::converged;
  }
  else
  {
    if(look.force_along_solution() <= unit)
      return Status::converged;
    double largest = 0;
    for(const Coordinates& p : look.solution())
      for(double entry : p)
        largest = (std::max)(largest, std::abs(entry));
    descend_along(run, look.solution(), largest, largest);
  }
  if(is_debug)
    std::fprintf(stderr, "    E %.8g -> %.8g\n", before, run.value());
  run.restart_gap();
  return run.next_iterate(before - run.value());
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_LEAVE_SADDLE_H
