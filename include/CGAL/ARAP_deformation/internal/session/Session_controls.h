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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_CONTROLS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_CONTROLS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/is_in_domain.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Built_core.h>
#include <CGAL/ARAP_deformation/internal/session/Cell_values.h>
#include <CGAL/ARAP_deformation/internal/session/Held_point.h>
#include <CGAL/ARAP_deformation/internal/session/Prepared_region.h>
#include <CGAL/ARAP_deformation/internal/session/Session_rules.h>
#include <CGAL/ARAP_deformation/internal/session/Session_vertices.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The options, the region of interest, and its control vertices and control points. What is changed
// here tells the prepared region which stages are out of date. No call is taken while a run works.
template <typename Domain>
class Session_controls
{
public:
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using simplex_descriptor = typename Domain::simplex_descriptor;
  using Point = typename Domain::Point;
  using Vertices = Session_vertices<Domain>;

  using Entry = typename Vertices::Entry;

  // Options that are out of range are refused by what uses them.
  Session_controls(Domain mesh, const Session_rules& rules, const Options& options,
                   Built_core::Models make_models)
    : m_vertices(std::move(mesh)), m_rules(rules), m_options(options),
      m_prepared(rules, std::move(make_models))
  {}

  const Options& options() const { return m_options; }

  Outcome set_options(const Options& options)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    Outcome checked = options.check();
    if(checked)
    {
      if(options.cells != m_options.cells)
        region_changed();
      if(options.bending_length != m_options.bending_length ||
         options.smoothing_length != m_options.smoothing_length)
        values_changed();
      m_options = options;
    }
    return checked;
  }

  const Vertices& vertices() const { return m_vertices; }

  // Where results are written elsewhere, an input that was not finite may have been mended.
  Point present(vertex_descriptor v) const
  {
    if(takes_points())
      return domain().point(v);
    const Point present = m_vertices.present(v);
    return domain().is_in_place() || is_finite(Domain::coordinates(present))
             ? present : Point(domain().point(v));
  }

  Point present(Control_point point) const
  {
    return point_at(point, [this](vertex_descriptor v) { return present(v); });
  }

  // the point of a vertex in the rest shape: where it is not finite, the one that it has now, which
  // the next run takes
  Point rest_point(vertex_descriptor v) const
  {
    const Point rest = m_vertices.rest(v);
    return is_finite(Domain::coordinates(rest)) ? rest : present(v);
  }

  Point rest_point(Control_point point) const
  {
    return point_at(point, [this](vertex_descriptor v) { return rest_point(v); });
  }

  // The functions that change the sets of vertices return whether they did.

  bool insert_roi(vertex_descriptor v)
  {
    return !refuse_in_a_run() && m_vertices.insert_roi(v) && region_changed();
  }

  template <typename InputIterator>
  void insert_roi(InputIterator begin, InputIterator end)
  {
    using Category = typename std::iterator_traits<InputIterator>::iterator_category;
    if(refuse_in_a_run())
      return;
    if constexpr(std::is_base_of_v<std::forward_iterator_tag, Category>)
      if(m_vertices.entries().empty()) // later, many of them may be there
        m_vertices.reserve(static_cast<std::size_t>(std::distance(begin, end)));
    for(; begin != end; ++begin)
      insert_roi(*begin);
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
    if(!m_vertices.insert_control(v, [this](vertex_descriptor u) { return present(u); }))
      return false;
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
    Held_point<Domain> held = {{}, {}, {Domain::make_point({0, 0, 0})}};
    if(!collect_corners(s, held.corners))
      return Control_point_insertion(Outcome(
        Status::not_a_simplex, "the simplex that was given for a control point is not there"));
    held.coordinates.assign(std::begin(coordinates), std::end(coordinates));
    if(held.coordinates.size() != held.corners.size() || !complete(held.coordinates))
      return Control_point_insertion(outcome(Status::invalid_coordinates, "a control point"));
    for(std::size_t k = held.corners.size(); k-- > 0;)
      if(held.coordinates[k] == 0)
      {
        held.corners.erase(held.corners.begin() + static_cast<std::ptrdiff_t>(k));
        held.coordinates.erase(held.coordinates.begin() + static_cast<std::ptrdiff_t>(k));
      }
    held.target.point = Domain::make_point(held.position(
      [this](vertex_descriptor v) { return Domain::coordinates(present(v)); }));
    // before what may throw: no region that is there knows the entries that are made
    const bool is_in_roi =
      std::all_of(held.corners.begin(), held.corners.end(),
                  [this](vertex_descriptor v) { return m_vertices.is_roi(v); });
    is_in_roi ? constraints_changed() : region_changed();
    const Control_point point = m_vertices.insert_point(std::move(held));
    return Control_point_insertion(Outcome(Status::success, std::string()), point);
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

  // The stiffness of cells, and which share a rotation. `change` is called with the values.
  template <typename Function>
  Outcome change_cell_values(const Function& change)
  {
    if(refuse_in_a_run())
      return outcome(Status::in_a_run);
    change(m_cell_values);
    values_changed();
    return Outcome(Status::success, std::string());
  }

  double energy() const { return m_energy; }

protected:
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  const Domain& domain() const { return m_vertices.domain(); }

  std::string name(vertex_descriptor v) const
  {
    return is_vertex_of(domain(), v) ? vertex_name(domain().index(v))
                                     : "a vertex that the mesh does not have";
  }

  std::string name(Control_point point) const { return control_point_name(point); }

  // the control point if its corners are where a function of vertices tells
  template <typename Function>
  Point point_at(Control_point point, const Function& f) const
  {
    const auto found = m_vertices.points().find(point);
    return Domain::make_point(
      found == m_vertices.points().end()
        ? Coordinates{0, 0, 0}
        : found->second.position([&](vertex_descriptor v) { return Domain::coordinates(f(v)); }));
  }

  // the corners of a simplex; false if it is not one of the domain
  bool collect_corners(const simplex_descriptor& s, std::vector<vertex_descriptor>& corners) const
  {
    if(!is_simplex_of(domain(), s))
      return false;
    for(vertex_descriptor v : domain().simplex_vertices(s))
      corners.push_back(v);
    bool is_there = false;
    if(!corners.empty())
      domain().for_each_incident_simplex(
        corners[0], [&](const simplex_descriptor& t, const auto&) { is_there |= t == s; });
    return is_there;
  }

  // Adds what a sum of barycentric coordinates lacks of 1 to the largest of them: a division would
  // move points that are far away. Returns false if that is more than rounding errors.
  static bool complete(std::vector<double>& coordinates)
  {
    if(!add_up_to_one(coordinates))
      return false;
    double& largest = *std::max_element(coordinates.begin(), coordinates.end(),
      [](double a, double b) { return std::abs(a) < std::abs(b); });
    largest += 1 - std::accumulate(coordinates.begin(), coordinates.end(), 0.0);
    return true;
  }

  // sets a flag from its construction to its destruction
  class Scoped_flag
  {
  public:
    explicit Scoped_flag(bool& flag) : m_flag(flag), m_before(std::exchange(flag, true)) {}
    Scoped_flag(const Scoped_flag&) = delete;
    Scoped_flag& operator=(const Scoped_flag&) = delete;
    ~Scoped_flag() { m_flag = m_before; }

  private:
    bool& m_flag;
    const bool m_before;
  };

  // Whether a run is under way, so that a visitor or another user function has made the call.
  bool refuse_in_a_run() const
  {
    CGAL_precondition_msg(!m_is_in_a_run,
                          "a visitor, function or map that a run calls must not change the object");
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

  // Writes points by a function: the map of a user may throw.
  template <typename Function>
  void set_points(const Function& write)
  {
    const Scoped_flag in_a_run(m_is_in_a_run);
    m_are_points_written = false;
    write();
    m_are_points_written = true;
  }

  // Whether points are looked at that others may have moved. CGAL's class does not look at them,
  // and after a call that failed in writing, some may be its own.
  bool takes_points() const
  {
    return m_rules.order == Minimization_order::local_first && domain().is_in_place() &&
           m_are_points_written;
  }

  std::shared_ptr<const char> m_identity = std::make_shared<char>(); // of this session
  Vertices m_vertices;
  Session_rules m_rules;
  Options m_options;
  double m_energy = not_a_number;
  bool m_is_in_a_run = false;
  bool m_are_points_written = true; // by the last call that writes points, all of them
  bool m_is_region_written = true;  // whether note_region_as_written() was called since its change
  Cell_values<Domain> m_cell_values;
  Prepared_region<Domain> m_prepared;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_CONTROLS_H
