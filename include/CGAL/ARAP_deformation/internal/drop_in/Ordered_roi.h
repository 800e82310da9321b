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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_ORDERED_ROI_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_ORDERED_ROI_H

#include <CGAL/license/ARAP_deformation.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The region of interest in the order of insertion, and the control vertices, all of which are in
// it.
template <typename Vertex, typename VertexIndexMap>
class Ordered_roi
{
public:
  Ordered_roi(VertexIndexMap index_map, std::size_t number_of_indices)
    : m_index_map(std::move(index_map)), m_position(number_of_indices, none),
      m_is_control(number_of_indices, false)
  {}

  bool contains(Vertex v) const { return m_position[index(v)] != none; }
  bool is_control(Vertex v) const { return m_is_control[index(v)]; }

  const std::vector<Vertex>& vertices() const
  {
    close_gaps();
    return m_vertices;
  }

  // The functions that change the sets return whether they did.

  bool insert(Vertex v)
  {
    if(contains(v))
      return false;
    m_vertices.push_back(v);
    m_position[index(v)] = m_vertices.size() - 1;
    return true;
  }

  bool insert_control(Vertex v)
  {
    if(is_control(v))
      return false;
    insert(v);
    m_is_control[index(v)] = true;
    return true;
  }

  bool erase(Vertex v)
  {
    if(!contains(v))
      return false;
    m_is_control[index(v)] = false;
    m_position[index(v)] = none;
    m_has_gaps = true;
    return true;
  }

  bool erase_control(Vertex v)
  {
    if(!is_control(v))
      return false;
    m_is_control[index(v)] = false;
    return true;
  }

  void clear()
  {
    clear_controls();
    m_vertices.clear();
    m_position.assign(m_position.size(), none);
    m_has_gaps = false;
  }

  void clear_controls() { m_is_control.assign(m_is_control.size(), false); }

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::size_t index(Vertex v) const { return static_cast<std::size_t>(get(m_index_map, v)); }

  // erase() leaves the vertex in the vector: this takes out all such together, to keep the order
  // without moving the others once for each
  void close_gaps() const
  {
    if(!m_has_gaps)
      return;
    std::size_t end = 0;
    for(std::size_t k = 0; k < m_vertices.size(); ++k)
    {
      const Vertex v = m_vertices[k];
      if(m_position[index(v)] != k) // erased, and inserted again further back or not at all
        continue;
      m_position[index(v)] = end;
      m_vertices[end++] = v;
    }
    m_vertices.erase(m_vertices.begin() + end, m_vertices.end());
    m_has_gaps = false;
  }

  VertexIndexMap m_index_map;
  mutable std::vector<Vertex> m_vertices;
  mutable std::vector<std::size_t> m_position; // in m_vertices
  mutable bool m_has_gaps = false;
  std::vector<bool> m_is_control;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_ORDERED_ROI_H
