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
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system.h>
#include <CGAL/ARAP_deformation/internal/solver/free_components.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
Sparse_matrix Constrained_system::with_rows(const Weighted_rows& rows) const
{
  Sparse_matrix matrix; // assigned: Eigen's constructors leak where memory runs out
  matrix = m_laplacian.matrix;
  if(rows.is_diagonal())
    rows.for_each_entry([&](int v, int, double entry) { diagonal_entry(matrix, v) += entry; });
  else
  {
    // the pattern stays, if the vertices of each row are those of a simplex
    Array<Eigen::Triplet<double, int>> others;
    rows.for_each_entry([&](int i, int j, double entry) {
      const int* const begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[j];
      const int* const end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[j + 1];
      const int* const found = std::lower_bound(begin, end, i);
      if(found != end && *found == i)
        matrix.valuePtr()[found - matrix.innerIndexPtr()] += entry;
      else
        others.emplace_back(i, j, entry);
    });
    if(!others.empty())
    {
      for(int v = 0; v < matrix.cols(); ++v)
        for(Sparse_matrix::InnerIterator entry(matrix, v); entry; ++entry)
          others.emplace_back(entry.row(), v, entry.value());
      matrix.setFromTriplets(others.begin(), others.end());
    }
  }
  return matrix;
}

// a free vertex whose diagonal entry is not a positive finite number, or -1
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
    if(!constraints.is_fixed[v] && (!(diagonal[v] > 0) || !is_finite(diagonal[v])))
      return v;
  return -1;
}

// The constraints of the matrix. Where hard rows are all that constrains a component they are soft
// ones, too: that changes no solution that keeps them, and makes the matrix definite.
CGAL_ARAP_INLINE_FUNCTION
Constraints Constrained_system::without_hard_rows(const Constraints& constraints) const
{
  Constraints result = {constraints.is_fixed, constraints.rows, {}};
  const Free_components components = find_free_components(m_laplacian, result);
  for(int r = 0; r < constraints.hard_rows.size(); ++r)
  {
    bool is_needed = false;
    double weight = 0;
    constraints.hard_rows.row(r).for_each_coefficient([&](int v, double b) {
      is_needed |= components.is_unconstrained(v);
      weight += std::abs(b) * diagonal_entry(m_laplacian.matrix, v);
    });
    if(is_needed)
      result.rows.append(constraints.hard_rows.row(r),
                         weight > 0 && is_finite(weight) ? weight : 1);
  }
  return result;
}

CGAL_ARAP_INLINE_FUNCTION
Diagnosis Constrained_system::prepare(const Constraints& constraints, Stages& stages)
{
  if(constraints.hard_rows.size() > Hard_rows::most_rows)
    return {Status::too_many_control_points};
  Hard_rows hard_rows(constraints);
  if(const int r = hard_rows.find_dependent(); r >= 0)
    return {Status::dependent_target, -1, -1, r};
  const bool has_hard_rows = !hard_rows.is_empty();
  const Constraints copy = has_hard_rows ? without_hard_rows(constraints) : Constraints();
  const Constraints& of_matrix = has_hard_rows ? copy : constraints;
  if(const int v = find_singular_vertex(of_matrix); v >= 0)
    return {Status::singular_matrix, v};
  m_hard_rows = std::move(hard_rows);
  if(constraints.number_of_free_vertices() == 0)
    return {};
  if(!m_has_factor || !border_or_eliminate(of_matrix))
  {
    if(!factorize(of_matrix, stages))
      return {Status::singular_matrix};
    if(has_hard_rows && !border_or_eliminate(of_matrix))
    {
      release_factor();
      return {Status::solver_failed};
    }
  }
  stages.border |= !m_further_unknowns.empty() || !m_multipliers.empty() || has_hard_rows;
  return {};
}

CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::border_or_eliminate(const Constraints& constraints)
{
  return set_border(constraints, true) ||
         (!m_hard_rows.is_empty() && set_border(constraints, false) && eliminate_hard_rows());
}

CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::factorize(const Constraints& constraints, Stages& stages)
{
  Sparse_matrix matrix = with_rows(constraints.rows);
  const auto& is_fixed = constraints.is_fixed;
  const bool has_pattern_of_laplacian = matrix.nonZeros() == m_laplacian.matrix.nonZeros();
  // the order is of some vertices, and then, if it does not suffice, of all
  const bool has_order = m_solver && has_pattern_of_laplacian && !m_is_coupled.empty();
  const bool is_analyzed =
    has_order && std::equal(is_fixed.begin(), is_fixed.end(), m_is_coupled.begin(),
                            [](char fixed, char coupled) { return fixed || coupled; });
  if(!is_analyzed)
  {
    m_is_coupled.resize(is_fixed.size());
    std::transform(is_fixed.begin(), is_fixed.end(), m_is_coupled.begin(),
                   [&](char fixed) { return has_order || !fixed; });
  }
  for(int v = 0; v < matrix.cols(); ++v)
  {
    double& diagonal = diagonal_entry(matrix, v);
    if(is_fixed[v] && (!(diagonal > 0) || !is_finite(diagonal)))
      diagonal = 1;
    diagonal *= diagonal_factor(m_laplacian);
    for(Sparse_matrix::InnerIterator entry(matrix, v); entry; ++entry)
      if(entry.row() != v && (is_fixed[v] || is_fixed[entry.row()]))
        entry.valueRef() = 0;
  }
  matrix.prune([&](int row, int column, double) {
    return row == column || (m_is_coupled[row] && m_is_coupled[column]);
  });

  m_further_unknowns.clear();
  m_multipliers.clear();
  // no factor where something fails, and never two
  std::unique_ptr<Linear_solver> solver = std::move(m_solver);
  m_has_factor = false;
  if(!is_analyzed)
  {
    solver.reset();
    solver = m_prototype->copy();
    stages.order = true;
  }
  stages.factor = true;
  if(!(is_analyzed || solver->analyze(matrix)) || !solver->factorize(matrix))
    return false;
  m_factorized = constraints;
  m_solver = std::move(solver);
  m_has_factor = true;
  if(!has_pattern_of_laplacian)
    m_is_coupled.clear();
  return true;
}

CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::set_border(const Constraints& constraints, bool are_hard_rows_bordered)
{
  constexpr int largest_border = 256; // beyond it a factorization costs less
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
  const int first_row = number_of_unknowns + static_cast<int>(multipliers.size());
  const int size = first_row + (are_hard_rows_bordered ? m_hard_rows.size() : 0);
  if(size > (m_prototype->can_have_border() ? largest_border : 0))
    return false;

  Array<Eigen::Triplet<double, int>> entries;
  Eigen::MatrixXd corner = Eigen::MatrixXd::Zero(size, size);
  // of each vertex that is a further unknown, -1 of any other; empty if there is none
  Array<int> column(number_of_unknowns > 0 ? n : 0, -1);
  for(int k = 0; k < number_of_unknowns; ++k)
    column[further_unknowns[k]] = k;
  if(number_of_unknowns > 0)
  {
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
  for(int r = 0; r < size - first_row; ++r)
    for(Sparse_matrix::InnerIterator entry(m_hard_rows.columns(), r); entry; ++entry)
      if(const int k = column.empty() ? -1 : column[entry.row()]; k >= 0)
        corner(first_row + r, k) = corner(k, first_row + r) = entry.value();
      else
        entries.emplace_back(entry.row(), first_row + r, entry.value());
  Sparse_matrix border(n, size);
  border.setFromTriplets(entries.begin(), entries.end());
  if(m_prototype->can_have_border() && !m_solver->set_border(border, corner))
    return false;
  m_are_hard_rows_bordered = are_hard_rows_bordered;
  m_further_unknowns = std::move(further_unknowns);
  m_multipliers = std::move(multipliers);
  return true;
}

// computes and factorizes S, three columns with each solution
CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::eliminate_hard_rows()
{
  const std::size_t m = static_cast<std::size_t>(m_hard_rows.size());
  Array<double> s(m * m);
  for(std::size_t first = 0; first < m; first += 3)
  {
    const std::size_t count = (std::min)(std::size_t(3), m - first);
    Array<Coordinates> three = m_hard_rows.own_values({});
    for(std::size_t k = 0; k < count; ++k)
      three[first + k][k] = 1;
    Array<Coordinates> x(static_cast<std::size_t>(m_laplacian.size()), Coordinates{0, 0, 0});
    m_hard_rows.add(three, x);
    if(!solve_matrix(x, {}))
      return false;
    const Array<Coordinates> minus_s = m_hard_rows.residuals(m_hard_rows.own_values({}), x);
    for(std::size_t k = 0; k < count; ++k)
      for(std::size_t r = 0; r < m; ++r)
        s[(first + k) * m + r] = -minus_s[r][k];
  }
  return m_eliminated.factorize(m_hard_rows.size(), s, Array<char>(m, false), Array<double>(m, 0),
                                0);
}

CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::solve(Array<Coordinates>& x, const Array<Coordinates>& values)
{
  const Array<Coordinates> own_values = m_hard_rows.own_values(values);
  if(!solve_matrix(x, own_values))
    return false;
  if(m_hard_rows.is_empty())
    return true;
  if(!m_are_hard_rows_bordered)
  {
    Array<Coordinates> correction(x.size(), Coordinates{0, 0, 0});
    Array<Coordinates> multipliers = m_hard_rows.residuals(own_values, x);
    m_eliminated.solve(multipliers.data());
    m_hard_rows.add(multipliers, correction);
    if(!solve_matrix(correction, {}))
      return false;
    for(std::size_t v = 0; v < x.size(); ++v)
      add(x[v], 1, correction[v]);
  }
  m_hard_rows.project(own_values, x); // whatever the solver's rounding errors are
  return true;
}

CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::meet(const Array<Coordinates>& values, Array<Coordinates>& x)
{
  if(m_hard_rows.is_empty())
    return true;
  Array<Coordinates> step(static_cast<std::size_t>(m_laplacian.size()), Coordinates{0, 0, 0});
  if(!solve(step, m_hard_rows.given_residuals(values, x)))
    return false;
  for(std::size_t v = 0; v < step.size(); ++v)
    add(x[v], 1, step[v]);
  return true;
}

CGAL_ARAP_INLINE_FUNCTION
bool Constrained_system::solve_matrix(Array<Coordinates>& x,
                                      const Array<Coordinates>& values)
{
  const std::size_t n = x.size(), first_row = m_further_unknowns.size() + m_multipliers.size();
  const std::size_t border_size =
    first_row + static_cast<std::size_t>(m_are_hard_rows_bordered ? m_hard_rows.size() : 0);
  if(border_size == 0)
    return m_solver->solve(n, x.data());
  m_bordered.assign(n + border_size, Coordinates{0, 0, 0});
  std::copy(x.begin(), x.end(), m_bordered.begin());
  for(std::size_t k = 0; k < m_further_unknowns.size(); ++k)
    std::swap(m_bordered[n + k], m_bordered[m_further_unknowns[k]]);
  for(std::size_t r = first_row; r < border_size; ++r)
    m_bordered[n + r] = values[r - first_row];
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
