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

// What a new user does first, and meets first: runs whose minimum is zero, short ways in, undo,
// points that others move, weights that change, and messages on what did not move.

#include "include/check.h"
#include "include/dense_algebra.h"
#include "include/domains.h"
#include "include/length.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Edge_map_weight.h>
#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Parts.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Rigid_start.h>
#include <CGAL/Aff_transformation_3.h>
#include <CGAL/arap_deform.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using CGAL::ARAP::Cell_scheme;
using CGAL::ARAP::Initial_guess;
using CGAL::ARAP::Minimizer;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;
using CGAL::ARAP::Status;
using Vertex = Mesh::Vertex_index;
using Deformation = CGAL::ARAP_deformation<Mesh>;
using Indices = std::vector<std::size_t>;

constexpr double infinity = std::numeric_limits<double>::infinity();

// a sheet with ripples; vertex i * (n + 1) + j is in row i
Shape sheet(int n)
{
  return grid("sheet of " + std::to_string(n), n, n, [](double u, double v) {
    return Eigen::Vector3d(u, v, 0.05 * std::sin(7 * u) * std::cos(5 * v));
  });
}

bool says(const CGAL::ARAP::Outcome& outcome, const std::string& part)
{
  if(outcome.message.find(part) != std::string::npos)
    return true;
  std::cerr << "    the message was: " << outcome.message << std::endl;
  return false;
}

// Runs whose minimum is zero.
namespace rigid {

const Affine_map identity{};

// A shape at rest is left alone, to the last bit; a handle that goes far away and comes back, or a
// deformed shape that returns, ends at rest.
void test_returns()
{
  for(double distance : {0.3, 1e3, 1e12})
  {
    test_case() = "a handle that goes by " + std::to_string(distance) + " and returns";
    Mesh mesh = make_mesh<Mesh>(sheet(20));
    const Mesh rest = mesh;
    Deformation d(mesh);
    d.insert_roi_vertices(vertices(mesh));
    for(int j = 0; j <= 20; ++j)
    {
      d.insert_control_vertex(Vertex(j));
      d.insert_control_vertex(Vertex(20 * 21 + j));
    }
    CHECK(d.deform().iterations == 0);
    CHECK(same_points(mesh, rest));
    const Vertex handle(20 * 21);
    CHECK(d.translate(handle, Eigen::Vector3d(0, 0, distance)));
    const Report away = d.deform();
    CHECK(away.status == Status::converged);
    CHECK(d.set_target_position(handle, rest.point(handle)));
    const Report back = d.deform();
    CHECK(back.status == Status::converged);
    CHECK_AT_MOST(largest_distance(points_of(mesh), points_of(rest)), 1e-4);
    CHECK(CGAL::ARAP::first_rise_of_energy(away) == 0);
    CHECK(CGAL::ARAP::first_rise_of_energy(back) == 0);
  }
}

// A session on a range of points and simplices.
template <typename Domain, typename Simplices>
struct Soup_session
{
  std::vector<Eigen::Vector3d> rest;
  std::vector<Point> points;
  Simplices simplices;
  CGAL::ARAP_deformation<Domain> deformation;
  Indices handles;

  Soup_session(const std::vector<Eigen::Vector3d>& rest_shape, const Simplices& all,
               const Indices& handles_, double weight, Minimizer minimizer,
               Initial_guess guess = Initial_guess::previous)
    : rest(rest_shape), points(points_of(rest)), simplices(all),
      deformation(Domain(points, simplices)), handles(handles_)
  {
    Options options;
    options.minimizer = minimizer;
    options.initial_guess = guess;
    CHECK(deformation.set_options(options));
    deformation.insert_roi_vertices(numbers(points.size()));
    for(std::size_t v : handles)
    {
      deformation.insert_control_vertex(v);
      CHECK(deformation.set_target_weight(v, weight));
    }
  }

  // motion(v) is that of the handle v
  template <typename Motion>
  Report run(const Motion& motion, unsigned int iterations = 1000)
  {
    for(std::size_t v : handles)
      CHECK(deformation.set_target_position(v, point(motion(v) * rest[v])));
    const Report report = deformation.deform(iterations, 1e-3);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    return report;
  }

  // a run whose minimum is zero, after which all points are those of motion(v)
  template <typename Motion>
  void check_run_to_rest(const Motion& motion, double tolerance = 1e-6)
  {
    const Report report = run(motion);
    CHECK(report.status == Status::converged);
    CHECK_AT_MOST(report.iterations, 30);
    CHECK_AT_MOST(report.final_energy(), 1e-15 * report.energy_scale);
    if(handles.size() < 3) // the rotation is not determined
      return;
    double error = 0;
    for(std::size_t v = 0; v < points.size(); ++v)
      error = larger(error, (vector(points[v]) - motion(v) * rest[v]).norm());
    CHECK_AT_MOST(error, tolerance);
  }
};

using Triangles = std::vector<std::array<std::size_t, 3>>;
using Tetrahedra = std::vector<std::array<std::size_t, 4>>;
using Surface =
  Soup_session<CGAL::ARAP::Polygon_soup_domain<std::vector<Point>, Triangles>, Triangles>;
using Volume =
  Soup_session<CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>, Tetrahedra>, Tetrahedra>;

// calls f(weight, minimizer) for hard and soft targets and both minimizers
template <typename Function>
void for_each_kind(const Function& f, const std::vector<double>& weights = {infinity, 1.0})
{
  for(double weight : weights)
    for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
      f(weight, minimizer);
}

// A thin triangle, whose weights are large, makes no difference, though solutions are less exact.
void test_thin_triangle()
{
  for(double height : {1e-5, 1e-6, 3e-7, 1e-7})
    for(int turn = 1; turn <= 5; ++turn)
    {
      test_case() = "a triangle of height " + std::to_string(height) + ", turn " +
                    std::to_string(turn);
      Shape shape = grid("sheet", 30, 30, [](double u, double v) {
        return Eigen::Vector3d(30 * u, 29 * v, 0.3 * std::sin(15 * u));
      });
      const Eigen::Vector3d a = shape.points[15 * 31], b = shape.points[16 * 31];
      shape.triangles.push_back({15 * 31, shape.points.size(), 16 * 31});
      shape.points.push_back((a + b) / 2 - Eigen::Vector3d(0, height, 0));
      Indices handles;
      for(std::size_t j = 0; j <= 30; ++j)
        for(std::size_t v : {j, 30 * 31 + j})
          handles.push_back(v);
      Surface session(shape.points, shape.triangles, handles, infinity,
                      CGAL::ARAP::Minimizer::automatic);
      const Affine_map motion = rigid_motion(0.2 * turn, {turn - 3.0, 1, 2}, {1, 0, 0});
      session.check_run_to_rest([&](std::size_t) { return motion; });
    }
}

// Handles move rigidly, one motion after the other, and nothing else is fixed.
void test_motions()
{
  const auto go = [](auto& session, double weight) {
    Affine_map motion = identity;
    for(const auto& step : {rigid_motion(0, {0, 0, 1}, {0.3, -2, 5}),
                            rigid_motion(1.1, {1, 2, 3}, {0, 0.1, 0}),
                            rigid_motion(3.1, {1, 0, 3}, {40, 0, 0})})
    {
      test_case() = std::to_string(session.handles.size()) + " of " +
                    std::to_string(session.points.size()) + " vertices, weight " +
                    std::to_string(weight);
      motion = step * motion;
      session.check_run_to_rest([&](std::size_t) { return motion; }, 1e-9);
    }
  };
  for_each_kind([&](double weight, Minimizer minimizer) {
    for(int n : is_long_run() ? std::vector<int>{20, 60, 200, 400} : std::vector<int>{20, 60})
    {
      const Shape shape = sheet(n);
      const std::size_t last = shape.points.size() - 1;
      for(const Indices& handles : {Indices{0}, Indices{0, last / 2 + 3, last, std::size_t(n)}})
      {
        Surface s(shape.points, shape.triangles, handles, weight, minimizer);
        go(s, weight);
      }
    }
    const Block shape = block(is_long_run() ? 20 : 6, 5, 4);
    for(const Indices& handles : {Indices{0}, Indices{0, 1, 50, shape.points.size() - 1}})
    {
      Volume s(shape.points, shape.tetrahedra, handles, weight, minimizer);
      go(s, weight);
    }
  }, {infinity, 1.0, 1e-3});
}

// Two sheets in one mesh, each with a motion of its own; then one of them is deformed, and the
// other one still moves at once.
void test_parts()
{
  for_each_kind([](double weight, Minimizer minimizer) {
    test_case() = "two sheets, weight " + std::to_string(weight);
    const Shape both = two_components(sheet(20));
    const std::size_t n = both.points.size() / 2;
    Surface s(both.points, both.triangles, {0, 20, 70, n - 1, n, n + 20, n + 70, 2 * n - 1}, weight,
              minimizer);
    const Affine_map left = rigid_motion(2, {1, 0.3, 0}, {0.2, 0, 1});
    const Affine_map right = rigid_motion(-1.3, {0, 1, 2}, {0, -3, 0});
    s.check_run_to_rest([&](std::size_t v) { return v < n ? left : right; });
    s.check_run_to_rest([&](std::size_t v) { return v < n ? right : left; });
    s.run([&](std::size_t v) {
      return v >= n ? right : v == 0 ? rigid_motion(0, {0, 0, 1}, {0, 0, 0.2}) : identity;
    }, 0);
    double error = 0;
    for(std::size_t v = n; v < 2 * n; ++v)
      error = larger(error, (vector(s.points[v]) - right * s.rest[v]).norm());
    CHECK_AT_MOST(error, 1e-9);
    s.check_run_to_rest([&](std::size_t v) { return v < n ? identity : right; });
  });
}

// A triangle whose corners are all fixed, and two parts, each at another corner. It is turned, so
// that the part between it and another fixed vertex is not at rest, and stays as the run leaves it.
void test_fixed_simplex()
{
  test_case() = "a fixed simplex with two parts at it";
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.8, 0}, {3, 0, 0},
                                               {2, -1, 0}, {2, 1, 0}, {-1, -1, 0}, {-1, 1, 0}};
  Surface s(points, {{0, 1, 2}, {1, 4, 5}, {3, 5, 4}, {0, 7, 6}}, {0, 1, 2, 3},
            infinity, Minimizer::quasi_newton);
  const Affine_map turn = rigid_motion(1, {1, 2, 0}, {0.2, 0, 0.3});
  const auto motion = [&](std::size_t v) { return v == 0 || v == 2 ? turn : identity; };
  const Report first = s.run(motion), second = s.run(motion);
  CHECK(first.final_energy() > 1e-3 * first.energy_scale);
  CHECK_AT_MOST(second.energy[0], (1 + 1e-9) * first.final_energy());
}

