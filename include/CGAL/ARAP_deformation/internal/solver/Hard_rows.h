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
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_substitution.h>
#include <CGAL/ARAP_deformation/internal/cholesky/packed_values.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/region/Disjoint_sets.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/solver/Laplacian.h>
#include <CGAL/ARAP_deformation/internal/solver/Orthogonalized_rows.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numeric>

namespace CGAL {
namespace ARAP {
namespace internal {

// The hard rows of constraints for the free vertices, orthogonalized where two are nearly parallel.
// B is small and sparse; its Gram matrix B B^T is factorized.
class Hard_rows
{
public:
  // beyond it elimination takes too much memory
  static constexpr int most_rows = 3000;

  Hard_rows() = default;

  explicit Hard_rows(const Constraints& constraints)
    : m_rows(constraints.hard_rows), m_orthogonalized(m_rows, constraints.is_fixed)
  {
    if(!is_empty())
      m_gram = std::make_shared<Gram_factor>(gram_matrix());
  }

  bool is_empty() const { return m_rows.size() == 0; }
  int size() const { return m_rows.size(); }

  // The first row that is a linear combination of those before it and of fixed vertices, or -1.
  // What counts is the squared sine of its angle to their span; behind a small pivot, the rounding
  // errors of later ones too, of rows that common vertices connect. (A pivot that is zero, or none,
  // spoils only those of later rows.)
  int find_dependent() const
  {
    if(is_empty())
      return -1;
    Disjoint_sets connected(size());
    Array<int> first(static_cast<int>(columns().rows()), -1); // the row at each vertex
    for_each_entry([&](std::size_t v, std::size_t r, double) {
      if(first[v] < 0)
        first[v] = static_cast<int>(r);
      connected.unite(first[v], static_cast<int>(r));
    });
    const Array<double> pivots = m_gram->pivots();
    Array<double> smallest_pivots(size(), 1); // of connected rows
    for(int r = 0; r < size(); ++r)
    {
      const double length = m_orthogonalized.length(r), pivot = pivots[r];
      double& smallest = smallest_pivots[connected.find(r)];
      if(!is_finite(pivot) || !(length * length * pivot > smallest_sine * smallest_sine) ||
         !(pivot > rounding_of_a_sum / smallest))
        return r;
      smallest = (std::min)(smallest, pivot);
    }
    return -1;
  }

  // B^T
  const Sparse_matrix& columns() const { return m_orthogonalized.columns(); }

  // x := x + B^T z
  void add(const Array<Coordinates>& z, Array<Coordinates>& x) const
  {
    for_each_entry([&](std::size_t v, std::size_t r, double b) { internal::add(x[v], b, z[r]); });
  }

  // z - B x
  Array<Coordinates> residuals(Array<Coordinates> z,
                                     const Array<Coordinates>& x) const
  {
    for_each_entry([&](std::size_t v, std::size_t r, double b) { internal::add(z[r], -b, x[v]); });
    return z;
  }

  // moves x to the nearest solution of B x = z
  void project(const Array<Coordinates>& z, Array<Coordinates>& x) const
  {
    add(m_gram->solve(residuals(z, x)), x);
  }

  // Moves x, the positions of all vertices, to the nearest ones where the rows as they are given
  // have these values.
  void correct(const Array<Coordinates>& values, Array<Coordinates>& x) const
  {
    if(!is_empty())
      add(m_gram->solve(own_values(given_residuals(values, x))), x);
  }

  // leaves out of forces what no step that keeps the rows feels
  void leave_out_multipliers(Array<Coordinates>& force) const
  {
    if(!is_empty())
      project(own_values({}), force);
  }

  // the values of these rows where those that are given have such values; zero if there are none
  Array<Coordinates> own_values(const Array<Coordinates>& given) const
  {
    return m_orthogonalized.values(given);
  }

  // what the rows as they are given lack of values at x, the positions of all vertices
  Array<Coordinates> given_residuals(const Array<Coordinates>& values,
                                           const Array<Coordinates>& x) const
  {
    Array<Coordinates> result;
    for(std::size_t r = 0; r < values.size(); ++r)
      result.push_back(difference(values[r], m_rows.value(static_cast<int>(r), x.data())));
    return result;
  }

private:
  // The factor of a Gram matrix in the order of its rows, or in one with the same pivots.
  class Gram_factor
  {
  public:
    explicit Gram_factor(const Sparse_matrix& matrix) : m_cholesky(matrix, rows_of(matrix))
    {
      m_cholesky.factorize(matrix, m_values); // the pivots tell if it fails
    }

    Array<double> pivots() const
    {
      const Supernodal_structure& structure = m_cholesky.structure();
      Array<double> result(structure.order().size());
      for(const Supernodal_structure::Block& block : structure.blocks())
        for(int k = block.supernodes_begin; k < block.supernodes_end; ++k)
        {
          const Supernodal_structure::Supernode& s = structure.supernodes()[k];
          for(int j = 0; j < s.width; ++j)
          {
            const double reciprocal = reciprocal_of_diagonal(s, m_values.get(), j);
            result[structure.order()[block.columns + static_cast<std::size_t>(s.first + j)]] =
              1 / (reciprocal * reciprocal);
          }
        }
      return result;
    }

    Array<Coordinates> solve(Array<Coordinates> z)
    {
      m_substitution.forward(m_cholesky.structure(), m_values.get(), z.data());
      m_substitution.backward(m_cholesky.structure(), m_values.get(), z.data());
      return z;
    }

  private:
    static Array<int> rows_of(const Sparse_matrix& matrix)
    {
      Array<int> rows(static_cast<int>(matrix.cols()));
      std::iota(rows.begin(), rows.end(), 0);
      return rows;
    }

    Supernodal_cholesky m_cholesky;
    std::unique_ptr<double[]> m_values;
    Supernodal_substitution<double> m_substitution;
  };

  // calls f(v, r, b) for each entry b of B, row after row
  template <typename Function>
  void for_each_entry(const Function& f) const
  {
    for(int r = 0; r < size(); ++r)
      for(Sparse_matrix::InnerIterator entry(columns(), r); entry; ++entry)
        f(static_cast<std::size_t>(entry.row()), static_cast<std::size_t>(r), entry.value());
  }

  // the lower triangle of B B^T
  Sparse_matrix gram_matrix() const
  {
    Array<Eigen::Triplet<double, int>> products;
    for(int r = 0; r < size(); ++r)
      products.emplace_back(r, r, 0); // also where all vertices are fixed
    // the row of each entry, its predecessor at the same vertex, and the last entry of each vertex
    Array<int> rows, previous, last(static_cast<int>(columns().rows()), -1);
    for_each_entry([&](std::size_t v, std::size_t r, double b) {
      rows.push_back(static_cast<int>(r));
      previous.push_back(last[v]);
      last[v] = static_cast<int>(rows.size()) - 1;
      for(int k = last[v]; k >= 0; k = previous[k])
        products.emplace_back(static_cast<int>(r), rows[k], b * columns().valuePtr()[k]);
    });
    Sparse_matrix gram(size(), size());
    gram.setFromTriplets(products.begin(), products.end());
    return gram;
  }

  Weighted_rows m_rows; // as they are given
  Orthogonalized_rows m_orthogonalized;
  std::shared_ptr<Gram_factor> m_gram; // cannot be copied
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_HARD_ROWS_H
