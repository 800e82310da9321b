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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Dynamics.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/domain/is_in_domain.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Iterate.h>
#include <CGAL/ARAP_deformation/internal/session/Region_targets.h>
#include <CGAL/ARAP_deformation/internal/session/Run.h>
#include <CGAL/ARAP_deformation/internal/session/Session_history.h>
#include <CGAL/ARAP_deformation/internal/session/Session_rules.h>
#include <CGAL/ARAP_deformation/internal/session/Time_step.h>
#include <CGAL/ARAP_deformation/internal/session/core_models.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Stands between a domain and the numeric core: keeps the region, reads the points once, runs the
// core on them, and writes them back once.
template <typename Domain>
class Session : public Session_history<Domain>
{
  using Base = Session_history<Domain>;

public:
  using typename Base::Entry;
  using typename Base::Point;
  using typename Base::simplex_descriptor;
  using typename Base::vertex_descriptor;
  using Iterate = internal::Iterate<Session>;
  using Visitor = std::function<Visitor_action(const Iterate&)>;
  using Force = typename Region_targets<Domain>::Force;

  // One type for all traits: their models are handed out for each region.
  template <typename Traits>
  Session(Domain mesh, const Traits& traits, const Session_rules& rules = {},
          const Options& options = {})
    : Base(std::move(mesh), rules, options, [traits] { return core_models(traits); })
  {}

  Outcome preprocess()
  {
    double unused = 0;
    Outcome prepared = begin(m_options, unused);
    if(prepared)
      prepared = prepare(m_options, 0, unused);
    if(prepared)
      prepared.message +=
        about_unconstrained_components(m_prepared.core().unconstrained_components());
    return prepared;
  }

  // what the last preparation led to
  const Outcome& preparation() const { return m_prepared.outcome_of_preparation(); }

  Report deform(unsigned int iterations, double tolerance, const Visitor& visitor)
  {
    Options options = m_options;
    options.iterations = iterations;
    options.tolerance = tolerance;
    Report report;
    {
      Scoped_seconds total(report.seconds.total);
      static_cast<Outcome&>(report) = perform(options, nullptr, {}, visitor, report);
    }
    return report;
  }

  // a time step with these forces
  Step_report advance(const Dynamics& dynamics, const Force& force, const Visitor& visitor)
  {
    Step_report report;
    Time_step step = {dynamics};
    static_cast<Outcome&>(report) =
      refuse_in_a_run() ? outcome(Status::in_a_run) : step.check();
    if(!report)
      return report;
    Options options = m_options;
    options.initial_guess = Initial_guess::previous;
    {
      Scoped_seconds total(report.seconds.total);
      static_cast<Outcome&>(report) = perform(options, &step, force, visitor, report);
      if(report)
      {
        Scoped_seconds seconds(report.seconds.transfer);
        m_energy = step.measure(m_prepared.rows().contents, m_prepared.positions(), report);
      }
    }
    return report;
  }

  Coordinates velocity(vertex_descriptor v) const
  {
    return m_vertices.velocity(m_vertices.find_known(v));
  }

  bool set_velocity(vertex_descriptor v, const Coordinates& velocity)
  {
    return !refuse_in_a_run() && m_vertices.set_velocity(v, velocity);
  }

  Matrix_3x3 rotation_of_vertex(vertex_descriptor v) const
  {
    const bool has_cell = m_options.cells.has_vertex_cells();
    return rotation_of_cell(has_cell, [&](const auto& region) {
      return region.find_vertex(domain(), v);
    });
  }

  Matrix_3x3 rotation_of_simplex(simplex_descriptor s) const
  {
    const bool has_cell = !m_options.cells.has_vertex_cells();
    return rotation_of_cell(has_cell && is_simplex_of(domain(), s), [&](const auto& region) {
      return region.find_simplex(domain(), s);
    });
  }

protected:
  using Base::domain;
  using Base::m_are_points_written;
  using Base::m_energy;
  using Base::m_is_in_a_run;
  using Base::m_is_region_written;
  using Base::m_options;
  using Base::m_prepared;
  using Base::m_rules;
  using Base::m_vertices;
  using Base::mend;
  using Base::mend_rest_points;
  using Base::points_of_entries;
  using Base::refuse_in_a_run;
  using Base::region_changed;
  using typename Base::Scoped_flag;
  using Base::set_points;
  using Base::takes_points;

  // whether a vertex has left the region of interest and is to return to the rest shape
  bool is_put_back(const Entry& entry) const
  {
    return m_rules.are_erased_put_back && entry.was_roi && !entry.is_roi;
  }

  void note_region_as_written()
  {
    if(!m_is_region_written)
      for(Entry& entry : m_vertices.entries())
        entry.was_roi = entry.is_roi;
    m_is_region_written = true;
  }

private:
  friend Iterate;

