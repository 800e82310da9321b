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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_REGION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_REGION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/region/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace CGAL {
namespace ARAP {
namespace internal {

// A surface with about a fifth of the vertices of another, where that can move: the vertices next
// to one of its nodes are a cell of a Voronoi diagram by numbers of edges, and where three cells or
// more meet in a polygon they have one in the dual. Fixed vertices next to free ones have nodes of
// their own, closer to each other.
class Coarse_region
{
public:
  // `is_fixed` has an entry for each movable vertex
  Coarse_region(const Region& fine, const Array<char>& is_fixed)
    : m_is_free(free_vertices(fine, is_fixed)), m_space(graph_of(fine), others(m_is_free), 12)
  {
    const int m = m_space.number_of_nodes();
    m_region.number_of_movable_vertices = m_region.number_of_centres =
      m_region.number_of_vertex_cells = m;
    m_region.rest.reserve(static_cast<std::size_t>(m));
    for(int node = 0; node < m; ++node)
      m_region.rest.push_back(fine.rest[m_space.vertex_of(node)]);
    m_region.indices = Array<std::size_t>(m);
    std::iota(m_region.indices.begin(), m_region.indices.end(), std::size_t(0));
    for(int s = 0; s < fine.number_of_simplices(); ++s)
      if(has_free(fine, s))
        add_polygon(fine, s);
    m_region.number_of_movable_simplices = m_region.number_of_simplices();
  }

  const Region& region() const { return m_region; }
  const Coarse_space& space() const { return m_space; }
  bool is_fixed(int node) const { return !m_is_free[m_space.vertex_of(node)]; }

private:
  static Array<char> free_vertices(const Region& fine, const Array<char>& is_fixed)
  {
    Array<char> result(fine.number_of_vertices(), false);
    for(int v = 0; v < fine.number_of_movable_vertices; ++v)
      result[v] = !is_fixed[v];
    return result;
  }

  static Array<char> others(Array<char> chosen)
  {
    for(char& is_chosen : chosen)
      is_chosen = !is_chosen;
    return chosen;
  }

  bool has_free(const Region& fine, int s) const
  {
    const int* const begin = fine.corners_of(s);
    return std::any_of(begin, begin + fine.number_of_corners(s),
                       [this](int v) { return m_is_free[v] != 0; });
  }

  // the neighbours of each vertex in polygons that have free vertices, twice for two polygons
  Index_lists graph_of(const Region& fine) const
  {
    return lists_of_pairs(fine.number_of_vertices(), [&](const auto& f) {
      for(int s = 0; s < fine.number_of_simplices(); ++s)
        if(has_free(fine, s))
        {
          const int* const corners = fine.corners_of(s);
          for(int n = fine.number_of_corners(s), k = n - 1, l = 0; l < n; k = l++)
          {
            f(corners[k], corners[l]);
            f(corners[l], corners[k]);
          }
        }
    });
  }

  void add_polygon(const Region& fine, int s)
  {
    Array<int>& corners = m_region.corners;
    const auto first = static_cast<std::ptrdiff_t>(corners.size());
    for(int k = 0; k < fine.number_of_corners(s); ++k)
      if(const int node = m_space.nodes(fine.corners_of(s)[k])[0];
         std::find(corners.begin() + first, corners.end(), node) == corners.end())
        corners.push_back(node);
    if(corners.size() < static_cast<std::size_t>(first) + 3)
      corners.resize(static_cast<std::size_t>(first));
    else
      m_region.first_corner.push_back(static_cast<int>(corners.size()));
  }

  Array<char> m_is_free; // for each vertex
  Coarse_space m_space;
  Region m_region;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_REGION_H
