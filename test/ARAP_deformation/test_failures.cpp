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

// Bad data and numerical failure: a status with a sentence that names the culprit, and mesh and
// object as they were.

#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using CGAL::ARAP::Outcome;
using CGAL::ARAP::Status;
using Vertex = Mesh::Vertex_index;

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

Shape sheet()
{
  return grid("sheet", 8, 4, [](double u, double v) { return Eigen::Vector3d(2 * u, v, u * v); });
}

// as same_points(), where points may not be numbers
bool same_or_bad_points(const Mesh& a, const Mesh& b)
{
  for(Vertex v : a.vertices())
    for(int k = 0; k < 3; ++k)
      if(a.point(v)[k] != b.point(v)[k] &&
         !(std::isnan(a.point(v)[k]) && std::isnan(b.point(v)[k])))
        return false;
  return true;
}

void check_refused(const Outcome& outcome, Status status, const std::string& culprit)
{
  CHECK(outcome.status == status);
  CHECK(!outcome);
  if(!CHECK(outcome.message.find(culprit) != std::string::npos))
    std::cerr << "    the message was: " << outcome.message << std::endl;
}

// After a failed call the mesh is as it was, and the object works once the cause is removed.
template <typename Deformation, typename Repair>
void check_failure(Mesh& mesh, Deformation& d, Status status, const std::string& culprit,
                   const Repair& repair)
{
  const Mesh before = mesh;
  check_refused(d.deform(), status, culprit);
  CHECK(same_or_bad_points(mesh, before));
  repair();
  const auto report = d.deform(5, 0);
  if(!CHECK(report))
    std::cerr << "    the message was: " << report.message << std::endl;
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
}

void test_points()
{
  for(double bad : {not_a_number, infinity, -infinity})
  {
    test_case() = "a point that is not finite";
    const Shape shape = sheet();
    const Scenario s = scenario(shape);
    Mesh mesh = make_mesh<Mesh>(shape);
    Mesh rest = mesh;
    mesh.point(Vertex(20)) = Point(0, bad, 0);
    {
      CGAL::ARAP_deformation<Mesh> d(mesh);
      prepare(d, s, all_vertices(mesh));
      check_failure(mesh, d, Status::non_finite_point, "vertex 20 ", [&] {
        mesh.point(Vertex(20)) = rest.point(Vertex(20));
        d.overwrite_initial_geometry();
      });
    }
    test_case() = "a target that is not finite";
    mesh = rest;
    CGAL::ARAP_deformation<Mesh> d(mesh);
    prepare(d, s, all_vertices(mesh));
    const Vertex handle = d.control_vertices()[1];
    const Point target = d.target_position(handle);
    CHECK(d.set_target_position(handle, Point(0, 0, bad)));
    check_failure(mesh, d, Status::non_finite_point,
                  "the target of vertex " + std::to_string(std::size_t(handle)) + " ",
                  [&] { d.set_target_position(handle, target); });
  }
}

void test_overflow()
{
  test_case() = "overflow";
  const Shape shape = sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  prepare(d, scenario(shape), all_vertices(mesh));
  const Vertex handle = d.control_vertices()[0];
  d.set_target_position(handle, Point(1e200, 0, 0));
  check_failure(mesh, d, Status::non_finite_energy, "overflow",
                [&] { d.set_target_position(handle, Point(9, 0, 0)); });
}

// not a number for the triangles at one corner of the sheet
struct Undefined_weight : CGAL::ARAP::Uniform_weight
{
  std::array<double, 3>
  simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>& triangle) const
  {
    const double w = triangle[0][0] + triangle[1][0] + triangle[2][0] > 5.6 ? not_a_number : 1;
    return {w, 1, 1};
  }
};

void test_faces()
{
  test_case() = "a degenerate triangle";
  Shape flat = sheet();
  flat.points[13] = (flat.points[12] + flat.points[14]) / 2; // already collinear in the sheet
  flat.points[18] = flat.points[13];
  Mesh degenerate = make_mesh<Mesh>(flat);
  CGAL::ARAP_deformation<Mesh> e(degenerate);
  prepare(e, scenario(flat), all_vertices(degenerate));
  const auto report = e.deform();
  CHECK(report);
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);

  test_case() = "a weight that is not finite";
  Mesh mesh = make_mesh<Mesh>(sheet());
  const Mesh before = mesh;
  using Traits = CGAL::ARAP_deformation_traits_3<CGAL::Default, Undefined_weight>;
  CGAL::ARAP_deformation<Mesh, Traits> u(mesh);
  prepare(u, scenario(sheet()), all_vertices(mesh));
  const auto refused = u.deform();
  CHECK(refused.status == Status::non_finite_weight);
  CHECK(refused.message.find("the face with the vertices ") == 0);
  CHECK(refused.message.find("has edges whose weights are not finite") != std::string::npos);
  CHECK(same_points(mesh, before));
}

