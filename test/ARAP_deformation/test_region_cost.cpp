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

// The cost follows the region of interest: a deformation of a few vertices touches the points of
// these and their neighbours, whatever the size of the mesh.

#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

struct Touched
{
  std::set<std::size_t> read, written, indexed;
};

// the points of a mesh, with a record of whose were read and written
struct Recording_point_map
{
  using key_type = Mesh::Vertex_index;
  using value_type = Point;
  using reference = Point;
  using category = boost::read_write_property_map_tag;

  Mesh* mesh;
  Touched* touched;

  friend Point get(const Recording_point_map& map, key_type v)
  {
    map.touched->read.insert(v);
    return map.mesh->point(v);
  }

  friend void put(const Recording_point_map& map, key_type v, const Point& p)
  {
    map.touched->written.insert(v);
    map.mesh->point(v) = p;
  }
};

struct Recording_index_map
{
  using key_type = Mesh::Vertex_index;
  using value_type = std::size_t;
  using reference = std::size_t;
  using category = boost::readable_property_map_tag;

  Touched* touched;

  friend std::size_t get(const Recording_index_map& map, key_type v)
  {
    map.touched->indexed.insert(v);
    return v;
  }
};

Touched deform_patch(int side)
{
  Mesh mesh = make_mesh<Mesh>(grid("sheet", side, side, [side](double u, double v) {
    return Eigen::Vector3d(side * u, side * v, 0);
  }));
  Touched touched;
  using Domain = CGAL::ARAP::Face_graph_domain<Mesh, Recording_point_map, Recording_index_map>;
  CGAL::ARAP_deformation<Mesh, CGAL::Default, Domain> deformation(
    Domain(mesh, Recording_point_map{&mesh, &touched}, Recording_index_map{&touched}));
  const auto vertex = [side](int i, int j) { return Mesh::Vertex_index(i * (side + 1) + j); };
  for(int i = 10; i < 20; ++i)
    for(int j = 10; j < 20; ++j)
      deformation.insert_roi_vertex(vertex(i, j));
  deformation.insert_control_vertex(vertex(15, 15));
  deformation.translate(vertex(15, 15), Eigen::Vector3d(0, 0, 2));
  const auto report = deformation.deform(10, 0);
  CHECK(report);
  CHECK(report.free_vertices == 99);
  deformation.reset();
  return touched;
}

int main()
{
  const Touched small = deform_patch(40), large = deform_patch(400);
  CHECK(small.written.size() == 100);
  CHECK(large.written.size() == 100);
  CHECK(large.read.size() == small.read.size());
  CHECK(large.indexed.size() == small.indexed.size());
  CHECK(large.read.size() <= 14 * 14);
  CHECK(large.indexed.size() <= 14 * 14);
  return checks_result();
}
