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

// Runs on shapes that are large enough for the coarse metric and the coarse start, with and without
// them.

#include "include/check.h"
#include "include/domains.h"
#include "include/length.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using CGAL::ARAP::Options;
using CGAL::ARAP::Report;
using Deformation = CGAL::ARAP_deformation<Mesh>;

struct Run
{
  Mesh mesh;
  Report report;

  Run(const Shape& shape, const Scenario& s, const Options& options)
    : mesh(make_mesh<Mesh>(shape))
  {
    auto d = prepared(mesh, s, options);
    report = d.deform();
    CHECK(report.status == CGAL::ARAP::Status::converged);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
  }
};

Shape sheet(int m, int n)
{
  return grid("sheet", m, n, [](double u, double v) {
    return Eigen::Vector3d(4 * u, 1.5 * v, 0.2 * std::sin(3 * v) + 0.1 * std::cos(9 * u));
  });
}

// the ends of a sheet, which are turned against each other and pushed together
Scenario twist(const Shape& shape, double angle)
{
  Scenario s{std::vector<int>(shape.points.size(), 1), shape.points};
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    if(const double x = shape.points[v].x(); x < 0.1)
      s.selection[v] = 0;
    else if(x > 3.9)
    {
      s.selection[v] = 2;
      s.targets[v] = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()) * shape.points[v] -
                     Eigen::Vector3d(0.8, 0, 0);
    }
  return s;
}

// what is run: in a short run, spokes
std::vector<Cell_scheme> schemes()
{
  std::vector<Cell_scheme> schemes = {Cell_scheme::spokes()};
  if(is_long_run())
    schemes.push_back(Cell_scheme::spokes_and_rims());
  return schemes;
}

// Runs with the coarse metric end no higher than without, in fewer iterations, and do not depend on
// the number of threads, nor on what the session has done before.
void test_runs()
{
  const Shape shape = sheet(270, 124);
  for(const Cell_scheme& cells : schemes())
  {
    test_case() = "runs";
    const Scenario s = twist(shape, 1.5);
    Options options = options_for(cells);
    options.tolerance = 1e-2;
    options.coarse_metric = false;
    const Run without(shape, s, options);
    options.coarse_metric = true;
    options.threads = 1;
    const Run with(shape, s, options);
    CHECK_AT_MOST(with.report.final_energy(), 1.01 * without.report.final_energy());
    CHECK_AT_MOST(with.report.iterations, 0.8 * without.report.iterations);
    if(cells != schemes().front())
      continue;
    options.threads = 3;
    const Run parallel(shape, s, options);
    CHECK(same_points(parallel.mesh, with.mesh) && parallel.report.energy == with.report.energy);
    if(!is_long_run())
      continue;

    Mesh mesh = make_mesh<Mesh>(shape);
    auto d = prepared(mesh, twist(shape, 0.5), options);
    CHECK(d.deform());
    d.reset();
    for(auto v : mesh.vertices())
      if(const Eigen::Vector3d& p = s.targets[v.idx()]; s.selection[v.idx()] == 2)
        d.set_target_position(v, Point(p.x(), p.y(), p.z()));
    const Report again = d.deform();
    CHECK(same_points(mesh, with.mesh) && again.energy == with.report.energy);
  }
}

// Refuses the systems of coarser surfaces.
struct Solver_of_large_systems : CGAL::ARAP::Multifrontal_cholesky_solver
{
  bool factorize(const CGAL::ARAP::Sparse_matrix& a)
  {
    return a.rows() > 10000 && CGAL::ARAP::Multifrontal_cholesky_solver::factorize(a);
  }
};

template <typename Solver = CGAL::Default>
Report course(const Shape& shape, const Scenario& s, const Options& options)
{
  Mesh mesh = make_mesh<Mesh>(shape);
  const Report report = prepared<CGAL::ARAP_deformation_traits<Solver>>(mesh, s, options).deform();
  CHECK(report.status == CGAL::ARAP::Status::converged ||
        report.status == CGAL::ARAP::Status::iteration_limit);
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
  return report;
}

// The first energy of a run, which is stopped then.
template <typename Solver = CGAL::Default>
double first_energy(const Shape& shape, const Scenario& s, const Options& options,
                    double weight = 0)
{
  Mesh mesh = make_mesh<Mesh>(shape);
  auto d = prepared<CGAL::ARAP_deformation_traits<Solver>>(mesh, s, options);
  if(weight > 0) // of a soft target
  {
    const Mesh::Vertex_index middle(static_cast<Mesh::size_type>(shape.points.size() / 2));
    d.insert_control_vertex(middle);
    CHECK(d.set_target_weight(middle, weight));
  }
  const Report report = d.deform([](const auto&) { return CGAL::ARAP::Visitor_action::stop; });
  CHECK(report.status == CGAL::ARAP::Status::stopped && report.iterations == 0);
  return report.final_energy();
}

double relative_difference(double a, double b) { return std::abs(a / b - 1); }

Options options_with_start(const Cell_scheme& cells, CGAL::ARAP::Initial_guess guess)
{
  Options options = options_for(cells, CGAL::ARAP::Minimizer::automatic, guess);
  options.bending_length = cells == Cell_scheme::spokes() ? 0.02 : 0;
  options.tolerance = 1e-2;
  options.threads = 1;
  return options;
}

