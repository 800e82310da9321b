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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CONCEPTS_CONCEPT_CHECKS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CONCEPTS_CONCEPT_CHECKS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/flat_types.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Reports what a model of a concept lacks where it is passed, and not where it is first used:
//   static_assert(Sparse_solver_requirements<Solver>::are_met);
// This assertion never fails itself: naming the member instantiates the class, whose own assertions
// have the messages.

template <typename Void, template <typename...> class Expression, typename... Arguments>
struct Is_valid : std::false_type {};

template <template <typename...> class Expression, typename... Arguments>
struct Is_valid<std::void_t<Expression<Arguments...>>, Expression, Arguments...>
  : std::true_type {};

// whether the alias template Expression is well-formed for the arguments
template <template <typename...> class Expression, typename... Arguments>
constexpr bool is_valid = Is_valid<void, Expression, Arguments...>::value;

template <typename From, typename To>
using Requires_convertible = std::enable_if_t<std::is_convertible_v<From, To>>;

// ARAPSparseSolver

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
                                              std::declval<const Eigen::MatrixXd&>())), bool>;

template <typename Solver>
constexpr bool can_have_border = is_valid<Call_set_border, Solver>;

template <typename Solver>
struct Sparse_solver_requirements
{
  static_assert(is_valid<Call_analyze, Solver>,
    "the model of ARAPSparseSolver lacks: bool analyze(const CGAL::ARAP::Sparse_matrix&)");
  static_assert(is_valid<Call_factorize, Solver>,
    "the model of ARAPSparseSolver lacks: bool factorize(const CGAL::ARAP::Sparse_matrix&)");
  static_assert(is_valid<Call_solve, Solver>,
    "the model of ARAPSparseSolver lacks: bool solve(std::size_t, CGAL::ARAP::Coordinates*)");
  static_assert(std::is_copy_constructible_v<Solver>,
    "the model of ARAPSparseSolver lacks: a copy constructor (a copy need not have the factor)");
  static_assert(std::is_move_constructible_v<Solver>,
    "the model of ARAPSparseSolver lacks: a move constructor");
  static_assert(std::is_move_assignable_v<Solver>,
    "the model of ARAPSparseSolver lacks: a move assignment");
  static constexpr bool are_met = true;
};

// ARAPClosestRotation_3

template <typename Rotation>
using Call_closest_rotation = decltype(std::declval<const Rotation&>()(
  std::size_t(), std::declval<const Matrix_3x3*>(), std::declval<Matrix_3x3*>()));

template <typename Rotation>
struct Closest_rotation_requirements
{
  static_assert(is_valid<Call_closest_rotation, Rotation>,
    "the model of ARAPClosestRotation_3 lacks: void operator()(std::size_t, "
    "const CGAL::ARAP::Matrix_3x3*, CGAL::ARAP::Matrix_3x3*) const");
  static_assert(std::is_copy_constructible_v<Rotation>,
    "the model of ARAPClosestRotation_3 lacks: a copy constructor");
  static_assert(std::is_copy_assignable_v<Rotation>,
    "the model of ARAPClosestRotation_3 lacks: an assignment");
  static constexpr bool are_met = true;
};

// ARAPEdgeWeight_3

template <typename Weight>
using Call_triangle_weights = Requires_convertible<
  decltype(std::declval<const Weight&>().simplex_weights(
    std::declval<const std::array<Coordinates, 3>&>())), std::array<double, 3>>;

template <typename Weight>
using Call_tetrahedron_weights = Requires_convertible<
  decltype(std::declval<const Weight&>().simplex_weights(
    std::declval<const std::array<Coordinates, 4>&>())), std::array<double, 6>>;

template <typename Weight>
using Call_edge_weight = Requires_convertible<
  decltype(std::declval<const Weight&>().edge_weight(
    std::declval<Edge_set>(), std::size_t(), std::size_t(), double())), double>;