  // what comes before all stages
  Outcome begin(const Options& options, double& transfer)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    const Scoped_flag in_a_run(m_is_in_a_run);
    const Outcome checked = options.check();
    return checked ? take_points_of_others(transfer) : checked;
  }

  // brings all stages up to date for a run with these options and this inertia
  Outcome prepare(const Options& options, double inertia, double& preprocess)
  {
    const Scoped_flag in_a_run(m_is_in_a_run);
    Scoped_seconds seconds(preprocess);
    m_prepared.set_inertia(inertia);
    const std::size_t values = m_prepared.version_of_values();
    const Outcome prepared =
      m_prepared.prepare(m_vertices, this->m_cell_values, options, m_stages);
    if(m_prepared.version_of_values() != values)
      m_energy = this->not_a_number;
    return prepared;
  }

  // A run, or a time step with these forces.
  Outcome perform(const Options& options, Time_step* step, const Force& force,
                  const Visitor& visitor, Report& report)
  {
    const double inertia = step ? step->inertia() : 0;
    if(Outcome begun = begin(options, report.seconds.transfer); !begun)
      return begun;
    const Outcome prepared = prepare(options, inertia, report.seconds.preprocess);
    report.stages = std::exchange(m_stages, {});
    if(!prepared)
      return prepared;
    const Scoped_flag in_a_run(m_is_in_a_run); // forces and sets are functions of the user, too
    Run run = [&] {
      Scoped_seconds seconds(report.seconds.transfer);
      return Run(m_prepared.built(), m_prepared.rows(), report);
    }();
    const Region_targets<Domain> reader(m_vertices, m_prepared);
    {
      Scoped_seconds seconds(report.seconds.transfer);
      Outcome begun = reader.read(run.positions, run.targets);
      if(begun && step)
        begun = reader.begin(*step, force, run.positions, run.targets);
      if(!begun)
        return begun;
    }
    Outcome result = execute(run, options, visitor, report);
    if(result)
    {
      add_remarks(result, report, options, m_prepared.roi_size() == 0,
                  inertia == 0 && m_prepared.number_of_controls() == 0,
                  m_prepared.rows().isolated_controls);
      Scoped_seconds seconds(report.seconds.transfer);
      finish(run, step ? reader.velocities_after(*step, run.positions) : Array<Coordinates>(),
             report);
    }
    return result;
  }

  Outcome execute(Run& run, const Options& options, const Visitor& visitor, Report& report)
  {
    const auto observe = [&](unsigned int iteration, double energy) {
      return visitor(Iterate(*this, run.positions, iteration, energy));
    };
    Outcome result = run.run(options, observe, report);
    if(result.status == Status::converged && m_rules.order == Minimization_order::global_first)
      result.message = "the energy changed by less than the tolerance in an iteration";
    return result;
  }

  // takes over what a run has led to
  void finish(Run& run, Array<Coordinates> velocities, Report& report)
  {
    write_points(run.positions);
    m_vertices.velocities().swap(velocities);
    run.finish(report);
    m_prepared.run_has_ended();
    m_energy = report.energy.back();
  }

  // Points that others have moved are where the run starts, or fixed there: undo by writing back
  // old points, for example.
  Outcome take_points_of_others(double& transfer)
  {
    Scoped_seconds seconds(transfer);
    if(!m_prepared.is_up_to_date() && !m_rules.are_erased_put_back)
      mend_rest_points();
    if(!takes_points())
      return outcome(Status::success);
    std::vector<std::pair<std::size_t, Point>> changed = m_vertices.changed_points();
    for(const auto& [k, point] : changed)
      if(const Entry& entry = m_vertices.entries()[k];
         entry.is_roi && !is_finite(Domain::coordinates(point)))
        return outcome_of_vertex(Status::non_finite_point, domain().index(entry.vertex));
    for(auto& [k, point] : changed) // one after the other: a copy that throws leaves the others
    {
      if(mend(m_vertices.entries()[k], point))
        region_changed();
      m_prepared.set_position(k, Domain::coordinates(point));
      m_vertices.present_points()[k] = std::move(point);
    }
    m_prepared.read_surroundings(m_vertices);
    return outcome(Status::success);
  }

  void write_points(Array<Coordinates>& positions)
  {
    std::vector<Point> points = new_points(positions);
    const auto write = [this](const auto& vertex, const Point& point) {
      domain().set_point(vertex, point);
    };
    const bool are_all_there = m_are_points_written || m_rules.are_erased_put_back;
    set_points([&] {
      for_each_written_vertex(points, write);
      if(!are_all_there) // what has left the region since may be where a failed call put it
        for(std::size_t k = 0; k < points.size(); ++k)
          if(const Entry& entry = m_vertices.entries()[k]; !entry.is_roi)
            write(entry.vertex, points[k]);
    });
    m_vertices.present_points().swap(points);
    note_region_as_written();
    m_prepared.positions().swap(positions);
  }

  // The new points of all entries: a free vertex is at its position, a hard control vertex at its
  // target, what is put back at its rest point, and all others stay.
  std::vector<Point> new_points(const Array<Coordinates>& positions) const
  {
    const std::vector<Point>& present = m_vertices.present_points();
    const Array<char>& is_fixed = m_prepared.core().constraints().is_fixed;
    const auto number_of_movable = static_cast<int>(is_fixed.size());
    return points_of_entries([&](std::size_t k, const Entry& entry) {
      if(!entry.is_roi)
        return is_put_back(entry) ? entry.rest : present[k];
      if(m_vertices.is_hard_control(entry))
        return m_vertices.target(entry);
      const int v = m_prepared.number_of_entry(k);
      return v >= 0 && v < number_of_movable && !is_fixed[v] ? Domain::make_point(positions[v])
                                                             : present[k];
    });
  }

  // Calls f(v, point) for each vertex that a run writes, also where it stays: a domain may write to
  // other places than it reads from.
  template <typename Function>
  void for_each_written_vertex(const std::vector<Point>& points, const Function& f) const
  {
    for(std::size_t k = 0; k < points.size(); ++k)
      if(const Entry& entry = m_vertices.entries()[k]; entry.is_roi || is_put_back(entry))
        f(entry.vertex, points[k]);
  }

  template <typename FindCell>
  Matrix_3x3 rotation_of_cell(bool has_cell, const FindCell& find_cell) const
  {
    return has_cell && m_prepared.has_region() ? m_prepared.rotation_of_cell(find_cell)
                                               : identity_matrix();
  }

  Stages m_stages; // since the last run
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_H
