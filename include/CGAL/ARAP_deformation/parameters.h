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

namespace parameters {

/// \cond SKIP_IN_MANUAL
// They begin a sequence, as in deformation_options(o).visitor(v), or have the rest of it as their
// second argument: region_of_interest(r, target_weight(w)). arap_deform() documents them.

template <typename... NP>
auto deformation_options(const ARAP::Options& options, const NP&... np)
{
  return internal_np::prepend<internal_np::deformation_options_t>(options, np...);
}

template <typename DeformationTraits, typename... NP>
auto deformation_traits(const DeformationTraits& traits, const NP&... np)
{
  return internal_np::prepend<internal_np::deformation_traits_t>(traits, np...);
}

template <typename VertexRange, typename... NP>
auto region_of_interest(const VertexRange& vertices, const NP&... np)
{
  return internal_np::prepend<internal_np::region_of_interest_t>(vertices, np...);
}

template <typename Weight, typename... NP>
auto target_weight(const Weight& weight, const NP&... np)
{
  return internal_np::prepend<internal_np::target_weight_t>(weight, np...);
}

template <typename SetRange, typename... NP>
auto target_sets(const SetRange& sets, const NP&... np)
{
  return internal_np::prepend<internal_np::target_sets_t>(sets, np...);
}

template <typename ControlPointRange, typename... NP>
auto control_points(const ControlPointRange& points, const NP&... np)
{
  return internal_np::prepend<internal_np::control_points_t>(points, np...);
}

template <typename OutputPointMap, typename... NP>
auto output_point_map(const OutputPointMap& points, const NP&... np)
{
  return internal_np::prepend<internal_np::output_point_map_t>(points, np...);
}

template <typename RotationRange, typename... NP>
auto target_rotations(const RotationRange& rotations, const NP&... np)
{
  return internal_np::prepend<internal_np::target_rotations_t>(rotations, np...);
}

template <typename StiffnessMap, typename... NP>
auto cell_stiffness(const StiffnessMap& stiffness, const NP&... np)
{
  return internal_np::prepend<internal_np::cell_stiffness_t>(stiffness, np...);
}

template <typename GroupMap, typename... NP>
auto cell_groups(const GroupMap& groups, const NP&... np)
{
  return internal_np::prepend<internal_np::cell_groups_t>(groups, np...);
}
/// \endcond

} // namespace parameters
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_PARAMETERS_H
