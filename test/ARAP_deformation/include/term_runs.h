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

#ifndef CGAL_ARAP_DEFORMATION_TEST_TERM_RUNS_H
#define CGAL_ARAP_DEFORMATION_TEST_TERM_RUNS_H

// Runs with each of what the energy has beside the paper's, given by the numbers of the vertices of
// a shape: the same over all domains and with all solvers.

#include "domains.h"

#include <CGAL/ARAP_deformation/Dynamics.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

// what a run has beside a scenario
struct Term_run
{
  std::string name;
  CGAL::ARAP::Options options;
  bool stiffness = false, groups = false, frames = false, soft = false, points = false;
  bool sets = false;    // planes and lines as the soft targets
  int steps = 0;        // of time, instead of one run
  bool is_free = false; // nothing is fixed or pulled
};

// Each term with all cells that can have it, and all of them together.
inline std::vector<Term_run> term_runs(double diameter)
{
  using CGAL::ARAP::Minimizer;
  std::vector<Term_run> all;
  const auto add = [&](const std::string& name, const Cell_scheme& cells) -> Term_run& {
    all.push_back({name, options_for(cells, Minimizer::local_global)});
    return all.back();
  };
  for(const Cell_scheme& cells : all_cell_schemes)
  {
    add("smoothing", cells).options.smoothing_length = 0.1 * diameter;
    add("stiffness", cells).stiffness = true;
    add("groups", cells).groups = true;
    add("frames", cells).frames = true;
    add("soft", cells).soft = true;
    add("control points", cells).points = true;
    if(cells.has_vertex_cells())
      add("bending", cells).options.bending_length = 0.1 * diameter;
    Term_run& together = add("all", cells);
    together.options.smoothing_length = 0.05 * diameter;
    together.options.bending_length = cells.has_vertex_cells() ? 0.03 * diameter : 0;
    together.stiffness = together.groups = together.frames = together.soft = true;
    together.points = together.sets = true;
    Term_run& steps = all.emplace_back(together);
    steps.name = "steps";
    steps.steps = 3;
    Term_run& free_steps = add("free steps", cells);
    free_steps.options.smoothing_length = 0.1 * diameter;
    free_steps.steps = 5;
    free_steps.is_free = true;
    Term_run& sets = add("sets", cells);
    sets.soft = sets.sets = true;
  }
  add("2-ring", Cell_scheme::k_ring(2));
  return all;
}

// The vertices and simplices of a domain by the numbers of a shape: vertex k of the shape is
// vertices[k], and simplices are in the order of their sorted corners, whatever the domain's order.
template <typename Domain>
struct Numbering
{
  using Vertex = typename Domain::vertex_descriptor;
  using Simplex = typename Domain::simplex_descriptor;

  Numbering(const Domain& domain_, const std::vector<Vertex>& vertices) : domain(domain_)
  {
    for(std::size_t k = 0; k < vertices.size(); ++k)
      number.emplace(domain.index(vertices[k]), k);
    for(Vertex v : vertices)
      domain.for_each_incident_simplex(v, [&](Simplex s, const auto&) {
        std::vector<std::size_t> corners = corners_of(s);
        std::sort(corners.begin(), corners.end());
        simplices.emplace(corners, s);
      });
    for(const auto& [corners, s] : simplices)
      simplex_number.emplace(s, simplex_number.size());
  }

  // in the order of the domain
  std::vector<std::size_t> corners_of(Simplex s) const
  {
    std::vector<std::size_t> corners;
    for(Vertex v : domain.simplex_vertices(s))
      corners.push_back(number.at(domain.index(v)));
    return corners;
  }

  const Domain& domain;
  std::map<std::size_t, std::size_t> number; // of a vertex, by its index
  std::map<std::vector<std::size_t>, Simplex> simplices;
  std::map<Simplex, std::size_t> simplex_number;
};

