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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_SPARSE_SOLVER_REQUIREMENTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_SPARSE_SOLVER_REQUIREMENTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Reports what a model of a concept lacks where it is passed, and not where it is first used:
//   static_assert(Sparse_solver_requirements<Solver>::are_met);
// This assertion never fails itself: naming the member instantiates the class, whose own assertions
// have the messages.

template <typename Solver>
using Call_analyze = Requires_convertible<
  decltype(std::declval<Solver&>().analyze(std::declval<const Sparse_matrix&>())), bool>;

template <typename Solver>
using Call_factorize = Requires_convertible<
  decltype(std::declval<Solver&>().factorize(std::declval<const Sparse_matrix&>())), bool>;

template <typename Solver>
using Call_solve = Requires_convertible<
  decltype(std::declval<Solver&>().solve(std::size_t(), std::declval<Coordinates*>())), bool>;

// optional: a border saves a factorization when control vertices change
template <typename Solver>
using Call_set_border = Requires_convertible<
  decltype(std::declval<Solver&>().set_border(std::declval<const Sparse_matrix&>(),
                                              std::declval<const Dense_matrix&>())), bool>;

template <typename Solver>
constexpr bool can_have_border = is_valid<Call_set_border, Solver>;

template <typename Solver>
struct Sparse_solver_members
{
  static_assert(is_valid<Call_analyze, Solver>,
    "the model of ARAPSparseSolver lacks: bool analyze(const CGAL::ARAP::Sparse_matrix&)");
  static_assert(is_valid<Call_factorize, Solver>,
    "the model of ARAPSparseSolver lacks: bool factorize(const CGAL::ARAP::Sparse_matrix&)");
  static_assert(is_valid<Call_solve, Solver>,
    "the model of ARAPSparseSolver lacks: bool solve(std::size_t, CGAL::ARAP::Coordinates*)");
  static_assert(std::is_copy_constructible_v<Solver>,
    "the model of ARAPSparseSolver lacks: a copy constructor (a copy need not have the factor)");
};

// the members by which solvers of other libraries are known
template <typename Solver>
using Call_linear_solver = decltype(std::declval<Solver&>().linear_solver(
  std::declval<const typename Solver::Vector&>(), std::declval<typename Solver::Vector&>()));
template <typename Solver>
using Call_analyze_pattern = decltype(std::declval<Solver&>().analyzePattern(
  std::declval<const typename Solver::MatrixType&>()));

// names the adaptor of such a solver, and not all that it lacks
template <typename Solver>
struct Sparse_solver_requirements
  : std::conditional_t<is_valid<Call_linear_solver, Solver> ||
                         is_valid<Call_analyze_pattern, Solver>,
                       std::true_type, Sparse_solver_members<Solver>>
{
  static_assert(!is_valid<Call_linear_solver, Solver>,
    "a solver of CGAL, a model of SparseLinearAlgebraWithFactorTraits_d, is no model of "
    "ARAPSparseSolver: wrap it in CGAL::ARAP::Sparse_linear_algebra_adaptor<>");
  static_assert(!is_valid<Call_analyze_pattern, Solver>,
    "a solver of Eigen is no model of ARAPSparseSolver: wrap it in "
    "CGAL::ARAP::Eigen_sparse_solver<>");
  static constexpr bool are_met = true;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_SPARSE_SOLVER_REQUIREMENTS_H
