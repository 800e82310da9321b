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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_CLOSEST_ROTATION_REQUIREMENTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_CLOSEST_ROTATION_REQUIREMENTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Rotation>
using Call_closest_rotation = decltype(std::declval<const Rotation&>()(
  std::size_t(), std::declval<const Matrix_3x3*>(), std::declval<Matrix_3x3*>()));

template <typename Rotation>
using Call_compute_close_rotation = decltype(std::declval<Rotation&>().compute_close_rotation(
  std::declval<const typename Rotation::Matrix&>(), std::declval<typename Rotation::Matrix&>()));

template <typename Rotation>
struct Closest_rotation_requirements
{
  static_assert(!is_valid<Call_compute_close_rotation, Rotation>,
    "a model of CGAL's concept DeformationClosestRotationTraits_3 is no model of "
    "ARAPClosestRotation: wrap it in CGAL::ARAP::Closest_rotation_traits_adaptor<>");
  static_assert(is_valid<Call_closest_rotation, Rotation>,
    "the model of ARAPClosestRotation lacks: void operator()(std::size_t, "
    "const CGAL::ARAP::Matrix_3x3*, CGAL::ARAP::Matrix_3x3*) const");
  static_assert(std::is_copy_constructible_v<Rotation>,
    "the model of ARAPClosestRotation lacks: a copy constructor");
  static constexpr bool are_met = true;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_CLOSEST_ROTATION_REQUIREMENTS_H
