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

// Where runs end, with and without the look at the second derivative: how many of some hundred
// quasi-Newton runs with the default options end further above their minimum than the tolerance
// allows.

#include "include/deformations.h"
#include "include/run_benchmark.h"
#include "include/shapes.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace benchmark;
using Vector = Eigen::Vector3d;

// the largest connected component
Shape<3> read_shape(const std::string& name)
{
  Mesh mesh = read_mesh(CGAL::data_file_path("meshes/" + name));
  CGAL::Polygon_mesh_processing::keep_largest_connected_components(mesh, 1);
  mesh.collect_garbage();
  return surface(name, mesh);
}

// What is counted over runs with or without a look.
struct Counts
{
  int runs = 0, converged = 0, above = 0, ten_times_above = 0, two_percent_above = 0;
  unsigned int iterations = 0, looking_iterations = 0, moves = 0;
  double seconds = 0;
};

using Table = std::map<std::pair<std::string, bool>, Counts>;

// A twentieth of the vertices at each end of the longest axis is held; one end is moved, and in the
// last pose a vertex in the middle is pulled, too.
template <std::size_t N>
class Problem
{
public:
  static constexpr int number_of_poses = 5;

  Problem(const Shape<N>& shape, int pose, const ARAP::Options& options)
    : m_points(shape.points), m_deformation(typename Shape<N>::Domain(m_points, shape.simplices))
  {
    const Eigen::AlignedBox3d box = bounding_box(shape);
    int axis;
    const double length = box.sizes().maxCoeff(&axis);
    m_diagonal = box.diagonal().norm();
    std::vector<std::size_t> order(m_points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return m_points[a][axis] < m_points[b][axis];
    });
    const std::size_t n = order.size(), count = (std::max)(n / 20, std::size_t(3));
    const Vector along = Vector::Unit(axis), across = Vector::Unit((axis + 1) % 3);
    const auto turned = [&](double angle, const Vector& turning_axis, const Vector& shift) {
      return Eigen::Isometry3d(Eigen::Translation3d(box.center() + shift) *
                               Eigen::AngleAxisd(angle, turning_axis.normalized()) *
                               Eigen::Translation3d(-box.center()));
    };
    const Eigen::Isometry3d motion =
      pose == 0   ? turned(1.2, across, Vector::Zero())
      : pose == 1 ? turned(2.36, along, Vector::Zero())
      : pose == 2 ? turned(0, along, -0.3 * length * along)
      : pose == 3 ? turned(1.5, Vector(1, 2, 0.5), 0.2 * length * across)
                  : turned(0, along, length * (0.25 * across + 0.1 * along));
    expect_success(m_deformation.set_options(options));
    for(std::size_t k = count; k < n; ++k)
      m_deformation.insert_roi_vertex(order[k]);
    for(std::size_t k = n - count; k < n; ++k)
      m_targets.emplace_back(order[k], to_point(motion * to_vector(m_points[order[k]])));
    if(pose == 4)
      m_targets.emplace_back(order[n / 2], to_point(to_vector(m_points[order[n / 2]]) +
                                                    0.15 * m_diagonal * across));
    for(const auto& [v, target] : m_targets)
      m_deformation.insert_control_vertex(v);
    m_is_free.assign(n, true);
    for(std::size_t k = 0; k < count; ++k)
      m_is_free[order[k]] = false;
    for(const auto& target : m_targets)
      m_is_free[target.first] = false;
    expect_success(m_deformation.preprocess());
  }

  ARAP::Report run(double tolerance, bool is_looking)
  {
    m_deformation.reset();
    for(const auto& [v, target] : m_targets)
      m_deformation.set_target_position(v, target);
    ARAP::Options options = m_deformation.options();
    options.verify_minimum = is_looking;
    expect_success(m_deformation.set_options(options));
    const ARAP::Report report = m_deformation.deform(options.iterations, tolerance);
    expect_success(report);
    return report;
  }

  // The energy that the run would end at, had it gone on: a longer one, and another one after a
  // small smooth disturbance.
  double minimum_below()
  {
    const ARAP::Report longer = m_deformation.deform(1000, 1e-7);
    expect_success(longer);
    for(std::size_t v = 0; v < m_points.size(); ++v)
      if(m_is_free[v])
      {
        const Vector p = to_vector(m_points[v]) / m_diagonal;
        const Vector wave(std::sin(9 * p.y() + 7 * p.z()), std::sin(8 * p.z() + 6 * p.x() + 1),
                          std::sin(7 * p.x() + 9 * p.y() + 2));
        m_points[v] = to_point(to_vector(m_points[v]) + 1e-3 * m_diagonal * wave);
      }
    const ARAP::Report disturbed = m_deformation.deform(1000, 1e-7);
    expect_success(disturbed);
    return (std::min)(longer.final_energy(), disturbed.final_energy());
  }

