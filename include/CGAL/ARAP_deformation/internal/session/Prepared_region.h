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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_PREPARED_REGION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_PREPARED_REGION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/Domain_region.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Session_vertices.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>
#include <CGAL/ARAP_deformation/internal/solver/Laplacian_solver.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// What is computed from the vertices of a session before a run: the region, the positions of its
// vertices, and the core.
template <typename Domain, typename Traits>
class Prepared_region
{
public:
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using Vertices = Session_vertices<Domain>;
  using Core = Deformation_core<Traits>;

  // the core, or nullptr if there is none that is up to date
  Core* core() { return m_core ? &*m_core : nullptr; }
  const Core* core() const { return m_core ? &*m_core : nullptr; }

  const Domain_region<Domain>& region() const { return m_region; }

  // of the vertices of the region
  std::vector<Coordinates>& positions() { return m_positions; }

  // the smallest index of the vertices of each component of the region that nothing holds
  const std::vector<std::size_t>& unconstrained_components() const
  {
    return m_unconstrained_components;
  }

  // To be called when what the core was made of changes. Its factor may be of use for other free
  // vertices, but not for other weights.
  void discard(bool are_weights_the_same)
  {
    if(!are_weights_the_same)
      m_idle_solver = {};
    else if(m_core)
      m_idle_solver = m_core->take_solver();
    m_core.reset();
  }

  // Makes the core for all that is fixed, unless it is up to date. What nothing holds stays where
  // it is, unless there is nothing else.
  Outcome prepare(const Vertices& vertices, const Traits& traits, const Options& options)
  {
    if(m_core)
      return outcome(Status::success);
    const auto& entries = vertices.entries();
    const auto is_there = [&](const auto& predicate) {
      return std::any_of(entries.begin(), entries.end(), predicate);
    };
    const auto is_roi = [](const auto& e) { return e.is_roi; };
    const auto is_tied = [&](const auto& e) {
      return e.is_roi && !vertices.domain().is_isolated(e.vertex);
    };
    if(is_there(is_roi) && !is_there(is_tied))
      return outcome(Status::no_simplex);

    const auto is_hard = [&](const auto& e) { return vertices.is_hard_control(e); };
    std::vector<vertex_descriptor> free_vertices = vertices.select([&](const auto& e) {
      return !is_hard(e) && (is_tied(e) || vertices.is_pulled(e));
    });
    std::vector<std::size_t> unconstrained_components;
    Outcome prepared = prepare(vertices, traits, options, free_vertices, unconstrained_components);
    if(prepared.status == Status::no_fixed_vertex &&
       (!free_vertices.empty() || is_there(is_hard)))
      prepared = prepare(vertices, traits, options, free_vertices, unconstrained_components);
    return prepared;
  }

  // a sentence on what the core found
  Outcome explain(const Diagnosis& diagnosis, const Domain& domain) const
  {
    return explain(diagnosis, domain, m_region, *m_core);
  }

private:
  using Region_ = Domain_region<Domain>;

  // Makes the core for these free vertices. If nothing holds some of them, they are erased, and
  // each of their components adds the smallest index of its vertices to `unconstrained_components`.
  Outcome prepare(const Vertices& vertices, const Traits& traits, const Options& options,
                  std::vector<vertex_descriptor>& free_vertices,
                  std::vector<std::size_t>& unconstrained_components)
  {
    const Domain& domain = vertices.domain();
    const auto name = [&](vertex_descriptor v) { return vertex_name(domain.index(v)); };
    Region_ region;
    if(!region.collect(domain, free_vertices))
      return outcome(Status::not_a_simplex, name(region.refused_vertex()));

    std::vector<Coordinates> positions;
    positions.reserve(region.vertices.size());
    region.flat.rest.reserve(region.vertices.size());
    for(vertex_descriptor v : region.vertices)
    {
      positions.push_back(Domain::coordinates(vertices.present(v)));
      const auto* entry = vertices.find(v);
      region.flat.rest.push_back(entry ? Domain::coordinates(entry->rest) : positions.back());
    }
    if(const int v = find_non_finite(positions); v >= 0)
      return outcome(Status::non_finite_point, name(region.vertices[v]));
    for(const auto& entry : vertices.entries())
      if(vertices.is_pulled(entry))
        region.flat.soft_positions.push_back({region.find_vertex(domain, entry.vertex),
                                              vertices.weight(entry)});

    std::optional<Core> core;
    core.emplace(traits, std::move(region.flat), options, std::exchange(m_idle_solver, {}));
    if(core->diagnosis().status != Status::success)
    {
      m_idle_solver = core->take_solver();
      if(core->diagnosis().status == Status::no_fixed_vertex)
        erase_unconstrained_components(domain, region, core->diagnosis().components,
                                       free_vertices, unconstrained_components);
      return explain(core->diagnosis(), domain, region, *core);
    }
    Outcome ready = outcome(Status::success);
    m_region = std::move(region);
    m_positions = std::move(positions);
    m_unconstrained_components = std::move(unconstrained_components);
    m_core = std::move(core);
    return ready;
  }

  static void erase_unconstrained_components(const Domain& domain, const Region_& region,
                                     const std::vector<int>& components,
                                     std::vector<vertex_descriptor>& free_vertices,
                                     std::vector<std::size_t>& unconstrained_components)
  {
    std::map<int, std::size_t> smallest_indices; // of the components
    const auto is_unconstrained = [&](vertex_descriptor v) {
      const int component = components[region.find_vertex(domain, v)];
      if(component < 0)
        return false;
      const std::size_t index = domain.index(v);
      std::size_t& smallest = smallest_indices.emplace(component, index).first->second;
      smallest = (std::min)(smallest, index);
      return true;
    };
    free_vertices.erase(
      std::remove_if(free_vertices.begin(), free_vertices.end(), is_unconstrained),
      free_vertices.end());
    for(const auto& component : smallest_indices)
      unconstrained_components.push_back(component.second);
    std::sort(unconstrained_components.begin(), unconstrained_components.end());
  }

  static Outcome explain(const Diagnosis& diagnosis, const Domain& domain, const Region_& region,
                         const Core& core)
  {
    if(diagnosis.vertex >= 0)
      return outcome(diagnosis.status,
                     vertex_name(domain.index(region.vertices[diagnosis.vertex])));
    if(diagnosis.simplex < 0)
      return outcome(diagnosis.status);
    return outcome(diagnosis.status, simplex_name(core.region(), diagnosis.simplex));
  }

  Laplacian_solver<typename Traits::Sparse_solver> m_idle_solver; // of a core that was discarded

  // up to date if m_core has a value
  Region_ m_region;
  std::vector<std::size_t> m_unconstrained_components;
  std::vector<Coordinates> m_positions;
  std::optional<Core> m_core;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_PREPARED_REGION_H
