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

// The same deformation whatever the mesh type, the order of the vertices, the order of the faces
// and the point map.

#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_items_with_id_3.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

using CGAL::ARAP::Cell_scheme;

struct Result
{
  std::vector<double> energy;
  std::vector<Eigen::Vector3d> points;
};

template <typename Deformation>
std::vector<double> run(Deformation& deformation, Cell_scheme cells)
{
  CGAL::ARAP::Options options;
  options.cells = cells;
  deformation.set_options(options);
  const auto report = deformation.deform(10, 0);
  CHECK(report);
  return report.energy;
}

template <typename TriangleMesh>
Result deform(const Shape& shape, const Scenario& s, Cell_scheme cells)
{
  TriangleMesh mesh = make_mesh<TriangleMesh>(shape);
  CGAL::ARAP_deformation<TriangleMesh> deformation(mesh);
  prepare(deformation, s, all_vertices(mesh));
  Result result{run(deformation, cells), {}};
  for(auto v : vertices(mesh))
    result.points.push_back(vector(get(CGAL::vertex_point, mesh, v)));
  return result;
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
  auto domain = CGAL::ARAP::make_face_graph_domain(
    mesh, CGAL::parameters::vertex_point_map(boost::make_assoc_property_map(points)));
  CGAL::ARAP_deformation<Mesh, CGAL::Default, decltype(domain)> deformation(domain);
  prepare(deformation, s, all_vertices(mesh));
  Result result{run(deformation, cells), {}};
  for(auto v : mesh.vertices())
  {
    result.points.push_back(vector(points[v]));
    CHECK(mesh.point(v) == CGAL::ORIGIN);
  }
  return result;
}

// vertices, faces and the corners of each face in another order
Result deform_shuffled(const Shape& shape, const Scenario& s, Cell_scheme cells)
{
  std::mt19937 random(11);
  std::vector<std::size_t> place(shape.points.size());
  std::iota(place.begin(), place.end(), std::size_t(0));
  std::shuffle(place.begin(), place.end(), random);
  Shape shuffled = shape;
  Scenario moved = s;
  for(std::size_t v = 0; v < place.size(); ++v)
  {
    shuffled.points[place[v]] = shape.points[v];
    moved.selection[place[v]] = s.selection[v];
    moved.targets[place[v]] = s.targets[v];
  }
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), random);
  for(auto& t : shuffled.triangles)
  {
    std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    for(auto& v : t)
      v = place[v];
  }
  const Result result = deform<Mesh>(shuffled, moved, cells);
  Result restored = result;
  for(std::size_t v = 0; v < place.size(); ++v)
    restored.points[v] = result.points[place[v]];
  return restored;
}

void compare(const Result& a, const Result& b, const Shape& shape)
{
  for(std::size_t k = 0; k < a.energy.size(); ++k)
    CHECK_AT_MOST(std::abs(a.energy[k] - b.energy[k]), 1e-10 * a.energy[0]);
  CHECK(a.points.size() == b.points.size());
  for(std::size_t v = 0; v < a.points.size(); ++v)
    CHECK_AT_MOST((a.points[v] - b.points[v]).norm(), 1e-10 * shape.diameter());
}

int main()
{
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  using Polyhedron_with_id = CGAL::Polyhedron_3<Kernel, CGAL::Polyhedron_items_with_id_3>;
  for(const Shape& shape : shapes())
    for(Cell_scheme cells :
        {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims(), Cell_scheme::elements()})
    {
      test_case() = shape.name;
      const Scenario s = scenario(shape);
      const Result reference = deform<Mesh>(shape, s, cells);
      compare(reference, deform<Polyhedron>(shape, s, cells), shape);
      compare(reference, deform<Polyhedron_with_id>(shape, s, cells), shape);
      compare(reference, deform_with_own_map(shape, s, cells), shape);
      compare(reference, deform_shuffled(shape, s, cells), shape);
    }
  return checks_result();
}
