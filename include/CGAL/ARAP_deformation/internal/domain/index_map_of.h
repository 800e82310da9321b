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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_INDEX_MAP_OF_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_INDEX_MAP_OF_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/has_parameter.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>

namespace CGAL {
namespace ARAP {
namespace internal {

// A map that is passed may have gaps, which get_initialized_vertex_index_map() refuses in Debug.
template <typename Graph, typename NamedParameters>
auto index_map_of(const Graph& mesh, const NamedParameters& np)
{
  if constexpr(has_parameter<NamedParameters, internal_np::vertex_index_t>)
    return parameters::get_parameter(np, internal_np::vertex_index);
  else
    return get_initialized_vertex_index_map(mesh, np);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_INDEX_MAP_OF_H
