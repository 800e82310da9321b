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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDERED_SUBSTITUTION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDERED_SUBSTITUTION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Border_columns.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Border_parts.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Quasidefinite_factor.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_substitution.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace CGAL {
namespace ARAP {
namespace internal {

// The factorization of D - W^T W. If the bordered matrix comes from a minimum, the block of the
// multipliers is negative semidefinite, and with them eliminated the rest is positive definite. A
// multiplier with next to nothing in B, but entries in D, is refused: it would have to come after
// the unknowns that it is for. Pivots are compared with the diagonal of D: what W subtracts may be
// all that D has.
inline bool factorize_remainder(const Dense_matrix& d, const Border_parts& w,
                                double smallest_pivot, Quasidefinite_factor& factor)
{
  const Array<int>& order = w.order();
  const Array<double> square = w.negative_square();
  const std::size_t n = order.size();
  Array<double> remainder(n * n), scales(n);
  Array<char> is_multiplier(n);
  for(std::size_t l = 0; l < n; ++l)
    for(std::size_t k = l; k < n; ++k)
    {
      const auto [column, row] = std::minmax(order[k], order[l]);
      remainder[static_cast<std::size_t>(column) * n + static_cast<std::size_t>(row)] =
        d(row, column) + square[l * w.size() + k];
    }
  for(std::size_t k = 0; k < n; ++k)
  {
    const double diagonal = d(static_cast<int>(k), static_cast<int>(k));
    is_multiplier[k] = diagonal <= 0;
    scales[k] = is_multiplier[k] ? std::abs(remainder[k * (n + 1)]) : diagonal;
  }
  return factor.factorize(static_cast<int>(n), remainder, is_multiplier, scales, smallest_pivot);
}

// Substitution with the factor of A, or with that of A with a border, [A B; B^T D]. With W = L^-1 P
// B, what is left for the unknowns of the border is the dense system of D - W^T W.
template <typename Number>
class Bordered_substitution
{
public:
  void remove_border()
  {
    m_border_size = 0;
    m_columns = Border_columns<Number>();
    m_remainder = Quasidefinite_factor();
  }

  // Returns `false`, and has no border, if the dense system is not safely solvable.
  bool set_border(const Supernodal_structure& structure, const Number* values,
                  const Sparse_matrix& b, const Dense_matrix& d)
  {
    bool is_solvable = false;
    try
    {
      if(b.cols() > 0)
      {
        m_columns.compute(structure, values, b);
        is_solvable = factorize_remainder(d, m_columns, smallest_pivot, m_remainder);
      }
    }
    catch(...)
    {
      remove_border();
      throw;
    }
    if(is_solvable)
      m_border_size = static_cast<std::size_t>(b.cols());
    else
      remove_border();
    return is_solvable || b.cols() == 0;
  }

  // Replaces the n rows of x, the last of which are those of the border, by the solution. The
  // right-hand side is divided by the scale meanwhile.
  void solve(const Supernodal_structure& structure, const Number* values, std::size_t n,
             Coordinates* x, double scale = 1)
  {
    m_substitution.forward(structure, values, x, 1 / scale);
    if(m_border_size > 0)
      solve_border(structure, x + (n - m_border_size), scale);
    m_substitution.backward(structure, values, x, scale);
  }

private:
  // Rounding errors of W, which are those of the factor, count as much more in the solution as the
  // pivots are smaller. Long before all digits are lost another factorization of A is better.
  static constexpr double smallest_pivot = std::is_same_v<Number, double> ? 1e-11 : 1e-4;

  // z := (D - W^T W)^-1 (g - W^T y), and y := y - W z in the local vectors
  void solve_border(const Supernodal_structure& structure, Coordinates* x, double scale)
  {
    const Array<int>& order = m_columns.order();
    m_products.assign(4 * m_columns.size(), 0);
    m_columns.multiply(structure, m_substitution, m_products.data());
    for(std::size_t k = 0; k < order.size(); ++k)
      for(std::size_t c = 0; c < 3; ++c)
        x[order[k]][c] = x[order[k]][c] / scale - m_products[4 * k + c];
    m_remainder.solve(x);
    for(std::size_t k = 0; k < order.size(); ++k)
      for(std::size_t c = 0; c < 3; ++c)
      {
        double& z = x[order[k]][c];
        m_products[4 * k + c] = z;
        z *= scale;
      }
    m_columns.subtract(structure, m_substitution, m_products.data());
  }

  Supernodal_substitution<Number> m_substitution;
  Border_columns<Number> m_columns;
  Quasidefinite_factor m_remainder;
  std::size_t m_border_size = 0;
  Array<double> m_products; // scratch
};

#ifdef CGAL_ARAP_DEFORMATION_COMPILED
extern template class Bordered_substitution<double>; // that of Cholmod_solver, too
#endif

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDERED_SUBSTITUTION_H
