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
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/minimizer/rigid_start.h>
#include <CGAL/ARAP_deformation/internal/region/Disjoint_sets.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/rotation_vectors.h>
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Whether something that is fixed, or a target, is torn away from its neighbours: by more than a
// tenth of the size of the rest shape. `size` is the squared diagonal of its bounding box.
inline bool is_torn(const Region& region, const Constraints& constraints, double size,
                    const Targets& targets, const std::vector<Coordinates>& x)
{
  const int n = region.number_of_movable_vertices;
  const auto is_free = [&](int v) { return v < n && !constraints.is_fixed[v]; };
  const auto is_far = [&](const Coordinates& d) { return dot(d, d) > 0.01 * size; };
  for(int r = 0; r < constraints.rows.size(); ++r)
    if(is_far(difference(targets.soft[static_cast<std::size_t>(r)],
                         constraints.rows.value(r, x.data()))))
      return true;
  for(int s = 0; s < region.number_of_simplices(); ++s)
  {
    const int* const begin = region.corners_of(s);
    const int* const end = begin + region.number_of_corners(s);
    const int* const free = std::find_if(begin, end, is_free);
    for(const int* v = begin; v != end && free != end; ++v)
      if(!is_free(*v))
      {
        const auto i = static_cast<std::size_t>(*v), j = static_cast<std::size_t>(*free);
        if(is_far(difference(difference(x[i], x[j]), difference(region.rest[i], region.rest[j]))))
          return true;
      }
  }
  return false;
}

// Rotations for the first guess of a run (Zayer et al. 2005): each handle, a set of connected
// vertices that are fixed or have a target, is turned by some rotation against the rest shape, and
// the rotation vectors of these are interpolated harmonically. A vertex alone has no rotation,
// unless it is a frame: it is left out, by dividing through what the number 1 at all others
// becomes.
class Harmonic_rotations
{
public:
  Harmonic_rotations(const Region& region, const Constraints& constraints,
                     const Targets& targets, const std::vector<Coordinates>& x)
    : m_known(region.number_of_vertices(), Coordinates{0, 0, 0}),
      m_is_known(region.number_of_vertices(), 0), m_constraints(constraints)
  {
    const int n = region.number_of_movable_vertices;
    Array<int> row_of(region.number_of_vertices(), -1);
    for(int r = 0; r < constraints.rows.size(); ++r)
      if(const int v = constraints.rows.position(r); v >= 0)
        row_of[v] = r;
    const auto is_handle = [&](int v) {
      return v >= n || constraints.is_fixed[v] || row_of[v] >= 0;
    };
    Disjoint_sets sets(region.number_of_vertices());
    for(int s = 0; s < region.number_of_simplices(); ++s)
    {
      const int* const begin = region.corners_of(s);
      const int* const end = begin + region.number_of_corners(s);
      const int* const first = std::find_if(begin, end, is_handle);
      for(const int* v = first; v != end; ++v)
        if(is_handle(*v))
          sets.unite(*first, *v);
    }
    std::map<int, std::vector<int>> handles;
    for(int v = 0; v < region.number_of_vertices(); ++v)
      if(is_handle(v))
        handles[sets.find(v)].push_back(v);
    const auto place = [&](int v) {
      return v < n && !constraints.is_fixed[v] ? targets.soft[static_cast<std::size_t>(row_of[v])]
                                               : x[static_cast<std::size_t>(v)];
    };
    for(const auto& handle : handles)
    {
      const std::vector<int>& vertices = handle.second;
      if(vertices.size() < 2)
        continue;
      const Rigid_fit fit(vertices.size(), [&](std::size_t k) { return region.rest[vertices[k]]; },
                          [&](std::size_t k) { return place(vertices[k]); });
      for(int v : vertices)
        set(v, fit.rotation());
    }
    for(const Frame& frame : targets.frames)
      set(frame.vertex, frame.rotation);
    m_are_all_known = true;
    for(int v = 0; v < region.number_of_vertices(); ++v)
      m_are_all_known &= !is_handle(v) || m_is_known[v];
  }

  // the rotation of each vertex, or nothing if no handle has one, or if the solver fails
  Array<Matrix_3x3> operator()(const Deformation_energy& energy, Constrained_system& system) const
  {
    Array<Matrix_3x3> rotations;
    if(std::find(m_is_known.begin(), m_is_known.end(), 1) == m_is_known.end())
      return rotations;
    Array<Coordinates> ones(m_known.size());
    for(std::size_t v = 0; v < ones.size(); ++v)
      ones[v] = {m_is_known[v] ? 1.0 : 0.0, 0, 0};
    Array<Coordinates> vectors = m_known;
    if(!extend(energy, system, vectors) || (!m_are_all_known && !extend(energy, system, ones)))
      return rotations;
    rotations.reserve(vectors.size());
    for(std::size_t v = 0; v < vectors.size(); ++v)
    {
      const double share = m_are_all_known ? 1 : ones[v][0];
      rotations.push_back(
        rotation_of_vector(share > 1e-9 ? scaled(vectors[v], 1 / share) : Coordinates{0, 0, 0}));
    }
    return rotations;
  }

private:
  void set(int v, const Matrix_3x3& rotation)
  {
    m_known[v] = rotation_vector(rotation);
    m_is_known[v] = 1;
  }

  // harmonic between what is fixed; rows pull to what is known at their vertices
  bool extend(const Deformation_energy& energy, Constrained_system& system,
              Array<Coordinates>& values) const
  {
    const int n = energy.number_of_movable_vertices();
    const auto is_free = [&](int v) { return v < n && !m_constraints.is_fixed[v]; };
    std::vector<Coordinates> solution(static_cast<std::size_t>(n), Coordinates{0, 0, 0});
    energy.for_each_edge([&](int i, int j, double w) {
      if(is_free(i) && !is_free(j))
        add(solution[static_cast<std::size_t>(i)], w, values[j]);
      else if(is_free(j) && !is_free(i))
        add(solution[static_cast<std::size_t>(j)], w, values[i]);
    });
    m_constraints.rows.for_each_entry([&](int i, int j, double entry) {
      if(is_free(i) && is_free(j))
      {
        add(solution[static_cast<std::size_t>(i)], entry, values[j]);
        if(i != j)
          add(solution[static_cast<std::size_t>(j)], entry, values[i]);
      }
    });
    if(!system.solve(solution))
      return false;
    for(int v = 0; v < n; ++v)
      if(is_free(v))
        values[v] = solution[static_cast<std::size_t>(v)];
    return true;
  }

  Array<Coordinates> m_known; // the rotation vectors of handles
  Array<char> m_is_known;
  bool m_are_all_known = false;
  const Constraints& m_constraints;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_HARMONIC_ROTATIONS_H
