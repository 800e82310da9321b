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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_LAPLACIAN_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_LAPLACIAN_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Half the Hessian of rigidity and bending with their rotations fixed, for all movable vertices of
// a region. Without bending it is the matrix of Equation (9) of the paper.
struct Laplacian
{
  Sparse_matrix matrix; // the lower triangle, every diagonal entry stored
  Array<char> is_tied;  // for each vertex whether an edge ties it to one that is not movable
  bool is_sum_of_squares = true; // whether no edge set has a negative energy, up to rounding

  Laplacian() = default;
  Laplacian(Laplacian&& other) { *this = std::move(other); }
  Laplacian& operator=(Laplacian&& other) // Eigen 3.4 copies matrices instead
  {
    matrix.swap(other.matrix);
    is_tied.swap(other.is_tied);
    is_sum_of_squares = other.is_sum_of_squares;
    return *this;
  }

  int size() const { return static_cast<int>(matrix.cols()); }
};

// the diagonal entry of a column of a lower triangle: the first one
inline double diagonal_entry(const Sparse_matrix& matrix, int column)
{
  return matrix.valuePtr()[matrix.outerIndexPtr()[column]];
}

inline double& diagonal_entry(Sparse_matrix& matrix, int column)
{
  return matrix.valuePtr()[matrix.outerIndexPtr()[column]];
}

// whether two compressed matrices have entries at the same places
inline bool has_pattern(const Sparse_matrix& a, const Sparse_matrix& b)
{
  return a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

// a bound of the rounding error of a sum, as a share of the sum of the absolute values
constexpr double rounding_of_a_sum = 16 * std::numeric_limits<double>::epsilon();

// The factor applied to the diagonal of a matrix before it is factorized. Rounding
// changes each pivot by some units in the last place of the diagonal entry; where large weights are
// next to small ones nothing else may be left of it. A sum of squares is positive semidefinite, and
// is raised by as much: a pivot that is too small would throw vertices far away, and one that is
// too large only makes the steps of local/global shorter, which still have the same fixed points.
// Any other matrix is lowered: what is singular up to rounding is refused.
inline double diagonal_factor(const Laplacian& laplacian)
{
  return laplacian.is_sum_of_squares ? 1 + rounding_of_a_sum : 1 - rounding_of_a_sum;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_LAPLACIAN_H
