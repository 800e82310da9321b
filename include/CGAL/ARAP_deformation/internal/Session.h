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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Default_visitor.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Deformation_core.h>
#include <CGAL/ARAP_deformation/internal/Domain_region.h>
#include <CGAL/ARAP_deformation/internal/Iterate.h>
#include <CGAL/ARAP_deformation/internal/Laplacian_solver.h>
#include <CGAL/ARAP_deformation/internal/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/Session_vertices.h>
#include <CGAL/ARAP_deformation/internal/sentences.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

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

  using Iterate = internal::Iterate<Session>;

  Session(Domain domain, const Traits& traits) : m_vertices(std::move(domain)), m_traits(traits) {}

  const Options& options() const { return m_options; }

  Outcome set_options(const Options& options)
  {
    if(is_in_a_run())
      return outcome(Status::in_a_run);
    Outcome checked = options.check();
    if(checked)
    {
      note_change(options.cells != m_options.cells, false);
      m_options = options;
    }
    return checked;
  }

  const Vertices& vertices() const { return m_vertices; }

  // the target of a control vertex, the point of any other
  Point target(vertex_descriptor v) const
  {
    return m_vertices.is_control(v) ? m_vertices.target(*m_vertices.find(v))
                                    : m_vertices.present(v);
  }

  // changes the region: f(vertices) returns whether it did; then all that follows from it is stale
  template <typename Function>
  bool change_vertices(const Function& f)
  {
    return !is_in_a_run() && note_change(f(m_vertices));
  }

  // replaces the target t of the control vertex v by f(t)
  template <typename Function>
  Outcome change_target(vertex_descriptor v, const Function& f)
  {
    if(is_in_a_run())
      return outcome(Status::in_a_run);
    auto* entry = m_vertices.find_control(v);
    if(entry == nullptr)
      return outcome(Status::not_a_control_vertex, name(v));
    Point& target = m_vertices.target(*entry);
    target = f(target);
    return Outcome(Status::success, std::string());
  }

  // the weight of the target of a control vertex, 0 for any other
  double weight(vertex_descriptor v) const
  {
    return m_vertices.is_control(v) ? m_vertices.weight(*m_vertices.find(v)) : 0;
  }

  Outcome set_weight(vertex_descriptor v, double weight)
  {
    if(is_in_a_run())
      return outcome(Status::in_a_run);
    auto* entry = m_vertices.find_control(v);
    if(entry == nullptr)
      return outcome(Status::not_a_control_vertex, name(v));
    if(!(weight >= 0))
      return outcome(Status::invalid_weight, name(v));
    const double before = std::exchange(m_vertices.weight(*entry), weight);
    note_change(weight != before);
    return Outcome(Status::success, std::string());
  }

  Outcome preprocess()
  {
    Outcome prepared = prepare();
    if(prepared)
      prepared.message += about_unheld_parts(m_unheld_parts);
    return prepared;
  }

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

  void reset()
  {
    if(is_in_a_run())
      return;
    std::vector<Coordinates> positions = m_positions;
    for(std::size_t k = 0; k < positions.size(); ++k)
      if(const auto* entry = m_vertices.find(m_region.vertices[k]))
        positions[k] = Domain::coordinates(entry->rest);
    std::vector<Point> points = copies(&Entry::rest), targets = points;
    for(const auto& entry : m_vertices.entries())
      domain().set_point(entry.vertex, entry.rest);
    move_to(&Entry::present, points);
    for(std::size_t k = 0; k < targets.size(); ++k)
      if(const Entry& entry = m_vertices.entries()[k]; entry.is_control)
        m_vertices.target(entry) = std::move(targets[k]);
    m_positions.swap(positions);
    if(m_core)
      m_core->reset_rotations();
    m_energy = not_a_number;
  }

  void overwrite_initial_geometry()
  {
    if(is_in_a_run())
      return;
    std::vector<Point> points = copies(&Entry::present);
    if(domain().is_in_place()) // the points may have been changed by others
      for(std::size_t k = 0; k < points.size(); ++k)
        points[k] = domain().point(m_vertices.entries()[k].vertex);
    std::vector<Point> rest = points;
    note_change(true, false);
    move_to(&Entry::present, points);
    move_to(&Entry::rest, rest);
  }

  double energy() const { return m_energy; }

  Matrix_3x3 rotation_of_vertex(vertex_descriptor v) const
  {
    const bool has_cell = m_core && m_options.cells.has_vertex_cells();
    return rotation_of_cell(has_cell ? m_region.find_vertex(domain(), v) : -1);
  }

  Matrix_3x3 rotation_of_simplex(simplex_descriptor s) const
  {
    const bool has_cell = m_core && !m_options.cells.has_vertex_cells();
    return rotation_of_cell(has_cell ? m_region.find_simplex(domain(), s) : -1);
  }

