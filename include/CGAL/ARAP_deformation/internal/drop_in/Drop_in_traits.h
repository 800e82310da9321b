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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_DROP_IN_TRAITS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_DROP_IN_TRAITS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Closest_rotation_traits_adaptor.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/Sparse_linear_algebra_adaptor.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>
#include <CGAL/ARAP_deformation/internal/rotation/closest_rotation_requirements.h>
#include <CGAL/ARAP_deformation/internal/solver/sparse_solver_requirements.h>

#include <tuple>
#include <type_traits>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename T>
constexpr bool is_sparse_solver =
  is_valid<Call_analyze, T> && is_valid<Call_factorize, T> && is_valid<Call_solve, T>;

template <typename T>
using Types_of_sparse_linear_algebra =
  std::tuple<typename T::NT, typename T::Matrix*, typename T::Vector*>;

template <typename T>
constexpr bool is_closest_rotation = is_valid<Call_closest_rotation, T>;

template <typename T>
using Types_of_closest_rotation_traits = std::tuple<typename T::Matrix*, typename T::Vector*>;

// the model of ARAPSparseSolver for what a user gave, which may be a model of CGAL's concept
template <typename T>
struct Select_sparse_solver
{
  static_assert(is_sparse_solver<T> || is_valid<Types_of_sparse_linear_algebra, T>,
                "The solver ST must be a model of ARAPSparseSolver (functions analyze, factorize, "
                "solve) or of SparseLinearAlgebraWithFactorTraits_d (types NT, Matrix, Vector).");
  using type = std::conditional_t<is_sparse_solver<T>, T, Sparse_linear_algebra_adaptor<T>>;
};

// the model of ARAPClosestRotation for what a user gave, which may be a model of CGAL's concept
template <typename T>
struct Select_closest_rotation
{
  static_assert(is_closest_rotation<T> || is_valid<Types_of_closest_rotation_traits, T>,
                "The rotation CR must be a model of ARAPClosestRotation (a function object for "
                "arrays of matrices) or of DeformationClosestRotationTraits_3 (types Matrix, "
                "Vector).");
  using type =
    std::conditional_t<is_closest_rotation<T>, T, Closest_rotation_traits_adaptor<T>>;
};

// What CGAL's class is given for its solver and its rotation where only its types are asked for:
// it then needs neither Eigen nor a model of these concepts.
struct No_linear_algebra {};
struct No_closest_rotation
{
  using Matrix = int;
  using Vector = int;
};

// a surface with a face that is no triangle is refused
template <typename Mesh, typename VertexPointMap, typename VertexIndexMap>
class Triangle_domain : public Face_graph_domain<Mesh, VertexPointMap, VertexIndexMap>
{
  using Base = Face_graph_domain<Mesh, VertexPointMap, VertexIndexMap>;

public:
  using Base::Base;

  static constexpr bool has_triangles_only = true;
};

// a model of ARAPDeformationTraits
template <typename Solver, typename Weight, typename Rotation>
struct Drop_in_traits
{
  using Sparse_solver = Solver;
  using Edge_weight = Weight;
  using Closest_rotation = Rotation;

  Solver solver;
  Weight weight;
  Rotation rotation;

  Solver sparse_solver_object() const { return solver; }
  Weight edge_weight_object() const { return weight; }
  Rotation closest_rotation_object() const { return rotation; }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_DROP_IN_TRAITS_H
