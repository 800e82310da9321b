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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_SHAPES_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_SHAPES_H

// Shapes as ranges of points and simplices: computed ones, and surfaces.

#include "scenario.h"

#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace benchmark {

namespace ARAP = CGAL::ARAP;

template <std::size_t N> // corners of a simplex
struct Shape
{
  using Simplices = std::vector<std::array<int, N>>;
  using Domain = ARAP::Simplex_soup_domain<static_cast<int>(N) - 1, std::vector<Point>, Simplices>;

  std::string name;
  std::vector<Point> points;
  Simplices simplices;
};

// a sheet of nu x nv quads, each cut in two, at the points f(u, v); closed in u if `is_closed`
template <typename Function>
Shape<3> sheet(const std::string& name, int nu, int nv, bool is_closed, const Function& f)
{
  Shape<3> shape{name, {}, {}};
  const int columns = is_closed ? nu : nu + 1;
  for(int i = 0; i < columns; ++i)
    for(int j = 0; j <= nv; ++j)
      shape.points.push_back(to_point(f(double(i) / nu, double(j) / nv)));
  const auto vertex = [&](int i, int j) { return (i % columns) * (nv + 1) + j; };
  for(int i = 0; i < nu; ++i)
    for(int j = 0; j < nv; ++j)
    {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                d = vertex(i, j + 1);
      const int e = (i + j) % 2 == 0 ? c : d; // the end of the diagonal from a, or from b
      shape.simplices.push_back({a, b, e});
      shape.simplices.push_back({e == c ? a : b, c, d});
    }
  return shape;
}

// The cubes of a grid that is_inside(x, y, z) tells by their lowest corners, each cut in the six
// tetrahedra of the ways from a corner to the opposite one.
template <typename Function>
Shape<4> block(const std::string& name, int nx, int ny, int nz, const Function& is_inside)
{
  Shape<4> shape{name, {}, {}};
  std::vector<int> vertices(static_cast<std::size_t>((nx + 1) * (ny + 1) * (nz + 1)), -1);
  const auto vertex = [&](const std::array<int, 3>& p) {
    int& v = vertices[static_cast<std::size_t>((p[0] * (ny + 1) + p[1]) * (nz + 1) + p[2])];
    if(v < 0)
    {
      v = static_cast<int>(shape.points.size());
      shape.points.emplace_back(p[0], p[1], p[2]);
    }
    return v;
  };
  for(int x = 0; x < nx; ++x)
    for(int y = 0; y < ny; ++y)
      for(int z = 0; z < nz; ++z)
      {
        std::array<std::size_t, 3> way = {0, 1, 2};
        if(is_inside(x, y, z))
          do
          {
            std::array<int, 3> p = {x, y, z};
            std::array<int, 4> corners = {vertex(p)};
            for(std::size_t k = 0; k < 3; ++k)
            {
              ++p[way[k]];
              corners[k + 1] = vertex(p);
            }
            shape.simplices.push_back(corners);
          } while(std::next_permutation(way.begin(), way.end()));
      }
  return shape;
}

inline Shape<4> block(const std::string& name, int nx, int ny, int nz)
{
  return block(name, nx, ny, nz, [](int, int, int) { return true; });
}

inline Shape<3> surface(const std::string& name, const Mesh& mesh)
{
  Shape<3> shape{name, points_of(mesh), {}};
  for(auto f : faces(mesh))
  {
    std::array<int, 3> corners;
    auto corner = corners.begin();
    for(auto v : vertices_around_face(mesh.halfedge(f), mesh))
      *corner++ = static_cast<int>(v.idx());
    shape.simplices.push_back(corners);
  }
  return shape;
}

// the bounding box of its points
template <std::size_t N>
Eigen::AlignedBox3d bounding_box(const Shape<N>& shape)
{
  Eigen::AlignedBox3d box;
  for(const Point& p : shape.points)
    box.extend(to_vector(p));
  return box;
}

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_SHAPES_H
