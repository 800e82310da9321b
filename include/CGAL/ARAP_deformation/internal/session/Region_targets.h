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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_REGION_TARGETS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_REGION_TARGETS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/domain/Domain_region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Prepared_region.h>
#include <CGAL/ARAP_deformation/internal/session/Session_vertices.h>
#include <CGAL/ARAP_deformation/internal/session/Time_step.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// What the control vertices and control points of a session mean for the vertices of its prepared
// region: where a run starts, and what its rows ask for.
template <typename Domain>
class Region_targets
{
public:
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using Vertices = Session_vertices<Domain>;
  using Entry = typename Vertices::Entry;
  using Prepared = Prepared_region<Domain>;
  using Force = std::function<Coordinates(vertex_descriptor)>; // none if it is empty

  Region_targets(const Vertices& vertices, const Prepared& prepared)
    : m_vertices(vertices), m_prepared(prepared)
  {}

  // Moves the hard control vertices to their targets, and reads the targets of the others.
  Outcome read(Array<Coordinates>& positions, Targets& targets) const
  {
    const auto& region = m_prepared.region();
    const auto& rows = m_prepared.rows();
    for(std::size_t k : rows.controls)
    {
      const Entry& entry = m_vertices.entries()[k];
      const auto& whole_target = m_vertices.whole_target(entry);
      const Coordinates target = Domain::coordinates(whole_target.point);
      if(whole_target.weight > 0 && !is_finite(target) && !whole_target.set)
        return outcome_of_vertex(Status::non_finite_point, domain().index(entry.vertex),
                                 "the target of ");
      const int v = m_prepared.number_of_entry(k);
      if(v >= 0 && m_vertices.is_hard_control(entry))
        positions[v] = target;
    }
    targets.soft.reserve(rows.soft_vertices.size() + rows.soft_points.size());
    for(int v : rows.soft_vertices)
      append_target(*m_vertices.find_target(region.vertices[v]), {0, 0, 0}, targets);
    for(const auto& [point, held] : m_vertices.points())
      if(held.target.weight > 0 && !is_finite(Domain::coordinates(held.target.point)) &&
         !held.target.set)
        return outcome(Status::non_finite_point, "the target of " + control_point_name(point));
    for(const auto* points : {&rows.soft_points, &rows.hard_points})
      for(Control_point point : *points)
      {
        const auto& held = m_vertices.points().at(point);
        const Coordinates fixed = fixed_share(held, positions);
        if(points == &rows.soft_points)
          append_target(held.target, fixed, targets);
        else
          targets.hard.push_back(difference(Domain::coordinates(held.target.point), fixed));
      }
    add_frames(targets);
    return outcome(Status::success);
  }

  // Moves the free vertices to where their inertia takes them, which the last soft rows ask for.
  Outcome begin(Time_step& step, const Force& force, Array<Coordinates>& positions,
                Targets& targets) const
  {
    const auto& region = m_prepared.region();
    const Array<double>& contents = m_prepared.rows().contents;
    step.start = m_prepared.positions();
    step.goals = positions;
    for(std::size_t v = 0; v < contents.size(); ++v)
    {
      if(contents[v] == 0)
        continue;
      const vertex_descriptor vertex = region.vertices[v];
      step.goals[v] = step.goal(positions[v], m_vertices.velocity(m_vertices.find(vertex)));
      if(force)
        add(step.goals[v], step.mobility(contents[v]), force(vertex));
      if(is_planar<Domain>)
        step.goals[v][2] = 0;
      if(!is_finite(step.goals[v]))
        return outcome_of_vertex(Status::non_finite_point, domain().index(vertex),
                                 "where velocity and forces take ");
      targets.soft.push_back(step.goals[v]);
    }
    positions = step.goals;
    return outcome(Status::success);
  }

  // Of all entries; hard control vertices are moved to their targets at once
  Array<Coordinates> velocities_after(const Time_step& step,
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
                         Domain::coordinates(m_vertices.present_points()[k]));
      else if(const int v = m_prepared.number_of_entry(k); v >= 0)
        way = difference(positions[v], step.start[v]);
      velocities[k] = scaled(way, 1 / step.dynamics.time_step);
    }
    return velocities;
  }

private:
  // the rotations that are given to cells at control vertices
  void add_frames(Targets& targets) const
  {
    for(std::size_t k : m_prepared.rows().controls)
      if(const auto& rotation = m_vertices.whole_target(m_vertices.entries()[k]).rotation)
        if(const int v = m_prepared.number_of_entry(k); v >= 0)
          targets.frames.push_back({v, *rotation});
  }

  // What corners that are not movable add to the position of a control point: they are no part of
  // its row.
  Coordinates fixed_share(const typename Vertices::Held_point& held,
                          const Array<Coordinates>& positions) const
  {
    return held.position([&](vertex_descriptor v) {
      const int number = m_prepared.region().find_vertex(domain(), v);
      if(number >= 0)
        return number < m_prepared.core().region().number_of_movable_vertices
                 ? Coordinates{0, 0, 0} : positions[number];
      const Entry& entry = *m_vertices.find(v);
      return Domain::coordinates(m_vertices.is_hard_control(entry) ? m_vertices.target(entry)
                                                                   : m_vertices.present(entry));
    });
  }

  // adds the target of a soft row that lacks a share of its position
  static void append_target(const typename Vertices::Target& target, const Coordinates& share,
                            Targets& targets)
  {
    targets.soft.push_back(difference(Domain::coordinates(target.point), share));
    if(!target.set)
      return;
    if(Domain::coordinates(Domain::make_point({1 + 1e-10, 0, 0}))[0] == 1)
      targets.precision = 1e-7; // of type float
    targets.add_set([&target, share](Coordinates c) {
      add(c, 1, share);
      return difference(Domain::coordinates(target.set(Domain::make_point(c))), share);
    });
  }

  const Domain& domain() const { return m_vertices.domain(); }

  const Vertices& m_vertices;
  const Prepared& m_prepared;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_REGION_TARGETS_H
