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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CONSTRAINTS_CONSTRAINTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CONSTRAINTS_CONSTRAINTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/constraints/Weighted_rows.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// What is prescribed for the movable vertices of a region: some are fixed, and rows pull others.
// Targets are no part of it: they may change with each run.
struct Constraints
{
  std::vector<char> is_fixed; // for each movable vertex
  Weighted_rows rows;         // of vertices that may be fixed or not

  int number_of_free_vertices() const
  {
    return static_cast<int>(std::count(is_fixed.begin(), is_fixed.end(), 0));
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CONSTRAINTS_CONSTRAINTS_H
