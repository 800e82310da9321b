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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_FIND_SUPERNODES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_FIND_SUPERNODES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodes.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

// The symbolic factorization: from the pattern of a matrix and an ordering of its rows to the
// supernodes of its Cholesky factor.

namespace CGAL {
namespace ARAP {
namespace internal {

// The pattern of one triangle of a symmetric matrix without its diagonal, column by column.
struct Triangle_pattern
{
  std::vector<int> begin, rows;
};

// A triangle of P A P^T: the lower, or if not so the upper one. The rows are in any order.
inline Triangle_pattern permuted_triangle(const Sparse_matrix& a, const std::vector<int>& position,
                                          bool is_lower)
{
  const int n = static_cast<int>(a.cols());
  Triangle_pattern triangle;
  triangle.begin.assign(n + 2, 0);
  const auto for_each_entry = [&](const auto& f) {
    for(int j = 0; j < n; ++j)
      for(int k = a.outerIndexPtr()[j]; k < a.outerIndexPtr()[j + 1]; ++k)
        if(const int i = a.innerIndexPtr()[k]; i != j)
        {
          const auto [first, last] = std::minmax(position[i], position[j]);
          is_lower ? f(first, last) : f(last, first);
        }
  };
  for_each_entry([&](int column, int) { ++triangle.begin[column + 2]; });
  std::partial_sum(triangle.begin.begin(), triangle.begin.end(), triangle.begin.begin());
  triangle.rows.resize(triangle.begin.back());
  for_each_entry([&](int column, int row) { triangle.rows[triangle.begin[column + 1]++] = row; });
  triangle.begin.pop_back();
  return triangle;
}

// The parent of each column, or -1 for roots, from the upper triangle. See Liu, The role of
// elimination trees in sparse factorization.
inline std::vector<int> elimination_tree(const Triangle_pattern& upper)
{
  const int n = static_cast<int>(upper.begin.size()) - 1;
  std::vector<int> parent(n, -1), ancestor(n, -1);
  for(int j = 0; j < n; ++j)
    for(int k = upper.begin[j]; k < upper.begin[j + 1]; ++k)
      for(int i = upper.rows[k]; i != -1 && i < j;)
      {
        const int next = ancestor[i];
        ancestor[i] = j;
        if(next == -1)
          parent[i] = j;
        i = next;
      }
  return parent;
}

// A postorder in which the child with the largest subtree comes last, next to its parent, with
// which it is likely to share a supernode.
inline std::vector<int> postorder(const std::vector<int>& parent)
{
  const int n = static_cast<int>(parent.size());
  std::vector<int> size(n, 1), position(n), next(n + 1, 0), result(n), last(n + 1, -1);
  for(int j = 0; j < n; ++j)
    if(parent[j] >= 0)
      size[parent[j]] += size[j];
  // the largest child, or root
  for(int j = 0; j < n; ++j)
    if(int& l = last[parent[j] < 0 ? n : parent[j]]; l < 0 || size[j] >= size[l])
      l = j;
  // parents first: each hands the places of its subtree out to its children
  for(int j = n; j-- > 0;)
  {
    const int p = parent[j] < 0 ? n : parent[j];
    const int end = p == n ? n : position[p];
    if(j == last[p])
      position[j] = end - 1;
    else
    {
      const int others = end - size[last[p]];
      position[j] = others - next[p] - 1;
      next[p] += size[j];
    }
  }
  for(int j = 0; j < n; ++j)
    result[position[j]] = j;
  return result;
}

// The number of rows of each column of the factor, the diagonal included; the columns are in
// postorder. See Gilbert, Ng and Peyton, An efficient algorithm to compute row and column counts
// for sparse Cholesky factorization.
inline std::vector<int> column_counts(const Triangle_pattern& lower, const std::vector<int>& parent)
{
  const int n = static_cast<int>(parent.size());
  std::vector<int> count(n, 0), first(n, -1), largest_first(n, -1), previous_leaf(n, -1),
                   ancestor(n);
  std::iota(ancestor.begin(), ancestor.end(), 0);
  for(int j = 0; j < n; ++j)
  {
    count[j] = first[j] == -1 ? 1 : 0;
    for(int i = j; i != -1 && first[i] == -1; i = parent[i])
      first[i] = j;
  }
  for(int j = 0; j < n; ++j)
  {
    if(parent[j] != -1)
      --count[parent[j]];
    for(int k = lower.begin[j]; k < lower.begin[j + 1]; ++k)
    {
      const int i = lower.rows[k];
      if(first[j] <= largest_first[i])
        continue;
      // column j is a leaf of the subtree of row i
      largest_first[i] = first[j];
      ++count[j];
      const int leaf = std::exchange(previous_leaf[i], j);
      if(leaf == -1)
        continue;
      int common = leaf;
      while(common != ancestor[common])
        common = ancestor[common];
      for(int l = leaf; l != common;)
        l = std::exchange(ancestor[l], common);
      --count[common];
    }
    if(parent[j] != -1)
      ancestor[j] = parent[j];
  }
  for(int j = 0; j < n; ++j)
    if(parent[j] != -1)
      count[parent[j]] += count[j];
  return count;
}

// Where supernodes begin, and at last the number of columns. Columns with the same rows are put
// together, and then supernodes with their parents where that adds few zeros to the factor: the
// fewer and wider they are, the less time goes into what is not arithmetic.
class Supernode_columns
{
public:
  Supernode_columns(const std::vector<int>& parent, const std::vector<int>& count)
  {
    const int n = static_cast<int>(parent.size());
    for(int j = 0; j < n; ++j)
      if(j == 0 || parent[j - 1] != j || count[j - 1] != count[j] + 1)
        m_begin.push_back(j);
    m_begin.push_back(n);
    merge(parent, count);
  }