// From a deformed state back to rest, or to where a rigid motion takes it.
void test_deformed()
{
  const auto go = [](auto& session, const std::string& name) {
    const auto deform = [&] {
      test_case() = name;
      const Report report = session.run([&](std::size_t v) {
        return v % 2 == 0 ? identity
                          : rigid_motion(0.6, {0, 1, double(v % 3)}, {-0.2, 0.1, 0.3});
      }, 60);
      CHECK(report.final_energy() > 1e-6 * report.energy_scale);
    };
    for(const Affine_map& motion :
        {identity, rigid_motion(3, {1, 2, 0}, {5, 0, -1}), rigid_motion(0, {1, 0, 0}, {0, 0, 1})})
    {
      deform();
      session.check_run_to_rest([&](std::size_t) { return motion; });
    }
  };
  for_each_kind([&](double weight, Minimizer minimizer) {
    for(int n : is_long_run() ? std::vector<int>{20, 60, 200} : std::vector<int>{20, 60})
    {
      const Shape shape = sheet(n);
      const std::size_t m = n + 1, last = m * m - 1;
      Surface s(shape.points, shape.triangles,
                {0, m - 1, last - n + 1, last, m * m / 2 + 1}, weight, minimizer);
      go(s, "deformed " + shape.name + ", weight " + std::to_string(weight));
    }
    const Block shape = block(8, 5, 4);
    Volume s(shape.points, shape.tetrahedra, {0, 5, 101, shape.points.size() - 2}, weight,
             minimizer);
    go(s, "deformed block, weight " + std::to_string(weight));
  });
}

// A bar whose ends are turned against each other by a full turn is at a minimum, and stays there;
// one that was turned by less returns.
void test_twist()
{
  const double pi = std::acos(-1.0);
  const Block shape = block(20, 4, 4);
  const Eigen::AlignedBox3d box = bounding_box(shape.points);
  Indices ends;
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    if(shape.points[v].x() == box.min().x() || shape.points[v].x() == box.max().x())
      ends.push_back(v);
  for_each_kind([&](double weight, Minimizer minimizer) {
    test_case() = "twist, weight " + std::to_string(weight);
    Volume s(shape.points, shape.tetrahedra, ends, weight, minimizer);
    const auto turned_by = [&](double angle) {
      const Affine_map turn = motion_about(box.center(), rigid_motion(angle, {1, 0, 0}, {0, 0, 0}));
      return [&, turn](std::size_t v) {
        return s.rest[v].x() == box.min().x() ? identity : turn;
      };
    };
    for(int frame = 1; frame <= 5; ++frame)
      s.run(turned_by(frame * pi / 6), 60);
    s.check_run_to_rest(turned_by(0));

    double before = 0;
    for(int frame = 1; frame <= 11; ++frame)
      before = s.run(turned_by(frame * pi / 6), 60).final_energy();
    const Report report = s.run(turned_by(2 * pi), 60);
    CHECK(report.final_energy() > before);
    double distance = 0;
    for(std::size_t v = 0; v < s.rest.size(); ++v)
      distance = larger(distance, (vector(s.points[v]) - s.rest[v]).norm());
    CHECK(distance > 0.5 * box.sizes().y());
    // where nothing is rigid a run ends at the same minimum
    const Report next = s.run(turned_by(2 * pi - 1e-4), 60);
    CHECK_AT_MOST(std::abs(next.final_energy() / report.final_energy() - 1), 1e-2);
  });
}

// A bar whose middle was turned over holds a twist between two ends, but not between an end and a
// single control point, in however many vertices that is: then the bar is placed.
void test_control_point_and_handle()
{
  const Block shape = block(20, 4, 4);
  const Eigen::AlignedBox3d box = bounding_box(shape.points);
  const Affine_map turn =
    motion_about(box.center(), rigid_motion(std::acos(-1.0), {1, 0, 0}, {0, 0, 0}));
  const auto x = [&](std::size_t v) { return shape.points[v].x() - box.min().x(); };
  const double length = box.sizes().x();
  for(const bool is_point : {false, true})
  {
    test_case() = is_point ? "handle and control point" : "two handles";
    std::vector<Point> points = points_of(shape.points);
    using Domain = CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>,
                                                       std::vector<std::array<std::size_t, 4>>>;
    CGAL::ARAP_deformation d(Domain(points, shape.tetrahedra));
    for(std::size_t v = 0; v < points.size(); ++v)
    {
      d.insert_roi_vertex(v);
      if(x(v) == 0 || (!is_point && x(v) == length))
        d.insert_control_vertex(v);
    }
    for(std::size_t s = 0; is_point && s < shape.tetrahedra.size(); ++s)
      if(const auto& t = shape.tetrahedra[s];
         std::all_of(t.begin(), t.end(), [&](std::size_t v) { return x(v) > 0.9 * length; }))
      {
        CHECK(d.insert_control_point(s, {0.25, 0.25, 0.25, 0.25}));
        break;
      }
    for(std::size_t v = 0; v < points.size(); ++v)
      if(x(v) > 0.3 * length && x(v) < 0.7 * length)
        points[v] = point(turn * shape.points[v]);
    const Report report = d.deform(200, 1e-3);
    CHECK(report && (report.iterations == 0) == is_point);
  }
}

// The guess of naive Laplacian editing knows no rotations; where constraints move rigidly it is not
// asked for.
void test_laplacian()
{
  for_each_kind([](double weight, Minimizer minimizer) {
    test_case() = "Laplacian guess, weight " + std::to_string(weight);
    const Shape both = two_components(sheet(20));
    const std::size_t n = both.points.size() / 2;
    Surface s(both.points, both.triangles, {0, 20, 70, n - 1, n, n + 20, n + 70, 2 * n - 1}, weight,
              minimizer, Initial_guess::laplacian);
    const Affine_map left = rigid_motion(2, {1, 0.3, 0}, {0.2, 0, 1});
    const Affine_map right = rigid_motion(-1.3, {0, 1, 2}, {0, -3, 0});
    s.check_run_to_rest([&](std::size_t v) { return v < n ? left : right; });
    s.run([&](std::size_t v) {
      return v < n ? left : rigid_motion(double(v), {0, 1, 2}, {0, 0, 0});
    }, 0);
    double error = 0;
    for(std::size_t v = 0; v < n; ++v)
      error = larger(error, (vector(s.points[v]) - left * s.rest[v]).norm());
    CHECK_AT_MOST(error, 1e-9);
    s.check_run_to_rest([&](std::size_t) { return identity; });
  });
}

