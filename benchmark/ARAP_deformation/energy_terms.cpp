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

// What bending, smooth and shared rotations, stiffness, larger cells and control points cost.

#include "include/deformations.h"
#include "include/run_benchmark.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace benchmark;

// the default solver, which adds up the sizes of its factors, and of those of its copies
class Measured_solver : public ARAP::Multifrontal_cholesky_solver
{
public:
  explicit Measured_solver(std::shared_ptr<double> bytes) : m_bytes(std::move(bytes)) {}

  bool factorize(const ARAP::Sparse_matrix& a)
  {
    const bool is_positive = ARAP::Multifrontal_cholesky_solver::factorize(a);
    *m_bytes += static_cast<double>(factor_bytes());
    return is_positive;
  }

private:
  std::shared_ptr<double> m_bytes;
};

using Traits = CGAL::ARAP_deformation_traits<Measured_solver>;
using Deformation = CGAL::ARAP_deformation<Mesh, Traits>;

struct Term
{
  std::string name;
  std::function<void(ARAP::Options&)> choose;
  std::function<void(Deformation&)> add;
};

// Lengths are shares of the diagonal of the bounding box.
std::vector<Term> make_terms(const Scenario& scenario)
{
  const auto no_options = [](ARAP::Options&) {};
  const auto nothing = [](Deformation&) {};
  const double d = scenario.diagonal;
  return {
    {"none", no_options, nothing},
    {"bending, 0.02", [d](auto& options) { options.bending_length = 0.02 * d; }, nothing},
    {"smooth rotations, 0.1", [d](auto& options) { options.smoothing_length = 0.1 * d; }, nothing},
    {"cells of one ring more",
     [](auto& options) { options.cells = ARAP::Cell_scheme::k_ring(1); }, nothing},
    {"stiffness", no_options,
     [](Deformation& deformation) {
       expect_success(deformation.set_stiffness([](vertex_descriptor v) {
         return 1 + std::size_t(v) % 7;
       }));
     }},
    {"1000 shared rotations", no_options,
     [&scenario](Deformation& deformation) {
       const std::size_t n = scenario.number_of_vertices();
       expect_success(deformation.set_groups([n](vertex_descriptor v) {
         return static_cast<int>(1000 * std::size_t(v) / n);
       }));
     }},
    {"100 control points", no_options,
     [&scenario](Deformation& deformation) {
       const std::size_t n = num_faces(scenario.mesh);
       for(std::size_t k = 0; k < 100; ++k)
       {
         const Mesh::Face_index f(static_cast<unsigned int>((2 * k + 1) * n / 200));
         const auto inserted =
           deformation.insert_control_point(f, std::array<double, 3>{0.5, 0.25, 0.25});
         expect_success(inserted);
         expect_success(deformation.set_target_weight(inserted.point, 1));
       }
     }}};
}

struct Result
{
  std::vector<double> preprocess, iteration, minimum;
  unsigned int iterations = 0;
};

// everything but preprocessing and targets
Deformation make_deformation(const Scenario& scenario, const Term& term, Mesh& mesh,
                             const std::shared_ptr<double>& bytes)
{
  Deformation deformation(mesh, Traits(Measured_solver(bytes)));
  ARAP::Options options;
  options.iterations = 10000;
  term.choose(options);
  expect_success(deformation.set_options(options));
  insert_vertices(scenario, deformation);
  term.add(deformation);
  return deformation;
}

void set_targets(const Scenario& scenario, Deformation& deformation)
{
  for(const auto& [v, target] : scenario.targets)
    deformation.set_target_position(v, target);
}

// The size of all factors: smooth rotations have a second one, which is made when a run begins. A
// run of one iteration has no coarser surface, whose factors do not stay.
double factor_bytes(const Scenario& scenario, const Term& term)
{
  const auto bytes = std::make_shared<double>(0);
  Mesh mesh = scenario.mesh;
  Deformation deformation = make_deformation(scenario, term, mesh, bytes);
  set_targets(scenario, deformation);
  expect_success(deformation.deform(1, deformation.options().tolerance));
  return *bytes;
}

// A run from the rest shape to the default tolerance, after preprocessing.
void measure(const Scenario& scenario, const Term& term, Result& result)
{
  Mesh mesh = scenario.mesh;
  Deformation deformation =
    make_deformation(scenario, term, mesh, std::make_shared<double>(0));
  const Stopwatch stopwatch;
  expect_success(deformation.preprocess());
  result.preprocess.push_back(stopwatch.seconds());
  set_targets(scenario, deformation);
  const ARAP::Report report = deformation.deform();
  expect_success(report);
  for(std::size_t k = 1; k < report.energy.size(); ++k)
    verify_at_most(report.energy[k] / report.energy[k - 1], 1 + 1e-9,
                   term.name + ": the energy after an iteration, relative to that before it,");
  result.minimum.push_back(report.seconds.total);
  result.iteration.push_back((report.seconds.local_steps + report.seconds.global_steps) /
                             report.iterations);
  result.iterations = report.iterations;
}

Json run(const Settings& settings)
{
  const Scenario scenario =
    make_scenario(read_mesh(settings.file_or(settings.quick ? "camel.off" : "armadillo.off")));
  Json section = make_section(
    "Terms of the energy",
    "The twisted model of " + format_number(static_cast<double>(scenario.number_of_vertices())) +
    " vertices with spokes and rims, or larger cells, one term at a time, in milliseconds on all "
    "threads. A run is one from the rest shape to the default tolerance, its guess and its looks "
    "at the end included; an iteration is its local and global steps over its iterations. Lengths "
    "are shares of the diagonal.",
    {{"term", "term"}, {"factor_mb", "factors, MB"}, {"preprocess_ms", "preprocessing"},
     {"iteration_ms", "iteration"}, {"iterations", "iterations"}, {"minimum_ms", "run"}});
  const std::vector<Term> terms = make_terms(scenario);
  std::vector<Result> results(terms.size());
  for(unsigned int repetition = 0; repetition < settings.few_repetitions; ++repetition)
    for(std::size_t k = 0; k < terms.size(); ++k)
      measure(scenario, terms[k], results[k]);
  for(std::size_t k = 0; k < terms.size(); ++k)
    section["rows"].push_back({{"term", terms[k].name},
                               {"factor_mb", 1e-6 * factor_bytes(scenario, terms[k])},
                               {"preprocess_ms", 1e3 * median(results[k].preprocess)},
                               {"iteration_ms", 1e3 * median(results[k].iteration)},
                               {"iterations", results[k].iterations},
                               {"minimum_ms", 1e3 * median(results[k].minimum)}});
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "energy_terms",
                       "usage: energy_terms [options]\n\n"
                       "Measures what the terms of the energy and control points cost.", run);
}
