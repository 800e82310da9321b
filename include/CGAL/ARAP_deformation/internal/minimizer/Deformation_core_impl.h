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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_DEFORMATION_CORE_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_DEFORMATION_CORE_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_metric.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_region.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/coarse/blended_rotations.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_weight_model.h>
#include <CGAL/ARAP_deformation/internal/energy/laplacian_of.h>
#include <CGAL/ARAP_deformation/internal/energy/make_deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/weighted_edge_sets.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Harmonic_rotations.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Laplacian_guess.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Parts.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Rigid_start.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/minimizer/cell_rotations.h>
#include <CGAL/ARAP_deformation/internal/minimizer/minimize_global_local.h>
#include <CGAL/ARAP_deformation/internal/minimizer/minimize_local_global.h>
#include <CGAL/ARAP_deformation/internal/minimizer/minimize_quasi_newton.h>
#include <CGAL/ARAP_deformation/internal/minimizer/torn_parts.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>
#include <CGAL/ARAP_deformation/internal/region/contents.h>
#include <CGAL/ARAP_deformation/internal/rotation/rotation_vectors.h>
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system.h>
#include <CGAL/ARAP_deformation/internal/solver/free_components.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The largest length of a term of the energy, over the size of what can move: beyond it rounding
// hides all other terms.
constexpr double largest_length = 1e6;

struct Deformation_core::State
{
  Deformation_energy energy;
  Constrained_system system;
  Free_neighborhood free_neighborhood;
  std::optional<Stars> stars; // of the Laplacian guess, if there was one
  Array<int> components; // for each movable vertex, until there are parts: see there
  std::optional<Parts> parts;
  std::unique_ptr<Coarse_metric> coarse_metric; // once a run has made it
};

CGAL_ARAP_INLINE_FUNCTION
Deformation_core::Deformation_core(const Core_models& models, Region region,
                                   Energy_model energy_model, Minimization_order order,
                                   unsigned int number_of_threads)
  : m_models(models), m_region(std::move(region)), m_order(order)
{
  m_is_isolated = Array<char>(m_region.number_of_movable_vertices, true);
  for(int v : m_region.corners)
    if(v < m_region.number_of_movable_vertices)
      m_is_isolated[v] = false;
  update_weights(std::move(energy_model), number_of_threads);
}

CGAL_ARAP_INLINE_FUNCTION
void Deformation_core::update_weights(Energy_model energy_model, unsigned int number_of_threads)
{
  m_energy_model = std::move(energy_model);
  run_with_threads(threads(number_of_threads), [&] { m_diagnosis = prepare(); });
}

CGAL_ARAP_INLINE_FUNCTION
Deformation_core::~Deformation_core() = default;

CGAL_ARAP_INLINE_FUNCTION
Diagnosis Deformation_core::prepare()
{
  const std::size_t version = m_models.weight->version();
  if(const int v = find_non_finite(m_region.rest); v >= 0)
    return {Status::non_finite_point, v};
  Simplices simplices = weighted_simplices(*m_models.weight, m_region);
  if(const int s = find_non_finite_simplex(simplices); s >= 0)
    return {Status::non_finite_weight, -1, s};
  Deformation_energy energy =
    make_deformation_energy(*m_models.weight, std::move(simplices), m_energy_model, m_region);
  if(const int v = energy.find_vertex_of_non_finite_weight(); v >= 0)
    return {Status::non_finite_weight, v};
  Laplacian laplacian = laplacian_of(energy);
  if(m_state)
  {
    m_state->energy = std::move(energy);
    m_state->stars.reset();
    m_state->coarse_metric.reset();
  }
  else
    m_state.reset(new State{std::move(energy), Constrained_system(m_models.solver->copy()), {}, {},
                            {}, {}, {}});
  m_state->system.set_laplacian(std::move(laplacian));
  m_weights_version = version;
  return {};
}

