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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_SCENARIO_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_SCENARIO_H

// The shapes to deform, and their targets.

#include "measure.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/helpers.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using vertex_descriptor = Mesh::Vertex_index;

inline Mesh read_mesh(const std::string& file)
{
  Mesh mesh;
  if(!std::ifstream(file))
    throw Failure("cannot read the mesh " + file +
                  "\nFor CGAL's meshes, set the environment variable CGAL_DATA_DIR to their folder "
                  "(script/setup gets them), or name another mesh.");
  if(!CGAL::IO::read_polygon_mesh(file, mesh) || !CGAL::is_triangle_mesh(mesh))
    throw Failure(file + " is not a triangulated surface");
  return mesh;
}

// Cuts each edge into `parts` equal parts, and each triangle into parts^2: the same surface with
// about parts^2 times as many vertices. The vertices of the mesh come first.
inline Mesh subdivided(const Mesh& mesh, std::size_t parts)
{
  if(parts == 1)
    return mesh;
  Mesh result;
  result.reserve(num_vertices(mesh) + (parts - 1) * num_edges(mesh) +
                 (parts - 1) * (parts - 2) / 2 * num_faces(mesh),
                 parts * num_edges(mesh) + 3 * parts * (parts - 1) / 2 * num_faces(mesh),
                 parts * parts * num_faces(mesh));
  const auto between = [](const Point& a, const Point& b, double t) { return a + t * (b - a); };
  const double n = static_cast<double>(parts);

  std::vector<vertex_descriptor> corner(mesh.number_of_vertices());
  for(vertex_descriptor v : vertices(mesh))
    corner[v.idx()] = result.add_vertex(mesh.point(v));
  std::vector<vertex_descriptor> first_on_edge(mesh.number_of_edges()); // parts - 1 on each
  for(auto e : edges(mesh))
    for(std::size_t k = 1; k < parts; ++k)
    {
      const vertex_descriptor v = result.add_vertex(
        between(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)), k / n));
      if(k == 1)
        first_on_edge[e.idx()] = v;
    }

  // the vertex k parts along h
  const auto along = [&](Mesh::Halfedge_index h, std::size_t k) {
    if(k == 0) return corner[mesh.source(h).idx()];
    if(k == parts) return corner[mesh.target(h).idx()];
    const auto e = mesh.edge(h);
    const std::size_t place = mesh.source(h) == mesh.vertex(e, 0) ? k : parts - k;
    return vertex_descriptor(
      static_cast<Mesh::size_type>(first_on_edge[e.idx()].idx() + place - 1));
  };
  std::vector<vertex_descriptor> row, next_row; // parallel to the first side
  for(auto f : faces(mesh))
  {
    const auto h = mesh.halfedge(f), right = mesh.next(h), left = mesh.prev(h);
    row.clear();
    for(std::size_t k = 0; k <= parts; ++k)
      row.push_back(along(h, k));
    for(std::size_t r = 1; r <= parts; ++r, row.swap(next_row))
    {
      next_row.assign(1, along(left, parts - r));
      const Point &a = result.point(next_row[0]), b = result.point(along(right, r));
      for(std::size_t k = 1; k + r < parts; ++k)
        next_row.push_back(result.add_vertex(between(a, b, k / (n - r))));
      if(r < parts)
        next_row.push_back(along(right, r));
      for(std::size_t k = 0; k + r <= parts; ++k)
      {
        result.add_face(row[k], row[k + 1], next_row[k]);
        if(k + r < parts)
          result.add_face(row[k + 1], next_row[k + 1], next_row[k]);
      }
    }
  }
  return result;
}

// Along the longest axis of the bounding box, the lowest 3% of a shape are fixed and the highest 3%
// are rotated by 1.5 rad about the line along that axis through the middle of the box.
class Twist
{
public:
  explicit Twist(const Eigen::AlignedBox3d& box) : m_middle(box.center())
  {
    const double share = 0.03, extent = box.sizes().maxCoeff(&m_axis);
    m_low = box.min()[m_axis] + share * extent;
    m_high = box.max()[m_axis] - share * extent;
    m_rotation = Eigen::AngleAxisd(1.5, Eigen::Vector3d::Unit(m_axis));
  }

  int axis() const { return m_axis; }
  bool is_fixed(const Eigen::Vector3d& p) const { return p[m_axis] <= m_low; }
  bool is_handle(const Eigen::Vector3d& p) const { return p[m_axis] >= m_high; }

  Eigen::Vector3d target(const Eigen::Vector3d& p) const
  {
    return is_handle(p) ? Eigen::Vector3d(m_middle + m_rotation * (p - m_middle)) : p;
  }

private:
  Eigen::Vector3d m_middle;
  Eigen::Matrix3d m_rotation;
  int m_axis = 0;
  double m_low = 0, m_high = 0;
};

inline Eigen::Vector3d to_vector(const Point& p) { return {p[0], p[1], p[2]}; }
inline Point to_point(const Eigen::Vector3d& p) { return Point(p[0], p[1], p[2]); }

struct Scenario
{
  Mesh mesh;
  std::vector<std::pair<vertex_descriptor, Point>> targets; // of all control vertices
  double diagonal = 0;                                      // of the bounding box

  std::size_t number_of_vertices() const { return num_vertices(mesh); }
  std::size_t number_of_free_vertices() const { return num_vertices(mesh) - targets.size(); }
};

inline Eigen::AlignedBox3d bounding_box(const Mesh& mesh)
{
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  return Eigen::AlignedBox3d(Eigen::Vector3d(box.xmin(), box.ymin(), box.zmin()),
                             Eigen::Vector3d(box.xmax(), box.ymax(), box.zmax()));
}

inline Scenario make_scenario(Mesh mesh)
{
  Scenario scenario;
  const Eigen::AlignedBox3d box = bounding_box(mesh);
  const Twist twist(box);
  for(vertex_descriptor v : vertices(mesh))
  {
    const Eigen::Vector3d p = to_vector(mesh.point(v));
    if(twist.is_fixed(p))
      scenario.targets.emplace_back(v, mesh.point(v));
    else if(twist.is_handle(p))
      scenario.targets.emplace_back(v, to_point(twist.target(p)));
  }
  scenario.mesh = std::move(mesh);
  scenario.diagonal = box.diagonal().norm();
  if(scenario.number_of_free_vertices() == 0)
    throw Failure("the mesh has no vertices between its two ends: nothing is free to move");
  return scenario;
}

inline double largest_distance(const std::vector<Point>& a, const std::vector<Point>& b)
{
  double largest = a.size() == b.size() ? 0 : std::numeric_limits<double>::quiet_NaN();
  for(std::size_t v = 0; v < (std::min)(a.size(), b.size()); ++v)
    largest = larger(largest, CGAL::squared_distance(a[v], b[v]));
  return std::sqrt(largest);
}

// of a mesh without gaps between its ids
inline std::vector<Point> points_of(const Mesh& mesh)
{
  return {mesh.points().begin(), mesh.points().end()};
}

inline double largest_distance(const Mesh& a, const Mesh& b)
{
  return largest_distance(points_of(a), points_of(b));
}

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_SCENARIO_H
