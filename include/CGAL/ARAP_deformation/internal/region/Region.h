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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_REGION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_REGION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The weights of a polygon are stored for all pairs of its corners.
constexpr int most_corners = 2048;

// What the numeric core knows of a mesh: the vertices that may move, with some rings of simplices
// around them, two unless cells are larger than a star. Those vertices come first, then their
// neighbors, then the neighbors of those, and so on. All but the last ring are centers: the
// vertices whose simplices are all here. Which of the vertices that may move are fixed is not said
// here, and may change.
struct Region
{
  int dimension = 2; // of the simplices: 2 for triangles and polygons, 3 for tetrahedra
  bool is_planar = false; // nothing leaves the plane z = 0
  int number_of_movable_vertices = 0;
  int number_of_centers = 0;
  int number_of_vertex_cells = 0; // the vertices whose cells have movable vertices come first
  int number_of_movable_simplices = 0; // those that have a movable vertex, which come first
  Array<Coordinates> rest;    // for each vertex its position in the rest shape
  Array<std::size_t> indices; // for each vertex its index in the mesh

  // the corners of simplex s are corners[first_corner[s]] to corners[first_corner[s + 1] - 1],
  // those of a polygon in their order around it
  Array<int> first_corner = {0};
  Array<int> corners;

  int number_of_vertices() const { return static_cast<int>(rest.size()); }
  int number_of_simplices() const { return static_cast<int>(first_corner.size()) - 1; }
  Index_range corners_of(int s) const
  {
    return {corners.data() + first_corner[s], corners.data() + first_corner[s + 1]};
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_REGION_H
