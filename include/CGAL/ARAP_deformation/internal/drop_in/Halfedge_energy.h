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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_HALFEDGE_ENERGY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_HALFEDGE_ENERGY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/drop_in/Deformed_region.h>
#include <CGAL/ARAP_deformation/internal/drop_in/Halfedge_weights.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/region/Index_lists.h>

#include <CGAL/boost/graph/helpers.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Energies of a region whose edges have the weights of halfedges. Vertex k of the region has the
// number numbers[k] in the energy, and so has the cell around it; the free vertices come first.
template <typename Mesh, typename Region, typename VertexIndexMap, typename Weights>
class Halfedge_energy_builder
{
  using Vertex_ = typename boost::graph_traits<Mesh>::vertex_descriptor;

public:
  Halfedge_energy_builder(const Mesh& mesh, const Region& region,
                          const VertexIndexMap& index_map, const Weights& weights,
                          const std::vector<int>& numbers, int number_of_free_vertices)
    : m_mesh(mesh), m_region(region), m_index_map(index_map), m_weights(weights),
      m_numbers(numbers), m_number_of_free_vertices(number_of_free_vertices),
      m_centres(region.number_of_cells), m_rest(region.size())
  {
    for(int k = 0; k < region.size(); ++k)
      m_rest[numbers[k]] = region.rest_coordinates(k);
    for(int k = 0; k < region.number_of_cells; ++k)
      m_centres[numbers[k]] = region.vertices[k];
  }

  // for each cell its edges, each with the weight of the halfedge to the centre, or the sum of them
  // where there is more than one to the same vertex
  Deformation_energy spokes() const
  {
    Stars stars;
    stars.weights.reserve(6 * m_region.vertices.size()); // what a closed mesh needs
    stars.neighbours.items.reserve(6 * m_region.vertices.size());
    std::vector<std::pair<int, double>> star;
    for(int cell = 0; cell < m_region.number_of_cells; ++cell)
    {
      star.clear();
      for_each_halfedge_to(m_centres[cell], m_mesh, [&](auto h) {
        star.emplace_back(number(source(h, m_mesh)), m_weights[h]);
      });
      star.resize(sort_and_add_up(star.begin(), star.end()));
      for(const auto& [neighbour, weight] : star)
      {
        stars.neighbours.items.push_back(neighbour);
        stars.weights.push_back(weight);
      }
      stars.neighbours.begin.push_back(static_cast<int>(stars.neighbours.items.size()));
    }
    return Deformation_energy(Star_energy(std::move(stars), m_number_of_free_vertices), m_rest,
                              m_number_of_free_vertices);
  }

  // for each cell the edges of all faces at its centre, each with the weight of the halfedge in the
  // face
  Deformation_energy spokes_and_rims() const
  {
    Simplices faces;
    Cells cells;
    std::vector<int> number_of_face(m_weights.size(), -1); // for each halfedge: that of its face
    for(int cell = 0; cell < m_region.number_of_cells; ++cell)
    {
      for_each_halfedge_to(m_centres[cell], m_mesh, [&](auto h) {
        if(is_border(h, m_mesh))
          return;
        if(number_of_face[m_weights.index(h)] < 0)
        {
          for(const auto g : halfedges_around_face(h, m_mesh))
            number_of_face[m_weights.index(g)] = faces.size();
          append_face(h, faces);
        }
        cells.sets.items.push_back(number_of_face[m_weights.index(h)]);
      });
      cells.sets.begin.push_back(static_cast<int>(cells.sets.items.size()));
    }
    cells.stiffness.assign(m_region.number_of_cells, 1);
    return Deformation_energy(
      Simplex_energy(std::move(faces), std::move(cells), m_number_of_free_vertices), m_rest,
      m_number_of_free_vertices);
  }

  // the number of a centre of a cell that is at a face that is not a triangle, or -1
  int find_non_triangle() const
  {
    int found = -1;
    for(int cell = 0; cell < m_region.number_of_cells && found < 0; ++cell)
      for_each_halfedge_to(m_centres[cell], m_mesh, [&](auto h) {
        if(!is_border(h, m_mesh) && !is_triangle(h, m_mesh))
          found = cell;
      });
    return found;
  }

private:
  // the triangle of h
  template <typename Halfedge>
  void append_face(Halfedge h, Simplices& faces) const
  {
    const Halfedge g = next(h, m_mesh), f = next(g, m_mesh);
    faces.first_weight.push_back(static_cast<int>(faces.weights.size()));
    for(const Halfedge corner : {h, g, f})
      faces.corners.items.push_back(number(target(corner, m_mesh)));
    faces.corners.begin.push_back(static_cast<int>(faces.corners.items.size()));
    for(const Halfedge edge : {g, h, f}) // of the corners (0, 1), (0, 2) and (1, 2)
      faces.weights.push_back(m_weights[edge]);
  }

  template <typename Vertex>
  int number(Vertex v) const { return m_numbers[m_region.places[get(m_index_map, v)]]; }

  const Mesh& m_mesh;
  const Region& m_region;
  const VertexIndexMap& m_index_map;
  const Weights& m_weights;
  const std::vector<int>& m_numbers;
  int m_number_of_free_vertices;
  std::vector<Vertex_> m_centres;   // by their numbers
  std::vector<Coordinates> m_rest; // by the vertices' numbers
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_HALFEDGE_ENERGY_H
