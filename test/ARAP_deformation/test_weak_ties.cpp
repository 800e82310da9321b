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

// What hangs on weights so small that rounding errors of the others hide them: of all that a matrix
// knows of them nothing may be left, so that they could be flung anywhere. They stay near.

#include "include/check.h"
#include "include/domains.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using CGAL::ARAP::Options;
using CGAL::ARAP::Report;

// Two tetrahedra of the usual size, one of them without a volume, with a tiny one between them.
template <typename Traits>
void test_bridge(const std::string& solver)
{
  using Tetrahedra = std::vector<std::array<int, 4>>;
  using Domain = CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>, Tetrahedra>;
  const Tetrahedra tetrahedra = {{0, 1, 2, 3}, {4, 5, 6, 7}, {3, 4, 8, 9}};
  for(double height : {0.0, 1.0})
    for(double size = 1e-4; size > 1e-16; size /= 5)
      for_all_options([&](const Options& options) {
        for(unsigned int iterations : {1u, 3u, 30u, 300u})
        {
          test_case() = solver + ", a bridge of size " + std::to_string(std::log10(size)) +
                        ", height " + std::to_string(height);
          const std::vector<Eigen::Vector3d> rest = {
            {-1, 0, 0}, {-1, 1, 0}, {-1, 0, 1}, {0, 0, 0}, {size, 0, 0}, {1, 1, 0}, {1, 0, 1},
            {2, 1, 1 + height}, {0, size, 0}, {0, 0, size}};
          std::vector<Point> points = points_of(rest);
          CGAL::ARAP_deformation<Domain, Traits> d{Domain(points, tetrahedra)};
          d.set_options(options);
          for(std::size_t v = 0; v < points.size(); ++v)
            d.insert_roi_vertex(v);
          for(std::size_t v : {0, 1, 2})
            d.insert_control_vertex(v);
          d.translate(0, Eigen::Vector3d(0, 0, 0.5));
          d.translate(1, Eigen::Vector3d(0.3, 0, 0));
          const Report report = d.deform(iterations, 0);
          CHECK(report);
          CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
          CHECK_AT_MOST(largest_distance(points, points_of(rest)), 10.0);
        }
      });
}

// All that holds a sheet are pulls, down to nothing. Where they can be told from rounding errors
// the sheet follows them.
void test_pulls()
{
  for(double height : {0.0, 0.3})
    for(double weight = 1; weight > 1e-30; weight /= 30)
      for_all_options([&](const Options& options) {
        test_case() = "pulls of weight " + std::to_string(std::log10(weight)) + ", height " +
                      std::to_string(height);
        const Shape shape = grid("sheet", 7, 6, [height](double u, double v) {
          return Eigen::Vector3d(7 * u, 6 * v, height * std::sin(9 * u + 4 * v));
        });
        const Eigen::Vector3d shift(1, 2, 3);
        std::vector<Point> points = points_of(shape.points);
        using Domain =
          CGAL::ARAP::Polygon_soup_domain<std::vector<Point>, decltype(shape.triangles)>;
        CGAL::ARAP_deformation<Domain> d{Domain(points, shape.triangles)};
        d.set_options(options);
        for(std::size_t v = 0; v < points.size(); ++v)
        {
          d.insert_roi_vertex(v);
          if(v >= 7 && v + 7 < points.size())
            continue;
          d.insert_control_vertex(v);
          d.translate(v, shift);
          d.set_target_weight(v, weight);
        }
        const Report report = d.deform(300, 0);
        CHECK(report);
        CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
        CHECK_AT_MOST(largest_distance(points, points_of(shape.points)), 3 * shift.norm());
        if(weight >= 1e-12)
          CHECK_AT_MOST((vector(points[20]) - shape.points[20] - shift).norm(), 0.5 * shift.norm());
      });
}

int main()
{
  test_bridge<CGAL::ARAP_deformation_traits_3<>>("multifrontal");
  test_bridge<CGAL::ARAP_deformation_traits_3<CGAL::ARAP::Eigen_LDLT_solver>>("Eigen");
  test_pulls();
  return checks_result();
}