CGAL_ARAP_INLINE_FUNCTION
Diagnosis Deformation_core::set_constraints(Constraints constraints,
                                            Unconstrained_components unconstrained,
                                            unsigned int number_of_threads, Stages& stages)
{
  Diagnosis diagnosis;
  run_with_threads(threads(number_of_threads), [&] {
    diagnosis = constrain(std::move(constraints), unconstrained, stages);
  });
  return diagnosis;
}

CGAL_ARAP_INLINE_FUNCTION
void Deformation_core::release_factor()
{
  m_state->system.release_factor();
  m_state->coarse_metric.reset();
  m_state->energy.clear_rotation_steps();
}

CGAL_ARAP_INLINE_FUNCTION
Diagnosis Deformation_core::constrain(Constraints constraints,
                                      Unconstrained_components unconstrained, Stages& stages)
{
  const int n = m_region.number_of_movable_vertices;
  const Free_components components =
    find_free_components(m_state->system.laplacian(), constraints);
  std::map<int, std::size_t> smallest_index; // of each unconstrained component
  bool are_there_others = false;
  for(int v = 0; v < n; ++v)
    if(components.is_unconstrained(v))
    {
      const std::size_t index = m_region.indices[v];
      std::size_t& smallest =
        smallest_index.emplace(components.component[v], index).first->second;
      smallest = (std::min)(smallest, index);
    }
    else
      are_there_others |= !constraints.is_fixed[v];
  if(!smallest_index.empty() &&
     (unconstrained == Unconstrained_components::refused ||
      (unconstrained == Unconstrained_components::fixed_beside_others && !are_there_others)))
    return {Status::no_fixed_vertex, smallest_index.begin()->first};
  for(int v = 0; v < n; ++v)
    constraints.is_fixed[v] |= components.is_unconstrained(v);
  if(!smallest_index.empty())
    constraints.rows.clear_weights_of_fixed(constraints.is_fixed);
  if(const int v = find_lost_row(constraints.hard_rows, constraints.is_fixed, components); v >= 0)
    return {Status::no_fixed_vertex, v};

  m_state->free_neighborhood = find_free_neighborhood(m_region, constraints.is_fixed);
  Bounding_box box;
  include_near(m_region.rest, box);
  m_squared_size = box.squared_length();
  if(m_squared_size > 0 && (std::max)(m_energy_model.bending_length,
                                      m_energy_model.smoothing_length) >
                             largest_length * std::sqrt(m_squared_size))
    return {Status::invalid_option};

  if(const Diagnosis prepared = m_state->system.prepare(constraints, stages);
     prepared.status != Status::success)
    return prepared;
  m_state->components = components.component;
  for(int v = 0; v < n; ++v)
    if(constraints.is_fixed[v])
      m_state->components[v] = components.is_unconstrained(v) || m_is_isolated[v] ? -2 : -1;
  m_state->parts.reset();
  m_state->energy.set_fixed(constraints.is_fixed, m_order == Minimization_order::global_first);
  m_constraints = std::move(constraints);
  m_unconstrained_components.clear();
  for(const auto& component : smallest_index)
    m_unconstrained_components.push_back(component.second);
  std::sort(m_unconstrained_components.begin(), m_unconstrained_components.end());
  return {};
}

CGAL_ARAP_INLINE_FUNCTION
void Deformation_core::include_near(const Array<Coordinates>& points,
                                    Bounding_box& box) const
{
  for(std::size_t v = 0; v < points.size(); ++v)
    if(m_state->free_neighborhood.is_near[v])
      box.include(points[v]);
}

CGAL_ARAP_INLINE_FUNCTION
int Deformation_core::number_of_cells() const
{
  return m_state->energy.number_of_cells();
}

CGAL_ARAP_INLINE_FUNCTION
Diagnosis Deformation_core::run(const Options& options, const Observer& observe,
                                Targets& targets, Array<Coordinates>& x,
                                Array<Matrix_3x3>& rotations, Report& report)
{
  Diagnosis diagnosis;
  run_with_threads(threads(options.threads), [&] {
    diagnosis = run_in_arena(options, observe, targets, x, rotations, report);
  });
  return diagnosis;
}

