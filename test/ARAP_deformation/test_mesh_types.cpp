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

// Surfaces in data structures for halfedges, of types that are dear to compile: kernels, a class
// derived from Surface_mesh, points in the plane, a part of a mesh, maps of a user's.

#include "include/domains.h"
#include "include/mesh_type.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/arap_deform.h>

#include <CGAL/boost/graph/Face_filtered_graph.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>

#include <boost/property_map/property_map.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

// what newer versions of CGAL ship as CGAL/Testsuite/DerivedSurfaceMesh.h
struct Derived_mesh : Mesh
{
  std::string name;
};

#define CGAL_GRAPH_TRAITS_INHERITANCE_CLASS_NAME Derived_mesh
#define CGAL_GRAPH_TRAITS_INHERITANCE_BASE_CLASS_NAME CGAL::Surface_mesh<Point>
#include <CGAL/boost/graph/graph_traits_inheritance_macros.h>

using CGAL::ARAP::Face_graph_domain;

// a mesh in the plane, turned by a half turn about an axis through it
void test_planar_mesh()
{
  test_case() = "a mesh of points with two coordinates";
  using Point_2 = CGAL::Simple_cartesian<double>::Point_2;
  const Shape shape = grid("sheet", 6, 6, [](double u, double v) {
    return Eigen::Vector3d(u, v + 0.2 * u * u, 0);
  });
  CGAL::Surface_mesh<Point_2> mesh;
  for(const auto& p : shape.points)
    mesh.add_vertex(Point_2(p.x(), p.y()));
  for(const auto& t : shape.triangles)
    mesh.add_face(mesh.vertices().begin()[t[0]], mesh.vertices().begin()[t[1]],
                  mesh.vertices().begin()[t[2]]);
  check_conforms(Face_graph_domain(mesh));
  CGAL::ARAP_deformation<CGAL::Surface_mesh<Point_2>> deformation(mesh);
  const auto vertices = mesh.vertices();
  deformation.insert_roi_vertices(vertices.begin(), vertices.end());
  for(auto v : vertices)
    if(shape.points[v].x() < 0.3)
    {
      deformation.insert_control_vertex(v);
      deformation.set_target_position(v, Point_2(-mesh.point(v).x(), -mesh.point(v).y()));
    }
  CHECK(deformation.deform(100, 1e-12));
  for(auto v : vertices)
  {
    CHECK_AT_MOST(std::abs(mesh.point(v).x() + shape.points[v].x()), 1e-6);
    CHECK_AT_MOST(std::abs(mesh.point(v).y() + shape.points[v].y()), 1e-6);
  }

  // velocities and forces have two coordinates, too
  using Vector_2 = CGAL::Simple_cartesian<double>::Vector_2;
  const auto v = *std::prev(vertices.end());
  CHECK(deformation.set_velocity(v, Vector_2(1, 2)));
  CHECK(deformation.velocity(v) == (CGAL::ARAP::Coordinates{1, 2, 0}));
  CHECK(deformation.advance(CGAL::ARAP::Dynamics(), std::map{std::pair{v, Vector_2(0, 3)}}));
  CHECK(deformation.velocity(v)[2] == 0 && deformation.velocity(v)[1] > 0);
}

// points of a type that has nothing but what is asked for
void test_bare_points()
{
  test_case() = "bare points";
  const Shape shape = shapes()[8];
  const Scenario s = scenario(shape);
  Mesh mesh = make_mesh<Mesh>(shape);
  std::vector<Bare_point> points;
  for(const auto& p : shape.points)
    points.emplace_back(p.x(), p.y(), p.z());
  const auto map = boost::make_iterator_property_map(points.begin(),
                                                     get(boost::vertex_index, mesh));
  const auto domain =
    CGAL::ARAP::make_face_graph_domain(mesh, CGAL::parameters::vertex_point_map(map));
  check_conforms(domain);
  compare(reference<2>(shape.points, shape.triangles, s, Cell_scheme::spokes()),
          deform(domain, all_vertices(mesh), s, Cell_scheme::spokes()), shape.diameter());
}

