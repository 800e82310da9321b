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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_SHAPES_H
#define CGAL_ARAP_DEFORMATION_DEMO_SHAPES_H

// Shapes to deform as in the figures of Sorkine and Alexa 2007: some are generated, others are
// meshes from CGAL's data folder. Each comes with its fixed vertices and the motion of its handle.

#include "Medit_file.h"
#include "Scene.h"
#include "read_mesh.h"
#include "shape_files.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace CGAL::ARAP::demo {

using Point = Kernel::Point_3;

template <typename Shape>
struct Demo_model
{
  std::string name;
  Shape mesh;
  std::vector<int> selection;
  Transform transform; // of the handle
  View view;           // shows the shape well, before and after
};

using Demo_shape = Demo_model<Mesh>;
using Demo_volume = Demo_model<Tetrahedral_mesh>;

// A rotation, in degrees, about an axis (0 for x, 1 for y, 2 for z) through `center`, followed by a
// translation.
inline Transform motion(int axis, double degrees, const Point& center, const Vector& translation)
{
  Transform m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const double angle = degrees * CGAL_PI / 180;
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  m[4 * i + i] = m[4 * j + j] = std::cos(angle);
  m[4 * j + i] = std::sin(angle);
  m[4 * i + j] = -m[4 * j + i];
  for(int k = 0; k < 3; ++k)
    m[4 * k + 3] = center[k] + translation[k] - Vector(m[4 * k], m[4 * k + 1], m[4 * k + 2]) *
                                                  (center - CGAL::ORIGIN);
  return m;
}

inline Transform translation(const Vector& t) { return motion(0, 0, CGAL::ORIGIN, t); }

// A selection by predicates on the coordinates relative to the bounding box, each from 0 to 1.
template <typename Shape, typename Is_fixed, typename Is_handle>
std::vector<int> select(const Shape& shape, Is_fixed is_fixed, Is_handle is_handle)
{
  const std::vector<Point>& points = points_of(shape);
  const CGAL::Bbox_3 box = CGAL::bbox_3(points.begin(), points.end());
  std::vector<int> selection;
  for(const Point& p : points) {
    std::array<double, 3> q;
    for(int i = 0; i < 3; ++i) // a flat mesh has no height to divide by
      q[i] = (p[i] - box.min(i)) / (std::max)(box.max(i) - box.min(i), 1e-100);
    const Point relative(q[0], q[1], q[2]);
    selection.push_back(is_fixed(relative) ? FIXED : is_handle(relative) ? HANDLE : FREE);
  }
  return selection;
}

// A triangle mesh of squares on an integer lattice. Their diagonals alternate, so that the mesh has
// no preferred direction. The function `place` maps the nodes of the lattice to points.
template <typename Place>
class Lattice_mesh
{
public:
  using Node = std::array<int, 3>;

  explicit Lattice_mesh(Place place) : m_place(place) {}

  // The square at `a` that extends along the axes i and j, with the normal i x j.
  void add_square(const Node& a, int i, int j)
  {
    Node b = a, c = a, d = a;
    ++b[i], ++c[i], ++c[j], ++d[j];
    const auto p = vertex(a), q = vertex(b), r = vertex(c), s = vertex(d);
    const bool is_even = (a[0] + a[1] + a[2]) % 2 == 0;
    m_mesh.add_face(p, q, is_even ? r : s);
    m_mesh.add_face(is_even ? p : q, r, s);
  }

  // The boundary of the cells that are inside, among the first n[0] x n[1] x n[2].
  template <typename Is_inside>
  void add_boundary(const Node& n, Is_inside is_inside)
  {
    for(int x = 0; x < n[0]; ++x)
      for(int y = 0; y < n[1]; ++y)
        for(int z = 0; z < n[2]; ++z)
          for(int i = 0; i < 3 && is_inside(Node{x, y, z}); ++i) {
            Node before{x, y, z}, after = before;
            --before[i], ++after[i];
            if(!is_inside(before))
              add_square({x, y, z}, (i + 2) % 3, (i + 1) % 3);
            if(!is_inside(after))
              add_square(after, (i + 1) % 3, (i + 2) % 3);
          }
  }

  const Mesh& mesh() const { return m_mesh; }

private:
  Mesh::Vertex_index vertex(const Node& node)
  {
    const auto [position, is_new] = m_vertices.try_emplace(node);
    if(is_new)
      position->second = m_mesh.add_vertex(m_place(node));
    return position->second;
  }

