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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_EMBEDDED_SHAPE_H
#define CGAL_ARAP_DEFORMATION_DEMO_EMBEDDED_SHAPE_H

// A surface in pieces that intersect each other, which cannot be deformed itself, and a coarse
// volume around it, which can (Section 5 of Sorkine and Alexa 2007).

#include "Scene.h"
#include "demo_shapes.h"
#include "mesh_panel.h"
#include "shape_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace CGAL::ARAP::demo {

// triangles without any connectivity
struct Soup
{
  std::vector<Point> points;
  std::vector<std::array<int, 3>> triangles;
};

// A sheet of nu x nv squares at the points f(u, v), with u and v from 0 to 1.
template <typename Place>
void add_sheet(Soup& soup, int nu, int nv, Place f)
{
  for(int i = 0; i <= nu; ++i)
    for(int j = 0; j <= nv; ++j) {
      const int d = int(soup.points.size()), c = d - 1, b = d - nv - 1, a = b - 1;
      soup.points.push_back(f(double(i) / nu, double(j) / nv));
      if(i > 0 && j > 0)
        soup.triangles.insert(soup.triangles.end(), {{a, b, c}, {c, b, d}});
    }
}

// A palm: its trunk consists of open cones, some of which overlap the next one while others do not
// reach it, and its leaves intersect.
inline Soup make_palm()
{
  Soup palm;
  const int cones = 11, leaves = 7;
  for(int k = 0; k < cones; ++k) {
    const double length = k % 2 == 0 ? 0.75 : 1.2;
    add_sheet(palm, 24, 4, [=](double u, double v) {
      const double radius = 0.21 - 0.006 * k + 0.09 * v;
      return Point(radius * std::cos(2 * CGAL_PI * u), radius * std::sin(2 * CGAL_PI * u),
                   0.33 * (k + length * v));
    });
  }
  for(int k = 0; k < leaves; ++k) {
    const double angle = 2 * CGAL_PI * (k + 0.3) / leaves;
    const double c = std::cos(angle), s = std::sin(angle);
    add_sheet(palm, 20, 6, [=](double u, double v) {
      const double r = 1.9 * u - 0.2, side = 2 * v - 1;
      const double t = 0.34 * side * std::sqrt(u * (1 - u) + 0.004);
      return Point(c * r - s * t, s * r + c * t, 3.75 + 0.75 * u - 1.5 * u * u - 0.5 * std::abs(t));
    });
  }
  return palm;
}

// The tetrahedra of a body-centered cubic lattice whose centroids are close to a point of the
// surface. The cubes of the lattice have edge length 2 * size.
inline Tetrahedral_mesh make_lattice_around(const Soup& surface, double size, double distance)
{
  using Node = std::array<int, 3>;
  Tetrahedral_mesh volume;
  std::map<Node, int> vertices;
  const auto place = [=](const Node& n) { return Point(size * n[0], size * n[1], size * n[2]); };
  const auto vertex = [&](const Node& n) {
    const auto [position, is_new] = vertices.try_emplace(n, int(vertices.size()));
    if(is_new)
      volume.points.push_back(place(n));
    return position->second;
  };
  const auto add_if_close = [&](const std::array<Node, 4>& corners) {
    Vector center(0, 0, 0);
    for(const Node& n : corners)
      center += (place(n) - CGAL::ORIGIN) / 4;
    const auto is_close = [&](const Point& p) {
      return CGAL::squared_distance(p, CGAL::ORIGIN + center) < distance * distance;
    };
    if(std::any_of(surface.points.begin(), surface.points.end(), is_close))
      volume.tetrahedra.push_back({vertex(corners[0]), vertex(corners[1]), vertex(corners[2]),
                                   vertex(corners[3])});
  };

  CGAL::Bbox_3 box;
  for(const Point& p : surface.points)
    box += p.bbox();
  Node first, last; // even, like all corners of cubes
  for(int k = 0; k < 3; ++k) {
    first[k] = 2 * int(std::floor((box.min(k) - distance) / size / 2) - 1);
    last[k] = 2 * int(std::ceil((box.max(k) + distance) / size / 2) + 1);
  }
  for(int x = first[0]; x <= last[0]; x += 2)
    for(int y = first[1]; y <= last[1]; y += 2)
      for(int z = first[2]; z <= last[2]; z += 2)
        for(int i = 0; i < 3; ++i) {
          // an edge of a cube, and the centers of the four cubes around it
          Node a{x, y, z}, b = a, m = a;
          b[i] += 2, m[i] += 1;
          std::array<Node, 5> around;
          for(int k = 0; k < 5; ++k) {
            around[k] = m;
            around[k][(i + 1) % 3] += k == 1 || k == 2 ? 1 : -1;
            around[k][(i + 2) % 3] += k == 2 || k == 3 ? 1 : -1;
            if(k > 0)
              add_if_close({a, b, around[k - 1], around[k]});
          }
        }
  return volume;
}

// The panel that shows a surface and the boundary edges of the volume around it. The selection is
// that of the vertices of the volume.
inline Panel panel(const Soup& surface, const Tetrahedral_mesh& volume,
                   const std::vector<int>& selection, const std::string& caption)
{
  Panel result;
  for(const auto* points : {&surface.points, &volume.points})
    for(const Point& p : *points)
      result.points.push_back({p.x(), p.y(), p.z()});
  result.triangles = surface.triangles;
  const int n = int(surface.points.size());
  const Skin boundary = skin(volume);
  for(const auto& [a, b] : internal::edges(boundary.triangles))
    result.lines.push_back({n + int(boundary.vertices[a]), n + int(boundary.vertices[b])});
  result.selection.assign(surface.points.size(), FREE);
  result.selection.insert(result.selection.end(), selection.begin(), selection.end());
  result.caption = caption;
  return result;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_EMBEDDED_SHAPE_H
