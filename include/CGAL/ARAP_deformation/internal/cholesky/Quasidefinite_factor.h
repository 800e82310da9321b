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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_QUASIDEFINITE_FACTOR_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_QUASIDEFINITE_FACTOR_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_substitution.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodes.h>
#include <CGAL/ARAP_deformation/internal/cholesky/dense_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/packed_values.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The factorization of a dense symmetric matrix
//   [ -S   C ]   [ L     ] [ -I   ] [ L^T  X^T ]
//   [ C^T  R ] = [ X  L' ] [    I ] [      L'^T ]
// where S and R + C^T S^-1 C are positive definite. With the rows of S first it needs no pivoting.
class Quasidefinite_factor
{
public:
  // Factorizes an n x n matrix, of which the lower triangle is read; is_negative[i] is true for the
  // rows of S. Returns `false` if a pivot is not above that share of the scale of its row, or if
  // the scale is less than that share of the diagonal of R + C^T S^-1 C, where S is so small that R
  // is lost in the rounding errors.
  bool factorize(int n, const Array<double>& matrix, const Array<char>& is_negative,
                 const Array<double>& scales, double smallest_share)
  {
    Array<int> order;
    for(char sign : {1, 0})
      for(int i = 0; i < n; ++i)
        if(is_negative[i] == sign)
          order.push_back(i);
    const int negative = static_cast<int>(std::count(is_negative.begin(), is_negative.end(), 1));
    const auto entry = [&](int i, int j) {
      return matrix[static_cast<std::size_t>((std::min)(i, j)) * static_cast<std::size_t>(n)
                    + static_cast<std::size_t>((std::max)(i, j))];
    };
    m_structure = Supernodal_structure(dense_supernodes(negative, n), order);
    m_negative = negative;

    // both panels with the opposite sign
    const int positive = n - negative;
    const std::ptrdiff_t height = n, below = positive;
    Array<double> panels(static_cast<std::size_t>(height * negative + below * below), 0);
    double* const first = panels.data();
    double* const second = first + height * negative;
    for(int j = 0; j < negative; ++j)
      for(int i = j; i < n; ++i)
        first[j * height + i] = -entry(order[i], order[j]);
    for(int j = 0; j < positive; ++j)
      for(int i = j; i < positive; ++i)
        second[j * below + i] = -entry(order[negative + i], order[negative + j]);
    factor_panel(first, negative, n);
    subtract_square(second, below, positive, 0, positive, first + negative, negative, height);
    std::transform(second, second + below * below, second, [](double value) { return -value; });
    for(int j = 0; j < positive; ++j)
      if(smallest_share * second[j * (below + 1)] > scales[order[negative + j]])
        return false;
    factor_panel(second, positive, positive);

    const auto is_safe = [&](int i, double reciprocal) {
      const double pivot = 1 / (reciprocal * reciprocal);
      return is_finite(pivot) && pivot > smallest_share * scales[order[i]];
    };
    for(int j = 0; j < n; ++j)
      if(!is_safe(j, j < negative ? first[j * (height + 1)]
                                  : second[(j - negative) * (below + 1)]))
        return false;
    m_values.resize(m_structure.values_size());
    const double* columns = first;
    for(int number : m_structure.numbers())
    {
      const Supernodal_structure::Supernode& s = m_structure.supernodes()[number];
      pack_values(s, columns, m_values.data());
      columns += size_of_columns(s);
    }
    return true;
  }

  // replaces the rows of x, as many as the matrix has, at least one, by the solution
  void solve(Coordinates* x)
  {
    m_substitution.forward(m_structure, m_values.data(), x);
    const int s = m_structure.numbers()[0];
    double* const row = m_substitution.local_vector(m_structure.blocks()[m_structure.block_of(s)])
                      + 4 * m_structure.supernodes()[s].first;
    std::transform(row, row + 4 * m_negative, row, [](double value) { return -value; });
    m_substitution.backward(m_structure, m_values.data(), x);
  }

private:
  // the rows of S, and the others
  static Supernodes dense_supernodes(int negative, int n)
  {
    Supernodes result = {{0}, {0}, {}};
    for(int end : {negative, n})
      if(end > result.columns.back())
      {
        for(int i = end; i < n; ++i)
          result.rows.push_back(i);
        result.columns.push_back(end);
        result.rows_begin.push_back(result.rows.size());
      }
    return result;
  }

  Supernodal_structure m_structure;
  Array<double> m_values;
  Supernodal_substitution<double> m_substitution;
  int m_negative = 0;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_QUASIDEFINITE_FACTOR_H
