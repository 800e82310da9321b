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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_IS_VALID_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_IS_VALID_H

#include <CGAL/license/ARAP_deformation.h>

#include <type_traits>

namespace CGAL {
namespace ARAP {
namespace internal {

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

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_IS_VALID_H
