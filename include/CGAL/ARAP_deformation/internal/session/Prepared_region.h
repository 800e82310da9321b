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
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/domain/Domain_region.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Built_region.h>
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

// What is computed from the vertices of a session before a run: the region, the positions of its
// vertices, and the core with the constraints. The one place that decides what a change costs.
template <typename Domain>
class Prepared_region
{
public:
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using Point = typename Domain::Point;
  using Vertices = Session_vertices<Domain>;
  using Models = Built_core::Models;

  // Of the sets of vertices, with all that the stages depend on: what has the same version is the
  // same.
  struct Versions
  {
    std::size_t region, values, constraints;
  };

  Prepared_region(const Session_rules& rules, Models make_models)
    : m_rules(rules), m_models(std::move(make_models))
  {}

  // Whether there is a region for the present region of interest, cells and rest shape.
  bool has_region() const { return has_region_of(m_present); }

  // These need has_region().
  const Domain_region<Domain>& region() const { return *m_prepared->region; }
  int number_of_entry(std::size_t k) const { return m_prepared->number_of_entry(k); }
  Built_core& built() { return *m_prepared; }
  Deformation_core& core() { return *m_prepared->core; }
  const Deformation_core& core() const { return *m_prepared->core; }

  // of the vertices of the region
  Array<Coordinates>& positions() { return m_prepared->positions; }
  const Array<Coordinates>& positions() const { return m_prepared->positions; }

  // Others have moved the vertex of an entry.
  void set_position(std::size_t k, const Coordinates& position)
  {
    m_last.are_complete = false;
    if(!has_region())
      return;
    set_position(k, position, m_prepared->positions);
    core().outdate_rotations();
  }

  // the same in other positions of the vertices of the region
  void set_position(std::size_t k, const Coordinates& position,
                    Array<Coordinates>& positions) const
  {
    if(const int v = number_of_entry(k); v >= 0)
      positions[v] = position;
  }

  // Reads the points around the region of interest again, which have no entries.
  void read_surroundings(const Vertices& vertices)
  {
    if(!has_region())
      return;
    Array<Coordinates>& positions = m_prepared->positions;
    for(int v = core().region().number_of_movable_vertices;
        v < core().region().number_of_vertices(); ++v)
      if(!vertices.find(region().vertices[v]))
        positions[v] = Domain::coordinates(vertices.domain().point(region().vertices[v]));
  }

  // The rotation after the last run of the cell find_cell(region), the identity if there is none.
  template <typename Function>
  Matrix_3x3 rotation_of_cell(const Function& find_cell) const
  {
    const int cell = find_cell(m_last.region ? *m_last.region : region());
    const Array<Matrix_3x3>& rotations = m_last.region ? m_last.rotations : core().rotations();
    return cell >= 0 && cell < static_cast<int>(rotations.size()) ? rotations[cell]
                                                                  : identity_matrix();
  }

  // To be called when a run has set the rotations.
  void run_has_ended() { m_last = Cell_rotations<Domain>(); }

  // makes those rotations identities that are at vertices which satisfy a predicate
  template <typename Predicate>
  void forget_rotations(const Predicate& is_forgotten)
  {
    if(!m_prepared)
      return;
    Array<Matrix_3x3> rotations = core().rotations();
    for(std::size_t c = 0; c < rotations.size(); ++c)
      if(is_forgotten(m_prepared->region->vertices[c]))
        rotations[c] = identity_matrix();
    core().set_rotations(std::move(rotations), core().are_rotations_complete());
  }

  // how many vertices are in the region of interest, and how many controls there are
  std::size_t roi_size() const { return m_roi_size; }
  std::size_t number_of_controls() const { return m_number_of_controls; }

  const Region_rows& rows() const { return m_rows; }

  // To be called when vertices were fixed or freed, or the weight of a target was changed.
  void constraints_changed() { m_present.constraints = ++m_last_version; }

  // To be called when the stiffness of cells or the length of an option was changed.
  void values_changed()
  {
    m_present.values = ++m_last_version;
    constraints_changed();
  }

  // To be called when the region of interest, the cells or the rest shape were changed.
  void region_changed()
  {
    m_last = Cell_rotations<Domain>();
    m_present.region = ++m_last_version;
    constraints_changed();
  }

  // Each free vertex gets a row, with this weight for a unit of its area or volume; 0 for none.
  void set_inertia(double inertia)
  {
    if(inertia != m_inertia)
      constraints_changed();
    m_inertia = inertia;
  }

  bool is_up_to_date() const
  {
    return has_region() && !has_other_values() && m_ready.constraints == m_present.constraints;
  }

