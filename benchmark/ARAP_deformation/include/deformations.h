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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_DEFORMATIONS_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_DEFORMATIONS_H

// Our class and CGAL's with a common interface, each on its own copy of the mesh, set up to do the
// same.

#include "measure.h"
#include "scenario.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/ARAP_deformation/Fill_reducing_ordering.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Cholmod_solver.h>

#include <CGAL/Surface_mesh_deformation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

namespace benchmark {

namespace ARAP = CGAL::ARAP;

// The weights of CGAL's ORIGINAL_ARAP: the cotangent of each angle is clamped, not the sum of both
// at an edge.
class Clamped_angle_weight : public ARAP::Cotangent_weight
{
public:
  std::array<double, 3> simplex_weights(const std::array<ARAP::Coordinates, 3>& triangle) const
  {
    std::array<double, 3> weights = ARAP::Cotangent_weight::simplex_weights(triangle);
    for(double& w : weights)
      w = (std::max)(w, 0.0);
    return weights;
  }
};

// CGAL's class starts with the global step, with identity rotations; ours starts with the local
// step. This fitting keeps the identities while told to, which gives our class the same start;
// afterwards it is the default fitting.
class Rotation_after_identity
{
  using Rotation = CGAL::ARAP_deformation_traits<>::Closest_rotation;

public:
  explicit Rotation_after_identity(const bool& is_identity) : m_is_identity(&is_identity) {}

  void operator()(std::size_t n, const ARAP::Matrix_3x3* covariances,
                  ARAP::Matrix_3x3* rotations) const
  {
    if(*m_is_identity)
      std::fill_n(rotations, n, ARAP::Matrix_3x3{1, 0, 0, 0, 1, 0, 0, 0, 1});
    else
      m_rotation(n, covariances, rotations);
  }

private:
  const bool* m_is_identity;
  Rotation m_rotation;
};

// The default solver with its factor in single precision, as a type.
struct Single_precision_solver : ARAP::Multifrontal_cholesky_solver
{
  Single_precision_solver()
    : ARAP::Multifrontal_cholesky_solver(ARAP::Factor_precision::single_precision)
  {}
};

// Calls f(traits, name) with traits for each of our solvers.
template <typename Weight, typename Function>
void for_each_solver(const Function& f)
{
  f(CGAL::ARAP_deformation_traits<ARAP::Multifrontal_cholesky_solver, Weight>(), "default");
  f(CGAL::ARAP_deformation_traits<Single_precision_solver, Weight>(), "single precision");
  f(CGAL::ARAP_deformation_traits<ARAP::Eigen_LDLT_solver, Weight>(), "Eigen");
#ifdef CGAL_LINKED_WITH_CHOLMOD
  f(CGAL::ARAP_deformation_traits<ARAP::Cholmod_solver, Weight>(), "CHOLMOD");
#endif
#ifdef CGAL_METIS_ENABLED
  using Solver = CGAL::ARAP_deformation_traits<>::Sparse_solver;
  f(CGAL::ARAP_deformation_traits<CGAL::Default, Weight>(
      Solver(ARAP::Fill_reducing_ordering::nested_dissection)), "default, METIS");
#endif
}

// the defaults, except for the weights, which are those of CGAL's class
using Default_traits = CGAL::ARAP_deformation_traits<CGAL::Default, Clamped_angle_weight>;

// Makes all vertices free except the control vertices.
template <typename Deformation>
void insert_vertices(const Scenario& scenario, Deformation& deformation)
{
  deformation.insert_roi_vertices(vertices(scenario.mesh).begin(), vertices(scenario.mesh).end());
  for(const auto& [v, target] : scenario.targets)
    deformation.insert_control_vertex(v);
}

// Goes back to the rest shape, with all targets of the scenario set.
template <typename AnyScenario, typename Deformation>
void restart(const AnyScenario& scenario, Deformation& deformation)
{
  deformation.reset();
  for(const auto& [v, target] : scenario.targets)
    deformation.set_target_position(v, target);
}

inline void expect_success(const ARAP::Outcome& outcome)
{
  if(!outcome)
    throw Failure("CGAL::ARAP_deformation: " + outcome.message);
}

template <typename Traits>
class Our_deformation
{
public:
  explicit Our_deformation(const Scenario& scenario, const Traits& traits = Traits(),
                           ARAP::Cell_scheme cells = ARAP::Cell_scheme::spokes())
    : m_scenario(scenario), m_mesh(scenario.mesh), m_deformation(m_mesh, traits)
  {
    ARAP::Options options;
    options.cells = cells;
    expect_success(m_deformation.set_options(options));
    insert_vertices(scenario, m_deformation);
    preprocess();
    m_preprocess_seconds = m_stopwatch.seconds();
  }

  // from construction to the factor
  double preprocess_seconds() const { return m_preprocess_seconds; }
  const Mesh& mesh() const { return m_mesh; }
  CGAL::ARAP_deformation<Mesh, Traits>& deformation() { return m_deformation; }

