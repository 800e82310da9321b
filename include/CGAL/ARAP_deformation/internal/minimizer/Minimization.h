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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZATION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZATION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Default_visitor.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_metric.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Observer.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/minimizer/gap_estimate.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// What all minimizers have in common: the energy that is minimized, the rigidity and the pull of
// the constraints; the local step, the solution for the global step, and what is observed, reported
// and tested after each iteration. Forces and steps are those of all movable vertices, the first
// ones; they are zero where a vertex is fixed.
class Minimization
{
public:
  Array<Coordinates>& x;
  const std::size_t number_of_vertices; // that are movable
  Report& report;
  const Options& options;
  double force_error = 0; // the rounding error of the force at a vertex
  double diameter = 0;    // of positions and targets

  Minimization(Deformation_energy& energy, const Closest_rotations& closest_rotations,
               Constrained_system& system, const Constraints& constraints, const Options& options_,
               const Observer& observe, const Region& region, Targets& targets,
               Array<Coordinates>& x_, Array<Matrix_3x3>& rotations,
               std::unique_ptr<Coarse_metric>& coarse_metric, Report& report_)
    : x(x_), number_of_vertices(constraints.is_fixed.size()), report(report_), options(options_),
      m_energy(energy), m_closest_rotations(closest_rotations), m_system(system),
      m_constraints(constraints), m_observe(observe), m_region(region), m_targets(targets),
      m_rotations(rotations), m_coarse_metric(coarse_metric)
  {
    for(std::size_t v = 0; v < number_of_vertices; ++v)
      if(constraints.is_fixed[v])
        m_fixed_vertices.push_back(v);
    if(m_energy.are_rotations_state())
      m_last_rotations = m_rotations;
    measure();
  }

  // the energy at x with the rotations fitted to x; without its force that takes less time
  double evaluate(bool is_force_needed = true)
  {
    Scoped_seconds local(report.seconds.local_steps);
    if(m_energy.are_rotations_state()) // each trial starts from those of the last iterate
      m_rotations = m_last_rotations;
    m_system.hard_rows().correct(m_targets.hard, x); // steps have rounding errors
    return complete(m_energy.fit_and_evaluate(m_closest_rotations, x, m_rotations,
                                              is_force_needed ? &m_force : nullptr));
  }

  // x is back at the last iterate, up to rounding errors: these, and those of a fit that started
  // from other rotations, do not raise the energy.
  void keep_energy() { m_value = (std::min)(m_value, report.energy.back()); }

  // the energy at x with the current rotations
  double evaluate_without_fit()
  {
    Scoped_seconds local(report.seconds.local_steps);
    return complete(m_energy.evaluate(x, m_rotations, m_force));
  }

  enum class Start { taken, rejected, failed }; // where the solver fails

  // Replaces x by the solution of the global step with the rotations that a function sets, but for
  // vertices that are placed; if `is_tried` only where that lowers the energy.
  template <typename Function>
  Start start_with(const Function& set_rotations, const std::vector<char>& is_placed, bool is_tried)
  {
    Array<Coordinates> step;
    const double energy = is_tried ? evaluate() : 0;
    const Array<Matrix_3x3> last_rotations = m_last_rotations;
    set_rotations(m_rotations); // others are fitted anew
    m_energy.clear_others(m_rotations);
    evaluate_without_fit();
    {
      Scoped_seconds seconds(report.seconds.initial_guess);
      if(!solve(step))
        return Start::failed;
    }
    Array<Coordinates>& before = step;
    for(std::size_t v = 0; v < number_of_vertices; ++v)
    {
      const Coordinates last = x[v];
      if(!is_placed[v])
        add(x[v], 1, step[v]);
      before[v] = last;
    }
    keep_rotations();
    if(is_tried && !(evaluate() < energy))
    {
      std::copy(before.begin(), before.end(), x.begin());
      m_last_rotations = last_rotations;
      return Start::rejected;
    }
    m_targets.project(m_constraints.rows, x);
    measure();
    return Start::taken;
  }

  // Replaces x by other positions, with rotations that are fitted to these alone, unless that makes
  // the energy rise. Returns whether they were taken. Rises within rounding count as none, so that
  // rounding does not decide between equal positions.
  bool try_positions(Array<Coordinates> other)
  {
    const double energy = evaluate();
    Array<Matrix_3x3> fitted = m_rotations;
    x.swap(other);
    m_energy.fit_and_evaluate(m_closest_rotations, x, m_rotations, nullptr, false);
    keep_rotations();
    const bool is_no_higher =
      evaluate_without_fit() <= energy + energy_resolution(energy, report);
    if(!is_no_higher)
    {
      x.swap(other);
      m_rotations.swap(fitted);
      keep_rotations();
      m_targets.project(m_constraints.rows, x);
    }
    measure();
    return is_no_higher;
  }

  const Array<Coordinates>& rest() const { return m_region.rest; }
  bool is_nothing_free() const { return m_fixed_vertices.size() == number_of_vertices; }

  // minus half the gradient where the energy was last evaluated with it
  const Array<Coordinates>& force() const { return m_force; }

