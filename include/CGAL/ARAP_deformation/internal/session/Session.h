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
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Iterate.h>
#include <CGAL/ARAP_deformation/internal/session/Prepared_region.h>
#include <CGAL/ARAP_deformation/internal/session/Session_vertices.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <limits>
#include <memory>
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
    Outcome prepared = m_prepared.prepare(m_vertices, m_traits, m_options);
    if(prepared)
      prepared.message += about_unconstrained_components(m_prepared.unconstrained_components());
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
    std::vector<Coordinates> positions = m_prepared.positions();
    for(std::size_t k = 0; k < positions.size(); ++k)
      if(const auto* entry = m_vertices.find(m_prepared.region().vertices[k]))
        positions[k] = Domain::coordinates(entry->rest);
    std::vector<Point> points = copies(&Entry::rest), targets = points;
    for(const auto& entry : m_vertices.entries())
      domain().set_point(entry.vertex, entry.rest);
    move_to(&Entry::present, points);
    for(std::size_t k = 0; k < targets.size(); ++k)
      if(const Entry& entry = m_vertices.entries()[k]; entry.is_control)
        m_vertices.target(entry) = std::move(targets[k]);
    m_prepared.positions().swap(positions);
    if(m_prepared.core())
      m_prepared.core()->reset_rotations();
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
    const bool has_cell = m_options.cells.has_vertex_cells();
    return rotation_of_cell(has_cell ? m_prepared.region().find_vertex(domain(), v) : -1);
  }

  Matrix_3x3 rotation_of_simplex(simplex_descriptor s) const
  {
    const bool has_cell = !m_options.cells.has_vertex_cells();
    return rotation_of_cell(has_cell ? m_prepared.region().find_simplex(domain(), s) : -1);
  }

private:
  friend Iterate;

  using Entry = typename Vertices::Entry;

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

  bool note_change(bool is_change, bool are_weights_the_same = true)
  {
    if(is_change)
    {
      m_prepared.discard(are_weights_the_same);
      m_energy = not_a_number;
    }
    return is_change;
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
      if(Outcome prepared = m_prepared.prepare(m_vertices, m_traits, m_options); !prepared)
        return prepared;
    }
    auto& core = *m_prepared.core();
    const auto& region = m_prepared.region();
    report.free_vertices = core.region().number_of_free_vertices;
    report.simplices = core.region().number_of_simplices();
    report.unconstrained_components = m_prepared.unconstrained_components();

    std::vector<Coordinates> positions = m_prepared.positions();
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
    std::vector<Coordinates> soft_targets;
    for(const Soft_position& soft : core.region().soft_positions)
    {
      const auto& entry = *m_vertices.find(region.vertices[soft.vertex]);
      soft_targets.push_back(Domain::coordinates(m_vertices.target(entry)));
    }

    const auto observe = [&](unsigned int iteration, double energy) {
      return visitor(Iterate(*this, positions, iteration, energy));
    };
    std::vector<Matrix_3x3> rotations = core.rotations();
    m_is_in_a_run = true;
    const auto end_of_run = [](bool* flag) { *flag = false; };
    const std::unique_ptr<bool, decltype(end_of_run)> run(&m_is_in_a_run, end_of_run);
    const Diagnosis diagnosis = core.run(options, observe, soft_targets, positions, rotations,
                                         report);
    Outcome result = m_prepared.explain(diagnosis, domain());
    if(result)
    {
      result.message += about_unconstrained_components(report.unconstrained_components);
      std::vector<std::pair<std::size_t, Point>> points = new_points(positions);
      for(const auto& [k, point] : points)
        domain().set_point(m_vertices.entries()[k].vertex, point);
      for(auto& [k, point] : points)
        m_vertices.entries()[k].present = std::move(point);
      m_prepared.positions().swap(positions);
      core.set_rotations(std::move(rotations));
      m_energy = report.energy.back();
      report.inverted_simplices = core.number_of_inverted_simplices(m_prepared.positions());
    }
    return result;
  }

  // The new points of the region of interest: of the free vertices at their positions, of the
  // hard control vertices, and of all that has no simplices or is fixed by nothing, and stays where
  // it is: a domain may write to other places than it reads from. Each has the place of the entry
  // of its vertex: the domain, which may throw, is not asked any more for what is done with them.
  std::vector<std::pair<std::size_t, Point>>
  new_points(const std::vector<Coordinates>& positions) const
  {
    const auto& entries = m_vertices.entries();
    std::vector<std::pair<std::size_t, Point>> points;
    points.reserve(entries.size());
    for(int v = 0; v < number_of_free_vertices(); ++v)
      points.emplace_back(m_vertices.find(m_prepared.region().vertices[v]) - entries.data(),
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
    const int number = m_prepared.region().find_vertex(domain(), v);
    return number >= 0 && number < number_of_free_vertices();
  }

  int number_of_free_vertices() const
  {
    return m_prepared.core()->region().number_of_free_vertices;
  }

  Matrix_3x3 rotation_of_cell(int cell) const
  {
    const auto* core = m_prepared.core();
    return core && cell >= 0 && cell < core->number_of_cells() ? core->rotation(cell)
                                                               : identity_matrix();
  }

  Vertices m_vertices;
  Traits m_traits;
  Options m_options;
  double m_energy = not_a_number;
  bool m_is_in_a_run = false;
  Prepared_region<Domain, Traits> m_prepared;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_H
