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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_HISTORY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_HISTORY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/session/Prepared_region.h>
#include <CGAL/ARAP_deformation/internal/session/Session_targets.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Back to the rest shape, a new rest shape, and back to an earlier state.
template <typename Domain>
class Session_history : public Session_targets<Domain>
{
  using Base = Session_targets<Domain>;

public:
  using typename Base::Entry;
  using typename Base::Point;
  using typename Base::Vertices;

  using Base::Base;
  using Base::present;
  using Base::rest_point;

  void reset()
  {
    if(refuse_in_a_run())
      return;
    mend_rest_points();
    Array<Coordinates> positions;
    if(m_prepared.has_region())
    {
      positions = m_prepared.positions();
      for(std::size_t k = 0; k < positions.size(); ++k)
        if(const auto* entry = m_vertices.find(m_prepared.region().vertices[k]);
           entry && is_reset(*entry))
          positions[k] = Domain::coordinates(entry->rest);
    }
    std::vector<Point> points =
      points_of_entries([](std::size_t, const Entry& entry) { return entry.rest; });
    std::vector<Point> targets = points, held_targets;
    for(const auto& held : m_vertices.points())
      held_targets.push_back(rest_point(held.first));
    set_points([&] {
      for(const auto& entry : m_vertices.entries())
        if(is_reset(entry))
          domain().set_point(entry.vertex, entry.rest);
    });
    // not swapped: where the present points were, nothing else would fit
    std::move(points.begin(), points.end(), m_vertices.present_points().begin());
    for(std::size_t k = 0; k < targets.size(); ++k)
      if(const Entry& entry = m_vertices.entries()[k]; entry.is_control)
      {
        replace_target(m_vertices.whole_target(entry), std::move(targets[k]));
        m_vertices.whole_target(entry).rotation.reset();
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
    std::vector<Point> points = m_vertices.present_points();
    if(domain().is_in_place() && m_are_points_written) // they may have been changed by others
      for(std::size_t k = 0; k < points.size(); ++k)
        points[k] = domain().point(m_vertices.entries()[k].vertex);
    std::vector<Point> rest = points;
    m_vertices.read_surroundings_again();
    m_prepared.reset_rotations();
    for(const Entry& entry : m_vertices.entries()) // they were those from the other rest shape
      if(entry.is_control)
        m_vertices.whole_target(entry).rotation.reset();
    region_changed();
    m_vertices.present_points().swap(points);
    for(std::size_t k = 0; k < rest.size(); ++k)
      m_vertices.entries()[k].rest = std::move(rest[k]);
  }

  // sets of vertices, targets, rest shape and positions, as a value
  struct State
  {
    typename Vertices::State vertices;
    typename Prepared_region<Domain>::State prepared;
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
      {
        state.vertices.present_points[k] = point;
        mend(state.vertices.entries[k], point);
        state.prepared.cells.are_complete = false; // rotations are of the positions before
        if(m_prepared.has_region())
          m_prepared.set_position(k, Domain::coordinates(point), state.prepared.positions);
      }
    }
    return state;
  }

  Outcome restore(State state)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    if(state.session != m_identity)
      return outcome(Status::foreign_state);
    auto change = m_vertices.prepare(std::move(state.vertices));
    m_prepared.renumber(state.prepared, domain(), [&](const auto& v) {
      return m_vertices.find_present(change, v);
    });
    // what may throw ends with the points; this object changes only after it
    const std::vector<Entry>& before = m_vertices.entries();
    const std::vector<Entry>& after = change.state.entries;
    set_points([&] {
      for(std::size_t k = 0; k < before.size(); ++k) // what had no entry then, or another one
        if(k >= after.size() || !(before[k].vertex == after[k].vertex))
          domain().set_point(before[k].vertex, m_vertices.first_point(k));
      for(std::size_t k = 0; k < after.size(); ++k)
        domain().set_point(after[k].vertex, change.state.present_points[k]);
    });
    const bool are_values_same = m_prepared.has_values_of(state.prepared);
    m_vertices.restore(std::move(change));
    m_prepared.restore(std::move(state.prepared));
    if(state.cells != m_options.cells)
      region_changed();
    m_energy = are_values_same && state.cells == m_options.cells ? state.energy : not_a_number;
    return Outcome(Status::success, std::string());
  }

protected:
  using Base::domain;
  using Base::m_are_points_written;
  using Base::m_energy;
  using Base::m_identity;
  using Base::m_options;
  using Base::m_prepared;
  using Base::m_rules;
  using Base::m_vertices;
  using Base::not_a_number;
  using Base::refuse_in_a_run;
  using Base::region_changed;
  using Base::replace_target;
  using Base::set_points;
  using Base::takes_points;

  // CGAL's class does not know what is outside of the region of interest.
  bool is_reset(const Entry& entry) const { return entry.is_roi || !m_rules.are_erased_put_back; }

  // If the point of a vertex was not finite when it was inserted, and is now: makes the new point
  // its rest point. Returns whether it has changed.
  static bool mend(Entry& entry, const Point& point)
  {
    const bool is_mended = !is_finite(Domain::coordinates(entry.rest)) &&
                           is_finite(Domain::coordinates(point));
    if(is_mended)
      entry.rest = point;
    return is_mended;
  }

  // The same for all, whoever has given them a point that is finite: a run, or the program, also to
  // the input where results are written elsewhere.
  void mend_rest_points()
  {
    for(std::size_t k = 0; k < m_vertices.entries().size(); ++k)
      if(Entry& entry = m_vertices.entries()[k]; !is_finite(Domain::coordinates(entry.rest)))
        if(const Point point = present(entry.vertex); mend(entry, point))
        {
          m_vertices.present_points()[k] = point;
          region_changed();
        }
  }

  // f(k, entry) for each entry: points are copied before any is changed, as copies may throw
  template <typename Function>
  std::vector<Point> points_of_entries(const Function& f) const
  {
    const std::vector<Entry>& entries = m_vertices.entries();
    // copies of one, which push_back() would take twice the time for; points need no default
    // constructor
    std::vector<Point> points(entries.size(), Domain::make_point({0, 0, 0}));
    for(std::size_t k = 0; k < points.size(); ++k)
      points[k] = f(k, entries[k]);
    return points;
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_HISTORY_H
