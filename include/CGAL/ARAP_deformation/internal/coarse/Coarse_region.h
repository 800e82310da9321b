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

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// A surface with about a fifth of the vertices of another, which are its nodes, around all that can
// move. The vertices nearest to a node, in numbers of edges, are its Voronoi cell, and where three
// cells or more meet in a polygon there is one with their nodes. Fixed vertices have nodes of their
// own, closer to each other: a shape bends most where it is held.
class Coarse_region
{
public:
  // `fine` is a surface, and `is_fixed` has an entry for each of its movable vertices. `is_near`
  // tells which vertices are free or beside such: all polygons at these are needed, as fixed
  // vertices have cells, too.
  Coarse_region(const Region& fine, const Array<char>& is_fixed, const Array<char>& is_near)
    : m_is_fixed(is_fixed), m_space(space_of(fine, is_near))
  {
    const int m = m_space.number_of_nodes();
    m_region.is_planar = fine.is_planar;
    m_region.number_of_movable_vertices = m_region.number_of_centers =
      m_region.number_of_vertex_cells = m;
    m_region.rest.reserve(static_cast<std::size_t>(m));
    for(int node = 0; node < m; ++node)
      m_region.rest.push_back(fine.rest[m_space.vertex_of(node)]);
    m_region.indices = Array<std::size_t>(m);
    std::iota(m_region.indices.begin(), m_region.indices.end(), std::size_t(0));
    for(int s = 0; s < fine.number_of_simplices(); ++s)
      if(has_corner(fine, s, is_near))
        add_polygon(fine, s);
    m_region.number_of_movable_simplices = m_region.number_of_simplices();
  }

  Region release_region() { return std::move(m_region); }
  const Coarse_space& space() const { return m_space; }
  bool is_fixed(int node) const { return m_is_fixed[m_space.vertex_of(node)] != 0; }

private:
  // makes about one vertex in five a node, as balls overlap
  static constexpr std::size_t vertices_of_a_ball = 12;

  static bool has_corner(const Region& fine, int s, const Array<char>& is_chosen)
  {
    const auto [begin, end] = fine.corners_of(s);
    return std::any_of(begin, end, [&](int v) { return is_chosen[v] != 0; });
  }

  Coarse_space space_of(const Region& fine, const Array<char>& is_near)
  {
    m_is_fixed.resize(static_cast<std::size_t>(fine.number_of_vertices()), true); // the others
    return Coarse_space(graph_of(fine, is_near), fine.rest, m_is_fixed, vertices_of_a_ball);
  }

  // the neighbors of each vertex, twice where they are so in two polygons
  static Index_lists graph_of(const Region& fine, const Array<char>& is_near)
  {
    return lists_of_pairs(fine.number_of_vertices(), [&](const auto& f) {
      for(int s = 0; s < fine.number_of_simplices(); ++s)
        if(has_corner(fine, s, is_near))
        {
          int last = *std::prev(fine.corners_of(s).end());
          for(int v : fine.corners_of(s))
          {
            f(last, v);
            f(v, last);
            last = v;
          }
        }
    });
  }

  void add_polygon(const Region& fine, int s)
  {
    Array<int>& corners = m_region.corners;
    const auto first = static_cast<std::ptrdiff_t>(corners.size());
    for(int v : fine.corners_of(s))
      if(const int node = m_space.nodes(v)[0];
         std::find(corners.begin() + first, corners.end(), node) == corners.end())
        corners.push_back(node);
    if(corners.size() < static_cast<std::size_t>(first) + 3)
      corners.resize(static_cast<std::size_t>(first));
    else
      m_region.first_corner.push_back(static_cast<int>(corners.size()));
  }

  Array<char> m_is_fixed; // for each vertex
  Coarse_space m_space;
  Region m_region;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_REGION_H
