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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_UNCONSTRAINED_COMPONENTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_UNCONSTRAINED_COMPONENTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/solver/Laplacian.h>

#include <algorithm>
#include <numeric>

namespace CGAL {
namespace ARAP {
namespace internal {

// For each movable vertex -1 if it is fixed, or if a chain of edges of non-zero weight ties it, by
// way of other free vertices, to a vertex that is fixed or has a target. If not, its
// component could be anywhere, and the system is singular: then it is the smallest vertex of that
// component.
inline Array<int> find_unconstrained_components(const Laplacian& laplacian,
                                                const Constraints& constraints)
{
  // union-find, with one more element for all that is fixed; the smallest vertex of each set is its
  // root, but for that one
  const int n = laplacian.size(), fixed = n;
  Array<int> parent(n + 1);
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&parent](int v) {
    while(parent[v] != v)
      v = parent[v] = parent[parent[v]];
    return v;
  };
  const auto tie = [&](int i, int j) {
    const int a = find(i), b = find(j);
    const int root = (std::max)(a, b) == fixed ? fixed : (std::min)(a, b);
    parent[a] = parent[b] = root;
  };
  for(int v = 0; v < n; ++v)
    if(constraints.is_fixed[v] || laplacian.is_tied[v])
      parent[v] = fixed;
  for(int v = 0; v < n; ++v)
    for(Sparse_matrix::InnerIterator entry(laplacian.matrix, v); entry; ++entry)
      if(entry.value() != 0 && entry.row() != v)
        tie(static_cast<int>(entry.row()), v);
  for(const Weighted_rows* rows : {&constraints.rows, &constraints.hard_rows})
    rows->for_each_row([&](auto begin, auto end, double sum, double weight) {
      for(auto v = begin; v != end && weight != 0; ++v)
        tie(*v, sum != 0 ? fixed : *begin); // a row that adds up to zero only ties its vertices
    });
  for(int v = 0; v < n; ++v)
    parent[v] = find(v);
  parent.pop_back();
  std::replace(parent.begin(), parent.end(), fixed, -1);
  return parent;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_UNCONSTRAINED_COMPONENTS_H
