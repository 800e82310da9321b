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

// Where quasi-Newton runs end: the second derivative of the energy, what a look at it finds, and
// that saddle points are left and minima are not.

#include "include/check.h"
#include "include/domains.h"
#include "include/problem.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Pseudorandom_vectors.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Second_look.h>
#include <CGAL/ARAP_deformation/internal/minimizer/gap_estimate.h>
#include <CGAL/ARAP_deformation/set_option.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

namespace derivative {

using namespace problem;

double largest(const Array<Coordinates>& points)
{
  double result = 0;
  for(const Coordinates& p : points)
    result = larger(result, std::sqrt(dot(p, p)));
  return result;
}

// The change of the force is that of the forces at two positions that are near.
void check_derivative(Problem& problem)
{
  Minimization run = problem.minimization();
  CHECK(run.has_second_derivative());
  Random random;
  Array<Coordinates> step(run.x.size());
  for(Coordinates& p : step)
    p = random();
  run.leave_free(step);
  const Array<Coordinates> start = run.x;
  const double h = 1e-5 * run.diameter;
  Array<Coordinates> difference(run.x.size(), Coordinates{0, 0, 0}), change;
  for(const double sign : {1.0, -1.0})
  {
    for(std::size_t v = 0; v < start.size(); ++v)
    {
      run.x[v] = start[v];
      add(run.x[v], sign * h, step[v]);
    }
    run.evaluate();
    for(std::size_t v = 0; v < start.size(); ++v)
      add(difference[v], sign / (2 * h), run.force()[v]);
  }
  run.x = start;
  run.evaluate();
  run.prepare_second_derivative();
  run.change_of_force(step, change);
  run.clear_second_derivative();
  const double size = largest(difference);
  CHECK(size > 0);
  for(std::size_t v = 0; v < start.size(); ++v)
    add(difference[v], -1, change[v]);
  CHECK_AT_MOST(largest(difference), 1e-6 * size);
}

// every cell scheme, with each term by itself and all of them
template <typename Simplices>
void test_derivative(const std::string& name, const std::vector<Eigen::Vector3d>& points,
                     const Simplices& simplices)
{
  const Region region = region_of(points, simplices);
  const auto n = static_cast<int>(points.size());
  const int terms = 7;
  for(const Cell_scheme& cells : {Cell_scheme::spokes(), Cell_scheme::k_ring(1),
                                  Cell_scheme::spokes_and_rims(), Cell_scheme::elements()})
    for(int chosen = 0; chosen <= terms; ++chosen)
    {
      test_case() = "derivative, " + name + ", " + std::to_string(chosen);
      const auto has = [chosen](int term) { return chosen == term || chosen == terms; };
      Energy_model model;
      model.cells = cells;
      const int number_of_cells =
        cells.has_vertex_cells() ? n : static_cast<int>(simplices.size());
      if(has(1) && cells.has_vertex_cells())
        model.bending_length = 0.3;
      if(has(2))
        for(int c = 0; c < number_of_cells; ++c)
          model.stiffness.push_back(0.2 + c % 3);
      if(has(3))
        for(int c = 0; c < number_of_cells; ++c)
          model.group.push_back(c % 4 == 0 ? c / 20 : -1);
      Problem problem(region, model, 0.01);
      if(has(4))
        problem.energy.set_given_rotations({{3, rotation_of_vector({0.1, 0.2, -0.3})},
                                            {4, rotation_of_vector({0.4, 0, 0.1})}});
      if(has(5))
        for(int k = 1; k < 4; ++k)
        {
          problem.constraints.rows.append(k, 0.7);
          problem.targets.soft.push_back({0.5, 0.1 * k, 1});
        }
      if(has(6))
      {
        Targets& targets = problem.targets;
        for(int k = 0; k < 2; ++k)
        {
          problem.constraints.rows.append({2 + k, 4 + k}, {0.25, 0.75}, 1.5);
          targets.soft.push_back({0, 0, 0});
        }
        const int size = problem.constraints.rows.size();
        targets.sets.push_back({size - 2, [](const Coordinates& p) { // onto a plane
          return Coordinates{p[0], p[1], 0.3};
        }});
        targets.sets.push_back({size - 1, [](const Coordinates& p) { // onto a sphere
          return scaled(p, 2 / std::sqrt(dot(p, p)));
        }});
        problem.constraints.hard_rows.append({1, n - 2}, {0.5, 0.5}, 1);
        targets.hard.push_back({0.2, 0.3, 0.4});
      }
      check_derivative(problem);
    }
}

// Sets of points of type float, some diameters from the origin: their projections are rounded,
// which the derivative of a projection hardly notices.
void test_rounded_sets(Region region)
{
  test_case() = "derivative, sets of rounded points";
  for(Coordinates& p : region.rest)
    add(p, 10, {1, 1, 1});
  const Coordinates normal = scaled({1, -2, 0.5}, 1 / std::sqrt(5.25));
  Array<Coordinates> changes[2];
  for(const bool is_rounded : {false, true})
  {
    Problem problem(region, Energy_model(), 0.01);
    const auto rounded = [=](Coordinates p) {
      for(double& c : p)
        c = is_rounded ? static_cast<float>(c) : c;
      return p;
    };
    problem.constraints.rows.append(1, 1.5);
    problem.targets.soft.push_back({0, 0, 0});
    problem.targets.add_set([=](const Coordinates& p) {
      Coordinates projection = rounded(p);
      add(projection, 0.3 - dot(normal, projection), normal);
      return rounded(projection);
    });
    if(is_rounded)
      problem.targets.precision = 1e-7;
    Minimization run = problem.minimization();
    run.evaluate();
    run.prepare_second_derivative();
    Array<Coordinates> step(run.x.size(), Coordinates{0, 0, 0});
    step[1] = {0.1, -0.2, 0.3};
    run.change_of_force(step, changes[is_rounded]);
    run.clear_second_derivative();
  }
  const Coordinates error = difference(changes[0][1], changes[1][1]);
  CHECK_AT_MOST(std::sqrt(dot(error, error)), 0.01);
}

// A target that hardly pulls, and is far away, leaves a strain what it is.
void test_far_target(const Region& region)
{
  test_case() = "a far target";
  Problem problem(region, Energy_model(), 0.01);
  problem.constraints.rows.append(1, 1e-30);
  problem.targets.soft.push_back({1e7, 0, 0});
  Minimization run = problem.minimization();
  run.evaluate();
  run.report.energy.push_back(run.value());
  CHECK(run.value() > 1e-6 && !run.is_at_zero());
}

// Where all rotations are given the energy is quadratic, the metric is its second derivative, and
// one step finds the gap. Next to a minimum a look finds it too, and no negative curvature.
void test_gap(const Region& region)
{
  for(const bool is_quadratic : {true, false})
  {
    test_case() = is_quadratic ? "gap of a quadratic energy" : "gap";
    Problem problem(region, Energy_model(), is_quadratic ? 0.05 : 0);
    if(is_quadratic)
    {
      std::vector<std::pair<int, Matrix_3x3>> given;
      for(int c = 0; c < problem.energy.number_of_cells(); ++c)
        given.emplace_back(c, rotation_of_vector({0.1, 0.02 * c, 0.3}));
      problem.energy.set_given_rotations(given);
    }
    Minimization run = problem.minimization();
    Array<Coordinates> step;
    double minimum = 0;
    const auto descend = [&](int iterations) {
      for(int k = 0; k < iterations; ++k)
      {
        run.evaluate();
        CHECK(run.solve(step));
        for(std::size_t v = 0; v < step.size(); ++v)
          add(run.x[v], 1, step[v]);
      }
      return run.evaluate();
    };
    if(!is_quadratic)
    {
      minimum = descend(3000);
      Random random;
      for(std::size_t v = 0; v < step.size(); ++v)
        if(!problem.constraints.is_fixed[v])
          add(run.x[v], 1e-4 * run.diameter, random());
      descend(2); // what is smooth remains
    }
    const Array<Coordinates> start = run.x;
    const double energy = run.evaluate();
    if(is_quadratic)
    {
      minimum = descend(1);
      run.x = start;
      run.evaluate();
    }
    CHECK(energy > minimum);
    const Pseudorandom_vectors disturbance(run.rest(), run.number_of_vertices);
    Second_look look(run, disturbance);
    Second_look::Finding finding = look.begin(1e-6 * (energy - minimum));
    int steps = 0;
    for(; finding == Second_look::Finding::nothing_yet && steps < 500; ++steps)
      finding = look.step();
    CHECK(finding == Second_look::Finding::positive_curvature);
    CHECK(!is_quadratic || steps == 1);
    CHECK_AT_MOST(std::abs(look.gap() / (energy - minimum) - 1), is_quadratic ? 5e-3 : 0.1);
  }
}

// Vectors depend on places, up to the sign of zeros, and differ where points are at the same place.
void test_disturbance()
{
  test_case() = "disturbance";
  const Array<Coordinates> points = {{0, 1, 2}, {3, 0, -0.}, {3, -0., 0}, {3, 0, 0}, {1, 2, 3}};
  const Array<Coordinates> reversed(points.rbegin(), points.rend());
  const Pseudorandom_vectors vectors(points, points.size()), others(reversed, reversed.size());
  CHECK(vectors(0) == others(4) && vectors(4) == others(0));
  CHECK(vectors(0) != vectors(4));
  std::vector<Coordinates> there = {vectors(1), vectors(2), vectors(3)};
  for(int k = 0; k < 3; ++k)
    CHECK(there[std::size_t(k)] == others(std::size_t(k) + 1));
  std::sort(there.begin(), there.end());
  CHECK(std::unique(there.begin(), there.end()) == there.end());
  for(std::size_t k = 0; k < points.size(); ++k)
    for(double c : vectors(k))
      CHECK_AT_MOST(std::abs(c), 0.5);
}

void test_all()
{
  const Shape sheet = grid("sheet", 7, 5, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0.4 * u * v + 0.2 * u * u);
  });
  const Block bar = block(4, 2, 2);
  test_derivative("sheet", sheet.points, sheet.triangles);
  test_derivative("bar", bar.points, bar.tetrahedra);
  test_disturbance();
  test_gap(region_of(sheet.points, sheet.triangles));
  test_rounded_sets(region_of(sheet.points, sheet.triangles));
  test_far_target(region_of(sheet.points, sheet.triangles));
}

} // namespace derivative