  Place m_place;
  std::map<Node, Mesh::Vertex_index> m_vertices;
  Mesh m_mesh;
};

// A sheet of nx x ny squares.
template <typename Place>
Mesh make_sheet(int nx, int ny, Place place)
{
  Lattice_mesh<Place> lattice(place);
  for(int x = 0; x < nx; ++x)
    for(int y = 0; y < ny; ++y)
      lattice.add_square({x, y, 0}, 0, 1);
  return lattice.mesh();
}

// The bar of the survey of Botsch and Sorkine 2008: its top is twisted.
inline Demo_shape make_bar(double size = 0.8)
{
  const int width = int(std::lround(12 / size)), height = int(std::lround(75 / size));
  const std::array<int, 3> cells{width, width, height};
  Lattice_mesh lattice([&](const std::array<int, 3>& n) {
    return Point(size * n[0] - 6, size * n[1] - 6, size * n[2]);
  });
  lattice.add_boundary(cells, [&](const std::array<int, 3>& n) {
    return (std::min)({n[0], n[1], n[2]}) >= 0 && n[0] < cells[0] && n[1] < cells[1] &&
           n[2] < cells[2];
  });
  const Mesh& mesh = lattice.mesh();
  const auto is_low = [](const Point& p) { return p.z() < 0.06; };
  const auto is_high = [](const Point& p) { return p.z() > 0.945; };
  return {"bar", mesh, select(mesh, is_low, is_high),
          motion(2, 135, CGAL::ORIGIN, CGAL::NULL_VECTOR),
          View{Vector(1, -0.6, 0.35), Vector(0, 0, 1), 320, 640}};
}

// The same bar, filled with tetrahedra: six per cube, one for each path along its edges from its
// first corner to its last.
inline Demo_volume make_filled_bar(double size = 1.5)
{
  const int width = int(std::lround(12 / size)), height = int(std::lround(75 / size));
  Tetrahedral_mesh mesh;
  for(int x = 0; x <= width; ++x)
    for(int y = 0; y <= width; ++y)
      for(int z = 0; z <= height; ++z)
        mesh.points.emplace_back(size * x - 6, size * y - 6, size * z);
  const auto vertex = [&](const std::array<int, 3>& n) {
    return (n[0] * (width + 1) + n[1]) * (height + 1) + n[2];
  };
  for(int x = 0; x < width; ++x)
    for(int y = 0; y < width; ++y)
      for(int z = 0; z < height; ++z) {
        std::array<int, 3> way{0, 1, 2};
        do {
          std::array<int, 3> node{x, y, z};
          std::array<int, 4> tetrahedron{vertex(node)};
          for(int k = 0; k < 3; ++k) {
            ++node[way[k]];
            tetrahedron[k + 1] = vertex(node);
          }
          mesh.tetrahedra.push_back(tetrahedron);
        } while(std::next_permutation(way.begin(), way.end()));
      }
  const Demo_shape bar = make_bar();
  const auto is_low = [](const Point& p) { return p.z() < 0.06; };
  const auto is_high = [](const Point& p) { return p.z() > 0.945; };
  return {"filled_bar", mesh, select(mesh, is_low, is_high), bar.transform, bar.view};
}

// The approximate signed distance to the surface of a cactus: round limbs in the yz plane with
// lengthwise ribs.
inline double cactus_distance(const Point& p)
{
  struct Limb { Point from, to; double radius; int ribs; };
  static const std::array<Limb, 5> limbs{{{{0, 0, 0}, {0, 0, 0.8}, 0.07, 8},
                                          {{0, 0, 0.36}, {0, -0.17, 0.44}, 0.04, 5},
                                          {{0, -0.17, 0.44}, {0, -0.19, 0.72}, 0.042, 5},
                                          {{0, 0, 0.2}, {0, 0.16, 0.25}, 0.038, 5},
                                          {{0, 0.16, 0.25}, {0, 0.175, 0.4}, 0.04, 5}}};
  const double blend = 0.012;
  double sum = 0;
  for(const auto& [from, to, radius, ribs] : limbs) {
    const Vector axis = to - from;
    const double t = ((p - from) * axis) / axis.squared_length();
    const Vector d = p - (from + (std::min)((std::max)(t, 0.), 1.) * axis);
    const double x = d.x();
    const double y = d * internal::unit(CGAL::cross_product(axis, Vector(1, 0, 0)));
    // the ribs fade out at the round ends, where their angle is not defined
    const double fade = (x * x + y * y) / (std::max)(d.squared_length(), 1e-12);
    const double rib = 0.08 * fade * std::cos(ribs * std::atan2(y, x));
    sum += std::exp((radius * (1 + rib) - std::sqrt(d.squared_length())) / blend);
  }
  // a smooth minimum of the distances to the limbs, above the ground
  return (std::max)(-blend * std::log(sum), 0.02 - p.z());
}