// Where cells are larger, placing a part rigidly is compared with leaving it. Another part keeps
// its guess, whose energy is above that of the shape before.
void test_laplacian_beside_others()
{
  test_case() = "Laplacian guess beside a part that is placed";
  const Shape alone = sheet(10), both = two_components(alone);
  const std::size_t n = alone.points.size();
  const Scenario s = scenario(alone);
  const auto run = [&](const Shape& shape, Mesh& mesh) { // returns the points before the guess
    Deformation d(mesh);
    Options options = options_for(Cell_scheme::k_ring(1));
    CHECK(d.set_options(options));
    d.insert_roi_vertices(vertices(mesh));
    for(std::size_t v = 0; v < n; ++v)
      if(s.selection[v] != 1)
        d.insert_control_vertex(Vertex(v), point(s.targets[v]));
    if(&shape == &both)
    {
      d.insert_control_vertex(Vertex(n));
      CHECK(d.translate(Vertex(n), Kernel::Vector_3(0, 0, 1)));
    }
    CHECK(d.deform());
    const std::vector<Point> before = points_of(mesh);
    options.initial_guess = Initial_guess::laplacian;
    CHECK(d.set_options(options) && d.deform(0, 0));
    return before;
  };
  Mesh mesh = make_mesh<Mesh>(alone), mesh_of_both = make_mesh<Mesh>(both);
  const std::vector<Point> before = run(alone, mesh);
  run(both, mesh_of_both);
  double moved = 0;
  for(std::size_t v = 0; v < n; ++v)
  {
    const Eigen::Vector3d guess = vector(mesh.point(Vertex(v)));
    CHECK_AT_MOST((vector(mesh_of_both.point(Vertex(v))) - guess).norm(), 1e-6);
    moved = larger(moved, (vector(before[v]) - guess).norm());
  }
  CHECK(moved > 0.01);
  const std::size_t last = both.points.size() - 1;
  CHECK_AT_MOST((vector(mesh_of_both.point(Vertex(last))) - both.points[last] -
                 Eigen::Vector3d(0, 0, 1)).norm(), 1e-9);
}

// Two parts that turn rigidly, but not together, though two of their cells share a rotation: the
// rigid motions are compared with the guess, not with where the vertices were before.
void test_laplacian_after_a_run()
{
  test_case() = "Laplacian guess after a run";
  const Shape shape = two_components(sheet(10));
  const std::size_t n = shape.points.size() / 2;
  const Scenario s = scenario(sheet(10));
  Mesh mesh = make_mesh<Mesh>(shape);
  Deformation d(mesh);
  Options options = options_for(Cell_scheme::spokes());
  options.initial_guess = Initial_guess::laplacian;
  CHECK(d.set_options(options));
  d.insert_roi_vertices(vertices(mesh));
  for(std::size_t v = 0; v < 2 * n; ++v)
    if(s.selection[v % n] != 1)
      d.insert_control_vertex(Vertex(v), point(
        Eigen::AngleAxisd(v < n ? 1 : -1, Eigen::Vector3d::UnitZ()) * shape.points[v]));
  const auto is_free = std::find(s.selection.begin(), s.selection.end(), 1);
  const auto shared = static_cast<std::size_t>(is_free - s.selection.begin()) + 25;
  CHECK(d.set_groups([=](Vertex v) { return std::size_t(v) % n == shared ? 0 : -1; }));
  const Report first = d.deform(20, 0), second = d.deform(20, 0);
  CHECK(first && second && first.final_energy() < 0.99 * first.energy[0]);
  CHECK_AT_MOST(std::abs(second.energy[0] - first.energy[0]), 1e-9 * first.energy[0]);
}

// Over a bending length of many edges conjugate gradients do not find the Laplacian guess: the run
// starts from where the vertices are, and tells so.
void test_laplacian_with_bending()
{
  test_case() = "Laplacian guess with bending";
  const Shape shape = sheet(40);
  const Scenario s = scenario(shape);
  for(const double length : {0.0, 0.2 * shape.diameter()})
  {
    Options options = options_for(Cell_scheme::spokes());
    options.bending_length = length;
    const auto start = [&](Initial_guess guess, Mesh& mesh) {
      Deformation d(mesh);
      options.initial_guess = guess;
      CHECK(d.set_options(options));
      d.insert_roi_vertices(vertices(mesh));
      for(std::size_t v = 0; v < shape.points.size(); ++v)
        if(s.selection[v] != 1)
          d.insert_control_vertex(Vertex(v), point(s.targets[v]));
      return d.deform(0, 0);
    };
    Mesh guessed = make_mesh<Mesh>(shape), moved = guessed;
    const Report laplacian = start(Initial_guess::laplacian, guessed);
    const Report previous = start(Initial_guess::previous, moved);
    CHECK(previous.initial_guess == Initial_guess::previous);
    const bool is_previous = laplacian.initial_guess == Initial_guess::previous;
    CHECK(is_previous == (points_of(guessed) == points_of(moved)));
    CHECK(is_previous == (length > 0));
    CHECK(is_previous || laplacian.initial_guess == Initial_guess::laplacian);
    CHECK(is_previous == (laplacian.message.find("no Laplacian") != std::string::npos));
  }
}

// Handles that turn a sheet rigidly, to where it is already, beside a frame that turns a cell the
// other way: no guess over a long bending length does better, found or not, than to stay.
void test_laplacian_that_is_not_taken()
{
  test_case() = "Laplacian guess that is not taken";
  const Shape shape = grid("sheet", 39, 29, [](double u, double v) {
    return Eigen::Vector3d(39 * u, 29 * v, 0);
  });
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  Mesh mesh = make_mesh<Mesh>(shape);
  Deformation d(mesh);
  Options options = options_for(Cell_scheme::spokes_and_rims());
  options.bending_length = 30;
  CHECK(d.set_options(options));
  d.insert_roi_vertices(vertices(mesh));
  Vertex middle;
  for(Vertex v : vertices(mesh))
  {
    const Eigen::Vector3d& p = shape.points[v];
    if(p.x() < 0.5 || p.x() > 38.5)
      d.insert_control_vertex(v, point(turn * p));
    else if(std::abs(p.x() - 20) < 0.5 && std::abs(p.y() - 15) < 0.5)
      middle = v;
    mesh.point(v) = point(turn * p);
  }
  d.insert_control_vertex(middle);
  CHECK(d.set_target_weight(middle, 0));
  CHECK(d.set_target_rotation(
    middle, Eigen::Matrix3d(Eigen::AngleAxisd(0.9, Eigen::Vector3d::UnitY()) * turn)));
  CHECK(d.deform(1000, 1e-4));
  const std::vector<Point> before = points_of(mesh);
  options.initial_guess = Initial_guess::laplacian;
  CHECK(d.set_options(options));
  const Report report = d.deform(0, 1e-4);
  CHECK(points_of(mesh) == before);
  CHECK(report && report.initial_guess == Initial_guess::previous);
  CHECK(says(report, "no Laplacian"));
}

// Handles on a straight line, up to rounding, leave a rotation about it free: there is none.
void test_line()
{
  for_each_kind([](double weight, Minimizer minimizer) {
    test_case() = "handles on a line, weight " + std::to_string(weight);
    Shape shape = sheet(20);
    for(auto& p : shape.points) // rounded to float somewhere else, and so no longer on a line
      p = (rigid_motion(1, {3, 1, 2}, {70, -30, 11}) * p).cast<float>().cast<double>();
    Indices line;
    for(std::size_t j = 0; j <= 20; ++j)
      line.push_back(j);
    Surface s(shape.points, shape.triangles, line, weight, minimizer);
    s.check_run_to_rest([&](std::size_t) { return rigid_motion(0, {1, 0, 0}, {0.3, 1, -7}); });
  });
}

// Rows of several vertices are compared as the points that they are; others than points are not.
void test_rows()
{
  using namespace CGAL::ARAP::internal;
  test_case() = "rows of several vertices";
  Region region;
  region.number_of_movable_vertices = region.number_of_centers = 4;
  region.number_of_movable_simplices = 2;
  region.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5}};
  region.first_corner = {0, 3, 6};
  region.corners = {0, 1, 2, 1, 3, 2};
  const Affine_map motion = rigid_motion(1.2, {1, 2, 3}, {0, 4, 0});
  for(double sum : {1.0, 0.0, 2.0})
  {
    Constraints constraints;
    constraints.is_fixed = Array<char>(4, false);
    CGAL::ARAP::internal::Targets targets;
    for(const auto& coefficients : {Array<double>{0.25, 0.25, sum - 0.5},
                                    Array<double>{0.75, 0, sum - 0.75},
                                    Array<double>{0, 0.5, sum - 0.5}})
    {
      constraints.rows.append({0, 1, 3}, coefficients, 1);
      Eigen::Vector3d target(0, 0, 0);
      for(std::size_t k = 0; k < 3; ++k)
      {
        const auto& p = region.rest[k == 2 ? 3 : k];
        target += coefficients[k] * (motion * Eigen::Vector3d(p[0], p[1], p[2]));
      }
      targets.soft.push_back({target.x(), target.y(), target.z()});
    }
    Array<CGAL::ARAP::Coordinates> x = region.rest;
    const Parts parts(region, constraints, Array<int>(4, 0));
    const Array<char> is_placed =
      Rigid_start(region, 2.25, parts, constraints, targets)(false, x);
    CHECK(is_placed == Array<char>(4, sum == 1));
    for(std::size_t v = 0; v < 4 && sum == 1; ++v)
    {
      const auto& p = region.rest[v];
      const Eigen::Vector3d expected = motion * Eigen::Vector3d(p[0], p[1], p[2]);
      CHECK_AT_MOST((Eigen::Vector3d(x[v][0], x[v][1], x[v][2]) - expected).norm(), 1e-12);
    }
    CHECK(sum == 1 || x == region.rest);
  }
}

} // namespace rigid

