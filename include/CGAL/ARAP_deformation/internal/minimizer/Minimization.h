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
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/minimizer/gap_estimate.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// `observe(k, E_k)` is called after iteration k, and after the initial evaluation with k = 0. Its
// type is erased: what a mesh and its visitor are makes no difference here, and costs no compile
// time.
using Observer = std::function<Visitor_action(unsigned int, double)>;

// What all minimizers have in common: the local step, the solution for the global step, and what is
// observed, reported and tested after each iteration. The solver holds the factorized Laplacian L
// of the first `number_of_free_vertices` vertices.
template <typename ClosestRotation, typename Solver>
class Minimization
{
public:
  std::vector<Coordinates>& x;
  const std::size_t number_of_free_vertices;
  Report& report;
  double force_error; // the rounding error of the force at a vertex
  double diameter;    // of positions and targets

  Minimization(Deformation_energy& energy, const ClosestRotation& closest_rotation, Solver& solver,
               std::size_t number_of_free_vertices_, const Options& options,
               const Observer& observe, const std::vector<Coordinates>& soft_targets,
               std::vector<Coordinates>& x_,
               std::vector<Matrix_3x3>& rotations, Report& report_)
    : x(x_), number_of_free_vertices(number_of_free_vertices_), report(report_),
      m_energy(energy), m_closest_rotation(closest_rotation), m_solver(solver),
      m_options(options), m_observe(observe), m_soft_targets(soft_targets), m_rotations(rotations)
  {
    Bounding_box box;
    box.include(x);
    box.include(soft_targets);
    report.energy_scale = energy.scale(box);
    report.rounding_level = energy.rounding_level(box);
    diameter = std::sqrt(box.squared_length());
    force_error = energy.rounding_error_of_force(box);
  }

  // the energy at x with the rotations fitted to x
  double evaluate()
  {
    Scoped_seconds local(report.seconds.local_steps);
    return m_value = m_energy.evaluate(m_closest_rotation, x, m_rotations, m_force,
                                        m_soft_targets);
  }

  // minus half the gradient where the energy was last evaluated
  const std::vector<Coordinates>& force() const { return m_force; }

  // Computes the local/global step, the solution of L step = force.
  bool solve(std::vector<Coordinates>& step)
  {
    step.assign(m_force.begin(), m_force.begin() + number_of_free_vertices);
    return m_solver.solve(number_of_free_vertices, step.data());
  }

  // By how much the energy has decreased by a step s since the last iterate. Near the minimum the
  // difference of the energies is lost in rounding, and the products of s with the forces before
  // and after it are not; they are computed by the functions.
  template <typename Before, typename After>
  double decrease(const Before& force_before, const After& force_after) const
  {
    const double difference = report.energy.back() - m_value;
    const double rounding = energy_resolution(m_value, report);
    return difference > 1e5 * rounding || !std::isfinite(m_value)
         ? difference : force_before() + force_after();
  }

  // whether the energy last evaluated is not above that of the last iterate
  bool is_not_higher() const
  {
    const double before = report.energy.back();
    return m_value <= before + energy_resolution(before, report);
  }

  // Makes x the next iterate, reached by the given decrease of the energy, or the first one.
  // Returns a status if the run is over.
  std::optional<Status> next_iterate(double decrease = 0)
  {
    if(report.energy.empty())
      m_gap = Gap_estimate(report.rounding_level);
    else
    {
      ++report.iterations;
      m_gap.add(decrease);
    }
    report.energy.push_back(m_value);
    if(!std::isfinite(m_value))
      return Status::non_finite_energy;
    if(is_far_higher())
      return Status::solver_failed;
    const bool is_nothing_free = number_of_free_vertices == 0; // then there is nothing to solve
    report.estimated_relative_gap = is_nothing_free ? 0 : m_gap(m_value);

    switch(m_observe(report.iterations, m_value))
    {
    case Visitor_action::stop: return Status::stopped;
    case Visitor_action::cancel: return Status::cancelled;
    case Visitor_action::proceed: break;
    }
    if(is_nothing_free || (m_options.tolerance > 0 &&
                           report.estimated_relative_gap <= m_options.tolerance))
      return Status::converged;
    if(report.iterations == m_options.iterations)
      return Status::iteration_limit;
    return std::nullopt;
  }

private:
  // Whether the last iterate's energy has risen by far more than rounding errors: what the solver
  // returns is nothing like the solution, which lowers it.
  bool is_far_higher() const
  {
    if(report.iterations == 0)
      return false;
    const double before = report.energy[report.iterations - 1];
    return m_value > before + 1e-2 * std::abs(before) + 1e4 * energy_resolution(before, report);
  }

  Deformation_energy& m_energy;
  const ClosestRotation& m_closest_rotation;
  Solver& m_solver;
  const Options& m_options;
  const Observer& m_observe;
  const std::vector<Coordinates>& m_soft_targets;
  std::vector<Matrix_3x3>& m_rotations;
  std::vector<Coordinates> m_force;
  double m_value = 0;
  Gap_estimate m_gap;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_MINIMIZATION_H