// Moves the vertices onto the surface of the cactus by a few Newton steps.
inline void project_onto_cactus(Mesh& mesh)
{
  const double h = 1e-5;
  const Vector dx(h, 0, 0), dy(0, h, 0), dz(0, 0, h);
  for(auto v : mesh.vertices())
    for(int step = 0; step < 5; ++step) {
      Point& p = mesh.point(v);
      const auto slope = [&](const Vector& e) {
        return (cactus_distance(p + e) - cactus_distance(p - e)) / (2 * h);
      };
      const Vector gradient(slope(dx), slope(dy), slope(dz));
      p = p - cactus_distance(p) / gradient.squared_length() * gradient;
    }
}

// A cactus as in the survey: its tip is bent to the side.
inline Demo_shape make_cactus()
{
  const double size = 0.02;
  const auto place = [&](const std::array<int, 3>& n) {
    return Point(size * (n[0] - 5), size * (n[1] - 13), size * n[2]);
  };
  Lattice_mesh lattice(place);
  lattice.add_boundary({10, 26, 46}, [&](const std::array<int, 3>& n) {
    return cactus_distance(place(n) + Vector(size, size, size) / 2) < 0;
  });
  Mesh mesh = lattice.mesh();
  for(int round = 0; round < 3; ++round) {
    project_onto_cactus(mesh);
    CGAL::Polygon_mesh_processing::isotropic_remeshing(mesh.faces(), 0.0115, mesh);
  }
  project_onto_cactus(mesh);
  mesh.collect_garbage();
  CGAL_postcondition(CGAL::is_closed(mesh)); // no cells touch only in an edge or a corner
  const auto is_low = [](const Point& p) { return p.z() < 0.1; };
  const auto is_tip = [](const Point& p) { return p.z() > 0.88 && std::abs(p.y() - 0.5) < 0.25; };
  return {"cactus", mesh, select(mesh, is_low, is_tip),
          motion(0, -70, Point(0, 0, 0.77), Vector(0, 0.35, -0.16)),
          View{Vector(1, 0.2, 0.25), Vector(0, 0, 1), 560, 640}};
}

// A sheet whose left half has four times as many columns as the right one, and is lifted in the
// middle: without cotangents the result shows the bias of the mesh.
inline Demo_shape make_biased_plane()
{
  const int fine = 48, coarse = 12;
  const Mesh mesh = make_sheet(fine + coarse, 2 * coarse, [&](const std::array<int, 3>& n) {
    const int x = n[0] - fine;
    return Point(double(x) / (x < 0 ? fine : coarse), double(n[1]) / coarse - 1, 0);
  });
  const auto is_border = [](const Point& p) {
    return (std::min)({p.x(), p.y(), 1 - p.x(), 1 - p.y()}) < 0.042;
  };
  const auto is_middle = [](const Point& p) {
    return (std::max)(std::abs(p.x() - 0.5), std::abs(p.y() - 0.5)) < 0.09;
  };
  return {"biased_plane", mesh, select(mesh, is_border, is_middle),
          translation(Vector(0, 0, 0.6)),
          View{Vector(0, -1, 0.5), Vector(0, 0, 1), 640, 480, true}};
}

// A sheet whose border is fixed and whose middle vertex is pulled.
inline Demo_shape make_pulled_sheet()
{
  const int cells = 40;
  const Mesh mesh = make_sheet(cells, cells, [&](const std::array<int, 3>& n) {
    return Point(double(n[0]) / cells, double(n[1]) / cells, 0);
  });
  const auto is_border = [](const Point& p) {
    return (std::min)({p.x(), p.y(), 1 - p.x(), 1 - p.y()}) < 1e-9;
  };
  const auto is_middle = [](const Point& p) {
    return (std::max)(std::abs(p.x() - 0.5), std::abs(p.y() - 0.5)) < 1e-9;
  };
  return {"pulled_sheet", mesh, select(mesh, is_border, is_middle), translation(Vector(0, 0, 0.3)),
          View{Vector(0.25, -1, 0.35), Vector(0, 0, 1), 520, 340, true}};
}