// Undo and redo, and points that others move.
namespace undo {

// A session, a frame of it, and what the frame led to.
struct Session
{
  Mesh mesh = make_mesh<Mesh>(sheet(12));
  Deformation d{mesh};

  Session()
  {
    for(Vertex v : mesh.vertices())
      if(v >= Vertex(13))
        d.insert_roi_vertex(v);
    d.insert_control_vertex(Vertex(168), Point(1, 1, 0.5));
  }
};

// two branches of a history, with a vertex each that the other does not know
void test_branches()
{
  test_case() = "branches of a history";
  Mesh mesh = make_mesh<Mesh>(sheet(12));
  Deformation d(mesh);
  for(Vertex v : mesh.vertices())
    if(v < Vertex(60))
      d.insert_roi_vertex(v);
  d.insert_control_vertex(Vertex(0));
  const auto start = d.state();
  d.insert_control_vertex(Vertex(100), Point(0, 0, 0.7));
  CHECK(d.set_target_weight(Vertex(100), 1));
  CHECK(d.deform(3, 0));
  const Mesh first = mesh;
  const auto first_state = d.state();
  CHECK(d.restore(start));
  d.insert_control_vertex(Vertex(120), Point(0, 0, 0.7));
  CHECK(d.deform(3, 0));
  CHECK(d.restore(first_state));
  CHECK(same_points(mesh, first));
  CHECK(d.is_control_vertex(Vertex(100)) && !d.is_control_vertex(Vertex(120)));
  CHECK(!d.is_roi_vertex(Vertex(120)));
  CHECK(d.deform(3, 0));
}

void test_state()
{
  Session s;
  CHECK(s.d.deform(4, 0));
  const Mesh before = s.mesh;
  const auto state = s.d.state();
  const Report next = s.d.deform(3, 0);
  const Mesh after = s.mesh;
  const auto later = s.d.state();

  const auto go_back = [&](const char* name) {
    test_case() = name;
    CHECK(s.d.restore(state));
    CHECK(same_points(s.mesh, before));
    CHECK(s.d.control_vertices().size() == 1 && s.d.roi_vertices().size() == 156);
    const Report again = s.d.deform(3, 0);
    CHECK_AT_MOST(largest_distance(points_of(s.mesh), points_of(after)), 1e-12);
    CHECK_AT_MOST(std::abs(again.final_energy() - next.final_energy()), 1e-12 * next.energy_scale);
    return again;
  };
  CHECK(!go_back("undo of a run").stages.factor);

  CHECK(s.d.translate(Vertex(168), Eigen::Vector3d(0, 0, 1)));
  s.d.insert_control_vertex(Vertex(100), Point(3, 0, 0));
  CHECK(s.d.deform(5, 0));
  const Report handles = go_back("undo of handles");
  CHECK(!handles.stages.region && !handles.stages.order);

  s.d.insert_roi_vertices(vertices(s.mesh)); // one more row, which the state does not know
  s.d.insert_control_vertex(Vertex(0), Point(0, 0, -1));
  CHECK(s.d.deform(5, 0));
  s.d.overwrite_initial_geometry();
  CHECK(s.d.translate(Vertex(0), Eigen::Vector3d(0, 0, -1)));
  CHECK(s.d.deform(5, 0));
  go_back("undo of a region and of a rest shape");
  CHECK(!s.d.is_roi_vertex(Vertex(0)));

  test_case() = "redo";
  CHECK(s.d.restore(state));
  CHECK(s.d.restore(later));
  CHECK(same_points(s.mesh, after));
  s.d.reset();
  CHECK(s.d.restore(later));
  CHECK(same_points(s.mesh, after));

  test_case() = "undo of a change that cannot be prepared";
  s.d.clear_roi_vertices();
  s.d.insert_roi_vertices(vertices(s.mesh));
  s.d.clear_control_vertices();
  CHECK(s.d.deform().status == Status::no_fixed_vertex);
  CHECK(s.d.restore(later));
  CHECK(s.d.deform(2, 0));
  const auto sound = s.d.state();
  s.d.clear_control_vertices();
  s.d.insert_roi_vertices(vertices(s.mesh));
  CHECK(!s.d.deform());
  CHECK(s.d.restore(sound));
  CHECK(s.d.deform(2, 0));

  test_case() = "a state of another mesh";
  Mesh other = make_mesh<Mesh>(sheet(5));
  Deformation d(other);
  d.insert_roi_vertex(Vertex(7));
  Mesh twin = make_mesh<Mesh>(sheet(12));
  Deformation of_twin(twin);
  CHECK(of_twin.restore(later).status == Status::foreign_state);
  const Mesh untouched = other;
  CHECK(d.restore(later).status == Status::foreign_state);
  CHECK(same_points(other, untouched) && d.roi_vertices().size() == 1);
}

// A modeler who writes old points back goes on from there.
void test_points_of_others()
{
  test_case() = "points of others";
  Session s;
  CHECK(s.d.deform(4, 0));
  const Mesh before = s.mesh;
  CHECK(s.d.translate(Vertex(168), Eigen::Vector3d(0, 0, 2)));
  CHECK(s.d.deform(20, 0));
  for(Vertex v : s.mesh.vertices())
    s.mesh.point(v) = before.point(v);
  CHECK(s.d.set_target_position(Vertex(168), before.point(Vertex(168))));
  const Report nothing = s.d.deform(0, 0);
  CHECK(same_points(s.mesh, before));
  Session fresh;
  const Report first = fresh.d.deform(4, 0);
  CHECK_AT_MOST(std::abs(nothing.final_energy() - first.final_energy()),
                1e-10 * first.final_energy());

  // also what is fixed around the region of interest
  s.mesh.point(Vertex(3)) = Point(0, 0.25, -1);
  const Report pulled = s.d.deform(0, 0);
  CHECK(pulled.final_energy() > 2 * nothing.final_energy());
  CHECK(s.mesh.point(Vertex(3)) == Point(0, 0.25, -1));

  test_case() = "the rest shape of what others move around the region of interest";
  const Point old_rest = make_mesh<Mesh>(sheet(12)).point(Vertex(3));
  const auto collect_again = [&s] {
    s.d.erase_roi_vertex(Vertex(90));
    CHECK(s.d.insert_roi_vertex(Vertex(90)));
    const Report again = s.d.deform(0, 0);
    CHECK(again.stages.region);
    return again.final_energy();
  };
  const auto state = s.d.state();
  CHECK_AT_MOST(std::abs(collect_again() - pulled.final_energy()), 1e-12 * pulled.energy_scale);
  s.d.insert_roi_vertex(Vertex(3));
  CHECK(s.d.deform(2, 0));
  CHECK(s.d.restore(state));
  CHECK(s.mesh.point(Vertex(3)) == Point(0, 0.25, -1));
  s.d.overwrite_initial_geometry();
  s.mesh.point(Vertex(3)) = Point(0, 0.25, -3);
  CHECK(s.d.deform(0, 0).final_energy() > 0.1);
  s.mesh.point(Vertex(3)) = Point(0, 0.25, -1);
  CHECK_AT_MOST(collect_again(), 1e-20);
  CHECK(s.d.restore(state));
  CHECK_AT_MOST(std::abs(collect_again() - pulled.final_energy()), 1e-12 * pulled.energy_scale);
  s.d.insert_roi_vertex(Vertex(3));
  s.d.reset();
  CHECK(s.mesh.point(Vertex(3)) == old_rest);

  test_case() = "points of others that are no numbers";
  const Point sound = s.mesh.point(Vertex(50));
  s.mesh.point(Vertex(50)) = Point(0, std::nan(""), 0);
  const Report broken = s.d.deform(2, 0);
  CHECK(broken.status == Status::non_finite_point);
  CHECK(says(broken, "vertex 50"));
  s.mesh.point(Vertex(50)) = sound;
  CHECK(s.d.preprocess()); // reads it again, as a run does
  s.mesh.point(Vertex(50)) = Point(0, std::nan(""), 0);
  CHECK(s.d.preprocess().status == Status::non_finite_point);
  const auto broken_state = s.d.state();
  s.mesh.point(Vertex(50)) = sound;
  CHECK(s.d.restore(broken_state));
  CHECK(says(s.d.deform(2, 0), "vertex 50"));
  s.mesh.point(Vertex(50)) = sound;
  CHECK(s.d.deform(2, 0));

  // what left the region of interest matters only where the region has it
  for(int row = 1; row <= 4; ++row)
    for(int column = 0; column <= 4; ++column)
      s.d.erase_roi_vertex(Vertex(13 * row + column));
  CHECK(s.d.deform(2, 0));
  const Point corner = s.mesh.point(Vertex(13)), beside = s.mesh.point(Vertex(52));
  s.mesh.point(Vertex(13)) = Point(0, std::nan(""), 0);
  CHECK(s.d.deform(2, 0));
  s.mesh.point(Vertex(52)) = Point(0, std::nan(""), 0);
  CHECK(says(s.d.deform(2, 0), "vertex 52"));
  s.mesh.point(Vertex(52)) = beside;
  CHECK(s.d.deform(2, 0));

  // nothing of a refused run stays
  const Report sound_run = s.d.deform(0, 0);
  const Point free = s.mesh.point(Vertex(80));
  s.mesh.point(Vertex(80)) = Point(5, 5, 5);
  s.mesh.point(Vertex(52)) = Point(0, std::nan(""), 0);
  CHECK(says(s.d.deform(0, 0), "vertex 52"));
  s.mesh.point(Vertex(80)) = free;
  s.mesh.point(Vertex(52)) = beside;
  CHECK_AT_MOST(std::abs(s.d.deform(0, 0).final_energy() - sound_run.final_energy()),
                1e-12 * sound_run.energy_scale);
  s.mesh.point(Vertex(13)) = corner;
}

// The rest point of a vertex that was inserted broken is where it is when it is mended, whatever is
// called next.
void test_mended_points()
{
  test_case() = "mended points";
  const Vertex v(3);
  const Point broken(0, std::nan(""), 0);
  Session s, t;
  const Point sound = s.mesh.point(v);
  const auto before = s.d.state();
  s.mesh.point(v) = broken;
  s.d.insert_roi_vertex(v);
  CHECK(s.d.deform().status == Status::non_finite_point);
  s.mesh.point(v) = sound;
  const auto mended = s.d.state();
  CHECK(s.d.deform());
  CHECK(s.d.restore(mended));
  CHECK(s.d.deform());
  CHECK(s.d.restore(before));
  CHECK(s.mesh.point(v) == sound);
  const Vertex moved(80);
  CHECK(s.d.is_roi_vertex(moved) && s.d.deform());
  CHECK(s.mesh.point(moved) != s.d.rest_position(moved));
  const Point now = s.mesh.point(moved);
  s.d.overwrite_initial_geometry();
  CHECK(s.d.rest_position(moved) == now);

  t.mesh.point(v) = broken;
  t.d.insert_roi_vertex(v);
  t.mesh.point(v) = sound;
  t.d.reset();
  CHECK(t.mesh.point(v) == sound);
  CHECK(t.d.deform());

  // where results are written elsewhere
  Mesh input = make_mesh<Mesh>(sheet(12));
  auto output = input.add_property_map<Vertex, Point>("v:output").first;
  for(const bool is_run : {true, false})
  {
    input.point(v) = broken;
    CGAL::ARAP_deformation d(CGAL::ARAP::make_face_graph_domain(input, output));
    d.insert_roi_vertices(vertices(input));
    d.insert_control_vertex(Vertex(168), Point(1, 1, 0.5));
    CHECK(says(d.deform(), "vertex 3"));
    input.point(v) = sound;
    CHECK(!is_run || d.deform());
    output[v] = Point(0, 0, 0);
    d.reset();
    CHECK(output[v] == sound);
  }
  input.point(v) = broken;
  CGAL::ARAP_deformation late(CGAL::ARAP::make_face_graph_domain(input, output));
  late.insert_roi_vertices(vertices(input));
  input.point(v) = sound;
  CHECK(late.rest_position(v) == sound);
  late.insert_control_vertex(v);
  late.insert_control_vertex(Vertex(168), Point(1, 1, 0.5));
  CHECK(late.target_position(v) == sound);
  CHECK(late.deform() && output[v] == sound && late.rest_position(v) == sound);
}

// A hard control vertex that was inserted broken, where nothing that moves meets it, has a rest
// point from the run on that puts it at its target.
template <typename Domain, typename Points>
void test_mended_target(const Domain& domain, const Points& points, bool is_reset)
{
  const Vertex v(3);
  const Point target(0.1, 0.2, 0.3);
  CGAL::ARAP_deformation<Domain> d(domain);
  d.insert_roi_vertices(domain.vertices());
  for(Vertex u : domain.vertices())
    if(u < Vertex(117)) // all but four rows
      d.insert_control_vertex(u);
  CHECK(d.set_target_position(v, target));
  CHECK(d.deform());
  CHECK(points[v] == target && d.rest_position(v) == target);
  if(is_reset)
    d.reset();
  CHECK(points[v] == target && d.target_position(v) == target);
  d.clear_control_vertices();
  d.insert_control_vertex(v);
  CHECK(d.deform());
  CHECK(points[v] == target && d.rest_position(v) == target);
}

void test_mended_targets()
{
  test_case() = "mended targets";
  for(const bool is_reset : {false, true})
  {
    Mesh mesh = make_mesh<Mesh>(sheet(12));
    mesh.point(Vertex(3)) = Point(0, std::nan(""), 0);
    auto output = mesh.add_property_map<Vertex, Point>("v:output").first;
    test_mended_target(CGAL::ARAP::make_face_graph_domain(mesh, output), output, is_reset);
    test_mended_target(CGAL::ARAP::Face_graph_domain<Mesh>(mesh), mesh.points(), is_reset);
  }
}

// What is wrong where nothing can move any more is not asked for.
void test_refusals_elsewhere()
{
  Session s;
  CHECK(s.d.deform(2, 0));
  const auto fix_all_but_one = [&s] {
    for(Vertex v : s.d.roi_vertices())
      if(v != Vertex(160))
        s.d.insert_control_vertex(v);
  };
  const auto before = s.d.state();
  test_case() = "a stiffness elsewhere";
  s.d.set_stiffness([](Vertex v) { return v == Vertex(30) ? std::nan("") : 1; });
  CHECK(s.d.deform(2, 0).status == Status::invalid_stiffness);
  fix_all_but_one();
  CHECK(s.d.deform(2, 0));
  s.d.clear_stiffness();
  CHECK(s.d.restore(before));

  test_case() = "a point elsewhere";
  CHECK(s.d.deform(2, 0));
  s.mesh.point(Vertex(3)) = Point(0, std::nan(""), 0);
  CHECK(says(s.d.deform(2, 0), "vertex 3"));
  fix_all_but_one();
  CHECK(s.d.deform(2, 0));
}

} // namespace undo

