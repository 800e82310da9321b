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

// What compilers get that do not have the vector extensions of g++ and clang.

#define CGAL_ARAP_NO_VECTOR_EXTENSIONS

#include "include/Single_precision_solver.h"
#include "include/check.h"
#include "include/conformance.h"
#include "include/domains.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/conformance/check_closest_rotation.h>
#include <CGAL/ARAP_deformation/conformance/check_sparse_solver.h>

#include <cmath>
#include <cstddef>

// all kernels of the energies, and of both minimizers
void test_deformation()
{
  const Shape shape = grid("sheet", 30, 20, [](double u, double v) {
    return Eigen::Vector3d(3 * u, 2 * v, 0.2 * std::sin(9 * u));
  });
  for(Cell_scheme cells : all_cell_schemes)
    for(double tolerance : {0.0, 1e-3})
    {
      Mesh mesh = make_mesh<Mesh>(shape);
      CGAL::ARAP_deformation<Mesh> deformation(mesh);
      CGAL::ARAP::Options options;
      options.cells = cells;
      CHECK(deformation.set_options(options));
      prepare(deformation, scenario(shape), all_vertices(mesh));
      const CGAL::ARAP::Report report = deformation.deform(300, tolerance);
      CHECK(CGAL::ARAP::succeeded(report.status));
      for(std::size_t k = 1; k < report.energy.size(); ++k)
        CHECK_AT_MOST(report.energy[k], report.energy[k - 1] + 1e-15 * report.energy_scale);
      CHECK(report.energy.back() < 0.9 * report.energy.front());
    }
}

int main()
{
  CHECK_CONFORMS(CGAL::ARAP::check_closest_rotation(CGAL::ARAP::Newton_closest_rotation()));
  CHECK_CONFORMS(CGAL::ARAP::check_sparse_solver(CGAL::ARAP::Multifrontal_cholesky_solver()));
  CHECK_CONFORMS(
    CGAL::ARAP::check_sparse_solver(Single_precision_solver(), 2e-2));
  test_deformation();
  return checks_result();
}
