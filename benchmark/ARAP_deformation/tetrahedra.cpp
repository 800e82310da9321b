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

// The time of an iteration and of preprocessing for tetrahedra, with one rotation each, compared
// with libigl if it is installed.

#include "include/deformations.h"
#include "include/iteration.h"
#include "include/run_benchmark.h"
#include "include/shapes.h"
#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
#include "include/libigl_deformation.h"
#endif

#include <cstddef>
#include <iostream>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using namespace benchmark;

// A bar with one end fixed and the other one turned.
struct Bar
{
  Shape<4> shape;
  std::vector<std::pair<std::size_t, Point>> targets;

  std::size_t number_of_vertices() const { return shape.points.size(); }
  double diagonal() const { return bounding_box(shape).diagonal().norm(); }
};

// Inner vertices are moved off the grid, so that no right angle makes a weight zero.
Bar make_bar(int nx, int ny, int nz)
{
  Bar bar{block("bar", nx, ny, nz), {}};
  std::mt19937 random(1);
  const auto moved = [&random](double x, int n) {
    const double shift = 0.2 * (static_cast<double>(random()) / 4294967295.0 - 0.5);
    return x == 0 || x == n ? x : x + shift;
  };
  for(Point& p : bar.shape.points)
  {
    const double x = moved(p.x(), nx), y = moved(p.y(), ny), z = moved(p.z(), nz);
    p = Point(x, y, z);
  }
  const Twist twist(bounding_box(bar.shape));
  for(std::size_t v = 0; v < bar.number_of_vertices(); ++v)
    if(const Eigen::Vector3d p = to_vector(bar.shape.points[v]);
       twist.is_fixed(p) || twist.is_handle(p))
      bar.targets.emplace_back(v, to_point(twist.target(p)));
  return bar;
}

template <typename Traits>
class Our_bar
{
public:
  Our_bar(const Bar& bar, const Traits& traits)
    : m_bar(bar), m_points(bar.shape.points),
      m_deformation(Shape<4>::Domain(m_points, bar.shape.simplices), traits)
  {
    ARAP::Options options;
    options.cells = ARAP::Cell_scheme::elements();
    options.initial_guess = ARAP::Initial_guess::previous; // as libigl
    expect_success(m_deformation.set_options(options));
    for(std::size_t v = 0; v < bar.number_of_vertices(); ++v)
      m_deformation.insert_roi_vertex(v);
    for(const auto& [v, target] : bar.targets)
      m_deformation.insert_control_vertex(v);
    expect_success(m_deformation.preprocess());
    m_preprocess_seconds = m_stopwatch.seconds();
  }

  double preprocess_seconds() const { return m_preprocess_seconds; }
  const std::vector<Point>& points() const { return m_points; }

  ARAP::Report run(unsigned int iterations)
  {
    restart(m_bar, m_deformation);
    ARAP::Report report = m_deformation.deform(iterations, 0);
    expect_success(report);
    for(std::size_t k = 1; k < report.energy.size(); ++k)
      verify_at_most(report.energy[k], report.energy[k - 1] * (1 + 1e-12),
                     "the energy after iteration " + std::to_string(k));
    return report;
  }

private:
  const Bar& m_bar;
  std::vector<Point> m_points;
  Stopwatch m_stopwatch; // starts before m_deformation is constructed
  CGAL::ARAP_deformation<Shape<4>::Domain, Traits> m_deformation;
  double m_preprocess_seconds = 0;
};

#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
// Fails unless the first iterates are the same; libigl fits rotations in single precision.
double verify_libigl(const Bar& bar, Libigl_deformation& libigl)
{
  Our_bar<CGAL::ARAP_deformation_traits<>> ours(bar, CGAL::ARAP_deformation_traits<>());
  ours.run(1);
  libigl.run(1);
  const double difference = largest_distance(ours.points(), libigl.points()) / bar.diagonal();
  verify_at_most(difference, 1e-3, "the largest difference between our first iterate and libigl's, "
                                   "relative to the bounding box,");
  return difference;
}
#endif

