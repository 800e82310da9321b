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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_JOINT_CELL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_JOINT_CELL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/region/Index_lists.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The cells of an edge set as one, where these are many: with the mean rotation M and the spread S
// of their rotations R,
//   sum of k || d' - R d ||^2 = (sum of k) || d' - M d ||^2 + d^T S d.
struct Joint_cell
{
  double stiffness = 0;
  Matrix_3x3 mean = {}, spread = {};

  Joint_cell(const Index_lists& cells, int set, const double* stiffnesses,
             const Matrix_3x3* rotations)
  {
    for(int k = cells.begin[set]; k < cells.begin[set + 1]; ++k)
      stiffness += stiffnesses[cells.items[k]];
    for(int k = cells.begin[set]; k < cells.begin[set + 1] && stiffness > 0; ++k)
      for(std::size_t entry = 0; entry < 9; ++entry)
        mean[entry] += stiffnesses[cells.items[k]] * rotations[cells.items[k]][entry] / stiffness;
    for(int k = cells.begin[set]; k < cells.begin[set + 1]; ++k)
      for(std::size_t a = 0; a < 3; ++a)
        for(std::size_t b = 0; b < 3; ++b)
          for(std::size_t row = 0; row < 3; ++row)
          {
            const Matrix_3x3& r = rotations[cells.items[k]];
            spread[3 * a + b] += stiffnesses[cells.items[k]] *
                                 (r[3 * row + a] - mean[3 * row + a]) *
                                 (r[3 * row + b] - mean[3 * row + b]);
          }
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_JOINT_CELL_H
