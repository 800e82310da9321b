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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_FREE_COMPONENTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_FREE_COMPONENTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/region/Disjoint_sets.h>
#include <CGAL/ARAP_deformation/internal/solver/Laplacian.h>

namespace CGAL {
namespace ARAP {
namespace internal {

// The free vertices that edges of non-zero weight and rows tie together.
struct Free_components
{
  Array<int> component; // for each movable vertex the smallest of its component, -1 if fixed
  Array<char> is_tied;  // for these: whether the component is tied to a fixed vertex or a target

  // What is not tied could be anywhere, and the system is singular.
  bool is_unconstrained(int v) const { return component[v] >= 0 && !is_tied[component[v]]; }
};

inline Free_components find_free_components(const Laplacian& laplacian,
                                            const Constraints& constraints)
{
  const int n = laplacian.size();
  Free_components result{Array<int>(n), laplacian.is_tied};
  Array<char>& is_tied = result.is_tied;
  const auto& is_fixed = constraints.is_fixed;
  Disjoint_sets sets(n);
  const auto tie = [&](int i, int j) {
    if(!is_fixed[i] && !is_fixed[j])
      sets.unite(i, j);
    is_tied[i] |= is_fixed[j];
    is_tied[j] |= is_fixed[i];
  };
  for(int v = 0; v < n; ++v)
    for(Sparse_matrix::InnerIterator entry(laplacian.matrix, v); entry; ++entry)
      if(entry.value() != 0 && entry.row() != v)
        tie(static_cast<int>(entry.row()), v);
  constraints.for_each_row([&](auto begin, auto end, double sum) {
    for(auto v = begin; v != end; ++v)
    {
      tie(*begin, *v);
      is_tied[*v] |= sum != 0; // a row that adds up to zero only ties its vertices
    }
  });
  for(int v = 0; v < n; ++v)
  {
    result.component[v] = is_fixed[v] ? -1 : sets.find(v);
    if(!is_fixed[v])
      is_tied[result.component[v]] |= is_tied[v];
  }
  return result;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_FREE_COMPONENTS_H
