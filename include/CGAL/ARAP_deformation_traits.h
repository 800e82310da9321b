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

#ifndef CGAL_ARAP_DEFORMATION_TRAITS_H
#define CGAL_ARAP_DEFORMATION_TRAITS_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/internal/session/traits_requirements.h>

#include <CGAL/Default.h>
#include <CGAL/tags.h>

#include <type_traits>
#include <utility>

namespace CGAL {

/// \ingroup PkgARAPDeformationRef
/// \brief defines the solver, the edge weights and the rotation fitting of a deformation, and
/// provides objects of them.
///
/// The objects may have state: construct the traits from them. A deformation works on copies.
///
/// \tparam SparseSolver a model of `ARAPSparseSolver`, default
///         `ARAP::Multifrontal_cholesky_solver`
/// \tparam EdgeWeight a model of `ARAPEdgeWeight`, default `ARAP::Safe_cotangent_weight`
/// \tparam ClosestRotation a model of `ARAPClosestRotation`, default
///         `ARAP::Newton_closest_rotation`
/// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`, which
///         is the default and runs in parallel if the program is linked with TBB (the macro
///         `CGAL_LINKED_WITH_TBB`). Results do not depend on it.
///
/// \cgalModels{ARAPDeformationTraits}
template <typename SparseSolver = Default,
          typename EdgeWeight = Default,
          typename ClosestRotation = Default,
          typename ConcurrencyTag = Parallel_if_available_tag>
class ARAP_deformation_traits
{
public:
  /// the type of the solver.
  using Sparse_solver =
    typename Default::Get<SparseSolver, ARAP::Multifrontal_cholesky_solver>::type;

  /// the type of the edge weights.
  using Edge_weight = typename Default::Get<EdgeWeight, ARAP::Safe_cotangent_weight>::type;

  /// the type of the rotation fitting.
  using Closest_rotation =
    typename Default::Get<ClosestRotation, ARAP::Newton_closest_rotation>::type;

  /// the concurrency tag.
  using Concurrency_tag = ConcurrencyTag;

#ifndef CGAL_LINKED_WITH_TBB
  static_assert(!std::is_convertible_v<Concurrency_tag, Parallel_tag>,
                "Parallel_tag is enabled but TBB is unavailable.");
#endif
  static_assert(ARAP::internal::Sparse_solver_requirements<Sparse_solver>::are_met);
  static_assert(ARAP::internal::Edge_weight_requirements<Edge_weight>::are_met);
  static_assert(ARAP::internal::Closest_rotation_requirements<Closest_rotation>::are_met);

  /// constructs the traits from the objects that they provide.
  explicit ARAP_deformation_traits(Sparse_solver solver = Sparse_solver(),
                                   Edge_weight weight = Edge_weight(),
                                   Closest_rotation rotation = Closest_rotation())
    : m_solver(std::move(solver)), m_weight(std::move(weight)), m_rotation(std::move(rotation))
  {}

  /// returns the solver, which is copied for each pattern of a matrix.
  Sparse_solver sparse_solver_object() const { return m_solver; }

  /// returns the edge weights.
  Edge_weight edge_weight_object() const { return m_weight; }

  /// returns the rotation fitting.
  Closest_rotation closest_rotation_object() const { return m_rotation; }

private:
  Sparse_solver m_solver;
  Edge_weight m_weight;
  Closest_rotation m_rotation;
};

} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_TRAITS_H
