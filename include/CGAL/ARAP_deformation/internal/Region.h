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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// What the numeric core knows of a mesh: the free vertices with two rings of simplices around them.
// The free vertices come first, then their neighbours, then the neighbours of those. The first two
// are the centres: the vertices whose simplices are all here. Every vertex that is not free is
// held. The simplices that have a free vertex come first.
template <std::size_t VerticesPerSimplex>
struct Region
{
  using Simplex = std::array<int, VerticesPerSimplex>;

  int number_of_free_vertices = 0;
  int number_of_centres = 0;
  int number_of_free_simplices = 0;
  std::vector<Coordinates> rest; // for each vertex its position in the rest shape
  std::vector<Simplex> simplices;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_H