// A run whose handles were torn away starts from a coarser surface: far below the guess by
// rotations, and it ends as low, in as few iterations. The number of threads does not matter, nor
// does the order of the vertices.
void test_starts()
{
  const Shape shape = sheet(200, 110);
  const Scenario s = twist(shape, 1.5);
  for(const Cell_scheme& cells : schemes())
  {
    test_case() = "starts";
    Options options = options_with_start(cells, CGAL::ARAP::Initial_guess::rotations);
    const Report without = course(shape, s, options);
    options.initial_guess = CGAL::ARAP::Initial_guess::automatic;
    const Report with = course(shape, s, options);
    CHECK_AT_MOST(with.energy.front(), 0.1 * without.energy.front());
    CHECK_AT_MOST(with.final_energy(), 1.01 * without.final_energy());
    const double low = 1.01 * (std::min)(with.final_energy(), without.final_energy());
    CHECK_AT_MOST(iterations_to(low, with), iterations_to(low, without));

    options.iterations = 20;
    const Report sequential = course(shape, s, options);
    CHECK(sequential.energy.front() == with.energy.front());
    options.threads = 3;
    CHECK(course(shape, s, options).final_energy() == sequential.final_energy());
    std::vector<std::size_t> place;
    const Shape other_shape = shuffled(shape, place);
    const Report in_other_order = course(other_shape, shuffled(s, place), options);
    CHECK_AT_MOST(relative_difference(in_other_order.energy.front(), sequential.energy.front()),
                  1e-6);
    CHECK_AT_MOST(relative_difference(in_other_order.final_energy(), sequential.final_energy()),
                  1e-4);
  }
}

// A coarser surface that is large starts from one that is coarser still.
void test_nested_starts()
{
  test_case() = "nested starts";
  const Shape shape = sheet(450, 260);
  const Scenario s = twist(shape, 1.5);
  Options options = options_with_start(Cell_scheme::spokes_and_rims(),
                                       CGAL::ARAP::Initial_guess::rotations);
  options.iterations = 20;
  const Report without = course(shape, s, options);
  options.initial_guess = CGAL::ARAP::Initial_guess::automatic;
  const Report with = course(shape, s, options);
  CHECK_AT_MOST(with.energy.front(), 0.1 * without.energy.front());
  CHECK_AT_MOST(with.final_energy(), without.final_energy());
  options.threads = 3;
  CHECK(course(shape, s, options).final_energy() == with.final_energy());
}

// Without a coarser surface a run starts where the guess by rotations does, but for rounding, as
// that is fitted once more where it is compared: with few iterations, with elements, with soft
// targets, where the solver refuses, and on a tube that is so thin that hardly anything is left of
// it.
void test_runs_without_start()
{
  // with the guess by rotations, and with the automatic one
  const auto first_energies = [](const Shape& shape, unsigned int iterations, const auto& energy_of,
                                 const Cell_scheme& cells = Cell_scheme::spokes_and_rims()) {
    const Scenario s = twist(shape, 1.5);
    Options options = options_with_start(cells, CGAL::ARAP::Initial_guess::rotations);
    options.iterations = iterations;
    const double of_rotations = energy_of(shape, s, options);
    options.initial_guess = CGAL::ARAP::Initial_guess::automatic;
    return std::pair(of_rotations, energy_of(shape, s, options));
  };
  const auto first_energies_agree = [&](const auto&... arguments) {
    const auto [of_rotations, automatic] = first_energies(arguments...);
    CHECK_AT_MOST(relative_difference(automatic, of_rotations), 1e-9);
  };
  const auto energy_of = [](const Shape& shape, const Scenario& s, const Options& options) {
    return first_energy(shape, s, options);
  };
  const Shape shape = sheet(200, 110);
  test_case() = "a run with a start";
  const auto [without_start, with_start] = first_energies(shape, 20, energy_of);
  CHECK_AT_MOST(with_start, 0.1 * without_start);
  test_case() = "few iterations";
  first_energies_agree(shape, 19, energy_of);
  test_case() = "elements";
  first_energies_agree(shape, 20, energy_of, Cell_scheme::elements());
  test_case() = "a soft target";
  first_energies_agree(shape, 20, [](const Shape& of, const Scenario& s, const Options& options) {
    return first_energy(of, s, options, 1);
  });
  test_case() = "a small part beside a large one, which nobody touches";
  {
    const Shape both = joined(shape, sheet(40, 15), {0, 5, 0});
    Scenario s = twist(both, 1.5);
    for(std::size_t v = 0; v < shape.points.size(); ++v)
    {
      s.selection[v] = (std::min)(s.selection[v], 1);
      s.targets[v] = shape.points[v];
    }
    Options options = options_with_start(Cell_scheme::spokes_and_rims(),
                                         CGAL::ARAP::Initial_guess::rotations);
    const double of_rotations = first_energy(both, s, options);
    options.initial_guess = CGAL::ARAP::Initial_guess::automatic;
    CHECK_AT_MOST(relative_difference(first_energy(both, s, options), of_rotations), 1e-9);
  }
  test_case() = "a solver that refuses";
  first_energies_agree(shape, 20, [](const Shape& of, const Scenario& s, const Options& options) {
    return first_energy<Solver_of_large_systems>(of, s, options);
  });
  Options options = options_for(Cell_scheme::spokes());
  options.iterations = 20;
  CHECK(course<Solver_of_large_systems>(shape, twist(shape, 1.5), options).status ==
        CGAL::ARAP::Status::iteration_limit);
  test_case() = "a thin tube";
  const double pi = std::acos(-1.0);
  first_energies_agree(grid("tube", 8000, 3, [pi](double u, double v) {
    return Eigen::Vector3d(4 * u, 0.001 * std::cos(2 * pi * v), 0.001 * std::sin(2 * pi * v));
  }, false, true), 20, energy_of);
}

int main()
{
  test_runs();
  test_starts();
  if(is_long_run())
    test_nested_starts();
  test_runs_without_start();
  return checks_result();
}
