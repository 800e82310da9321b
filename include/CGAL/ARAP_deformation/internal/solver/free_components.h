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

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The components of the free vertices: edges of non-zero weight connect them, and rows those that
// are tied.
struct Free_components
{
  Array<int> component; // for each movable vertex the smallest of its component, -1 if fixed
  Array<char> is_tied;  // for these: whether the component is tied to fixed vertices or targets

  // What is not tied could be anywhere, and the system is singular.
  bool is_unconstrained(int v) const { return component[v] >= 0 && !is_tied[component[v]]; }
};

// For some components the sums of the coefficients that a row has in them.
using Row_sums = std::map<int, double>;

// Ties the components that are determined by these rows, all that couple them: by Gauss-Jordan
// elimination with complete pivoting, of which Eigen's form costs each program seconds to compile.
inline void tie_coupled(const std::vector<const Row_sums*>& rows, Array<char>& is_tied)
{
  std::map<int, int> columns;
  for(const Row_sums* row : rows)
    for(const auto& entry : *row)
      columns.emplace(entry.first, static_cast<int>(columns.size()));
  using Row_major = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Row_major matrix = Row_major::Zero(static_cast<int>(rows.size()),
                                     static_cast<int>(columns.size()));
  for(std::size_t r = 0; r < rows.size(); ++r)
    for(const auto& [component, sum] : *rows[r])
      matrix(static_cast<int>(r), columns[component]) = sum;
  for(Eigen::Index r = 0; r < matrix.rows(); ++r)
    matrix.row(r).normalize();
  for(Eigen::Index c = 0; c < matrix.cols(); ++c)
    matrix.col(c).normalize();
  Array<Eigen::Index> row_of(columns.size(), -1); // of each pivot
  for(Eigen::Index rank = 0; rank < matrix.rows(); ++rank)
  {
    Eigen::Index r = 0, c = 0;
    const double largest = matrix.bottomRows(matrix.rows() - rank).cwiseAbs().maxCoeff(&r, &c);
    if(!(largest > smallest_sine))
      break;
    matrix.row(rank).swap(matrix.row(rank + r));
    matrix.row(rank) /= double(matrix(rank, c));
    for(Eigen::Index other = 0; other < matrix.rows(); ++other)
      if(const double factor = matrix(other, c); other != rank && factor != 0)
        matrix.row(other) -= factor * matrix.row(rank);
    row_of[static_cast<std::size_t>(c)] = rank;
  }
  // a pivot moves as its row says if others move, which are no pivots
  for(const auto& [component, k] : columns)
    if(const Eigen::Index r = row_of[static_cast<std::size_t>(k)]; r >= 0)
    {
      matrix(r, k) = 0;
      is_tied[component] = matrix.row(r).norm() <= smallest_sine;
    }
}

// Ties components that no edge ties, but rows: no translation of them leaves the rows their values.
// These depend on sums of coefficients only.
inline void tie_by_rows(const Constraints& constraints, Disjoint_sets& components,
                        Array<char>& is_tied)
{
  // those of components that are not tied yet, without sums that are next to nothing beside the
  // length of the row: what it would do with them is to throw the component far away
  const auto loose_sums = [&](const Weighted_rows::Row& row) {
    Row_sums sums;
    row.for_each_coefficient([&](int v, double b) {
      if(const int k = components.find(v); !constraints.is_fixed[v] && !is_tied[k])
        sums[k] += b;
    });
    for(auto entry = sums.begin(); entry != sums.end();)
      if(std::abs(entry->second) > smallest_sine * row.length)
        ++entry;
      else
        entry = sums.erase(entry);
    return sums;
  };
  std::vector<Row_sums> rows; // at last those that couple several components
  for(bool is_changed = true; is_changed;)
  {
    is_changed = false;
    rows.clear();
    constraints.for_each_row([&](const Weighted_rows::Row& row) {
      Row_sums sums = loose_sums(row);
      if(sums.size() == 1)
        is_tied[sums.begin()->first] = is_changed = true;
      else if(!sums.empty())
        rows.push_back(std::move(sums));
    });
  }

  Disjoint_sets groups = components;
  for(const Row_sums& row : rows)
    for(const auto& entry : row)
      groups.unite(row.begin()->first, entry.first);
  std::map<int, std::vector<const Row_sums*>> rows_of; // for each group
  for(const Row_sums& row : rows)
    rows_of[groups.find(row.begin()->first)].push_back(&row);
  for(const auto& group : rows_of)
    tie_coupled(group.second, is_tied);
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
  constraints.for_each_row([&](const Weighted_rows::Row& row) { // unites those that are tied
    int first = -1;
    for(int v : row)
      if(!is_fixed[v] && is_tied[sets.find(v)])
      {
        first = first < 0 ? v : first;
        sets.unite(first, v);
      }
  });
  for(int v = 0; v < n; ++v)
    result.component[v] = is_fixed[v] ? -1 : sets.find(v);
  return result;
}

// An unconstrained vertex of a hard row that has no free vertex once these are fixed, or -1.
inline int find_lost_row(const Weighted_rows& hard_rows, const Array<char>& is_fixed,
                         const Free_components& components)
{
  int result = -1;
  hard_rows.for_each_row([&](const Weighted_rows::Row& row) {
    if(std::all_of(row.begin(), row.end(), [&](int v) { return is_fixed[v]; }))
      for(int v : row)
        if(result < 0 && components.is_unconstrained(v))
          result = v;
  });
  return result;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_FREE_COMPONENTS_H