// Weights of a user: they count from the next run on, and what is singular is refused.
namespace user_weights {

using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::ARAP::Edge_map_weight>;

void test_changes()
{
  for(const Cell_scheme cells : {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims()})
  {
    test_case() = "weights that change";
    const Shape shape = sheet(10);
    Mesh mesh = make_mesh<Mesh>(shape), other = mesh;
    CGAL::ARAP::Edge_map_weight weight;
    for(auto e : mesh.edges())
      weight.set_weight(mesh.vertex(e, 0), mesh.vertex(e, 1), 1);
    Options options;
    options.cells = cells;
    const auto start = [&](Mesh& m) {
      CGAL::ARAP_deformation<Mesh, Traits> d(m, Traits({}, weight));
      CHECK(d.set_options(options));
      prepare(d, scenario(shape), all_vertices(m));
      return d;
    };
    auto d = start(mesh);
    CHECK(d.deform(300, 1e-9));
    for(auto e : mesh.edges())
      if(mesh.vertex(e, 0) % 3 == 0)
        weight.set_weight(mesh.vertex(e, 0), mesh.vertex(e, 1), 5);
    const Report changed = d.deform(1000, 1e-9);
    CHECK(changed.stages.weights && changed.stages.factor);
    CHECK(!changed.stages.region && !changed.stages.order);
    auto fresh = start(other);
    const Report expected = fresh.deform(1000, 1e-9);
    CHECK_AT_MOST(std::abs(changed.final_energy() - expected.final_energy()),
                  1e-6 * expected.final_energy());
    CHECK(!d.deform(1, 0).stages.weights);
    weight.set_weight(60, 61, 3);
    CHECK(d.preprocess());
    const Report refused = d.deform(1, -1); // did nothing: the next one tells what came before
    CHECK(refused.status == Status::invalid_option && !refused.stages.weights);
    CHECK(d.deform(1, 0).stages.weights);

    const std::vector<Point> before = points_of(mesh);
    const CGAL::ARAP::Matrix_3x3 rotation = d.rotation(Vertex(60));
    CHECK(rotation[0] < 0.999);
    weight.set_weight(60, 61, std::nan(""));
    for(int call = 0; call < 2; ++call)
      CHECK(d.deform(5, 0).status == Status::non_finite_weight);
    CHECK(points_of(mesh) == before && d.rotation(Vertex(60)) == rotation);
    weight.set_weight(60, 61, 2);
    const Report mended = d.deform(5, 0);
    CHECK(mended && mended.stages.weights && !mended.stages.region);

    // another region may have no edge whose weight is wrong
    weight.set_weight(60, 61, std::nan(""));
    CHECK(d.deform(5, 0).status == Status::non_finite_weight);
    for(auto v : mesh.vertices())
      if(v != Vertex(5))
        d.insert_control_vertex(v);
    CHECK(d.deform(5, 0));
  }
}

// Two free vertices whose matrix is [[2, -1], [-1, 1/2]], up to scale and rounding: its determinant
// is zero.
void test_singular()
{
  for(double weight : {-0.5 * (1 + 1e-15), -0.5 * (1 - 1e-15)})
  {
    test_case() = "a singular matrix of signed weights";
    std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    const std::vector<Point> rest = points;
    const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}};
    using Domain = CGAL::ARAP::Polygon_soup_domain<std::vector<Point>,
                                                   std::vector<std::array<int, 3>>>;
    CGAL::ARAP::Edge_map_weight weights;
    weights.set_weight(0, 1, 1);
    weights.set_weight(1, 2, 1);
    weights.set_weight(0, 2, weight);
    CGAL::ARAP_deformation<Domain, Traits> d(Domain(points, triangles), Traits({}, weights));
    Options options;
    options.cells = Cell_scheme::spokes();
    CHECK(d.set_options(options));
    d.insert_roi_vertices(d.domain().vertices());
    d.insert_control_vertex(0, Point(0, 0, 1));
    const Report report = d.deform(5, 0);
    CHECK(report.status == Status::singular_matrix);
    CHECK(report.energy.empty() && std::isnan(report.final_energy()));
    CHECK(points == rest);
  }
}

