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

// Small shapes made in code, and a handle scenario that fits them all. They are compiled once, in
// shapes.cpp.

#include "check.h"

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

Eigen::AlignedBox3d bounding_box(const std::vector<Eigen::Vector3d>& points);

// the diagonal of the bounding box
double diameter_of(const std::vector<Eigen::Vector3d>& points);

struct Shape
{
  std::string name;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::size_t, 3>> triangles;

  double diameter() const { return diameter_of(points); }
};

// A sheet of nu x nv quads, each cut in two, at the points f(u, v) with u and v in [0, 1].
// Closed in u, or in u and v, if `wrap_u`, `wrap_v`.
Shape grid(const std::string& name, int nu, int nv,
           const std::function<Eigen::Vector3d(double, double)>& f, bool wrap_u = false,
           bool wrap_v = false);

Shape octahedron();

// each triangle cut in four, the new vertices moved by `f`
Shape subdivided(const std::string& name, const Shape& coarse,
                 const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& f);

// vertices, triangles and the corners of each triangle in another order; a vertex v is at place[v]
Shape shuffled(const Shape& shape, std::vector<std::size_t>& place);

// the second one shifted
Shape joined(const Shape& first, const Shape& second, const Eigen::Vector3d& shift);

Shape two_components(const Shape& shape);

// A dozen of them: open and closed, flat and curved, with sharp and obtuse and irregular triangles.
std::vector<Shape> shapes();

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

using Triangles = decltype(Shape::triangles);
extern template Mesh make_mesh<Mesh>(const std::vector<Eigen::Vector3d>&, const Triangles&);

template <typename TriangleMesh>
TriangleMesh make_mesh(const Shape& shape)
{
  return make_mesh<TriangleMesh>(shape.points, shape.triangles);
}

inline Eigen::Vector3d vector(const Point& p) { return {p.x(), p.y(), p.z()}; }
inline const Eigen::Vector3d& vector(const Eigen::Vector3d& p) { return p; }
inline Point point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

double distance(const Eigen::Vector3d& p, const Eigen::Vector3d& q);

std::vector<Point> points_of(const Mesh& mesh);

std::vector<Point> points_of(const std::vector<Eigen::Vector3d>& vectors);

// the largest distance of two points at the same place; vast if their numbers differ
template <typename P, typename Q>
double largest_distance(const std::vector<P>& a, const std::vector<Q>& b)
{
  double largest = a.size() == b.size() ? 0 : 1e300;
  for(std::size_t k = 0; k < a.size() && k < b.size(); ++k)
    largest = larger(largest, distance(vector(a[k]), vector(b[k])));
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
Scenario shuffled(const Scenario& s, const std::vector<std::size_t>& place);

// p -> linear p + translation. Eigen's own maps take longer to compile in each program.
struct Affine_map
{
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const;
  Affine_map operator*(const Affine_map& first) const;
  Affine_map inverse() const;
  Eigen::Matrix4d matrix() const;
};

Affine_map rigid_motion(double angle, const Eigen::Vector3d& axis,
                        const Eigen::Vector3d& translation);

// the motion as it is seen from a center
Affine_map motion_about(const Eigen::Vector3d& center, const Affine_map& motion);

Scenario scenario(const Shape& shape, double angle = 0.9);

// with all fixed vertices as handles, so that the region is the whole shape
Scenario in_whole(Scenario s);

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
bool same_points(const Mesh& a, const Mesh& b);

template <typename TriangleMesh>
auto all_vertices(const TriangleMesh& mesh)
{
  const auto range = vertices(mesh);
  return std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor>(range.begin(),
                                                                                   range.end());
}

#endif // CGAL_ARAP_DEFORMATION_TEST_SHAPES_H
