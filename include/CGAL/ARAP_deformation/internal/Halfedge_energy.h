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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_HALFEDGE_ENERGY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_HALFEDGE_ENERGY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Deformed_region.h>
#include <CGAL/ARAP_deformation/internal/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/Halfedge_weights.h>
#include <CGAL/ARAP_deformation/internal/Rigidity_energy.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>

#include <CGAL/boost/graph/helpers.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Energies of a region whose edges have the weights of halfedges. Vertex k of the region has the
// number numbers[k] in the energy.
template <typename Mesh, typename Region, typename VertexIndexMap, typename Weights>
class Halfedge_energy_builder
{
public:
  Halfedge_energy_builder(const Mesh& mesh, const Region& region,
                          const VertexIndexMap& index_map, const Weights& weights,
                          const std::vector<int>& numbers)
    : m_mesh(mesh), m_region(region), m_index_map(index_map), m_weights(weights),
      m_numbers(numbers)
  {}

  // for each cell its edges, each with the weight of the halfedge to the centre
  Rigidity_energy spokes() const
  {
    Edge_sets sets = empty_sets();
    for(int cell = 0; cell < m_region.number_of_cells; ++cell)
    {
      for_each_halfedge_to(m_region.vertices[cell], m_mesh,
                           [&](auto h) { append_edge(h, sets); });
      close_set(sets);
    }
    return Rigidity_energy(std::move(sets), separate_cells(m_region.number_of_cells));
  }

  // for each cell the edges of all faces at its centre, each with the weight of the halfedge in the
  // face
  Rigidity_energy spokes_and_rims() const
  {
    Edge_sets sets = empty_sets();
    Cells cells;
    std::vector<int> set_of_face(m_weights.size(), -1); // for each halfedge: that of its face
    for(int cell = 0; cell < m_region.number_of_cells; ++cell)
    {
      for_each_halfedge_to(m_region.vertices[cell], m_mesh, [&](auto h) {
        if(is_border(h, m_mesh))
          return;
        if(set_of_face[m_weights.index(h)] < 0)
        {
          for(const auto g : halfedges_around_face(h, m_mesh))
          {
            set_of_face[m_weights.index(g)] = sets.size();
            append_edge(g, sets);
          }
          close_set(sets);
        }
        cells.sets.push_back(set_of_face[m_weights.index(h)]);
      });
      cells.begin.push_back(static_cast<int>(cells.sets.size()));
    }
    cells.stiffness.assign(m_region.number_of_cells, 1);
    return Rigidity_energy(std::move(sets), std::move(cells));
  }

  // the centre of a cell that is at a face that is not a triangle, or -1
  int find_non_triangle() const
  {
    int found = -1;
    for(int cell = 0; cell < m_region.number_of_cells && found < 0; ++cell)
      for_each_halfedge_to(m_region.vertices[cell], m_mesh, [&](auto h) {
        if(!is_border(h, m_mesh) && !is_triangle(h, m_mesh))
          found = cell;
      });
    return found;
  }

private:
  // with room for what a closed mesh needs: there are three edges and two faces for each vertex
  Edge_sets empty_sets() const
  {
    Edge_sets sets;
    sets.edges.reserve(6 * m_region.vertices.size());
    return sets;
  }

  template <typename Halfedge>
  void append_edge(Halfedge h, Edge_sets& sets) const
  {
    const int i = place(target(h, m_mesh)), j = place(source(h, m_mesh));
    sets.edges.push_back({m_numbers[i], m_numbers[j], m_weights[h],
                          difference(m_region.rest_coordinates(i),
                                     m_region.rest_coordinates(j))});
  }

  static void close_set(Edge_sets& sets)
  {
    sets.begin.push_back(static_cast<int>(sets.edges.size()));
  }

  template <typename Vertex>
  int place(Vertex v) const { return m_region.places[get(m_index_map, v)]; }

  const Mesh& m_mesh;
  const Region& m_region;
  const VertexIndexMap& m_index_map;
  const Weights& m_weights;
  const std::vector<int>& m_numbers;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_HALFEDGE_ENERGY_H
