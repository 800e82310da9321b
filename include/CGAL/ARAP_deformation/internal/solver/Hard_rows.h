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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_HARD_ROWS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_HARD_ROWS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The hard rows of constraints for the free vertices, each scaled to length 1 of the row for all
// vertices. B is small and sparse; its Gram matrix B B^T is factorized.
class Hard_rows
{
public:
  using Values = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

  // beyond it elimination takes too much memory
  static constexpr int most_rows = 3000;

  Hard_rows() = default;

  explicit Hard_rows(const Constraints& constraints) : m_rows(constraints.hard_rows)
  {
    if(is_empty())
      return;
    Array<Eigen::Triplet<double, int>> entries;
    for(int r = 0; r < size(); ++r)
    {
      double square = 0;
      m_rows.for_each_coefficient(r, [&](int, double b) { square += b * b; });
      m_scale.push_back(1 / std::sqrt(square));
      m_rows.for_each_coefficient(r, [&](int v, double b) {
        if(!constraints.is_fixed[v])
          entries.emplace_back(v, r, b * m_scale[r]);
      });
    }
    m_columns.resize(static_cast<int>(constraints.is_fixed.size()), size());
    m_columns.setFromTriplets(entries.begin(), entries.end());
    const Sparse_matrix gram = m_columns.transpose() * m_columns;
    m_gram = std::make_shared<Gram_factor>();
    m_gram->setShift(1e-2 * smallest_pivot); // so that no pivot is zero
    m_gram->compute(gram);
  }

  bool is_empty() const { return m_rows.size() == 0; }
  int size() const { return m_rows.size(); }

  // The first row that is a linear combination of those before it and of fixed vertices, or -1. Its
  // pivot is the squared sine of its angle to their span.
  int find_dependent() const
  {
    if(is_empty())
      return -1;
    if(m_gram->info() != Eigen::Success)
      return 0; // something is not finite
    const Eigen::VectorXd pivots = m_gram->vectorD();
    for(int r = 0; r < size(); ++r)
      if(!(pivots[r] > smallest_pivot))
        return r;
    return -1;
  }

  // B^T
  const Sparse_matrix& columns() const { return m_columns; }

  // B x
  Values values(const std::vector<Coordinates>& x) const
  {
    return m_columns.transpose() * Eigen::Map<const Values>(x.data()->data(), m_columns.rows(), 3);
  }

  // x := x + B^T z
  void add(const Values& z, std::vector<Coordinates>& x) const
  {
    for(int r = 0; r < size(); ++r)
      for(Sparse_matrix::InnerIterator entry(m_columns, r); entry; ++entry)
        for(int c = 0; c < 3; ++c)
          x[static_cast<std::size_t>(entry.row())][static_cast<std::size_t>(c)] +=
            entry.value() * z(r, c);
  }

  // moves x to the nearest solution of B x = z
  void project(const Values& z, std::vector<Coordinates>& x) const
  {
    add(m_gram->solve(z - values(x)), x);
  }

  // Moves x, the positions of all vertices, to the nearest ones where the rows as they are given
  // have these values.
  void correct(const std::vector<Coordinates>& values, std::vector<Coordinates>& x) const
  {
    if(!is_empty())
      add(m_gram->solve(scaled(residuals(values, x))), x);
  }

  // leaves out of forces what no step that keeps the rows feels
  void leave_out_multipliers(std::vector<Coordinates>& force) const
  {
    if(!is_empty())
      project(Values::Zero(size(), 3), force);
  }

  // The values of rows as they are given, scaled as the rows are here; zero if there are none.
  Values scaled(const std::vector<Coordinates>& values) const
  {
    Values result = Values::Zero(size(), 3);
    for(std::size_t r = 0; r < values.size(); ++r)
      for(std::size_t c = 0; c < 3; ++c)
        result(static_cast<int>(r), static_cast<int>(c)) = m_scale[r] * values[r][c];
    return result;
  }

  // what the rows as they are given lack of values at x, the positions of all vertices
  std::vector<Coordinates> residuals(const std::vector<Coordinates>& values,
                                     const std::vector<Coordinates>& x) const
  {
    std::vector<Coordinates> result;
    for(std::size_t r = 0; r < values.size(); ++r)
      result.push_back(difference(values[r], m_rows.value(static_cast<int>(r), x.data())));
    return result;
  }

private:
  static constexpr double smallest_pivot = 1e-12;
  using Gram_factor =
    Eigen::SimplicialLDLT<Sparse_matrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;

  Weighted_rows m_rows;   // as they are given
  Array<double> m_scale;  // of each row
  Sparse_matrix m_columns;
  std::shared_ptr<Gram_factor> m_gram; // cannot be copied
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_HARD_ROWS_H
