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

#include <cstddef>
#include <utility>
#include <vector>

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
    Point rest;
  };

  const Array<Vertex>& vertices() const { return m_vertices; }

  // the point of the vertex with an index in the rest shape, nullptr if it is not known
  const Point* find(std::size_t index) const
  {
    const int slot = m_slots[index];
    return slot == Paged_index_map::none ? nullptr : &m_vertices[slot].rest;
  }

  void keep(std::size_t index, Vertex v)
  {
    if(const int slot = m_slots[index]; slot != Paged_index_map::none)
    {
      m_vertices[slot] = std::move(v);
      return;
    }
    m_slots.reserve(index); // so that what throws throws before anything is changed
    m_vertices.push_back(std::move(v));
    m_slots.set(index, static_cast<int>(m_vertices.size()) - 1);
  }

  // What restore() makes of these, which needs no more memory.
  struct Change
  {
    Array<Vertex> vertices;
    std::vector<std::size_t> added; // by their indices
  };

  // those of a state, and what was found since
  Change prepare(const Domain& domain, const Array<Vertex>& state)
  {
    Change change{m_vertices, {}};
    for(const Vertex& v : state)
      if(const std::size_t index = domain.index(v.vertex); m_slots[index] != Paged_index_map::none)
        change.vertices[m_slots[index]] = v;
      else
      {
        m_slots.reserve(index);
        change.vertices.push_back(v);
        change.added.push_back(index);
      }
    return change;
  }

  void restore(Change change)
  {
    auto slot = static_cast<int>(m_vertices.size());
    for(std::size_t index : change.added)
      m_slots.set(index, slot++);
    m_vertices.swap(change.vertices);
  }

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
