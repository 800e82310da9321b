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
#include <CGAL/ARAP_deformation/internal/is_finite.h>
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

// Rows of length 1 with the same solutions as some others, for their free vertices. Of two points
// that are close to each other, a factor in single precision sees no difference but rounding
// errors. So where a row has a large cosine with an earlier one, its part along that one is taken
// away, by modified Gram-Schmidt; elsewhere that would only fill the rows. Three or more rows may
// still be nearly dependent.
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
      m_scale.push_back(reciprocal(rows.row(r).length));
      Row row;
      rows.row(r).for_each_coefficient([&](int v, double b) {
        if(!is_fixed[v])
          row[v] = b * m_scale.back();
      });
      m_length.push_back(take_away_others(r, all, rows_at, row));
      if(!is_finite(m_length.back()) || !(m_length.back() > smallest_sine))
        break;
      for(auto& [v, b] : row)
      {
        b *= reciprocal(m_length.back());
        rows_at[v].push_back(r);
      }
      all.push_back(std::move(row));
    }
    m_scale.resize(static_cast<std::size_t>(rows.size()), 0);
    m_length.resize(static_cast<std::size_t>(rows.size()), 0);
    Array<Eigen::Triplet<double, int>> entries;
    for(std::size_t r = 0; r < all.size(); ++r)
      for(const auto& [v, b] : all[r])
        entries.emplace_back(v, static_cast<int>(r), b);
    m_columns.resize(static_cast<int>(is_fixed.size()), rows.size());
    m_columns.setFromTriplets(entries.begin(), entries.end());
  }

  // these rows B, as columns: B^T; zero from the first on that depends on others
  const Sparse_matrix& columns() const { return m_columns; }

  // what was left of a row of length 1, counting its fixed vertices and others that cannot move
  double length(int r) const { return m_length[r]; }

  // the values of these rows where the given ones have such values; zero if there are none
  Array<Coordinates> values(const Array<Coordinates>& given) const
  {
    Array<Coordinates> result(m_scale.size(), Coordinates{0, 0, 0});
    auto part = m_parts.begin();
    for(std::size_t r = 0; r < given.size(); ++r)
    {
      result[r] = scaled(given[r], m_scale[r]);
      for(; part != m_parts.end() && part->row == static_cast<int>(r); ++part)
        add(result[r], -part->factor, result[part->other]);
      result[r] = scaled(result[r], reciprocal(m_length[r]));
    }
    return result;
  }

private:
  using Row = std::map<int, double>; // the coefficients of vertices

  // what was taken away from a row
  struct Part
  {
    int row, other;
    double factor;
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
    constexpr double largest_cosine = 0.9, negligible = 0.01 * smallest_sine;
    double length = length_of(row); // each change makes it smaller by a factor
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
        m_parts.push_back({r, k, part});
        is_changed = true;
      }
    }
    return length;
  }

  Array<double> m_scale, m_length; // of each row
  std::vector<Part> m_parts;       // row after row
  Sparse_matrix m_columns;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_ORTHOGONALIZED_ROWS_H
