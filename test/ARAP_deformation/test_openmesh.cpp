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

// OpenMesh's meshes of triangles and of polygons, with coordinates of both precisions.

#include "include/nasty_runs.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>

struct Double_traits : OpenMesh::DefaultTraits
{
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

// The points of a mesh as they are: the map that CGAL provides rounds what it writes to float.
template <typename OpenMesh_mesh>
struct Point_map
{
  using key_type = typename OpenMesh_mesh::VertexHandle;
  using value_type = typename OpenMesh_mesh::Point;
  using reference = value_type;
  using category = boost::read_write_property_map_tag;

  OpenMesh_mesh* mesh;

  friend value_type get(Point_map map, key_type v) { return map.mesh->point(v); }
  friend void put(Point_map map, key_type v, const value_type& p) { map.mesh->set_point(v, p); }
};

// Returns the new vertices; faces must be those of a manifold.
template <typename OpenMesh_mesh, typename Faces>
std::vector<typename OpenMesh_mesh::VertexHandle>
add_to(OpenMesh_mesh& mesh, const std::vector<Eigen::Vector3d>& points, const Faces& faces)
{
  std::vector<typename OpenMesh_mesh::VertexHandle> vertices;
  for(const auto& p : points)
    vertices.push_back(mesh.add_vertex(typename OpenMesh_mesh::Point(p.x(), p.y(), p.z())));
  for(const auto& face : faces)
  {
    std::vector<typename OpenMesh_mesh::VertexHandle> corners;
    for(std::size_t v : face)
      corners.push_back(vertices[v]);
    CHECK(mesh.add_face(corners).is_valid());
  }
  return vertices;
}

template <typename OpenMesh_mesh>
void test_mesh_type(const std::string& name, double tolerance)
{
  for(const Shape& shape : shapes())
  {
    test_case() = name + ", " + shape.name;
    const Scenario s = scenario(shape);
    for(Cell_scheme cells : all_cell_schemes)
    {
      OpenMesh_mesh mesh;
      const auto vertices = add_to(mesh, shape.points, shape.triangles);
      const OpenMesh_mesh rest = mesh;
      const Result expected = reference<2>(shape.points, shape.triangles, s, cells);
      const CGAL::ARAP::Face_graph_domain<OpenMesh_mesh> domain(mesh);
      check_conforms(domain);
      mesh = rest; // CGAL's map has rounded the points that were put back
      compare(expected, deform(domain, vertices, s, cells), shape.diameter(), 2e-5);

      mesh = rest;
      const CGAL::ARAP::Face_graph_domain<OpenMesh_mesh, Point_map<OpenMesh_mesh>> own_map(
        mesh, Point_map<OpenMesh_mesh>{&mesh});
      check_conforms(own_map);
      compare(expected, deform(own_map, vertices, s, cells), shape.diameter(), tolerance);
    }
  }
}

// quads and larger faces, in a mesh from which faces and vertices were removed
void test_polygons()
{
  test_case() = "PolyMesh with polygons";
  using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<Double_traits>;
  Polygons polygons;
  const Shape shape = tube(polygons);
  const Scenario s = scenario(shape);
  for(Cell_scheme cells : all_cell_schemes)
  {
    PolyMesh mesh;
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    const auto extra = mesh.add_vertex(PolyMesh::Point(9, 9, 9));
    const auto vertices = add_to(mesh, shape.points, polygons);
    mesh.delete_face(PolyMesh::FaceHandle(20), false);
    mesh.delete_vertex(extra, false);
    Polygons kept = polygons;
    kept.erase(kept.begin() + 20);
    const CGAL::ARAP::Face_graph_domain<PolyMesh, Point_map<PolyMesh>> domain(
      mesh, Point_map<PolyMesh>{&mesh});
    check_conforms(domain);
    compare(reference<2>(shape.points, kept, s, cells), deform(domain, vertices, s, cells),
            shape.diameter());
  }
}

template <typename OpenMesh_mesh, std::size_t N>
void test_shelf(const std::string& name, const std::vector<Nasty_shape<N>>& shelf)
{
  for(const Nasty_shape<N>& shape : manifold(shelf))
  {
    OpenMesh_mesh mesh;
    const auto vertices = add_to(mesh, shape.points, shape.simplices);
    using Map = Point_map<OpenMesh_mesh>;
    test_in_place_of(name, CGAL::ARAP::Face_graph_domain<OpenMesh_mesh, Map>(mesh, Map{&mesh}),
                     vertices, shape);
  }
}

int main()
{
  test_polygons();
  test_mesh_type<OpenMesh::TriMesh_ArrayKernelT<Double_traits>>("TriMesh, double", 1e-10);
  test_mesh_type<OpenMesh::PolyMesh_ArrayKernelT<Double_traits>>("PolyMesh, double", 1e-10);
  test_mesh_type<OpenMesh::TriMesh_ArrayKernelT<>>("TriMesh, float", 2e-5);
  test_mesh_type<OpenMesh::PolyMesh_ArrayKernelT<>>("PolyMesh, float", 2e-5);
  test_shelf<OpenMesh::TriMesh_ArrayKernelT<Double_traits>>("TriMesh", nasty_surfaces());
  test_shelf<OpenMesh::PolyMesh_ArrayKernelT<Double_traits>>("PolyMesh", nasty_polygons());
  print_ends();
  return checks_result();
}
