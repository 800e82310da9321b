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

#include <CGAL/ARAP_deformation/Default_visitor.h>
#include <CGAL/ARAP_deformation/Dynamics.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/minimizer/rigid_start.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/Svd_rotation.h>
#include <CGAL/ARAP_deformation/internal/session/Cell_values.h>
#include <CGAL/ARAP_deformation/internal/session/Iterate.h>
#include <CGAL/ARAP_deformation/internal/session/Prepared_region.h>
#include <CGAL/ARAP_deformation/internal/session/Session_rules.h>
#include <CGAL/ARAP_deformation/internal/session/Session_vertices.h>
#include <CGAL/ARAP_deformation/internal/session/Time_step.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Domain>
using Call_is_simplex = decltype(std::declval<const Domain&>().is_simplex(
  std::declval<const typename Domain::simplex_descriptor&>()));

// Stands between a domain and the numeric core: keeps the region, reads the points once, runs the
// core on them, and writes them back once.
template <typename Domain, typename Traits>
class Session
{
public:
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using simplex_descriptor = typename Domain::simplex_descriptor;
  using Point = typename Domain::Point;
  using Vertices = Session_vertices<Domain>;

  using Entry = typename Vertices::Entry;
  using Iterate = internal::Iterate<Session>;

  // Options that are out of range are refused by what uses them.
  Session(Domain domain, const Traits& traits, const Session_rules& rules = {},
          const Options& options = {})
    : m_vertices(std::move(domain)), m_traits(traits), m_rules(rules), m_options(options),
      m_prepared(rules)
  {}

  const Options& options() const { return m_options; }

