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

#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/laplacian_of.h>
#include <CGAL/ARAP_deformation/internal/energy/weighted_edge_sets.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Laplacian_guess.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/minimizer/minimize_global_local.h>
#include <CGAL/ARAP_deformation/internal/minimizer/minimize_local_global.h>
#include <CGAL/ARAP_deformation/internal/minimizer/minimize_quasi_newton.h>
#include <CGAL/ARAP_deformation/internal/minimizer/rigid_start.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system.h>
#include <CGAL/ARAP_deformation/internal/solver/unconstrained_components.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

struct Deformation_core::State
{
  Deformation_energy energy;
  Constrained_system system;
  std::optional<Stars> stars; // of the Laplacian guess, if there was one
};

CGAL_ARAP_INLINE_FUNCTION
Deformation_core::Deformation_core(const Core_models& models, Region region, Cell_scheme cells,
                                   Minimization_order order, unsigned int number_of_threads)
  : m_models(models), m_region(std::move(region)), m_cells(cells), m_order(order)
{
  m_is_isolated = Array<char>(m_region.number_of_movable_vertices, true);
  for(int v : m_region.corners)
    if(v < m_region.number_of_movable_vertices)
      m_is_isolated[v] = false;
  Bounding_box box;
  box.include(m_region.rest);
  m_squared_size = box.squared_length();
  update_weights(number_of_threads);
}

CGAL_ARAP_INLINE_FUNCTION
void Deformation_core::update_weights(unsigned int number_of_threads)
{
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
    make_deformation_energy(*m_models.weight, std::move(simplices), m_cells, m_region);
  if(const int v = energy.find_vertex_of_non_finite_weight(); v >= 0)
    return {Status::non_finite_weight, v};
  m_rotations.resize(static_cast<std::size_t>(energy.number_of_cells()), identity_matrix());
  Laplacian laplacian = laplacian_of(energy);
  if(m_state)
  {
    m_state->energy = std::move(energy);
    m_state->stars.reset();
  }
  else
    m_state.reset(new State{std::move(energy), Constrained_system(m_models.solver->copy()), {}});
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
}

CGAL_ARAP_INLINE_FUNCTION
Diagnosis Deformation_core::constrain(Constraints constraints,
                                      Unconstrained_components unconstrained, Stages& stages)
{
  const std::vector<int> components =
    find_unconstrained_components(m_state->system.laplacian(), constraints);
  std::map<int, std::size_t> smallest_index; // of each component
  bool are_there_others = false;
  for(std::size_t v = 0; v < components.size(); ++v)
    if(components[v] >= 0)
    {
      const std::size_t index = m_region.indices[v];
      std::size_t& smallest = smallest_index.emplace(components[v], index).first->second;
      smallest = (std::min)(smallest, index);
    }
    else
      are_there_others |= !constraints.is_fixed[v];
  if(!smallest_index.empty() &&
     (unconstrained == Unconstrained_components::refused ||
      (unconstrained == Unconstrained_components::fixed_beside_others && !are_there_others)))
    return {Status::no_fixed_vertex, smallest_index.begin()->first};
  for(std::size_t v = 0; v < components.size(); ++v)
    constraints.is_fixed[v] |= components[v] >= 0;

  if(constraints.hard_rows.size() > Hard_rows::most_rows)
    return {Status::too_many_control_points};
  if(const int r = Hard_rows(constraints).find_dependent(); r >= 0)
    return {Status::dependent_target, -1, -1, r};
  if(const int v = m_state->system.find_singular_vertex(constraints); v >= 0)
    return {Status::singular_matrix, v};
  Constrained_system::Work work;
  const bool is_ready = m_state->system.prepare(constraints, work);
  stages.order |= work.order;
  stages.factor |= work.factor;
  stages.border |= work.border;
  if(!is_ready)
    return {Status::singular_matrix};
  m_state->energy.set_fixed(constraints.is_fixed, m_order == Minimization_order::global_first,
                            m_rotations);
  m_is_untied = m_is_isolated;
  for(std::size_t v = 0; v < components.size(); ++v)
    m_is_untied[v] |= components[v] >= 0;
  m_constraints = std::move(constraints);
  m_unconstrained_components.clear();
  for(const auto& component : smallest_index)
    m_unconstrained_components.push_back(component.second);
  std::sort(m_unconstrained_components.begin(), m_unconstrained_components.end());
  return {};
}