private:
  std::vector<Point> m_points;
  CGAL::ARAP_deformation<typename Shape<N>::Domain> m_deformation;
  std::vector<std::pair<std::size_t, Point>> m_targets;
  std::vector<char> m_is_free;
  double m_diagonal = 0;
};

template <std::size_t N>
void measure(const Shape<N>& shape, Table& table)
{
  const std::pair<std::string, ARAP::Cell_scheme> schemes[] = {
    {"spokes", ARAP::Cell_scheme::spokes()},
    {"spokes and rims", ARAP::Cell_scheme::spokes_and_rims()},
    {"elements", ARAP::Cell_scheme::elements()}};
  for(const auto& [name, cells] : schemes)
    for(int pose = 0; pose < Problem<N>::number_of_poses; ++pose)
    {
      // surfaces of elements bend for nothing, and are a world of their own: few of them
      if(N == 3 && cells == ARAP::Cell_scheme::elements() && shape.points.size() > 1000)
        continue;
      ARAP::Options options;
      options.cells = cells;
      Problem<N> problem(shape, pose, options);
      for(const double tolerance : {1e-2, 1e-3})
        for(const bool is_looking : {false, true})
        {
          const ARAP::Report report = problem.run(tolerance, is_looking);
          const double minimum = problem.minimum_below();
          const double gap = (report.final_energy() - minimum) / minimum;
          Counts& counts = table[{name + (N == 3 ? ", surfaces" : ", tetrahedra"), is_looking}];
          ++counts.runs;
          counts.iterations += report.iterations;
          counts.looking_iterations += report.looking_iterations;
          counts.moves += report.saddles_left + report.plateaus_left;
          counts.seconds += report.seconds.total;
          if(report.status != ARAP::Status::converged ||
             report.final_energy() < 1e-9 * report.energy_scale) // next to zero
            continue;
          ++counts.converged;
          counts.above += gap > tolerance;
          counts.ten_times_above += gap > 10 * tolerance;
          counts.two_percent_above += gap > (std::max)(0.02, tolerance);
          if(gap > 2 * tolerance)
            std::cerr << shape.name << ", pose " << pose << ", " << name << ", " << tolerance
                      << (is_looking ? ", looked" : "") << ": " << gap << " above, "
                      << to_string(report.end) << std::endl;
        }
    }
}

Json run(const Settings& settings)
{
  Table table;
  const auto measure_mesh = [&](const std::string& name) { measure(read_shape(name), table); };
  const double pi = std::acos(-1.0);
  measure(sheet("strip", 60, 12, false, [](double u, double v) { return Vector(5 * u, v, 0); }),
          table);
  measure(block("bar", 24, 4, 4), table);
  measure_mesh("elephant.off");
  if(!settings.quick)
  {
    measure(sheet("plate", 40, 40, false, [](double u, double v) { return Vector(u, v, 0); }),
            table);
    measure(sheet("tube", 40, 60, true, [=](double u, double v) {
      return Vector(std::cos(2 * pi * u), std::sin(2 * pi * u), 10 * v);
    }), table);
    measure(sheet("gutter", 20, 80, false, [=](double u, double v) {
      return Vector(std::cos(pi * u), std::sin(pi * u), 10 * v);
    }), table);
    measure(block("plate of tetrahedra", 16, 16, 2), table);
    measure(block("cube", 8, 8, 8), table);
    for(const char* name : {"blade.off", "hand.off", "femur.off", "knot1.off", "bones.off",
                            "pig.off", "mushroom.off", "triceratops.off", "cylinder.off",
                            "sphere.off", "pipe.off", "head.off", "cow.off", "rotor.off",
                            "fandisk.off"})
      measure_mesh(name);
  }
  Json section = make_section(
    "Where quasi-Newton runs end",
    "Runs with the default options and the tolerances 1e-2 and 1e-3, in five poses, with and "
    "without a look at the second derivative; how many converged, to an energy that is not "
    "next to zero, and of these ended above the minimum that they would have reached by more than "
    "the tolerance, ten times as much, and two percent.",
    {{"cells", "cells"}, {"look", "look"}, {"runs", "runs"}, {"converged", "converged"},
     {"above", "above the tolerance"}, {"ten_times", "ten times"}, {"two_percent", "2 percent"},
     {"iterations", "iterations"}, {"looking", "of these looking"},
     {"moves", "saddle points and plateaus left"}, {"seconds", "seconds"}});
  for(const auto& [key, counts] : table)
    section["rows"].push_back(
      {{"cells", key.first}, {"look", key.second ? "yes" : "no"}, {"runs", counts.runs},
       {"converged", counts.converged}, {"above", counts.above},
       {"ten_times", counts.ten_times_above}, {"two_percent", counts.two_percent_above},
       {"iterations", counts.iterations}, {"looking", counts.looking_iterations},
       {"moves", counts.moves}, {"seconds", counts.seconds}});
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "ends",
                       "usage: ends [options]\n\n"
                       "Counts the quasi-Newton runs that end above their minimum. Takes some\n"
                       "minutes, or with --quick, on three shapes, some seconds.", run, {});
}
