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

// The iterates of the package and of a dense, slow reference agree, energies and positions, for each
// cell scheme, each weight, whole meshes and regions of interest.

#include "include/check.h"
#include "include/dense_reference.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using CGAL::ARAP::Cell_scheme;

template <typename Weight>
void compare(const Shape& shape, const Scenario& s, Cell_scheme cells,
             Dense_reference::Cells dense_cells, Dense_reference::Weights dense_weights)
{
  using Traits = CGAL::ARAP_deformation_traits_3<CGAL::Default, Weight>;
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh, Traits> deformation(mesh);
  CGAL::ARAP::Options options;
  options.cells = cells;
  CHECK(deformation.set_options(options));
  prepare(deformation, s, all_vertices(mesh));

  const Dense_reference reference(shape, s.selection, dense_cells, dense_weights);
  std::vector<Eigen::Vector3d> x = s.targets;
  const unsigned int iterations = 8;
  std::vector<double> energies = {reference.energy(x)};
  std::vector<std::vector<Eigen::Vector3d>> iterates = {x};
  for(unsigned int k = 0; k < iterations; ++k)
  {
    reference.iterate(x);
    energies.push_back(reference.energy(x));
    iterates.push_back(x);
  }

  const CGAL::ARAP::Report report = deformation.deform(iterations, 0, [&](const auto& iterate) {
    Mesh copy = mesh;
    iterate.put_points(copy.points());
    double error = 0;
    for(auto v : mesh.vertices())
      error = (std::max)(error, (vector(copy.point(v)) - iterates[iterate.iteration()][v]).norm());
    CHECK_AT_MOST(error, 1e-10 * shape.diameter());
    return CGAL::ARAP::Visitor_action::proceed;
  });
  CHECK(report.status == CGAL::ARAP::Status::iteration_limit);
  if(!CHECK(report.energy.size() == energies.size()))
    return;
  for(std::size_t k = 0; k < energies.size(); ++k)
    CHECK_AT_MOST(std::abs(report.energy[k] - energies[k]),
                  1e-10 * std::abs(energies[k]) + 1e-14 * report.energy_scale);
}

int main()
{
  const std::pair<Cell_scheme, Dense_reference::Cells> schemes[] = {
    {Cell_scheme::spokes(), Dense_reference::SPOKES},
    {Cell_scheme::spokes_and_rims(), Dense_reference::SPOKES_AND_RIMS},
    {Cell_scheme::elements(), Dense_reference::ELEMENTS}};
  for(const Shape& shape : shapes())
  {
    if(shape.points.size() > 180)
      continue;
    Scenario whole = scenario(shape, 0.6);
    for(int& status : whole.selection) // all but the handles: the region is the whole mesh
      if(status == 0)
        status = 2;
    for(const Scenario& s : {scenario(shape, 0.6), whole})
      for(const auto& [cells, dense_cells] : schemes)
      {
        test_case() = shape.name + ", cells " + std::to_string(dense_cells);
        compare<CGAL::ARAP::Safe_cotangent_weight>(shape, s, cells, dense_cells,
                                                   Dense_reference::SAFE);
        compare<CGAL::ARAP::Cotangent_weight>(shape, s, cells, dense_cells,
                                              Dense_reference::COTANGENT);
        compare<CGAL::ARAP::Uniform_weight>(shape, s, cells, dense_cells,
                                            Dense_reference::UNIFORM);
        if(dense_cells == Dense_reference::SPOKES) // with triangles a weight of zero may cut it off
          compare<CGAL::ARAP::Clamped_cotangent_weight>(shape, s, cells, dense_cells,
                                                        Dense_reference::CLAMPED);
      }
  }
  return checks_result();
}