  // Whether the second derivative is known. Smooth rotations depend on each other. A time step has
  // no need of it: it is short, and inertia makes its energy convex.
  bool has_second_derivative() const
  {
    return !m_energy.are_rotations_state() && m_constraints.inertia == 0;
  }

  // to be called before change_of_force(), when x was evaluated last
  void prepare_second_derivative()
  {
    Scoped_seconds local(report.seconds.local_steps);
    m_energy.prepare_second_derivative(x, m_rotations);
  }

  // How the force changes if x changes by a step, to first order. The step is as long as x, and
  // zero but at free vertices. Sets that targets are projected onto are differentiated numerically.
  void change_of_force(const Array<Coordinates>& step, Array<Coordinates>& change)
  {
    Scoped_seconds local(report.seconds.local_steps);
    m_energy.change_of_force(step, m_rotations, change);
    Array<Coordinates> targets(m_targets.soft.size(), Coordinates{0, 0, 0});
    for(const Targets::Set& set : m_targets.sets)
    {
      Coordinates moved = m_constraints.rows.value(set.row, x.data());
      const Coordinates value = m_constraints.rows.value(set.row, step.data());
      const double length = std::sqrt(dot(value, value));
      if(!(length > 0))
        continue;
      const auto r = static_cast<std::size_t>(set.row);
      double largest = diameter; // coordinate, which tells the rounding error
      for(double c : moved)
        largest = (std::max)(largest, std::abs(c));
      const double h = std::sqrt(m_targets.precision * largest * diameter) / length;
      add(moved, h, value);
      targets[r] = scaled(difference(set.projection(moved), m_targets.soft[r]), 1 / h);
    }
    m_constraints.rows.pull(targets, step, change);
    leave_free(change);
  }

  void clear_second_derivative() { m_energy.clear_second_derivative(); }

  // leaves forces only where a step can follow them
  void leave_free(Array<Coordinates>& force) const
  {
    for(std::size_t v : m_fixed_vertices)
      force[v] = {0, 0, 0};
    if(m_region.is_planar)
      for(Coordinates& f : force)
        f[2] = 0;
    m_system.hard_rows().leave_out_multipliers(force);
  }

  // Completes the metric of the Laplacian for the positions x, which were evaluated last. None for
  // few vertices, for which it costs more than it saves, and where it would not be definite.
  Coarse_metric* build_coarse_metric()
  {
    constexpr std::size_t least_vertices = 30000;
    if(!options.coarse_metric ||
       number_of_vertices - m_fixed_vertices.size() < least_vertices ||
       !has_second_derivative() || !is_zero_least() ||
       !m_system.hard_rows().is_empty())
      return nullptr;
    const Sparse_matrix& laplacian = m_system.laplacian().matrix;
    if(!m_coarse_metric)
      m_coarse_metric = std::make_unique<Coarse_metric>(m_energy, laplacian, m_region.rest);
    if(!m_coarse_metric->is_of_use())
      return nullptr;
    const bool has_rows = m_constraints.rows.size() > 0;
    const Sparse_matrix own = has_rows ? m_system.with_rows(m_constraints.rows) : Sparse_matrix();
    return m_coarse_metric->build(m_energy, has_rows ? own : laplacian, m_constraints.is_fixed, x,
                                  m_rotations) ? m_coarse_metric.get() : nullptr;
  }

  double value() const { return m_value; } // that was evaluated last

  // Computes the local/global step, the solution of L step = force.
  bool solve(Array<Coordinates>& step) { return solve_for(m_force, step); }

  // the same for other forces
  bool solve_for(const Array<Coordinates>& force, Array<Coordinates>& step)
  {
    if(is_nothing_free()) // there is no factor
    {
      step.assign(force.size(), Coordinates{0, 0, 0});
      return true;
    }
    step.resize(force.size());
    for_each_block(force.size(), [&](std::size_t begin, std::size_t end) {
      std::copy(force.data() + begin, force.data() + end, step.data() + begin);
    });
    return m_system.solve(step);
  }

  // By how much the energy has decreased by a step s since the last iterate. Near the minimum the
  // difference of the energies is lost in rounding, and the products of s with the forces before
  // and after it are not; they are computed by the functions.
  template <typename Before, typename After>
  double decrease(const Before& force_before, const After& force_after) const
  {
    const double difference = report.energy.back() - m_value;
    const double rounding = energy_resolution(m_value, report);
    return difference > 1e5 * rounding || !is_finite(m_value)
         ? difference : force_before() + force_after();
  }

  // whether the energy last evaluated is above that of the last iterate; not if it has overflowed,
  // by which a run ends
  bool is_higher() const
  {
    const double before = report.energy.back();
    return is_finite(m_value) && m_value > before + energy_resolution(before, report);
  }

  // Whether it is higher by far more than rounding errors: what the solver returns is nothing like
  // the solution, which lowers it.
  bool is_far_higher() const
  {
    const double before = report.energy.back();
    return m_value > before + 1e-2 * std::abs(before) + 1e4 * energy_resolution(before, report);
  }

