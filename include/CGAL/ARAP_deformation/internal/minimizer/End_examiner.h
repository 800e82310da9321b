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
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Pseudorandom_vectors.h>
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

namespace CGAL {
namespace ARAP {
namespace internal {

// Looks at the second derivative where a run would end with `Status::converged`, and moves on from
// there if it is a saddle point, or if there is further to go than was estimated. Each step of a
// look, and each step of local/global that it tries, counts as an iteration: these are limited, and
// can be stopped and cancelled, as all others.
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
    m_is_cut_off = has_no_iterations_left();
    if(m_is_cut_off)
      return finish(End::undecided);

    const double tolerated = m_run.tolerated_decrease(), start = m_run.value();
    m_small_gains = m_last_energy - start < 0.01 * tolerated ? m_small_gains + 1 : 0;
    if(!m_disturbance)
      m_disturbance.emplace(m_run.rest(), m_run.number_of_vertices);
    Second_look look(m_run, *m_disturbance);
    const Second_look::Finding finding = search(look, 1e-3 * tolerated);
    const bool is_convex = finding != Second_look::Finding::negative_curvature;
    if(!is_convex)
    {
      look.turn_to_direction();
      sharpen(look, most_turns_at_saddle);
    }
    if(m_interruption)
      return interrupted(!is_convex || look.gap() > tolerated);
    if(finding == Second_look::Finding::failure) // a lost chance, and no more
      return Status::converged;

    Array<Coordinates> iterate = m_run.x;
    const double gap = look.gap();
    const bool is_gap_small = gap <= tolerated;
    End end = End::undecided;
    if(finding == Second_look::Finding::positive_curvature && is_gap_small)
      end = End::minimum;
    else if(!is_convex && look.is_curvature_negative()) // and not zero
      end = End::flat;
    bool does_hold = false;
    if(is_gap_small)
    {
      report.estimated_relative_gap =
        (std::max)(report.estimated_relative_gap, m_run.options.tolerance * gap / tolerated);
      if(end == End::undecided && m_is_cut_off)
        return finish(end);
      does_hold = is_convex && does_model_hold(iterate, look, tolerated);
      if(m_number_of_moves >= most_moves ||
         m_small_gains >= (is_convex ? 1 : 2) * most_small_gains)
        return finish(!is_convex || does_hold ? end : End::undecided); // as certain as it becomes
    }
    const bool is_lower = descend(iterate, look, is_convex, gap > 0 && !does_hold, tolerated, end);
    if(m_interruption)
    {
      return_to(iterate);
      return interrupted(!is_convex || !is_gap_small);
    }
    if(!is_lower) // rounding errors are all that is left
      return finish(end);
    ++(end == End::flat ? report.saddles_left : report.plateaus_left);
    return move_on(start);
  }

private:
  static constexpr unsigned int most_steps = 200; // of a look
  static constexpr int most_turns = 30; // of a direction, toward the least curvature
  static constexpr int most_turns_at_saddle = 10; // where any negative curvature will do
  static constexpr unsigned int most_moves = 10; // if the gap is small
  static constexpr unsigned int most_small_gains = 2; // by moves in a row

  // the last one may be needed to move on
  bool has_no_iterations_left() const
  {
    return m_run.report.iterations + 1 >= m_run.options.iterations;
  }

  // Nothing lower was found. Where that may be for lack of iterations, an estimate of the gap that
  // was wrong is not believed.
  Status finish(End end)
  {
    Report& report = m_run.report;
    if(m_is_cut_off && (end == End::flat || m_number_of_moves > 0))
    {
      report.estimated_relative_gap = std::numeric_limits<double>::infinity();
      return Status::iteration_limit;
    }
    report.end = m_is_cut_off ? End::undecided : end;
    return Status::converged;
  }

