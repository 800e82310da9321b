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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_MAKE_SIMPLEX_SEARCH_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_MAKE_SIMPLEX_SEARCH_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/Simplex_search.h>

#include <array>
#include <memory>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

std::unique_ptr<Simplex_search<3>>
make_simplex_search(const std::vector<std::array<Coordinates, 3>>& triangles);
std::unique_ptr<Simplex_search<4>>
make_simplex_search(const std::vector<std::array<Coordinates, 4>>& tetrahedra);

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/domain/make_simplex_search_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_MAKE_SIMPLEX_SEARCH_H