  // Whether a solution x of L x = f leads uphill, as no right one does: f x is below zero by more
  // than is tolerated, and than rounding errors.
  bool is_uphill(double f_x) const
  {
    return -f_x > tolerated_decrease() + energy_resolution(report.energy.back(), report);
  }

  // Makes x the next iterate, reached by the given decrease of the energy, or the first one.
  // Returns a status if the run is over.
  std::optional<Status> next_iterate(double decrease = 0)
  {
    if(!report.energy.empty())
    {
      ++report.iterations;
      m_gap.add(decrease, report);
    }
    report.energy.push_back(m_value);
    keep_rotations();
    if(!is_finite(m_value))
      return Status::non_finite_energy;
    estimate_gap();
    const bool is_power_of_two = (report.iterations & (report.iterations - 1)) == 0;
    if(is_within_tolerance() || (report.iterations > 4 && is_power_of_two))
    {
      measure(); // the run may have come from far away
      estimate_gap();
    }
    if(is_within_tolerance())
      report.estimated_relative_gap += gap_of_rotations();

    if(const auto status = observe())
      return status;
    if(is_within_tolerance())
      return Status::converged;
    if(report.iterations == options.iterations)
      return Status::iteration_limit;
    return std::nullopt;
  }

  // Counts an iteration that moved nothing; x is the iterate.
  std::optional<Status> same_iterate()
  {
    ++report.iterations;
    report.energy.push_back(report.energy.back());
    return observe();
  }

  // Where the estimate of the gap was wrong, it is made anew from the decreases to come, and
  // believed when it is this much less.
  void distrust_gap()
  {
    m_gap = Gap_estimate();
    m_trust *= 0.25;
  }

  // whether no energy is below zero
  bool is_zero_least() const { return m_system.laplacian().is_sum_of_squares; }

  // whether there is nothing to be gained, or no more than strains of a millionth give
  bool is_at_zero() const
  {
    return is_nothing_free() ||
           (is_zero_least() &&
            std::abs(m_value) <= (std::max)(negligible_energy(report), 1e-12 * m_energy.scale()));
  }

  // what may be left to be gained where a run ends
  double tolerated_decrease() const
  {
    return options.tolerance * (std::max)(std::abs(m_value), negligible_energy(report));
  }

private:
  // as those of the last iterate
  void keep_rotations()
  {
    if(m_energy.are_rotations_state())
      m_last_rotations = m_rotations;
  }

  std::optional<Status> observe()
  {
    const Visitor_action action = [this] {
      Scoped_seconds visitor(report.seconds.visitor);
      return m_observe(report.iterations, report.energy.back());
    }();
    if(action == Visitor_action::proceed)
      return std::nullopt;
    return action == Visitor_action::stop ? Status::stopped : Status::cancelled;
  }

  // Adds the pull of the rows to the rigidity, and leaves forces at free vertices only. The squared
  // distance from a set has the gradient of that from the projection, which is the target.
  double complete(double rigidity)
  {
    m_targets.project(m_constraints.rows, x);
    m_value = rigidity + m_constraints.rows.pull(m_targets.soft, x, m_force);
    leave_free(m_force);
    return m_value;
  }

  // the scales that rounding is judged by, at the present positions
  void measure()
  {
    Scoped_seconds local(report.seconds.local_steps);
    Bounding_box box = m_energy.bounding_box(x);
    box.include(m_constraints.rows.places(m_targets.soft, x));
    report.energy_scale = m_energy.scale(box);
    report.rounding_level = m_energy.rounding_level(box, m_constraints.inertia);
    diameter = std::sqrt(box.squared_length());
    force_error = m_energy.rounding_error_of_force(box, m_constraints.inertia);
  }

  void estimate_gap()
  {
    report.estimated_relative_gap = is_nothing_left() ? 0 : m_gap(m_value, report);
  }

  // What rotations that are state can still gain: they may creep, which the energies do not tell.
  double gap_of_rotations()
  {
    const double gain = m_energy.gain_of_rotation_step(x, m_rotations);
    return gain > report.rounding_level
             ? gain / (std::max)(std::abs(m_value), negligible_energy(report)) : 0;
  }

  // whether neither a vertex is free nor are rotations: where they are state they take several fits
  bool is_nothing_left() const { return is_nothing_free() && !m_energy.are_rotations_state(); }

  bool is_within_tolerance() const
  {
    return is_nothing_left() ||
           (options.tolerance > 0 &&
            report.estimated_relative_gap <= m_trust * options.tolerance);
  }

  Deformation_energy& m_energy;
  const Closest_rotations& m_closest_rotations;
  Constrained_system& m_system;
  const Constraints& m_constraints;
  std::vector<std::size_t> m_fixed_vertices; // of the movable ones
  const Observer& m_observe;
  const Region& m_region;
  Targets& m_targets;
  Array<Matrix_3x3>& m_rotations;
  std::unique_ptr<Coarse_metric>& m_coarse_metric;
  Array<Matrix_3x3> m_last_rotations; // of the last iterate, if the fit depends on them
  Array<Coordinates> m_force;
  double m_value = 0;
  Gap_estimate m_gap;
  double m_trust = 1; // in this estimate
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZATION_H