// Fails unless the iterates with each solver are those with the default one.
void verify_solvers(const Bar& bar)
{
  std::vector<Point> expected;
  for_each_solver<CGAL::Default>([&](const auto& traits, const char* name) {
    using Solver = std::decay_t<decltype(traits.sparse_solver_object())>;
    Our_bar deformation(bar, traits);
    deformation.run(5);
    if(expected.empty())
      expected = deformation.points(); // the default is the first
    verify_at_most(largest_distance(expected, deformation.points()) / bar.diagonal(),
                   std::is_same_v<Solver, Single_precision_solver> ? 1e-5 : 1e-8,
                   std::string("the largest difference of the iterates with the solver ") + name +
                   ", relative to the bounding box,");
  });
}

void compare(const Bar& bar, const Settings& settings, Json& rows)
{
  verify_solvers(bar);
  const unsigned int iterations = number_of_iterations(5 * bar.number_of_vertices());
  std::vector<std::pair<std::string, std::vector<Measurements>>> ours; // by solver and threads
  const std::vector<unsigned int> counts = thread_counts();
  Measurements libigl;
  double difference = 0;
  for(unsigned int repetition = 0; repetition < settings.few_repetitions; ++repetition)
  {
    std::size_t solver = 0;
    for_each_solver<CGAL::Default>([&](const auto& traits, const char* name) {
      if(repetition == 0)
        ours.emplace_back(name, std::vector<Measurements>(counts.size()));
      for(std::size_t k = 0; k < counts.size(); ++k)
      {
        const Thread_limit limit(counts[k]);
        Our_bar deformation(bar, traits);
        measure_ours(deformation, iterations, ours[solver].second[k]);
      }
      ++solver;
    });
#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
    const Libigl_scenario copy = libigl_scenario(bar.shape, bar.targets);
    Libigl_deformation deformation(copy, Libigl_energy::elements);
    if(repetition == 0)
      difference = verify_libigl(bar, deformation);
    measure_other(deformation.preprocess_seconds(),
                  [&](unsigned int n) { return deformation.run(n); }, iterations, libigl);
#endif
  }
  for(std::size_t k = 0; k < counts.size(); ++k)
    for(const auto& [name, by_threads] : ours)
    {
      const Measurements& measurements = by_threads[k];
      Json row = {{"vertices", bar.number_of_vertices()},
                  {"tetrahedra", bar.shape.simplices.size()},
                  {"solver", name},
                  {"threads", counts[k]},
                  {"local_step_ms", milliseconds(measurements.local_step)},
                  {"global_step_ms", milliseconds(measurements.global_step)},
                  {"iteration_ms", milliseconds(measurements.iteration)},
                  {"preprocess_ms", milliseconds(measurements.preprocess)}};
      if(!libigl.iteration.empty())
      {
        row["libigl_iteration_ms"] = milliseconds(libigl.iteration);
        row["iteration_ratio"] = median(libigl.iteration) / median(measurements.iteration);
        row["libigl_preprocess_ms"] = milliseconds(libigl.preprocess);
        row["preprocess_ratio"] = median(libigl.preprocess) / median(measurements.preprocess);
        row["largest_difference"] = difference;
      }
      rows.push_back(row);
    }
}

Json run(const Settings& settings)
{
#ifndef ARAP_DEFORMATION_BENCHMARK_LIBIGL
  std::cout << "NOTICE: libigl was not found; there is nothing to compare tetrahedra with\n";
#endif
  Json section = make_section(
    "Tetrahedra",
    "Milliseconds; a bar, one rotation for each tetrahedron.",
    {{"vertices", "vertices"}, {"tetrahedra", "tetrahedra"}, {"solver", "solver"},
     {"threads", "threads"}, {"local_step_ms", "local step"}, {"global_step_ms", "global step"},
     {"iteration_ms", "iteration"}, {"libigl_iteration_ms", "libigl"},
     {"iteration_ratio", "libigl / ours"}, {"preprocess_ms", "preprocessing"},
     {"libigl_preprocess_ms", "libigl"}, {"preprocess_ratio", "libigl / ours"}});
  compare(make_bar(36, 10, 10), settings, section["rows"]);
  if(!settings.quick)
    compare(make_bar(61, 22, 22), settings, section["rows"]);
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "tetrahedra",
                       "usage: tetrahedra [options]\n\n"
                       "Measures the time of an iteration for tetrahedra.", run, {"repetitions"});
}