void test_nothing_fixed()
{
  test_case() = "no fixed vertex";
  const Shape shape = sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  d.insert_roi_vertices(mesh.vertices().begin(), mesh.vertices().end());
  check_failure(mesh, d, Status::no_fixed_vertex, "vertex 0 is free",
                [&] { d.insert_control_vertex(Vertex(7)); });

  test_case() = "one of two components is not fixed";
  const Shape two = two_components(shape);
  Mesh pair = make_mesh<Mesh>(two);
  CGAL::ARAP_deformation<Mesh> e(pair);
  e.insert_roi_vertices(pair.vertices().begin(), pair.vertices().end());
  e.insert_control_vertex(Vertex(7));
  CHECK(e.set_target_position(Vertex(7), Point(0, 0, 3)));
  const Mesh rest = pair;
  for(int call = 0; call < 2; ++call) // the second one has nothing to do
    CHECK(e.preprocess().message.find("unconstrained component") != std::string::npos);
  for(int run = 0; run < 2; ++run) // both have nothing to preprocess
  {
    const auto report = e.deform();
    CHECK(report);
    CHECK(report.unconstrained_components == std::vector<std::size_t>(1, shape.points.size()));
    CHECK(report.message.find("component of vertex " + std::to_string(shape.points.size())) !=
          std::string::npos);
    CHECK(report.free_vertices == shape.points.size() - 1);
  }
  for(std::size_t v = 0; v < two.points.size(); ++v)
    CHECK((pair.point(Vertex(v)) == rest.point(Vertex(v))) == (v >= shape.points.size()));
  e.insert_control_vertex(Vertex(shape.points.size() + 3));
  const auto all_fixed = e.deform();
  CHECK(all_fixed && all_fixed.unconstrained_components.empty());
  CHECK(all_fixed.free_vertices == two.points.size() - 2);

  test_case() = "isolated vertices";
  const Vertex isolated = mesh.add_vertex(Point(5, 5, 5));
  CGAL::ARAP_deformation<Mesh> f(mesh);
  f.insert_roi_vertices(mesh.vertices().begin(), mesh.vertices().end());
  f.insert_control_vertex(Vertex(7));
  CHECK(f.deform()); // stay where they are
  CHECK(mesh.point(isolated) == Point(5, 5, 5));
  f.insert_control_vertex(isolated); // goes to its target, whether that is a hard one or a soft one
  CHECK(f.set_target_position(isolated, Point(6, 5, 4)));
  CHECK(f.set_target_weight(isolated, 0.5));
  CHECK(f.deform());
  CHECK_AT_MOST(std::sqrt(CGAL::squared_distance(mesh.point(isolated), Point(6, 5, 4))), 1e-12);
}

void test_nothing_free()
{
  test_case() = "nothing is free";
  const Shape shape = sheet();
  const Mesh rest = make_mesh<Mesh>(shape);
  Mesh mesh = rest;
  CGAL::ARAP_deformation<Mesh> d(mesh);
  CHECK(d.deform()); // not even a region
  CHECK(same_or_bad_points(mesh, rest));
  d.insert_control_vertices(mesh.vertices().begin(), mesh.vertices().end());
  d.translate(mesh.vertices().begin(), mesh.vertices().end(), Kernel::Vector_3(1, 0, 0));
  CGAL::ARAP::Options options;
  for(auto guess : {CGAL::ARAP::Initial_guess::previous, CGAL::ARAP::Initial_guess::laplacian})
  {
    options.initial_guess = guess;
    d.set_options(options);
    const auto report = d.deform();
    CHECK(report.status == Status::converged);
    CHECK(report.energy == std::vector<double>{0});
    for(Vertex v : mesh.vertices())
      CHECK(mesh.point(v) == rest.point(v) + Kernel::Vector_3(1, 0, 0));
  }
}

// weights under which the matrix is not positive definite, or not finite
struct Bad_weight : CGAL::ARAP::Uniform_weight
{
  double value;
  explicit Bad_weight(double v = -1) : value(v) {}
  double edge_weight(CGAL::ARAP::Edge_set, std::size_t i, std::size_t j, double) const
  {
    return std::isnan(value) && (i + j) % 3 != 0 ? 1 : value; // they are sorted with numbers
  }
};