// Weights that differ from one triangle to the other.
struct Weight_of_triangles
{
  std::array<double, 3> simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>& p) const
  {
    const bool is_first = p[1][0] + p[2][0] > 1.5; // (0, 1, 2) and (0, 2, 3)
    return is_first ? std::array<double, 3>{1, -1, 1} : std::array<double, 3>{0, 0, 0.5};
  }
  std::array<double, 6> simplex_weights(const std::array<CGAL::ARAP::Coordinates, 4>&) const
  {
    return {};
  }
  double edge_weight(CGAL::ARAP::Edge_set, std::size_t, std::size_t, double sum) const
  {
    return sum;
  }
};

// The same matrix of the free vertices 1 and 2, from faces one of which has a negative energy.
template <typename Weight>
void test_negative_energy(const std::string& name, const std::vector<std::vector<int>>& faces,
                          const Weight& weight)
{
  test_case() = "a singular matrix of a negative energy: " + name;
  std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 0.5, 0}};
  auto domain = CGAL::ARAP::make_polygon_soup_domain(points, faces);
  using Other_traits = CGAL::ARAP_deformation_traits<CGAL::Default, Weight>;
  CGAL::ARAP_deformation<decltype(domain), Other_traits> d(domain, Other_traits({}, weight));
  Options options;
  options.cells = Cell_scheme::elements();
  CHECK(d.set_options(options));
  d.insert_roi_vertices(domain.vertices());
  d.insert_control_vertex(0, Point(0, 0, 1));
  d.insert_control_vertex(3);
  d.insert_control_vertex(4);
  CHECK(d.deform(5, 0).status == Status::singular_matrix);
  CHECK(points[2] == Point(1, 1, 0));
}

void test_negative_energies()
{
  CGAL::ARAP::Edge_map_weight weights;
  weights.set_weight(0, 1, 1);
  weights.set_weight(1, 2, 1);
  weights.set_weight(0, 2, -1);
  weights.set_weight(2, 3, 0.5);
  test_negative_energy("a polygon", {{0, 1, 2, 3, 4}}, weights);
  test_negative_energy("weights of triangles", {{0, 1, 2}, {0, 2, 3}}, Weight_of_triangles());
}

} // namespace user_weights

// What did not move is said.
namespace messages {

void test_messages()
{
  Mesh mesh = make_mesh<Mesh>(sheet(6));
  {
    test_case() = "no region";
    Deformation d(mesh);
    CHECK(says(d.deform(), "the region of interest is empty"));
    d.insert_control_vertex(Vertex(0), Point(0, 0, 1));
    d.insert_control_vertex(Vertex(1));
    CHECK(says(d.deform(), "nothing is free to move: every vertex of the region of interest"));
  }
  {
    test_case() = "no handle";
    Deformation d(mesh);
    for(int k = 10; k < 20; ++k)
      d.insert_roi_vertex(Vertex(k));
    CHECK(says(d.deform(), "there is no control vertex"));
    d.insert_roi_vertices(vertices(mesh));
    const Report report = d.deform();
    CHECK(report.status == Status::no_fixed_vertex);
    CHECK(report.message.rfind("there is no control vertex: vertex ", 0) == 0);
  }
  {
    test_case() = "an isolated handle";
    const Vertex isolated = mesh.add_vertex(Point(5, 5, 5));
    Deformation d(mesh);
    d.insert_roi_vertices(vertices(mesh));
    d.insert_control_vertex(isolated, Point(6, 6, 6));
    d.insert_control_vertex(Vertex(0));
    const Report report = d.deform();
    CHECK(report && says(report, "vertex 49: a control vertex without an incident simplex"));
    CHECK(mesh.point(isolated) == Point(6, 6, 6));
  }
#ifdef CGAL_NDEBUG // else a precondition says so
  {
    test_case() = "a vertex that was removed, and one that never was";
    const Vertex removed = mesh.add_vertex(Point(7, 7, 7));
    mesh.remove_vertex(removed);
    Deformation d(mesh);
    d.insert_roi_vertices(vertices(mesh));
    for(const Vertex v : {removed, Vertex(12345), Vertex()})
    {
      CHECK(!d.insert_control_vertex(v) && !d.insert_roi_vertex(v));
      CHECK(d.control_vertices().empty());
    }
  }
#endif
}

// The phases add up to the total, for a frame whose time is that of reading and writing as well.
void test_seconds()
{
  test_case() = "seconds";
  const Block shape = block(16, 12, 10);
  std::vector<Point> points = points_of(shape.points);
  using Domain = CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>,
                                                     std::vector<std::array<std::size_t, 4>>>;
  CGAL::ARAP_deformation<Domain> d(Domain(points, shape.tetrahedra));
  d.insert_roi_vertices(d.domain().vertices());
  d.insert_control_vertex(0, Point(0, 0, -1));
  for(std::size_t v = 1; v < 30; ++v)
    d.insert_control_vertex(v);
  double least_share = 1; // of what is in no phase; it is more where others interrupt
  for(int k = 0; k < 10; ++k)
  {
    const CGAL::ARAP::Phase_seconds s = d.deform(2, 0, [](const auto&) {
      volatile double x = 0;
      for(int i = 0; i < 100000; ++i)
        x = x + i;
      return CGAL::ARAP::Visitor_action::proceed;
    }).seconds;
    CHECK(s.visitor > 0 && s.transfer > 0 && s.local_steps > 0 && s.global_steps > 0);
    CHECK_AT_MOST(sum_of_phases(s), s.total);
    least_share = (std::min)(least_share, 1 - sum_of_phases(s) / s.total);
  }
  CHECK_AT_MOST(least_share, 0.2);
}

} // namespace messages