  // Brings all stages up to date, and adds those that this took. If it fails, rotations and
  // positions are as they were.
  Outcome prepare(Vertices& vertices, const Cell_values<Domain>& values, const Options& options,
                  Stages& stages)
  {
    if(!is_up_to_date())
    {
      m_outcome = Outcome(); // as long as something may throw
      m_outcome = update(vertices, values, options, stages);
    }
    if(!m_outcome || !vertices.domain().is_in_place() ||
       m_rules.order == Minimization_order::global_first)
      return m_outcome;
    const int v = find_non_finite(positions()); // around the region, where others may move it
    return v < 0 ? m_outcome
                 : outcome_of_vertex(Status::non_finite_point, core().region().indices[v]);
  }

  // what the last preparation led to
  const Outcome& outcome_of_preparation() const { return m_outcome; }

  // the rotations become identities
  void reset_rotations()
  {
    m_last = Cell_rotations<Domain>();
    if(m_prepared)
      m_prepared->core->set_rotations({}, false);
  }

  // What is needed to return to the present sets, positions and rotations, bit by bit.
  struct State
  {
    Versions present;
    std::size_t numbering; // of the vertices that these are of
    Array<Coordinates> positions;
    Cell_rotations<Domain> cells;
    double inertia; // of the constraints
    Cell_rotations<Domain> cells_here = {}; // in the region that there is, if it is another one
  };

  State state() const
  {
    if(!has_region())
      return {m_present, none, {}, m_last, m_inertia};
    return {m_present, m_prepared->numbering, m_prepared->positions,
            m_last.region ? m_last : m_prepared->rotations_of_cells(), m_inertia};
  }

  // another one if they have changed, which may be found out when they are used
  std::size_t version_of_values() const { return m_present.values; }

  // whether stiffness and lengths are those of a state
  bool has_values_of(const State& state) const { return state.present.values == m_present.values; }

  // Makes positions of a state those of the region that there is, if it serves for the state, and
  // finds the rotations there. find_present(v) is where a vertex with an entry is in the state.
  template <typename Function>
  void renumber(State& state, const Domain& domain, const Function& find_present) const
  {
    if(!has_region_of(state.present))
      return;
    if(state.cells.region && state.cells.region != m_prepared->region)
      state.cells_here = m_prepared->rotations_from(state.cells, domain);
    if(m_prepared->numbering == state.numbering)
      return;
    Array<Coordinates> positions = m_prepared->positions;
    for(std::size_t k = 0; k < positions.size(); ++k)
      if(const Point* present = find_present(region().vertices[k]))
        positions[k] = Domain::coordinates(*present);
    state.positions.swap(positions);
  }

  // Takes a state that was renumbered. Stages that are the same stay ready. Throws nothing.
  void restore(State state)
  {
    const std::size_t values = m_present.values; // stiffness and options are no part of it
    const bool is_inertia_other = state.inertia != m_inertia;
    m_present = state.present;
    m_present.values = values;
    if(is_inertia_other)
      constraints_changed();
    const bool is_here = has_region() && !state.cells_here.region;
    Cell_rotations<Domain>& cells = is_here ? state.cells : state.cells_here;
    if(has_region())
    {
      m_prepared->positions.swap(state.positions);
      core().set_rotations(std::move(cells.rotations), cells.are_complete);
    }
    m_last = is_here ? Cell_rotations<Domain>() : std::move(state.cells);
  }

private:
  static constexpr std::size_t none = 0; // no version

  // whether the weights of the region that there is are not those of the present values
  bool has_other_values() const
  {
    return core().are_weights_stale() || m_ready.values != m_present.values;
  }

  bool has_region_of(const Versions& present) const
  {
    return m_prepared && m_ready.region == present.region;
  }

