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

// The domain of ranges: triangles against a mesh, edges with three faces, faces of either
// orientation, output to another range, points of several types, and simplices that are none.

#include "include/domains.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>

using CGAL::ARAP::Polygon_soup_domain;
using CGAL::ARAP::Status;
using CGAL::ARAP::Tetrahedron_soup_domain;

void test_surfaces()
{
  for(const Shape& shape : shapes())
    for(Cell_scheme cells : all_cell_schemes)
    {
      test_case() = shape.name;
      const Scenario s = scenario(shape);
      const Result soup = reference<2>(shape.points, shape.triangles, s, cells);
      Mesh mesh = make_mesh<Mesh>(shape);
      compare(soup, deform(CGAL::ARAP::Face_graph_domain<Mesh>(mesh), all_vertices(mesh), s, cells),
              shape.diameter());

      // the orientation of a face means nothing
      auto turned = shape.triangles;
      for(std::size_t t = 0; t < turned.size(); t += 3)
        std::swap(turned[t][0], turned[t][1]);
      compare(soup, reference<2>(shape.points, turned, s, cells), shape.diameter());
    }
}

template <typename Point_>
void test_point_type(double tolerance)
{
  const Shape shape = shapes()[9];
  const Scenario s = scenario(shape);
  std::vector<Point_> points;
  for(const auto& p : shape.points)
    points.push_back(CGAL::ARAP::internal::construct_point<Point_>(p.x(), p.y(), p.z()));
  const Polygon_soup_domain<std::vector<Point_>, decltype(shape.triangles)> domain(points,
                                                                                   shape.triangles);
  check_conforms(domain);
  compare(reference<2>(shape.points, shape.triangles, s, Cell_scheme::spokes()),
          deform(domain, numbers(points.size()), s, Cell_scheme::spokes()), shape.diameter(),
          tolerance);
}

// three sheets that meet in one edge line
void test_non_manifold()
{
  test_case() = "edges with three faces";
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  const int n = 12;
  for(int k = 0; k <= n; ++k)
    for(const auto& [x, y] : {std::pair<double, double>(0, 0), {1, 0}, {-0.5, 0.9}, {-0.5, -0.9}})
      points.emplace_back(x, y, 0.5 * k);
  for(int k = 0; k < n; ++k)
    for(int sheet = 1; sheet <= 3; ++sheet)
    {
      triangles.push_back({4 * k, 4 * k + sheet, 4 * k + 4});
      triangles.push_back({4 * k + 4, 4 * k + sheet, 4 * k + 4 + sheet});
    }
  Scenario s{std::vector<int>(points.size(), 1), points};
  const Eigen::Isometry3d turn = rigid_motion(1.5, {0, 0, 1}, {0.5, 0, 0});
  for(int k = 0; k < 4; ++k)
  {
    s.selection[k] = 0;
    s.selection[points.size() - 1 - k] = 2;
    s.targets[points.size() - 1 - k] = turn * points[points.size() - 1 - k];
  }
  for(Cell_scheme cells : all_cell_schemes)
  {
    const Result result = reference<2>(points, triangles, s, cells);
    CHECK(result.energy.back() < 0.9 * result.energy.front());
    CHECK(result.energy.back() > 0);

    // a rigid motion of all fixed vertices is the motion of all
    Scenario rigid = s;
    for(std::size_t v = 0; v < points.size(); ++v)
    {
      rigid.selection[v] = rigid.selection[v] == 1 ? 1 : 2;
      rigid.targets[v] = turn * points[v];
    }
    std::vector<Point> moved = points_of(points);
    const Polygon_soup_domain<std::vector<Point>, decltype(triangles)> domain(moved, triangles);
    check_conforms(domain);
    CGAL::ARAP_deformation<std::decay_t<decltype(domain)>> deformation(domain);
    CGAL::ARAP::Options options;
    options.cells = cells;
    options.initial_guess = CGAL::ARAP::Initial_guess::laplacian;
    deformation.set_options(options);
    prepare(deformation, rigid, numbers(points.size()));
    CHECK(deformation.deform(2000, 1e-12));
    if(cells != Cell_scheme::elements()) // a membrane may fold
      for(std::size_t v = 0; v < points.size(); ++v)
        CHECK_AT_MOST((vector(moved[v]) - turn * points[v]).norm(), 0.02); // turned by 1.5
  }
}