void test_matrices()
{
  using Traits = CGAL::ARAP_deformation_traits_3<CGAL::Default, Bad_weight>;
  const Shape shape = sheet();
  const Scenario s = scenario(shape);
  const Mesh rest = make_mesh<Mesh>(shape);
  const auto try_weight = [&](double value, Status status, const std::string& culprit) {
    Mesh mesh = rest;
    CGAL::ARAP_deformation<Mesh, Traits> d(mesh, Traits({}, Bad_weight(value)));
    prepare(d, s, all_vertices(mesh));
    check_refused(d.deform(), status, culprit);
    check_refused(d.preprocess(), status, culprit);
    CHECK(same_or_bad_points(mesh, rest));
  };
  test_case() = "singular and non-finite matrices";
  try_weight(-1, Status::singular_matrix, "vertex ");
  try_weight(not_a_number, Status::singular_matrix, "vertex ");
  try_weight(infinity, Status::singular_matrix, "vertex ");
}

// a solver that fails where it is told to
struct Failing_solver : CGAL::ARAP::Multifrontal_cholesky_solver
{
  static int solves_left;
  static bool can_factorize;

  bool factorize(const CGAL::ARAP::Sparse_matrix& a)
  {
    return can_factorize && CGAL::ARAP::Multifrontal_cholesky_solver::factorize(a);
  }

  bool solve(std::size_t n, CGAL::ARAP::Coordinates* x)
  {
    return solves_left-- > 0 && CGAL::ARAP::Multifrontal_cholesky_solver::solve(n, x);
  }
};
int Failing_solver::solves_left = 0;
bool Failing_solver::can_factorize = true;

void test_solver()
{
  using Traits = CGAL::ARAP_deformation_traits_3<Failing_solver>;
  const Shape shape = sheet();
  for(auto guess : {CGAL::ARAP::Initial_guess::previous, CGAL::ARAP::Initial_guess::laplacian})
  {
    test_case() = "a solver that fails";
    Mesh mesh = make_mesh<Mesh>(shape);
    CGAL::ARAP_deformation<Mesh, Traits> d(mesh);
    CGAL::ARAP::Options options;
    options.initial_guess = guess;
    d.set_options(options);
    prepare(d, scenario(shape), all_vertices(mesh));
    Failing_solver::can_factorize = false;
    check_failure(mesh, d, Status::singular_matrix, "factorized",
                  [] { Failing_solver::can_factorize = true; Failing_solver::solves_left = 99; });
    for(int left : {0, 1, 2, 3})
    {
      Failing_solver::solves_left = left;
      check_failure(mesh, d, Status::solver_failed, "the solver failed",
                    [] { Failing_solver::solves_left = 99; });
    }
  }
}

// A solver whose solutions are too large, so that the energy rises, is found out before anything is
// written.
struct Overshooting_solver : CGAL::ARAP::Multifrontal_cholesky_solver
{
  static double factor;

  bool solve(std::size_t n, CGAL::ARAP::Coordinates* x)
  {
    const bool is_solved = CGAL::ARAP::Multifrontal_cholesky_solver::solve(n, x);
    for(std::size_t v = 0; v < n; ++v)
      for(double& coordinate : x[v])
        coordinate *= factor;
    return is_solved;
  }
};
double Overshooting_solver::factor = 1;

void test_rising_energy()
{
  using Traits = CGAL::ARAP_deformation_traits_3<Overshooting_solver>;
  for(auto minimizer : {CGAL::ARAP::Minimizer::local_global, CGAL::ARAP::Minimizer::quasi_newton})
  {
    test_case() = "a solver that makes the energy rise";
    Mesh mesh = make_mesh<Mesh>(sheet());
    CGAL::ARAP_deformation<Mesh, Traits> d(mesh);
    CGAL::ARAP::Options options;
    options.minimizer = minimizer;
    d.set_options(options);
    prepare(d, scenario(sheet()), all_vertices(mesh));
    Overshooting_solver::factor = 10;
    check_failure(mesh, d, Status::solver_failed, "the solver failed",
                  [] { Overshooting_solver::factor = 1; });
  }
}

int main()
{
  test_points();
  test_overflow();
  test_faces();
  test_nothing_fixed();
  test_nothing_free();
  test_matrices();
  test_solver();
  test_rising_energy();
  return checks_result();
}