template <typename Weight>
struct Edge_weight_requirements
{
  static_assert(is_valid<Call_triangle_weights, Weight>,
    "the model of ARAPEdgeWeight_3 lacks: std::array<double, 3> "
    "simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>&) const");
  static_assert(is_valid<Call_edge_weight, Weight>,
    "the model of ARAPEdgeWeight_3 lacks: "
    "double edge_weight(CGAL::ARAP::Edge_set, std::size_t, std::size_t, double) const");
  static_assert(std::is_copy_constructible_v<Weight>,
    "the model of ARAPEdgeWeight_3 lacks: a copy constructor");
  static_assert(std::is_copy_assignable_v<Weight>,
    "the model of ARAPEdgeWeight_3 lacks: an assignment");
  static constexpr bool are_met = true;
};

// ARAPDeformationTraits_3

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
    "the model of ARAPDeformationTraits_3 lacks: the type Sparse_solver");
  static_assert(is_valid<Edge_weight_of, Traits>,
    "the model of ARAPDeformationTraits_3 lacks: the type Edge_weight");
  static_assert(is_valid<Closest_rotation_of, Traits>,
    "the model of ARAPDeformationTraits_3 lacks: the type Closest_rotation");
  static_assert(
    Requirements_of<Sparse_solver_requirements, Sparse_solver_of, Traits>::are_met);
  static_assert(Requirements_of<Edge_weight_requirements, Edge_weight_of, Traits>::are_met);
  static_assert(
    Requirements_of<Closest_rotation_requirements, Closest_rotation_of, Traits>::are_met);
  static_assert(is_valid<Call_sparse_solver_object, Traits>,
    "the model of ARAPDeformationTraits_3 lacks: Sparse_solver sparse_solver_object() const");
  static_assert(is_valid<Call_edge_weight_object, Traits>,
    "the model of ARAPDeformationTraits_3 lacks: Edge_weight edge_weight_object() const");
  static_assert(is_valid<Call_closest_rotation_object, Traits>,
    "the model of ARAPDeformationTraits_3 lacks: "
    "Closest_rotation closest_rotation_object() const");
  static_assert(std::is_copy_constructible_v<Traits>,
    "the model of ARAPDeformationTraits_3 lacks: a copy constructor");
  static_assert(std::is_copy_assignable_v<Traits>,
    "the model of ARAPDeformationTraits_3 lacks: an assignment");
  static constexpr bool are_met = true;
};

// ARAPDomain_3

template <typename Domain> using Point_of = typename Domain::Point;
template <typename Domain> using Vertex_of = typename Domain::vertex_descriptor;
template <typename Domain> using Simplex_of = typename Domain::simplex_descriptor;

template <typename Domain>
using Constant_dimension = std::integral_constant<int, static_cast<int>(Domain::dimension)>;

template <typename Domain>
using Call_index = Requires_convertible<
  decltype(std::declval<const Domain&>().index(std::declval<Vertex_of<Domain>>())), std::size_t>;

template <typename Domain>
using Call_point = Requires_convertible<
  decltype(std::declval<const Domain&>().point(std::declval<Vertex_of<Domain>>())),
  Point_of<Domain>>;

template <typename Domain>
using Call_set_point = decltype(std::declval<const Domain&>().set_point(
  std::declval<Vertex_of<Domain>>(), std::declval<const Point_of<Domain>&>()));

template <typename Domain>
using Call_is_in_place =
  Requires_convertible<decltype(std::declval<const Domain&>().is_in_place()), bool>;

template <typename Domain>
using Call_is_isolated = Requires_convertible<
  decltype(std::declval<const Domain&>().is_isolated(std::declval<Vertex_of<Domain>>())), bool>;

template <typename Domain, typename Range>
using Requires_vertex_range =
  Requires_convertible<decltype(*std::begin(std::declval<Range&>())), Vertex_of<Domain>>;

template <typename Domain>
using Call_vertices =
  Requires_vertex_range<Domain, const decltype(std::declval<const Domain&>().vertices())>;

template <typename Domain>
using Call_simplex_vertices =
  Requires_vertex_range<Domain, const decltype(std::declval<const Domain&>().simplex_vertices(
    std::declval<Simplex_of<Domain>>()))>;

template <typename Domain>
using Call_coordinates = Requires_convertible<
  decltype(Domain::coordinates(std::declval<const Point_of<Domain>&>())), Coordinates>;