  // The visitor has stopped the look. An estimate of the gap that it has refuted is not believed.
  std::optional<Status> interrupted(bool is_refuted)
  {
    if(is_refuted || m_number_of_moves > 0)
      m_run.report.estimated_relative_gap = std::numeric_limits<double>::infinity();
    return m_interruption;
  }

  // Counts an iteration that looked, and moved nothing.
  void count_look()
  {
    ++m_run.report.looking_iterations;
    m_interruption = m_run.same_iterate();
  }

  // The same where x is not the iterate.
  void count_trial(Array<Coordinates>& iterate)
  {
    m_run.x.swap(iterate);
    count_look();
    m_run.x.swap(iterate);
  }

  // to be asked where there is more to do
  bool goes_on()
  {
    m_is_cut_off = has_no_iterations_left();
    return !m_interruption && !m_is_cut_off;
  }

  Second_look::Finding search(Second_look& look, double disturbance)
  {
    auto finding = look.begin(disturbance);
    for(unsigned int k = 0;
        k < most_steps && finding == Second_look::Finding::nothing_yet && goes_on(); ++k)
    {
      finding = look.step();
      count_look();
    }
    return finding;
  }

  void sharpen(Second_look& look, int turns)
  {
    for(int k = 0; k < turns && goes_on() && look.sharpen(); ++k)
      count_look();
  }

  // moves x
  double energy_at(const Array<Coordinates>& before, const Array<Coordinates>& direction, double t)
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

  // makes x what it was before, to the last bit
  void return_to(const Array<Coordinates>& positions)
  {
    std::copy(positions.begin(), positions.end(), m_run.x.begin());
    m_run.evaluate();
    std::copy(positions.begin(), positions.end(), m_run.x.begin());
    m_run.keep_energy();
  }

  // Moves x to where the energy is lower, if there is such a point: to the minimum of the model, if
  // that may be one, or along the direction of least curvature. If this curvature turns out to be
  // negative, `end` becomes flat.
  bool descend(Array<Coordinates>& iterate, Second_look& look, bool is_convex,
               bool may_be_at_solution, double tolerated, End& end)
  {
    const bool is_at_solution =
      may_be_at_solution && descend_along(iterate, look.solution(), 1, 1, 0);
    if(is_convex && is_at_solution)
      return true;
    if(is_convex)
    {
      look.turn_to_solution();
      sharpen(look, most_turns);
      if(!look.is_curvature_negative())
        return descend_along_soft_direction(iterate, look, tolerated);
      end = End::flat;
    }
    return descend_from_saddle(iterate, look) || is_at_solution;
  }

  // makes x the next iterate; `start` is the energy of the last one
  std::optional<Status> move_on(double start)
  {
    ++m_number_of_moves;
    m_last_energy = start;
    m_run.distrust_gap();
    const std::optional<Status> status = m_run.next_iterate(start - m_run.value());
    if(status == Status::converged) // without another look: the energy is next to zero
      m_run.report.end = m_run.is_zero_least() ? End::minimum : End::undecided;
    return status;
  }

  // Whether the model of the energy holds behind its minimum, as far from it as x is, where it has
  // the value that it has at x. If not, as in a curved valley, it does not tell what is left.
  bool does_model_hold(const Array<Coordinates>& iterate, const Second_look& look, double tolerated)
  {
    const double value = m_run.value();
    const double change = energy_at(iterate, look.solution(), 2) - value;
    return_to(iterate);
    const double predicted = 4 * (look.curvature() - look.gap());
    const double error = std::abs(change - predicted);
    return error <= 0.1 * tolerated &&
           error <= (std::max)(0.2 * std::abs(predicted), 1e-3 * tolerated);
  }

