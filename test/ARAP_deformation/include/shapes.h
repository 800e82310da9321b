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

#ifndef CGAL_ARAP_DEFORMATION_TEST_SHAPES_H
#define CGAL_ARAP_DEFORMATION_TEST_SHAPES_H

// Small shapes made in code, and a handle scenario that fits them all.

#include "check.h"

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

// of the bounding box of points
inline double diameter_of(const std::vector<Eigen::Vector3d>& points)
{
  Eigen::AlignedBox3d box;
  for(const auto& p : points)
    box.extend(p);
  return box.diagonal().norm();
}

struct Shape
{
  std::string name;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::size_t, 3>> triangles;

  double diameter() const { return diameter_of(points); }
};

// A sheet of nu x nv quads, each cut in two, at the points f(u, v) with u and v in [0, 1].
// Closed in u, or in u and v, if `wrap_u`, `wrap_v`.
template <typename Function>
Shape grid(const std::string& name, int nu, int nv, const Function& f, bool wrap_u = false,
           bool wrap_v = false)
{
  Shape shape{name, {}, {}};
  const int columns = wrap_u ? nu : nu + 1, rows = wrap_v ? nv : nv + 1;
  for(int i = 0; i < columns; ++i)
    for(int j = 0; j < rows; ++j)
      shape.points.push_back(f(double(i) / nu, double(j) / nv));
  const auto vertex = [&](int i, int j) { return std::size_t((i % columns) * rows + j % rows); };
  for(int i = 0; i < nu; ++i)
    for(int j = 0; j < nv; ++j)
    {
      const std::size_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                        d = vertex(i, j + 1);
      if((i + j) % 2 == 0)
        shape.triangles.insert(shape.triangles.end(), {{a, b, c}, {a, c, d}});
      else
        shape.triangles.insert(shape.triangles.end(), {{a, b, d}, {b, c, d}});
    }
  return shape;
}