private:
  friend Iterate;

  using Entry = typename Vertices::Entry;
  using Region_ = Domain_region<Domain>;
  using Core = Deformation_core<Traits>;

  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  const Domain& domain() const { return m_vertices.domain(); }

  std::string name(vertex_descriptor v) const { return vertex_name(domain().index(v)); }

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
  bool is_in_a_run() const
  {
    CGAL_precondition(!m_is_in_a_run);
    return m_is_in_a_run;
  }

  // A factor may be of use for other free vertices, but not for other weights.
  bool note_change(bool is_change, bool are_weights_the_same = true)
  {
    if(is_change)
    {
      if(!are_weights_the_same)
        m_idle_solver = {};
      else if(m_core)
        m_idle_solver = m_core->take_solver();
      m_core.reset();
      m_energy = not_a_number;
    }
    return is_change;
  }

  // Makes the core for all that is held, unless it is up to date. What nothing holds stays where
  // it is, unless there is nothing else.
  Outcome prepare()
  {
    if(m_core)
      return outcome(Status::success);
    const auto is_tied = [this](const auto& e) {
      return e.is_roi && !domain().is_isolated(e.vertex);
    };
    std::vector<vertex_descriptor> free_vertices = m_vertices.select([&](const auto& e) {
      return !m_vertices.is_hard_control(e) && (is_tied(e) || m_vertices.is_pulled(e));
    });
    const auto is_roi = [](const auto& e) { return e.is_roi; };
    if(any_of_entries(is_roi) && !any_of_entries(is_tied))
      return outcome(Status::no_simplex);

    std::vector<std::size_t> unheld_parts;
    Outcome prepared = prepare(free_vertices, unheld_parts);
    const auto is_hard = [this](const auto& e) { return m_vertices.is_hard_control(e); };
    if(prepared.status == Status::no_held_vertex &&
       (!free_vertices.empty() || any_of_entries(is_hard)))
      prepared = prepare(free_vertices, unheld_parts);
    return prepared;
  }

  // Makes the core for these free vertices. If nothing holds some of them, they are erased, and
  // each of their components adds the smallest index of its vertices to `unheld_parts`.
  Outcome prepare(std::vector<vertex_descriptor>& free_vertices,
                  std::vector<std::size_t>& unheld_parts)
  {
    Region_ region;
    if(!region.collect(domain(), free_vertices))
      return outcome(Status::not_a_simplex, name(region.refused_vertex()));

    std::vector<Coordinates> positions;
    positions.reserve(region.vertices.size());
    region.flat.rest.reserve(region.vertices.size());
    for(vertex_descriptor v : region.vertices)
    {
      positions.push_back(Domain::coordinates(m_vertices.present(v)));
      const auto* entry = m_vertices.find(v);
      region.flat.rest.push_back(entry ? Domain::coordinates(entry->rest) : positions.back());
    }
    if(const int v = find_non_finite(positions); v >= 0)
      return outcome(Status::non_finite_point, name(region.vertices[v]));
    for(const auto& entry : m_vertices.entries())
      if(m_vertices.is_pulled(entry))
        region.flat.soft_positions.push_back({region.find_vertex(domain(), entry.vertex),
                                              m_vertices.weight(entry)});

    std::optional<Core> core;
    core.emplace(m_traits, std::move(region.flat), m_options,
                 std::exchange(m_idle_solver, {}));
    if(core->diagnosis().status != Status::success)
    {
      m_idle_solver = core->take_solver();
      if(core->diagnosis().status == Status::no_held_vertex)
        erase_loose_components(region, core->diagnosis().loose_components, free_vertices,
                               unheld_parts);
      return explain(core->diagnosis(), region, *core);
    }
    Outcome ready = outcome(Status::success);
    m_region = std::move(region);
    m_positions = std::move(positions);
    m_unheld_parts = std::move(unheld_parts);
    m_core = std::move(core);
    return ready;
  }

  void erase_loose_components(const Region_& region, const std::vector<int>& loose_components,
                              std::vector<vertex_descriptor>& free_vertices,
                              std::vector<std::size_t>& unheld_parts) const
  {
    std::map<int, std::size_t> smallest_indices; // of the components
    const auto is_loose = [&](vertex_descriptor v) {
      const int component = loose_components[region.find_vertex(domain(), v)];
      if(component < 0)
        return false;
      const std::size_t index = domain().index(v);
      std::size_t& smallest = smallest_indices.emplace(component, index).first->second;
      smallest = (std::min)(smallest, index);
      return true;
    };
    free_vertices.erase(std::remove_if(free_vertices.begin(), free_vertices.end(), is_loose),
                        free_vertices.end());
    for(const auto& component : smallest_indices)
      unheld_parts.push_back(component.second);
    std::sort(unheld_parts.begin(), unheld_parts.end());
  }

  template <typename Predicate>
  bool any_of_entries(const Predicate& predicate) const
  {
    return std::any_of(m_vertices.entries().begin(), m_vertices.entries().end(), predicate);
  }

  Outcome explain(const Diagnosis& diagnosis, const Region_& region, const Core& core) const
  {
    if(diagnosis.vertex >= 0)
      return outcome(diagnosis.status, name(region.vertices[diagnosis.vertex]));
    if(diagnosis.simplex < 0)
      return outcome(diagnosis.status);
    return outcome(diagnosis.status, simplex_name(core.region(), diagnosis.simplex));
  }

  template <typename Visitor>
  Outcome deform(unsigned int iterations, double tolerance, Visitor& visitor, Report& report)
  {
    if(is_in_a_run())
      return outcome(Status::in_a_run);
    Options options = m_options;
    options.iterations = iterations;
    options.tolerance = tolerance;
    if(Outcome checked = options.check(); !checked)
      return checked;
    {
      Scoped_seconds seconds(report.seconds.preprocess);
      if(Outcome prepared = prepare(); !prepared)
        return prepared;
    }
    report.free_vertices = m_core->region().number_of_free_vertices;
    report.simplices = m_core->region().number_of_simplices();
    report.unheld_parts = m_unheld_parts;

    std::vector<Coordinates> positions = m_positions;
    for(const auto& entry : m_vertices.entries())
    {
      if(!entry.is_control)
        continue;
      const Coordinates target = Domain::coordinates(m_vertices.target(entry));
      if(!is_finite(target))
        return outcome(Status::non_finite_point, "the target of " + name(entry.vertex));
      const int v = m_region.find_vertex(domain(), entry.vertex);
      if(v >= 0 && m_vertices.is_hard_control(entry))
        positions[v] = target;
    }
    std::vector<Coordinates> soft_targets;
    for(const Soft_position& soft : m_core->region().soft_positions)
    {
      const auto& entry = *m_vertices.find(m_region.vertices[soft.vertex]);
      soft_targets.push_back(Domain::coordinates(m_vertices.target(entry)));
    }

    const auto observe = [&](unsigned int iteration, double energy) {
      return visitor(Iterate(*this, positions, iteration, energy));
    };
    std::vector<Matrix_3x3> rotations = m_core->rotations();
    m_is_in_a_run = true;
    const auto end_of_run = [](bool* flag) { *flag = false; };
    const std::unique_ptr<bool, decltype(end_of_run)> run(&m_is_in_a_run, end_of_run);
    const Diagnosis diagnosis = m_core->run(options, observe, soft_targets, positions, rotations,
                                            report);
    Outcome result = explain(diagnosis, m_region, *m_core);
    if(result)
    {
      result.message += about_unheld_parts(m_unheld_parts);
      std::vector<std::pair<std::size_t, Point>> points = new_points(positions);
      for(const auto& [k, point] : points)
        domain().set_point(m_vertices.entries()[k].vertex, point);
      for(auto& [k, point] : points)
        m_vertices.entries()[k].present = std::move(point);
      m_positions.swap(positions);
      m_core->set_rotations(std::move(rotations));
      m_energy = report.energy.back();
      report.inverted_simplices = m_core->number_of_inverted_simplices(m_positions);
    }
    return result;
  }

  // The new points of the region of interest: of the free vertices at their positions, of the
  // hard control vertices, and of all that has no simplices or is held by nothing, and stays where
  // it is: a domain may write to other places than it reads from. Each has the place of the entry
  // of its vertex: the domain, which may throw, is not asked any more for what is done with them.
  std::vector<std::pair<std::size_t, Point>>
  new_points(const std::vector<Coordinates>& positions) const
  {
    const auto& entries = m_vertices.entries();
    std::vector<std::pair<std::size_t, Point>> points;
    points.reserve(entries.size());
    for(int v = 0; v < m_core->region().number_of_free_vertices; ++v)
      points.emplace_back(m_vertices.find(m_region.vertices[v]) - entries.data(),
                          Domain::make_point(positions[v]));
    for(std::size_t k = 0; k < entries.size(); ++k)
      if(m_vertices.is_hard_control(entries[k]))
        points.emplace_back(k, m_vertices.target(entries[k]));
      else if(entries[k].is_roi && !is_free(entries[k].vertex))
        points.emplace_back(k, entries[k].present);
    return points;
  }

  // whether v is solved for
  bool is_free(vertex_descriptor v) const
  {
    const int number = m_region.find_vertex(domain(), v);
    return number >= 0 && number < m_core->region().number_of_free_vertices;
  }

  Matrix_3x3 rotation_of_cell(int cell) const
  {
    return cell >= 0 && cell < m_core->number_of_cells() ? m_core->rotation(cell)
                                                         : identity_matrix();
  }

  Vertices m_vertices;
  Traits m_traits;
  Options m_options;
  double m_energy = not_a_number;
  bool m_is_in_a_run = false;

  Laplacian_solver<typename Traits::Sparse_solver> m_idle_solver; // of a core that was out of date

  // what preprocess() computes; up to date if m_core has a value
  Region_ m_region;
  std::vector<std::size_t> m_unheld_parts;
  std::vector<Coordinates> m_positions; // of the vertices of the region
  std::optional<Core> m_core;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_H