  // Where the curvature is small, the model may have a minimum that the energy lacks: the energy
  // keeps falling. Goes along the direction until the model has risen by the tolerance, and from
  // there by steps of local/global, as long as these promise to lower the energy by twice the gap
  // of the model and a hundredth of the tolerance. Where this helped, in slit tubes, curvatures
  // were at most 0.0085 of that of the Laplacian, and with a coarse metric four to five times as
  // much. With one, any curvature qualifies: shapes large enough to have it are soft.
  bool descend_along_soft_direction(Array<Coordinates>& iterate, Second_look& look,
                                    double tolerated)
  {
    constexpr double largest_curvature = 0.03;
    constexpr int least_steps = 6, most_steps_down = 40;
    if(!look.has_coarse_metric() && look.relative_curvature() > largest_curvature)
      return false;
    const Array<Coordinates>& direction = look.direction();
    const double curvature = look.curvature_along_direction();
    double length = 0.1 * m_run.diameter / largest_entry(direction.data(), direction.size());
    if(curvature > 0)
      length = (std::min)(length, std::sqrt(tolerated / curvature));
    if(!(length > 0) || !is_finite(length) || !is_finite(curvature))
      return false;
    const double sign = look.is_along_force() ? 1 : -1;
    Array<Coordinates> step;
    const double below = m_run.value() - (std::max)(2 * look.gap(), 0.01 * tolerated) -
                         4 * energy_resolution(m_run.value(), m_run.report);
    for(const double t : {sign * length, -sign * length})
    {
      double energy = energy_at(iterate, direction, t), fall = 0;
      for(int k = 0;
          k < most_steps_down && (k < least_steps || energy - below < 20 * fall) && goes_on(); ++k)
      {
        const double last = energy;
        energy = energy_after_step(step);
        if(energy < below)
          return true;
        count_trial(iterate);
        fall = last - energy;
      }
    }
    return_to(iterate);
    return false;
  }

  bool descend_from_saddle(Array<Coordinates>& iterate, Second_look& look)
  {
    constexpr int relaxing_steps = 2; // they lead back into a curved valley
    const Array<Coordinates>& direction = look.direction();
    const double first = 0.01 * m_run.diameter /
                         largest_entry(direction.data(), direction.size());
    const double sign = look.is_along_force() ? 1 : -1;
    return descend_along(iterate, direction, sign * first, 100 * first, relaxing_steps) ||
           descend_along(iterate, direction, -sign * first, 100 * first, relaxing_steps);
  }

  // Moves x by a multiple of a direction to where the energy is lower, if there is such a point, as
  // far as it goes on falling when the step is doubled, or until that is `longest`. Energies are
  // compared after some steps of local/global.
  bool descend_along(Array<Coordinates>& iterate, const Array<Coordinates>& direction, double first,
                     double longest, int steps)
  {
    if(!is_finite(first))
      return false;
    const Array<Coordinates> before = m_run.x;
    Array<Coordinates> lowest, step;
    double lowest_energy = m_run.value() - 4 * energy_resolution(m_run.value(), m_run.report);
    for(double t = first; std::abs(t) > 1e-4 * std::abs(first) && (steps == 0 || goes_on());
        t *= lowest.empty() ? 0.25 : 2)
    {
      double energy = energy_at(before, direction, t);
      for(int k = 0; k < steps && goes_on(); ++k)
      {
        energy = energy_after_step(step);
        count_trial(iterate);
      }
      const bool is_lowest = energy < lowest_energy;
      if(is_lowest)
      {
        lowest_energy = energy;
        lowest = m_run.x;
      }
      if(!lowest.empty() && (!is_lowest || 2 * std::abs(t) > longest))
        break;
    }
    const bool is_lower = !lowest.empty();
    return_to(is_lower ? lowest : before);
    return is_lower;
  }

  Minimization& m_run;
  std::optional<Pseudorandom_vectors> m_disturbance; // once a look needs it
  std::optional<Status> m_interruption; // by the visitor
  bool m_is_cut_off = false; // a look, for lack of iterations
  unsigned int m_number_of_moves = 0;
  unsigned int m_small_gains = 0; // how many of the last moves gained next to nothing
  double m_last_energy = std::numeric_limits<double>::infinity(); // where it last moved on from
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_END_EXAMINER_H