// The estimate of the gap, for decreases that are known.
namespace estimate {

using CGAL::ARAP::Report;
using CGAL::ARAP::internal::Gap_estimate;

// the least and the largest ratio of the estimate and the gap in the last tenth of n iterations, of
// which the k-th decreases an energy that tends to 1 by `decrease(k)`, to 1 + remainder(k)
template <typename Decrease, typename Remainder>
std::pair<double, double> ratios(int n, const Decrease& decrease, const Remainder& remainder)
{
  std::pair<double, double> result = {HUGE_VAL, 0};
  Gap_estimate estimate;
  Report report;
  report.energy_scale = 1;
  report.energy = {1 + remainder(0)};
  for(int k = 1; k <= n; ++k)
  {
    estimate.add(decrease(k), report);
    report.energy.push_back(1 + remainder(k));
    const double ratio = estimate(report.energy.back(), report) / remainder(k);
    if(k > 0.9 * n)
      result = {(std::min)(result.first, ratio), (std::max)(result.second, ratio)};
  }
  return result;
}

void test_known_series()
{
  for(const int n : {100, 300, 1000, 1050, 2050, 10000})
  {
    test_case() = "decreases that form a geometric series of " + std::to_string(n);
    const double factor = 1 - 10.0 / n;
    const auto of_series = ratios(
      n, [=](int k) { return (1 - factor) * std::pow(factor, k - 1); },
      [=](int k) { return std::pow(factor, k); });
    CHECK(of_series.first >= 1);
    CHECK_AT_MOST(of_series.second, 10);
  }
}

// It took quadratic time in the number of iterations: 256 times as long for 16 times as many.
void test_time()
{
  test_case() = "time of the estimate";
  const auto seconds = [](int n) {
    const std::clock_t begin = std::clock();
    const auto of_series = ratios(n, [](int k) { return 1.0 / k / (k + 1); },
                                  [](int k) { return 1.0 / (k + 1); });
    CHECK(of_series.first > 0.05); // this converges too slowly for it
    return double(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  double few = HUGE_VAL, many = HUGE_VAL;
  for(int repetition = 0; repetition < 3; ++repetition)
  {
    few = (std::min)(few, seconds(10000));
    many = (std::min)(many, seconds(160000));
  }
  CHECK_AT_MOST(many / few, 64);
}

} // namespace estimate

namespace ends {

using CGAL::ARAP::End;
using CGAL::ARAP::Initial_guess;
using CGAL::ARAP::Minimizer;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;
using CGAL::ARAP::Status;
using CGAL::ARAP::Visitor_action;

using Deformation = CGAL::ARAP_deformation<Mesh>;

// one end of it is fixed, the other one is pushed toward it
Scenario push(const Shape& shape, double share)
{
  Scenario s{std::vector<int>(shape.points.size(), 1), shape.points};
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    if(const double x = shape.points[v].x(); x < 0.25)
      s.selection[v] = 0;
    else if(x > 3.75)
    {
      s.selection[v] = 2;
      s.targets[v].x() -= share * 4;
    }
  return s;
}

Shape strip(int rows = 6)
{
  return grid("strip", 4 * rows, rows,
              [](double u, double v) { return Eigen::Vector3d(4 * u, v, 0); });
}

struct Run
{
  Mesh mesh;
  Report report;

  template <typename Visitor = CGAL::ARAP::Default_visitor>
  Run(const Shape& shape, const Scenario& s, const Options& options, Visitor visitor = Visitor())
    : mesh(make_mesh<Mesh>(shape))
  {
    auto d = prepared(mesh, s, options);
    report = d.deform(visitor);
    CHECK(report.energy.size() == report.iterations + 1);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    CHECK_AT_MOST(report.looking_iterations, report.iterations);
  }
};

// A flat strip that is pushed together stays flat, until it is looked at: then it buckles.
void test_buckling()
{
  const Shape shape = strip();
  const Scenario s = push(shape, 0.2);
  for(const Cell_scheme& cells : {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims()})
  {
    test_case() = "buckling";
    Options options = options_for(cells);
    const Run buckled(shape, s, options);
    CHECK(buckled.report.status == Status::converged);
    CHECK(buckled.report.end == End::minimum);
    CHECK(buckled.report.saddles_left > 0 && buckled.report.looking_iterations > 0);
    options.verify_minimum = false;
    const Run flat(shape, s, options);
    CHECK(flat.report.status == Status::converged && flat.report.end == End::unknown);
    CHECK(flat.report.looking_iterations == 0);
    CHECK_AT_MOST(buckled.report.final_energy(), 0.1 * flat.report.final_energy());

    // it is where other ways lead, too: the strip is bent a little before it is pushed
    Scenario bent = s;
    options.verify_minimum = true;
    options.tolerance = 1e-5;
    Mesh mesh = make_mesh<Mesh>(shape);
    auto d = prepared(mesh, s, options);
    for(auto v : mesh.vertices())
      if(s.selection[v.idx()] == 1)
        mesh.point(v) = Point(mesh.point(v).x(), mesh.point(v).y(),
                              0.3 * std::sin((mesh.point(v).x() - 0.25) * 0.9));
    const Report other = d.deform();
    CHECK(other.status == Status::converged && other.end == End::minimum);
    CHECK_AT_MOST(buckled.report.final_energy(), (1 + 2e-3) * other.final_energy());
  }
}

// A slit tube that is pushed together may come into a valley where the quadratic model of the
// energy has its minimum near by, but the energy falls on around a curve: by a tenth or a fifth.
void test_curved_valleys()
{
  int number_of_valleys = 0;
  for(const auto& [wave, share] : {std::pair(0.03, 0.65), std::pair(0.04, 0.62),
                                   std::pair(0.075, 0.6), std::pair(0.075, 0.65),
                                   std::pair(0.09, 0.7)})
    for(int size : {8, 9, 10})
    {
      test_case() = "curved valley, " + std::to_string(size) + ", " + std::to_string(share);
      const double amplitude = wave;
      const Shape shape = grid("tube", 24, size, [&](double u, double v) {
        const double angle = 6 * v, radius = 0.3 + amplitude * std::sin(12 * u);
        return Eigen::Vector3d(4 * u, radius * std::cos(angle), radius * std::sin(angle));
      });
      Mesh mesh = make_mesh<Mesh>(shape);
      Deformation d(mesh);
      Options options = options_for(Cell_scheme::spokes_and_rims());
      CHECK(d.set_options(options));
      prepare(d, push(shape, share), all_vertices(mesh));
      const Report report = d.deform();
      CHECK(report.status == Status::converged && report.end == End::minimum);
      number_of_valleys += report.plateaus_left > 0;
      options.tolerance = 1e-6;
      CHECK(d.set_options(options));
      const Report further = d.deform();
      CHECK_AT_MOST(report.final_energy(), 1.002 * further.final_energy());
    }
  CHECK(number_of_valleys > 0);
}

struct Tube
{
  int length, width;
  double wave, frequency, angle, share;
  Cell_scheme cells;
  double tolerance;
};

Shape slit(const Tube& tube)
{
  Shape shape = grid("tube", tube.length, tube.width, [&](double u, double v) {
    const double angle = tube.angle * v,
                 radius = 0.3 + tube.wave * std::sin(tube.frequency * u);
    return Eigen::Vector3d(4 * u, radius * std::cos(angle), radius * std::sin(angle));
  });
  shape.triangles.clear(); // with all diagonals alike
  const auto rows = static_cast<std::size_t>(tube.width) + 1;
  for(std::size_t a = 0; a + rows + 1 < shape.points.size(); ++a)
    if((a + 1) % rows != 0)
    {
      shape.triangles.push_back({a, a + rows, a + rows + 1});
      shape.triangles.push_back({a, a + rows + 1, a + 1});
    }
  return shape;
}

// Where the curvature is small in one direction the model of the energy may have a minimum that the
// energy has not: in slit tubes, which would end 4 to 20 percent too high.
void test_soft_directions()
{
  const Cell_scheme spokes = Cell_scheme::spokes(), rims = Cell_scheme::spokes_and_rims();
  for(const Tube& tube : {Tube{33, 8, 0.046, 16.1, 4.9, 0.58, spokes, 1e-2},
                          Tube{25, 12, 0.078, 15.5, 5.4, 0.72, spokes, 1e-2},
                          Tube{25, 8, 0.057, 13, 4.8, 0.22, spokes, 1e-3},
                          Tube{23, 11, 0.016, 6.7, 4.1, 0.21, rims, 1e-3},
                          Tube{24, 5, 0.022, 17.2, 6, 0.72, spokes, 1e-3},
                          Tube{19, 12, 0.076, 8.7, 5.5, 0.55, rims, 1e-2},
                          Tube{31, 8, 0.027, 17.1, 5, 0.32, spokes, 1e-2},
                          Tube{35, 12, 0.025, 7.7, 3.6, 0.64, spokes, 1e-3}})
  {
    test_case() = "soft direction, " + std::to_string(tube.length);
    const Shape shape = slit(tube);
    Mesh mesh = make_mesh<Mesh>(shape);
    Deformation d(mesh);
    Options options;
    options.cells = tube.cells;
    options.tolerance = tube.tolerance;
    CHECK(d.set_options(options));
    prepare(d, push(shape, tube.share), all_vertices(mesh));
    const Report report = d.deform();
    CHECK(report.status == Status::converged);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    options.tolerance = 1e-6;
    CHECK(d.set_options(options));
    CHECK_AT_MOST(report.final_energy(), (1 + 2 * tube.tolerance) * d.deform().final_energy());
  }
}

// Plates of tetrahedra that are pushed together: in one a look that ends too soon sees no direction
// in which it buckles; in the other a saddle point is so flat that a short way from it leads back.
void test_plates()
{
  using Tetrahedra = decltype(Block::tetrahedra);
  using Domain = CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>, Tetrahedra>;
  struct Plate
  {
    Cell_scheme cells;
    int length, width;
    double share; // of the length, by which it is pushed
  };
  for(const auto& [cells, length, width, share] : {Plate{Cell_scheme::elements(), 14, 6, 0.1},
                                                   Plate{Cell_scheme::spokes(), 14, 16, 0.2}})
  {
    test_case() = "plate, " + std::to_string(width);
    const Block block = unit_cubes(length, width, 1);
    std::vector<Point> points = points_of(block.points);
    CGAL::ARAP_deformation<Domain> d(Domain(points, block.tetrahedra));
    Options options = options_for(cells);
    options.tolerance = 1e-2;
    CHECK(d.set_options(options));
    const std::size_t n = points.size(), held = n * 6 / 100; // not whole rows, which hold it flat
    for(std::size_t v = held; v < n; ++v)
      d.insert_roi_vertex(v);
    for(std::size_t v = n - held; v < n; ++v)
    {
      d.insert_control_vertex(v);
      d.set_target_position(v, points[v] - CGAL::Vector_3<Kernel>(share * length, 0, 0));
    }
    const Report report = d.deform();
    CHECK(report.status == Status::converged && report.end == End::minimum);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    options.tolerance = 1e-5;
    CHECK(d.set_options(options));
    CHECK_AT_MOST(report.final_energy(), 1.02 * d.deform().final_energy());
  }
}

// A minimum is looked at and stays where it is, to the last bit.
void test_minimum()
{
  int number_of_minima = 0;
  for(const Shape& shape : shapes())
    for(const Cell_scheme& cells : {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims()})
    {
      test_case() = "minimum, " + shape.name;
      const Scenario s = scenario(shape);
      Options options = options_for(cells);
      const Run looked(shape, s, options);
      options.verify_minimum = false;
      const Run not_looked(shape, s, options);
      CHECK(looked.report.status == Status::converged);
      CHECK(looked.report.estimated_relative_gap <= options.tolerance);
      CHECK_AT_MOST(looked.report.final_energy(), not_looked.report.final_energy());
      if(looked.report.end != End::minimum || looked.report.saddles_left > 0 ||
         looked.report.plateaus_left > 0)
        continue;
      ++number_of_minima;
      CHECK(same_points(looked.mesh, not_looked.mesh));
      CHECK(looked.report.iterations ==
            not_looked.report.iterations + looked.report.looking_iterations);
    }
  CHECK(number_of_minima > 10);
}

// What a look tries is not shown: iterations that look show the iterate before once more. A run
// that is stopped there leaves that iterate, one that is cancelled no trace.
void test_trials(const Shape& shape, double share, const Options& options,
                 const std::vector<Mesh::Face_index>& control_points = {})
{
  test_case() = "trials " + shape.name;
  const Scenario s = push(shape, share);
  const Mesh first = make_mesh<Mesh>(shape);
  Mesh mesh = first;
  auto d = prepared(mesh, s, options);
  for(auto f : control_points)
    CHECK(d.insert_control_point(f, std::array{0.2, 0.3, 0.5}));
  const Deformation::State start = d.state();
  std::vector<Mesh> iterates;
  const Report report = d.deform([&](const auto& iterate) {
    CHECK(iterate.iteration() == iterates.size());
    iterates.push_back(first);
    iterate.put_points(iterates.back().points());
    return Visitor_action::proceed;
  });
  CHECK(report.status == Status::converged);
  CHECK(report.saddles_left + report.plateaus_left > 0);
  if(!CHECK(iterates.size() == report.iterations + 1))
    return;
  const auto looks = [&](unsigned int k) {
    return k > 0 && k < iterates.size() && same_points(iterates[k], iterates[k - 1]);
  };
  unsigned int number_of_looks = 0;
  for(unsigned int k = 1; k <= report.iterations; ++k)
  {
    number_of_looks += looks(k);
    if(!looks(k) || looks(k + 1)) // the last of a look, which are trials
      continue;
    for(const auto& [last, action] :
        {std::pair(k - 1, Visitor_action::cancel), std::pair(k, Visitor_action::stop)})
    {
      CHECK(d.restore(start));
      const Report ended = d.deform([last = last, action = action](const auto& iterate) {
        return iterate.iteration() < last ? Visitor_action::proceed : action;
      });
      CHECK(ended.iterations == last && ended.end == End::unknown);
      CHECK(ended.energy.back() == report.energy[last]);
      CHECK(same_points(mesh, action == Visitor_action::stop ? iterates[last] : first));
      // a look that found a saddle point, or comes after others that found the estimate wrong
      if(action == Visitor_action::stop &&
         ((report.plateaus_left == 0 && k < report.iterations) ||
          ended.saddles_left + ended.plateaus_left > 0))
        CHECK(ended.estimated_relative_gap > 1);
    }
  }
  CHECK(number_of_looks == report.looking_iterations);
}

void test_all_trials()
{
  Options options;
  options.cells = Cell_scheme::spokes();
  test_trials(strip(), 0.2, options); // from a saddle point
  test_trials(strip(), 0.2, options, {Mesh::Face_index(120), Mesh::Face_index(160)});
  const Tube tube{23, 11, 0.016, 6.7, 4.1, 0.21, Cell_scheme::spokes_and_rims(), 1e-3};
  options.cells = tube.cells;
  options.tolerance = tube.tolerance;
  test_trials(slit(tube), tube.share, options); // from plateaus
}

// A look is limited, and can be stopped and cancelled, as all iterations.
void test_visitor()
{
  test_case() = "visitor";
  const Shape shape = shapes()[5];
  const Scenario s = scenario(shape);
  Options options = options_for(Cell_scheme::spokes_and_rims());
  const Run whole(shape, s, options);
  const Report& report = whole.report;
  CHECK(report.looking_iterations > 3 && report.saddles_left == 0 && report.end == End::minimum);
  const unsigned int last = report.iterations - 2; // it looks there
  for(const Visitor_action action : {Visitor_action::stop, Visitor_action::cancel})
  {
    const Run run(shape, s, options, [&](const auto& iterate) {
      return iterate.iteration() == last ? action : Visitor_action::proceed;
    });
    CHECK(run.report.iterations == last && run.report.end == End::unknown);
    CHECK(run.report.status ==
          (action == Visitor_action::stop ? Status::stopped : Status::cancelled));
    CHECK(same_points(run.mesh, action == Visitor_action::stop ? whole.mesh
                                                               : make_mesh<Mesh>(shape)));
  }
  options.iterations = last;
  const Run limited(shape, s, options);
  CHECK(limited.report.status == Status::converged && limited.report.end == End::undecided);
  CHECK(limited.report.message.find("; it was not decided whether") != std::string::npos);
  CHECK_AT_MOST(limited.report.iterations, last);
  CHECK(same_points(limited.mesh, whole.mesh));
  // that end before, in, and after the look at a saddle point
  const Shape flat = strip();
  const Scenario pushed = push(flat, 0.2);
  options = options_for(Cell_scheme::spokes());
  const Run buckled(flat, pushed, options);
  int number_of_saddles = 0;
  for(unsigned int limit = 5; limit < buckled.report.iterations + 3; ++limit)
  {
    options.iterations = limit;
    const Report cut = Run(flat, pushed, options).report;
    CHECK_AT_MOST(cut.iterations, limit);
    if(cut.status == Status::iteration_limit)
    {
      CHECK(cut.end == End::unknown && cut.iterations + 1 >= limit);
      number_of_saddles += cut.iterations < limit && cut.saddles_left == 0;
      CHECK(cut.iterations == limit || cut.estimated_relative_gap > 1);
    }
    else // where the estimate was wrong once, it is looked at until it is known
      CHECK(cut.status == Status::converged &&
            (cut.saddles_left == 0 || cut.end == End::minimum));
  }
  CHECK(number_of_saddles > 0);
  options.iterations = buckled.report.iterations + 1;
  CHECK(Run(flat, pushed, options).report.end == End::minimum);
}

// To which side a flat strip buckles does not depend on the order of its vertices.
void test_order()
{
  const Shape first = strip();
  for(const Cell_scheme& cells : {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims()})
  {
    const Options options = options_for(cells);
    Shape shape = first;
    Scenario s = push(shape, 0.2);
    const Run reference(shape, s, options);
    std::vector<Mesh::Vertex_index> place; // of the vertices of the first order
    for(auto v : reference.mesh.vertices())
      place.push_back(v);
    double height = 0;
    for(auto v : reference.mesh.vertices())
      height = larger(height, std::abs(reference.mesh.point(v).z()));
    CHECK(height > 0.1);
    for(int k = 0; k < 4; ++k)
    {
      test_case() = "order of vertices " + std::to_string(k);
      std::vector<std::size_t> next;
      shape = shuffled(shape, next);
      s = shuffled(s, next);
      for(auto& v : place)
        v = Mesh::Vertex_index(static_cast<unsigned int>(next[v]));
      const Run run(shape, s, options);
      double distance = 0;
      for(auto v : reference.mesh.vertices())
        distance = larger(distance, std::sqrt(CGAL::squared_distance(reference.mesh.point(v),
                                                                     run.mesh.point(place[v]))));
      CHECK_AT_MOST(distance, 1e-4 * height);
    }
  }
}

// A flap that hangs on a stretched strip of elements turns about its hinge without any energy.
void test_hinge()
{
  test_case() = "hinge";
  const Shape shape =
    grid("strip", 12, 2, [](double u, double v) { return Eigen::Vector3d(4 * u, v, 0); });
  Scenario s = push(shape, 0);
  for(std::size_t v = 0; v < shape.points.size(); ++v)
  {
    const double x = shape.points[v].x();
    s.selection[v] = x < 0.25 ? 0 : std::abs(x - 2) < 0.2 ? 2 : 1;
    s.targets[v].x() += 0.2;
  }
  const Run run(shape, s, options_for(Cell_scheme::elements()));
  CHECK(run.report.status == Status::converged && run.report.end == End::undecided);
  CHECK(run.report.saddles_left == 0);
  CHECK_AT_MOST(run.report.looking_iterations, 150); // 200 would not decide it either
}

// what does not look, and what has nothing to look at
void test_unknown()
{
  test_case() = "unknown";
  const Shape shape = strip();
  const Scenario s = push(shape, 0.2);
  Options options = options_for(Cell_scheme::spokes(), Minimizer::local_global);
  CHECK(CGAL::ARAP::set_option(options, "verify_minimum", "false") && !options.verify_minimum);
  CHECK(CGAL::ARAP::set_option(options, "verify_minimum", "true") && options.verify_minimum);
  CHECK(!CGAL::ARAP::set_option(options, "verify_minimum", "1"));
  CHECK(Run(shape, s, options).report.end == End::unknown);
  options.minimizer = Minimizer::automatic;
  options.smoothing_length = 0.5;
  CHECK(Run(shape, s, options).report.end == End::unknown);
  options.smoothing_length = 0;
  const Run rest(shape, push(shape, 0), options); // nothing is pushed
  CHECK(rest.report.end == End::minimum && rest.report.looking_iterations == 0);
}

// the same to the last bit for any number of threads
void test_threads()
{
  test_case() = "threads";
  const Shape shape = strip(24); // several blocks of vertices
  Options options = options_for(Cell_scheme::spokes_and_rims());
  options.threads = 1;
  const Run one(shape, push(shape, 0.2), options);
  options.threads = 4;
  const Run four(shape, push(shape, 0.2), options);
  CHECK(one.report.saddles_left > 0);
  CHECK(one.report.energy == four.report.energy);
  CHECK(same_points(one.mesh, four.mesh));
}

void test_all()
{
  test_buckling();
  test_curved_valleys();
  test_soft_directions();
  test_plates();
  test_minimum();
  test_all_trials();
  test_visitor();
  test_order();
  test_hinge();
  test_unknown();
  test_threads();
}

} // namespace ends

int main()
{
  derivative::test_all();
  estimate::test_known_series();
  estimate::test_time();
  ends::test_all();
  return checks_result();
}