  std::vector<int> begin() && { return std::move(m_begin); }

private:
  // the share of zeros in a supernode of that many columns
  static double largest_share_of_zeros(double width)
  {
    return width <= 4 ? 1 : width <= 16 ? 0.8 : width <= 48 ? 0.1 : 0.05;
  }

  // Supernodes that follow each other and are child and parent, the last ones first.
  void merge(const std::vector<int>& parent, const std::vector<int>& count)
  {
    std::vector<int> begin(1, m_begin.back());
    double entries_above = 0, below = 0;
    for(std::size_t s = m_begin.size() - 1; s-- > 0;)
    {
      const int first = m_begin[s], end = m_begin[s + 1];
      const double entries =
        std::accumulate(count.begin() + first, count.begin() + end, 0.0);
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
    m_begin.assign(begin.rbegin(), begin.rend());
  }

  std::vector<int> m_begin;
};

// The supernodes of the factor of P A P^T. On the way `order`, which has the row of the matrix for
// each row of the factor, becomes a postorder.
inline Supernodes find_supernodes(const Sparse_matrix& a, std::vector<int>& order)
{
  std::vector<int> parent =
    elimination_tree(permuted_triangle(a, inverse_permutation(order), false));
  const std::vector<int> post = postorder(parent), post_position = inverse_permutation(post);
  std::vector<int> unsorted_parent = parent, unsorted_order = order;
  for(std::size_t j = 0; j < post.size(); ++j)
  {
    order[j] = unsorted_order[post[j]];
    const int p = unsorted_parent[post[j]];
    parent[j] = p < 0 ? -1 : post_position[p];
  }
  const Triangle_pattern lower = permuted_triangle(a, inverse_permutation(order), true);

  Supernodes result;
  result.columns = Supernode_columns(parent, column_counts(lower, parent)).begin();
  const std::size_t n = result.columns.size() - 1;
  result.rows_begin.assign(1, 0);
  result.values_begin.resize(n);
  std::size_t values = 0;
  const std::vector<int> supernode_of = supernode_of_columns(result.columns);
  std::vector<int> first_child(n, -1), next_child(n, -1);
  std::vector<int> seen(order.size(), -1); // the last supernode that a row was found in
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
    add(lower.rows.data() + lower.begin[begin], lower.rows.data() + lower.begin[end]);
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
    const std::size_t below = result.rows.size() - rows;
    const std::size_t width = static_cast<std::size_t>(end - begin);
    if(below > 0)
    {
      const int p = supernode_of[result.rows[rows]];
      next_child[s] = std::exchange(first_child[p], mark);
    }
    result.values_begin[s] = values;
    values += width * (width + below);
  }
  return result;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_FIND_SUPERNODES_H
