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

// Naive Laplacian editing as the initial guess: the dense least-squares solution, not a step of
// the iteration, and a start from which the energy falls as well.

#include "include/Single_precision_solver.h"
#include "include/check.h"
#include "include/dense_reference.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <algorithm>
#include <string>
#include <vector>

using CGAL::ARAP::Cell_scheme;

double largest_distance(const Mesh& mesh, const std::vector<Eigen::Vector3d>& x)
{
  double distance = 0;
  for(auto v : mesh.vertices())
    distance = (std::max)(distance, (vector(mesh.point(v)) - x[v]).norm());
  return distance;
}

template <typename Solver>
void test()
{
  using Deformation =
    CGAL::ARAP_deformation<Mesh, CGAL::ARAP_deformation_traits_3<Solver>>;
  for(const Shape& shape : shapes())
    for(Cell_scheme cells :
        {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims(), Cell_scheme::elements()})
    {
      test_case() = shape.name;
      const Scenario s = scenario(shape, 0.5);
      const bool is_spokes = cells == Cell_scheme::spokes();
      // whatever the cells, L has the weights of stars
      std::vector<Dense_reference::Simplex> triangles;
      for(const auto& t : shape.triangles)
        triangles.emplace_back(t.begin(), t.end());
      const Dense_reference reference(shape.points, triangles, 2, s.selection,
                                      Dense_reference::SPOKES, Dense_reference::CLAMPED);
      std::vector<Eigen::Vector3d> x = s.targets, step = s.targets;
      reference.laplacian_guess(x);
      reference.iterate(step);

      Mesh mesh = make_mesh<Mesh>(shape);
      Deformation deformation(mesh);
      CGAL::ARAP::Options options;
      options.cells = cells;
      options.initial_guess = CGAL::ARAP::Initial_guess::laplacian;
      deformation.set_options(options);
      prepare(deformation, s, all_vertices(mesh));
      const auto report = deformation.deform(0, 0);
      CHECK(report.status == CGAL::ARAP::Status::iteration_limit);
      CHECK(report.energy.size() == 1);
      if(is_spokes)
        CHECK_AT_MOST(std::abs(report.energy[0] - reference.energy(x)),
                      1e-8 * report.energy[0] + 1e-14 * report.energy_scale);
      CHECK_AT_MOST(largest_distance(mesh, x), 1e-8 * shape.diameter());
      if(shape.points.size() > 10) // with few free vertices they may agree
        CHECK(largest_distance(mesh, step) > 1e-4 * shape.diameter());

      // from there on as from any other start, again and again
      const auto run = deformation.deform(20, 0);
      CHECK(run.energy.size() == 21);
      CHECK(CGAL::ARAP::first_rise_of_energy(run) == 0);
      CHECK_AT_MOST(std::abs(run.energy[0] - report.energy[0]),
                    1e-8 * report.energy[0] + 1e-14 * report.energy_scale);
    }
}

int main()
{
  test<CGAL::ARAP::Multifrontal_cholesky_solver>();
  test<Single_precision_solver>();
  return checks_result();
}
