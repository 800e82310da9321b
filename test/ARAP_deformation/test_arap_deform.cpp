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

// The function arap_deform() and its named parameters: the same as the class.

#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/arap_deform.h>

#include <boost/property_map/property_map.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

using Vertex = Mesh::Vertex_index;
using CGAL::ARAP::Status;
namespace params = CGAL::parameters;

// Keeps a count: it must be called itself, and not a copy.
struct Counter
{
  int count = 0;

  template <typename Iterate>
  CGAL::ARAP::Visitor_action operator()(const Iterate& iterate)
  {
    ++count;
    return iterate.iteration() == 4 ? CGAL::ARAP::Visitor_action::stop
                                    : CGAL::ARAP::Visitor_action::proceed;
  }
};

int main()
{
  const Shape shape = grid("sheet", 10, 5, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0.2 * u * u);
  });
  Scenario s = scenario(shape);
  for(int& status : s.selection) // a function call constrains all that does not move
    if(status == 0)
      status = 2;
  const Mesh rest = make_mesh<Mesh>(shape);
  std::map<Vertex, bool> is_constrained;
  std::map<Vertex, Point> targets;
  for(Vertex v : rest.vertices())
  {
    is_constrained[v] = s.selection[v] == 2;
    if(is_constrained[v])
      targets[v] = point(s.targets[v]);
  }
  const auto constrained_map = boost::make_assoc_property_map(is_constrained);
  const auto target_map = boost::make_assoc_property_map(targets);
  CGAL::ARAP::Options options;
  options.cells = CGAL::ARAP::Cell_scheme::spokes();
  options.tolerance = 0;
  options.iterations = 12;

  const auto by_class = [&](auto traits, unsigned int iterations) {
    Mesh mesh = rest;
    CGAL::ARAP_deformation<Mesh, decltype(traits)> d(mesh, traits);
    prepare(d, s, all_vertices(mesh));
    // in the order of the function: the positions depend on it by rounding
    CHECK(d.set_options(options));
    CHECK(d.deform(iterations, 0));
    return mesh;
  };
  const CGAL::ARAP_deformation_traits_3<> traits;

  Mesh mesh = rest;
  auto report = CGAL::arap_deform(mesh, constrained_map, target_map, options);
  CHECK(report.iterations == 12);
  CHECK(same_points(mesh, by_class(traits, 12)));

  test_case() = "number_of_iterations";
  mesh = rest;
  report = CGAL::arap_deform(mesh, constrained_map, target_map, options,
                             params::number_of_iterations(4u));
  CHECK(report.iterations == 4);
  CHECK(same_points(mesh, by_class(traits, 4)));

  test_case() = "weight_calculator and sparse_linear_solver";
  mesh = rest;
  CHECK(CGAL::arap_deform(mesh, constrained_map, target_map, options,
                          params::weight_calculator(CGAL::ARAP::Uniform_weight())
                            .sparse_linear_solver(CGAL::ARAP::Multifrontal_cholesky_solver())));
  const CGAL::ARAP_deformation_traits_3<CGAL::Default, CGAL::ARAP::Uniform_weight> uniform;
  CHECK(same_points(mesh, by_class(uniform, 12)));

  test_case() = "visitor";
  mesh = rest;
  Counter counter;
  report = CGAL::arap_deform(mesh, constrained_map, target_map, options,
                             params::visitor(std::ref(counter)));
  CHECK(report.status == Status::stopped);
  CHECK(counter.count == 5);
  CHECK(same_points(mesh, by_class(traits, 4)));

  test_case() = "vertex_point_map and vertex_index_map";
  mesh = rest;
  std::map<Vertex, Point> points;
  std::map<Vertex, int> indices;
  for(Vertex v : mesh.vertices())
  {
    points[v] = mesh.point(v);
    indices[v] = int(mesh.number_of_vertices() - 1 - v);
  }
  CHECK(CGAL::arap_deform(mesh, constrained_map, target_map, options,
                          params::vertex_point_map(boost::make_assoc_property_map(points))
                            .vertex_index_map(boost::make_assoc_property_map(indices))));
  CHECK(same_points(mesh, rest));
  for(Vertex v : mesh.vertices())
    mesh.point(v) = points[v];
  CHECK(same_points(mesh, by_class(traits, 12)));

  test_case() = "default options";
  mesh = rest;
  report = CGAL::arap_deform(mesh, constrained_map, target_map);
  CHECK(report);
  CHECK(report.energy.back() < report.energy.front());

  test_case() = "failures";
  mesh = rest;
  options.tolerance = -1;
  CHECK(CGAL::arap_deform(mesh, constrained_map, target_map, options).status ==
        Status::invalid_option);
  for(auto& [v, constrained] : is_constrained)
    constrained = false;
  CHECK(CGAL::arap_deform(mesh, constrained_map, target_map).status == Status::no_fixed_vertex);
  CHECK(same_points(mesh, rest));
  return checks_result();
}
