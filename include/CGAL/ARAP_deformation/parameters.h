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

#ifndef CGAL_ARAP_DEFORMATION_PARAMETERS_H
#define CGAL_ARAP_DEFORMATION_PARAMETERS_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>

#include <CGAL/Named_function_parameters.h>

#include <type_traits>
#include <utility>

namespace CGAL {

namespace internal_np {

enum deformation_options_t { deformation_options };
enum deformation_traits_t { deformation_traits };
enum region_of_interest_t { region_of_interest };
enum target_weight_t { target_weight };
enum control_points_t { control_points };
enum output_point_map_t { output_point_map };
enum target_sets_t { target_sets };
enum target_rotations_t { target_rotations };
enum cell_stiffness_t { cell_stiffness };
enum cell_groups_t { cell_groups };

template <typename Tag, typename T>
Named_function_parameters<T, Tag> prepend(const T& value)
{
  return value;
}

template <typename Tag, typename T, typename Base>
Named_function_parameters<T, Tag, Base> prepend(const T& value, const Base& base)
{
  return {value, base};
}

} // namespace internal_np

namespace ARAP {
namespace internal {

template <typename T>
constexpr bool is_named_parameters = false;
template <typename T, typename Tag, typename Base>
constexpr bool is_named_parameters<Named_function_parameters<T, Tag, Base>> = true;

template <typename NamedParameters, typename Tag>
using Parameter_of = std::decay_t<decltype(parameters::get_parameter(
  std::declval<const NamedParameters&>(), Tag()))>;

template <typename NamedParameters, typename Tag>
constexpr bool has_parameter =
  !std::is_same_v<Parameter_of<NamedParameters, Tag>, internal_np::Param_not_found>;

template <typename NamedParameters, typename Tag>
constexpr bool has_number = std::is_arithmetic_v<Parameter_of<NamedParameters, Tag>>;

} // namespace internal
} // namespace ARAP

namespace parameters {

/// \addtogroup PkgARAPDeformationParameters
/// Named parameters of `CGAL::arap_deform()` and of the constructors of `CGAL::ARAP_deformation`,
/// in addition to those of \cgal. They begin a sequence,
/// `parameters::deformation_options(o).visitor(v)`, or have the rest of it as their second
/// argument: `parameters::region_of_interest(r, parameters::target_weight(w))`.
/// @{

/// the options, default `ARAP::Options()`.
template <typename... NP>
auto deformation_options(const ARAP::Options& options, const NP&... np)
{
  return internal_np::prepend<internal_np::deformation_options_t>(options, np...);
}

/// the traits, a model of `ARAPDeformationTraits`; then `weight_calculator` and
/// `sparse_linear_solver` are ignored.
template <typename DeformationTraits, typename... NP>
auto deformation_traits(const DeformationTraits& traits, const NP&... np)
{
  return internal_np::prepend<internal_np::deformation_traits_t>(traits, np...);
}

/// the region of interest, a range of vertices; default all vertices in `arap_deform()`, and none
/// in the constructors. Constrained vertices are in it anyway.
template <typename VertexRange, typename... NP>
auto region_of_interest(const VertexRange& vertices, const NP&... np)
{
  return internal_np::prepend<internal_np::region_of_interest_t>(vertices, np...);
}

/// the weight of each target, see `ARAP_deformation::set_target_weight()`: a number, or a map from
/// vertices to numbers (a property map, a function object, a map, or a vector by the indices of
/// the vertices); default infinite. Vertices that only `vertex_is_constrained_map` constrains are
/// hard, and so are those that a map has no value for. A map says nothing of control points: they
/// are hard. In `arap_deform()` only.
template <typename Weight, typename... NP>
auto target_weight(const Weight& weight, const NP&... np)
{
  return internal_np::prepend<internal_np::target_weight_t>(weight, np...);
}

/// targets that are sets, a range of pairs of a vertex and a projection, such as a
/// `std::map<Vertex, std::function<Point(const Point&)>>`, see
/// `ARAP_deformation::set_target_set()`; such a vertex needs no other target, but a finite
/// `target_weight()`. In `arap_deform()` only.
template <typename SetRange, typename... NP>
auto target_sets(const SetRange& sets, const NP&... np)
{
  return internal_np::prepend<internal_np::target_sets_t>(sets, np...);
}

/// control points, a range of tuples of a simplex, barycentric coordinates and a target, such as
/// `std::vector<std::tuple<Simplex, std::array<double, 3>, Point>>`, see
/// `ARAP_deformation::insert_control_point()`; a `target_weight()` that is a number counts for
/// them, too. In `arap_deform()` only.
template <typename ControlPointRange, typename... NP>
auto control_points(const ControlPointRange& points, const NP&... np)
{
  return internal_np::prepend<internal_np::control_points_t>(points, np...);
}

/// where the new points of a `FaceGraph` are written, a model of `WritablePropertyMap`; default the
/// vertex point map. Only vertices in the region of interest are written: copy the other points
/// first. The mesh may be `const`.
template <typename OutputPointMap, typename... NP>
auto output_point_map(const OutputPointMap& points, const NP&... np)
{
  return internal_np::prepend<internal_np::output_point_map_t>(points, np...);
}

/// the rotations that control vertices prescribe, see `ARAP_deformation::set_target_rotation()`: a
/// range of pairs of a vertex and a rotation, such as a `std::map`; default none. The vertices have
/// targets, too. In `arap_deform()` only.
template <typename RotationRange, typename... NP>
auto target_rotations(const RotationRange& rotations, const NP&... np)
{
  return internal_np::prepend<internal_np::target_rotations_t>(rotations, np...);
}

/// the stiffness of cells, a map from vertices or simplices to numbers, see
/// `ARAP_deformation::set_stiffness()`, also for generic lambdas; default 1.
template <typename StiffnessMap, typename... NP>
auto cell_stiffness(const StiffnessMap& stiffness, const NP&... np)
{
  return internal_np::prepend<internal_np::cell_stiffness_t>(stiffness, np...);
}

/// the groups of cells that share a rotation, a map from vertices or simplices to integers, see
/// `ARAP_deformation::set_groups()`, also for generic lambdas; default none.
template <typename GroupMap, typename... NP>
auto cell_groups(const GroupMap& groups, const NP&... np)
{
  return internal_np::prepend<internal_np::cell_groups_t>(groups, np...);
}
/// @}

} // namespace parameters
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_PARAMETERS_H