inline Shape octahedron()
{
  return {"octahedron",
          {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

// each triangle cut in four, the new vertices moved by `f`
template <typename Function>
Shape subdivided(const std::string& name, const Shape& coarse, const Function& f)
{
  Shape fine{name, coarse.points, {}};
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
  const auto middle = [&](std::size_t a, std::size_t b) {
    const auto [it, is_new] = middles.insert({std::minmax(a, b), fine.points.size()});
    if(is_new)
      fine.points.push_back(f(0.5 * (coarse.points[a] + coarse.points[b])));
    return it->second;
  };
  for(const auto& [a, b, c] : coarse.triangles)
  {
    const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangles.insert(fine.triangles.end(),
                          {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

// vertices, triangles and the corners of each triangle in another order; a vertex v is at place[v]
inline Shape shuffled(const Shape& shape, std::vector<std::size_t>& place)
{
  std::mt19937 random(11);
  place.resize(shape.points.size());
  std::iota(place.begin(), place.end(), std::size_t(0));
  std::shuffle(place.begin(), place.end(), random);
  Shape result = shape;
  for(std::size_t v = 0; v < place.size(); ++v)
    result.points[place[v]] = shape.points[v];
  std::shuffle(result.triangles.begin(), result.triangles.end(), random);
  for(auto& t : result.triangles)
  {
    std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    for(auto& v : t)
      v = place[v];
  }
  return result;
}

inline Shape two_components(const Shape& shape)
{
  Shape both = shape;
  both.name = "two of " + shape.name;
  for(const auto& p : shape.points)
    both.points.push_back(p + Eigen::Vector3d(1.5 * shape.diameter(), 0, 0));
  for(const auto& [a, b, c] : shape.triangles)
    both.triangles.push_back({a + shape.points.size(), b + shape.points.size(),
                              c + shape.points.size()});
  return both;
}

// A dozen of them: open and closed, flat and curved, with sharp and obtuse and irregular triangles.
inline std::vector<Shape> shapes()
{
  using V = Eigen::Vector3d;
  const double pi = std::acos(-1.0);
  const auto normalized = [](const V& p) { return V(p.normalized()); };
  const Shape sphere =
    subdivided("sphere", subdivided("", subdivided("", octahedron(), normalized), normalized),
               normalized);
  std::vector<Shape> all;
  all.push_back({"tetrahedron", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                 {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}});
  all.push_back(octahedron());
  all.push_back(sphere);
  all.push_back(subdivided("ellipsoid", sphere, [](const V& p) { return p; }));
  for(auto& p : all.back().points)
    p = V(3 * p.x(), p.y(), 0.6 * p.z());
  all.push_back(grid("flat sheet", 12, 6, [](double u, double v) { return V(2 * u, v, 0); }));
  all.push_back(grid("bumpy sheet", 16, 12, [=](double u, double v) {
    return V(2 * u, 1.5 * v, 0.1 * std::sin(6 * pi * u) * std::cos(4 * pi * v));
  }));
  all.push_back(grid("obtuse sheet", 10, 8, [](double u, double v) {
    return V(u + 2.5 * v, 0.6 * v, 0.1 * u * u);
  }));
  all.push_back(grid("cylinder", 12, 15, [=](double u, double v) {
    return V(std::cos(2 * pi * u), std::sin(2 * pi * u), 5 * v);
  }, true));
  all.push_back(grid("torus", 16, 10, [=](double u, double v) {
    const double r = 2 + 0.7 * std::cos(2 * pi * v);
    return V(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), 0.7 * std::sin(2 * pi * v));
  }, true, true));
  all.push_back(grid("saddle", 10, 10, [](double u, double v) {
    return V(2 * u - 1, 2 * v - 1, (2 * u - 1) * (2 * u - 1) - (2 * v - 1) * (2 * v - 1));
  }));
  all.push_back(two_components(grid("strip", 14, 3, [](double u, double v) {
    return V(0.5 * v, 4 * u, 0.2 * u * u);
  })));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  all.push_back(grid("irregular sheet", 14, 14, [&](double u, double v) {
    return V(u + jitter(random) / 14, v + jitter(random) / 14, 0.3 * u * v + jitter(random) / 14);
  }));
  return all;
}

template <typename FaceGraph, typename Faces>
FaceGraph make_mesh(const std::vector<Eigen::Vector3d>& vectors, const Faces& faces)
{
  using Mesh_point = typename boost::property_traits<
    typename boost::property_map<FaceGraph, CGAL::vertex_point_t>::type>::value_type;
  std::vector<Mesh_point> points;
  for(const auto& p : vectors)
    points.emplace_back(p.x(), p.y(), p.z());
  FaceGraph mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, faces, mesh);
  return mesh;
}

template <typename TriangleMesh>
TriangleMesh make_mesh(const Shape& shape)
{
  return make_mesh<TriangleMesh>(shape.points, shape.triangles);
}

inline Eigen::Vector3d vector(const Point& p) { return {p.x(), p.y(), p.z()}; }
inline const Eigen::Vector3d& vector(const Eigen::Vector3d& p) { return p; }
inline Point point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

inline std::vector<Point> points_of(const Mesh& mesh)
{
  return {mesh.points().begin(), mesh.points().end()};
}

inline std::vector<Point> points_of(const std::vector<Eigen::Vector3d>& vectors)
{
  std::vector<Point> points;
  for(const auto& p : vectors)
    points.push_back(point(p));
  return points;
}

// the largest distance of two points at the same place; vast if their numbers differ
template <typename P, typename Q>
double largest_distance(const std::vector<P>& a, const std::vector<Q>& b)
{
  double largest = a.size() == b.size() ? 0 : 1e300;
  for(std::size_t k = 0; k < a.size() && k < b.size(); ++k)
    largest = larger(largest, (vector(a[k]) - vector(b[k])).norm());
  return largest;
}

// Which vertices are fixed, and where: the sixth of the vertices that is lowest along the longest
// axis of the shape stays (at least two), and as many of the highest are turned and moved.
struct Scenario
{
  std::vector<int> selection;           // 0 fixed, 1 free, 2 handle
  std::vector<Eigen::Vector3d> targets; // of all vertices: the free ones' are their places
};

// for the shape in another order, whose vertex v is at place[v]
inline Scenario shuffled(const Scenario& s, const std::vector<std::size_t>& place)
{
  Scenario result = s;
  for(std::size_t v = 0; v < place.size(); ++v)
  {
    result.selection[place[v]] = s.selection[v];
    result.targets[place[v]] = s.targets[v];
  }
  return result;
}

inline Eigen::Isometry3d rigid_motion(double angle, const Eigen::Vector3d& axis,
                                      const Eigen::Vector3d& translation)
{
  return Eigen::Translation3d(translation) * Eigen::AngleAxisd(angle, axis.normalized());
}

inline Scenario scenario(const Shape& shape, double angle = 0.9)
{
  Eigen::AlignedBox3d box;
  for(const auto& p : shape.points)
    box.extend(p);
  int axis;
  box.sizes().maxCoeff(&axis);
  std::vector<std::size_t> order(shape.points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return shape.points[a][axis] < shape.points[b][axis];
  });
  const std::size_t count = (std::max)(order.size() / 6, std::size_t(1)), n = order.size();
  const Eigen::Isometry3d motion =
    Eigen::Translation3d(box.center()) *
    rigid_motion(angle, Eigen::Vector3d(1, 2, 0.5), 0.2 * box.sizes()) *
    Eigen::Translation3d(-box.center());
  Scenario result{std::vector<int>(n, 1), shape.points};
  for(std::size_t k = 0; k < (std::max)(count, std::size_t(2)) && k + 1 < n; ++k)
    result.selection[order[k]] = 0;
  for(std::size_t k = n - count; k < n; ++k)
  {
    result.selection[order[k]] = 2;
    result.targets[order[k]] = motion * shape.points[order[k]];
  }
  return result;
}

// the point of a class with a domain, and of one without
template <typename Deformation>
auto point_of(const Eigen::Vector3d& p, int)
  -> decltype(Deformation::Deformation_domain::make_point({p.x(), p.y(), p.z()}))
{
  return Deformation::Deformation_domain::make_point({p.x(), p.y(), p.z()});
}

template <typename Deformation>
auto point_of(const Eigen::Vector3d& p, long)
{
  return typename Deformation::Point(p.x(), p.y(), p.z());
}

// inserts region and controls of a scenario; vertex k of the mesh is vertex k of the shape
template <typename Deformation>
void prepare(Deformation& deformation, const Scenario& s,
             const std::vector<typename Deformation::vertex_descriptor>& vertices)
{
  for(std::size_t k = 0; k < vertices.size(); ++k)
    if(s.selection[k] != 0)
      deformation.insert_roi_vertex(vertices[k]);
  for(std::size_t k = 0; k < vertices.size(); ++k)
    if(s.selection[k] == 2)
    {
      deformation.insert_control_vertex(vertices[k]);
      deformation.set_target_position(vertices[k], point_of<Deformation>(s.targets[k], 0));
    }
}

// whether two meshes of one connectivity have the same points, to the last bit
inline bool same_points(const Mesh& a, const Mesh& b)
{
  for(auto v : a.vertices())
    if(a.point(v) != b.point(v))
      return false;
  return true;
}

template <typename TriangleMesh>
auto all_vertices(const TriangleMesh& mesh)
{
  const auto range = vertices(mesh);
  return std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor>(range.begin(),
                                                                                   range.end());
}

#endif // CGAL_ARAP_DEFORMATION_TEST_SHAPES_H
