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

// How the time of an iteration grows with the size of the mesh, compared with n log n.

#include "include/deformations.h"
#include "include/iteration.h"
#include "include/run_benchmark.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace {

using namespace benchmark;

Json run(const Settings& settings)
{
  const Mesh mesh = read_mesh(settings.file_or("armadillo.off"));
  Json section = make_section(
    "Growth",
    "Milliseconds; the last column is the time divided by n log n, relative to the first size.",
    {{"vertices", "vertices"}, {"threads", "threads"}, {"preprocess_ms", "preprocessing"},
     {"local_step_ms", "local step"}, {"global_step_ms", "global step"},
     {"iteration_ms", "iteration"}, {"growth", "relative to n log n"}});
  std::vector<double> first(thread_counts().size()); // milliseconds / (n log n)
  for(unsigned int parts : settings.quick ? std::vector<unsigned int>{1, 2}
                                          : std::vector<unsigned int>{2, 4, 8, 12})
  {
    const Scenario scenario = make_scenario(subdivided(mesh, parts));
    const double n = static_cast<double>(scenario.number_of_vertices());
    for(std::size_t k = 0; k < first.size(); ++k)
    {
      const Thread_limit limit(thread_counts()[k]);
      Measurements measurements;
      for(unsigned int repetition = 0; repetition < settings.few_repetitions; ++repetition)
      {
        Our_deformation<Default_traits> ours(scenario);
        measure_ours(ours, number_of_iterations(scenario.number_of_vertices()), measurements);
      }
      const double scaled = milliseconds(measurements.iteration) / (n * std::log(n));
      if(first[k] == 0)
        first[k] = scaled;
      section["rows"].push_back({{"vertices", scenario.number_of_vertices()},
                                 {"threads", thread_counts()[k]},
                                 {"preprocess_ms", milliseconds(measurements.preprocess)},
                                 {"local_step_ms", milliseconds(measurements.local_step)},
                                 {"global_step_ms", milliseconds(measurements.global_step)},
                                 {"iteration_ms", milliseconds(measurements.iteration)},
                                 {"growth", scaled / first[k]}});
    }
  }
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "growth",
                       "usage: growth [options]\n\n"
                       "Measures how the time of an iteration grows with the size of the mesh, up\n"
                       "to 3.7 million vertices, which takes a few gigabytes.", run);
}
