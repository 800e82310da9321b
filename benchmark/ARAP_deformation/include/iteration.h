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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_ITERATION_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_ITERATION_H

// The seconds of a local/global iteration and of the preprocessing.

#include "deformations.h"
#include "measure.h"
#include "section.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace benchmark {

// enough iterations for a measurable run, and not many more
inline unsigned int number_of_iterations(std::size_t number_of_vertices)
{
  return static_cast<unsigned int>(
    (std::min)((std::max)(std::size_t(2000000) / number_of_vertices, std::size_t(4)),
               std::size_t(80)));
}

struct Measurements
{
  std::vector<double> preprocess, iteration, local_step, global_step;
};

// Adds the measurements of one object of our class. The difference of two runs leaves out what a
// run does before and after its iterations; the first run of an object, which does more, is neither
// of the two.
template <typename Deformation>
void measure_ours(Deformation& ours, unsigned int iterations, Measurements& measurements)
{
  const auto per_iteration = [iterations](double longer, double shorter) {
    return (longer - shorter) / iterations;
  };
  ours.run(1);
  const ARAP::Report shorter = ours.run(1), longer = ours.run(iterations + 1);
  const ARAP::Phase_seconds &s = shorter.seconds, &l = longer.seconds;
  measurements.preprocess.push_back(ours.preprocess_seconds());
  measurements.iteration.push_back(per_iteration(l.total, s.total));
  measurements.local_step.push_back(per_iteration(l.local_steps, s.local_steps));
  measurements.global_step.push_back(per_iteration(l.global_steps, s.global_steps));
}

// the same for a competitor; run(n) returns the seconds of n iterations
template <typename Run>
void measure_other(double preprocess_seconds, const Run& run, unsigned int iterations,
                   Measurements& measurements)
{
  run(1);
  const double shorter = run(1), longer = run(iterations + 1);
  measurements.preprocess.push_back(preprocess_seconds);
  measurements.iteration.push_back((longer - shorter) / iterations);
}

inline double milliseconds(const std::vector<double>& seconds) { return 1e3 * median(seconds); }

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_ITERATION_H
