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

// The time of one local/global iteration and of preprocessing, on a mesh and its subdivisions,
// compared with CGAL's Surface_mesh_deformation, and with libigl if it is installed.

#include "include/deformations.h"
#include "include/iteration.h"
#include "include/run_benchmark.h"
#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
#include "include/libigl_deformation.h"
#endif

#include <CGAL/boost/graph/helpers.h>

#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace benchmark;

#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
// libigl's weights are raw cotangents of stars, and it starts from the rest shape. It fits
// rotations in single precision with few steps, so that only the first iterates are comparable.
void verify_libigl(const Scenario& scenario, Libigl_deformation& libigl)
{
  Our_deformation<CGAL::ARAP_deformation_traits<CGAL::Default, ARAP::Cotangent_weight>>
    ours(scenario);
  ours.run(1);
  libigl.run(1);
  verify_at_most(largest_distance(points_of(ours.mesh()), libigl.points()) / scenario.diagonal,
                 1e-3,
                 "the largest difference between our first iterate and libigl's, relative to the "
                 "bounding box,");
}
#endif

template <CGAL::Deformation_algorithm_tag Tag, typename Weight>
void compare(const Scenario& scenario, const Settings& settings, ARAP::Cell_scheme cells,
             const std::string& cells_name, bool with_libigl, Json& rows)
{
  const double difference = verify_iterates<Weight, Tag>(scenario, cells);
  const unsigned int iterations = number_of_iterations(scenario.number_of_vertices());
  std::map<std::pair<unsigned int, std::string>, Measurements> ours; // by threads and solver
  Measurements cgal, libigl;
  const unsigned int repetitions = scenario.number_of_vertices() < 200000
                                 ? settings.repetitions : settings.few_repetitions;
  for(unsigned int repetition = 0; repetition < repetitions; ++repetition)
  {
    for(unsigned int threads : thread_counts())
      for_each_solver<Weight>([&](const auto& traits, const char* solver) {
        const Thread_limit limit(threads);
        Our_deformation deformation(scenario, traits, cells);
        measure_ours(deformation, iterations, ours[{threads, solver}]);
      });
    {
      Cgal_deformation<Tag> deformation(scenario);
      measure_other(deformation.preprocess_seconds(),
                    [&](unsigned int n) { return deformation.run(n); }, iterations, cgal);
    }
#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL
    if(with_libigl)
    {
      const Libigl_scenario copy = libigl_scenario(scenario);
      Libigl_deformation deformation(copy, Libigl_energy::spokes);
      if(repetition == 0)
        verify_libigl(scenario, deformation);
      measure_other(deformation.preprocess_seconds(),
                    [&](unsigned int n) { return deformation.run(n); }, iterations, libigl);
    }
#else
    static_cast<void>(with_libigl);
#endif
  }

  for(const auto& [configuration, measurements] : ours)
  {
    Json row = {{"vertices", scenario.number_of_vertices()},
                {"cells", cells_name},
                {"solver", configuration.second},
                {"threads", configuration.first},
                {"preprocess_ms", milliseconds(measurements.preprocess)},
                {"local_step_ms", milliseconds(measurements.local_step)},
                {"global_step_ms", milliseconds(measurements.global_step)},
                {"iteration_ms", milliseconds(measurements.iteration)},
                {"cgal_preprocess_ms", milliseconds(cgal.preprocess)},
                {"cgal_iteration_ms", milliseconds(cgal.iteration)},
                {"largest_difference", difference}};
    row["preprocess_ratio"] = median(cgal.preprocess) / median(measurements.preprocess);
    row["iteration_ratio"] = median(cgal.iteration) / median(measurements.iteration);
    if(!libigl.iteration.empty())
    {
      row["libigl_preprocess_ms"] = milliseconds(libigl.preprocess);
      row["libigl_iteration_ms"] = milliseconds(libigl.iteration);
    }
    rows.push_back(row);
  }
}

Json run(const Settings& settings)
{
  const std::string file = settings.file_or("armadillo.off");
  const Mesh mesh = read_mesh(file);
  if(!CGAL::is_closed(mesh))
    std::cout << "NOTICE: the mesh has a border, where the weights of ORIGINAL_ARAP depend on the "
                 "version of CGAL\n";
  Json section = make_section(
    "One local/global iteration",
    "Milliseconds; CGAL: Surface_mesh_deformation with ORIGINAL_ARAP (spokes) and SPOKES_AND_RIMS. "
    "The iterates agree with each solver: to 1e-8 of the bounding box, in single precision to "
    "1e-5.",
    {{"vertices", "vertices"}, {"cells", "cells"}, {"solver", "solver"}, {"threads", "threads"},
     {"local_step_ms", "local step"}, {"global_step_ms", "global step"},
     {"iteration_ms", "iteration"}, {"cgal_iteration_ms", "CGAL"},
     {"iteration_ratio", "CGAL / ours"}, {"libigl_iteration_ms", "libigl"},
     {"preprocess_ms", "preprocessing"}, {"cgal_preprocess_ms", "CGAL"},
     {"preprocess_ratio", "CGAL / ours"}, {"libigl_preprocess_ms", "libigl"}});
  for(unsigned int parts : settings.quick ? std::vector<unsigned int>{1}
                                          : std::vector<unsigned int>{1, 2, 4})
  {
    const Scenario scenario = make_scenario(subdivided(mesh, parts));
    compare<CGAL::ORIGINAL_ARAP, Clamped_angle_weight>(
      scenario, settings, ARAP::Cell_scheme::spokes(), "spokes", true, section["rows"]);
    if(parts == 1 && !settings.quick)
      compare<CGAL::SPOKES_AND_RIMS, ARAP::Cotangent_weight>(
        scenario, settings, ARAP::Cell_scheme::spokes_and_rims(), "spokes and rims", false,
        section["rows"]);
  }
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "iteration_time",
                       "usage: iteration_time [options]\n\n"
                       "Compares the time of an iteration with that of CGAL's package\n"
                       "Surface_mesh_deformation, after checking that the iterates agree.", run);
}
