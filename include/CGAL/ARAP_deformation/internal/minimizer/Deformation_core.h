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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_DEFORMATION_CORE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_DEFORMATION_CORE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_weight_model.h>
#include <CGAL/ARAP_deformation/internal/energy/Energy_model.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Observer.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>
#include <CGAL/ARAP_deformation/internal/region/Diagnosis.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/rotation/Closest_rotations.h>
#include <CGAL/ARAP_deformation/internal/solver/Linear_solver.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The models that a traits class hands out.
struct Core_models
{
  std::shared_ptr<const Edge_weight_model> weight;
  Closest_rotations closest_rotations;
  std::shared_ptr<const Linear_solver> solver; // a prototype, which is copied
  bool is_parallel;
};

// What becomes of components of free vertices that nothing constrains: they are refused, become
// fixed, or become fixed if there are other free vertices.
enum class Unconstrained_components { refused, fixed, fixed_beside_others };

// In what CGAL's class differs: it counts all cells, and begins each iteration with the global
// step.
enum class Minimization_order { local_first, global_first };

class Minimization;
class Parts;

inline bool is_quasi_newton(const Options& options)
{
  return options.minimizer == Minimizer::quasi_newton ||
         (options.minimizer == Minimizer::automatic && options.tolerance > 0);
}

// The numeric part of a deformation, which never sees a mesh; not a template, so that it can be
// compiled once.
class Deformation_core
{
public:
  // Computes what depends on the region and not on constraints or positions: weights, edge sets,
  // cells, the Laplacian.
  Deformation_core(const Core_models& models, Region region, Energy_model energy_model,
                   Minimization_order order, unsigned int number_of_threads);
  ~Deformation_core();

  // What is wrong with the region or its weights, if anything: then only the weights may be
  // computed again, and rotations are what they were.
  const Diagnosis& diagnosis() const { return m_diagnosis; }

  // whether the weights have changed since they were computed
  bool are_weights_stale() const { return m_models.weight->version() != m_weights_version; }

  // Computes the weights again, and all that depends on them. The cells must be the same. The order
  // of the factor is kept; set_constraints() must be called before another run.
  void update_weights(Energy_model energy_model, unsigned int number_of_threads);

  const Region& region() const { return m_region; }
  bool has_vertex_cells() const { return m_energy_model.cells.has_vertex_cells(); }

  // whether a movable vertex is not in any simplex
  bool is_isolated(int v) const { return m_is_isolated[v] != 0; }

  // Prepares the system for these constraints, and adds which stages that took. Where unconstrained
  // components are refused the status is no_fixed_vertex.
  Diagnosis set_constraints(Constraints constraints, Unconstrained_components unconstrained,
                            unsigned int number_of_threads, Stages& stages);

  // Forgets the factor, to save memory; set_constraints() must be called before another run.
  void release_factor();

  // for the last successful call
  const Constraints& constraints() const { return m_constraints; }

  // the smallest index in the mesh of the vertices of each component that became fixed
  const std::vector<std::size_t>& unconstrained_components() const
  {
    return m_unconstrained_components;
  }

  int number_of_cells() const;

  // The rotation of a cell, the identity where nothing moves. None if all are identities, as before
  // the first run.
  const Array<Matrix_3x3>& rotations() const { return m_rotations; }

  // whether these are of a run that went on from others: else those of cells that did not move are
  // identities
  bool are_rotations_complete() const { return m_are_rotations_complete; }

  void set_rotations(Array<Matrix_3x3> rotations, bool are_complete)
  {
    m_rotations = std::move(rotations);
    m_are_rotations_complete = are_complete;
  }

  // Positions have changed, to which these rotations do not belong.
  void outdate_rotations() { m_are_rotations_complete = false; }

  // whether a run goes on from the rotations before
  bool are_rotations_state() const;

  // Where it does, but these are not complete, as of a new region: makes them those of the
  // positions that it starts from.
  void complete(Array<Matrix_3x3>& rotations, const Array<Coordinates>& x,
                unsigned int number_of_threads);

  // Moves the free vertices of x, whose other vertices are at their final positions, and fits the
  // rotations but for those that frames give. Targets that are sets become the projections of the
  // final positions. What it prepares for guesses and coarse metrics is kept for the next run.
  Diagnosis run(const Options& options, const Observer& observe, Targets& targets,
                Array<Coordinates>& x, Array<Matrix_3x3>& rotations, Report& report);

  // the number of tetrahedra that are inside out at the positions x; 0 on a surface
  std::size_t number_of_inverted_simplices(const Array<Coordinates>& x) const;

private:
  struct State; // energy and system: what only the implementation knows

  struct Placement
  {
    Array<char> is_placed;       // for each movable vertex: by a rigid motion, or because it stays
    Array<Coordinates> unplaced; // where all are without that, if the energy has to decide
    // whether the others, or all of `unplaced`, are where the Laplacian guess has them
    bool is_laplacian = false, is_unplaced_laplacian = false;
  };

  Diagnosis prepare();
  Diagnosis constrain(Constraints constraints, Unconstrained_components unconstrained,
                      Stages& stages);
  Diagnosis run_in_arena(const Options& options, const Observer& observe, Targets& targets,
                         Array<Coordinates>& x, Array<Matrix_3x3>& rotations,
                         Report& report);
  bool is_local(const Targets& targets) const;
  const Parts& parts();
  Diagnosis place(const Options& options, Targets& targets, Array<Coordinates>& x,
                  Placement& placement);
  Array<int> find_torn_parts(const Targets& targets, const Array<Coordinates>& x,
                             Minimization& minimization, Array<char>& is_placed);
  void set_placed(int part, Array<char>& is_placed);
  bool start_with_rotations(const Options& options, const Targets& targets,
                            const Array<Coordinates>& x, Minimization& minimization,
                            Array<char>& is_placed, Report& report);
  bool are_all_placed(const Array<char>& is_placed) const; // whether all free vertices are
  Array<char> staying(const Array<char>& is_placed) const;
  Diagnosis guess_by_laplacian(const Array<char>& is_placed, const Targets& targets,
                               Array<Coordinates>& x, bool& is_found);
  bool can_have_coarse_start(const Options& options, const Array<char>& stays) const;
  Array<Matrix_3x3> coarse_rotations(const Options& options, const Array<Coordinates>& x,
                                     const Array<char>& stays) const;
  void include_near(const Array<Coordinates>& points, Bounding_box& box) const;
  unsigned int threads(unsigned int number) const { return m_models.is_parallel ? number : 1; }

  Core_models m_models;
  Region m_region;
  Energy_model m_energy_model;
  Minimization_order m_order;
  bool m_is_coarse = false; // it is the coarser surface of another
  std::size_t m_weights_version = 0;
  std::unique_ptr<State> m_state;
  Array<char> m_is_isolated; // for each movable vertex
  double m_squared_size = 0; // of the diagonal of the box of what is near free vertices, at rest
  Constraints m_constraints;
  std::vector<std::size_t> m_unconstrained_components;
  Array<Matrix_3x3> m_rotations;
  bool m_are_rotations_complete = false;
  Diagnosis m_diagnosis;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_DEFORMATION_CORE_H
