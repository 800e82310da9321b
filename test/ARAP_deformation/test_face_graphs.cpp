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

// Surfaces in data structures for halfedges: removed elements, a const mesh with an output map,
// large polygons, other orders of vertices and faces, all terms of the energy, and shapes that are
// not clean. test_mesh_types has other types of meshes and of points.

#include "include/mesh_type.h"
#include "include/nasty_runs.h"
#include "include/term_runs.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/arap_deform.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/Polyhedron_3.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

using CGAL::ARAP::Face_graph_domain;

void test_removed_elements()
{
  test_case() = "removed elements";
  const Shape shape = shapes()[5];
  const Scenario s = scenario(shape);
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices, removed;
  for(const auto& p : shape.points)
  {
    removed.push_back(mesh.add_vertex(Point(7, 7, 7)));
    vertices.push_back(mesh.add_vertex(point(p)));
  }
  for(const auto& [a, b, c] : shape.triangles)
    mesh.add_face(vertices[a], vertices[b], vertices[c]);
  for(auto v : removed)
    mesh.remove_vertex(v);
  const std::size_t hole = shape.triangles.size() / 2;
  CGAL::Euler::remove_face(mesh.halfedge(Mesh::Face_index(Mesh::size_type(hole))), mesh);
  auto triangles = shape.triangles;
  triangles.erase(triangles.begin() + std::ptrdiff_t(hole));
  CHECK(mesh.has_garbage());
  CHECK(mesh.number_of_faces() == triangles.size());
  for(Cell_scheme cells : all_cell_schemes)
  {
    Mesh copy = mesh;
    const Face_graph_domain<Mesh> domain(copy);
    check_conforms(domain);
    compare(reference<2>(shape.points, triangles, s, cells), deform(domain, vertices, s, cells),
            shape.diameter());
  }
}

void test_const_mesh()
{
  test_case() = "a const mesh with an output map";
  const Shape shape = shapes()[8];
  const Scenario s = scenario(shape);
  const Mesh mesh = make_mesh<Mesh>(shape);
  const Mesh before = mesh;
  std::map<Mesh::Vertex_index, Point> output;
  const auto output_map = boost::make_assoc_property_map(output);
  const auto domain = CGAL::ARAP::make_face_graph_domain(mesh, output_map);
  check_conforms(domain);
  const auto same =
    CGAL::ARAP::make_face_graph_domain(mesh, CGAL::parameters::output_point_map(output_map));
  static_assert(std::is_same_v<decltype(same), decltype(domain)>);
  CHECK(!same.is_in_place());
  output.clear();
  Result result = deform(domain, all_vertices(mesh), s, Cell_scheme::spokes(), [&](auto v) {
    return s.selection[v] == 0 ? mesh.point(v) : output.at(v);
  });
  for(auto v : mesh.vertices()) // what is not in the region of interest is not written
    CHECK(output.count(v) == (s.selection[v] == 0 ? 0 : 1));
  CHECK(same_points(mesh, before));
  compare(reference<2>(shape.points, shape.triangles, s, Cell_scheme::spokes()), result,
          shape.diameter());

  // the function writes all points, those of vertices without a face too
  Mesh with_isolated = mesh;
  const auto isolated = with_isolated.add_vertex(Point(5, 5, 5));
  const Mesh& input = with_isolated;
  output.clear();
  const Face_graph_domain all(input, input.points(), get(boost::vertex_index, input), output_map);
  std::map<Mesh::Vertex_index, bool> constrained;
  std::map<Mesh::Vertex_index, Point> targets;
  for(auto v : mesh.vertices())
    if(s.selection[v] != 1)
    {
      constrained[v] = true;
      targets[v] = point(s.targets[v]);
    }
  const CGAL::ARAP::Report report = CGAL::arap_deform(
    all, boost::make_assoc_property_map(constrained), boost::make_assoc_property_map(targets));
  CHECK(report);
  CHECK(output.size() == input.number_of_vertices());
  CHECK(output[isolated] == Point(5, 5, 5));
}

// A polygon with many corners is turned, or refused.
void test_large_polygon(int n, bool is_refused)
{
  test_case() = "a polygon with " + std::to_string(n) + " corners";
  Mesh mesh;
  std::vector<Mesh::Vertex_index> corners;
  for(int k = 0; k < n; ++k)
  {
    const double angle = 2 * CGAL_PI * k / n, radius = 1 + 0.2 * std::cos(5 * angle);
    corners.push_back(
      mesh.add_vertex(Point(radius * std::cos(angle), radius * std::sin(angle), 0)));
  }
  mesh.add_face(corners);
  const Mesh before = mesh;
  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  deformation.insert_roi_vertices(corners.begin(), corners.end());
  for(int k : {0, n / 3, 2 * n / 3})
  {
    const Point& p = mesh.point(corners[k]);
    deformation.insert_control_vertex(corners[k]);
    deformation.set_target_position(corners[k], Point(p.x(), 0.6 * p.y(), 0.8 * p.y()));
  }
  const CGAL::ARAP::Report report = deformation.deform(200, 1e-8);
  std::cout << test_case() << ": " << report.seconds.preprocess << " + "
            << report.seconds.total - report.seconds.preprocess << " s, " << report.iterations
            << " iterations" << std::endl;
  CHECK(bool(report) != is_refused);
  if(is_refused)
  {
    CHECK(report.status == CGAL::ARAP::Status::too_many_corners);
    CHECK(report.message.find("more than 2048 corners") != std::string::npos);
    CHECK(report.message.find("triangulate_face") != std::string::npos);
    CHECK(same_points(mesh, before));
    return;
  }
  for(auto v : corners)
  {
    const Point p = before.point(v);
    CHECK_AT_MOST(std::sqrt(CGAL::squared_distance(mesh.point(v),
                                                   Point(p.x(), 0.6 * p.y(), 0.8 * p.y()))), 1e-3);
  }
}

