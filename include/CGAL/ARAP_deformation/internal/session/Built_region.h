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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_BUILT_REGION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_BUILT_REGION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/domain/Domain_region.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core.h>
#include <CGAL/ARAP_deformation/internal/region/Paged_index_map.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Cell_values.h>
#include <CGAL/ARAP_deformation/internal/session/Region_constraints.h>
#include <CGAL/ARAP_deformation/internal/session/Session_rules.h>
#include <CGAL/ARAP_deformation/internal/session/Session_vertices.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Rotations with the region whose cells they are of, or nothing.
template <typename Domain>
struct Cell_rotations
{
  std::shared_ptr<const Domain_region<Domain>> region;
  Array<Matrix_3x3> rotations;
};

// A region with its positions and its core.
template <typename Domain>
struct Built_region
{
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using Point = typename Domain::Point;
  using Vertices = Session_vertices<Domain>;
  using Models = std::function<Core_models()>; // makes those of one region

  std::size_t numbering; // of the vertices: no other region has the same
  // without its flat part, which the core owns
  std::shared_ptr<Domain_region<Domain>> region = std::make_shared<Domain_region<Domain>>();
  Array<Coordinates> positions;
  std::unique_ptr<Deformation_core> core;
  bool is_whole; // whether all of the region of interest is movable

  Built_region(std::size_t number, bool is_whole_) : numbering(number), is_whole(is_whole_) {}

  bool is_movable(int v) const
  {
    return v >= 0 && v < core->region().number_of_movable_vertices;
  }

  // Collects the region, in the rest shape and at the present points, and computes what depends on
  // it alone.
  Outcome make(const Vertices& vertices, const Cell_values<Domain>& values, const Models& models,
               const Options& options, const Session_rules& rules)
  {
    const Domain& domain = vertices.domain();
    const auto name = [&](vertex_descriptor v) { return vertex_name(domain.index(v)); };
    std::vector<vertex_descriptor> movable = vertices.select([&](const auto& e) {
      return e.is_roi && (is_whole || !vertices.is_hard_control(e));
    });
    if(!is_whole)
      append_neighbours(vertices, movable);
    if(!region->collect(domain, movable, static_cast<int>(options.cells.rings())))
      return outcome(region->refusal(), name(region->refused_vertex()));

    positions.reserve(region->vertices.size());
    region->flat.rest.reserve(region->vertices.size());
    for(vertex_descriptor v : region->vertices)
    {
      const auto* entry = vertices.find(v);
      if(entry && !entry->is_roi && rules.are_erased_put_back)
      {
        const Point point = entry->was_roi ? entry->rest : domain.point(v);
        positions.push_back(Domain::coordinates(point));
        region->flat.rest.push_back(positions.back());
        continue;
      }
      positions.push_back(Domain::coordinates(vertices.present(v)));
      region->flat.rest.push_back(Domain::coordinates(vertices.rest(v)));
    }
    if(const int v = find_non_finite(positions); v >= 0)
      return outcome(Status::non_finite_point, name(region->vertices[v]));
    Energy_model model;
    if(Outcome filled = values.fill_in(model, options, domain, *region, region->flat); !filled)
      return filled;
    core = std::make_unique<Deformation_core>(
      models(), std::move(region->flat), std::move(model), rules.order, options.threads);
    return explain(core->diagnosis(), domain);
  }

  // with the weight of the inertia of a unit of area or volume, or 0
  void collect_constraints(const Vertices& vertices, const Session_rules& rules, double inertia,
                           Region_constraints& constraints) const
  {
    const Domain& domain = vertices.domain();
    for(const auto& entry : vertices.entries())
    {
      if(!entry.is_roi)
        continue;
      const int v = region->find_vertex(domain, entry.vertex);
      const bool can_move = is_movable(v);
      const bool is_isolated = can_move ? core->is_isolated(v)
                                        : entry.is_control && domain.is_isolated(entry.vertex);
      if(entry.is_control && is_isolated)
        constraints.add_isolated_control(domain.index(entry.vertex));
      if(!can_move)
        continue;
      if(vertices.is_pulled(entry))
        constraints.pull(v, vertices.weight(entry));
      else if(vertices.is_hard_control(entry) || (is_isolated && !rules.are_unconstrained_refused))
        constraints.fix(v);
    }
    for(const auto& [point, held] : vertices.points())
    {
      std::vector<int> corners;
      for(vertex_descriptor corner : held.corners)
        corners.push_back(region->find_vertex(domain, corner));
      if(Vertices::is_pull(held.target.weight))
        constraints.pull(point, corners, held.coordinates, held.target.weight);
      else if(held.target.weight == Vertices::hard)
        constraints.fix(point, corners, held.coordinates);
    }
    if(inertia > 0)
      constraints.add_inertia(inertia);
  }

  // The rotations that these cells have elsewhere, the identity where they have none. None if there
  // are none.
  Array<Matrix_3x3> rotations_from(const Cell_rotations<Domain>& from, const Domain& domain) const
  {
    if(!from.region || from.rotations.empty())
      return {};
    Array<Matrix_3x3> rotations(core->number_of_cells(), identity_matrix());
    const bool are_at_vertices = core->has_vertex_cells();
    for(std::size_t c = 0; c < rotations.size(); ++c)
      if(const int old = are_at_vertices
                           ? from.region->find_vertex(domain, region->vertices[c])
                           : from.region->find_simplex(domain, region->simplices[c]);
         old >= 0 && old < static_cast<int>(from.rotations.size()))
        rotations[c] = from.rotations[old];
    return rotations;
  }

  // a sentence on what the core found
  Outcome explain(const Diagnosis& diagnosis, const Domain& domain) const
  {
    if(diagnosis.vertex >= 0)
      return outcome(diagnosis.status,
                     vertex_name(domain.index(region->vertices[diagnosis.vertex])));
    if(diagnosis.simplex < 0)
      return outcome(diagnosis.status);
    return outcome(diagnosis.status, simplex_name(core->region(), diagnosis.simplex));
  }

private:
  // adds the vertices of the region of interest that are in a simplex with one of those
  static void append_neighbours(const Vertices& vertices, std::vector<vertex_descriptor>& movable)
  {
    const Domain& domain = vertices.domain();
    Paged_index_map is_there;
    const std::size_t number_of_free = movable.size();
    for(vertex_descriptor v : movable)
      is_there.set(domain.index(v), 1);
    for(std::size_t k = 0; k < number_of_free; ++k)
      domain.for_each_incident_simplex(movable[k], [&](const auto&, const auto& corners) {
        for(vertex_descriptor corner : corners)
          if(const std::size_t index = domain.index(corner);
             is_there[index] == Paged_index_map::none && vertices.is_roi(corner))
          {
            is_there.set(index, 1);
            movable.push_back(corner);
          }
      });
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_BUILT_REGION_H
