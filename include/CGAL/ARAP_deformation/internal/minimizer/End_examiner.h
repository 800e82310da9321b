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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_END_EXAMINER_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_END_EXAMINER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Second_look.h>
#include <CGAL/ARAP_deformation/internal/minimizer/gap_estimate.h>
#include <CGAL/ARAP_deformation/internal/parallel/largest_entry.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Looks at the second derivative where a run would end with `Status::converged`, and moves on from
// there if it is a saddle point, or if there is further to go than was estimated. What it looks at
// counts as iterations: they are limited, and can be stopped and cancelled, as all others.
class End_examiner
{
public:
  explicit End_examiner(Minimization& run) : m_run(run) {}

  // Returns the status if the run is over.
  std::optional<Status> operator()()
  {
    Report& report = m_run.report;
    if(m_run.is_at_zero())
      report.end = End::minimum;
    if(report.end == End::minimum || !m_run.options.verify_minimum ||
       !m_run.has_second_derivative())
      return Status::converged;

    if(has_no_iterations_left())
      return without_look();
    const double tolerated = m_run.tolerated_decrease(), start = m_run.value();
    m_small_gains = m_last_energy - start < 0.01 * tolerated ? m_small_gains + 1 : 0;
    Second_look look(m_run);
    auto finding = look.begin(1e-3 * tolerated);
    for(unsigned int k = 0; k < most_steps && finding == Second_look::Finding::nothing_yet; ++k)
    {
      if(has_no_iterations_left())
        break;
      finding = look.step();
      ++report.looking_iterations;
      if(const auto status = m_run.same_iterate())
        return status;
    }
    if(finding == Second_look::Finding::failure) // a lost chance, and no more
      return Status::converged;
    bool is_saddle = finding == Second_look::Finding::negative_curvature;
    if(is_saddle)
      if(const auto status = sharpen(look))
        return status;
    const double gap = look.gap();
    bool does_hold = false;
    if(gap <= tolerated)
    {
      report.end = is_saddle ? End::flat
                 : finding == Second_look::Finding::nothing_yet ? End::undecided : End::minimum;
      report.estimated_relative_gap =
        (std::max)(report.estimated_relative_gap, m_run.options.tolerance * gap / tolerated);
      if(report.end == End::undecided && has_no_iterations_left())
        return without_look();
      does_hold = !is_saddle && does_model_hold(look, tolerated);
      if(m_number_of_moves >= most_moves ||
         m_small_gains >= (is_saddle ? 2 : 1) * most_small_gains)
      {
        if(!is_saddle && !does_hold)
          report.end = End::undecided;
        return Status::converged; // the gap is as certain as it becomes
      }
    }

    bool is_lower = gap > 0 && !does_hold && descend_along(look.solution(), 1, 1, 0);
    if(!is_saddle && !is_lower)
    {
      const End end = std::exchange(report.end, End::unknown); // while it looks
      look.turn_to_solution();
      if(const auto status = sharpen(look))
        return status;
      is_saddle = look.is_curvature_negative();
      report.end = end == End::unknown        ? end
                 : is_saddle                ? End::flat
                 : has_no_iterations_left() ? End::undecided : end;
      is_lower = !is_saddle && descend_along_soft_direction(look, tolerated);
    }
    if(is_saddle)
    {
      const Array<Coordinates>& direction = look.direction();
      const double first = 0.01 * m_run.diameter /
                           largest_entry(direction.data(), direction.size());
      const double sign = look.is_along_force() ? 1 : -1;
      is_lower |= descend_along(direction, sign * first, 100 * first, relaxing_steps) ||
                  descend_along(direction, -sign * first, 100 * first, relaxing_steps);
    }
    if(!is_lower) // rounding errors are all that is left
    {
      if(report.end == End::undecided && has_no_iterations_left())
        return without_look();
      if(gap > tolerated)
        report.end = is_saddle ? End::flat : End::undecided;
      return Status::converged;
    }
    ++m_number_of_moves;
    ++(is_saddle ? report.saddles_left : report.plateaus_left);
    report.end = End::unknown;
    m_last_energy = start;
    m_run.distrust_gap();
    const std::optional<Status> status = m_run.next_iterate(start - m_run.value());
    if(status == Status::converged) // without another look: the energy is next to zero
      report.end = End::minimum;
    return status;
  }

private:
  static constexpr unsigned int most_steps = 200; // of a look
  static constexpr int most_turns = 30; // of a direction, toward the least curvature
  static constexpr unsigned int most_moves = 10; // if the gap is small
  static constexpr unsigned int most_small_gains = 2; // by moves in a row
  static constexpr int relaxing_steps = 2; // from places along a direction of negative curvature

  std::optional<Status> sharpen(Second_look& look)
  {
    for(int k = 0; k < most_turns && !has_no_iterations_left() && look.sharpen(); ++k)
    {
      ++m_run.report.looking_iterations;
      if(const auto status = m_run.same_iterate())
        return status;
    }
    return std::nullopt;
  }

