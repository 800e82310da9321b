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

#include <CGAL/Exact_integer.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_homogeneous.h>

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

// Registration to a plane, with points far from the origin: a look at the end finds that it is a
// minimum, whatever rounding makes of the derivative of projections.
template <typename Point_>
void test_registration(const char* name)
{
  test_case() = std::string("registration, ") + name;
  const Shape shape = shapes()[9];
  using Domain = Polygon_soup_domain<std::vector<Point_>, decltype(shape.triangles)>;
  const double far_away = 10 * shape.diameter();
  std::vector<Point_> points;
  for(const auto& p : shape.points)
    points.push_back(Domain::make_point({p.x() + far_away, p.y() + far_away, p.z() + far_away}));
  CGAL::ARAP_deformation<Domain> deformation(Domain(points, shape.triangles));
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    deformation.insert_roi_vertex(v);
    if(v % 5 == 1)
      deformation.insert_control_vertex(v); // stays
    if(v % 3 != 0 || v % 5 == 1)
      continue;
    deformation.insert_control_vertex(v);
    CHECK(deformation.set_target_weight(v, 1));
    CHECK(deformation.set_target_set(v, [far_away](const Point_& p) {
      auto c = Domain::coordinates(p); // onto a plane
      const double distance = (c[2] - far_away - 0.2 * (c[0] - c[1])) / 1.08;
      return Domain::make_point({c[0] + 0.2 * distance, c[1] - 0.2 * distance, c[2] - distance});
    }));
  }
  const CGAL::ARAP::Report report = deformation.deform();
  CHECK(report && report.end == CGAL::ARAP::End::minimum);
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
    planar.push_back(CGAL::ARAP::internal::construct_point<true, Point_2>(p.x(), p.y(), 0.0));
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
    CGAL::ARAP::internal::translated<true>(planar[0], std::array<double, 2>{1, 2});
  CHECK(moved[0] == planar[0][0] + 1 && moved[1] == planar[0][1] + 2);
}

// What looks for a way out does not find one to the side: a strip in the plane that is pushed
// together by default options, a body that swings, a frame.
void test_staying_in_the_plane()
{
  using Point_2 = Eigen::Vector2d;
  const Shape shape = grid("strip", 21, 5, [](double u, double v) {
    return Eigen::Vector3d(5 * u, v, 0);
  });
  std::vector<Point_2> rest;
  for(const auto& p : shape.points)
    rest.emplace_back(p.x(), p.y());
  using Domain = Polygon_soup_domain<std::vector<Point_2>, decltype(shape.triangles)>;
  using Deformation = CGAL::ARAP_deformation<Domain>;
  const auto prepare = [&](Deformation& d, double share) {
    for(std::size_t v = 0; v < rest.size(); ++v)
    {
      d.insert_roi_vertex(v);
      if(const double x = rest[v].x(); x < 0.01 || x > 4.99)
        d.insert_control_vertex(v, Point_2(share * x, rest[v].y()));
    }
  };
  test_case() = "a strip in the plane that is pushed together";
  for(const double share : {0.98, 0.9, 0.6})
  {
    std::vector<double> energies;
    for(const bool is_verified : {true, false})
    {
      std::vector<Point_2> points = rest;
      Deformation d(Domain(points, shape.triangles));
      prepare(d, share);
      CGAL::ARAP::Options options;
      options.verify_minimum = is_verified;
      CHECK(d.set_options(options));
      const CGAL::ARAP::Report report = d.deform();
      CHECK(report);
      energies.push_back(report.final_energy());

      // the energy of the points that were written
      std::vector<Point_2> others = rest;
      Deformation e(Domain(others, shape.triangles));
      prepare(e, share);
      options.initial_guess = CGAL::ARAP::Initial_guess::previous;
      CHECK(e.set_options(options) && e.preprocess());
      others = points;
      CHECK_AT_MOST(std::abs(e.deform(0, 0).final_energy() / energies.back() - 1), 1e-9);
    }
    CHECK_AT_MOST(energies[0] / energies[1], 1.001);
  }

  test_case() = "handles on a line in the plane, after a half-turn";
  std::vector<Point_2> turning = rest;
  Deformation turned_over(Domain(turning, shape.triangles));
  for(std::size_t v = 0; v < rest.size(); ++v)
  {
    turned_over.insert_roi_vertex(v);
    if(rest[v].x() > 4.99)
      turned_over.insert_control_vertex(v, Point_2(-rest[v]));
  }
  CHECK(turned_over.deform());
  for(std::size_t v = 0; v < rest.size(); ++v)
    CHECK_AT_MOST((turning[v] + rest[v]).norm(), 1e-12);

  test_case() = "gravity across the plane, and a frame that tilts out of it";
  std::vector<Point_2> points = rest;
  Deformation d(Domain(points, shape.triangles));
  prepare(d, 1);
  CGAL::ARAP::Dynamics dynamics;
  dynamics.acceleration = {0, 0, -9.81};
  for(int step = 0; step < 5; ++step)
  {
    const CGAL::ARAP::Step_report report = d.advance(dynamics);
    CHECK(report && report.center_of_mass[2] == 0);
  }
  for(std::size_t v = 0; v < rest.size(); ++v)
    CHECK_AT_MOST((points[v] - rest[v]).norm(), 1e-12);
  const double c = std::cos(0.5), s = std::sin(0.5);
  const CGAL::ARAP::Matrix_3x3 tilted = {c, 0, s, 0, 1, 0, -s, 0, c},
                               turned = {c, -s, 0, s, c, 0, 0, 0, 1};
  const CGAL::ARAP::Outcome refused = d.set_target_rotation(0, tilted);
  CHECK(refused.status == CGAL::ARAP::Status::invalid_rotation);
  CHECK(refused.message.find("vertex 0 was given a target rotation") == 0);
  CHECK(refused.message.find("turn their plane into itself") != std::string::npos);
  CHECK(d.set_target_rotation(0, turned));
  const Eigen::Matrix3f rounded = Eigen::AngleAxisf(0.5f, Eigen::Vector3f::UnitZ()).matrix();
  CGAL::ARAP::Matrix_3x3 nearly;
  for(int k = 0; k < 9; ++k) // as single precision may leave it
    nearly[static_cast<std::size_t>(k)] = rounded(k / 3, k % 3) + (k % 3 == k / 3 ? -6e-8 : 6e-8);
  CHECK(d.set_target_rotation(0, nearly));
}

int main()
{
  using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
  using CGAL::Simple_cartesian;
  test_case() = "points of several types";
  test_point_type<Bare_point>(1e-12);
  test_point_type<Epeck::Point_3>(1e-12);
  test_point_type<CGAL::Simple_homogeneous<CGAL::Exact_integer>::Point_3>(1e-12);
  test_point_type<Simple_cartesian<double>::Point_3>(1e-12);
  test_point_type<Simple_cartesian<float>::Point_3>(1e-5);
  test_point_type<std::array<double, 3>>(1e-12);
  test_point_type<std::array<float, 3>>(1e-5);
  test_registration<std::array<double, 3>>("double");
  test_registration<std::array<float, 3>>("float");
  test_plane<Epeck::Point_2>(1e-12);
  test_plane<Simple_cartesian<double>::Point_2>(1e-12);
  test_plane<std::array<double, 2>>(1e-12);
  test_plane<std::array<float, 2>>(1e-5);
  test_plane<Eigen::Vector2d>(1e-12);
  test_staying_in_the_plane();
  return checks_result();
}
