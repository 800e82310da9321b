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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_TRAITS_REQUIREMENTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_TRAITS_REQUIREMENTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/energy/edge_weight_requirements.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>
#include <CGAL/ARAP_deformation/internal/rotation/closest_rotation_requirements.h>
#include <CGAL/ARAP_deformation/internal/solver/sparse_solver_requirements.h>

#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Traits> using Sparse_solver_of = typename Traits::Sparse_solver;
template <typename Traits> using Edge_weight_of = typename Traits::Edge_weight;
template <typename Traits> using Closest_rotation_of = typename Traits::Closest_rotation;

template <typename Traits>
using Call_sparse_solver_object = Requires_convertible<
  decltype(std::declval<const Traits&>().sparse_solver_object()), Sparse_solver_of<Traits>>;

template <typename Traits>
using Call_edge_weight_object = Requires_convertible<
  decltype(std::declval<const Traits&>().edge_weight_object()), Edge_weight_of<Traits>>;

template <typename Traits>
using Call_closest_rotation_object = Requires_convertible<
  decltype(std::declval<const Traits&>().closest_rotation_object()), Closest_rotation_of<Traits>>;

// The requirements of a nested type; none if the type is missing, which is reported by itself.
template <template <typename> class Requirements, template <typename...> class Type,
          typename Traits, bool = is_valid<Type, Traits>>
struct Requirements_of : Requirements<Type<Traits>> {};

template <template <typename> class Requirements, template <typename...> class Type,
          typename Traits>
struct Requirements_of<Requirements, Type, Traits, false>
{
  static constexpr bool are_met = true;
};

template <typename Traits>
struct Deformation_traits_requirements
{
  static_assert(is_valid<Sparse_solver_of, Traits>,
    "the model of ARAPDeformationTraits lacks: the type Sparse_solver");
  static_assert(is_valid<Edge_weight_of, Traits>,
    "the model of ARAPDeformationTraits lacks: the type Edge_weight");
  static_assert(is_valid<Closest_rotation_of, Traits>,
    "the model of ARAPDeformationTraits lacks: the type Closest_rotation");
  static_assert(
    Requirements_of<Sparse_solver_requirements, Sparse_solver_of, Traits>::are_met);
  static_assert(Requirements_of<Edge_weight_requirements, Edge_weight_of, Traits>::are_met);
  static_assert(
    Requirements_of<Closest_rotation_requirements, Closest_rotation_of, Traits>::are_met);
  static_assert(is_valid<Call_sparse_solver_object, Traits>,
    "the model of ARAPDeformationTraits lacks: Sparse_solver sparse_solver_object() const");
  static_assert(is_valid<Call_edge_weight_object, Traits>,
    "the model of ARAPDeformationTraits lacks: Edge_weight edge_weight_object() const");
  static_assert(is_valid<Call_closest_rotation_object, Traits>,
    "the model of ARAPDeformationTraits lacks: "
    "Closest_rotation closest_rotation_object() const");
  static_assert(std::is_copy_constructible_v<Traits>,
    "the model of ARAPDeformationTraits lacks: a copy constructor");
  static constexpr bool are_met = true;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_TRAITS_REQUIREMENTS_H
