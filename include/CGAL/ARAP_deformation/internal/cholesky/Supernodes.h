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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODES_H

#include <CGAL/license/ARAP_deformation.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The columns of a Cholesky factor in supernodes, which are runs of columns with the same rows
// below their dense triangle. The columns are in a postorder of the elimination tree.
struct Supernodes
{
  std::vector<int> columns;              // where those of each begin, and at last their number
  std::vector<std::size_t> rows_begin;   // where the rows of each begin, and at last their number
  std::vector<int> rows;                 // below the triangle, ascending
  std::vector<std::size_t> values_begin; // where the values of each begin: column by column, each
                                         // from the supernode's first row on

  std::size_t size() const { return values_begin.size(); }
  int width(std::size_t s) const { return columns[s + 1] - columns[s]; }
  int below(std::size_t s) const { return static_cast<int>(rows_begin[s + 1] - rows_begin[s]); }
};

inline std::vector<int> inverse_permutation(const std::vector<int>& order)
{
  std::vector<int> position(order.size());
  for(std::size_t k = 0; k < order.size(); ++k)
    position[order[k]] = static_cast<int>(k);
  return position;
}

// the supernode of each column, from where the columns of each supernode begin
inline std::vector<int> supernode_of_columns(const std::vector<int>& columns)
{
  std::vector<int> result(columns.back());
  for(std::size_t s = 0; s + 1 < columns.size(); ++s)
    std::fill(result.begin() + columns[s], result.begin() + columns[s + 1], static_cast<int>(s));
  return result;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODES_H