// The short ways in.
namespace short_ways {

void test_one_call()
{
  const Mesh rest = make_mesh<Mesh>(sheet(8));
  const auto is_fixed = [](Vertex v) { return v < Vertex(9); };
  const std::map<Vertex, Point> targets = {{Vertex(80), Point(1, 1, 0.5)},
                                           {Vertex(40), rest.point(Vertex(40))}};
  const auto run = [&](const char* name, const auto& call) {
    test_case() = name;
    Mesh mesh = rest;
    const Report report = call(mesh);
    CHECK(report && report.iterations > 0);
    CHECK(mesh.point(Vertex(80)) == Point(1, 1, 0.5));
    return points_of(mesh);
  };
  namespace parameters = CGAL::parameters;
  const auto expected = run("a map", [&](Mesh& mesh) {
    return CGAL::arap_deform(mesh, targets, parameters::vertex_is_constrained_map(is_fixed));
  });
  CHECK(run("pairs", [&](Mesh& mesh) {
    const std::vector<std::pair<Vertex, Point>> pairs(targets.begin(), targets.end());
    std::map<Vertex, bool> constrained;
    for(Vertex v : mesh.vertices())
      if(is_fixed(v)) constrained[v] = true;
    return CGAL::arap_deform(mesh, pairs, parameters::vertex_is_constrained_map(constrained));
  }) == expected);
  CHECK(run("functions", [&](Mesh& mesh) {
    return CGAL::arap_deform(
      mesh, [&](Vertex v) { return is_fixed(v) || targets.count(v) > 0; },
      [&](Vertex v) { return is_fixed(v) ? rest.point(v) : targets.at(v); });
  }) == expected);
  CHECK(run("vectors", [&](Mesh& mesh) {
    std::vector<bool> constrained;
    for(Vertex v : mesh.vertices())
      constrained.push_back(is_fixed(v) || targets.count(v) > 0);
    return CGAL::arap_deform(mesh, constrained, targets, Options());
  }) == expected);
  {
    test_case() = "a vector that is too short";
    Mesh mesh = rest;
    bool is_refused = false;
    try { static_cast<void>(CGAL::arap_deform(mesh, std::vector<bool>(80), targets, Options())); }
    catch(const std::out_of_range&) { is_refused = true; }
    CHECK(is_refused && points_of(mesh) == points_of(rest));
  }

  run("maps that count their copies", [&](Mesh& mesh) {
    int number = 0;
    struct Counted
    {
      explicit Counted(int& copies) : m_copies(copies) {}
      Counted(const Counted& other) : m_copies(other.m_copies) { ++m_copies; }
      int& m_copies;
    };
    const Counted counted(number);
    const Report report = CGAL::arap_deform(mesh, targets, parameters::target_weight(
      [counted](Vertex v) { return v == Vertex(80) ? infinity : 1; },
      parameters::vertex_is_constrained_map(
        [counted, is_fixed](Vertex v) { return is_fixed(v); })));
    CHECK_AT_MOST(number, 40); // not for each of 81 vertices
    return report;
  });

  Options options;
  options.iterations = 2;
  options.tolerance = 0;
  const auto few = run("options", [&](Mesh& mesh) {
    const Report report = CGAL::arap_deform(
      mesh, targets, parameters::deformation_options(options).vertex_is_constrained_map(is_fixed));
    CHECK(report.iterations == 2);
    return report;
  });
  CHECK(few != expected);
  CHECK(run("options first", [&](Mesh& mesh) {
    return CGAL::arap_deform(mesh, targets, options,
                             parameters::vertex_is_constrained_map(is_fixed));
  }) == few);
  options.iterations = 100;
  CHECK(run("a number of iterations beside options", [&](Mesh& mesh) {
    return CGAL::arap_deform(
      mesh, targets, options,
      parameters::vertex_is_constrained_map(is_fixed).number_of_iterations(2));
  }) == few);
  options.iterations = 2;
  CHECK(run("options last", [&](Mesh& mesh) {
    const auto np = parameters::vertex_is_constrained_map(is_fixed).number_of_iterations(2);
    return CGAL::arap_deform(mesh, targets, parameters::deformation_options(options, np));
  }) == few);
  run("traits and region", [&](Mesh& mesh) {
    using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::ARAP::Uniform_weight>;
    std::vector<Vertex> region;
    for(Vertex v : mesh.vertices())
      if(v > Vertex(30)) region.push_back(v);
    const Report report = CGAL::arap_deform(
      mesh, targets,
      parameters::region_of_interest(region, parameters::deformation_traits(Traits())));
    CHECK(report.free_vertices == 48);
    for(int v = 0; v < 30; ++v)
      CHECK(mesh.point(Vertex(v)) == rest.point(Vertex(v)));
    return report;
  });

  test_case() = "a soup in one line";
  const Shape shape = sheet(8);
  std::vector<Point> points = points_of(shape.points);
  const std::map<std::size_t, Point> at = {{0, points[0]}, {8, points[8]}, {80, Point(1, 1, 0.5)}};
  CHECK(CGAL::arap_deform(CGAL::ARAP::make_polygon_soup_domain(points, shape.triangles), at,
                          Options()));
  CHECK(points[80] == Point(1, 1, 0.5) && points[8] == rest.point(Vertex(8)));

  test_case() = "soft targets";
  Mesh mesh = rest;
  CHECK(CGAL::arap_deform(mesh, targets, parameters::target_weight(
    0.1, parameters::vertex_is_constrained_map(is_fixed))));
  CHECK(mesh.point(Vertex(80)) != Point(1, 1, 0.5));
  Mesh same = rest;
  CHECK(CGAL::arap_deform(
    same, [&](Vertex v) { return targets.count(v) > 0; }, targets, parameters::target_weight(
    0.1, parameters::vertex_is_constrained_map(is_fixed))));
  CHECK(points_of(mesh) == points_of(same));

  test_case() = "a const mesh and an output map";
  auto output = mesh.add_property_map<Vertex, Point>("v:output").first;
  const Mesh& constant = mesh;
  const std::vector<Point> before = points_of(mesh);
  CHECK(CGAL::arap_deform(constant, targets, parameters::output_point_map(output)));
  CHECK(points_of(mesh) == before && output[Vertex(80)] == Point(1, 1, 0.5));
}

void test_class()
{
  test_case() = "deduction, ranges and transformations";
  const Mesh rest = make_mesh<Mesh>(sheet(8));
  Mesh mesh = rest;
  auto points = mesh.add_property_map<Vertex, Point>("v:other").first;
  for(Vertex v : mesh.vertices())
    points[v] = Point(2 * rest.point(v).x(), rest.point(v).y(), 0);
  CGAL::ARAP_deformation d(mesh, CGAL::parameters::vertex_point_map(points));
  d.insert_roi_vertices(vertices(mesh));
  const std::vector<Vertex> handles = {Vertex(0), Vertex(40), Vertex(80)};
  d.insert_control_vertices(handles);
  const Kernel::Vector_3 up(0, 0, 1);
  const CGAL::Aff_transformation_3<Kernel> twice(CGAL::SCALING, 2), lift(CGAL::TRANSLATION, up);
  CHECK(d.transform(handles, twice));
  CHECK(d.target_position(Vertex(80)) == Point(4, 2, 0));
  CHECK(d.transform(handles, lift));
  CHECK(d.target_position(Vertex(80)) == Point(4, 2, 1));
  CHECK(d.transform(handles, lift, CGAL::ARAP::Transformed::rest_shape));
  CHECK(d.target_position(Vertex(80)) == Point(2, 1, 1));
  CHECK(d.translate(handles, up));
  CHECK(d.rotate(handles, Eigen::Vector3d(0, 0, 0),
                 Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()))));
  CHECK(d.set_target_weight(handles, 10));
  CHECK(!d.set_target_weight(handles, -1));
  CHECK(!d.insert_control_vertex(Vertex(0), Point(0, 0, 2)));
  CHECK(d.target_position(Vertex(0)) == Point(0, 0, 2));
  CHECK(d.deform());
  CHECK(points_of(mesh) == points_of(rest));
  CGAL::ARAP_deformation plain(mesh);
  static_assert(std::is_same_v<decltype(plain), Deformation>);
  using Domain = CGAL::ARAP::Face_graph_domain<Mesh>;
  using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::ARAP::Uniform_weight>;
  static_assert(std::is_same_v<decltype(CGAL::ARAP_deformation(mesh, Traits())),
                               CGAL::ARAP_deformation<Mesh, Traits>>);
  static_assert(std::is_same_v<decltype(CGAL::ARAP_deformation(Domain(mesh), Traits())),
                               CGAL::ARAP_deformation<Domain, Traits>>);
  const Mesh& constant = mesh; // by named parameters, which are no traits
  using To_other_points = decltype(
    CGAL::ARAP_deformation(constant, CGAL::parameters::output_point_map(points)));
  static_assert(std::is_same_v<To_other_points::Deformation_domain::Mesh, const Mesh>);

  test_case() = "constrained vertices of the constructor";
  const auto is_fixed = [](Vertex v) { return v < Vertex(9); };
  CGAL::ARAP_deformation held(mesh, CGAL::parameters::vertex_is_constrained_map(is_fixed));
  CHECK(held.control_vertices().size() == 9 && held.roi_vertices().size() == 9);
  CHECK(std::isinf(held.target_weight(Vertex(8))));

  test_case() = "all named parameters of the constructor";
  namespace np = CGAL::parameters;
  Mesh by_functions = rest, by_names = rest;
  auto output = by_names.add_property_map<Vertex, Point>("v:output").first;
  std::vector<Vertex> region;
  for(Vertex v : rest.vertices())
  {
    output[v] = rest.point(v);
    if(v > Vertex(8) && v < Vertex(75))
      region.push_back(v);
  }
  const auto stiffness = [](Vertex v) { return 1. + v % 4; };
  const auto groups = [](Vertex v) { return v > Vertex(50) ? 3 : -1; };
  const auto is_held = [](Vertex v) { return v == Vertex(20) || v == Vertex(40); };
  Options five;
  five.iterations = 5;
  five.tolerance = 0;
  const auto lift_one = [](auto& object) {
    CHECK(object.set_target_position(Vertex(40), Point(1, 1, 1)));
    const Report report = object.deform();
    CHECK(report && report.iterations == 5);
  };
  CGAL::ARAP_deformation named(
    by_names,
    np::region_of_interest(region,
      np::cell_stiffness(stiffness,
        np::cell_groups(groups,
          np::deformation_options(five,
            np::output_point_map(output).vertex_is_constrained_map(is_held)
              .weight_calculator(CGAL::ARAP::Uniform_weight())
              .sparse_linear_solver(CGAL::ARAP::Eigen_LDLT_solver()))))));
  lift_one(named);
  CGAL::ARAP_deformation<Mesh, Traits> same(by_functions);
  CHECK(same.set_options(five) && same.set_stiffness(stiffness) && same.set_groups(groups));
  same.insert_roi_vertices(region);
  same.insert_control_vertices(std::vector<Vertex>{Vertex(20), Vertex(40)});
  lift_one(same);
  CHECK(points_of(by_names) == points_of(rest));
  for(Vertex v : rest.vertices())
    CHECK_AT_MOST((vector(output[v]) - vector(by_functions.point(v))).norm(), 1e-12);
  using Named_traits = decltype(named)::Deformation_traits;
  static_assert(std::is_same_v<Named_traits::Sparse_solver, CGAL::ARAP::Eigen_LDLT_solver>);
  static_assert(std::is_same_v<Named_traits::Edge_weight, CGAL::ARAP::Uniform_weight>);
  using Ignored = decltype(CGAL::ARAP_deformation(mesh, np::deformation_traits(
    Traits(), np::sparse_linear_solver(CGAL::ARAP::Eigen_LDLT_solver()))));
  static_assert(std::is_same_v<Ignored::Deformation_traits, Traits>);

