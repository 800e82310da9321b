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

// Visitors and reports: what a run tells while it goes on and when it is over, stop, cancel, and
// exceptions.

#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

using Deformation = CGAL::ARAP_deformation<Mesh>;
using Vertex = Mesh::Vertex_index;
using CGAL::ARAP::Report;
using CGAL::ARAP::Status;
using CGAL::ARAP::Visitor_action;

const Shape shape = grid("sheet", 12, 6, [](double u, double v) {
  return Eigen::Vector3d(2 * u, v, 0.1 * u * u);
});

void test_statuses()
{
  const Status all[] = {
    Status::not_run, Status::success, Status::converged, Status::iteration_limit, Status::stopped,
    Status::cancelled, Status::invalid_option, Status::in_a_run, Status::not_a_control_vertex,
    Status::invalid_weight, Status::not_a_simplex, Status::no_simplex, Status::no_tetrahedron,
    Status::non_finite_point, Status::non_finite_weight, Status::no_fixed_vertex,
    Status::singular_matrix, Status::solver_failed, Status::non_finite_energy};
  std::set<std::string> names, sentences;
  for(Status status : all)
  {
    names.insert(to_string(status));
    sentences.insert(CGAL::ARAP::internal::outcome(status).message);
  }
  CHECK(names.size() == std::size(all) && !names.count("unknown"));
  CHECK(sentences.size() == std::size(all));
  const Report report;
  CHECK(report.status == Status::not_run && !report && !report.message.empty());
}

void test_iterates()
{
  Mesh mesh = make_mesh<Mesh>(shape);
  const Mesh rest = mesh;
  Deformation d(mesh);
  prepare(d, scenario(shape), all_vertices(mesh));
  std::vector<double> seen;
  Mesh copy = mesh;
  const Report report = d.deform(9, 0, [&](const Deformation::Iterate& iterate) {
    CHECK(iterate.iteration() == seen.size());
    seen.push_back(iterate.energy());
    CHECK(same_points(mesh, rest)); // written when the run is over
    iterate.put_points(copy.points());
    return Visitor_action::proceed;
  });
  CHECK(seen == report.energy);
  CHECK(same_points(mesh, copy));
  CHECK(report.iterations == 9);
  CHECK(report.free_vertices > 0 && report.simplices > 0 && report.energy_scale > 0);
  CHECK(report.seconds.total > 0);
  CHECK(report.seconds.local_steps + report.seconds.global_steps + report.seconds.preprocess <=
        report.seconds.total);
}

void test_stop()
{
  const auto at = [](unsigned int k, Visitor_action action) {
    return [k, action](const auto& iterate) {
      return iterate.iteration() == k ? action : Visitor_action::proceed;
    };
  };
  Mesh five = make_mesh<Mesh>(shape);
  Deformation d(five);
  prepare(d, scenario(shape), all_vertices(five));
  CHECK(d.deform(5, 0));

  Mesh mesh = make_mesh<Mesh>(shape);
  Deformation e(mesh);
  prepare(e, scenario(shape), all_vertices(mesh));
  const Report stopped = e.deform(100, 0, at(5, Visitor_action::stop));
  CHECK(stopped.status == Status::stopped);
  CHECK(stopped && stopped.iterations == 5);
  CHECK(same_points(mesh, five));

  const Mesh before = mesh;
  const double energy = e.energy();
  const auto rotation = e.rotation(Vertex(40));
  for(Vertex v : e.control_vertices())
    e.translate(v, Kernel::Vector_3(0, 0, 1));
  const auto check_unchanged = [&] {
    CHECK(same_points(mesh, before));
    CHECK(e.energy() == energy);
    CHECK(e.rotation(Vertex(40)) == rotation);
  };
  const Report cancelled = e.deform(100, 0, at(5, Visitor_action::cancel));
  CHECK(cancelled.status == Status::cancelled);
  CHECK(!cancelled);
  check_unchanged();

  bool is_caught = false;
  try
  {
    e.deform(100, 0, [](const auto& iterate) {
      if(iterate.iteration() == 3)
        throw std::runtime_error("the user's own");
      return Visitor_action::proceed;
    });
  }
  catch(const std::runtime_error&)
  {
    is_caught = true;
  }
  CHECK(is_caught);
  check_unchanged();

  // and it still does what it would have done
  for(Vertex v : d.control_vertices())
    d.translate(v, Kernel::Vector_3(0, 0, 1));
  CHECK(d.deform(7, 0) && e.deform(7, 0));
  CHECK(same_points(mesh, five));
}

