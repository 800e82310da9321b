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

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/cholesky/elimination_tree.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// The columns of a Cholesky factor in supernodes, which are runs of columns with the same rows
// below their dense triangle. The columns are in a postorder of the elimination tree.
struct Supernodes
{
  Array<int> columns;            // where those of each begin, and at last their number
  Array<std::size_t> rows_begin; // where the rows of each begin, and at last their number
  Array<int> rows;               // below the triangle, ascending

  std::size_t size() const { return columns.size() - 1; }
  int width(std::size_t s) const { return columns[s + 1] - columns[s]; }
  int below(std::size_t s) const { return static_cast<int>(rows_begin[s + 1] - rows_begin[s]); }
};

// Where supernodes begin, and at last the number of columns. Columns with the same rows form
// supernodes, which are then merged with their parents if that adds few zeros to the factor: fewer
// and wider supernodes have less overhead.
inline Array<int> supernode_columns(const Array<int>& parent, const Array<int>& count)
{
  const int n = static_cast<int>(parent.size());
  Array<int> all;
  for(int j = 0; j < n; ++j)
    if(j == 0 || parent[j - 1] != j || count[j - 1] != count[j] + 1)
      all.push_back(j);

  // the share of zeros in a supernode of that many columns
  const auto largest_share_of_zeros = [](double width) {
    return width <= 4 ? 1 : width <= 8 ? 0.8 : width <= 48 ? 0.1 : 0.05;
  };
  // supernodes that follow each other and are child and parent, the last ones first
  Array<int> begin(1, n);
  double entries_above = 0, below = 0;
  for(std::size_t s = all.size(); s-- > 0;)
  {
    const int first = all[s], end = s + 1 < all.size() ? all[s + 1] : n;
    const double entries = std::accumulate(count.begin() + first, count.begin() + end, 0.0);
    if(begin.size() > 1 && parent[end - 1] == end)
    {
      const double width = begin[begin.size() - 2] - first;
      const double size = width * ((width + 1) / 2 + below);
      if(size - entries - entries_above <= largest_share_of_zeros(width) * size)
      {
        begin.back() = first;
        entries_above += entries;
        continue;
      }
    }
    begin.push_back(first);
    entries_above = entries;
    below = count[end - 1] - 1;
  }
  return Array<int>(begin.rbegin(), begin.rend());
}

// The supernodes of the factor of P A P^T. `order`, which has the row of the matrix for each row of
// the factor, is replaced by an equivalent postorder.
inline Supernodes find_supernodes(const Sparse_matrix& a, Array<int>& order)
{
  Array<int> parent =
    elimination_tree(permuted_triangle(a, inverse_permutation(order), false));
  const Array<int> post = postorder(parent), post_position = inverse_permutation(post);
  Array<int> unsorted_parent = parent, unsorted_order = order;
  for(std::size_t j = 0; j < post.size(); ++j)
  {
    order[j] = unsorted_order[post[j]];
    const int p = unsorted_parent[post[j]];
    parent[j] = p < 0 ? -1 : post_position[p];
  }
  const Index_lists lower = permuted_triangle(a, inverse_permutation(order), true);

  Supernodes result;
  result.columns = supernode_columns(parent, column_counts(lower, parent));
  const std::size_t n = result.columns.size() - 1;
  result.rows_begin.assign(1, 0);
  const Array<int> supernode_of = list_of_each(result.columns);
  Array<int> first_child(n, -1), next_child(n, -1);
  Array<int> seen(order.size(), -1); // the last supernode that a row was found in
  for(std::size_t s = 0; s < n; ++s)
  {
    const int begin = result.columns[s], end = result.columns[s + 1], mark = static_cast<int>(s);
    const auto add = [&](const int* row, const int* last) {
      for(; row != last; ++row)
        if(*row >= end && seen[*row] != mark)
        {
          seen[*row] = mark;
          result.rows.push_back(*row);
        }
    };
    const std::size_t rows = result.rows_begin[s];
    add(lower.items.data() + lower.begin[begin], lower.items.data() + lower.begin[end]);
    for(int child = first_child[s]; child >= 0; child = next_child[child])
    {
      // not pointers: the rows grow
      for(std::size_t k = result.rows_begin[child]; k < result.rows_begin[child + 1]; ++k)
      {
        const int row = result.rows[k];
        add(&row, &row + 1);
      }
    }
    std::sort(result.rows.begin() + static_cast<std::ptrdiff_t>(rows), result.rows.end());
    result.rows_begin.push_back(result.rows.size());
    if(result.rows.size() > rows)
    {
      const int p = supernode_of[result.rows[rows]];
      next_child[s] = std::exchange(first_child[p], mark);
    }
  }
  return result;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODES_H
