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

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/region/Disjoint_sets.h>
#include <CGAL/ARAP_deformation/internal/solver/Laplacian.h>

#include <Eigen/Core>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace CGAL {
namespace ARAP {
namespace internal {

// The free vertices that edges of non-zero weight and rows tie together.
struct Free_components
{
  Array<int> component; // for each movable vertex the smallest of its component, -1 if fixed
  Array<char> is_tied;  // for these: whether the component is tied to fixed vertices or targets

  // What is not tied could be anywhere, and the system is singular.
  bool is_unconstrained(int v) const { return component[v] >= 0 && !is_tied[component[v]]; }
};

// whether the columns are linearly independent
inline bool has_full_column_rank(Eigen::MatrixXd matrix)
{
  for(auto column : matrix.colwise())
    if(const double length = column.norm(); length > 0)
      column /= length;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(matrix);
  factors.setThreshold(1e-8);
  return factors.rank() == matrix.cols();
}

// Ties components that no edge ties, and unites those that rows connect: they are tied if only one
// translation of each gives the rows their values. These depend on the sum of the coefficients that
// a row has in a component, an entry of a matrix.
inline void tie_by_rows(const Constraints& constraints, Disjoint_sets& sets, Array<char>& is_tied)
{
  const int n = static_cast<int>(constraints.is_fixed.size());
  Array<int> smallest(n); // of the component, -1 where there is no need of rows
  for(int v = 0; v < n; ++v)
    smallest[v] = constraints.is_fixed[v] || is_tied[sets.find(v)] ? -1 : sets.find(v);
  Array<int> first;       // for each row the first vertex with such a component
  constraints.for_each_row([&](auto begin, auto end, auto) {
    const auto is_loose = [&](int v) { return smallest[v] >= 0; };
    const auto v = std::find_if(begin, end, is_loose);
    first.push_back(v == end ? -1 : *v);
    for(auto w = v; w != end; ++w)
      if(is_loose(*w))
        sets.unite(*v, *w);
  });

  Array<int> column(n), number_of_rows(n, 0), number_of_columns(n, 0); // the last two for each set
  for(int v = 0; v < n; ++v)
    if(smallest[v] == v)
      column[v] = number_of_columns[sets.find(v)]++;
  for(int v : first)
    if(v >= 0)
      ++number_of_rows[sets.find(v)];
  std::map<int, Eigen::MatrixXd> matrices; // for each set
  std::size_t r = 0;
  constraints.for_each_row([&](auto begin, auto end, auto coefficient) {
    const int v = first[r++];
    if(v < 0)
      return;
    const int set = sets.find(v);
    Eigen::MatrixXd& matrix = matrices[set];
    if(matrix.size() == 0)
      matrix.setZero(number_of_rows[set], number_of_columns[set]);
    auto row = matrix.row(--number_of_rows[set]);
    double size = 0;
    for(auto w = begin; w != end; ++w, ++coefficient)
    {
      size += std::abs(*coefficient);
      if(smallest[*w] >= 0)
        row[column[smallest[*w]]] += *coefficient;
    }
    for(double& sum : row)
      sum = std::abs(sum) > rounding_of_a_sum * size ? sum / size : 0;
  });
  for(const auto& [set, matrix] : matrices)
    is_tied[set] = has_full_column_rank(matrix);
}

inline Free_components find_free_components(const Laplacian& laplacian,
                                            const Constraints& constraints)
{
  const int n = laplacian.size();
  Free_components result{Array<int>(n), laplacian.is_tied};
  Array<char>& is_tied = result.is_tied;
  const auto& is_fixed = constraints.is_fixed;
  Disjoint_sets sets(n);
  for(int v = 0; v < n; ++v)
    for(Sparse_matrix::InnerIterator entry(laplacian.matrix, v); entry; ++entry)
      if(const int w = static_cast<int>(entry.row()); entry.value() != 0 && w != v)
      {
        if(!is_fixed[v] && !is_fixed[w])
          sets.unite(v, w);
        is_tied[v] |= is_fixed[w];
        is_tied[w] |= is_fixed[v];
      }
  for(int v = 0; v < n; ++v)
    is_tied[sets.find(v)] |= is_tied[v];
  tie_by_rows(constraints, sets, is_tied);
  constraints.for_each_row([&](auto begin, auto end, auto) { // those of components that are tied
    int first = -1;
    for(auto v = begin; v != end; ++v)
      if(!is_fixed[*v] && is_tied[sets.find(*v)])
      {
        first = first < 0 ? *v : first;
        sets.unite(first, *v);
      }
  });
  for(int v = 0; v < n; ++v)
    result.component[v] = is_fixed[v] ? -1 : sets.find(v);
  return result;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_FREE_COMPONENTS_H
