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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_CELLS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_CELLS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/region/Index_lists.h>

#include <numeric>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The edge sets of each cell, which share one rotation and the stiffness of the cell.
struct Cells
{
  Index_lists sets;
  std::vector<double> stiffness;

  int size() const { return sets.size(); }
};

// each edge set is a cell
inline Cells separate_cells(int number_of_sets)
{
  Cells cells;
  cells.sets.begin.resize(number_of_sets + 1);
  std::iota(cells.sets.begin.begin(), cells.sets.begin.end(), 0);
  cells.sets.items.assign(cells.sets.begin.begin(), cells.sets.begin.end() - 1);
  cells.stiffness.assign(number_of_sets, 1);
  return cells;
}

// the simplices with these corners are a cell at each of the first `number_of_centres` vertices
inline Cells vertex_cells(const Index_lists& corners, int number_of_centres)
{
  return {lists_with(corners, number_of_centres), std::vector<double>(number_of_centres, 1)};
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_CELLS_H
