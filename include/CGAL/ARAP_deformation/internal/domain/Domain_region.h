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

#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>
#include <CGAL/ARAP_deformation/internal/region/Paged_index_map.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Domain>
using Triangles_only = decltype(Domain::has_triangles_only);

// A region with the names of its vertices and simplices in a mesh. It is collected by walking over
// the region only.
template <typename Domain>
struct Domain_region
{
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using simplex_descriptor = typename Domain::simplex_descriptor;

  Region flat;
  Array<vertex_descriptor> vertices;
  std::vector<simplex_descriptor> simplices;
  // the simplices whose smallest vertex is v are first_simplex[v] to first_simplex[v + 1] - 1
  Array<int> first_simplex;
  Paged_index_map numbers; // from Domain::index() to the number in the region

  // Collects the region of the given movable vertices, which are distinct, for cells of the stars
  // within `cell_rings` rings; positions are filled in later. Movable vertices are numbered in
  // breadth-first order, so that what is near in the mesh is near in memory. Returns false if there
  // is something that is not a simplex, or has too many corners: refused_vertex() is at it, and
  // refusal() says which.
  bool collect(const Domain& domain, const std::vector<vertex_descriptor>& movable_vertices,
               int cell_rings = 0)
  {
    flat.dimension = Domain::dimension;
    flat.number_of_movable_vertices = static_cast<int>(movable_vertices.size());
    vertices.assign(movable_vertices.begin(), movable_vertices.end());
    flat.indices.resize(movable_vertices.size());
    for(vertex_descriptor v : movable_vertices)
      numbers.set(domain.index(v), movable_without_number);

    int number_of_visited = 0;
    for(vertex_descriptor v : movable_vertices) // a seed in each component
    {
      number(domain, v);
      if(!collect_simplices(domain, number_of_visited, m_number_of_found))
        return false;
      number_of_visited = m_number_of_found;
    }
    flat.number_of_movable_simplices = static_cast<int>(simplices.size());
    // a cell that has a movable vertex is within cell_rings + 1 rings, and so many more its stars
    flat.number_of_centres = flat.number_of_movable_vertices;
    for(int ring = 1; ring <= 2 * cell_rings + 1; ++ring)
    {
      const int begin = std::exchange(flat.number_of_centres, static_cast<int>(vertices.size()));
      if(ring == cell_rings + 1)
        flat.number_of_vertex_cells = flat.number_of_centres;
      if(!collect_simplices(domain, begin, flat.number_of_centres))
        return false;
    }
    first_simplex.push_back(static_cast<int>(simplices.size()));
    shrink();
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

  // the vertex at whose faces collect() stopped
  vertex_descriptor refused_vertex() const { return vertices[first_simplex.size() - 1]; }

  Status refusal() const { return m_refusal; }

private:
  static constexpr int movable_without_number = -2;

  int number(const Domain& domain, vertex_descriptor v)
  {
    const std::size_t index = domain.index(v);
    int n = numbers[index];
    if(n == movable_without_number)
    {
      n = m_number_of_found++;
      numbers.set(index, n);
      vertices[n] = v;
      flat.indices[n] = index;
    }
    else if(n == Paged_index_map::none)
    {
      n = static_cast<int>(vertices.size());
      numbers.set(index, n);
      vertices.push_back(v);
      flat.indices.push_back(index);
    }
    return n;
  }

  // Visits the vertices from `begin` to `end`, which moves on while movable vertices are found.
  // They are visited in the order of their numbers, and what is not yet numbered gets a larger
  // number: a simplex is met first at its smallest vertex.
  bool collect_simplices(const Domain& domain, int begin, const int& end)
  {
    for(int v = begin; v < end; ++v)
    {
      first_simplex.push_back(static_cast<int>(simplices.size()));
      bool are_simplices = true;
      domain.for_each_incident_simplex(
        vertices[v], [&](simplex_descriptor s, const auto& corners) {
          // what has a smaller corner was visited there, and all of its corners have numbers
          bool is_first_visit = true;
          for(vertex_descriptor corner : corners)
          {
            flat.corners.push_back(number(domain, corner));
            is_first_visit = flat.corners.back() >= v;
            if(!is_first_visit)
              break;
          }
          if(!is_first_visit)
            return flat.corners.resize(static_cast<std::size_t>(flat.first_corner.back()));
          const auto first = flat.corners.begin() + flat.first_corner.back();
          if(are_polygons_allowed && flat.corners.end() - first > most_corners)
            m_refusal = Status::too_many_corners;
          are_simplices &= m_refusal != Status::too_many_corners &&
                           is_simplex(first, flat.corners.end());
          simplices.push_back(s);
          flat.first_corner.push_back(static_cast<int>(flat.corners.size()));
        });
      if(!are_simplices)
        return false;
    }
    return true;
  }

  void shrink()
  {
    flat.indices.shrink_to_fit();
    flat.first_corner.shrink_to_fit();
    flat.corners.shrink_to_fit();
    vertices.shrink_to_fit();
    simplices.shrink_to_fit();
    first_simplex.shrink_to_fit();
  }

  static constexpr bool are_polygons_allowed =
    Domain::dimension == 2 && !is_valid<Triangles_only, Domain>;

  int m_number_of_found = 0; // movable vertices that have a number
  Status m_refusal = Status::not_a_simplex;

  // whether there are as many corners as the dimension asks for, all different
  template <typename Iterator>
  static bool is_simplex(Iterator begin, Iterator end)
  {
    const auto n = end - begin;
    if(are_polygons_allowed ? n < 3 : n != Domain::dimension + 1)
      return false;
    if(n <= 4)
    {
      for(Iterator a = begin; a != end; ++a)
        if(std::find(a + 1, end, *a) != end)
          return false;
      return true;
    }
    std::vector<int> sorted(begin, end);
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DOMAIN_REGION_H
