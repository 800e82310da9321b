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

// Ranges of points of types that are dear to compile, in space and in the plane.

#include "include/domains.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

using CGAL::ARAP::Polygon_soup_domain;

template <typename Point_>
void test_point_type(double tolerance)
{
  const Shape shape = shapes()[9];
  const Scenario s = scenario(shape);
  using Domain = Polygon_soup_domain<std::vector<Point_>, decltype(shape.triangles)>;
  std::vector<Point_> points;
  for(const auto& p : shape.points)
    points.push_back(Domain::make_point({p.x(), p.y(), p.z()}));
  const Domain domain(points, shape.triangles);
  check_conforms(domain);
  compare(reference<2>(shape.points, shape.triangles, s, Cell_scheme::spokes()),
          deform(domain, numbers(points.size()), s, Cell_scheme::spokes()), shape.diameter(),
          tolerance);
}

// Points with two coordinates are deformed as those in the plane z = 0, and stay there: compressed,
// they do not give way to the side.
template <typename Point_2>
void test_plane(double tolerance)
{
  test_case() = "points with two coordinates";
  const int side = 9;
  const Shape shape = grid("sheet", side, side, [](double u, double v) {
    return Eigen::Vector3d(3 * u, v + 0.1 * std::sin(9 * u), 0);
  });
  std::vector<Point_2> planar;
  std::vector<Point> spatial = points_of(shape.points);
  for(const auto& p : shape.points)
    planar.push_back(CGAL::ARAP::internal::construct_point<Point_2>(p.x(), p.y(), 0.0));
  for(Cell_scheme cells : all_cell_schemes)
  {
    auto p = planar;
    auto q = spatial;
    const auto run = [&](const auto& domain) {
      CGAL::ARAP_deformation<std::decay_t<decltype(domain)>> deformation(domain);
      CHECK(deformation.set_options(options_for(cells)));
      for(std::size_t v : domain.vertices())
      {
        deformation.insert_roi_vertex(v);
        const double x = shape.points[v].x();
        if(x > 0.01 && x < 2.99)
          continue;
        deformation.insert_control_vertex(v);
        auto c = domain.coordinates(domain.point(v));
        c[0] *= 0.5;
        c[1] += 0.2 * x;
        CHECK(deformation.set_target_position(v, domain.make_point(c)));
      }
      return deformation.deform(300, 0);
    };
    const auto domain = CGAL::ARAP::make_polygon_soup_domain(p, shape.triangles);
    check_conforms(domain);
    CHECK(run(domain));
    CHECK(run(CGAL::ARAP::make_polygon_soup_domain(q, shape.triangles)));
    for(std::size_t v = 0; v < p.size(); ++v)
    {
      CHECK(q[v][2] == 0);
      CHECK_AT_MOST(std::abs(CGAL::to_double(p[v][0]) - q[v][0]), tolerance);
      CHECK_AT_MOST(std::abs(CGAL::to_double(p[v][1]) - q[v][1]), tolerance);
    }
  }
  const Point_2 moved =
    CGAL::ARAP::internal::translated(planar[0], std::array<double, 2>{1, 2});
  CHECK(moved[0] == planar[0][0] + 1 && moved[1] == planar[0][1] + 2);
}

int main()
{
  using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
  using CGAL::Simple_cartesian;
  test_case() = "points of several types";
  test_point_type<Bare_point>(1e-12);
  test_point_type<Epeck::Point_3>(1e-12);
  test_point_type<Simple_cartesian<double>::Point_3>(1e-12);
  test_point_type<Simple_cartesian<float>::Point_3>(1e-5);
  test_point_type<std::array<double, 3>>(1e-12);
  test_point_type<std::array<float, 3>>(1e-5);
  test_plane<Epeck::Point_2>(1e-12);
  test_plane<Simple_cartesian<double>::Point_2>(1e-12);
  test_plane<std::array<double, 2>>(1e-12);
  test_plane<std::array<float, 2>>(1e-5);
  test_plane<Eigen::Vector2d>(1e-12);
  return checks_result();
}
