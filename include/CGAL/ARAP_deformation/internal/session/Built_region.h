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
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/domain/Domain_region.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core.h>
#include <CGAL/ARAP_deformation/internal/region/Paged_index_map.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Built_core.h>
#include <CGAL/ARAP_deformation/internal/session/Cell_values.h>
#include <CGAL/ARAP_deformation/internal/session/Region_constraints.h>
#include <CGAL/ARAP_deformation/internal/session/Session_rules.h>
#include <CGAL/ARAP_deformation/internal/session/Session_vertices.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <cstddef>
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
  bool are_complete = false; // see Deformation_core
};

// A region with its positions and its core.
template <typename Domain>
struct Built_region : Built_core
{
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using Point = typename Domain::Point;
  using Vertices = Session_vertices<Domain>;

  // without its flat part, which the core owns
  std::shared_ptr<Domain_region<Domain>> region = std::make_shared<Domain_region<Domain>>();

  // of the vertices that had an entry when the region was made, by the places of the entries: their
  // numbers in the region, or -1
  Array<int> numbers_of_entries;

  using Built_core::Built_core;

  int number_of_entry(std::size_t k) const
  {
    return k < numbers_of_entries.size() ? numbers_of_entries[k] : Paged_index_map::none;
  }

  // Collects the region, in the rest shape and at the present points, and computes what depends on
  // it alone.
  Outcome make(const Vertices& vertices, const Cell_values<Domain>& values, const Models& models,
               const Options& options, const Session_rules& rules)
  {
    const Domain& domain = vertices.domain();
    std::vector<vertex_descriptor> movable = vertices.select([&](const auto& e) {
      return e.is_roi && (is_whole || !vertices.is_hard_control(e));
    });
    if(!is_whole)
      append_neighbors(vertices, movable);
    if(!region->collect(domain, movable, static_cast<int>(options.cells.rings())))
      return outcome_of_vertex(region->refusal(), region->refused_vertex());

    numbers_of_entries.reserve(vertices.entries().size());
    for(const auto& entry : vertices.entries())
      numbers_of_entries.push_back(region->find_vertex(domain, entry.vertex));
    for(vertex_descriptor v : region->vertices)
    {
      const auto* entry = vertices.find(v);
      if(entry && !entry->is_roi && rules.are_erased_put_back)
      {
        const Point point = entry->was_roi ? entry->rest : domain.point(v);
        add_points(Domain::coordinates(point), Domain::coordinates(point), region->flat);
      }
      else
        add_points(Domain::coordinates(vertices.present(v)), Domain::coordinates(vertices.rest(v)),
                   region->flat);
    }
    if(const int v = find_non_finite(positions); v >= 0)
      return outcome_of_vertex(Status::non_finite_point, region->flat.indices[v]);
    Energy_model model;
    if(Outcome filled = values.fill_in(model, options, domain, *region, region->flat); !filled)
      return filled;
    return make_core(models, region->flat, model, rules.order, options);
  }

  // with the weight of the inertia of a unit of area or volume, or 0
  void collect_constraints(const Vertices& vertices, const Session_rules& rules, double inertia,
                           Region_constraints& constraints) const
  {
    const Domain& domain = vertices.domain();
    for(std::size_t k = 0; k < vertices.entries().size(); ++k)
    {
      const auto& entry = vertices.entries()[k];
      if(!entry.is_roi)
        continue;
      if(entry.is_control)
        constraints.rows().controls.push_back(k);
      const int v = number_of_entry(k);
      const bool can_move = is_movable(v);
      const bool is_isolated = can_move ? core->is_isolated(v)
                                        : entry.is_control && domain.is_isolated(entry.vertex);
      if(entry.is_control && is_isolated)
        constraints.rows().isolated_controls.push_back(domain.index(entry.vertex));
      if(!can_move)
        continue;
      if(vertices.is_pulled(entry))
        constraints.pull(v, vertices.whole_target(entry).weight);
      else if(vertices.is_hard_control(entry) || (is_isolated && !rules.are_unconstrained_refused))
        constraints.fix(v);
    }
    for(const auto& [point, held] : vertices.points())
    {
      std::vector<int> corners;
      for(vertex_descriptor corner : held.corners)
        corners.push_back(region->find_vertex(domain, corner));
      if(held.target.is_pull())
        constraints.pull(point, corners, held.coordinates, held.target.weight);
      else if(held.target.is_hard())
        constraints.fix(point, corners, held.coordinates);
    }
    if(inertia > 0)
      constraints.add_inertia(inertia);
  }

  Cell_rotations<Domain> rotations_of_cells() const
  {
    return {region, core->rotations(), core->are_rotations_complete()};
  }

  // The rotations that these cells have in another region, the identity where they have none. None
  // if there are none.
  Cell_rotations<Domain> rotations_from(const Cell_rotations<Domain>& others,
                                        const Domain& domain) const
  {
    Cell_rotations<Domain> result{region, {}, others.are_complete};
    if(others.rotations.empty())
      return result;
    result.rotations = Array<Matrix_3x3>(core->number_of_cells(), identity_matrix());
    const bool are_at_vertices = core->has_vertex_cells();
    for(std::size_t c = 0; c < result.rotations.size(); ++c)
      if(const int old = are_at_vertices
                           ? others.region->find_vertex(domain, region->vertices[c])
                           : others.region->find_simplex(domain, region->simplices[c]);
         old >= 0 && old < static_cast<int>(others.rotations.size()))
        result.rotations[c] = others.rotations[old];
      else
        result.are_complete = false;
    return result;
  }

  void take_rotations(const Cell_rotations<Domain>& others, const Domain& domain)
  {
    Cell_rotations<Domain> own = rotations_from(others, domain);
    core->set_rotations(std::move(own.rotations), own.are_complete);
  }

private:
  // adds the vertices of the region of interest that are in a simplex with one of those
  static void append_neighbors(const Vertices& vertices, std::vector<vertex_descriptor>& movable)
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
