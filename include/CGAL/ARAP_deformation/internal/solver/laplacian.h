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
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/solver/raise_diagonal.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Half the Hessian of the energy with its rotations fixed, for the free vertices: the matrix of
// Equation (9) of the paper, from which the fixed vertices' rows and columns are left out, so that
// it is symmetric positive definite. The lower triangle, with its diagonal raised.
inline Sparse_matrix free_laplacian(const Deformation_energy& energy)
{
  // the off-diagonal entries of each column, with one entry for each edge set
  const int n = energy.number_of_free_vertices();
  using Entry = std::pair<int, double>;
  std::vector<int> first(n + 1, 0);
  std::vector<double> diagonal(n, 0);
  energy.for_each_edge([&](int i, int j, double w) {
    if(i < n) diagonal[i] += w;
    if(j < n) diagonal[j] += w;
    if(i < n && j < n) ++first[(std::min)(i, j) + 1];
  });
  for(const Soft_position& soft : energy.soft_positions())
    diagonal[soft.vertex] += soft.weight;
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Entry> entries(first.back());
  std::vector<int> next(first.begin(), first.end() - 1);
  energy.for_each_edge([&](int i, int j, double w) {
    if(i < n && j < n) entries[next[(std::min)(i, j)]++] = {(std::max)(i, j), -w};
  });

  // sorted, and those of the same row added up: of column j there are sizes[j], and the diagonal
  std::vector<int>& sizes = next;
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    for(std::size_t j = begin; j < end; ++j)
      sizes[j] = sort_and_add_up(entries.begin() + first[j], entries.begin() + first[j + 1]);
  });
  Sparse_matrix laplacian(n, n);
  int* outer = laplacian.outerIndexPtr();
  for(int j = 0; j < n; ++j)
    outer[j + 1] = outer[j] + sizes[j] + 1;
  laplacian.resizeNonZeros(outer[n]);
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    for(std::size_t j = begin; j < end; ++j)
    {
      int* row = laplacian.innerIndexPtr() + outer[j];
      double* value = laplacian.valuePtr() + outer[j];
      *row++ = static_cast<int>(j);
      *value++ = diagonal[j];
      for(int k = 0; k < sizes[j]; ++k)
      {
        *row++ = entries[first[j] + k].first;
        *value++ = entries[first[j] + k].second;
      }
    }
  });
  raise_diagonal(laplacian);
  return laplacian;
}

// For each free vertex -1 if a chain of edges of non-zero weight ties it, over other free vertices,
// to one that is fixed or pulled to a target. If not, its component could be anywhere, and the
// matrix is singular: then it is the smallest vertex of that component.
inline std::vector<int> find_unconstrained_components(const Deformation_energy& energy)
{
  // union-find, with one more element for all that is fixed; the smallest of each set is its root,
  // but for that one
  const int fixed = energy.number_of_free_vertices();
  std::vector<int> parent(fixed + 1);
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&parent](int v) {
    while(parent[v] != v)
      v = parent[v] = parent[parent[v]];
    return v;
  };
  const auto tie = [&](int i, int j, double weight) {
    if(weight == 0)
      return;
    const int a = find((std::min)(i, fixed)), b = find((std::min)(j, fixed));
    const int root = (std::max)(a, b) == fixed ? fixed : (std::min)(a, b);
    parent[a] = parent[b] = root;
  };
  energy.for_each_edge(tie);
  for(const Soft_position& soft : energy.soft_positions())
    tie(soft.vertex, fixed, soft.weight);
  for(int v = 0; v < fixed; ++v)
    parent[v] = find(v);
  parent.pop_back();
  std::replace(parent.begin(), parent.end(), fixed, -1);
  return parent;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_LAPLACIAN_H
