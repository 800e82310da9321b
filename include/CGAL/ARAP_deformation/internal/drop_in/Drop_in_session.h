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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_DROP_IN_SESSION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_DROP_IN_SESSION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Default_visitor.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Session.h>
#include <CGAL/ARAP_deformation/internal/session/Session_rules.h>

#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// A session with the rules of CGAL's Surface_mesh_deformation: what leaves the region of interest
// returns to the rest shape when the region is next used, and finite targets survive erasing the
// control vertex.
template <typename Domain>
class Drop_in_session : public Session<Domain>
{
  using Base = Session<Domain>;
  using Base::m_prepared;
  using Base::m_vertices;

public:
  using Entry = typename Base::Entry;
  using Point = typename Base::Point;
  using vertex_descriptor = typename Base::vertex_descriptor;

  template <typename Traits>
  Drop_in_session(Domain domain, const Traits& traits)
    : Base(std::move(domain), traits, cgal_rules())
  {}

  using Base::refuse_in_a_run;

  bool erase_roi(vertex_descriptor v)
  {
    keep_target(m_vertices.find_control(v));
    return Base::erase_roi(v);
  }

  void clear_roi()
  {
    keep_targets();
    Base::clear_roi();
  }

  bool erase_control(vertex_descriptor v)
  {
    keep_target(m_vertices.find_control(v));
    return Base::erase_control(v);
  }

  void clear_control()
  {
    keep_targets();
    Base::clear_control();
  }

  Point target(vertex_descriptor v) const
  {
    const Entry* const entry = m_vertices.find(v);
    return entry && has_just_entered(*entry) ? this->domain().point(v) : Base::target(v);
  }

  template <typename Function>
  Outcome change_target(vertex_descriptor v, const Function& f)
  {
    put_back_erased();
    return Base::change_target(v, f);
  }

  Report deform(unsigned int iterations, double tolerance)
  {
    read_entered();
    return Base::deform(iterations, tolerance, Default_visitor());
  }

  Outcome preprocess()
  {
    read_entered();
    Outcome prepared = Base::preprocess();
    if(prepared)
      put_back_erased();
    return prepared;
  }

  void reset()
  {
    put_back_erased();
    Base::reset();
  }

  void overwrite_initial_geometry()
  {
    put_back_erased();
    auto present = m_vertices.present_points(); // CGAL's class leaves its solution as it is
    Base::overwrite_initial_geometry();
    m_vertices.present_points().swap(present);
  }

  // moves what has left the region of interest back to the rest shape, and forgets its rotations
  void put_back_erased()
  {
    if(this->m_is_region_written || refuse_in_a_run())
      return;
    read_entered();
    m_prepared.forget_rotations([this](vertex_descriptor v) {
      bool is_near = m_vertices.is_roi(v);
      this->domain().for_each_incident_simplex(v, [&](const auto&, const auto& corners) {
        for(vertex_descriptor corner : corners)
          is_near = is_near || m_vertices.is_roi(corner);
      });
      return !is_near;
    });
    for(Entry& entry : m_vertices.entries())
      if(this->is_put_back(entry))
      {
        Point point = entry.rest;
        this->domain().set_point(entry.vertex, entry.rest);
        m_vertices.present(entry) = std::move(point);
      }
    this->note_region_as_written();
  }

private:
  // An erased control vertex is where its target is, from now on, if that is a place.
  void keep_target(Entry* control)
  {
    if(!control || refuse_in_a_run())
      return;
    const Point& target = m_vertices.target(*control);
    if(!is_finite(Domain::coordinates(target)))
      return;
    if(m_prepared.has_region())
      if(const int v = m_prepared.region().find_vertex(this->domain(), control->vertex); v >= 0)
        m_prepared.positions()[v] = Domain::coordinates(target);
    m_vertices.present(*control) = target;
  }

  void keep_targets()
  {
    for(Entry& entry : m_vertices.entries())
      if(entry.is_control)
        keep_target(&entry);
  }

  // What has entered the region of interest is where the mesh has it when that is next used.
  bool has_just_entered(const Entry& entry) const
  {
    return !this->m_is_region_written && !m_prepared.has_region() && entry.is_roi && !entry.was_roi;
  }

  void read_entered()
  {
    if(refuse_in_a_run())
      return;
    for(Entry& entry : m_vertices.entries())
      if(has_just_entered(entry))
      {
        const Point point = this->domain().point(entry.vertex);
        entry.rest = point;
        m_vertices.present(entry) = point;
        if(entry.is_control)
          m_vertices.target(entry) = point;
      }
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_DROP_IN_SESSION_H