CGAL_ARAP_INLINE_FUNCTION
bool Deformation_core::are_rotations_state() const
{
  return m_state->energy.are_rotations_state();
}

CGAL_ARAP_INLINE_FUNCTION
void Deformation_core::complete(Array<Matrix_3x3>& rotations, const Array<Coordinates>& x,
                                unsigned int number_of_threads)
{
  if(m_are_rotations_complete || !are_rotations_state())
    return;
  rotations.clear();
  if(x != m_region.rest)
    run_with_threads(threads(number_of_threads), [&] {
      m_state->energy.set_given_rotations({}); // a run leaves those of its own targets
      m_state->energy.pause_rotation_steps();
      for(int k = 0; k <= 10; ++k) // then smooth them
        m_state->energy.fit_and_evaluate(m_models.closest_rotations, x, rotations, nullptr, k > 0);
    });
}

CGAL_ARAP_INLINE_FUNCTION
bool Deformation_core::are_all_placed(const Array<char>& is_placed) const
{
  return std::equal(is_placed.begin(), is_placed.end(), m_constraints.is_fixed.begin(),
                    [](char placed, char fixed) { return placed || fixed; });
}

// for each movable vertex, whether it is fixed or placed
CGAL_ARAP_INLINE_FUNCTION
Array<char> Deformation_core::staying(const Array<char>& is_placed) const
{
  Array<char> result = m_constraints.is_fixed;
  for(std::size_t v = 0; v < result.size(); ++v)
    result[v] = result[v] || is_placed[v];
  return result;
}

// Moves the free vertices of x that are not placed to the minimum of the energy of their Laplacian
// coordinates, if it is found.
CGAL_ARAP_INLINE_FUNCTION
Diagnosis Deformation_core::guess_by_laplacian(const Array<char>& is_placed, const Targets& targets,
                                               Array<Coordinates>& x, bool& is_found)
{
  if(!m_state->stars)
  {
    Stars stars = star_edge_sets(*m_models.weight,
                                 weighted_simplices(*m_models.weight, m_region), m_region);
    if(const int v = find_vertex_of_non_finite_weight(stars); v >= 0)
      return {Status::non_finite_weight, v};
    m_state->stars = std::move(stars);
  }
  const Array<Coordinates> before = x;
  Laplacian_guess guess(*m_state->stars, m_region, m_constraints, is_placed, m_state->system);
  if(!guess(targets, x))
    return {Status::solver_failed};
  // where rounding errors decide, as in parts that hardly any weight ties, it may be anywhere; a
  // bounding box takes no notice of what is no number
  Bounding_box box;
  include_near(m_region.rest, box);
  include_near(before, box);
  box.include(m_constraints.rows.places(targets.soft, before));
  box.include(m_constraints.hard_rows.places(targets.hard, before));
  const double size = box.squared_length();
  include_near(x, box);
  is_found = guess.is_found() && box.squared_length() <= 4 * size && find_non_finite(x) < 0;
  if(!is_found)
    x = before;
  return {};
}

// Whether a run on a coarser surface may tell where to start. It does not pay in volumes, which
// need few iterations, nor for elements, which hardly resist bending, nor for a preview or a frame;
// and that surface has no rows and no stiffness.
CGAL_ARAP_INLINE_FUNCTION
bool Deformation_core::can_have_coarse_start(const Options& options,
                                             const Array<char>& stays) const
{
  constexpr std::ptrdiff_t least_vertices = 20000; // with fewer it takes longer than it saves
  constexpr unsigned int least_iterations = 20;
  constexpr auto most_neighbors = static_cast<std::size_t>((std::numeric_limits<int>::max)());
  return m_region.dimension == 2 && has_vertex_cells() && options.iterations >= least_iterations &&
         std::count(stays.begin(), stays.end(), 0) >= least_vertices &&
         2 * m_region.corners.size() <= most_neighbors && // each corner has two
         m_constraints.rows.size() == 0 && m_constraints.hard_rows.size() == 0 &&
         m_energy_model.stiffness.empty();
}

