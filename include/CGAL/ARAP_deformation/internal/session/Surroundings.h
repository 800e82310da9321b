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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SURROUNDINGS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SURROUNDINGS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/region/Paged_index_map.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The rest shape of vertices around the region of interest, whoever moves them.
template <typename Domain>
class Surroundings
{
public:
  using Point = typename Domain::Point;

  struct Vertex
  {
    typename Domain::vertex_descriptor vertex;
    Point rest, first; // in the rest shape now, and in that when it was found
  };

  const Array<Vertex>& vertices() const { return m_vertices; }

  // the point of the vertex with an index in the rest shape, nullptr if it is not known
  const Point* find(std::size_t index) const
  {
    const int slot = m_slots[index];
    return slot == Paged_index_map::none ? nullptr : &m_vertices[slot].rest;
  }

  void keep(std::size_t index, const typename Domain::vertex_descriptor& v, const Point& rest)
  {
    if(const int slot = m_slots[index]; slot != Paged_index_map::none)
    {
      Vertex& kept = m_vertices[slot];
      if(!is_finite(Domain::coordinates(kept.first))) // it has been mended
        kept.first = rest;
      kept.rest = rest;
      return;
    }
    m_slots.reserve(index); // so that what throws throws before anything is changed
    m_vertices.push_back({v, rest, rest});
    m_slots.set(index, static_cast<int>(m_vertices.size()) - 1);
  }

  // What restore() makes of these. Vertices are only ever appended: those of an earlier state come
  // first here, too. What was found since stays, with the points that it had when it was found.
  Array<Vertex> prepare(const Array<Vertex>& state) const
  {
    Array<Vertex> vertices = m_vertices;
    for(std::size_t k = 0; k < vertices.size(); ++k)
      vertices[k].rest = k < state.size() ? state[k].rest : vertices[k].first;
    return vertices;
  }

  void restore(Array<Vertex>& prepared) { m_vertices.swap(prepared); }

  // takes the points that the mesh has now for all of them, or for none if one throws
  void read_again(const Domain& domain)
  {
    Array<Vertex> vertices = m_vertices;
    for(Vertex& v : vertices)
      v.rest = domain.point(v.vertex);
    m_vertices.swap(vertices);
  }

private:
  Paged_index_map m_slots; // from Domain::index() to the place in m_vertices
  Array<Vertex> m_vertices;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SURROUNDINGS_H
