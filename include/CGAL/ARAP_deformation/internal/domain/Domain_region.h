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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DOMAIN_REGION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DOMAIN_REGION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>
#include <CGAL/ARAP_deformation/internal/region/Numbered_region.h>
#include <CGAL/ARAP_deformation/internal/region/Paged_index_map.h>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Domain>
using Triangles_only = decltype(Domain::has_triangles_only);

// whether the points of a domain have two coordinates
template <typename Domain, typename = void>
constexpr bool is_planar = false;
template <typename Domain>
constexpr bool is_planar<Domain, std::void_t<decltype(Domain::is_planar)>> = Domain::is_planar;

// A region with the names of its vertices and simplices in a mesh. It is collected by walking over
// the region only.
template <typename Domain>
class Domain_region : public Numbered_region
{
public:
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using simplex_descriptor = typename Domain::simplex_descriptor;

  Array<vertex_descriptor> vertices;
  std::vector<simplex_descriptor> simplices;

  // Collects the region of the given movable vertices, which are distinct, for cells of the stars
  // within `cell_rings` rings; positions are filled in later. Movable vertices are numbered in
  // breadth-first order, so that what is near in the mesh is near in memory. Returns false if there
  // is something that is not a simplex, or has too many corners: refused_vertex() is the index of
  // the vertex where, and refusal() says which.
  bool collect(const Domain& domain, const std::vector<vertex_descriptor>& movable_vertices,
               int cell_rings)
  {
    flat.dimension = Domain::dimension;
    flat.is_planar = is_planar<Domain>;
    for(vertex_descriptor v : movable_vertices)
      add_movable(domain.index(v));
    vertices.assign(movable_vertices.begin(), movable_vertices.end());

    int number_of_visited = 0;
    for(vertex_descriptor v : movable_vertices) // a seed in each component
    {
      number(domain, v);
      if(!collect_simplices(domain, number_of_visited, number_of_found()))
        return false;
      number_of_visited = number_of_found();
    }
    flat.number_of_movable_simplices = flat.number_of_simplices();
    // a cell that has a movable vertex is within cell_rings + 1 rings, and so many more its stars
    flat.number_of_centers = flat.number_of_movable_vertices;
    for(int ring = 1; ring <= 2 * cell_rings + 1; ++ring)
    {
      const int begin = std::exchange(flat.number_of_centers, static_cast<int>(vertices.size()));
      if(ring == cell_rings + 1)
        flat.number_of_vertex_cells = flat.number_of_centers;
      if(!collect_simplices(domain, begin, flat.number_of_centers))
        return false;
    }
    first_simplex.push_back(flat.number_of_simplices());
    shrink();
    vertices.shrink_to_fit();
    simplices.shrink_to_fit();
    return true;
  }

  // the number of v in the region, or -1
  int find_vertex(const Domain& domain, vertex_descriptor v) const
  {
    return numbers[domain.index(v)];
  }

  // the number of s in the region, or -1
  int find_simplex(const Domain& domain, simplex_descriptor s) const
  {
    int smallest = static_cast<int>(vertices.size());
    for(vertex_descriptor v : domain.simplex_vertices(s))
      smallest = (std::min)(smallest, find_vertex(domain, v));
    if(smallest == Paged_index_map::none || smallest + 1 >= static_cast<int>(first_simplex.size()))
      return -1;
    const auto begin = simplices.begin() + first_simplex[smallest];
    const auto end = simplices.begin() + first_simplex[smallest + 1];
    const auto found = std::find(begin, end, s);
    return found == end ? -1 : static_cast<int>(found - simplices.begin());
  }

private:
  int number(const Domain& domain, vertex_descriptor v)
  {
    const int found_before = number_of_found();
    const int n = Numbered_region::number(domain.index(v));
    if(number_of_found() > found_before)
      vertices[n] = v;
    else if(n == static_cast<int>(vertices.size()))
      vertices.push_back(v);
    return n;
  }

  // Visits the vertices from `begin` to `end`, which moves on while movable vertices are found.
  // They are visited in the order of their numbers, and what is not yet numbered gets a larger
  // number: a simplex is met first at its smallest vertex.
  bool collect_simplices(const Domain& domain, int begin, const int& end)
  {
    for(int v = begin; v < end; ++v)
    {
      first_simplex.push_back(flat.number_of_simplices());
      const vertex_descriptor at = vertices[v];
      domain.for_each_incident_simplex(
        at, [&](simplex_descriptor s, const auto& corners) {
          for(vertex_descriptor corner : corners)
            if(!add_corner(v, corner == at ? v : number(domain, corner)))
              return;
          add_simplex(are_polygons_allowed);
          simplices.push_back(s);
        });
      if(is_refused())
        return false;
    }
    return true;
  }

  static constexpr bool are_polygons_allowed =
    Domain::dimension == 2 && !is_valid<Triangles_only, Domain>;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DOMAIN_REGION_H
