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

// Shapes that are not clean, of a shelf and random ones, as ranges.
// usage: test_nasty_shapes [NUMBER_OF_RANDOM_SHAPES [FIRST_SEED]]

#include "include/nasty_runs.h"

#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

template <int Dimension, std::size_t N>
void test_as_ranges(const Nasty_shape<N>& shape)
{
  using Simplices = std::vector<std::array<std::size_t, N>>;
  using Domain = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;
  const std::string structure = Dimension == 3 ? "tetrahedra" : N == 3 ? "triangles" : "polygons";
  for_each_case(shape, structure, [&](const Handles& handles, const Options& options) {
    std::vector<Point> points = points_of(shape.points);
    CGAL::ARAP_deformation<Domain> deformation(Domain(points, shape.simplices));
    run(deformation, numbers(points.size()), [&](std::size_t v) { return points[v]; }, handles,
        options);
  });
}

int main(int argc, char* argv[])
{
  for(const Nasty_surface& shape : nasty_surfaces())
    test_as_ranges<2>(shape);
  for(const Nasty_polygons& shape : nasty_polygons())
    test_as_ranges<2>(shape);
  for(const Nasty_volume& shape : nasty_volumes())
    test_as_ranges<3>(shape);

  const int number_of_shapes = argc > 1 ? std::atoi(argv[1]) : 150;
  const int first_seed = argc > 2 ? std::atoi(argv[2]) : 1;
  for(int seed = first_seed; seed < first_seed + number_of_shapes; ++seed)
  {
    std::mt19937 random(static_cast<unsigned int>(seed));
    Nasty_surface surface = random_shape(sheet_of(5, 4), random);
    surface.name = "random, seed " + std::to_string(seed);
    test_as_ranges<2>(surface);
    Nasty_volume volume = random_shape(block_of(2, 2, 1), random);
    volume.name = "random, seed " + std::to_string(seed);
    test_as_ranges<3>(volume);
  }
  print_ends();
  return checks_result();
}
