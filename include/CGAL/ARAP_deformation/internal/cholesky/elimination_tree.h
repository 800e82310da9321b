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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_ELIMINATION_TREE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_ELIMINATION_TREE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

// The symbolic factorization up to the sizes of the columns: patterns of permuted matrices, the
// elimination tree, its postorder, and the number of entries of each column of the factor.

namespace CGAL {
namespace ARAP {
namespace internal {

inline Array<int> inverse_permutation(const Array<int>& order)
{
  Array<int> position(order.size());
  for(std::size_t k = 0; k < order.size(); ++k)
    position[order[k]] = static_cast<int>(k);
  return position;
}

// For each row of a symmetric matrix, of which the lower triangle is given, the others that it has
// entries for.
inline Index_lists neighbors_of_rows(const Sparse_matrix& a)
{
  const int n = static_cast<int>(a.cols());
  return lists_of_pairs(n, [&](const auto& f) {
    for(int j = 0; j < n; ++j)
      for(Sparse_matrix::InnerIterator entry(a, j); entry; ++entry)
        if(const int i = static_cast<int>(entry.row()); i != j)
        {
          f(i, j);
          f(j, i);
        }
  });
}

// The rows of each column of a triangle of P A P^T without its diagonal: the lower triangle, or if
// not so the upper one. The rows are in any order.
inline Index_lists permuted_triangle(const Sparse_matrix& a, const Array<int>& position,
                                     bool is_lower)
{
  const int n = static_cast<int>(a.cols());
  return lists_of_pairs(n, [&](const auto& f) {
    for(int j = 0; j < n; ++j)
      for(int k = a.outerIndexPtr()[j]; k < a.outerIndexPtr()[j + 1]; ++k)
        if(const int i = a.innerIndexPtr()[k]; i != j)
        {
          const auto [first, last] = std::minmax(position[i], position[j]);
          is_lower ? f(first, last) : f(last, first);
        }
  });
}

// The parent of each column, or -1 for roots, from the upper triangle. See Liu, The role of
// elimination trees in sparse factorization.
inline Array<int> elimination_tree(const Index_lists& upper)
{
  const int n = upper.size();
  Array<int> parent(n, -1), ancestor(n, -1);
  for(int j = 0; j < n; ++j)
    for(int k = upper.begin[j]; k < upper.begin[j + 1]; ++k)
      for(int i = upper.items[k]; i != -1 && i < j;)
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
inline Array<int> postorder(const Array<int>& parent)
{
  const int n = static_cast<int>(parent.size());
  Array<int> size(n, 1), position(n), next(n + 1, 0), last(n + 1, -1);
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
  return inverse_permutation(position);
}

// The number of rows of each column of the factor, the diagonal included; the columns are in
// postorder. See Gilbert, Ng and Peyton, An efficient algorithm to compute row and column counts
// for sparse Cholesky factorization.
inline Array<int> column_counts(const Index_lists& lower, const Array<int>& parent)
{
  const int n = static_cast<int>(parent.size());
  Array<int> count(n, 0), first(n, -1), largest_first(n, -1), previous_leaf(n, -1), ancestor(n);
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
      const int i = lower.items[k];
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

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_ELIMINATION_TREE_H
