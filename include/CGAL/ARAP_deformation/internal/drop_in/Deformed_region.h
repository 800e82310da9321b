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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_DEFORMED_REGION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_DEFORMED_REGION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/Point_conversion.h>
#include <CGAL/ARAP_deformation/internal/drop_in/Halfedge_weights.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The vertices that a deformation looks at: the region of interest in its order, then all
// neighbours of it, then all neighbours of these. Those of the first two kinds are the centres of
// cells. Points are kept as the mesh has them, so that targets are not rounded.
template <typename Vertex, typename Point>
struct Deformed_region
{
  static constexpr int none = -1;

  std::vector<Vertex> vertices;
  int roi_size = 0;
  int number_of_cells = 0;
  std::vector<int> places; // for each index of a vertex of the mesh: its place in `vertices`
  std::vector<Point> rest;
  std::vector<Point> points; // the targets of the control vertices
  std::vector<Matrix_3x3> rotations; // of the cells

  int size() const { return static_cast<int>(vertices.size()); }

  Coordinates rest_coordinates(int k) const
  {
    return Point_conversion<Point>::coordinates(rest[k]);
  }

  void reset_rotations() { std::fill(rotations.begin(), rotations.end(), identity_matrix()); }
};

// The region for a new region of interest. What the old one knows is taken over, so that a vertex
// that stays in the region of interest keeps its rest position, its target and its rotation. One
// that has left it is looked at in its rest position, where it is to be put back.
template <typename Vertex, typename Point, typename Mesh, typename VertexIndexMap,
          typename VertexPointMap>
Deformed_region<Vertex, Point> next_region(const Deformed_region<Vertex, Point>& old,
                                           const std::vector<Vertex>& roi, const Mesh& mesh,
                                           const VertexIndexMap& index_map,
                                           const VertexPointMap& point_map)
{
  constexpr int none = Deformed_region<Vertex, Point>::none;
  Deformed_region<Vertex, Point> region;
  region.places.assign(old.places.size(), none);
  const auto append = [&](Vertex v) {
    int& place = region.places[get(index_map, v)];
    if(place == none)
    {
      place = region.size();
      region.vertices.push_back(v);
    }
  };
  const auto append_neighbours = [&](int begin, int end) {
    for(int k = begin; k < end; ++k)
      for_each_halfedge_to(region.vertices[k], mesh,
                           [&](auto h) { append(source(h, mesh)); });
  };
  for(const Vertex v : roi)
    append(v);
  region.roi_size = region.size();
  append_neighbours(0, region.roi_size);
  region.number_of_cells = region.size();
  append_neighbours(region.roi_size, region.number_of_cells);

  region.rest.reserve(region.vertices.size());
  region.points.reserve(region.vertices.size());
  region.rotations.assign(region.number_of_cells, identity_matrix());
  for(int k = 0; k < region.size(); ++k)
  {
    const Vertex v = region.vertices[k];
    const int old_place = old.places[get(index_map, v)];
    const bool is_known = old_place != none;
    if(is_known && (k < region.roi_size || old_place < old.roi_size))
    {
      region.rest.push_back(old.rest[old_place]);
      region.points.push_back(k < region.roi_size ? old.points[old_place] : old.rest[old_place]);
    }
    else
    {
      region.rest.push_back(get(point_map, v));
      region.points.push_back(region.rest.back());
    }
    if(k < region.number_of_cells && is_known && old_place < old.number_of_cells)
      region.rotations[k] = old.rotations[old_place];
  }
  return region;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_DEFORMED_REGION_H