void test_checks()
{
  // what is not a number is never lost
  const double nan = std::nan("");
  CHECK(larger(1, 2) == 2 && larger(2, 1) == 2);
  CHECK(std::isnan(larger(1, nan)) && std::isnan(larger(nan, 1)));
  CHECK(std::isnan(largest_distance({Point(0, nan, 0), Point(3, 0, 0)},
                                    {Point(0, 0, 0), Point(1, 0, 0)})));

  Report report;
  report.energy_scale = 1;
  report.energy = {3, 2, 1, 1};
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
  report.energy = {3, 2, 2 + 1e-17, 2.1, 1};
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 3);
  report.energy = {1, std::nan("")};
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 1);
  CHECK(CGAL::ARAP::is_rotation({0, -1, 0, 1, 0, 0, 0, 0, 1}));
  CHECK(!CGAL::ARAP::is_rotation({0, 1, 0, 1, 0, 0, 0, 0, 1}));    // a reflection
  CHECK(!CGAL::ARAP::is_rotation({0, -1, 0, 1, 0, 1e-9, 0, 0, 1})); // sheared a little

  Mesh mesh = make_mesh<Mesh>(shape);
  const Mesh rest = mesh;
  CHECK(CGAL::ARAP::relative_edge_length_error(mesh, rest.points(), mesh.points()) == 0);
  for(Vertex v : mesh.vertices())
    mesh.point(v) = CGAL::ORIGIN + 1.25 * (mesh.point(v) - CGAL::ORIGIN);
  CHECK(std::abs(CGAL::ARAP::relative_edge_length_error(mesh, rest.points(), mesh.points()) -
                 0.25) < 1e-14);

  // the same over the simplices of a domain: each edge counts once, and those of triangles are all
  mesh.point(Vertex(3)) = Point(1, 2, 3);
  const std::vector<Point> rest_points(rest.points().begin(), rest.points().end());
  const double of_graph =
    CGAL::ARAP::relative_edge_length_error(mesh, rest.points(), mesh.points());
  const CGAL::ARAP::Face_graph_domain<Mesh> domain(mesh);
  CHECK(std::abs(CGAL::ARAP::relative_edge_length_error(domain, rest_points) - of_graph) < 1e-14);
  const std::vector<Point> square = {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0),
                                     Point(0, 1, 0)};
  std::vector<Point> stretched = square;
  stretched[2] = stretched[3] = Point(0, 3, 0);
  const std::vector<std::array<int, 4>> corners = {{0, 1, 2, 3}};
  using Corners = std::vector<std::array<int, 4>>;
  const CGAL::ARAP::Polygon_soup_domain<std::vector<Point>, Corners> face(stretched, corners);
  const CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>, Corners> flat(stretched, corners);
  const double left = 2, top = -1, right = std::sqrt(10.0) - 1; // errors of the sides, all 1 before
  const double rising = 3 - std::sqrt(2.0), falling = std::sqrt(10.0) - std::sqrt(2.0);
  const double sides = left * left + top * top + right * right;
  CHECK(std::abs(CGAL::ARAP::relative_edge_length_error(face, square) -
                 std::sqrt(sides / 4)) < 1e-14);
  CHECK(std::abs(CGAL::ARAP::relative_edge_length_error(flat, square) -
                 std::sqrt((sides + rising * rising + falling * falling) / 8)) < 1e-14);
}

// For a geometric series of decreases the extrapolated gap is that of some iterations before: never
// too small, and not much too large. A run that seems to end and does not is waited for.
void test_gap()
{
  using CGAL::ARAP::internal::Gap_estimate;
  for(const double ratio : {0.3, 0.8, 0.99})
  {
    Gap_estimate estimate;
    CHECK(std::isinf(estimate(3)));
    for(int k = 1; k < 300 && std::pow(ratio, k) > 1e-12; ++k)
    {
      estimate.add(std::pow(ratio, k - 1) - std::pow(ratio, k));
      const double gap = std::pow(ratio, k), estimated = estimate(2 + gap);
      if(k < 10)
        CHECK(std::isinf(estimated));
      else if(k >= 15)
      {
        CHECK_AT_MOST(gap / 2, estimated * (1 + 1e-6));
        const double earlier_gap = gap / std::pow(ratio, 9 + 0.25 * k);
        if(earlier_gap < 1)
          CHECK_AT_MOST(estimated, earlier_gap);
      }
    }
  }

  Gap_estimate estimate(1e-19);
  CHECK(estimate(1e-20) == 0); // nothing but rounding is left
  for(int k = 0; k < 50; ++k)
    estimate.add(1);
  CHECK(std::isinf(estimate(1000))); // no end in sight
  estimate.add(0);
  CHECK(estimate(1000) == 0);

  Gap_estimate rising; // weights that are negative, or rounding
  for(int k = 0; k < 20; ++k)
    rising.add(-1);
  CHECK(std::isinf(rising(1000)));

  Gap_estimate pausing;
  for(int k = 0; k < 20; ++k)
    pausing.add(std::pow(0.5, k));
  CHECK(pausing(100) < 1e-4);
  for(int k = 0; k < 3; ++k)
    pausing.add(1);
  for(int k = 0; k < 4; ++k)
    pausing.add(1e-9);
  CHECK(pausing(100) > 1e-2);
}

int main()
{
  test_statuses();
  test_iterates();
  test_stop();
  test_checks();
  test_gap();
  return checks_result();
}
