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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CONSTRAINTS_CONSTRAINTS_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CONSTRAINTS_CONSTRAINTS_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
void Weighted_rows::append(int vertex, double weight)
{
  const double one = 1;
  append({&vertex, &vertex + 1, &one, 1}, weight);
}

CGAL_ARAP_INLINE_FUNCTION
void Weighted_rows::append(const Array<int>& vertices, const Array<double>& coefficients,
                           double weight, double squares_elsewhere)
{
  append({vertices.data(), vertices.data() + vertices.size(), coefficients.data(),
          std::sqrt(std::inner_product(coefficients.begin(), coefficients.end(),
                                       coefficients.begin(), squares_elsewhere))}, weight);
}

CGAL_ARAP_INLINE_FUNCTION
void Weighted_rows::append(const Row& row, double weight)
{
  const std::ptrdiff_t n = row.end() - row.begin();
  m_vertices.items.insert(m_vertices.items.end(), row.begin(), row.end());
  m_vertices.end_list();
  m_coefficients.insert(m_coefficients.end(), row.coefficients, row.coefficients + n);
  m_weights.push_back(weight);
  m_lengths.push_back(row.length);
  m_is_diagonal &= n <= 1;
}

CGAL_ARAP_INLINE_FUNCTION
void Weighted_rows::clear_weights_of_fixed(const Array<char>& is_fixed)
{
  for(int r = 0; r < size(); ++r)
    if(const Row vertices = row(r);
       std::all_of(vertices.begin(), vertices.end(), [&](int v) { return is_fixed[v] != 0; }))
      m_weights[r] = 0;
}

CGAL_ARAP_INLINE_FUNCTION
double Weighted_rows::pull(const Array<Coordinates>& targets,
                           const Array<Coordinates>& x,
                           Array<Coordinates>& force) const
{
  const Coordinates* const positions = x.data();
  Coordinates* const forces = force.data();
  Array<Coordinates> pulls(m_weights.size());
  const double energy = sum_over_blocks(pulls.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for(std::size_t r = begin; r < end; ++r)
    {
      const Coordinates residual =
        difference(targets[r], value(static_cast<int>(r), positions));
      pulls[r] = scaled(residual, m_weights[r]);
      sum += dot(pulls[r], residual);
    }
    return sum;
  });
  for(int r = 0; r < size(); ++r) // one after the other: rows may share vertices
    row(r).for_each_coefficient([&](int v, double b) { add(forces[v], b, pulls[r]); });
  return energy;
}

CGAL_ARAP_INLINE_FUNCTION
Array<Coordinates> Weighted_rows::places(const Array<Coordinates>& targets,
                                         const Array<Coordinates>& x) const
{
  Array<Coordinates> result;
  for(int r = 0; r < size(); ++r)
    if(m_weights[r] == 0)
      continue;
    else if(position(r) >= 0)
      result.push_back(targets[r]);
    else if(const Row vertices = row(r); vertices.begin() != vertices.end())
    {
      result.push_back(x[*vertices.begin()]);
      add(result.back(), 1, difference(targets[r], value(r, x.data())));
    }
  return result;
}

CGAL_ARAP_INLINE_FUNCTION
Array<int> Weighted_rows::order() const
{
  Array<int> rows(m_weights.size());
  std::iota(rows.begin(), rows.end(), 0);
  std::sort(rows.begin(), rows.end(),
            [this](int r, int s) { return is_less(*this, r, *this, s); });
  return rows;
}

CGAL_ARAP_INLINE_FUNCTION
bool Weighted_rows::is_less(const Weighted_rows& a, int r, const Weighted_rows& b, int s)
{
  const int a_begin = a.m_vertices.begin[r], a_end = a.m_vertices.begin[r + 1];
  const int b_begin = b.m_vertices.begin[s], b_end = b.m_vertices.begin[s + 1];
  if(a_end - a_begin != b_end - b_begin)
    return a_end - a_begin < b_end - b_begin;
  for(int k = a_begin, l = b_begin; k < a_end; ++k, ++l)
  {
    const auto left = std::tie(a.m_vertices.items[k], a.m_coefficients[k]);
    const auto right = std::tie(b.m_vertices.items[l], b.m_coefficients[l]);
    if(left != right)
      return left < right;
  }
  return a.m_weights[r] < b.m_weights[s];
}

CGAL_ARAP_INLINE_FUNCTION
std::size_t Constraints::number_of_free_vertices() const
{
  return static_cast<std::size_t>(std::count(is_fixed.begin(), is_fixed.end(), 0));
}

CGAL_ARAP_INLINE_FUNCTION
void Targets::project(const Weighted_rows& rows, const Array<Coordinates>& x)
{
  for(const Set& set : sets)
    soft[set.row] = set.projection(rows.value(set.row, x.data()));
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CONSTRAINTS_CONSTRAINTS_IMPL_H
