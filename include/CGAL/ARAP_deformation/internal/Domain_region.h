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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_REGION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_REGION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Paged_index_map.h>
#include <CGAL/ARAP_deformation/internal/Region.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// A region with the names of its vertices and simplices in a mesh. It is collected by walking over
// the region only.
template <typename Domain>
struct Domain_region
{
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using simplex_descriptor = typename Domain::simplex_descriptor;
  static constexpr std::size_t N = Domain::vertices_per_simplex;

  Region<N> flat;
  std::vector<vertex_descriptor> vertices;
  std::vector<simplex_descriptor> simplices;
  // the simplices whose smallest vertex is v are first_simplex[v] to first_simplex[v + 1] - 1
  std::vector<int> first_simplex;
  Paged_index_map numbers; // from Domain::index() to the number in the region

  // Collects the region of the given free vertices. Returns false if there is a face that is not a
  // simplex: refused_vertex() is at it.
  bool collect(const Domain& domain, const std::vector<vertex_descriptor>& free_vertices)
  {
    for(vertex_descriptor v : free_vertices)
      number(domain, v);
    flat.number_of_free_vertices = flat.number_of_centres = static_cast<int>(vertices.size());
    if(!collect_simplices(domain, 0, flat.number_of_centres))
      return false;
    flat.number_of_free_simplices = static_cast<int>(simplices.size());
    flat.number_of_centres = static_cast<int>(vertices.size());
    if(!collect_simplices(domain, flat.number_of_free_vertices, flat.number_of_centres))
      return false;
    first_simplex.push_back(static_cast<int>(simplices.size()));
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

private:
  int number(const Domain& domain, vertex_descriptor v)
  {
    const std::size_t index = domain.index(v);
    int n = numbers[index];
    if(n == Paged_index_map::none)
    {
      n = static_cast<int>(vertices.size());
      numbers.set(index, n);
      vertices.push_back(v);
    }
    return n;
  }

  // Vertices are visited in the order of their numbers, and what is not yet numbered gets a larger
  // number: a simplex is met first at its smallest vertex.
  bool collect_simplices(const Domain& domain, int begin, int end)
  {
    for(int v = begin; v < end; ++v)
    {
      first_simplex.push_back(static_cast<int>(simplices.size()));
      const bool are_simplices = domain.for_each_incident_simplex(
        vertices[v], [&](simplex_descriptor s, const std::array<vertex_descriptor, N>& corners) {
          std::array<int, N> simplex;
          bool is_first_visit = true;
          for(std::size_t k = 0; k < N; ++k)
          {
            simplex[k] = number(domain, corners[k]);
            is_first_visit &= simplex[k] >= v;
          }
          if(!is_first_visit)
            return;
          simplices.push_back(s);
          flat.simplices.push_back(simplex);
        });
      if(!are_simplices)
        return false;
    }
    return true;
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_REGION_H
