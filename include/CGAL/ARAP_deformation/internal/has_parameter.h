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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_HAS_PARAMETER_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_HAS_PARAMETER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/Named_function_parameters.h>

#include <type_traits>
#include <utility>

namespace CGAL {
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
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_HAS_PARAMETER_H