#ifdef CGAL_NDEBUG // else a precondition says so
  test_case() = "invalid options of the constructor";
  Options options;
  options.tolerance = -1;
  CGAL::ARAP_deformation invalid(mesh, CGAL::parameters::deformation_options(options));
  invalid.insert_roi_vertices(vertices(mesh));
  invalid.insert_control_vertex(Vertex(0), Point(0, 0, 1));
  CHECK(invalid.preprocess().status == Status::invalid_option);
  const Report refused = invalid.deform();
  CHECK(refused.status == Status::invalid_option && says(refused, "tolerance"));
  CHECK(points_of(mesh) == points_of(rest));
  CHECK(invalid.set_options(Options()));
  CHECK(invalid.preprocess() && invalid.deform());
#endif
}

} // namespace short_ways

// The guess of naive Laplacian editing.
namespace guess {

// || L x - L p || with star weights of one, over the free vertices and their neighbors
double residual(const Mesh& mesh, const Mesh& rest)
{
  double sum = 0;
  for(Vertex v : mesh.vertices())
  {
    Eigen::Vector3d row = Eigen::Vector3d::Zero();
    for(Vertex w : mesh.vertices_around_target(mesh.halfedge(v)))
      row += vector(mesh.point(v)) - vector(mesh.point(w)) - vector(rest.point(v)) +
             vector(rest.point(w));
    sum += row.squaredNorm();
  }
  return std::sqrt(sum);
}

// It does not depend on what was before, and is a minimum. A hub with thousands of neighbors costs
// no more than others.
void test_guess()
{
  using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::ARAP::Uniform_weight>;
  const int spokes = short_or_long(1000, 5000);
  Shape wheel{"wheel", {Eigen::Vector3d::Zero()}, {}};
  for(int k = 0; k < spokes; ++k)
  {
    const double angle = 2 * std::acos(-1.0) * k / spokes;
    wheel.points.push_back({std::cos(angle), std::sin(angle), 0.1 * std::sin(5 * angle)});
    wheel.triangles.push_back({0, std::size_t(1 + k), std::size_t(1 + (k + 1) % spokes)});
  }
  for(const Shape& shape : {sheet(16), wheel})
  {
    test_case() = "guess, " + shape.name;
    const Mesh rest = make_mesh<Mesh>(shape);
    Mesh mesh = rest, other = rest;
    Options options;
    options.initial_guess = Initial_guess::laplacian;
    const auto start = [&](Mesh& m) { return prepared<Traits>(m, scenario(shape), options); };
    auto d = start(mesh);
    const Report report = d.deform(0, 0);
    CHECK(report);
    auto e = start(other);
    CHECK(e.translate(e.control_vertices(), Eigen::Vector3d(1e3, 0, 7)));
    CHECK(e.deform(9, 0));
    CHECK(e.translate(e.control_vertices(), Eigen::Vector3d(-1e3, 0, -7)));
    CHECK(e.deform(0, 0));
    CHECK_AT_MOST(largest_distance(points_of(mesh), points_of(other)), 1e-6);

    const double minimum = residual(mesh, rest);
    const Scenario s = scenario(shape);
    for(std::size_t v = 0; v < s.selection.size(); v += 37)
      if(s.selection[v] == 1)
        for(double step : {1e-3, -1e-3})
        {
          Mesh moved = mesh;
          moved.point(Vertex(Vertex::size_type(v))) =
            mesh.point(Vertex(Vertex::size_type(v))) + Kernel::Vector_3(0, step, step);
          CHECK(residual(moved, rest) > minimum);
        }
  }
}

// Weights of 1e6 next to 1, in a half of the sheet, at every fifth edge, or anywhere: against the
// dense solution, in numbers with more digits.
void test_weights()
{
  using Matrix = Matrix_of_long_doubles;
  const Shape shape = sheet(10);
  Scenario s = scenario(shape);
  for(std::size_t v = 0; v < s.targets.size(); ++v)
    s.targets[v] = shape.points[v] + 1e-4 * (s.targets[v] - shape.points[v]);
  for(int pattern = 0; pattern < 3; ++pattern)
  {
    test_case() = "guess with large weights, pattern " + std::to_string(pattern);
    Mesh mesh = make_mesh<Mesh>(shape);
    CGAL::ARAP::Edge_map_weight weights;
    const Eigen::Index n = Eigen::Index(shape.points.size());
    Matrix l = Matrix::Zero(n, n);
    std::mt19937 random(3);
    int k = 0;
    for(auto e : mesh.edges())
    {
      const Vertex v = mesh.vertex(e, 0), w = mesh.vertex(e, 1);
      const bool is_large = pattern == 0 ? mesh.point(v).y() + mesh.point(w).y() < 1
                            : pattern == 1 ? k++ % 5 == 0 : random() % 2 == 0;
      const double weight = is_large ? 1e6 : 1;
      weights.set_weight(v, w, weight);
      const auto i = Eigen::Index(v), j = Eigen::Index(w);
      l(i, i) += weight, l(j, j) += weight, l(i, j) -= weight, l(j, i) -= weight;
    }
    Matrix rest(n, 3), fixed = Matrix::Zero(n, 3), columns(n, n);
    std::vector<Eigen::Vector3d> expected = s.targets;
    std::vector<std::size_t> free;
    for(std::size_t v = 0; v < shape.points.size(); ++v)
    {
      rest.row(Eigen::Index(v)) = shape.points[v].transpose().cast<long double>();
      if(s.selection[v] == 1)
      {
        columns.col(Eigen::Index(free.size())) = l.col(Eigen::Index(v));
        free.push_back(v);
      }
      else
        fixed.row(Eigen::Index(v)) = s.targets[v].transpose().cast<long double>();
    }
    columns.conservativeResize(n, Eigen::Index(free.size()));
    const Matrix solution = least_squares(columns, l * (rest - fixed));
    for(std::size_t v = 0; v < free.size(); ++v)
      expected[free[v]] = solution.row(Eigen::Index(v)).transpose().cast<double>();

    CGAL::ARAP_deformation<Mesh, user_weights::Traits> d(mesh, user_weights::Traits({}, weights));
    Options options;
    options.initial_guess = Initial_guess::laplacian;
    CHECK(d.set_options(options));
    prepare(d, s, all_vertices(mesh));
    CHECK(d.deform(0, 0));
    CHECK_AT_MOST(largest_distance(points_of(mesh), expected), 1e-6);

    // Where the solution leaves the surroundings of the shape, the vertices stay where they are.
    const Scenario far = scenario(shape);
    for(std::size_t v : free)
      mesh.point(Vertex(Vertex::size_type(v))) = point(shape.points[v]);
    for(std::size_t v = 0; v < far.targets.size(); ++v)
      if(far.selection[v] == 2)
        CHECK(d.set_target_position(Vertex(Vertex::size_type(v)), point(far.targets[v])));
    CHECK(d.deform(0, 0));
    CHECK(points_of(mesh) == points_of(far.targets));
  }
}

} // namespace guess

int main()
{
  rigid::test_motions();
  rigid::test_thin_triangle();
  rigid::test_returns();
  rigid::test_parts();
  rigid::test_fixed_simplex();
  rigid::test_deformed();
  rigid::test_twist();
  rigid::test_control_point_and_handle();
  rigid::test_laplacian();
  rigid::test_laplacian_beside_others();
  rigid::test_laplacian_after_a_run();
  rigid::test_laplacian_with_bending();
  rigid::test_laplacian_that_is_not_taken();
  rigid::test_line();
  rigid::test_rows();
  undo::test_state();
  undo::test_branches();
  undo::test_points_of_others();
  undo::test_mended_points();
  undo::test_mended_targets();
  undo::test_refusals_elsewhere();
  user_weights::test_changes();
  user_weights::test_singular();
  user_weights::test_negative_energies();
  messages::test_messages();
  messages::test_seconds();
  short_ways::test_one_call();
  short_ways::test_class();
  guess::test_guess();
  guess::test_weights();
  return checks_result();
}
