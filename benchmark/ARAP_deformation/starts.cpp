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

// How low runs end from the rest shape, whose handles are then torn away, and how soon they are
// there: with the default options, from the rest shape itself, without the coarse start, and
// without the coarse metric.

#include "include/deformations.h"
#include "include/run_benchmark.h"
#include "include/shapes.h"

#include <CGAL/Side_of_triangle_mesh.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace benchmark;

struct Sample
{
  unsigned int iteration;
  double seconds, energy;
};

struct Run
{
  double preprocess_seconds;
  ARAP::Report report;
  std::vector<Sample> samples; // of all iterates
};

// A run from the rest shape, with one end fixed and the other turned; in the middle all is free. By
// a new object, so that what a first run prepares counts for each.
template <std::size_t N>
Run run_from_rest(const Shape<N>& shape, const ARAP::Options& options, bool is_soft)
{
  std::vector<Point> points = shape.points;
  const Stopwatch preprocess_stopwatch;
  CGAL::ARAP_deformation<typename Shape<N>::Domain> deformation(
    typename Shape<N>::Domain(points, shape.simplices));
  expect_success(deformation.set_options(options));
  const Twist twist(bounding_box(shape));
  std::vector<std::pair<std::size_t, Point>> targets;
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    deformation.insert_roi_vertex(v);
    if(const auto p = to_vector(points[v]); twist.is_fixed(p) || twist.is_handle(p))
      targets.emplace_back(v, to_point(twist.target(p)));
  }
  for(const auto& target : targets)
  {
    deformation.insert_control_vertex(target.first);
    if(is_soft)
      expect_success(deformation.set_target_weight(target.first, 10));
  }
  expect_success(deformation.preprocess());
  Run run = {preprocess_stopwatch.seconds(), {}, {}};
  for(const auto& [v, target] : targets)
    deformation.set_target_position(v, target);
  const Stopwatch stopwatch;
  run.report = deformation.deform(options.iterations, options.tolerance, [&](const auto& iterate) {
    run.samples.push_back({iterate.iteration(), stopwatch.seconds(), iterate.energy()});
    return ARAP::Visitor_action::proceed;
  });
  expect_success(run.report);
  return run;
}

struct Kind
{
  std::string name = "spokes";
  ARAP::Cell_scheme cells = ARAP::Cell_scheme::spokes();
  bool is_soft = false;
  double bending = 0; // of the diagonal of the bounding box
};

// Where that is known, the times are also given in iterations of CGAL's class.
template <std::size_t N>
void measure(const Shape<N>& shape, const Kind& kind, Json& section, double cgal_seconds = 0)
{
  ARAP::Options options;
  options.cells = kind.cells;
  options.bending_length = kind.bending * bounding_box(shape).diagonal().norm();
  options.iterations = 2000;

  struct Start
  {
    std::string name;
    ARAP::Initial_guess guess;
    bool has_coarse_metric;
  };
  std::vector<Start> starts = {{"default", ARAP::Initial_guess::automatic, true},
                               {"rest shape", ARAP::Initial_guess::previous, true}};
  if(N == 3 && !kind.is_soft && kind.cells.has_vertex_cells() &&
     shape.points.size() > 20000) // where it would have one
    starts.push_back({"default, no coarse start", ARAP::Initial_guess::rotations, true});
  // the same; the largest takes too long without
  if(shape.points.size() > 30000 && shape.points.size() < 500000)
    starts.push_back({"default, no coarse metric", ARAP::Initial_guess::automatic, false});
  const auto run = [&](const Start& start, double tolerance) {
    ARAP::Options chosen = options;
    chosen.initial_guess = start.guess;
    chosen.coarse_metric = start.has_coarse_metric;
    chosen.tolerance = tolerance;
    return run_from_rest(shape, chosen, kind.is_soft);
  };
  std::vector<Run> long_runs;
  double lowest = std::numeric_limits<double>::infinity();
  for(const Start& start : starts)
  {
    long_runs.push_back(run(start, 1e-6));
    lowest = (std::min)(lowest, long_runs.back().report.final_energy());
  }
  for(std::size_t k = 0; k < starts.size(); ++k)
  {
    const Start& start = starts[k];
    const Run& long_run = long_runs[k];
    const ARAP::Report report = run(start, options.tolerance).report;
    Json row = {{"shape", shape.name}, {"kind", kind.name}, {"vertices", shape.points.size()},
                {"start", start.name}, {"preprocess", long_run.preprocess_seconds},
                {"energy", long_run.report.final_energy()}, {"lowest", lowest},
                {"tolerance_iterations", report.iterations},
                {"tolerance_seconds", report.seconds.total},
                {"estimated_gap", report.estimated_relative_gap},
                {"true_gap", report.final_energy() / lowest - 1}};
    for(const Sample& s : long_run.samples)
      if(s.energy <= (1 + 1e-3) * lowest)
      {
        row["iterations"] = s.iteration;
        row["seconds"] = s.seconds;
        if(cgal_seconds > 0) // of an iteration
          row["cgal_iterations"] = (long_run.preprocess_seconds + s.seconds) / cgal_seconds;
        break;
      }
    section["rows"].push_back(row);
    Json curve = Json::array();
    for(const Sample& s : long_run.samples)
      curve.push_back({s.seconds, s.energy / lowest - 1});
    section["curves"][shape.name + ", " + kind.name + ", " +
                      std::to_string(shape.points.size())][start.name] = curve;
  }
  std::cerr << shape.name << ", " << kind.name << ", " << shape.points.size() << std::endl;
}