  Outcome set_options(const Options& options)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    Outcome checked = options.check();
    if(checked)
    {
      if(options.cells != m_options.cells ||
         (options.smoothing_length > 0) != (m_options.smoothing_length > 0))
        region_changed();
      else if(options.bending_length != m_options.bending_length ||
              options.smoothing_length != m_options.smoothing_length)
        values_changed();
      m_options = options;
    }
    return checked;
  }

  const Vertices& vertices() const { return m_vertices; }

  // The target of a control vertex or a control point, the projection of where it is if the target
  // is a set; the point of what is no control.
  template <typename Handle>
  Point target(Handle handle) const
  {
    const auto* target = m_vertices.find_target(handle);
    return target == nullptr ? present(handle)
           : target->set     ? target->set(present(handle)) : target->point;
  }

  Point present(vertex_descriptor v) const
  {
    return takes_points() ? Point(domain().point(v)) : m_vertices.present(v);
  }

  Point present(Control_point point) const
  {
    return point_at(point, [this](vertex_descriptor v) { return present(v); });
  }

  // the point of a vertex of the region of interest in the rest shape
  const Point& rest_point(vertex_descriptor v) const { return m_vertices.find(v)->rest; }

  Point rest_point(Control_point point) const
  {
    return point_at(point, [this](vertex_descriptor v) { return rest_point(v); });
  }

  // The functions that change the sets of vertices return whether they did.

  bool insert_roi(vertex_descriptor v)
  {
    return !refuse_in_a_run() && m_vertices.insert_roi(v) && region_changed();
  }

  bool erase_roi(vertex_descriptor v)
  {
    return !refuse_in_a_run() && m_vertices.erase_roi(v) && region_changed();
  }

  void clear_roi()
  {
    clear_points();
    if(!refuse_in_a_run() && m_vertices.clear_roi())
      region_changed();
  }

  bool insert_control(vertex_descriptor v)
  {
    if(refuse_in_a_run())
      return false;
    const bool was_roi = m_vertices.is_roi(v);
    std::optional<Point> moved; // others may have moved it
    if(takes_points() && m_vertices.find(v) != nullptr)
      moved = domain().point(v);
    if(!m_vertices.insert_control(v))
      return false;
    if(moved)
      m_vertices.target(*m_vertices.find(v)) = std::move(*moved);
    return was_roi ? constraints_changed() : region_changed();
  }

  bool erase_control(vertex_descriptor v)
  {
    return !refuse_in_a_run() && m_vertices.erase_control(v) && constraints_changed();
  }

  void clear_control()
  {
    clear_points();
    if(!refuse_in_a_run() && m_vertices.clear_control())
      constraints_changed();
  }

  // The corners are given by their barycentric coordinates.
  template <typename CoordinateRange>
  Control_point_insertion insert_point(const simplex_descriptor& s,
                                       const CoordinateRange& coordinates)
  {
    if(refuse_in_a_run())
      return Control_point_insertion(outcome(Status::in_a_run));
    typename Vertices::Held_point held = {{}, {}, {Domain::make_point({0, 0, 0}), Vertices::hard}};
    if(!collect_corners(s, held.corners))
      return Control_point_insertion(Outcome(
        Status::not_a_simplex, "the simplex that was given for a control point is not there"));
    held.coordinates.assign(std::begin(coordinates), std::end(coordinates));
    const double sum = std::accumulate(held.coordinates.begin(), held.coordinates.end(), 0.0);
    if(held.coordinates.size() != held.corners.size() || !(std::abs(sum - 1) <= 1e-9) ||
       !std::all_of(held.coordinates.begin(), held.coordinates.end(),
                    [](double c) { return is_finite(c); }))
      return Control_point_insertion(outcome(Status::invalid_coordinates, "a control point"));
    for(std::size_t k = held.corners.size(); k-- > 0;)
      if(held.coordinates[k] == 0)
      {
        held.corners.erase(held.corners.begin() + static_cast<std::ptrdiff_t>(k));
        held.coordinates.erase(held.coordinates.begin() + static_cast<std::ptrdiff_t>(k));
      }
      else
        held.coordinates[k] /= sum;
    held.target.point = Domain::make_point(Vertices::position(
      held, [this](vertex_descriptor v) { return Domain::coordinates(present(v)); }));
    for(vertex_descriptor v : held.corners)
      insert_roi(v);
    constraints_changed();
    return Control_point_insertion(Outcome(Status::success, std::string()),
                                   m_vertices.insert_point(std::move(held)));
  }

  bool erase_point(Control_point point)
  {
    return !refuse_in_a_run() && m_vertices.erase_point(point) && constraints_changed();
  }

  void clear_points()
  {
    if(!refuse_in_a_run() && m_vertices.clear_points())
      constraints_changed();
  }

  // replaces the target t of a control vertex or a control point by f(t)
  template <typename Handle, typename Function>
  Outcome change_target(Handle handle, const Function& f)
  {
    return with_target(handle, [&](auto& target) {
      replace_target(target, f(this->target(handle)));
      return Outcome(Status::success, std::string());
    });
  }

  template <typename Handle, typename Projection>
  Outcome set_target_set(Handle handle, Projection projection)
  {
    return with_target(handle, [&](auto& target) {
      if(target.weight == Vertices::hard)
        return refuse_hard_set(handle);
      target.set = std::move(projection);
      return Outcome(Status::success, std::string());
    });
  }

  // the weight of the target of a control vertex or a control point, 0 for what is none
  template <typename Handle>
  double weight(Handle handle) const
  {
    const auto* target = m_vertices.find_target(handle);
    return target == nullptr ? 0 : target->weight;
  }

  template <typename Handle>
  Outcome set_weight(Handle handle, double weight)
  {
    return with_target(handle, [&](auto& target) {
      if(!(weight >= 0))
        return outcome(Status::invalid_weight, name(handle));
      if(target.set && weight == Vertices::hard)
        return refuse_hard_set(handle);
      const double before = std::exchange(target.weight, weight);
      if(weight != before)
        constraints_changed();
      return Outcome(Status::success, std::string());
    });
  }

  // the rotation of the cells at a control vertex, or none: then it is fitted
  Outcome set_rotation(vertex_descriptor v, const std::optional<Matrix_3x3>& rotation)
  {
    return with_target(v, [&](auto& target) {
      if(rotation && !is_rotation(*rotation))
        return outcome(Status::invalid_rotation, name(v));
      target.rotation = rotation;
      if(rotation)
        target.rotation = Svd_rotation::closest(*rotation);
      return Outcome(Status::success, std::string());
    });
  }

  // the same for each of some control vertices: the rotation of their rigid motion
  Outcome set_rotations_of_motion(const std::vector<vertex_descriptor>& vertices)
  {
    std::vector<Coordinates> rest, targets;
    for(vertex_descriptor v : vertices)
    {
      const auto* entry = m_vertices.find_control(v);
      if(entry == nullptr)
        return outcome(Status::not_a_control_vertex, name(v));
      rest.push_back(Domain::coordinates(entry->rest));
      targets.push_back(Domain::coordinates(m_vertices.target(*entry)));
    }
    const std::optional<Matrix_3x3> rotation = rotation_of_motion(rest, targets);
    if(!rotation)
      return Outcome(Status::invalid_rotation, "the targets are no rigid motion of the rest shape, "
                     "or the vertices lie on a line");
    Outcome result(Status::success, std::string());
    for(auto v = vertices.begin(); v != vertices.end() && result; ++v)
      result = set_rotation(*v, rotation);
    return result;
  }

  // The stiffness of cells, and which share a rotation. `change` is called with the values.
  template <typename Function>
  Outcome change_cell_values(const Function& change)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    const bool had_groups = m_cell_values.has_groups();
    change(m_cell_values);
    if(had_groups || m_cell_values.has_groups())
      region_changed();
    else
      values_changed();
    return Outcome(Status::success, std::string());
  }

  Outcome preprocess()
  {
    Outcome prepared = m_options.check();
    if(!prepared)
      return prepared;
    prepared = prepare();
    if(prepared)
      prepared.message +=
        about_unconstrained_components(m_prepared.core().unconstrained_components());
    return prepared;
  }

  // what the last preparation led to
  const Outcome& preparation() const { return m_prepared.outcome_of_preparation(); }

  template <typename Visitor>
  Report deform(unsigned int iterations, double tolerance, Visitor& visitor)
  {
    Report report;
    {
      Scoped_seconds total(report.seconds.total);
      static_cast<Outcome&>(report) = deform(iterations, tolerance, visitor, report);
    }
    return report;
  }

  // A time step with these forces, or none if the function is empty.
  Step_report advance(const Dynamics& dynamics, std::function<Coordinates(vertex_descriptor)> force)
  {
    Step_report report;
    static_cast<Outcome&>(report) = dynamics.check();
    if(!report)
      return report;
    Time_step<vertex_descriptor> step = {dynamics, std::move(force)};
    Default_visitor visitor;
    {
      Scoped_seconds total(report.seconds.total);
      static_cast<Outcome&>(report) =
        deform(m_options.iterations, m_options.tolerance, visitor, report, &step);
      if(!report)
        return report;
      Scoped_seconds seconds(report.seconds.transfer);
      step.measure(m_prepared.rows().contents, m_prepared.positions(), report);
      m_energy = report.elastic_energy / dynamics.modulus;
    }
    return report;
  }

  Coordinates velocity(vertex_descriptor v) const
  {
    return m_vertices.velocity(m_vertices.find(v));
  }

  bool set_velocity(vertex_descriptor v, const Coordinates& velocity)
  {
    return !refuse_in_a_run() && m_vertices.set_velocity(v, velocity);
  }

  void reset()
  {
    if(refuse_in_a_run())
      return;
    std::vector<Coordinates> positions;
    if(m_prepared.has_region())
    {
      positions = m_prepared.positions();
      for(std::size_t k = 0; k < positions.size(); ++k)
        if(const auto* entry = m_vertices.find(m_prepared.region().vertices[k]))
          positions[k] = Domain::coordinates(entry->rest);
    }
    std::vector<Point> points = copies(&Entry::rest), targets = points, held_targets;
    for(const auto& held : m_vertices.points())
      held_targets.push_back(rest_point(held.first));
    for(const auto& entry : m_vertices.entries())
      if(entry.is_roi || !m_rules.are_erased_put_back)
        domain().set_point(entry.vertex, entry.rest);
    move_to(&Entry::present, points);
    for(std::size_t k = 0; k < targets.size(); ++k)
      if(const Entry& entry = m_vertices.entries()[k]; entry.is_control)
      {
        replace_target(m_vertices.whole_target(entry), std::move(targets[k]));
        m_vertices.rotation(entry).reset();
      }
    std::size_t number = 0;
    for(auto& held : m_vertices.points())
      replace_target(held.second.target, std::move(held_targets[number++]));
    if(m_prepared.has_region())
      m_prepared.positions().swap(positions);
    m_prepared.reset_rotations();
    m_vertices.velocities().clear();
    m_energy = not_a_number;
  }

  void overwrite_initial_geometry()
  {
    if(refuse_in_a_run())
      return;
    m_vertices.keep_first_points();
    std::vector<Point> points = copies(&Entry::present);
    if(domain().is_in_place()) // the points may have been changed by others
      for(std::size_t k = 0; k < points.size(); ++k)
        points[k] = domain().point(m_vertices.entries()[k].vertex);
    std::vector<Point> rest = points;
    m_vertices.read_surroundings_again();
    m_prepared.reset_rotations();
    for(const Entry& entry : m_vertices.entries()) // they were those from the other rest shape
      if(entry.is_control)
        m_vertices.rotation(entry).reset();
    region_changed();
    move_to(&Entry::present, points);
    move_to(&Entry::rest, rest);
  }

  // sets of vertices, targets, rest shape and positions, as a value
  struct State
  {
    typename Vertices::State vertices;
    typename Prepared_region<Domain, Traits>::State prepared;
    Cell_scheme cells;
    double energy;
    std::shared_ptr<const char> session; // whose state it is
  };

  State state() const
  {
    State state = {m_vertices.state(), m_prepared.state(), m_options.cells, m_energy, m_identity};
    if(takes_points())
    {
      const auto changed = m_vertices.changed_points();
      for(const auto& [k, point] : changed)
        state.vertices.entries[k].present = point;
      if(m_prepared.has_region())
        m_prepared.take_points(m_vertices, changed, state.prepared.positions);
    }
    return state;
  }

  Outcome restore(State state)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    if(state.session != m_identity)
      return outcome(Status::foreign_state);
    const std::vector<Entry>& before = m_vertices.entries();
    const std::vector<Entry>& after = state.vertices.entries;
    for(std::size_t k = 0; k < before.size(); ++k) // what had no entry then, or another one
      if(k >= after.size() || before[k].vertex != after[k].vertex)
        domain().set_point(before[k].vertex, m_vertices.first_point(k));
    for(const Entry& entry : after)
      domain().set_point(entry.vertex, entry.present);
    const bool are_values_same = m_prepared.has_values_of(state.prepared);
    m_vertices.restore(std::move(state.vertices));
    m_prepared.restore(std::move(state.prepared), m_vertices);
    if(state.cells != m_options.cells)
      region_changed();
    m_energy = are_values_same && state.cells == m_options.cells ? state.energy : not_a_number;
    return Outcome(Status::success, std::string());
  }

  double energy() const { return m_energy; }

  Matrix_3x3 rotation_of_vertex(vertex_descriptor v) const
  {
    const bool has_cell = m_options.cells.has_vertex_cells();
    return rotation_of_cell(has_cell, [&] { return m_prepared.region().find_vertex(domain(), v); });
  }

  Matrix_3x3 rotation_of_simplex(simplex_descriptor s) const
  {
    const bool has_cell = !m_options.cells.has_vertex_cells();
    return rotation_of_cell(has_cell,
                            [&] { return m_prepared.region().find_simplex(domain(), s); });
  }

