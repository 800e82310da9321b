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
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/matrix_3x3.h>

namespace CGAL {
namespace ARAP {
namespace internal {

// The cells of an edge set as one, where these are many: with the mean rotation M and the spread S
// of their rotations R,
//   sum of k || d' - R d ||^2 = (sum of k) || d' - M d ||^2 + d^T S d.
struct Joint_cell
{
  double stiffness;
  Matrix_rows mean, spread;

  CGAL_ARAP_ALWAYS_INLINE Joint_cell(const Index_lists& cells, int set, const double* stiffnesses,
                                     const Matrix_3x3* rotations)
    : stiffness(0), mean(Matrix_rows::zero()), spread(Matrix_rows::zero())
  {
    const int begin = cells.begin[set], end = cells.begin[set + 1];
    for(int k = begin; k < end; ++k)
      stiffness += stiffnesses[cells.items[k]];
    for(int k = begin; k < end && stiffness > 0; ++k)
      mean.add_product(Double4::all(stiffnesses[cells.items[k]] / stiffness),
                       Matrix_rows::of(rotations[cells.items[k]]));
    for(int k = begin; k < end; ++k)
    {
      const Double4 factor = Double4::all(stiffnesses[cells.items[k]]);
      const Matrix_rows rotation = Matrix_rows::of(rotations[cells.items[k]]);
      const Double4 x = rotation.x - mean.x, y = rotation.y - mean.y, z = rotation.z - mean.z;
      spread.add_outer_product(factor * x, x);
      spread.add_outer_product(factor * y, y);
      spread.add_outer_product(factor * z, z);
    }
  }
};

// The means of the cells of the sets in [begin, end), and the sum of d^T S d over the edges there,
// whose w d d^T add up to their rest covariances.
struct Joint_cells_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Index_lists& cells, int begin, int end,
                                          const double* stiffnesses, const Matrix_3x3* rotations,
                                          const Matrix_3x3* rest_covariances, Matrix_3x3* means,
                                          double* energy)
  {
    Double4 sum = Double4::zero();
    for(int i = begin; i < end; ++i)
    {
      const Joint_cell cell(cells, i, stiffnesses, rotations);
      cell.mean.store(means[i]);
      const Matrix_rows rest = Matrix_rows::of(rest_covariances[i]);
      sum = multiply_add(cell.spread.x, rest.x,
            multiply_add(cell.spread.y, rest.y, multiply_add(cell.spread.z, rest.z, sum)));
    }
    *energy = sum[0] + sum[1] + sum[2];
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_JOINT_CELL_H