// the faces of one half of a shape, without the other half
void test_filtered_graph()
{
  test_case() = "Face_filtered_graph";
  const Shape shape = shapes()[8];
  Mesh mesh = make_mesh<Mesh>(shape);
  auto patch = mesh.add_property_map<Mesh::Face_index, int>("f:patch", 0).first;
  std::vector<std::array<std::size_t, 3>> selected;
  for(auto f : mesh.faces())
  {
    std::array<std::size_t, 3> corners;
    std::size_t k = 0;
    for(auto v : vertices_around_face(halfedge(f, mesh), mesh))
      corners[k++] = v;
    if(shape.points[corners[0]].y() < 0.3)
    {
      patch[f] = 1;
      selected.push_back(corners);
    }
  }
  CHECK(selected.size() > 20 && selected.size() + 20 < mesh.number_of_faces());
  using Graph = CGAL::Face_filtered_graph<Mesh>;
  Graph graph(mesh, 1, patch);
  CHECK(graph.is_selection_valid());

  Scenario s = scenario(shape);
  std::vector<bool> is_in(shape.points.size(), false);
  for(const auto& corners : selected)
    for(std::size_t v : corners)
      is_in[v] = true;
  std::vector<Mesh::Vertex_index> vertices; // of the selection, and their numbers in the shape
  Scenario part{{}, {}};
  for(std::size_t v = 0; v < is_in.size(); ++v)
  {
    if(!is_in[v])
      s.selection[v] = 0;
    else
    {
      vertices.emplace_back(static_cast<Mesh::size_type>(v));
      part.selection.push_back(s.selection[v]);
      part.targets.push_back(s.targets[v]);
    }
  }
  for(Cell_scheme cells : all_cell_schemes)
  {
    Mesh copy = mesh;
    Graph copy_graph(copy, 1, copy.add_property_map<Mesh::Face_index, int>("f:patch").first);
    const Face_graph_domain<Graph> domain(copy_graph);
    if(cells == all_cell_schemes[0])
    {
      check_conforms(domain);
      for(auto v : copy.vertices()) // others would have the index of the first vertex
        CHECK(domain.is_vertex(v) == is_in[v]);
      for(auto f : copy.faces())
        CHECK(domain.is_simplex(f) == (patch[f] == 1));
      CHECK(!domain.is_vertex(Mesh::null_vertex()) && !domain.is_simplex(Mesh::null_face()));
    }
    Result expected = reference<2>(shape.points, selected, s, cells);
    Result found = deform(domain, vertices, part, cells);
    std::vector<Eigen::Vector3d> points;
    for(auto v : vertices)
      points.push_back(expected.points[v]);
    expected.points = points;
    compare(expected, found, shape.diameter());
  }
}

// the points in a map of the user's, outside of the mesh
Result deform_with_own_map(const Shape& shape, const Scenario& s, Cell_scheme cells)
{
  Mesh mesh = make_mesh<Mesh>(shape);
  std::map<Mesh::Vertex_index, Point> points;
  for(auto v : mesh.vertices())
  {
    points[v] = mesh.point(v);
    mesh.point(v) = CGAL::ORIGIN;
  }
  const auto domain = CGAL::ARAP::make_face_graph_domain(
    mesh, CGAL::parameters::vertex_point_map(boost::make_assoc_property_map(points)));
  const Result result = deform(domain, all_vertices(mesh), s, cells);
  for(auto v : mesh.vertices())
    CHECK(mesh.point(v) == CGAL::ORIGIN);
  return result;
}

// the same of a const mesh
void test_own_map_of_const_mesh()
{
  test_case() = "a const mesh with a point map of the user's";
  const Mesh mesh = make_mesh<Mesh>(shapes()[8]);
  std::map<Mesh::Vertex_index, Point> points;
  for(auto v : mesh.vertices())
    points[v] = mesh.point(v);
  const Mesh::Vertex_index v(3);
  const std::map<Mesh::Vertex_index, Point> targets = {{v, Point(9, 9, 9)}};
  CHECK(CGAL::arap_deform(mesh, targets, CGAL::parameters::vertex_point_map(
                                           boost::make_assoc_property_map(points))));
  CHECK(points[v] == targets.at(v) && mesh.point(v) != targets.at(v));
}

int main()
{
  test_own_map_of_const_mesh();
  test_mesh_type<CGAL::Surface_mesh<CGAL::Simple_cartesian<float>::Point_3>>(
    "Simple_cartesian<float>", 2e-5);
  test_mesh_type<Derived_mesh>("a derived class");
  test_mesh_type<CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>>(
    "EPICK");
  test_mesh_type<CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>>(
    "EPECK");
  test_mesh_type<CGAL::Polyhedron_3<Kernel, CGAL::Polyhedron_items_with_id_3>>(
    "Polyhedron_3 with ids");
  test_planar_mesh();
  test_bare_points();
  test_filtered_graph();
  compare_all("own map", deform_with_own_map);
  return checks_result();
}