// The rotation at each vertex that does not stay, from a run on a coarser surface. That begins at
// x, or if it is large, too, with a run on a still coarser one. None if that fails, or would take
// too long.
CGAL_ARAP_INLINE_FUNCTION
Array<Matrix_3x3> Deformation_core::coarse_rotations(const Options& options,
                                                     const Array<Coordinates>& x,
                                                     const Array<char>& stays) const
{
  Coarse_region coarse(m_region, stays, find_free_neighborhood(m_region, stays).is_near);
  const Coarse_space& space = coarse.space();
  if(space.number_of_nodes() > space.number_of_vertices() / 2)
    return {};
  Core_models models = m_models;
  models.weight = // the user's may depend on the mesh
    std::make_shared<Edge_weight_model_of<Safe_cotangent_weight>>(Safe_cotangent_weight());
  Energy_model energy_model;
  energy_model.cells = m_energy_model.cells;
  energy_model.bending_length = m_energy_model.bending_length;
  constexpr unsigned int threads = 0; // those of the arena that this is in
  Deformation_core core(models, coarse.release_region(), std::move(energy_model), m_order, threads);
  core.m_is_coarse = true;
  Constraints constraints;
  Array<Coordinates> positions;
  for(int node = 0; node < space.number_of_nodes(); ++node)
  {
    constraints.is_fixed.push_back(coarse.is_fixed(node));
    positions.push_back(x[space.vertex_of(node)]);
  }
  Stages stages;
  if(core.diagnosis().status != Status::success ||
     core.set_constraints(std::move(constraints), Unconstrained_components::fixed, threads,
                          stages).status != Status::success)
    return {};
  Options coarse_options;
  coarse_options.initial_guess = Initial_guess::previous;
  coarse_options.minimizer = Minimizer::quasi_newton;
  coarse_options.coarse_metric = options.coarse_metric;
  coarse_options.verify_minimum = false;
  coarse_options.iterations = 100;
  // it need not converge: the rest depends on the finer surface
  coarse_options.tolerance = (std::max)(3e-3, options.tolerance);
  Targets targets;
  Array<Matrix_3x3> rotations;
  Report report;
  const Status status =
    core.run(coarse_options, [](unsigned int, double) { return Visitor_action::proceed; }, targets,
             positions, rotations, report).status;
  if(status != Status::converged && status != Status::iteration_limit)
    return {};
  return blended_rotations(space, rotations, core.m_state->energy.fitted_cells());
}

// Whether the energy of each part depends on that part alone: no cell depends on others that are
// far away.
CGAL_ARAP_INLINE_FUNCTION
bool Deformation_core::is_local(const Targets& targets) const
{
  return m_energy_model.group.empty() && m_energy_model.smoothing_length == 0 &&
         m_energy_model.cells.rings() == 0 && targets.frames.empty();
}

CGAL_ARAP_INLINE_FUNCTION
const Parts& Deformation_core::parts()
{
  if(!m_state->parts)
  {
    m_state->parts.emplace(m_region, m_constraints, m_state->components);
    m_state->components = Array<int>();
  }
  return *m_state->parts;
}

// Moves x to where a run starts, but for rotations that do better: parts are at their minimum where
// a rigid motion takes them there, the Laplacian guess is made, hard targets are met.
CGAL_ARAP_INLINE_FUNCTION
Diagnosis Deformation_core::place(const Options& options, Targets& targets, Array<Coordinates>& x,
                                  Placement& placement)
{
  Array<char>& is_placed = placement.is_placed;
  Array<Coordinates>& unplaced = placement.unplaced;
  const bool is_laplacian = options.initial_guess == Initial_guess::laplacian;
  is_placed = Array<char>(m_constraints.is_fixed.size(), false);
  targets.project(m_constraints.rows, x);
  if(m_order == Minimization_order::local_first && m_constraints.inertia == 0)
  {
    // where a cell may have a negative energy, zero is not the least
    if(!is_local(targets) || !m_state->system.laplacian().is_sum_of_squares)
      unplaced = x;
    is_placed = Rigid_start(m_region, m_squared_size, parts(), m_constraints,
                            targets)(is_laplacian, x);
    if(std::find(is_placed.begin(), is_placed.end(), 1) == is_placed.end())
      Array<Coordinates>().swap(unplaced);
  }
  if(is_laplacian)
  {
    Diagnosis diagnosis;
    placement.is_laplacian = true;
    if(!are_all_placed(is_placed))
      diagnosis = guess_by_laplacian(is_placed, targets, x, placement.is_laplacian);
    if(!unplaced.empty() && diagnosis.status == Status::success)
      diagnosis = guess_by_laplacian(Array<char>(is_placed.size(), false), targets, unplaced,
                                     placement.is_unplaced_laplacian);
    if(diagnosis.status != Status::success)
      return diagnosis;
  }
  if(!m_state->system.meet(targets.hard, x) ||
     (!unplaced.empty() && !m_state->system.meet(targets.hard, unplaced)))
    return {Status::solver_failed};
  return {};
}

