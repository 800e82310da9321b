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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_TORN_PARTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_TORN_PARTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Parts.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace CGAL {
namespace ARAP {
namespace internal {

// Where free vertices meet others.
struct Free_neighborhood
{
  Array<char> is_near; // for each vertex: it is in a simplex with a free one
  Array<std::array<int, 2>> ties; // a free vertex with one that is not: see find_torn()
};

// In each simplex all free vertices are tied to all that are not free.
inline Free_neighborhood find_free_neighborhood(const Region& region, const Array<char>& is_fixed)
{
  const int n = region.number_of_movable_vertices;
  const auto is_free = [&](int v) { return v < n && !is_fixed[v]; };
  Free_neighborhood result = {Array<char>(region.number_of_vertices(), false), {}};
  for(int s = 0; s < region.number_of_simplices(); ++s)
  {
    const Index_range corners = region.corners_of(s);
    if(std::none_of(corners.begin(), corners.end(), is_free))
      continue;
    for(int v : corners)
    {
      result.is_near[v] = true;
      for(int u : corners)
        if(!is_free(v) && is_free(u))
          result.ties.push_back({u, v});
    }
  }
  return result;
}

// Marks the parts from which something that is fixed is torn away: a distance between neighbors has
// changed by more than a tenth of their size. Lengths are compared, as a handle that has turned
// takes its neighbors with it: where edges are long, it would count as torn in each later frame.
inline void find_torn(const Array<std::array<int, 2>>& ties, const Array<Coordinates>& rest,
                      const Parts& parts, const Array<Coordinates>& x, Array<char>& is_torn)
{
  for(const auto& [i, j] : ties)
    if(const int part = parts.part_of(i); part >= 0 && !is_torn[part])
    {
      const Coordinates now = difference(x[i], x[j]), before = difference(rest[i], rest[j]);
      const double change = std::sqrt(dot(now, now)) - std::sqrt(dot(before, before));
      is_torn[part] = change * change > 0.01 * parts.squared_size(part);
    }
}

// The same where soft targets are as far away, and their pulls are not in balance with other
// forces: a target of little weight that stays away is no reason to begin again. force() returns
// minus half the gradient of the energy at x.
template <typename Function>
void find_torn(const Constraints& constraints, const Targets& targets, const Parts& parts,
               const Array<Coordinates>& x, const Function& force, Array<char>& is_torn)
{
  const Array<Coordinates>* forces = nullptr;
  for(int r = 0; r < constraints.rows.size(); ++r)
  {
    const auto row = constraints.rows.row(r);
    const auto v = std::find_if(row.begin(), row.end(), [&](int u) { return parts.is_free(u); });
    const int part = v == row.end() ? -1 : parts.part_of(*v);
    if(part < 0 || is_torn[part])
      continue;
    const Coordinates way = difference(targets.soft[r], constraints.rows.value(r, x.data()));
    if(!(dot(way, way) > 0.01 * parts.squared_size(part)))
      continue;
    if(forces == nullptr)
      forces = &force();
    Coordinates sum = {0, 0, 0};
    double factor = 0;
    row.for_each_coefficient([&](int u, double b) {
      if(!constraints.is_fixed[u])
      {
        add(sum, b, (*forces)[u]);
        factor += b * b * constraints.rows.weight(r);
      }
    });
    is_torn[part] = dot(sum, sum) > 0.25 * factor * factor * dot(way, way);
  }
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_TORN_PARTS_H
