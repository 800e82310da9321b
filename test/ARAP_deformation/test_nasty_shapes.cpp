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

// Shapes that are not clean, of a shelf and random ones, with handles of all kinds: a run either
// ends with finite points and an energy that never rises, but for rounding, or is refused with a
// sentence and changes nothing.
// usage: test_nasty_shapes [NUMBER_OF_RANDOM_SHAPES [FIRST_SEED]]

#include "include/check.h"
#include "include/nasty_shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/checks.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <vector>

using CGAL::ARAP::Minimizer;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;
using CGAL::ARAP::Status;

const double infinity = std::numeric_limits<double>::infinity();

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

std::vector<Handles> handles_for(const std::vector<Eigen::Vector3d>& points, bool is_solid)
{
  const Scenario s = scenario(Shape{"", points, {}}, 1.2);
  Eigen::AlignedBox3d box;
  for(const auto& p : points)
    box.extend(p);
  const double diameter = box.diagonal().norm();
  std::vector<Handles> all = {{"ends", {}}, {"soft ends", {}}, {"one held", {}}, {"all held", {}},
                              {"far away", {}}, {"all at one point", {}}, {"none", {}},
                              {"not a number", {}}};
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    all[3].handles.push_back({v, s.targets[v], infinity});
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
std::map<std::string, int>& ends() { static std::map<std::string, int> counts; return counts; }

bool are_finite(const Point& p)
{
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

// relative to the energy: with handles 10^5 diameters away a rounding error may be more than what
// the package takes for one
double largest_rise(const Report& report)
{
  double largest = 0;
  for(std::size_t k = 1; k < report.energy.size(); ++k)
    largest = (std::max)(largest, report.energy[k] / report.energy[k - 1] - 1);
  return largest;
}

// One run of a deformation in which vertices[k] is vertex k of the shape; point(v) is where it is.
template <typename Deformation, typename Vertices, typename PointOf>
void run(Deformation& deformation, const Vertices& vertices, const PointOf& point_of_vertex,
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
    deformation.insert_control_vertex(vertices[vertex]);
    CHECK(deformation.set_target_position(vertices[vertex], point(target)));
    CHECK(deformation.set_target_weight(vertices[vertex], weight));
  }
  const Report report = deformation.deform(25, options.tolerance);
  ++ends()[CGAL::ARAP::to_string(report.status)];
  if(!report)
  {
    CHECK(report.message.size() > 20);
    const bool is_expected = handles.name == "none" ? report.status == Status::no_held_vertex ||
                                                        report.status == Status::no_simplex
                           : handles.name == "not a number"
                               ? report.status == Status::non_finite_point : false;
    if(!CHECK(is_expected))
      std::cerr << "    " << report.message << std::endl;
    for(std::size_t k = 0; k < vertices.size(); ++k)
      CHECK(point_of_vertex(vertices[k]) == before[k]);
    return;
  }
  CHECK(handles.name != "none" && handles.name != "not a number");
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0 || largest_rise(report) <= 1e-9);
  for(double energy : report.energy)
    CHECK(energy >= -1e-9 * report.energy_scale);
  for(const auto& v : vertices)
    CHECK(are_finite(point_of_vertex(v)));
  for(const auto& [vertex, target, weight] : handles.handles)
    if(weight == infinity)
      CHECK(point_of_vertex(vertices[vertex]) == point(target));
  for(std::size_t part : report.unheld_parts)
    CHECK(point_of_vertex(vertices[part]) == before[part]);
  CHECK(report.unheld_parts.empty() ==
        (report.message.find("nothing holds") == std::string::npos));
}

template <std::size_t N, typename Function>
void for_each_case(const Nasty_shape<N>& shape, const Function& f)
{
  for(const Handles& handles : handles_for(shape.points, N == 4))
    for(Cell_scheme cells : all_cell_schemes)
      for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
      {
        test_case() = shape.name + ", handles: " + handles.name + ", " +
                      (minimizer == Minimizer::local_global ? "local/global" : "quasi-Newton") +
                      (cells == Cell_scheme::spokes() ? ", spokes" :
                       cells == Cell_scheme::elements() ? ", elements" : ", spokes and rims");
        Options options;
        options.cells = cells;
        options.minimizer = minimizer;
        f(handles, options);
      }
}

template <std::size_t N>
void test_as_ranges(const Nasty_shape<N>& shape)
{
  using Simplices = std::vector<std::array<std::size_t, N>>;
  using Domain = CGAL::ARAP::Simplex_soup_domain<int(N) - 1, std::vector<Point>, Simplices>;
  for_each_case(shape, [&](const Handles& handles, const Options& options) {
    std::vector<Point> points = points_of(shape.points);
    CGAL::ARAP_deformation<Domain> deformation(Domain(points, shape.simplices));
    run(deformation, numbers(points.size()), [&](std::size_t v) { return points[v]; }, handles,
        options);
  });
}

// the same in a mesh, if it can be one
void test_as_mesh(const Nasty_surface& shape)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  if(!PMP::is_polygon_soup_a_polygon_mesh(shape.simplices))
    return;
  for_each_case(shape, [&](const Handles& handles, const Options& options) {
    Mesh mesh = make_mesh<Mesh>(Shape{"", shape.points, shape.simplices});
    CGAL::ARAP_deformation<Mesh> deformation(mesh);
    run(deformation, all_vertices(mesh), [&](auto v) { return mesh.point(v); }, handles, options);
  });
}

int main(int argc, char* argv[])
{
  for(const Nasty_surface& shape : nasty_surfaces())
  {
    test_as_ranges(shape);
    test_as_mesh(shape);
  }
  for(const Nasty_volume& shape : nasty_volumes())
    test_as_ranges(shape);

  const int number_of_shapes = argc > 1 ? std::atoi(argv[1]) : 150;
  const int first_seed = argc > 2 ? std::atoi(argv[2]) : 1;
  for(int seed = first_seed; seed < first_seed + number_of_shapes; ++seed)
  {
    std::mt19937 random(static_cast<unsigned int>(seed));
    Nasty_surface surface = random_shape(sheet_of(5, 4), random);
    surface.name = "random surface, seed " + std::to_string(seed);
    test_as_ranges(surface);
    Nasty_volume volume = random_shape(block_of(2, 2, 1), random);
    volume.name = "random volume, seed " + std::to_string(seed);
    test_as_ranges(volume);
  }
  int sum = 0;
  for(const auto& [status, count] : ends())
  {
    std::cout << status << ": " << count << " runs" << std::endl;
    sum += count;
  }
  std::cout << sum << " runs in all" << std::endl;
  return checks_result();
}