  // the last one may be needed to move on
  bool has_no_iterations_left() const
  {
    return m_run.report.iterations + 1 >= m_run.options.iterations;
  }

  // An estimate of the gap that was wrong before is not believed.
  Status without_look()
  {
    m_run.report.end = End::undecided;
    return m_number_of_moves > 0 ? Status::iteration_limit : Status::converged;
  }

  // moves x
  double energy_at(const Array<Coordinates>& before,
                   const Array<Coordinates>& direction, double t)
  {
    for_each_block(m_run.number_of_vertices, [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v)
      {
        m_run.x[v] = before[v];
        add(m_run.x[v], t, direction[v]);
      }
    });
    return m_run.evaluate();
  }

  // The same after steps of local/global, which lead back into a curved valley.
  double energy_at(const Array<Coordinates>& before, const Array<Coordinates>& direction, double t,
                   int steps)
  {
    double energy = energy_at(before, direction, t);
    Array<Coordinates> step;
    for(int k = 0; k < steps; ++k)
      energy = energy_after_step(step);
    return energy;
  }

  // moves x by a step of local/global, if the solver does not fail
  double energy_after_step(Array<Coordinates>& step)
  {
    {
      Scoped_seconds global(m_run.report.seconds.global_steps);
      if(!m_run.solve(step))
        return m_run.value();
    }
    return energy_at(m_run.x, step, 1);
  }

  // Whether the model of the energy holds behind its minimum, as far from it as x is, where it has
  // the value that it has at x. If not, as in a curved valley, it does not tell what is left.
  bool does_model_hold(const Second_look& look, double tolerated)
  {
    const double value = m_run.value();
    const Array<Coordinates> before = m_run.x;
    const double change = energy_at(before, look.solution(), 2) - value;
    energy_at(before, look.solution(), 0);
    m_run.keep_energy();
    const double predicted = 4 * (look.curvature() - look.gap());
    const double error = std::abs(change - predicted);
    return error <= 0.1 * tolerated &&
           error <= (std::max)(0.2 * std::abs(predicted), 1e-3 * tolerated);
  }

  // Where the curvature is small, the model may have a minimum that the energy has not: this falls
  // further on. Goes along the direction to where the model has risen by what is tolerated, and
  // from there by steps of local/global, as long as these promise to lead below that minimum.
  bool descend_along_soft_direction(Second_look& look, double tolerated)
  {
    constexpr int least_steps = 6, most_steps_down = 40;
    const Array<Coordinates>& direction = look.direction();
    const double curvature = look.curvature_along_direction();
    double length = 0.1 * m_run.diameter / largest_entry(direction.data(), direction.size());
    if(curvature > 0)
      length = (std::min)(length, std::sqrt(tolerated / curvature));
    if(!(length > 0) || !std::isfinite(length) || !std::isfinite(curvature))
      return false;
    const double sign = look.is_along_force() ? 1 : -1;
    const Array<Coordinates> before = m_run.x;
    const double below = m_run.value() - 2 * (std::max)(look.gap(), 0.0) -
                         4 * energy_resolution(m_run.value(), m_run.report);
    Array<Coordinates> step;
    for(const double t : {sign * length, -sign * length})
    {
      double energy = energy_at(before, direction, t), fall = 0;
      for(int k = 0; k < most_steps_down && (k < least_steps || energy - below < 20 * fall); ++k)
      {
        const double last = energy;
        energy = energy_after_step(step);
        if(energy < below)
          return true;
        fall = last - energy;
      }
    }
    energy_at(before, direction, 0);
    m_run.keep_energy();
    return false;
  }

  // Moves x by a multiple of a direction to where the energy is lower, if there is such a point, as
  // far as it goes on falling when the step is doubled, or until that is `longest`. Energies are
  // compared after some steps of local/global.
  bool descend_along(const Array<Coordinates>& direction, double first, double longest,
                     int steps)
  {
    if(!std::isfinite(first))
      return false;
    const Array<Coordinates> before = m_run.x;
    double lowest = m_run.value() - 4 * energy_resolution(m_run.value(), m_run.report);
    double best = 0;
    for(double t = first; std::abs(t) > 1e-4 * std::abs(first); t *= best != 0 ? 2 : 0.25)
    {
      const double energy = energy_at(before, direction, t, steps);
      if(energy < lowest)
      {
        lowest = energy;
        best = t;
      }
      if(best != 0 && (best != t || 2 * std::abs(t) > longest))
        break;
    }
    energy_at(before, direction, best, best != 0 ? steps : 0);
    if(best == 0)
      m_run.keep_energy();
    return best != 0;
  }

  Minimization& m_run;
  unsigned int m_number_of_moves = 0;
  unsigned int m_small_gains = 0; // how many of the last moves gained next to nothing
  double m_last_energy = std::numeric_limits<double>::infinity(); // where it last moved on from
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_END_EXAMINER_H