// A strip that is fixed at one end; a single vertex near the other end is to stand upright.
inline Demo_shape make_strip()
{
  const int cells = 8;
  const Mesh mesh = make_sheet(10 * cells, cells, [&](const std::array<int, 3>& n) {
    return Point(double(n[0]) / cells, double(n[1]) / cells - 0.5, 0);
  });
  const auto is_end = [](const Point& p) { return p.x() < 0.03; };
  const auto is_handle = [](const Point& p) {
    return (std::max)(std::abs(p.x() - 0.95), std::abs(p.y() - 0.5)) < 1e-9;
  };
  return {"strip", mesh, select(mesh, is_end, is_handle),
          motion(1, -90, Point(9.5, 0, 0), Vector(-3.5, 0, 5)),
          View{Vector(0.3, -1, 0.3), Vector(0, 0, 1), 560, 420}};
}

// A sheet with spikes, one edge of which is lifted and pulled over the opposite one.
inline Demo_shape make_spiky_plane()
{
  const int cells = 100, spikes = 10;
  const Mesh mesh = make_sheet(cells, cells, [&](const std::array<int, 3>& n) {
    const double x = double(n[0]) / cells, y = double(n[1]) / cells;
    const double wave = std::sin(spikes * CGAL_PI * x) * std::sin(spikes * CGAL_PI * y);
    return Point(2 * x - 1, 2 * y - 1, 0.09 * CGAL::square(wave * wave));
  });
  const auto is_first = [](const Point& p) { return p.x() < 0.045; };
  const auto is_last = [](const Point& p) { return p.x() > 0.955; };
  return {"spiky_plane", mesh, select(mesh, is_first, is_last),
          translation(Vector(-1.3, 0, 0.9)),
          View{Vector(-0.6, -1, 0.4), Vector(0, 0, 1), 640, 480}};
}

// The armadillo stands on its feet and raises a hand.
inline Demo_shape armadillo(const std::string& file)
{
  const Mesh mesh = read_mesh(file);
  const auto is_foot = [](const Point& p) { return p.y() < 0.08; };
  const auto is_hand = [](const Point& p) { return p.x() > 0.88 && p.y() > 0.6; };
  return {"armadillo", mesh, select(mesh, is_foot, is_hand), translation(Vector(-15, 40, 0)),
          View{Vector(0.5, 0.2, -1), Vector(0, 1, 0), 640, 640}};
}

// The camel stands on its feet and turns its head.
inline Demo_shape camel(const std::string& file)
{
  const Mesh mesh = read_mesh(file);
  const auto is_foot = [](const Point& p) { return p.y() < 0.1; };
  const auto is_head = [](const Point& p) { return p.y() > 0.85 && p.z() > 0.75; };
  return {"camel", mesh, select(mesh, is_foot, is_head),
          motion(1, -60, Point(0, 0.4, 0.32), Vector(-0.08, 0, 0)),
          View{Vector(-1, 0.25, 0.8), Vector(0, 1, 0), 640, 640}};
}

// The dino, with y upwards as the others, stands on its feet and is pulled down at a single vertex,
// the tip of its snout.
inline Demo_shape dino(const std::string& file)
{
  Mesh mesh = read_mesh(file);
  for(Point& p : mesh.points())
    p = Point(p.x(), p.z(), -p.y());
  const auto vertices = mesh.vertices();
  const auto tip = *std::max_element(vertices.begin(), vertices.end(), [&](auto v, auto w) {
    return mesh.point(v).z() < mesh.point(w).z();
  });
  const auto is_foot = [](const Point& p) { return p.y() < 0.1; };
  Demo_shape shape{"dino", mesh, select(mesh, is_foot, [](const Point&) { return false; }),
                   translation(Vector(0.3, -2, 0.5)),
                   View{Vector(1, 0.25, 0.35), Vector(0, 1, 0), 640, 640}};
  shape.selection[tip] = HANDLE;
  return shape;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_SHAPES_H
