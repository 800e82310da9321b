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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_ORTHOGONALIZED_ROWS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_ORTHOGONALIZED_ROWS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <Eigen/SparseCore>

#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Rows with the same solutions as some others, restricted to free vertices, any two of which are
// nearly orthogonal: from each row its parts along those before it are taken away, by the modified
// Gram-Schmidt process, unless they are small; what is left is scaled to length 1. Of rows that are
// nearly dependent a factor in single precision would see nothing but rounding errors.
class Orthogonalized_rows
{
public:
  Orthogonalized_rows() = default;

  Orthogonalized_rows(const Weighted_rows& rows, const Array<char>& is_fixed)
  {
    std::vector<Row> all;
    std::map<int, std::vector<int>> rows_at; // for each vertex
    for(int r = 0; r < rows.size(); ++r)
    {
      double square = 0;
      rows.for_each_coefficient(r, [&](int, double b) { square += b * b; });
      m_scale.push_back(1 / std::sqrt(square));
      Row row;
      rows.for_each_coefficient(r, [&](int v, double b) {
        if(!is_fixed[v])
          row[v] = b * m_scale.back();
      });
      m_length.push_back(take_away_others(r, all, rows_at, row));
      for(auto& [v, b] : row)
      {
        b *= reciprocal(m_length.back());
        rows_at[v].push_back(r);
      }
      all.push_back(std::move(row));
    }
    Array<Eigen::Triplet<double, int>> entries;
    for(int r = 0; r < rows.size(); ++r)
      for(const auto& [v, b] : all[static_cast<std::size_t>(r)])
        entries.emplace_back(v, r, b);
    m_columns.resize(static_cast<int>(is_fixed.size()), rows.size());
    m_columns.setFromTriplets(entries.begin(), entries.end());
  }

  // these rows B, as columns: B^T
  const Sparse_matrix& columns() const { return m_columns; }

  // What was left of a row of length 1 for all vertices, fixed ones too.
  double length(int r) const { return m_length[r]; }

  // the values of these rows where the given ones have such values; zero if there are none
  Array<Coordinates> values(const Array<Coordinates>& given) const
  {
    Array<Coordinates> result(m_scale.size(), Coordinates{0, 0, 0});
    auto step = m_steps.begin();
    for(std::size_t r = 0; r < given.size(); ++r)
    {
      result[r] = scaled(given[r], m_scale[r]);
      for(; step != m_steps.end() && step->row == static_cast<int>(r); ++step)
        add(result[r], -step->part, result[step->other]);
      result[r] = scaled(result[r], reciprocal(m_length[r]));
    }
    return result;
  }

private:
  using Row = std::map<int, double>; // the coefficients of vertices

  // A part that was taken away.
  struct Step
  {
    int row, other;
    double part;
  };

  static double reciprocal(double length) { return length > 0 ? 1 / length : 0; }

  static double length_of(const Row& row)
  {
    double square = 0;
    for(const auto& entry : row)
      square += entry.second * entry.second;
    return std::sqrt(square);
  }

  // returns the length of what is left
  double take_away_others(int r, const std::vector<Row>& all,
                          const std::map<int, std::vector<int>>& rows_at, Row& row)
  {
    constexpr double largest_cosine = 0.1, negligible = 1e-8;
    double length = length_of(row);
    for(bool is_changed = true; is_changed && length > negligible; length = length_of(row))
    {
      is_changed = false;
      std::set<int> others;
      for(const auto& entry : row)
        if(const auto found = rows_at.find(entry.first); found != rows_at.end())
          others.insert(found->second.begin(), found->second.end());
      for(int k : others)
      {
        const Row& other = all[static_cast<std::size_t>(k)];
        double part = 0;
        for(const auto& [v, b] : other)
          if(const auto found = row.find(v); found != row.end())
            part += b * found->second;
        if(!(std::abs(part) > largest_cosine * length))
          continue;
        for(const auto& [v, b] : other)
          row[v] -= part * b;
        m_steps.push_back({r, k, part});
        is_changed = true;
      }
    }
    return length;
  }

  Array<double> m_scale, m_length; // of each row
  std::vector<Step> m_steps;       // row after row
  Sparse_matrix m_columns;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_ORTHOGONALIZED_ROWS_H
