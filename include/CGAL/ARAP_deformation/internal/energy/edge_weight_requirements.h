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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_WEIGHT_REQUIREMENTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_WEIGHT_REQUIREMENTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

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
    "the model of ARAPEdgeWeight lacks: std::array<double, 3> "
    "simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>&) const");
  static_assert(is_valid<Call_edge_weight, Weight>,
    "the model of ARAPEdgeWeight lacks: "
    "double edge_weight(CGAL::ARAP::Edge_set, std::size_t, std::size_t, double) const");
  static_assert(std::is_copy_constructible_v<Weight>,
    "the model of ARAPEdgeWeight lacks: a copy constructor");
  static constexpr bool are_met = true;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_WEIGHT_REQUIREMENTS_H
