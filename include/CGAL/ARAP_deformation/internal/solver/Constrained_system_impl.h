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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_CONSTRAINED_SYSTEM_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_CONSTRAINED_SYSTEM_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
Sparse_matrix Constrained_system::with_rows(const Weighted_rows& rows) const
{
  Sparse_matrix matrix = m_laplacian.matrix;
  if(rows.is_diagonal())
    rows.for_each_entry([&](int v, int, double entry) { diagonal_entry(matrix, v) += entry; });
  else
  {
    Array<Eigen::Triplet<double, int>> entries;
    rows.for_each_entry([&](int i, int j, double entry) { entries.emplace_back(i, j, entry); });
    Sparse_matrix sum(matrix.rows(), matrix.cols());
    sum.setFromTriplets(entries.begin(), entries.end());
    matrix += sum; // the pattern stays, if the vertices of each row are those of a simplex
  }
  return matrix;
}

CGAL_ARAP_INLINE_FUNCTION
int Constrained_system::find_singular_vertex(const Constraints& constraints) const
{
  const int n = m_laplacian.size();
  Array<double> diagonal(n);
  for(int v = 0; v < n; ++v)
    diagonal[v] = diagonal_entry(m_laplacian.matrix, v);
  constraints.rows.for_each_entry([&](int i, int j, double entry) {
    if(i == j) diagonal[i] += entry;
  });
  for(int v = 0; v < n; ++v)
    if(!constraints.is_fixed[v] && (!(diagonal[v] > 0) || !std::isfinite(diagonal[v])))
      return v;
  return -1;
}

CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::prepare(const Constraints& constraints, Work& work)
{
  work = Work();
  if(constraints.number_of_free_vertices() == 0)
    return true;
  if(m_has_factor && m_prototype->can_have_border() && set_border(constraints))
  {
    work.border = !m_further_unknowns.empty() || !m_multipliers.empty();
    return true;
  }
  return factorize(constraints, work);
}

CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::factorize(const Constraints& constraints, Work& work)
{
  Sparse_matrix matrix = with_rows(constraints.rows);
  const auto& is_fixed = constraints.is_fixed;
  for(int v = 0; v < matrix.cols(); ++v)
  {
    double& diagonal = diagonal_entry(matrix, v);
    if(is_fixed[v] && (!(diagonal > 0) || !std::isfinite(diagonal)))
      diagonal = 1;
    for(Sparse_matrix::InnerIterator entry(matrix, v); entry; ++entry)
      if(entry.row() != v && (is_fixed[v] || is_fixed[entry.row()]))
        entry.valueRef() = 0;
  }
  for(int v = 0; v < matrix.cols(); ++v)
    diagonal_entry(matrix, v) *= diagonal_factor(m_laplacian);

  m_further_unknowns.clear();
  m_multipliers.clear();
  // no factor where something fails, and never two
  std::unique_ptr<Linear_solver> solver = std::move(m_solver);
  m_has_factor = false;
  const bool is_analyzed = solver && matrix.nonZeros() == m_analyzed_nonzeros &&
                           matrix.nonZeros() == m_laplacian.matrix.nonZeros();
  if(!is_analyzed)
  {
    solver.reset();
    solver = m_prototype->copy();
    work.order = true;
    m_analyzed_nonzeros = matrix.nonZeros();
  }
  work.factor = true;
  if(!(is_analyzed || solver->analyze(matrix)) || !solver->factorize(matrix))
    return false;
  m_factorized = constraints;
  m_solver = std::move(solver);
  m_has_factor = true;
  return true;
}

CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::set_border(const Constraints& constraints)
{
  constexpr std::size_t largest_border = 256; // beyond it a factorization costs less
  const int n = m_laplacian.size();
  Array<char> is_kept(n);
  for(int v = 0; v < n; ++v)
    is_kept[v] = !constraints.is_fixed[v] && !m_factorized.is_fixed[v];
  Weighted_rows::for_each_changed_vertex(m_factorized.rows, constraints.rows,
                                         [&](int v) { is_kept[v] = false; });
  Array<int> further_unknowns, multipliers; // the vertices that they are for
  for(int v = 0; v < n; ++v)
    if(!is_kept[v])
    {
      if(!constraints.is_fixed[v]) further_unknowns.push_back(v);
      if(!m_factorized.is_fixed[v]) multipliers.push_back(v);
    }
  const int number_of_unknowns = static_cast<int>(further_unknowns.size());
  const std::size_t size = further_unknowns.size() + multipliers.size();
  if(size > largest_border)
    return false;

  Array<Eigen::Triplet<double, int>> entries;
  Eigen::MatrixXd corner =
    Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
  if(number_of_unknowns > 0)
  {
    Array<int> column(n, -1);
    for(int k = 0; k < number_of_unknowns; ++k)
      column[further_unknowns[k]] = k;
    const bool has_rows = constraints.rows.size() > 0;
    const Sparse_matrix own = has_rows ? with_rows(constraints.rows) : Sparse_matrix();
    const Sparse_matrix& matrix = has_rows ? own : m_laplacian.matrix;
    for(int v = 0; v < n; ++v)
      for(Sparse_matrix::InnerIterator entry(matrix, v); entry; ++entry)
      {
        const int k = column[v], l = column[entry.row()];
        if(k < 0 && l < 0)
          continue;
        if(k >= 0 && l >= 0)
          corner(k, l) = corner(l, k) = entry.value() * (k == l ? diagonal_factor(m_laplacian) : 1);
        else if(k >= 0 && is_kept[entry.row()])
          entries.emplace_back(entry.row(), k, entry.value());
        else if(l >= 0 && is_kept[v])
          entries.emplace_back(v, l, entry.value());
      }
  }
  for(std::size_t k = 0; k < multipliers.size(); ++k)
    entries.emplace_back(multipliers[k], number_of_unknowns + static_cast<int>(k), 1);
  Sparse_matrix border(n, static_cast<Eigen::Index>(size));
  border.setFromTriplets(entries.begin(), entries.end());
  if(!m_solver->set_border(border, corner))
    return false;
  m_further_unknowns = std::move(further_unknowns);
  m_multipliers = std::move(multipliers);
  return true;
}

CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::solve(std::vector<Coordinates>& x)
{
  const std::size_t n = x.size(), border_size = m_further_unknowns.size() + m_multipliers.size();
  if(border_size == 0)
    return m_solver->solve(n, x.data());
  m_bordered.assign(n + border_size, Coordinates{0, 0, 0});
  std::copy(x.begin(), x.end(), m_bordered.begin());
  for(std::size_t k = 0; k < m_further_unknowns.size(); ++k)
    std::swap(m_bordered[n + k], m_bordered[m_further_unknowns[k]]);
  if(!m_solver->solve(m_bordered.size(), m_bordered.data()))
    return false;
  for(int v : m_multipliers)
    m_bordered[v] = {0, 0, 0};
  for(std::size_t k = 0; k < m_further_unknowns.size(); ++k)
    m_bordered[m_further_unknowns[k]] = m_bordered[n + k];
  std::copy_n(m_bordered.begin(), n, x.begin());
  return true;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_CONSTRAINED_SYSTEM_IMPL_H
