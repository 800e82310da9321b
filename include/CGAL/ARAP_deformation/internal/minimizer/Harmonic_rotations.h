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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_HARMONIC_ROTATIONS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_HARMONIC_ROTATIONS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Parts.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Rigid_fit.h>
#include <CGAL/ARAP_deformation/internal/region/Disjoint_sets.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/rotation_vectors.h>
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Rotations for the first guess of a run (Zayer et al. 2005): each handle, a set of connected
// vertices that are fixed or have a target, is turned by some rotation against the rest shape, and
// the rotation vectors of these are interpolated harmonically. Of a handle only simplices at
// vertices near free ones are seen: a region that is cut to what can move has no others.
//
// A vertex alone has no rotation, unless it is a frame, and a control point has none. But the
// factor keeps the vectors there at what they are. So two harmonic fields are computed that are 0
// there: one that has the known vectors, and one that is 1 where these are. The ratio of their
// pulls at such a vertex is the vector with which nothing would pull at it; for a single one that
// is exact. In a part where nothing has a rotation all turn as their motion does, taken as one.
class Harmonic_rotations
{
public:
  Harmonic_rotations(const Region& region, const Constraints& constraints,
                     const Parts& parts, const Array<char>& is_near, const Targets& targets,
                     const Array<Coordinates>& x)
    : m_known(region.number_of_vertices(), Coordinates{0, 0, 0}),
      m_is_known(region.number_of_vertices(), 0), m_constraints(constraints), m_parts(parts)
  {
    const int n = region.number_of_movable_vertices;
    Array<int> row_of(region.number_of_vertices(), -1);
    for(int r = 0; r < constraints.rows.size(); ++r)
      if(const int v = constraints.rows.position(r); v >= 0)
        row_of[v] = r;
    const auto is_handle = [&](int v) {
      return v >= n || constraints.is_fixed[v] || row_of[v] >= 0;
    };
    Array<char> is_seen(region.number_of_vertices(), false);
    Disjoint_sets sets(region.number_of_vertices());
    for(int s = 0; s < region.number_of_simplices(); ++s)
    {
      const auto [begin, end] = region.corners_of(s);
      if(std::none_of(begin, end, [&](int v) { return is_near[v] != 0; }))
        continue;
      const int* const first = std::find_if(begin, end, is_handle);
      for(const int* v = first; v != end; ++v)
        if(is_handle(*v))
        {
          is_seen[*v] = true;
          sets.unite(*first, *v);
        }
    }
    std::vector<std::pair<int, int>> members; // each a set and a vertex
    for(int v = 0; v < region.number_of_vertices(); ++v)
      if(is_seen[v])
        members.emplace_back(sets.find(v), v);
    const Index_lists handles = lists_by_first(std::move(members));
    const auto place = [&](int v) {
      return v < n && !constraints.is_fixed[v] ? targets.soft[row_of[v]] : x[v];
    };
    for(int h = 0; h < handles.size(); ++h)
    {
      const Index_range handle = handles.list(h);
      if(handle.size() < 2)
        continue;
      Array<Coordinates> rest, places;
      for(int v : handle)
      {
        rest.push_back(region.rest[v]);
        places.push_back(place(v));
      }
      const Rigid_fit fit(rest, places);
      for(int v : handle)
        set(v, fit.rotation());
    }
    for(const Frame& frame : targets.frames)
      if(is_handle(frame.vertex)) // and not one of weight 0, which holds nothing
        set(frame.vertex, frame.rotation);
    for(int v = 0; v < region.number_of_vertices(); ++v)
      if(is_seen[v] && !m_is_known[v])
        m_unknown.append(v, 1);
    for(const Weighted_rows* rows : {&constraints.rows, &constraints.hard_rows})
      for(int r = 0; r < rows->size(); ++r)
        if(rows == &constraints.hard_rows || rows->position(r) < 0)
          m_unknown.append(rows->row(r), rows->weight(r));
    for(int part = 0; part < parts.size(); ++part)
      find_motion(part, region, targets, x);
  }