CGAL_ARAP_INLINE_FUNCTION
void Deformation_core::reset_rotations()
{
  std::fill(m_rotations.begin(), m_rotations.end(), identity_matrix());
}

CGAL_ARAP_INLINE_FUNCTION
Diagnosis Deformation_core::run(const Options& options, const Observer& observe,
                                Targets& targets, std::vector<Coordinates>& x,
                                std::vector<Matrix_3x3>& rotations, Report& report)
{
  Diagnosis diagnosis;
  run_with_threads(threads(options.threads), [&] {
    diagnosis = run_in_arena(options, observe, targets, x, rotations, report);
  });
  return diagnosis;
}

CGAL_ARAP_INLINE_FUNCTION
Diagnosis Deformation_core::run_in_arena(const Options& options, const Observer& observe,
                                         Targets& targets, std::vector<Coordinates>& x,
                                         std::vector<Matrix_3x3>& rotations, Report& report)
{
  {
    Scoped_seconds seconds(report.seconds.initial_guess);
    targets.project(m_constraints.rows, x);
  }
  if(options.initial_guess == Initial_guess::laplacian &&
     m_constraints.number_of_free_vertices() > 0)
  {
    Scoped_seconds seconds(report.seconds.initial_guess);
    if(!m_state->stars)
      m_state->stars = star_edge_sets(*m_models.weight,
                                      weighted_simplices(*m_models.weight, m_region), m_region);
    const std::vector<Coordinates> before = x;
    if(!Laplacian_guess(*m_state->stars, m_region, m_constraints, m_state->system)(targets, x))
      return {Status::solver_failed};
    // where rounding errors decide, as in parts that hardly any weight ties, it may be anywhere
    Bounding_box box;
    box.include(m_region.rest);
    box.include(before);
    box.include(targets.soft);
    box.include(targets.hard);
    const double size = box.squared_length();
    box.include(x);
    if(!(box.squared_length() <= 4 * size))
      x = before;
  }
  if(options.initial_guess == Initial_guess::previous &&
     m_order == Minimization_order::local_first &&
     m_constraints.number_of_free_vertices() > 0)
    start_rigidly(m_region, m_squared_size, m_constraints, m_is_untied, targets, x);
  {
    Scoped_seconds seconds(report.seconds.initial_guess);
    if(!m_state->system.meet(targets.hard, x))
      return {Status::solver_failed};
  }
  Minimization minimization(m_state->energy, m_models.closest_rotations, m_state->system,
                            m_constraints, options, observe, targets, x, rotations, report);
  if(m_order == Minimization_order::global_first)
    return {minimize_global_local(minimization)};
  const bool is_quasi_newton =
    options.minimizer == Minimizer::quasi_newton ||
    (options.minimizer == Minimizer::automatic && options.tolerance > 0);
  return {is_quasi_newton ? minimize_quasi_newton(minimization)
                          : minimize_local_global(minimization)};
}

CGAL_ARAP_INLINE_FUNCTION
std::size_t
Deformation_core::number_of_inverted_simplices(const std::vector<Coordinates>& x) const
{
  // the sign of the volume of the tetrahedron s
  const auto orientation = [this](int s, const Coordinates* points) {
    const int* c = m_region.corners_of(s);
    const double volume =
      dot(cross(difference(points[c[1]], points[c[0]]), difference(points[c[2]], points[c[0]])),
          difference(points[c[3]], points[c[0]]));
    return (volume > 0) - (volume < 0);
  };
  std::size_t count = 0;
  if(m_region.dimension == 3)
    for(int s = 0; s < m_region.number_of_simplices(); ++s)
      count += orientation(s, m_region.rest.data()) * orientation(s, x.data()) < 0;
  return count;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_DEFORMATION_CORE_IMPL_H
