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

#ifndef CGAL_ARAP_DEFORMATION_OF_SIMPLICES_H
#define CGAL_ARAP_DEFORMATION_OF_SIMPLICES_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <utility>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationOptions
/// a map whose keys are simplices; see `of_simplices()`.
template <typename Map>
struct Simplex_map
{
  Map map; ///< the map.
};

/// \ingroup PkgARAPDeformationOptions
/// declares that the keys of a map for `CGAL::ARAP_deformation::set_stiffness()` or `set_groups()`
/// are simplices. A generic lambda needs it: by itself it is asked for vertices.
template <typename Map>
Simplex_map<Map> of_simplices(Map map)
{
  return {std::move(map)};
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_OF_SIMPLICES_H
