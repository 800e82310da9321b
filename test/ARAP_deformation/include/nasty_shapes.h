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

#ifndef CGAL_ARAP_DEFORMATION_TEST_NASTY_SHAPES_H
#define CGAL_ARAP_DEFORMATION_TEST_NASTY_SHAPES_H

// A shelf of shapes as they come out of scanners, modelers and bugs, and random ones.

#include "domains.h"
#include "shapes.h"

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

// N = 3 for triangles, 4 for tetrahedra, or for quadrangles
template <std::size_t N>
struct Nasty_shape
{
  std::string name;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::size_t, N>> simplices;
};

using Nasty_surface = Nasty_shape<3>;
using Nasty_volume = Nasty_shape<4>;
using Nasty_polygons = Nasty_shape<4>;

Nasty_surface sheet_of(int nu, int nv);

Nasty_volume block_of(int nx, int ny, int nz);

std::vector<Nasty_surface> nasty_surfaces();

std::vector<Nasty_polygons> nasty_polygons();

std::vector<Nasty_volume> nasty_volumes();

// those that differ from the first one in nothing but points
std::vector<Nasty_volume> nasty_points_of_a_volume();

// those that can be stored in a data structure for halfedges
template <std::size_t N>
std::vector<Nasty_shape<N>> manifold(std::vector<Nasty_shape<N>> shelf)
{
  shelf.erase(std::remove_if(shelf.begin(), shelf.end(), [](const Nasty_shape<N>& shape) {
    return !CGAL::Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(shape.simplices);
  }), shelf.end());
  return shelf;
}

// A good shape with a few random things done to it.
template <std::size_t N>
Nasty_shape<N> random_shape(Nasty_shape<N> shape, std::mt19937& random);

#endif // CGAL_ARAP_DEFORMATION_TEST_NASTY_SHAPES_H
