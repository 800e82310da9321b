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
#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
#include "include/libigl_deformation.h"
#endif

#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using namespace benchmark;

using Tetrahedra = std::vector<std::array<int, 4>>;

// A bar with one end fixed and the other one turned.
struct Bar
{
  std::vector<Point> points;
  Tetrahedra tetrahedra;
  std::vector<std::pair<std::size_t, Point>> targets;
};

// A grid of cubes, each cut into six tetrahedra around a diagonal. Inner vertices are moved off the
// grid, so that no right angle makes a weight zero.
Bar make_bar(int nx, int ny, int nz)
{
  Bar bar;
  std::mt19937 random(1);
  const auto jitter = [&random](int k, int n) {
    const double shift = 0.2 * (static_cast<double>(random()) / 4294967295.0 - 0.5);
    return k == 0 || k == n ? 0.0 : shift;
  };
  const auto vertex = [&](int x, int y, int z) { return (x * (ny + 1) + y) * (nz + 1) + z; };
  Eigen::AlignedBox3d box;
  for(int x = 0; x <= nx; ++x)
    for(int y = 0; y <= ny; ++y)
      for(int z = 0; z <= nz; ++z)
      {
        const Eigen::Vector3d p(x + jitter(x, nx), y + jitter(y, ny), z + jitter(z, nz));
        bar.points.push_back(to_point(p));
        box.extend(p);
      }
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for(int x = 0; x < nx; ++x)
    for(int y = 0; y < ny; ++y)
      for(int z = 0; z < nz; ++z)
        for(const auto& order : orders) // the paths from a corner to the opposite one
        {
          std::array<int, 3> place = {x, y, z};
          std::array<int, 4> corners = {vertex(x, y, z)};
          for(int k = 0; k < 3; ++k)
          {
            ++place[static_cast<std::size_t>(order[k])];
            corners[static_cast<std::size_t>(k) + 1] = vertex(place[0], place[1], place[2]);
          }
          if(&order - orders >= 3) // these are odd permutations
            std::swap(corners[0], corners[1]);
          bar.tetrahedra.push_back(corners);
        }
  const Twist twist(box);
  for(std::size_t v = 0; v < bar.points.size(); ++v)
    if(const Eigen::Vector3d p = to_vector(bar.points[v]); twist.is_fixed(p) || twist.is_handle(p))
      bar.targets.emplace_back(v, to_point(twist.target(p)));
  return bar;
}

using Domain = ARAP::Tetrahedron_soup_domain<std::vector<Point>, Tetrahedra>;

template <typename Traits>
class Our_bar
{
public:
  Our_bar(const Bar& bar, const Traits& traits)
    : m_bar(bar), m_points(bar.points),
      m_deformation(Domain(m_points, bar.tetrahedra), traits)
  {
    ARAP::Options options;
    options.cells = ARAP::Cell_scheme::elements();
    options.initial_guess = ARAP::Initial_guess::previous; // as libigl
    expect_success(m_deformation.set_options(options));
    for(std::size_t v = 0; v < bar.points.size(); ++v)
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
  CGAL::ARAP_deformation<Domain, Traits> m_deformation;
  double m_preprocess_seconds = 0;
};

#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
Libigl_scenario libigl_bar(const Bar& bar)
{
  Libigl_scenario result;
  result.points.resize(static_cast<Eigen::Index>(bar.points.size()), 3);
  result.simplices.resize(static_cast<Eigen::Index>(bar.tetrahedra.size()), 4);
  result.fixed.resize(static_cast<Eigen::Index>(bar.targets.size()));
  result.targets.resize(result.fixed.size(), 3);
  for(Eigen::Index k = 0; k < result.points.rows(); ++k)
    result.points.row(k) = to_vector(bar.points[static_cast<std::size_t>(k)]);
  for(Eigen::Index k = 0; k < result.simplices.rows(); ++k)
    result.simplices.row(k) = Eigen::Map<const Eigen::RowVector4i>(
      bar.tetrahedra[static_cast<std::size_t>(k)].data());
  for(Eigen::Index k = 0; k < result.fixed.size(); ++k)
  {
    const auto& [v, target] = bar.targets[static_cast<std::size_t>(k)];
    result.fixed[k] = static_cast<int>(v);
    result.targets.row(k) = to_vector(target);
  }
  return result;
}

// Fails unless the first iterates are the same; libigl fits rotations in single precision.
double verify_libigl(const Bar& bar, Libigl_deformation& libigl)
{
  Our_bar<CGAL::ARAP_deformation_traits<>> ours(bar, CGAL::ARAP_deformation_traits<>());
  ours.run(1);
  libigl.run(1);
  double largest = 0;
  Eigen::AlignedBox3d box;
  for(std::size_t v = 0; v < bar.points.size(); ++v)
  {
    box.extend(to_vector(bar.points[v]));
    largest = larger(largest, (to_vector(ours.points()[v]) -
                                   libigl.points().row(static_cast<Eigen::Index>(v)).transpose())
                                    .norm());
  }
  const double difference = largest / box.diagonal().norm();
  verify_at_most(difference, 1e-3, "the largest difference between our first iterate and libigl's, "
                                   "relative to the bounding box,");
  return difference;
}
#endif

// Fails unless the iterates with each solver are those with the default one.
void verify_solvers(const Bar& bar)
{
  std::vector<Point> expected;
  const double diagonal = std::sqrt(CGAL::squared_distance(bar.points.front(), bar.points.back()));
  for_each_solver<CGAL::Default>([&](const auto& traits, const char* name) {
    using Solver = std::decay_t<decltype(traits.sparse_solver_object())>;
    Our_bar deformation(bar, traits);
    deformation.run(5);
    if(expected.empty())
      expected = deformation.points(); // the default is the first
    double largest = 0;
    for(std::size_t v = 0; v < expected.size(); ++v)
      largest = larger(largest, CGAL::squared_distance(expected[v], deformation.points()[v]));
    verify_at_most(std::sqrt(largest) / diagonal,
                   std::is_same_v<Solver, Single_precision_solver> ? 1e-5 : 1e-8,
                   std::string("the largest difference of the iterates with the solver ") + name +
                   ", relative to the bounding box,");
  });
}

void compare(const Bar& bar, const Settings& settings, Json& rows)
{
  verify_solvers(bar);
  const unsigned int iterations = number_of_iterations(5 * bar.points.size());
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
    const Libigl_scenario copy = libigl_bar(bar);
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
      Json row = {{"vertices", bar.points.size()},
                  {"tetrahedra", bar.tetrahedra.size()},
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