  Outcome update(Vertices& vertices, const Cell_values<Domain>& values, const Options& options,
                 Stages& stages)
  {
    if(m_prepared && core().are_weights_stale()) // those of the user are others
      m_present.values = ++m_last_version;
    m_are_rotations_coupled = values.has_groups() || options.smoothing_length > 0;
    m_ready.constraints = none; // a failure may have released the factor
    std::size_t roi_size = 0, number_of_fixed = 0, number_of_controls = 0;
    bool has_simplex = false;
    for(const auto& entry : vertices.entries())
    {
      roi_size += entry.is_roi;
      number_of_fixed += vertices.is_hard_control(entry);
      number_of_controls += entry.is_control;
      has_simplex = has_simplex || (entry.is_roi && !vertices.domain().is_isolated(entry.vertex));
    }
    if(roi_size > 0 && !has_simplex)
      return outcome(Status::no_simplex);

    std::unique_ptr<Built_region<Domain>> next;
    if(needs_region(vertices, roi_size, number_of_fixed))
    {
      stages.region = stages.weights = true;
      if(m_prepared)
        m_prepared->core->release_factor(); // there are never two
      vertices.release_spare_memory();
      next = std::make_unique<Built_region<Domain>>(++m_last_numbering,
                                                    is_whole(roi_size, number_of_fixed));
      if(Outcome made = next->make(vertices, values, m_models, options, m_rules); !made)
        return made;
      if(m_last.region)
        next->take_rotations(m_last, vertices.domain());
      else if(m_prepared && (m_rules.are_rotations_kept || has_region()))
        next->take_rotations(m_prepared->rotations_of_cells(), vertices.domain());
    }
    else if(has_other_values())
    {
      stages.weights = true;
      m_ready.values = none;
      Energy_model model;
      if(Outcome filled = values.fill_in(model, options, vertices.domain(), region(),
                                         core().region()); !filled)
        return filled;
      core().update_weights(std::move(model), options.threads);
      if(core().diagnosis().status == Status::success)
        m_ready.values = m_present.values;
    }
    Built_region<Domain>& prepared = next ? *next : *m_prepared;
    if(prepared.core->diagnosis().status != Status::success) // its weights
      return prepared.explain(prepared.core->diagnosis());
    Region_constraints constraints(prepared);
    prepared.collect_constraints(vertices, m_rules, m_inertia, constraints);
    Outcome result = constraints.prepare(
      m_rules.are_unconstrained_refused ? Unconstrained_components::refused
      : number_of_fixed > 0             ? Unconstrained_components::fixed
                                        : Unconstrained_components::fixed_beside_others,
      options.threads, stages);
    const std::size_t number_of_points = vertices.points().size();
    if(result.status == Status::no_fixed_vertex && number_of_controls + number_of_points == 0)
      result.message = "there is no control vertex: " + result.message;
    if(!result)
      return result;
    if(next)
    {
      if(!m_rules.are_erased_put_back) // CGAL's class reads them again
        for(vertex_descriptor v : next->region->vertices)
          vertices.keep_rest(v);
      if(has_region() && !next->is_whole && !m_last.region && !core().rotations().empty())
        m_last = m_prepared->rotations_of_cells();
      m_prepared = std::move(next);
    }
    m_rows = std::move(constraints.rows());
    m_roi_size = roi_size;
    m_number_of_controls = number_of_controls + number_of_points;
    m_ready = m_present;
    return result;
  }

  // Movable is all of the region of interest, so that handles may change without another region.
  // But where most of it is fixed, these are the free vertices and their neighbors: the cost
  // follows what can move. Not so if rotations depend on those of cells that are far away.
  bool is_whole(std::size_t roi_size, std::size_t number_of_fixed) const
  {
    return m_rules.order == Minimization_order::global_first || m_are_rotations_coupled ||
           2 * number_of_fixed <= roi_size;
  }

  bool needs_region(const Vertices& vertices, std::size_t roi_size,
                    std::size_t number_of_fixed) const
  {
    if(!has_region())
      return true;
    if(m_prepared->is_whole)
      return !is_whole(roi_size, number_of_fixed) && 4 * number_of_fixed > 3 * roi_size;
    const auto number_of_movable =
      static_cast<std::size_t>(core().region().number_of_movable_vertices);
    if(is_whole(roi_size, number_of_fixed) ||
       number_of_movable > 8 * (roi_size - number_of_fixed) + 1000)
      return true;
    for(std::size_t k = 0; k < vertices.entries().size(); ++k)
      if(const auto& entry = vertices.entries()[k];
         entry.is_roi && !vertices.is_hard_control(entry) &&
         !m_prepared->is_movable(number_of_entry(k)))
        return true;
    return false;
  }

  Session_rules m_rules;
  Models m_models;
  Outcome m_outcome;
  std::unique_ptr<Built_region<Domain>> m_prepared; // what was last prepared with success
  // those of the last run, or of a state, if there is another region since, which may have fewer
  Cell_rotations<Domain> m_last;
  Region_rows m_rows;
  std::size_t m_roi_size = 0, m_number_of_controls = 0;
  bool m_are_rotations_coupled = false;
  double m_inertia = 0;
  Versions m_present = {1, 1, 1}, m_ready = {none, none, none};
  std::size_t m_last_version = 1, m_last_numbering = none;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_PREPARED_REGION_H