  void preprocess() { expect_success(m_deformation.preprocess()); }
  void restart() { benchmark::restart(m_scenario, m_deformation); }
  void proceed(unsigned int iterations) { expect_success(m_deformation.deform(iterations, 0)); }

  // Local/global iterations from the rest shape itself.
  ARAP::Report run(unsigned int iterations)
  {
    restart_without_guess();
    return checked(m_deformation.deform(iterations, 0), iterations);
  }

  // the same, from the same start as CGAL's class; for traits with Rotation_after_identity
  void run_after_identity(unsigned int iterations, bool& is_identity)
  {
    restart_without_guess();
    is_identity = true;
    checked(m_deformation.deform(iterations, 0, [&is_identity](const auto&) {
      is_identity = false;
      return ARAP::Visitor_action::proceed;
    }), iterations);
  }

private:
  void restart_without_guess()
  {
    restart();
    ARAP::Options options = m_deformation.options();
    options.initial_guess = ARAP::Initial_guess::previous;
    expect_success(m_deformation.set_options(options));
  }

  static ARAP::Report checked(ARAP::Report report, unsigned int iterations)
  {
    expect_success(report);
    if(report.iterations != iterations)
      throw Failure("CGAL::ARAP_deformation stopped after " + std::to_string(report.iterations) +
                    " of " + std::to_string(iterations) + " iterations: " + report.message);
    return report;
  }

  const Scenario& m_scenario;
  Mesh m_mesh;
  Stopwatch m_stopwatch; // starts before m_deformation is constructed
  CGAL::ARAP_deformation<Mesh, Traits> m_deformation;
  double m_preprocess_seconds = 0;
};

template <CGAL::Deformation_algorithm_tag Tag>
class Cgal_deformation
{
public:
  explicit Cgal_deformation(const Scenario& scenario)
    : m_scenario(scenario), m_mesh(scenario.mesh), m_deformation(m_mesh)
  {
    insert_vertices(scenario, m_deformation);
    preprocess();
    m_preprocess_seconds = m_stopwatch.seconds();
  }

  double preprocess_seconds() const { return m_preprocess_seconds; }
  const Mesh& mesh() const { return m_mesh; }
  auto& deformation() { return m_deformation; }

  void preprocess()
  {
    if(!m_deformation.preprocess())
      throw Failure("CGAL::Surface_mesh_deformation: preprocess() failed");
  }

  void restart() { benchmark::restart(m_scenario, m_deformation); }

  // further iterations, and their seconds
  double proceed(unsigned int iterations)
  {
    const Stopwatch stopwatch;
    m_deformation.deform(iterations, 0);
    return stopwatch.seconds();
  }

  double run(unsigned int iterations)
  {
    restart();
    return proceed(iterations);
  }

private:
  const Scenario& m_scenario;
  Mesh m_mesh;
  Stopwatch m_stopwatch; // starts before m_deformation is constructed
  CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default, Tag> m_deformation;
  double m_preprocess_seconds = 0;
};

// Fails unless our iterates with each solver equal those of CGAL's class, since all solve the same
// problem by the same steps. Returns the largest difference of those in double precision, relative
// to the bounding box.
template <typename Weight, CGAL::Deformation_algorithm_tag Tag>
double verify_iterates(const Scenario& scenario, ARAP::Cell_scheme cells)
{
  std::map<unsigned int, Mesh> expected; // after so many iterations
  Cgal_deformation<Tag> cgal(scenario);
  for(unsigned int iterations : {1u, 10u})
  {
    cgal.run(iterations);
    expected.emplace(iterations, cgal.mesh());
  }
  double largest_of_all = 0;
  for_each_solver<Weight>([&](const auto& traits, const char* name) {
    const auto solver = traits.sparse_solver_object();
    using Solver = std::decay_t<decltype(solver)>;
    using Traits = CGAL::ARAP_deformation_traits<Solver, Weight, Rotation_after_identity>;
    bool is_identity = true;
    Our_deformation<Traits> ours(
      scenario, Traits(solver, Weight(), Rotation_after_identity(is_identity)), cells);
    double largest = 0;
    for(const auto& [iterations, mesh] : expected)
    {
      ours.run_after_identity(iterations, is_identity);
      largest = larger(largest, largest_distance(ours.mesh(), mesh) / scenario.diagonal);
    }
    const bool is_single = std::is_same_v<Solver, Single_precision_solver>;
    verify_at_most(largest, is_single ? 1e-5 : 1e-8,
                   std::string("the largest difference between our iterates and CGAL's, relative "
                               "to the bounding box, with the solver ") + name + ",");
    if(!is_single)
      largest_of_all = larger(largest_of_all, largest);
  });
  return largest_of_all;
}

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_DEFORMATIONS_H
