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

// Runs on shapes that are large enough for the coarse metric, with it and without.

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
  const Shape shape = grid("sheet", 270, 124, [](double u, double v) {
    return Eigen::Vector3d(4 * u, 1.5 * v, 0.2 * std::sin(3 * v) + 0.1 * std::cos(9 * u));
  });
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

int main()
{
  test_runs();
  return checks_result();
}