// The parts from which handles were torn away. If there is one, all others are placed, as they
// stay.
CGAL_ARAP_INLINE_FUNCTION
Array<int> Deformation_core::find_torn_parts(const Targets& targets, const Array<Coordinates>& x,
                                             Minimization& minimization, Array<char>& is_placed)
{
  Array<char> is_torn(parts().size(), false);
  find_torn(m_state->free_neighborhood.ties, m_region.rest, parts(), x, is_torn);
  find_torn(m_constraints, targets, parts(), x, [&]() -> const Array<Coordinates>& {
    minimization.evaluate();
    return minimization.force();
  }, is_torn);
  Array<int> torn;
  for(int part = 0; part < parts().size(); ++part)
    if(is_torn[part])
      torn.push_back(part);
  if(!torn.empty())
    for(int part = 0; part < parts().size(); ++part)
      if(!is_torn[part])
        set_placed(part, is_placed);
  return torn;
}

CGAL_ARAP_INLINE_FUNCTION
void Deformation_core::set_placed(int part, Array<char>& is_placed)
{
  for(int v : parts().free_vertices(part))
    is_placed[v] = true;
}

// Starts with smooth rotations instead of x if they are asked for; where handles were torn away, if
// that lowers the energy. Returns false if the solver fails.
CGAL_ARAP_INLINE_FUNCTION
bool Deformation_core::start_with_rotations(const Options& options, const Targets& targets,
                                            const Array<Coordinates>& x, Minimization& minimization,
                                            Array<char>& is_placed, Report& report)
{
  using Start = Minimization::Start;
  Array<int> torn;
  if(options.initial_guess == Initial_guess::automatic &&
     m_order == Minimization_order::local_first)
    torn = find_torn_parts(targets, x, minimization, is_placed);
  const bool is_tried = !torn.empty();
  if(are_all_placed(is_placed))
    return true;
  // for what does not stay, the rotations that rotation_of() makes of values, one for each vertex
  const auto start_with = [&](auto values, const auto& rotation_of, const Array<char>& stays,
                              bool only_if_lower) {
    const Start result = minimization.start_with([&](Array<Matrix_3x3>& to_set) {
      m_state->energy.complete(to_set);
      set_rotations_of_cells(m_region, has_vertex_cells(),
                             [&](std::size_t v) { return rotation_of(values[v]); }, to_set);
      decltype(values)().swap(values); // memory is at its peak from now on
    }, stays, only_if_lower);
    if(result == Start::taken)
      report.initial_guess = Initial_guess::rotations;
    return result;
  };
  Start start = Start::taken;
  if(is_tried || options.initial_guess == Initial_guess::rotations)
  {
    Array<Coordinates> vectors = [&] {
      Scoped_seconds seconds(report.seconds.initial_guess);
      return Harmonic_rotations(m_region, m_constraints, parts(),
                                m_state->free_neighborhood.is_near, targets,
                                x)(m_state->energy, m_state->system);
    }();
    // each part by itself, unless they are many: each try takes a solution and two local steps
    constexpr std::size_t most_tries = 8;
    if(!vectors.empty() && torn.size() > 1 && torn.size() <= most_tries && is_local(targets))
    {
      start = Start::rejected;
      for(int part : torn)
      {
        Array<char> others(is_placed.size(), true);
        for(int v : parts().free_vertices(part))
          others[v] = is_placed[v];
        const Start result = start_with(vectors, rotation_of_vector, others, true);
        if(result == Start::failed)
          return false;
        if(result == Start::taken)
          start = result;
        else
          set_placed(part, is_placed);
      }
    }
    else if(!vectors.empty())
      start = start_with(std::move(vectors), rotation_of_vector, is_placed, is_tried);
  }
  // where the guess is rejected, as where the last run ended with a spike, there is no reason to
  // begin again
  if((is_tried || m_is_coarse) && start == Start::taken && is_local(targets) &&
     is_quasi_newton(options) && can_have_coarse_start(options, staying(is_placed)))
  {
    Array<Matrix_3x3> rotations_of_vertices = [&] {
      Scoped_seconds seconds(report.seconds.initial_guess);
      return coarse_rotations(options, x, staying(is_placed));
    }();
    if(!rotations_of_vertices.empty())
      start = start_with(std::move(rotations_of_vertices),
                         [](const Matrix_3x3& rotation) { return rotation; }, is_placed, true);
  }
  return start != Start::failed;
}

