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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_MAKE_SIMPLEX_SEARCH_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_MAKE_SIMPLEX_SEARCH_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/domain/Tetrahedron_search.h>
#include <CGAL/ARAP_deformation/internal/domain/Triangle_search.h>
#include <CGAL/ARAP_deformation/internal/domain/make_simplex_search.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>

#include <array>
#include <memory>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION std::unique_ptr<Simplex_search<3>>
make_simplex_search(const std::vector<std::array<Coordinates, 3>>& triangles)
{
  return std::make_unique<Triangle_search>(triangles);
}

CGAL_ARAP_INLINE_FUNCTION std::unique_ptr<Simplex_search<4>>
make_simplex_search(const std::vector<std::array<Coordinates, 4>>& tetrahedra)
{
  return std::make_unique<Tetrahedron_search>(tetrahedra);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_MAKE_SIMPLEX_SEARCH_IMPL_H
