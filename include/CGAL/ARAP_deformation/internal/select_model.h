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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SELECT_MODEL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SELECT_MODEL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Closest_rotation_traits_adaptor.h>
#include <CGAL/ARAP_deformation/Eigen_cholesky_solver.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/Sparse_linear_algebra_adaptor.h>
#include <CGAL/ARAP_deformation/flat_types.h>

#include <CGAL/Default.h>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename T, typename = void>
struct Is_sparse_solver : std::false_type {};

template <typename T>
struct Is_sparse_solver<T, std::void_t<
  decltype(std::declval<T&>().analyze(std::declval<const Sparse_matrix&>())),
  decltype(std::declval<T&>().factorize(std::declval<const Sparse_matrix&>())),
  decltype(std::declval<T&>().solve(std::size_t(), std::declval<Coordinates*>()))>>
  : std::true_type {};

template <typename T, typename = void>
struct Is_sparse_linear_algebra : std::false_type {};

template <typename T>
struct Is_sparse_linear_algebra<T, std::void_t<typename T::NT, typename T::Matrix,
                                               typename T::Vector>> : std::true_type {};

template <typename T>
using Is_closest_rotation =
  std::is_invocable<const T&, std::size_t, const Matrix_3x3*, Matrix_3x3*>;

template <typename T, typename = void>
struct Is_closest_rotation_traits : std::false_type {};

template <typename T>
struct Is_closest_rotation_traits<T, std::void_t<typename T::Matrix, typename T::Vector>>
  : std::true_type {};

// the model of ARAPSparseSolver for what a user gave, which may be a model of CGAL's concept
template <typename T>
struct Select_sparse_solver
{
  static_assert(Is_sparse_solver<T>::value || Is_sparse_linear_algebra<T>::value,
                "The solver ST must be a model of ARAPSparseSolver (functions analyze, factorize, "
                "solve) or of SparseLinearAlgebraWithFactorTraits_d (types NT, Matrix, Vector).");
  using type = std::conditional_t<Is_sparse_solver<T>::value, T, Sparse_linear_algebra_adaptor<T>>;
};

template <>
struct Select_sparse_solver<Default> { using type = Eigen_cholesky_solver; };

// the model of ARAPClosestRotation_3 for what a user gave, which may be a model of CGAL's concept
template <typename T>
struct Select_closest_rotation
{
  static_assert(Is_closest_rotation<T>::value || Is_closest_rotation_traits<T>::value,
                "The rotation CR must be a model of ARAPClosestRotation_3 (a function object for "
                "arrays of matrices) or of DeformationClosestRotationTraits_3 (types Matrix, "
                "Vector).");
  using type =
    std::conditional_t<Is_closest_rotation<T>::value, T, Closest_rotation_traits_adaptor<T>>;
};

template <>
struct Select_closest_rotation<Default> { using type = SVD_closest_rotation; };

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SELECT_MODEL_H
