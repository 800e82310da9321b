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

// Runs on shapes that are large enough for the coarse metric and for a coarse run to start with,
// with these and without.

#include "include/check.h"
#include "include/domains.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <string>
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
    Deformation d(mesh);
    CHECK(d.set_options(options));
    prepare(d, s, all_vertices(mesh));
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

// Runs with the coarse metric end no higher than without, in fewer iterations, and do not depend on
// the number of threads, nor on what the session has done before.
void test_runs()
{
  const Shape shape = sheet(270, 124);
  for(const Cell_scheme& cells : {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims()})
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
    if(cells == Cell_scheme::spokes())
      continue;
    options.threads = 3;
    const Run parallel(shape, s, options);
    CHECK(same_points(parallel.mesh, with.mesh) && parallel.report.energy == with.report.energy);

    Mesh mesh = make_mesh<Mesh>(shape);
    Deformation d(mesh);
    CHECK(d.set_options(options));
    prepare(d, twist(shape, 0.5), all_vertices(mesh));
    CHECK(d.deform());
    d.reset();
    for(auto v : mesh.vertices())
      if(const Eigen::Vector3d& p = s.targets[v.idx()]; s.selection[v.idx()] == 2)
        d.set_target_position(v, Point(p.x(), p.y(), p.z()));
    const Report again = d.deform();
    CHECK(same_points(mesh, with.mesh) && again.energy == with.report.energy);
  }
}

// The first energy of a run and the last one, and its iterations.
struct Course
{
  double first, last;
  unsigned int iterations;

  Course(const Shape& shape, const Scenario& s, const Options& options, double weight = 0)
  {
    Mesh mesh = make_mesh<Mesh>(shape);
    Deformation d(mesh);
    CHECK(d.set_options(options));
    prepare(d, s, all_vertices(mesh));
    if(weight > 0) // of a soft target
    {
      const Mesh::Vertex_index middle(static_cast<Mesh::size_type>(shape.points.size() / 2));
      d.insert_control_vertex(middle);
      CHECK(d.set_target_weight(middle, weight));
    }
    const Report report = d.deform();
    CHECK(report.status == CGAL::ARAP::Status::converged ||
          report.status == CGAL::ARAP::Status::iteration_limit);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    first = report.energy.front();
    last = report.final_energy();
    iterations = report.iterations;
  }
};

// A run whose handles were torn away starts with a coarse run after the guess by rotations. It does
// not depend on the number of threads. With few iterations or with soft targets there is none.
void test_starts()
{
  const Shape shape = sheet(200, 110);
  const Scenario s = twist(shape, 1.5);
  for(const Cell_scheme& cells :
      {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims(), Cell_scheme::elements()})
  {
    test_case() = "starts";
    Options options = options_for(cells, CGAL::ARAP::Minimizer::automatic,
                                  CGAL::ARAP::Initial_guess::automatic);
    options.bending_length = cells == Cell_scheme::spokes() ? 0.02 : 0;
    options.tolerance = 1e-2;
    options.threads = 1;
    if(cells == Cell_scheme::elements()) // these bend without energy: the end is far away
      options.iterations = 100;
    Options changed = options;
    changed.initial_guess = CGAL::ARAP::Initial_guess::rotations;
    const Course without(shape, s, changed);
    const Course with(shape, s, options);
    CHECK_AT_MOST(with.first, 0.1 * without.first);
    CHECK_AT_MOST(with.last, 1.01 * without.last);
    CHECK_AT_MOST(with.iterations, 1.1 * without.iterations);

    changed = options;
    changed.threads = 3;
    changed.iterations = 20;
    const Course parallel(shape, s, changed);
    changed.threads = 1;
    CHECK(Course(shape, s, changed).last == parallel.last);
    changed.iterations = 19; // the guess by rotations, but for rounding: it is found by another way
    CHECK_AT_MOST(std::abs(Course(shape, s, changed).first / without.first - 1), 1e-9);
    if(cells == Cell_scheme::spokes())
    {
      changed.iterations = 20;
      changed.initial_guess = CGAL::ARAP::Initial_guess::rotations;
      const double first = Course(shape, s, changed, 1).first;
      changed.initial_guess = CGAL::ARAP::Initial_guess::automatic;
      CHECK_AT_MOST(std::abs(Course(shape, s, changed, 1).first / first - 1), 1e-9);
    }
  }
}

int main()
{
  test_runs();
  test_starts();
  return checks_result();
}