  // The rotation vector of each vertex, or nothing if nothing tells one, or if the solver fails. To
  // be called once.
  Array<Coordinates> operator()(const Deformation_energy& energy, Constrained_system& system)
  {
    const bool are_all_known = m_unknown.size() == 0;
    const bool is_any_known =
      std::find(m_is_known.begin(), m_is_known.end(), 1) != m_is_known.end();
    if(!is_any_known && m_motions.empty())
      return {};
    Array<Coordinates> vectors = are_all_known ? std::move(m_known) : m_known;
    if(is_any_known && (!extend(energy, system, vectors) ||
                        (!are_all_known && !hold_unknown(energy, system, vectors))))
      return {};
    for(const auto& [part, vector] : m_motions)
    {
      for(int v : m_parts.free_vertices(part))
        vectors[v] = vector;
      for(int v : m_parts.fixed_vertices(part))
        vectors[v] = vector;
    }
    return vectors;
  }

private:
  // Adds the rotation of all that constrains a part, if none of it has one.
  void find_motion(int part, const Region& region, const Targets& targets,
                   const Array<Coordinates>& x)
  {
    if(!m_parts.can_be_rigid(part))
      return;
    Array<Coordinates> rest, places;
    const bool is_none_known = m_parts.for_each_constraint(
      part, region, m_constraints, targets, x,
      [&](int v, int, const Coordinates& p, const Coordinates& q) {
        rest.push_back(p);
        places.push_back(q);
        return v < 0 || !m_is_known[v];
      });
    if(is_none_known && !rest.empty())
      m_motions.emplace_back(part, rotation_vector(Rigid_fit(rest, places).rotation()));
  }

  void set(int v, const Matrix_3x3& rotation)
  {
    m_known[v] = rotation_vector(rotation);
    m_is_known[v] = 1;
  }

  // Makes values harmonic. They stay where vertices are fixed, and rows pull to what they are.
  bool extend(const Deformation_energy& energy, Constrained_system& system,
              Array<Coordinates>& values) const
  {
    Array<Coordinates> step = pulls(energy, values);
    step.resize(m_constraints.is_fixed.size());
    for(std::size_t v = 0; v < step.size(); ++v)
      if(m_constraints.is_fixed[v])
        step[v] = {0, 0, 0};
    if(!system.solve(step))
      return false;
    for(std::size_t v = 0; v < step.size(); ++v)
      if(!m_constraints.is_fixed[v])
        add(values[v], 1, step[v]);
    return true;
  }

  // by how much the neighbors pull at the value of each vertex
  static Array<Coordinates> pulls(const Deformation_energy& energy,
                                  const Array<Coordinates>& values)
  {
    Array<Coordinates> sums(values.size(), Coordinates{0, 0, 0});
    energy.for_each_edge([&](int i, int j, double w) {
      const Coordinates d = difference(values[j], values[i]);
      add(sums[i], w, d);
      add(sums[j], -w, d);
    });
    return sums;
  }

  // Replaces vectors that are 0 where they are unknown by those that are where nothing pulls them
  // away.
  bool hold_unknown(const Deformation_energy& energy, Constrained_system& system,
                    Array<Coordinates>& vectors) const
  {
    constexpr double largest = 3.2; // more than half a turn is no mean of rotation vectors
    Array<Coordinates> ones(vectors.size(), Coordinates{0, 0, 0});
    for(std::size_t v = 0; v < ones.size(); ++v)
      ones[v][0] = m_is_known[v];
    if(!extend(energy, system, ones))
      return false;
    const Array<Coordinates> pulls_of_vectors = pulls(energy, vectors),
                             pulls_of_ones = pulls(energy, ones);
    vectors = m_known;
    Array<double> sums(vectors.size(), 0); // rows may share vertices
    for(int r = 0; r < m_unknown.size(); ++r)
    {
      const Coordinates pull = m_unknown.value(r, pulls_of_vectors.data());
      const double one = m_unknown.value(r, pulls_of_ones.data())[0];
      if(one > 0 && dot(pull, pull) <= largest * largest * one * one)
        m_unknown.row(r).for_each_coefficient([&](int v, double b) {
          sums[v] += b * b;
          add(vectors[v], b * b / one, pull);
        });
    }
    for(std::size_t v = 0; v < vectors.size(); ++v)
      if(sums[v] > 0 && !m_is_known[v])
        vectors[v] = scaled(vectors[v], 1 / sums[v]);
      else
        vectors[v] = m_known[v];
    return extend(energy, system, vectors);
  }

  Array<Coordinates> m_known; // the rotation vectors of handles
  Array<char> m_is_known;
  Weighted_rows m_unknown; // single vertices and control points
  const Constraints& m_constraints;
  const Parts& m_parts;
  std::vector<std::pair<int, Coordinates>> m_motions; // parts, and their rotation vectors
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_HARMONIC_ROTATIONS_H
