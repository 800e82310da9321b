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
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Laplacian_guess.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Scoped_seconds.h>
#include <CGAL/ARAP_deformation/internal/minimizer/minimize_local_global.h>
#include <CGAL/ARAP_deformation/internal/minimizer/minimize_quasi_newton.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/solver/Laplacian_solver.h>
#include <CGAL/ARAP_deformation/internal/solver/factorize_laplacian.h>
#include <CGAL/ARAP_deformation/internal/solver/laplacian.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Traits, typename = void>
struct Get_concurrency_tag { using type = Parallel_if_available_tag; };

template <typename Traits>
struct Get_concurrency_tag<Traits, std::void_t<typename Traits::Concurrency_tag>>
{
  using type = typename Traits::Concurrency_tag;
};

// what work is done at the same time with
template <typename Traits>
using Concurrency_tag_of = typename Get_concurrency_tag<Traits>::type;

// The deformation of a region: all of it that is numbers, and nothing that is a mesh.
template <typename Traits>
class Deformation_core
{
  using Solver = typename Traits::Sparse_solver;

public:
  // Computes what depends on the region and not on the positions: energy, matrix, factor. A solver
  // that has served before may have a factor that is of use.
  Deformation_core(const Traits& traits, Region region, const Options& options,
                   Laplacian_solver<Solver> solver)
    : m_region(std::move(region)), m_weight(traits.edge_weight_object()),
      m_closest_rotation(traits.closest_rotation_object()),
      m_prototype_solver(traits.sparse_solver_object()), m_solver(std::move(solver))
  {
    run_with_threads(number_of_threads(options),
                     [&] { m_diagnosis = prepare(options.cells); });
  }

  // what is wrong with the region, if anything; then run() must not be called
  const Diagnosis& diagnosis() const { return m_diagnosis; }

  const Region& region() const { return m_region; }

  // the solver, of which there is no further use here
  Laplacian_solver<Solver> take_solver() { return std::exchange(m_solver, {}); }

  // the rotation of a cell; the identity before the first run
  Matrix_3x3 rotation(int cell) const
  {
    return m_rotations.empty() ? identity_matrix() : m_rotations[cell];
  }

  // the rotations of all cells
  std::vector<Matrix_3x3> rotations() const
  {
    return m_rotations.empty()
         ? std::vector<Matrix_3x3>(m_energy.number_of_cells(), identity_matrix()) : m_rotations;
  }

  void set_rotations(std::vector<Matrix_3x3> rotations) { m_rotations = std::move(rotations); }

  void reset_rotations() { m_rotations = std::vector<Matrix_3x3>(); }

  int number_of_cells() const { return m_energy.number_of_cells(); }

  // Moves the free vertices of x, whose other vertices are at their final positions, and fits the
  // rotations; there is a target for each of the region's soft positions. Of what it does
  // nothing is kept but the factorization for the initial guess.
  Diagnosis run(const Options& options, const Observer& observe,
                const std::vector<Coordinates>& soft_targets, std::vector<Coordinates>& x,
                std::vector<Matrix_3x3>& rotations, Report& report)
  {
    Diagnosis diagnosis;
    run_with_threads(number_of_threads(options), [&] {
      diagnosis = run_in_arena(options, observe, soft_targets, x, rotations, report);
    });
    return diagnosis;
  }

  // the number of tetrahedra that are inside out at the positions x; 0 on a surface
  std::size_t number_of_inverted_simplices(const std::vector<Coordinates>& x) const
  {
    std::size_t count = 0;
    if(m_region.dimension == 3)
      for(int s = 0; s < m_region.number_of_simplices(); ++s)
        count += orientation(s, m_region.rest) * orientation(s, x) < 0;
    return count;
  }

private:
  // 0 for as many as there are
  static unsigned int number_of_threads(const Options& options)
  {
    return std::is_convertible_v<Concurrency_tag_of<Traits>, Parallel_tag> ? options.threads : 1;
  }

  Diagnosis run_in_arena(const Options& options, const Observer& observe,
                         const std::vector<Coordinates>& soft_targets, std::vector<Coordinates>& x,
                         std::vector<Matrix_3x3>& rotations, Report& report)
  {
    if(options.initial_guess == Initial_guess::laplacian && m_region.number_of_free_vertices > 0)
    {
      Scoped_seconds seconds(report.seconds.initial_guess);
      if(!m_laplacian_guess)
      {
        const Simplices simplices = weighted_simplices(m_weight, m_region);
        Laplacian_guess<Solver> guess(star_edge_sets(m_weight, simplices, m_region), m_region,
                                      m_prototype_solver);
        if(!guess.is_factorized())
          return {Status::singular_matrix};
        m_laplacian_guess.emplace(std::move(guess));
      }
      if(!(*m_laplacian_guess)(soft_targets, x))
        return {Status::solver_failed};
    }
    Minimization<typename Traits::Closest_rotation, Laplacian_solver<Solver>> minimization(
      m_energy, m_closest_rotation, m_solver, m_region.number_of_free_vertices, options, observe,
      soft_targets, x, rotations, report);
    return {is_quasi_newton(options) ? minimize_quasi_newton(minimization)
                                     : minimize_local_global(minimization)};
  }

  static bool is_quasi_newton(const Options& options)
  {
    return options.minimizer == Minimizer::quasi_newton ||
           (options.minimizer == Minimizer::automatic && options.tolerance > 0);
  }

  // the sign of the volume of the tetrahedron s
  int orientation(int s, const std::vector<Coordinates>& x) const
  {
    const int* c = m_region.corners_of(s);
    const double volume = dot(cross(difference(x[c[1]], x[c[0]]), difference(x[c[2]], x[c[0]])),
                              difference(x[c[3]], x[c[0]]));
    return (volume > 0) - (volume < 0);
  }

  Diagnosis prepare(Cell_scheme scheme)
  {
    if(const int v = find_non_finite(m_region.rest); v >= 0)
      return {Status::non_finite_point, v};
    Simplices simplices = weighted_simplices(m_weight, m_region);
    if(const int s = find_non_finite_simplex(simplices); s >= 0)
      return {Status::non_finite_weight, -1, s};
    m_energy = make_deformation_energy(m_weight, std::move(simplices), scheme, m_region);
    return m_solver.prepare(m_energy, m_region.indices, m_prototype_solver);
  }

  Region m_region;
  typename Traits::Edge_weight m_weight;
  typename Traits::Closest_rotation m_closest_rotation;
  Solver m_prototype_solver; // as the traits hand it out
  Laplacian_solver<Solver> m_solver;
  Deformation_energy m_energy;
  std::optional<Laplacian_guess<Solver>> m_laplacian_guess;
  std::vector<Matrix_3x3> m_rotations; // empty before the first run
  Diagnosis m_diagnosis;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_DEFORMATION_CORE_H