// on that mesh; its handles are not those of the other runs, but do not matter for the time
double seconds_of_a_cgal_iteration(const Mesh& mesh)
{
  constexpr unsigned int iterations = 5;
  const Scenario scenario = make_scenario(mesh);
  Cgal_deformation<CGAL::ORIGINAL_ARAP> cgal(scenario);
  cgal.run(1);
  return cgal.proceed(iterations) / iterations;
}

// cubes inside a surface: so many along the longest side of its bounding box
Shape<4> volume(const std::string& name, const Mesh& mesh, int cubes)
{
  const Eigen::AlignedBox3d box = bounding_box(mesh);
  const double size = box.sizes().maxCoeff() / cubes;
  const Eigen::Vector3i n = (box.sizes() / size).array().ceil().cast<int>();
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(mesh);
  return block(name, n[0], n[1], n[2], [&](int x, int y, int z) {
    const Eigen::Vector3d middle = box.min() + size * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
    return side(to_point(middle)) == CGAL::ON_BOUNDED_SIDE;
  });
}

Json run(const Settings& settings)
{
  Json section = make_section(
    "Where runs from the rest shape end",
    "One end of each shape is fixed, the other turned by 1.5 rad. Iterations and seconds until the "
    "energy is within 1e-3 of the lowest that any run with a tolerance of 1e-6 found, if it comes "
    "there; then a run with the default tolerance of 1e-3: its length, and the gap that it "
    "estimates beside the true one. All times without preprocessing, but for those in iterations "
    "of CGAL's class, which are from construction to 1e-3.",
    {{"shape", "shape"}, {"kind", "energy"}, {"vertices", "vertices"}, {"start", "from"},
     {"preprocess", "preprocessing [s]"}, {"lowest", "lowest energy"}, {"energy", "energy"},
     {"iterations", "iterations to 1e-3"}, {"seconds", "seconds"},
     {"cgal_iterations", "in CGAL's iterations"},
     {"tolerance_iterations", "iterations of the run"}, {"tolerance_seconds", "seconds of the run"},
     {"estimated_gap", "estimated gap"}, {"true_gap", "true gap"}});
  const Kind spokes, rims = {"spokes and rims", ARAP::Cell_scheme::spokes_and_rims()},
             elements = {"elements", ARAP::Cell_scheme::elements()};
  const Kind soft = {"spokes, soft targets", spokes.cells, true},
             bending = {"spokes, bending", spokes.cells, false, 0.01};
  const double pi = std::acos(-1.0);
  const auto bar = [=](double u, double v) {
    return Eigen::Vector3d(std::cos(2 * pi * u), std::sin(2 * pi * u), 10 * v);
  };

  measure(sheet("tube", 40, 60, true, bar), spokes, section);
  measure(block("bar of tetrahedra", 30, 6, 6), elements, section);
  if(settings.quick)
    return section;
  const Mesh armadillo = read_mesh(CGAL::data_file_path("meshes/armadillo.off"));
  for(std::size_t parts : {1u, 2u, 4u, 6u})
  {
    const Mesh mesh = subdivided(armadillo, parts);
    measure(surface("armadillo", mesh), spokes, section, seconds_of_a_cgal_iteration(mesh));
  }
  for(const Kind& kind : {rims, elements, soft, bending})
    measure(surface("armadillo", armadillo), kind, section);
  for(const Kind& kind : {spokes, rims})
  {
    measure(surface("cactus", read_mesh(CGAL::data_file_path("meshes/cactus.off"))), kind, section);
    measure(sheet("tube", 160, 240, true, bar), kind, section);
  }
  for(const Kind& kind : {spokes, elements})
  {
    measure(block("bar of tetrahedra", 60, 15, 15), kind, section);
    measure(volume("armadillo of tetrahedra", armadillo, 60), kind, section);
  }
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "starts",
                       "usage: starts [options]\n\n"
                       "Measures how low runs end from the rest shape, and how soon. Takes some\n"
                       "minutes, or with --quick, on two small shapes, some seconds.", run, {});
}
