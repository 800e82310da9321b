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

// Iterates and energies against the dense reference: triangles, polygons and tetrahedra, whole
// shapes and regions of interest, each cell scheme with each weight, hard and soft targets.

#include "include/dense_reference.h"
#include "include/domains.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation_traits_3.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using Simplices = std::vector<Dense_reference::Simplex>;

template <int Dimension, typename Weight>
void compare(const std::vector<Eigen::Vector3d>& rest, const Simplices& simplices,
             double diameter, const Scenario& s, Cell_scheme cells,
             Dense_reference::Cells dense_cells, Dense_reference::Weights dense_weights,
             bool is_soft)
{
  using Domain = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;
  using Traits = CGAL::ARAP_deformation_traits_3<CGAL::Default, Weight>;
  std::vector<Point> points = points_of(rest);
  CGAL::ARAP_deformation<Domain, Traits> deformation(Domain(points, simplices));
  CGAL::ARAP::Options options;
  options.cells = cells;
  CHECK(deformation.set_options(options));
  prepare(deformation, s, numbers(points.size()));

  // of the handles every other one; what is not in the region remains fixed
  std::vector<std::size_t> soft;
  std::vector<int> selection = s.selection;
  std::vector<Eigen::Vector3d> x = s.targets;
  const auto weight = [](std::size_t v) { return 0.1 + double(v % 4); };
  int number_of_handles = 0;
  for(std::size_t v = 0; v < rest.size(); ++v)
    if(is_soft && selection[v] == 2 && number_of_handles++ % 2 == 0)
    {
      soft.push_back(v);
      selection[v] = 1;
      x[v] = rest[v];
      CHECK(deformation.set_target_weight(v, weight(v)));
    }
  CHECK(is_soft == !soft.empty());
  Dense_reference reference(rest, simplices, Dimension, selection, dense_cells, dense_weights);
  for(std::size_t v : soft)
    reference.add_soft_position(v, weight(v), s.targets[v]);
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
    std::vector<Point> copy = points;
    iterate.put_points(boost::make_iterator_property_map(
      copy.begin(), boost::typed_identity_property_map<std::size_t>()));
    double error = 0;
    for(std::size_t v = 0; v < copy.size(); ++v)
      error = larger(error, (vector(copy[v]) - iterates[iterate.iteration()][v]).norm());
    CHECK_AT_MOST(error, 1e-10 * diameter);
    return CGAL::ARAP::Visitor_action::proceed;
  });
  CHECK(report.status == CGAL::ARAP::Status::iteration_limit);
  if(!CHECK(report.energy.size() == energies.size()))
    return;
  for(std::size_t k = 0; k < energies.size(); ++k)
    CHECK_AT_MOST(std::abs(report.energy[k] - energies[k]),
                  1e-10 * std::abs(energies[k]) + 1e-14 * report.energy_scale);
}

template <int Dimension>
void compare_all(const std::string& name, const std::vector<Eigen::Vector3d>& points,
                 const Simplices& simplices, double diameter)
{
  const std::pair<Cell_scheme, Dense_reference::Cells> schemes[] = {
    {Cell_scheme::spokes(), Dense_reference::SPOKES},
    {Cell_scheme::spokes_and_rims(), Dense_reference::SPOKES_AND_RIMS},
    {Cell_scheme::elements(), Dense_reference::ELEMENTS}};
  const Scenario part = scenario(Shape{"", points, {}}, 0.6);
  Scenario whole = part;
  for(int& status : whole.selection) // all but the handles: the region is the whole shape
    if(status == 0)
      status = 2;
  const std::pair<Scenario, bool> cases[] = {
    {part, false}, {part, true}, {whole, false}, {whole, true}};
  for(const auto& [s, is_soft] : cases)
    for(const auto& [cells, dense_cells] : schemes)
    {
      test_case() = name + ", cells " + std::to_string(dense_cells);
      compare<Dimension, CGAL::ARAP::Safe_cotangent_weight>(
        points, simplices, diameter, s, cells, dense_cells, Dense_reference::SAFE, is_soft);
      compare<Dimension, CGAL::ARAP::Cotangent_weight>(
        points, simplices, diameter, s, cells, dense_cells, Dense_reference::COTANGENT, is_soft);
      compare<Dimension, CGAL::ARAP::Uniform_weight>(
        points, simplices, diameter, s, cells, dense_cells, Dense_reference::UNIFORM, is_soft);
      if(dense_cells == Dense_reference::SPOKES) // in a simplex a weight of zero may cut it off
        compare<Dimension, CGAL::ARAP::Clamped_cotangent_weight>(
          points, simplices, diameter, s, cells, dense_cells, Dense_reference::CLAMPED, is_soft);
    }
}

// a sheet of hexagons and quads, not flat
void test_polygons()
{
  std::vector<Eigen::Vector3d> points;
  const int n = 9, m = 8;
  for(int i = 0; i <= n; ++i)
    for(int j = 0; j <= m; ++j)
      points.emplace_back(0.3 * i + 0.05 * (j % 2), 0.25 * j,
                          0.1 * std::sin(i) * std::cos(0.7 * j));
  const auto vertex = [=](int i, int j) { return std::size_t(i * (m + 1) + j); };
  Simplices polygons;
  for(int i = 0; i < n; ++i)
    for(int j = 0; j < m; ++j)
      if(j % 3 == 2)
        polygons.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                            vertex(i, j + 1)});
      else if(j % 3 == 0 && j + 2 <= m)
        polygons.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                            vertex(i + 1, j + 2), vertex(i, j + 2), vertex(i, j + 1)});
  compare_all<2>("polygons", points, polygons, diameter_of(points));
}

int main()
{
  for(const Shape& shape : shapes())
  {
    if(shape.points.size() > 180)
      continue;
    Simplices triangles;
    for(const auto& t : shape.triangles)
      triangles.emplace_back(t.begin(), t.end());
    compare_all<2>(shape.name, shape.points, triangles, shape.diameter());
  }
  test_polygons();
  const Block solid = block(4, 2, 2);
  Simplices tetrahedra;
  for(const auto& t : solid.tetrahedra)
    tetrahedra.emplace_back(t.begin(), t.end());
  compare_all<3>("tetrahedra", solid.points, tetrahedra, solid.diameter());
  return checks_result();
}