// Time steps, each of twenty iterations, against what mechanics says of motions.
template <typename Deformation>
std::vector<double> advance(Deformation& deformation, const Term_run& run,
                            const std::vector<typename Deformation::vertex_descriptor>& vertices)
{
  using Domain = typename Deformation::Deformation_domain;
  CGAL::ARAP::Options options = run.options;
  options.iterations = 20;
  options.tolerance = 0;
  CHECK(deformation.set_options(options));
  CGAL::ARAP::Dynamics dynamics;
  dynamics.time_step = 0.02;
  dynamics.density = 2;
  dynamics.modulus = 20;
  dynamics.acceleration = {0.5, 0, -3};
  for(const auto& v : vertices)
  {
    const CGAL::ARAP::Coordinates p = Domain::coordinates(deformation.domain().point(v));
    deformation.set_velocity(v, Eigen::Vector3d(0.3 - p[1], p[0] + 0.4 * p[2], std::sin(p[0])));
  }
  std::vector<double> energies;
  CGAL::ARAP::Coordinates momentum = {};
  double energy = 0;
  for(int step = 0; step < run.steps; ++step)
  {
    const CGAL::ARAP::Step_report report = deformation.advance(dynamics);
    if(!CHECK(report))
      std::cerr << "    " << report.message << std::endl;
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    CHECK(report.stages.factor == (step == 0));
    energies.insert(energies.end(), report.energy.begin(), report.energy.end());
    double sum = report.kinetic_energy + report.elastic_energy;
    for(std::size_t k = 0; k < 3; ++k)
    {
      momentum[k] += dynamics.time_step * report.mass * dynamics.acceleration[k];
      if(step > 0 && run.is_free)
        CHECK_AT_MOST(std::abs(report.momentum[k] - momentum[k]),
                      1e-9 * std::sqrt(2 * report.mass * report.kinetic_energy));
      sum -= report.mass * dynamics.acceleration[k] * report.center_of_mass[k];
    }
    momentum = report.momentum;
    if(step > 0 && run.is_free)
      CHECK_AT_MOST(sum, energy + 1e-9 * report.kinetic_energy);
    energy = sum;
  }
  return energies;
}

// onto a plane or a line
template <typename Domain>
auto projection(bool is_onto_plane)
{
  return [is_onto_plane](const typename Domain::Point& p) {
    const CGAL::ARAP::Coordinates c = Domain::coordinates(p);
    const Eigen::Vector3d direction = Eigen::Vector3d(1, -2, 0.5).normalized(),
                          on_it(0.1, 0.2, 0.3), from(c[0], c[1], c[2]);
    const Eigen::Vector3d along = direction * direction.dot(from - on_it),
                          to = is_onto_plane ? Eigen::Vector3d(from - along) : on_it + along;
    return Domain::make_point({to[0], to[1], to[2]});
  };
}