Result deform_shuffled(const Shape& shape, const Scenario& s, Cell_scheme cells)
{
  std::vector<std::size_t> place;
  Mesh mesh = make_mesh<Mesh>(shuffled(shape, place));
  const Result result =
    deform(Face_graph_domain<Mesh>(mesh), all_vertices(mesh), shuffled(s, place), cells);
  Result restored = result;
  for(std::size_t v = 0; v < place.size(); ++v)
    restored.points[v] = result.points[place[v]];
  return restored;
}

template <typename Mesh_>
void test_polygons()
{
  test_case() = "polygons";
  Polygons polygons;
  const Shape shape = tube(polygons);
  const Scenario s = scenario(shape);
  for(Cell_scheme cells : all_cell_schemes)
  {
    Mesh_ mesh = make_mesh<Mesh_>(shape.points, polygons);
    const Face_graph_domain<Mesh_> domain(mesh);
    check_conforms(domain);
    compare(reference<2>(shape.points, polygons, s, cells),
            deform(domain, all_vertices(mesh), s, cells), shape.diameter());
  }
}

// Each term of the energy, on triangles in two components and on polygons.
template <typename Mesh_>
void test_terms_of(const std::string& name)
{
  const auto test = [&](const Shape& shape, const auto& faces) {
    test_case() = name + ", " + shape.name;
    test_terms<2>(shape.points, faces, scenario(shape), [&](const auto& compare_with) {
      Mesh_ mesh = make_mesh<Mesh_>(shape.points, faces);
      compare_with(Face_graph_domain<Mesh_>(mesh), all_vertices(mesh));
    });
  };
  for(const Shape& shape : {shapes()[6], shapes()[10]})
    test(shape, as_polygons(shape.triangles));
  Polygons polygons;
  const Shape shape = tube(polygons);
  test(shape, polygons);
}

// shapes that are not clean, where the points are written to another place
template <std::size_t N>
void test_with_output_map(const Nasty_shape<N>& shape)
{
  const Mesh mesh = make_mesh<Mesh>(shape.points, shape.simplices);
  for_each_case(shape, "output map", [&](const Handles& handles, const Options& options) {
    std::map<Mesh::Vertex_index, Point> output;
    const auto output_map = boost::make_assoc_property_map(output);
    using Domain = CGAL::ARAP::Face_graph_domain<const Mesh, CGAL::Default, CGAL::Default,
                                                 decltype(output_map)>;
    CGAL::ARAP_deformation<Domain> deformation(
      Domain(mesh, mesh.points(), get(boost::vertex_index, mesh), output_map));
    const bool is_done = run(deformation, all_vertices(mesh), [&](auto v) {
      const auto written = output.find(v);
      return written == output.end() ? mesh.point(v) : written->second;
    }, handles, options);
    CHECK(output.size() == (is_done ? num_vertices(mesh) : 0));
  });
}

// what is null is no element, in a mesh that does not know its elements either
template <typename Mesh_>
void test_null_elements()
{
  using Graph_traits = boost::graph_traits<Mesh_>;
  Mesh_ mesh = make_mesh<Mesh_>(octahedron());
  CGAL::ARAP_deformation<Mesh_> d(mesh);
  CHECK(d.set_options(options_for(CGAL::ARAP::Cell_scheme::elements())));
#ifdef CGAL_NDEBUG // else a precondition says so
  CHECK(!d.insert_roi_vertex(Graph_traits::null_vertex()) && d.roi_vertices().empty());
#endif
  CHECK(d.insert_control_point(Graph_traits::null_face(), {1, 0, 0}).status ==
        CGAL::ARAP::Status::not_a_simplex);
  const CGAL::ARAP::Matrix_3x3 identity = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  CHECK(d.simplex_rotation(Graph_traits::null_face()) == identity);
}

int main()
{
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  test_mesh_type<Mesh>("Simple_cartesian<double>");
  test_mesh_type<Polyhedron>("Polyhedron_3");
  test_removed_elements();
  test_null_elements<Mesh>();
  test_null_elements<Polyhedron>();
  test_const_mesh();
  for(int n : {5, 64, 65, 100, 1000, 2049, 70000})
    test_large_polygon(n, n > 2048);
  compare_all("another order", deform_shuffled);
  test_polygons<Mesh>();
  test_polygons<Polyhedron>();
  test_terms_of<Mesh>("terms over Surface_mesh");
  test_terms_of<Polyhedron>("terms over Polyhedron_3");
  test_shelf_as_graph<Mesh>("Surface_mesh");
  test_shelf_as_graph<Polyhedron>("Polyhedron_3");
  for_each_manifold([](const auto& shape) { test_with_output_map(shape); });
  print_ends();
  return checks_result();
}
