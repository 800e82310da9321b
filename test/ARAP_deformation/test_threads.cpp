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

// The results are the same to the last bit for any number of threads.

#include "include/check.h"
#include "include/domains.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/tags.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

// what is compared
struct Bits
{
  std::vector<double> energy;
  std::vector<Point> points;
};

template <int Dimension, typename ConcurrencyTag, typename Simplices>
Bits run(const std::vector<Eigen::Vector3d>& vectors, const Simplices& simplices,
         CGAL::ARAP::Options options, unsigned int threads)
{
  using Domain = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;
  using Traits = CGAL::ARAP_deformation_traits_3<CGAL::Default, CGAL::Default, CGAL::Default,
                                                 ConcurrencyTag>;
  Bits bits{{}, points_of(vectors)};
  CGAL::ARAP_deformation<Domain, Traits> deformation(Domain(bits.points, simplices));
  options.threads = threads;
  CHECK(deformation.set_options(options));
  prepare(deformation, scenario(Shape{"", vectors, {}}), numbers(vectors.size()));
  bits.energy = deformation.deform().energy;

  // once more with other control vertices
  deformation.erase_control_vertex(deformation.control_vertices().front());
  deformation.insert_control_vertex(vectors.size() / 2);
  const std::vector<double> energy = deformation.deform().energy;
  bits.energy.insert(bits.energy.end(), energy.begin(), energy.end());
  CHECK(bits.energy.size() > 4);
  return bits;
}

template <int Dimension, typename Simplices>
void test(const std::string& name, const std::vector<Eigen::Vector3d>& points,
          const Simplices& simplices)
{
  for(Cell_scheme cells : all_cell_schemes)
    for(double tolerance : {0.0, 1e-3}) // local/global and quasi-Newton
    {
      test_case() = name;
      CGAL::ARAP::Options options;
      options.cells = cells;
      options.iterations = 6;
      options.tolerance = tolerance;
      const Bits one = run<Dimension, CGAL::Sequential_tag>(points, simplices, options, 0);
      for(unsigned int threads : {0u, 1u, 2u, 3u, 8u})
      {
        const Bits many = run<Dimension, CGAL::Parallel_if_available_tag>(points, simplices,
                                                                          options, threads);
        CHECK(many.energy == one.energy);
        CHECK(many.points == one.points);
      }
    }
}

int main()
{
#ifdef CGAL_LINKED_WITH_TBB
  // more threads than there may be processors
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
#else
  std::cout << "TBB is not linked: there is one thread" << std::endl;
#endif
  const Shape sheet = grid("sheet", 110, 60, [](double u, double v) { // several blocks of each loop
    return Eigen::Vector3d(3 * u, 2 * v, 0.2 * std::sin(9 * u) * std::cos(7 * v));
  });
  test<2>("triangles", sheet.points, sheet.triangles);
  Polygons polygons;
  const Shape pipe = tube(polygons);
  test<2>("polygons", pipe.points, polygons);
  const Block solid = block(25, 10, 10);
  test<3>("tetrahedra", solid.points, solid.tetrahedra);
  return checks_result();
}
