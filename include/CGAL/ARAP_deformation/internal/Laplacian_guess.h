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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_LAPLACIAN_GUESS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_LAPLACIAN_GUESS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>

#include <Eigen/SparseCore>

#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Naive Laplacian editing (Section 4 of the paper): the positions x of the free vertices that
// minimize || L x - L p ||^2, where row i of L is the sum of w_ij (x_i - x_j) over the star of i,
// and p is the rest shape. The rows are those of the free vertices and their neighbours; all others
// are constant.
template <typename Solver>
class Laplacian_guess
{
public:
  // The first vertices are free; `rest` has the positions of all.
  Laplacian_guess(Stars stars, const std::vector<Coordinates>& rest, int number_of_free_vertices,
                  Solver solver)
    : m_stars(std::move(stars)), m_rest_laplacian(laplacian(rest)),
      m_step(number_of_free_vertices), m_solver(std::move(solver))
  {
    std::vector<Eigen::Triplet<double, int>> entries;
    m_stars.for_each_edge([&](int i, int j, double w) {
      if(i < number_of_free_vertices) entries.emplace_back(i, i, w);
      if(j < number_of_free_vertices) entries.emplace_back(i, j, -w);
    });
    Sparse_matrix columns(m_stars.size(), number_of_free_vertices); // of L, of the free vertices
    columns.setFromTriplets(entries.begin(), entries.end());
    const Sparse_matrix normal =
      (Sparse_matrix(columns.transpose()) * columns).template triangularView<Eigen::Lower>();
    m_is_factorized = m_solver.analyze(normal) && m_solver.factorize(normal);
  }

  bool is_factorized() const { return m_is_factorized; }

  // Moves the free vertices of x. Returns false if the solver failed.
  bool operator()(std::vector<Coordinates>& x)
  {
    // The condition number of L^T L is the square of that of L: further passes refine the first
    // one, until they move nothing any more, or gain nothing.
    double first = 0, last = 0;
    for(int pass = 0; pass < 8; ++pass)
    {
      compute_right_hand_side(x);
      if(!m_solver.solve(m_step.size(), m_step.data()))
        return false;
      double size = 0;
      for(std::size_t v = 0; v < m_step.size(); ++v)
      {
        add(x[v], 1, m_step[v]);
        size += dot(m_step[v], m_step[v]);
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
      if(is_free(i)) add(m_step[i], w, residual);
      if(is_free(j)) add(m_step[j], -w, residual);
    });
  }

  bool is_free(int v) const { return static_cast<std::size_t>(v) < m_step.size(); }

  Stars m_stars;
  std::vector<Coordinates> m_rest_laplacian; // L p, for each star
  std::vector<Coordinates> m_step; // of the free vertices
  Solver m_solver;
  bool m_is_factorized = false;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_LAPLACIAN_GUESS_H
