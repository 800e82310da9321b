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

// What is compiled here is header-only, with preconditions checked, and as by a compiler that does
// not have the vector extensions of g++ and clang.

#undef CGAL_ARAP_DEFORMATION_COMPILED
#define CGAL_DEBUG 1
#define CGAL_ARAP_NO_VECTOR_EXTENSIONS

#include "include/check.h"
#include "include/conformance.h"
#include "include/domains.h"
#include "include/misuse.h"
#include "include/shapes.h"
#include "include/Single_precision_solver.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Edge_map_weight.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/check_closest_rotation.h>
#include <CGAL/ARAP_deformation/conformance/check_sparse_solver.h>
#include <CGAL/property_map.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <type_traits>
#include <vector>

// Misuse of the interface where preconditions are checked: they fail.
namespace misuse {

void test_all()
{
  CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {});
  const auto is_refused = [](const auto& call) {
    try
    {
      call();
    }
    catch(const CGAL::Precondition_exception&)
    {
      return true;
    }
    return false;
  };
  test_misuse([&](const auto& call) { CHECK(is_refused(call)); });

  Mesh mesh = make_mesh<Mesh>(octahedron());
  CGAL::ARAP_deformation<Mesh> d(mesh);
  CHECK(is_refused([&] { d.target_position(Mesh::Vertex_index(0)); }));
  // there is one for each vertex
  CHECK(is_refused([&] { d.simplex_rotation(Mesh::Face_index(0)); }));
  CGAL::ARAP::Options options;
  options.cells = CGAL::ARAP::Cell_scheme::elements();
  CHECK(d.set_options(options));
  CHECK(is_refused([&] { d.rotation(Mesh::Vertex_index(0)); })); // there is one for each face

  // edge weights by indices that have gaps, which are no misuse
  std::map<Mesh::Vertex_index, int> indices;
  for(Mesh::Vertex_index v : mesh.vertices())
    indices[v] = 2 * int(v) + 1;
  const boost::associative_property_map<std::map<Mesh::Vertex_index, int>> index_map(indices);
  const CGAL::ARAP::Edge_map_weight weight = CGAL::ARAP::make_edge_map_weight(
    mesh, CGAL::Constant_property_map<Mesh::Edge_index, double>(3),
    CGAL::parameters::vertex_index_map(index_map));
  for(Mesh::Edge_index e : mesh.edges())
    CHECK(weight.edge_weight(CGAL::ARAP::Edge_set::star, get(index_map, mesh.vertex(e, 0)),
                             get(index_map, mesh.vertex(e, 1)), 0) == 3);

  // in a run, by a visitor
  d.insert_control_vertex(Mesh::Vertex_index(0));
  d.insert_roi_vertex(Mesh::Vertex_index(1));
  CHECK(is_refused([&] {
    CHECK(!d.deform([&](const auto&) {
      d.clear_roi_vertices();
      return CGAL::ARAP::Visitor_action::proceed;
    }));
  }));
  CHECK(d.deform()); // the exception has ended the run

  // a vertex that there is not
  std::vector<Point> points = points_of(octahedron().points);
  const auto faces = octahedron().triangles;
  using Soup = CGAL::ARAP::Polygon_soup_domain<std::vector<Point>, std::decay_t<decltype(faces)>>;
  CGAL::ARAP_deformation<Soup> soup(Soup(points, faces));
  CHECK(is_refused([&] { soup.insert_roi_vertex(points.size()); }));
  CHECK(is_refused([&] { soup.insert_control_vertex(std::size_t(-1)); }));
  CHECK(soup.roi_vertices().empty());
}

} // namespace misuse

// What compilers get that do not have the vector extensions of g++ and clang.
namespace without_vector_extensions {

// all kernels of the energies, and of both minimizers
void test_deformation()
{
  const Shape shape = grid("sheet", 30, 20, [](double u, double v) {
    return Eigen::Vector3d(3 * u, 2 * v, 0.2 * std::sin(9 * u));
  });
  for(Cell_scheme cells : all_cell_schemes)
    for(double tolerance : {0.0, 1e-3})
    {
      Mesh mesh = make_mesh<Mesh>(shape);
      CGAL::ARAP_deformation<Mesh> deformation(mesh);
      CGAL::ARAP::Options options;
      options.cells = cells;
      CHECK(deformation.set_options(options));
      prepare(deformation, scenario(shape), all_vertices(mesh));
      const CGAL::ARAP::Report report = deformation.deform(300, tolerance);
      CHECK(CGAL::ARAP::succeeded(report.status));
      for(std::size_t k = 1; k < report.energy.size(); ++k)
        CHECK_AT_MOST(report.energy[k], report.energy[k - 1] + 1e-15 * report.energy_scale);
      CHECK(report.energy.back() < 0.9 * report.energy.front());
    }
}

void test_all()
{
  CHECK_CONFORMS(CGAL::ARAP::check_closest_rotation(CGAL::ARAP::Newton_closest_rotation()));
  CHECK_CONFORMS(CGAL::ARAP::check_sparse_solver(CGAL::ARAP::Multifrontal_cholesky_solver()));
  CHECK_CONFORMS(
    CGAL::ARAP::check_sparse_solver(Single_precision_solver(), 2e-2));
  test_deformation();
}

} // namespace without_vector_extensions

int main()
{
  without_vector_extensions::test_all();
  misuse::test_all(); // from then on CGAL throws
  return checks_result();
}