protected:
  friend Iterate;

  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  const Domain& domain() const { return m_vertices.domain(); }

  std::string name(vertex_descriptor v) const { return vertex_name(domain().index(v)); }
  std::string name(Control_point point) const { return control_point_name(point); }

  static void replace_target(typename Vertices::Target& target, Point point)
  {
    target.point = std::move(point);
    target.set = nullptr;
  }

  // calls f(target) with the target of a control vertex or a control point
  template <typename Handle, typename Function>
  Outcome with_target(Handle handle, const Function& f)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    auto* target = m_vertices.find_target(handle);
    return target == nullptr ? refuse_without_target(handle) : f(*target);
  }

  Outcome refuse_without_target(vertex_descriptor v) const
  {
    return outcome(Status::not_a_control_vertex, name(v));
  }

  Outcome refuse_without_target(Control_point point) const
  {
    return Outcome(Status::not_a_control_vertex,
                   name(point) + " has no target: it was erased, or is of another object");
  }

  template <typename Handle>
  Outcome refuse_hard_set(Handle handle) const
  {
    return Outcome(Status::invalid_weight, name(handle) + " has an infinite weight; for a target "
                                           "that is a set give it a finite one first");
  }

  // the control point if its corners are where a function of vertices tells
  template <typename Function>
  Point point_at(Control_point point, const Function& f) const
  {
    const auto found = m_vertices.points().find(point);
    return Domain::make_point(
      found == m_vertices.points().end()
        ? Coordinates{0, 0, 0}
        : Vertices::position(found->second,
                             [&](vertex_descriptor v) { return Domain::coordinates(f(v)); }));
  }

  // the corners of a simplex; false if it is not one of the domain
  bool collect_corners(const simplex_descriptor& s, std::vector<vertex_descriptor>& corners) const
  {
    if constexpr(is_valid<Call_is_simplex, Domain>)
      if(!domain().is_simplex(s))
        return false;
    for(vertex_descriptor v : domain().simplex_vertices(s))
      corners.push_back(v);
    bool is_there = false;
    if(!corners.empty())
      domain().for_each_incident_simplex(
        corners[0], [&](const simplex_descriptor& t, const auto&) { is_there |= t == s; });
    return is_there;
  }

  // Points of all entries are copied before any is changed: copies may throw.
  std::vector<Point> copies(Point Entry::*point) const
  {
    std::vector<Point> points;
    points.reserve(m_vertices.entries().size());
    for(const Entry& entry : m_vertices.entries())
      points.push_back(entry.*point);
    return points;
  }

  void move_to(Point Entry::*point, std::vector<Point>& points)
  {
    for(std::size_t k = 0; k < points.size(); ++k)
      m_vertices.entries()[k].*point = std::move(points[k]);
  }

  // Whether a visitor has called: it works on what the run is working on.
  bool refuse_in_a_run() const
  {
    CGAL_precondition(!m_is_in_a_run);
    return m_is_in_a_run;
  }

  // these return true, for the functions that say whether they changed something

  bool region_changed()
  {
    m_prepared.region_changed();
    m_is_region_written = false;
    m_energy = not_a_number;
    return true;
  }

  bool values_changed()
  {
    m_prepared.values_changed();
    m_energy = not_a_number;
    return true;
  }

  bool constraints_changed()
  {
    m_prepared.constraints_changed();
    m_energy = not_a_number;
    return true;
  }

  Outcome prepare()
  {
    return m_prepared.prepare(m_vertices, m_cell_values, m_traits, m_options, m_stages);
  }

  // with a time step, if one is given, else at once
  template <typename Visitor>
  Outcome deform(unsigned int iterations, double tolerance, Visitor& visitor, Report& report,
                 Time_step<vertex_descriptor>* step = nullptr)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    Options options = m_options;
    options.iterations = iterations;
    options.tolerance = tolerance;
    if(step)
      options.initial_guess = Initial_guess::previous;
    if(Outcome checked = options.check(); !checked)
      return checked;
    if(Outcome taken = take_points_of_others(report); !taken)
      return taken;
    {
      Scoped_seconds seconds(report.seconds.preprocess);
      m_prepared.set_inertia(step ? step->inertia() : 0);
      const Outcome prepared = prepare();
      report.stages = std::exchange(m_stages, {});
      if(!prepared)
        return prepared;
    }
    Deformation_core& core = m_prepared.core();
    report.free_vertices = core.constraints().number_of_free_vertices();
    report.simplices = static_cast<std::size_t>(core.region().number_of_simplices());
    report.unconstrained_components = core.unconstrained_components();

    Array<Coordinates> positions;
    Targets targets;
    if(Outcome read = read_targets(positions, targets, report); !read)
      return read;
    if(step)
      if(Outcome begun = begin_step(*step, positions, targets, report); !begun)
        return begun;
    const auto observe = [&](unsigned int iteration, double energy) {
      return visitor(Iterate(*this, positions, iteration, energy));
    };
    Array<Matrix_3x3> rotations = core.rotations();
    m_is_in_a_run = true;
    const auto end_of_run = [](bool* flag) { *flag = false; };
    const std::unique_ptr<bool, decltype(end_of_run)> run(&m_is_in_a_run, end_of_run);
    targets.frames = frames();
    const Diagnosis diagnosis = core.run(options, observe, targets, positions, rotations, report);
    Outcome result = m_prepared.explain(diagnosis, domain());
    for(const Targets::Set& set : targets.sets)
      if(!is_finite(targets.soft[static_cast<std::size_t>(set.row)]))
        return outcome(Status::non_finite_point, "the target of " + name_of_row(set.row));
    if(result)
    {
      if(result.status == Status::converged && m_rules.order == Minimization_order::global_first)
        result.message = "the energy changed by less than the tolerance in an iteration";
      describe(result, report, step != nullptr);
      Scoped_seconds seconds(report.seconds.transfer);
      Array<Coordinates> velocities;
      if(step)
        velocities = velocities_after(*step, positions);
      write_points(positions);
      m_vertices.velocities().swap(velocities);
      core.set_rotations(std::move(rotations));
      m_energy = report.energy.back();
      report.inverted_simplices = core.number_of_inverted_simplices(m_prepared.positions());
    }
    return result;
  }

  // Whether points are looked at that others may have moved. CGAL's class does not look at them,
  // and after a run that failed in writing, some may be the run's own.
  bool takes_points() const
  {
    return m_rules.order == Minimization_order::local_first && domain().is_in_place() &&
           m_are_points_written;
  }

  // Points that others have moved are where the run starts, or fixed there: undo by writing back
  // old points, for example.
  Outcome take_points_of_others(Report& report)
  {
    Scoped_seconds seconds(report.seconds.transfer);
    if(!takes_points())
      return outcome(Status::success);
    const std::vector<std::pair<std::size_t, Point>> changed = m_vertices.changed_points();
    for(const auto& [k, point] : changed)
      if(!is_finite(Domain::coordinates(point)))
        return outcome(Status::non_finite_point, name(m_vertices.entries()[k].vertex));
    for(const auto& [k, point] : changed)
    {
      Entry& entry = m_vertices.entries()[k];
      entry.present = point;
      if(!is_finite(Domain::coordinates(entry.rest))) // it has been mended
      {
        entry.rest = point;
        region_changed();
      }
    }
    return m_prepared.has_region() ? m_prepared.take_points(m_vertices, changed)
                                   : outcome(Status::success);
  }

  // The positions at which a run starts, with the hard control vertices at their targets, and the
  // targets of the others.
  Outcome read_targets(Array<Coordinates>& positions, Targets& targets, Report& report) const
  {
    Scoped_seconds seconds(report.seconds.transfer);
    const auto& region = m_prepared.region();
    positions = m_prepared.positions();
    for(const auto& entry : m_vertices.entries())
    {
      if(!entry.is_control)
        continue;
      const Coordinates target = Domain::coordinates(m_vertices.target(entry));
      if(!is_finite(target))
        return outcome(Status::non_finite_point, "the target of " + name(entry.vertex));
      const int v = region.find_vertex(domain(), entry.vertex);
      if(v >= 0 && m_vertices.is_hard_control(entry))
        positions[v] = target;
    }
    const auto& rows = m_prepared.rows();
    targets.soft.reserve(rows.soft_vertices.size() + rows.soft_points.size());
    for(int v : rows.soft_vertices)
      append_target(*m_vertices.find_target(region.vertices[v]), {0, 0, 0}, targets);
    for(const auto* points : {&rows.soft_points, &rows.hard_points})
      for(Control_point point : *points)
      {
        const auto& held = m_vertices.points().at(point);
        if(!is_finite(Domain::coordinates(held.target.point)))
          return outcome(Status::non_finite_point, "the target of " + name(point));
        const Coordinates fixed = fixed_share(held, positions);
        if(points == &rows.soft_points)
          append_target(held.target, fixed, targets);
        else
          targets.hard.push_back(difference(Domain::coordinates(held.target.point), fixed));
      }
    return outcome(Status::success);
  }

  // moves the free vertices to where their inertia takes them, which the last soft rows ask for
  Outcome begin_step(Time_step<vertex_descriptor>& step, Array<Coordinates>& positions,
                     Targets& targets, Report& report) const
  {
    Scoped_seconds seconds(report.seconds.transfer);
    const auto& region = m_prepared.region();
    const Array<double>& contents = m_prepared.rows().contents;
    step.start = m_prepared.positions();
    step.goals = positions;
    for(std::size_t v = 0; v < contents.size(); ++v)
    {
      if(contents[v] == 0)
        continue;
      const vertex_descriptor vertex = region.vertices[v];
      step.goals[v] = step.goal(vertex, positions[v],
                                m_vertices.velocity(m_vertices.find(vertex)), contents[v]);
      if(!is_finite(step.goals[v]))
        return outcome(Status::non_finite_point,
                       "where velocity and forces take " + name(vertex));
      targets.soft.push_back(step.goals[v]);
    }
    positions = step.goals;
    return outcome(Status::success);
  }

  // of all entries; hard control vertices are moved to their targets at once
  Array<Coordinates> velocities_after(const Time_step<vertex_descriptor>& step,
                                      const Array<Coordinates>& positions) const
  {
    const std::vector<Entry>& entries = m_vertices.entries();
    Array<Coordinates> velocities(entries.size(), Coordinates{0, 0, 0});
    for(std::size_t k = 0; k < entries.size(); ++k)
    {
      if(!entries[k].is_roi)
        continue;
      Coordinates way = {0, 0, 0};
      if(m_vertices.is_hard_control(entries[k]))
        way = difference(Domain::coordinates(m_vertices.target(entries[k])),
                         Domain::coordinates(entries[k].present));
      else if(const int v = m_prepared.region().find_vertex(domain(), entries[k].vertex); v >= 0)
        way = difference(positions[v], step.start[v]);
      velocities[k] = scaled(way, 1 / step.dynamics.time_step);
    }
    return velocities;
  }

  // the rotations that are given to cells at control vertices
  std::vector<Frame> frames() const
  {
    std::vector<Frame> frames;
    for(const auto& entry : m_vertices.entries())
      if(entry.is_control && m_vertices.rotation(entry))
        if(const int v = m_prepared.region().find_vertex(domain(), entry.vertex); v >= 0)
          frames.push_back({v, *m_vertices.rotation(entry)});
    return frames;
  }

  // What corners that are not movable add to the position of a control point: they are no part of
  // its row.
  Coordinates fixed_share(const typename Vertices::Held_point& held,
                          const Array<Coordinates>& positions) const
  {
    return Vertices::position(held, [&](vertex_descriptor v) {
      const int number = m_prepared.region().find_vertex(domain(), v);
      if(number >= 0)
        return number < m_prepared.core().region().number_of_movable_vertices
                 ? Coordinates{0, 0, 0} : positions[number];
      const Entry& entry = *m_vertices.find(v);
      return Domain::coordinates(m_vertices.is_hard_control(entry) ? m_vertices.target(entry)
                                                                   : entry.present);
    });
  }

  // adds the target of a soft row that lacks a share of its position
  static void append_target(const typename Vertices::Target& target, const Coordinates& share,
                            Targets& targets)
  {
    if(target.set)
      targets.sets.push_back(
        {static_cast<int>(targets.soft.size()), [&target, share](Coordinates c) {
           add(c, 1, share);
           return difference(Domain::coordinates(target.set(Domain::make_point(c))), share);
         }});
    targets.soft.push_back(difference(Domain::coordinates(target.point), share));
  }

  std::string name_of_row(int r) const
  {
    const auto& rows = m_prepared.rows();
    const std::size_t row = static_cast<std::size_t>(r), n = rows.soft_vertices.size();
    return row < n ? name(m_prepared.region().vertices[rows.soft_vertices[row]])
                   : name(rows.soft_points[row - n]);
  }

  // adds to the message what a user would not expect
  void describe(Outcome& result, const Report& report, bool is_time_step) const
  {
    if(report.free_vertices == 0)
      result.message = about_nothing_free(m_prepared.roi_size() == 0);
    else if(m_prepared.number_of_controls() == 0 && !is_time_step)
      result.message += "; there is no control vertex";
    result.message += about_isolated_controls(m_prepared.isolated_controls());
    result.message += about_unconstrained_components(report.unconstrained_components);
  }

  void write_points(Array<Coordinates>& positions)
  {
    std::vector<std::pair<std::size_t, Point>> points = new_points(positions);
    m_are_points_written = false; // the map of a user may throw
    for(const auto& [k, point] : points)
      domain().set_point(m_vertices.entries()[k].vertex, point);
    m_are_points_written = true;
    for(auto& [k, point] : points)
      m_vertices.entries()[k].present = std::move(point);
    note_region_as_written();
    m_prepared.positions().swap(positions);
  }

  // The new points of the region of interest: of the free vertices at their positions, of the hard
  // control vertices at their targets, and of all other fixed vertices where they are: a domain may
  // write to other places than it reads from. Each has the place of the entry of its vertex: the
  // domain, which may throw, is not asked any more for what is done with them.
  std::vector<std::pair<std::size_t, Point>>
  new_points(const Array<Coordinates>& positions) const
  {
    const auto& entries = m_vertices.entries();
    const Array<char>& is_fixed = m_prepared.core().constraints().is_fixed;
    std::vector<std::pair<std::size_t, Point>> points;
    points.reserve(entries.size());
    for(std::size_t k = 0; k < entries.size(); ++k)
    {
      const Entry& entry = entries[k];
      if(is_put_back(entry))
        points.emplace_back(k, entry.rest);
      if(!entry.is_roi)
        continue;
      const int v = m_prepared.region().find_vertex(domain(), entry.vertex);
      if(m_vertices.is_hard_control(entry))
        points.emplace_back(k, m_vertices.target(entry));
      else if(v >= 0 && v < static_cast<int>(is_fixed.size()) && !is_fixed[v])
        points.emplace_back(k, Domain::make_point(positions[v]));
      else
        points.emplace_back(k, entry.present);
    }
    return points;
  }

  // whether a vertex has left the region of interest and is to return to the rest shape
  bool is_put_back(const Entry& entry) const
  {
    return m_rules.are_erased_put_back && entry.was_roi && !entry.is_roi;
  }

  bool is_region_written() const { return m_is_region_written; }

  void note_region_as_written()
  {
    if(!m_is_region_written)
      for(Entry& entry : m_vertices.entries())
        entry.was_roi = entry.is_roi;
    m_is_region_written = true;
  }

  template <typename FindCell>
  Matrix_3x3 rotation_of_cell(bool has_cell, const FindCell& find_cell) const
  {
    if(!has_cell || !m_prepared.has_region())
      return identity_matrix();
    const Array<Matrix_3x3>& rotations = m_prepared.core().rotations();
    const int cell = find_cell();
    return cell >= 0 && cell < static_cast<int>(rotations.size()) ? rotations[cell]
                                                                  : identity_matrix();
  }

  Vertices m_vertices;
  Traits m_traits;
  Session_rules m_rules;
  Options m_options;
  double m_energy = not_a_number;
  std::shared_ptr<const char> m_identity = std::make_shared<char>();
  bool m_is_in_a_run = false;
  bool m_are_points_written = true; // those of the last run, all of them
  bool m_is_region_written = true; // whether note_region_as_written() was called since its change
  Stages m_stages;                 // since the last run
  Cell_values<Domain> m_cell_values;
  Prepared_region<Domain, Traits> m_prepared;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_H