void test_output_range()
{
  test_case() = "another range for the output";
  const Block shape = block(4, 2, 2);
  const Scenario s = scenario(shape);
  const std::vector<Point> points = points_of(shape.points);
  std::vector<Point> output(points.size(), Point(7, 7, 7));
  std::vector<Point> input = points;
  const Tetrahedron_soup_domain<std::vector<Point>, decltype(shape.tetrahedra)> domain(
    input, shape.tetrahedra, output);
  check_conforms(domain);
  output.assign(points.size(), Point(7, 7, 7));
  const auto read = [&output](std::size_t v) { return output[v]; };
  Result result = deform(domain, numbers(points.size()), s, Cell_scheme::spokes_and_rims(), read);
  CHECK(input == points);
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    CHECK((output[v] == Point(7, 7, 7)) == (s.selection[v] == 0)); // outside the region of interest
    if(s.selection[v] == 0)
      result.points[v] = shape.points[v];
  }
  compare(reference<3>(shape.points, shape.tetrahedra, s, Cell_scheme::spokes_and_rims()), result,
          shape.diameter());

  // a second run goes on from the first, and after reset() all is as at first
  CGAL::ARAP_deformation<std::decay_t<decltype(domain)>> d(domain);
  std::vector<Point> in_place = points;
  const Tetrahedron_soup_domain<std::vector<Point>, decltype(shape.tetrahedra)> plain(
    in_place, shape.tetrahedra);
  CGAL::ARAP_deformation<std::decay_t<decltype(plain)>> e(plain);
  const auto free = std::size_t(std::find(s.selection.begin(), s.selection.end(), 1) -
                                s.selection.begin());
  const auto run = [&](auto& deformation) {
    prepare(deformation, s, numbers(points.size()));
    deformation.deform(3, 0);
    deformation.insert_control_vertex(free); // fixed where it is: preprocesses again
    deformation.deform(3, 0);
    deformation.overwrite_initial_geometry();
    deformation.translate(free, Kernel::Vector_3(0.1, 0, 0));
    deformation.deform(3, 0);
  };
  run(d);
  run(e);
  for(std::size_t v = 0; v < points.size(); ++v)
    if(s.selection[v] != 0)
      CHECK(output[v] == in_place[v]);
  CHECK(input == points);
}

template <int Dimension, typename Simplices>
void check_refused(const Simplices& simplices)
{
  std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const std::vector<Point> before = points;
  const CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices> domain(points,
                                                                                        simplices);
  CGAL::ARAP_deformation<std::decay_t<decltype(domain)>> deformation(domain);
  for(std::size_t v : {0, 1, 2, 3, 4})
    deformation.insert_roi_vertex(v);
  deformation.insert_control_vertex(4);
  deformation.translate(4, Kernel::Vector_3(1, 0, 0));
  const CGAL::ARAP::Report report = deformation.deform();
  CHECK(report.status == Status::not_a_simplex);
  CHECK(report.message.find("vertex ") == 0);
  CHECK(points == before);
  CHECK(!CGAL::ARAP::check_domain(domain).empty());
}

int main()
{
  test_surfaces();
  test_non_manifold();
  test_output_range();

  test_case() = "points of several types";
  test_point_type<Bare_point>(1e-12);
  test_point_type<std::array<double, 3>>(1e-12);
  test_point_type<std::array<float, 3>>(1e-5);
  test_point_type<CGAL::Simple_cartesian<double>::Point_3>(1e-12);
  test_point_type<CGAL::Simple_cartesian<float>::Point_3>(1e-5);
  test_point_type<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>(1e-12);

  using Triangles = std::vector<std::array<int, 3>>;
  using Signed_polygons = std::vector<std::vector<int>>;
  using Tetrahedra = std::vector<std::array<int, 4>>;
  test_case() = "a corner that does not exist";
  check_refused<2>(Triangles{{0, 1, 2}, {0, 1, 5}});
  check_refused<2>(Triangles{{0, 1, 2}, {0, -1, 4}});
  check_refused<2>(Signed_polygons{{0, 1, 2}, {0, 1, 2, 9}});
  check_refused<3>(Tetrahedra{{0, 1, 2, 3}, {0, 1, 2, 1000000}});
  test_case() = "a corner twice";
  check_refused<2>(Triangles{{0, 1, 2}, {0, 1, 1}});
  check_refused<2>(Signed_polygons{{0, 1, 2}, {0, 1, 2, 3, 1, 4}});
  check_refused<3>(Tetrahedra{{0, 1, 2, 3}, {0, 1, 2, 0}});
  test_case() = "too few corners";
  check_refused<2>(Signed_polygons{{0, 1, 2}, {0, 1}});
  check_refused<3>(Signed_polygons{{0, 1, 2, 3}, {0, 1, 4}});
  return checks_result();
}