// Ten iterations with the terms of a run, or its time steps.
template <typename Deformation>
Result deform_with(Deformation& deformation,
                   const std::vector<typename Deformation::vertex_descriptor>& vertices,
                   const Scenario& s, const Term_run& run)
{
  using Domain = typename Deformation::Deformation_domain;
  using Vertex = typename Domain::vertex_descriptor;
  using Simplex = typename Domain::simplex_descriptor;
  const Domain& domain = deformation.domain();
  const Numbering<Domain> numbering(domain, vertices);
  const auto of_vertex = [&](Vertex v) { return numbering.number.at(domain.index(v)); };
  const auto of_simplex = [&](Simplex t) { return numbering.simplex_number.at(t); };
  const auto stiffness = [](std::size_t k) { return 0.3 + double(7 * k % 5); };
  const auto group = [](std::size_t k) { return k % 7 < 2 ? int(k / 14) : -1; };

  CHECK(deformation.set_options(run.options));
  if(run.is_free)
    deformation.insert_roi_vertices(vertices);
  else
    prepare(deformation, s, vertices);
  const bool is_at_vertices = run.options.cells.has_vertex_cells();
  if(run.stiffness && is_at_vertices)
    deformation.set_stiffness([&](Vertex v) { return stiffness(of_vertex(v)); });
  else if(run.stiffness)
    deformation.set_stiffness([&](Simplex t) { return stiffness(of_simplex(t)); });
  if(run.groups && is_at_vertices)
    deformation.set_groups([&](Vertex v) { return group(of_vertex(v)); });
  else if(run.groups)
    deformation.set_groups([&](Simplex t) { return group(of_simplex(t)); });
  for(std::size_t k = 0; k < vertices.size(); ++k)
    if(s.selection[k] == 2)
    {
      if(run.soft && k % 3 != 0)
        CHECK(deformation.set_target_weight(vertices[k], 0.5 + double(k % 3)));
      if(run.sets && k % 3 != 0)
        CHECK(deformation.set_target_set(vertices[k], projection<Domain>(k % 3 == 1)));
      if(run.frames && k % 4 == 0)
        CHECK(deformation.set_target_rotation(vertices[k], Eigen::Quaterniond(Eigen::AngleAxisd(
          0.3 + 0.01 * double(k), Eigen::Vector3d(1, 0.2 * double(k % 5), -0.5).normalized()))));
    }
  std::vector<std::pair<std::vector<std::size_t>, Simplex>> inside; // with free corners only
  for(const auto& simplex : numbering.simplices)
    if(std::all_of(simplex.first.begin(), simplex.first.end(),
                   [&](std::size_t v) { return s.selection[v] == 1; }))
      inside.push_back(simplex);
  CHECK(inside.size() > 3);
  for(std::size_t k = 0; k < 4 && run.points && inside.size() > 3; ++k)
  {
    const auto& [sorted, simplex] = inside[(k + 1) * inside.size() / 5];
    std::vector<double> coordinates;
    for(std::size_t v : numbering.corners_of(simplex)) // the same place, whichever comes first
      coordinates.push_back(1 + double(std::lower_bound(sorted.begin(), sorted.end(), v) -
                                       sorted.begin()));
    for(double& c : coordinates)
      c *= 2.0 / double(sorted.size() * (sorted.size() + 1));
    const auto inserted = deformation.insert_control_point(simplex, coordinates);
    CHECK(inserted);
    CHECK(deformation.translate(inserted.point, Eigen::Vector3d(0.03, -0.02 * double(k), 0.04)));
    if(k % 2 == 1)
      CHECK(deformation.set_target_weight(inserted.point, 2.0));
  }
  Result result;
  if(run.steps > 0)
    result.energy = advance(deformation, run, vertices);
  else
  {
    const CGAL::ARAP::Report report = deformation.deform(10, 0);
    if(!CHECK(report))
      std::cerr << "    " << report.message << std::endl;
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    result.energy = report.energy;
  }
  for(const Vertex& v : vertices)
  {
    const CGAL::ARAP::Coordinates c = Domain::coordinates(domain.point(v));
    result.points.emplace_back(c[0], c[1], c[2]);
  }
  return result;
}

// All terms over a domain, which make() makes with its vertices in the order of the points, against
// the domain of ranges.
template <int Dimension, typename Simplices, typename Make>
void test_terms(const std::vector<Eigen::Vector3d>& points, const Simplices& simplices,
                const Scenario& s, const Make& make)
{
  using Soup = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;
  const std::string name = test_case();
  const double diameter = diameter_of(points);
  for(const Term_run& run : term_runs(diameter))
  {
    test_case() = name + ", " + run.name;
    std::vector<Point> copy = points_of(points);
    CGAL::ARAP_deformation<Soup> expected(Soup(copy, simplices));
    const Result a = deform_with(expected, numbers(points.size()), s, run);
    make([&](const auto& domain, const auto& vertices) {
      CGAL::ARAP_deformation<std::decay_t<decltype(domain)>> deformation(domain);
      compare(a, deform_with(deformation, vertices, s, run), diameter);
    });
  }
  test_case() = name;
}

#endif // CGAL_ARAP_DEFORMATION_TEST_TERM_RUNS_H