CGAL_ARAP_INLINE_FUNCTION
Diagnosis Deformation_core::run_in_arena(const Options& options, const Observer& observe,
                                         Targets& targets, Array<Coordinates>& x,
                                         Array<Matrix_3x3>& rotations, Report& report)
{
  if(!rotations.empty()) // a cell that no longer counts leaves nothing to a later run
    m_state->energy.clear_others(rotations);
  Placement placement;
  {
    Scoped_seconds seconds(report.seconds.initial_guess);
    if(const Diagnosis placed = place(options, targets, x, placement);
       placed.status != Status::success)
      return placed;
  }
  m_state->energy.set_given_rotations(
    rotations_of_cells(m_region, has_vertex_cells(), number_of_cells(), targets.frames));
  if(are_rotations_state() && (is_quasi_newton(options) || options.tolerance > 0))
  {
    Scoped_seconds seconds(report.seconds.preprocess);
    // local/global is that of the papers; there the steps only tell how far it is from the minimum
    m_state->energy.prepare_rotation_steps(*m_models.solver, is_quasi_newton(options) ? 2 : 0);
  }
  else
    m_state->energy.pause_rotation_steps();
  Minimization minimization(m_state->energy, m_models.closest_rotations, m_state->system,
                            m_constraints, options, observe, m_region, targets, x, rotations,
                            m_state->coarse_metric, report);
  if(!placement.unplaced.empty())
  {
    x.swap(placement.unplaced);
    if(!minimization.try_positions(std::move(placement.unplaced)))
    {
      placement.is_placed.assign(placement.is_placed.size(), false);
      placement.is_laplacian = placement.is_unplaced_laplacian;
    }
  }
  if(placement.is_laplacian)
    report.initial_guess = Initial_guess::laplacian;
  if(!start_with_rotations(options, targets, x, minimization, placement.is_placed, report))
    return {Status::solver_failed};
  if(m_order == Minimization_order::global_first)
    return {minimize_global_local(minimization)};
  const bool are_rotations_all = minimization.is_nothing_free() && are_rotations_state();
  return {is_quasi_newton(options) && !are_rotations_all ? minimize_quasi_newton(minimization)
                                                         : minimize_local_global(minimization)};
}

CGAL_ARAP_INLINE_FUNCTION
std::size_t
Deformation_core::number_of_inverted_simplices(const Array<Coordinates>& x) const
{
  std::size_t count = 0;
  if(m_region.dimension == 3)
    for(int s = 0; s < m_region.number_of_simplices(); ++s)
    {
      const auto corners = m_region.corners_of(s);
      count += is_inverted([&](std::size_t k) { return x[corners[k]]; },
                           [&](std::size_t k) { return m_region.rest[corners[k]]; });
    }
  return count;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_DEFORMATION_CORE_IMPL_H
