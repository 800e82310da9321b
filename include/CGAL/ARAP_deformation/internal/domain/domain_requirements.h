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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DOMAIN_REQUIREMENTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DOMAIN_REQUIREMENTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/energy/edge_weight_requirements.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Domain> using Point_of = typename Domain::Point;
template <typename Domain> using Vertex_of = typename Domain::vertex_descriptor;
template <typename Domain> using Simplex_of = typename Domain::simplex_descriptor;

template <typename Domain>
using Compare_vertices = Requires_convertible<
  decltype(std::declval<const Vertex_of<Domain>&>() == std::declval<const Vertex_of<Domain>&>()),
  bool>;

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
  static_assert(is_valid<Point_of, Domain>, "the model of ARAPDomain lacks: the type Point");
  static_assert(is_valid<Vertex_of, Domain>,
    "the model of ARAPDomain lacks: the type vertex_descriptor");
  static_assert(is_valid<Compare_vertices, Domain>,
    "the model of ARAPDomain lacks: operator== of vertex_descriptor");
  static_assert(is_valid<Simplex_of, Domain>,
    "the model of ARAPDomain lacks: the type simplex_descriptor");
  static_assert(is_valid<Constant_dimension, Domain>,
    "the model of ARAPDomain lacks: static constexpr int dimension");
  static_assert(is_valid<Call_index, Domain>,
    "the model of ARAPDomain lacks: std::size_t index(vertex_descriptor) const");
  static_assert(is_valid<Call_point, Domain>,
    "the model of ARAPDomain lacks: Point point(vertex_descriptor) const");
  static_assert(is_valid<Call_set_point, Domain>,
    "the model of ARAPDomain lacks: void set_point(vertex_descriptor, const Point&) const");
  static_assert(is_valid<Call_is_in_place, Domain>,
    "the model of ARAPDomain lacks: bool is_in_place() const");
  static_assert(is_valid<Call_is_isolated, Domain>,
    "the model of ARAPDomain lacks: bool is_isolated(vertex_descriptor) const");
  static_assert(is_valid<Call_vertices, Domain>,
    "the model of ARAPDomain lacks: vertices() const, a range of vertex_descriptor, also where "
    "it is const");
  static_assert(is_valid<Call_simplex_vertices, Domain>,
    "the model of ARAPDomain lacks: simplex_vertices(simplex_descriptor) const, "
    "a range of vertex_descriptor, also where it is const");
  static_assert(is_valid<Call_coordinates, Domain>,
    "the model of ARAPDomain lacks: "
    "static CGAL::ARAP::Coordinates coordinates(const Point&)");
  static_assert(is_valid<Call_make_point, Domain>,
    "the model of ARAPDomain lacks: static Point make_point(const CGAL::ARAP::Coordinates&)");
  static_assert(is_valid<Call_for_each_incident_simplex, Domain>,
    "the model of ARAPDomain lacks: "
    "void for_each_incident_simplex(vertex_descriptor, const Function&) const");
  static_assert(std::is_copy_constructible_v<Domain>,
    "the model of ARAPDomain lacks: a copy constructor");
  static_assert(std::is_copy_assignable_v<Domain>,
    "the model of ARAPDomain lacks: an assignment");

  static constexpr int dimension = dimension_of<Domain>;
  static_assert(dimension == 0 || dimension == 2 || dimension == 3,
    "the dimension of the model of ARAPDomain must be 2 or 3");
  static_assert(dimension != 3 || is_valid<Call_tetrahedron_weights, Weight>,
    "the model of ARAPEdgeWeight lacks, for a domain of dimension 3: std::array<double, 6> "
    "simplex_weights(const std::array<CGAL::ARAP::Coordinates, 4>&) const");
  static constexpr bool are_met = true;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DOMAIN_REQUIREMENTS_H
