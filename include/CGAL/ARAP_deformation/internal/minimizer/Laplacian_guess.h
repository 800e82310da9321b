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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_LAPLACIAN_GUESS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_LAPLACIAN_GUESS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/solver/Laplacian.h>
#include <CGAL/ARAP_deformation/internal/solver/Linear_solver.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Naive Laplacian editing (Section 4 of the paper): the positions x of the free vertices that
// minimize || L x - L p ||^2, where row i of L is the sum of w_ij (x_i - x_j) over the star of i,
// and p is the rest shape. The rows are those of the free vertices and their neighbours; all others
// are constant. Vertices that are pulled to targets are put there; other rows are not considered.
class Laplacian_guess
{
public:
  Laplacian_guess(const Stars& stars, const Region& region, const Constraints& constraints,
                  std::unique_ptr<Linear_solver> solver)
    : m_stars(stars), m_rest_laplacian(laplacian(region.rest)),
      m_row(region.number_of_vertices(), none), m_solver(std::move(solver))
  {
    for(int v = 0; v < region.number_of_movable_vertices; ++v)
      if(!constraints.is_fixed[v])
        m_row[v] = 0;
    for(int r = 0; r < constraints.rows.size(); ++r)
      if(const int v = constraints.rows.position(r); v >= 0 && m_row[v] == 0)
      {
        m_soft_positions.push_back({v, r});
        m_row[v] = none;
      }
    int number_of_rows = 0;
    for(int& row : m_row)
      if(row != none)
        row = number_of_rows++;
    m_step.resize(number_of_rows);

    std::vector<Eigen::Triplet<double, int>> entries;
    m_stars.for_each_edge([&](int i, int j, double w) {
      if(is_free(i)) entries.emplace_back(i, m_row[i], w);
      if(is_free(j)) entries.emplace_back(i, m_row[j], -w);
    });
    Sparse_matrix columns(m_stars.size(), number_of_rows); // of L, of the free vertices
    columns.setFromTriplets(entries.begin(), entries.end());
    Sparse_matrix normal =
      (Sparse_matrix(columns.transpose()) * columns).triangularView<Eigen::Lower>();
    raise_diagonal(normal);
    bound_steps(normal);
    m_is_factorized =
      number_of_rows == 0 || (m_solver->analyze(normal) && m_solver->factorize(normal));
  }

  bool is_factorized() const { return m_is_factorized; }

  // Moves the free vertices of x; there is a target for each row of the constraints. Returns false
  // if the solver failed.
  bool operator()(const std::vector<Coordinates>& targets, std::vector<Coordinates>& x)
  {
    for(const auto& [v, row] : m_soft_positions)
      x[v] = targets[row];
    if(m_step.empty())
      return true;
    // The condition number of L^T L is the square of that of L: further passes refine the first
    // one, until they move nothing any more, or gain nothing.
    double first = 0, last = 0;
    for(int pass = 0; pass < 8; ++pass)
    {
      compute_right_hand_side(x);
      if(!m_solver->solve(m_step.size(), m_step.data()))
        return false;
      double size = 0;
      for(std::size_t v = 0; v < m_row.size(); ++v)
        if(is_free(v))
        {
          const Coordinates& step = m_step[m_row[v]];
          add(x[v], 1, step);
          size += dot(step, step);
        }
      if(pass == 0)
        first = size;
      else if(size <= 1e-20 * first || (pass > 1 && size > 0.25 * last))
        break;
      last = size;
    }
    return true;
  }

private:
  // Where an equation with large weights has a small one, its rounding error may be anything
  // compared to that: the vertex of the small weight must not be flung away to make up for it.
  void bound_steps(Sparse_matrix& normal) const
  {
    std::vector<double> sums(m_stars.size(), 0); // of the weights of each equation
    m_stars.for_each_edge([&](int i, int, double w) { sums[i] += std::abs(w); });
    m_stars.for_each_edge([&](int i, int j, double) {
      const double error = rounding_of_a_sum * sums[i];
      for(int v : {i, j})
        if(is_free(v))
          diagonal_entry(normal, m_row[v]) += error * error;
    });
  }

  // L x
  std::vector<Coordinates> laplacian(const std::vector<Coordinates>& x) const
  {
    std::vector<Coordinates> result(m_stars.size(), Coordinates{0, 0, 0});
    m_stars.for_each_edge([&](int i, int j, double w) {
      add(result[i], w, difference(x[i], x[j]));
    });
    return result;
  }

  // L^T (L p - L x)
  void compute_right_hand_side(const std::vector<Coordinates>& x)
  {
    const std::vector<Coordinates> present = laplacian(x);
    m_step.assign(m_step.size(), Coordinates{0, 0, 0});
    m_stars.for_each_edge([&](int i, int j, double w) {
      const Coordinates residual = difference(m_rest_laplacian[i], present[i]);
      if(is_free(i)) add(m_step[m_row[i]], w, residual);
      if(is_free(j)) add(m_step[m_row[j]], -w, residual);
    });
  }

  bool is_free(std::size_t v) const { return m_row[v] != none; }

  static constexpr int none = -1;

  const Stars& m_stars;
  std::vector<Coordinates> m_rest_laplacian; // L p, for each star
  std::vector<std::pair<int, int>> m_soft_positions; // vertices and the rows that pull them
  std::vector<int> m_row;          // for each vertex its row in the system, if it has one
  std::vector<Coordinates> m_step; // for each row
  std::unique_ptr<Linear_solver> m_solver;
  bool m_is_factorized = false;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_LAPLACIAN_GUESS_H