template <typename Domain>
using Call_make_point = Requires_convertible<
  decltype(Domain::make_point(std::declval<const Coordinates&>())), Point_of<Domain>>;

template <typename Domain>
struct Function_of_simplex
{
  template <typename Vertices>
  void operator()(Simplex_of<Domain>, const Vertices&) const {}
};

template <typename Domain>
using Call_for_each_incident_simplex =
  decltype(std::declval<const Domain&>().for_each_incident_simplex(
    std::declval<Vertex_of<Domain>>(), std::declval<const Function_of_simplex<Domain>&>()));

// 0 if Domain has no such constant
template <typename Domain, typename = void>
constexpr int dimension_of = 0;
template <typename Domain>
constexpr int dimension_of<Domain, std::void_t<Constant_dimension<Domain>>> =
  Constant_dimension<Domain>::value;

// The requirements of a domain, and those of the weights for its dimension. (Members that return
// `auto` are instantiated to deduce their types.)
template <typename Domain, typename Weight>
struct Domain_requirements
{
  static_assert(is_valid<Point_of, Domain>, "the model of ARAPDomain_3 lacks: the type Point");
  static_assert(is_valid<Vertex_of, Domain>,
    "the model of ARAPDomain_3 lacks: the type vertex_descriptor");
  static_assert(is_valid<Simplex_of, Domain>,
    "the model of ARAPDomain_3 lacks: the type simplex_descriptor");
  static_assert(is_valid<Constant_dimension, Domain>,
    "the model of ARAPDomain_3 lacks: static constexpr int dimension");
  static_assert(is_valid<Call_index, Domain>,
    "the model of ARAPDomain_3 lacks: std::size_t index(vertex_descriptor) const");
  static_assert(is_valid<Call_point, Domain>,
    "the model of ARAPDomain_3 lacks: Point point(vertex_descriptor) const");
  static_assert(is_valid<Call_set_point, Domain>,
    "the model of ARAPDomain_3 lacks: void set_point(vertex_descriptor, const Point&) const");
  static_assert(is_valid<Call_is_in_place, Domain>,
    "the model of ARAPDomain_3 lacks: bool is_in_place() const");
  static_assert(is_valid<Call_is_isolated, Domain>,
    "the model of ARAPDomain_3 lacks: bool is_isolated(vertex_descriptor) const");
  static_assert(is_valid<Call_vertices, Domain>,
    "the model of ARAPDomain_3 lacks: vertices() const, a range of vertex_descriptor");
  static_assert(is_valid<Call_simplex_vertices, Domain>,
    "the model of ARAPDomain_3 lacks: simplex_vertices(simplex_descriptor) const, "
    "a range of vertex_descriptor");
  static_assert(is_valid<Call_coordinates, Domain>,
    "the model of ARAPDomain_3 lacks: "
    "static CGAL::ARAP::Coordinates coordinates(const Point&)");
  static_assert(is_valid<Call_make_point, Domain>,
    "the model of ARAPDomain_3 lacks: static Point make_point(const CGAL::ARAP::Coordinates&)");
  static_assert(is_valid<Call_for_each_incident_simplex, Domain>,
    "the model of ARAPDomain_3 lacks: "
    "void for_each_incident_simplex(vertex_descriptor, const Function&) const");
  static_assert(std::is_copy_constructible_v<Domain>,
    "the model of ARAPDomain_3 lacks: a copy constructor");
  static_assert(std::is_copy_assignable_v<Domain>,
    "the model of ARAPDomain_3 lacks: an assignment");

  static constexpr int dimension = dimension_of<Domain>;
  static_assert(dimension == 0 || dimension == 2 || dimension == 3,
    "the dimension of the model of ARAPDomain_3 must be 2 or 3");
  static_assert(dimension != 3 || is_valid<Call_tetrahedron_weights, Weight>,
    "the model of ARAPEdgeWeight_3 lacks, for a domain of dimension 3: std::array<double, 6> "
    "simplex_weights(const std::array<CGAL::ARAP::Coordinates, 4>&) const");
  static constexpr bool are_met = true;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CONCEPTS_CONCEPT_CHECKS_H
