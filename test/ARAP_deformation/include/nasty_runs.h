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

#ifndef CGAL_ARAP_DEFORMATION_TEST_NASTY_RUNS_H
#define CGAL_ARAP_DEFORMATION_TEST_NASTY_RUNS_H

// Runs of shapes that are not clean with handles of all kinds: a run either ends with finite points
// and an energy that never rises, but for rounding, or is refused with a sentence and changes
// nothing.

#include "length.h"
#include "nasty_shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <vector>

using CGAL::ARAP::Initial_guess;
using CGAL::ARAP::Minimizer;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;
using CGAL::ARAP::Status;

constexpr double infinity = std::numeric_limits<double>::infinity();

// what a user does to a shape
struct Handles
{
  struct Handle
  {
    std::size_t vertex;
    Eigen::Vector3d target;
    double weight;
  };

  std::string name;
  std::vector<Handle> handles;
};

inline std::vector<Handles> handles_for(const std::vector<Eigen::Vector3d>& points, bool is_solid)
{
  const Scenario s = scenario(Shape{"", points, {}}, 1.2);
  const double diameter = diameter_of(points);
  std::vector<Handles> all = {{"ends", {}}, {"soft ends", {}}, {"one fixed", {}}, {"all fixed", {}},
                              {"far away", {}}, {"all at one point", {}}, {"none", {}},
                              {"not a number", {}}, {"all but one fixed", {}}};
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    all[3].handles.push_back({v, s.targets[v], infinity});
    if(v != points.size() / 2)
      all[8].handles.push_back({v, s.targets[v], infinity});
    if(s.selection[v] == 1)
      continue;
    all[0].handles.push_back({v, s.targets[v], infinity});
    all[1].handles.push_back({v, s.targets[v], is_solid && diameter > 0 ? 0.5 * diameter : 0.5});
    if(all[2].handles.empty())
      all[2].handles.push_back({v, points[v] + diameter * Eigen::Vector3d(1, 0, 0), infinity});
    all[4].handles.push_back({v, s.targets[v] * (s.selection[v] == 2 ? 1e5 : 1), infinity});
    all[5].handles.push_back({v, points[0], infinity});
    all[7].handles.push_back({v, s.targets[v], infinity});
  }
  all[7].handles.back().target.y() = std::nan("");
  return all;
}

// how many runs ended how
inline std::map<std::string, int>& ends()
{
  static std::map<std::string, int> counts;
  return counts;
}

inline void print_ends()
{
  int sum = 0;
  for(const auto& [status, count] : ends())
  {
    std::cout << status << ": " << count << " runs" << std::endl;
    sum += count;
  }
  std::cout << sum << " runs in all" << std::endl;
}

// relative to the energy: with handles 10^5 diameters away a rounding error may be more than what
// the package takes for one
inline double largest_rise(const Report& report)
{
  double largest = 0;
  for(std::size_t k = 1; k < report.energy.size(); ++k)
    largest = larger(largest, report.energy[k] / report.energy[k - 1] - 1);
  return largest;
}

