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

// The time from the rest shape to relative gaps of 1e-3 and 1e-5 to the minimum of the energy,
// compared with CGAL's Surface_mesh_deformation.

#include "include/deformations.h"
#include "include/run_benchmark.h"
#include "include/star_energy.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace benchmark;

struct Sample
{
  unsigned int iterations;
  double seconds, energy;
};

// the first sample whose energy is within the gap, or none
const Sample* first_within(const std::vector<Sample>& samples, double minimum, double gap)
{
  const auto found = std::find_if(samples.begin(), samples.end(), [&](const Sample& s) {
    return s.energy - minimum <= gap * minimum;
  });
  return found == samples.end() ? nullptr : &*found;
}

// Runs our class to the tolerance, and records the energy of each iterate, as the report does. A
// tolerance of 0 selects local/global iterations.
template <typename Deformation>
std::pair<std::vector<Sample>, ARAP::Report> sample_ours(Deformation& ours, unsigned int iterations,
                                                         double tolerance)
{
  std::vector<Sample> samples;
  ours.restart();
  const Stopwatch stopwatch;
  ARAP::Report report =
    ours.deformation().deform(iterations, tolerance, [&](const auto& iterate) {
      samples.push_back({iterate.iteration(), stopwatch.seconds(), iterate.energy()});
      return ARAP::Visitor_action::proceed;
    });
  expect_success(report);
  return {std::move(samples), std::move(report)};
}

// Runs CGAL's class in pieces until the gap is reached, within 2% of its iterations. It does not
// report energies: they are evaluated between the pieces, and that time is not counted.
template <typename Deformation>
std::vector<Sample> sample_cgal(Deformation& cgal, const Star_energy& energy, double minimum,
                                double gap)
{
  const unsigned int limit = 20000;
  std::vector<Sample> samples;
  unsigned int iterations = 0;
  double seconds = 0;
  cgal.restart();
  do
  {
    const unsigned int piece = (std::max)(iterations / 50, 1u);
    seconds += cgal.proceed(piece);
    iterations += piece;
    samples.push_back({iterations, seconds, energy(cgal.mesh()).energy});
  } while(samples.back().energy - minimum > gap * minimum && iterations < limit);
  return samples;
}

// The minimum, from a long run. Verified by the gradient, computed without code of this package.
double find_minimum(const Scenario& scenario, const Star_energy& energy)
{
  Our_deformation<Default_traits> ours(scenario);
  const ARAP::Report report = sample_ours(ours, 10000, 1e-11).second;
  const Star_energy::Value value = energy(ours.mesh());
  verify_at_most(std::abs(value.energy - report.energy.back()) / value.energy, 1e-9,
                 "the relative difference between the reported energy and an independent one");
  verify_at_most(value.gradient * scenario.diagonal / value.energy, 1e-2,
                 "the norm of the gradient at the minimum, times the diagonal of the bounding box, "
                 "divided by the energy,");
  return report.energy.back();
}

Json curve(const std::vector<Sample>& samples, double minimum)
{
  Json points = Json::array();
  for(const Sample& s : samples)
    points.push_back({s.iterations, s.seconds, (s.energy - minimum) / minimum});
  return points;
}

Json run(const Settings& settings)
{
  const std::string file = settings.file_or(settings.quick ? "dino.off" : "armadillo.off");
  const Scenario scenario = make_scenario(read_mesh(file));
  const Star_energy energy(scenario);
  const double minimum = find_minimum(scenario, energy);

  Json section = make_section(
    "From the rest shape to the minimum",
    "Seconds and iterations until the energy is within a relative gap of the minimum, without "
    "preprocessing. CGAL: Surface_mesh_deformation, ORIGINAL_ARAP, one run, whose iterations are "
    "known within 2%. The minima agree.",
    {{"vertices", "vertices"}, {"gap", "gap"}, {"threads", "threads"},
     {"seconds", "seconds"}, {"iterations", "iterations"}, {"cgal_seconds", "CGAL"},
     {"cgal_iterations", "CGAL's iterations"}, {"ratio", "CGAL / ours"},
     {"tolerance_seconds", "seconds with this tolerance"},
     {"estimated_gap", "estimated gap"}, {"true_gap", "true gap"}});
  section["minimum"] = minimum;

  const std::vector<double> gaps = {1e-3, 1e-5};
  Cgal_deformation<CGAL::ORIGINAL_ARAP> cgal(scenario);
  const std::vector<Sample> cgal_samples = sample_cgal(cgal, energy, minimum, gaps.back());
  const double lowest = cgal_samples.back().energy;
  verify_at_most((lowest - minimum) / minimum, gaps.back(),
                 "the relative gap of CGAL's last iterate to our minimum");
  verify_at_most((minimum - lowest) / minimum, 1e-9,
                 "the relative gap of our minimum to CGAL's last iterate");
  section["cgal_curve"] = curve(cgal_samples, minimum);

  for(unsigned int threads : thread_counts())
  {
    const Thread_limit limit(threads);
    Our_deformation<Default_traits> ours(scenario);
    std::vector<Sample> samples;
    std::vector<std::vector<double>> seconds(gaps.size()), tolerance_seconds(gaps.size());
    std::vector<ARAP::Report> reports(gaps.size());
    for(unsigned int repetition = 0; repetition < settings.few_repetitions; ++repetition)
    {
      samples = sample_ours(ours, 10000, gaps.back() * 1e-2).first;
      for(std::size_t k = 0; k < gaps.size(); ++k)
      {
        const Sample* reached = first_within(samples, minimum, gaps[k]);
        if(reached == nullptr)
          throw Failure("our class did not reach the gap");
        seconds[k].push_back(reached->seconds);
        reports[k] = sample_ours(ours, 10000, gaps[k]).second;
        tolerance_seconds[k].push_back(reports[k].seconds.total);
      }
    }
    for(std::size_t k = 0; k < gaps.size(); ++k)
    {
      const Sample* cgal_reached = first_within(cgal_samples, minimum, gaps[k]);
      section["rows"].push_back(
        {{"vertices", scenario.number_of_vertices()},
         {"gap", gaps[k]},
         {"threads", threads},
         {"seconds", median(seconds[k])},
         {"iterations", first_within(samples, minimum, gaps[k])->iterations},
         {"cgal_seconds", cgal_reached->seconds},
         {"cgal_iterations", cgal_reached->iterations},
         {"ratio", cgal_reached->seconds / median(seconds[k])},
         {"tolerance_seconds", median(tolerance_seconds[k])},
         {"estimated_gap", reports[k].estimated_relative_gap},
         {"true_gap", (reports[k].energy.back() - minimum) / minimum}});
    }
    section["curve_of_" + std::to_string(threads)] = curve(samples, minimum);
  }
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "time_to_minimum",
                       "usage: time_to_minimum [options]\n\n"
                       "Measures the time from the rest shape to the minimum of the energy, with\n"
                       "our class and with CGAL's. Takes a few minutes, or with --quick, for a\n"
                       "smaller mesh, some seconds.", run);
}