// One run of a deformation in which vertices[k] is vertex k of the shape; point(v) is where it is.
// Returns whether it was done.
template <typename Deformation, typename Vertices, typename PointOf>
bool run(Deformation& deformation, const Vertices& vertices, const PointOf& point_of_vertex,
         const Handles& handles, const Options& options)
{
  CHECK(deformation.set_options(options));
  std::vector<Point> before;
  for(const auto& v : vertices)
  {
    deformation.insert_roi_vertex(v);
    before.push_back(point_of_vertex(v));
  }
  for(const auto& [vertex, target, weight] : handles.handles)
  {
    for(int time = 0; time < 2; ++time) // the second one changes nothing
      CHECK(deformation.insert_control_vertex(vertices[vertex]) == (time == 0));
    CHECK(deformation.set_target_position(vertices[vertex], point_of<Deformation>(target, 0)));
    CHECK(deformation.set_target_weight(vertices[vertex], weight));
  }
  const Report report = deformation.deform(25, options.tolerance);
  ++ends()[CGAL::ARAP::to_string(report.status)];
  if(!report)
  {
    CHECK(report.message.size() > 20);
    const bool is_expected = handles.name == "none" ? report.status == Status::no_fixed_vertex ||
                                                        report.status == Status::no_simplex
                           : handles.name == "not a number"
                               ? report.status == Status::non_finite_point : false;
    if(!CHECK(is_expected))
      std::cerr << "    " << report.message << std::endl;
    for(std::size_t k = 0; k < vertices.size(); ++k)
      CHECK(point_of_vertex(vertices[k]) == before[k]);
    return false;
  }
  CHECK(handles.name != "none" && handles.name != "not a number");
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0 || largest_rise(report) <= 1e-9);
  for(double energy : report.energy)
    CHECK(energy >= -1e-9 * report.energy_scale);
  for(const auto& v : vertices)
    CHECK(is_finite_point(point_of_vertex(v)));
  for(const auto& [vertex, target, weight] : handles.handles)
    if(weight == infinity)
      CHECK(point_of_vertex(vertices[vertex]) == point(target));
  std::size_t unconstrained = 0;
  for(std::size_t k = 0; k < vertices.size(); ++k)
    if(std::binary_search(report.unconstrained_components.begin(),
                          report.unconstrained_components.end(),
                          deformation.domain().index(vertices[k])))
    {
      ++unconstrained;
      CHECK(point_of_vertex(vertices[k]) == before[k]);
    }
  CHECK(unconstrained == report.unconstrained_components.size());
  CHECK(report.unconstrained_components.empty() ==
        (report.message.find("unconstrained component") == std::string::npos));
  return true;
}

inline std::string name_of(const Options& options)
{
  std::string name = options.minimizer == Minimizer::local_global ? "local/global" : "quasi-Newton";
  if(options.initial_guess == Initial_guess::laplacian)
    name += ", Laplacian guess";
  if(options.cells == Cell_scheme::spokes())
    return name + ", spokes";
  if(options.cells.rings() > 0)
    return name + ", larger cells";
  return name + (options.cells == Cell_scheme::elements() ? ", elements" : ", spokes and rims");
}

// Calls f(handles, options) for all handles, cell schemes, minimizers and initial guesses.
template <std::size_t N, typename Function>
void for_each_case(const Nasty_shape<N>& shape, const std::string& structure, const Function& f)
{
  static Every_nth is_run(7);
  for(const Handles& handles : handles_for(shape.points, N == 4))
    for_all_options([&](const Options& options) {
      if(!is_run())
        return;
      test_case() = structure + ", " + shape.name + ", handles: " + handles.name + ", " +
                    name_of(options);
      f(handles, options);
    });
}

// Runs of a shape whose points are given to the vertices of a mesh or complex.
template <typename Domain, std::size_t N>
void test_in_place_of(const std::string& structure, const Domain& domain,
                      const std::vector<typename Domain::vertex_descriptor>& vertices,
                      const Nasty_shape<N>& shape)
{
  for_each_case(shape, structure, [&](const Handles& handles, const Options& options) {
    for(std::size_t k = 0; k < vertices.size(); ++k)
    {
      const Eigen::Vector3d& p = shape.points[k];
      domain.set_point(vertices[k], Domain::make_point({p.x(), p.y(), p.z()}));
    }
    CGAL::ARAP_deformation<Domain> deformation(domain);
    run(deformation, vertices, [&](auto v) {
      const auto c = Domain::coordinates(domain.point(v));
      return Point(c[0], c[1], c[2]);
    }, handles, options);
  });
}

// Calls f(shape) for all that can be stored in a data structure for halfedges.
template <typename Function>
void for_each_manifold(const Function& f)
{
  for(const Nasty_surface& shape : manifold(nasty_surfaces()))
    f(shape);
  for(const Nasty_polygons& shape : manifold(nasty_polygons()))
    f(shape);
}

template <typename Graph>
void test_shelf_as_graph(const std::string& structure)
{
  for_each_manifold([&](const auto& shape) {
    Graph mesh = make_mesh<Graph>(shape.points, shape.simplices);
    test_in_place_of(structure, CGAL::ARAP::Face_graph_domain<Graph>(mesh), all_vertices(mesh),
                     shape);
  });
}

#endif // CGAL_ARAP_DEFORMATION_TEST_NASTY_RUNS_H
