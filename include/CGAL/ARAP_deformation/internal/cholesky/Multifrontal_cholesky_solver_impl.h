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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_MULTIFRONTAL_CHOLESKY_SOLVER_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_MULTIFRONTAL_CHOLESKY_SOLVER_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Bordered_substitution.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/fill_reducing_order.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/parallel/largest_entry.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace CGAL {
namespace ARAP {

namespace internal {

// The factor of a matrix, if it has values.
template <typename Number>
struct Cholesky_factor
{
  // has no values if it fails
  bool compute(const Supernodal_cholesky& cholesky, const Sparse_matrix& a)
  {
    substitution.remove_border();
    std::unique_ptr<Number[]> computed = std::move(values);
    if(!cholesky.factorize(a, computed))
      return false;
    values = std::move(computed);
    return true;
  }

  void remove() { *this = Cholesky_factor(); }

  std::unique_ptr<Number[]> values;
  Bordered_substitution<Number> substitution;
};

} // namespace internal

struct Multifrontal_cholesky_solver::State
{
  State(const Sparse_matrix& a, Fill_reducing_ordering ordering)
    : cholesky(a, internal::fill_reducing_order(a, ordering))
  {}

  const internal::Supernodal_structure& structure() const { return cholesky.structure(); }

  void solve(std::size_t n, Coordinates* x)
  {
    if(!single_factor.values)
      return double_factor.substitution.solve(structure(), double_factor.values.get(), n, x);
    // very small and very large right-hand sides would leave the range of float
    const double largest = internal::largest_entry(x, n);
    const double unit = largest > 1e-300 && internal::is_finite(largest) ? largest : 1;
    single_factor.substitution.solve(structure(), single_factor.values.get(), n, x, unit);
  }

  // Whether solutions, and what a border makes of them, remain in the range of float for all kinds
  // of right-hand sides: smooth ones have large solutions, and one column may be much smaller than
  // another.
  static bool is_in_range(const Sparse_matrix& a)
  {
    for(int column = 0; column < a.outerSize(); ++column)
      if(const Sparse_matrix::InnerIterator diagonal(a, column);
         !diagonal || !(1e-15 < diagonal.value() && diagonal.value() < 1e15))
        return false;
    return true;
  }

  // Whether refining the solution for a random right-hand side works. That is a power iteration: it
  // finds what the factor is worst for, however little of it the right-hand side has.
  bool is_accurate(const Sparse_matrix& a)
  {
    const std::size_t n = static_cast<std::size_t>(a.rows());
    internal::Array<Coordinates> residual(n), step;
    std::uint64_t state = 1; // of the generator std::minstd_rand, whose header is large
    for(Coordinates& row : residual)
      for(double& entry : row)
      {
        state = 48271 * state % 2147483647;
        entry = static_cast<double>(state) / 2147483646 - 0.5;
      }
    double first = 0, last = 0;
    for(int k = 0; k < 4; ++k)
    {
      step = residual;
      solve(n, step.data());
      double energy = 0;
      for(std::size_t v = 0; v < n; ++v)
        for(std::size_t c = 0; c < 3; ++c)
          energy += residual[v][c] * step[v][c];
      if(k == 0)
        first = energy;
      else if(!(energy <= 1e-2 * last + 1e-24 * first))
        return false;
      last = energy;
      for(int j = 0; j < a.outerSize(); ++j)
        for(Sparse_matrix::InnerIterator entry(a, j); entry; ++entry)
          for(std::size_t c = 0; c < 3; ++c)
          {
            residual[entry.row()][c] -= entry.value() * step[j][c];
            if(entry.row() != j)
              residual[j][c] -= entry.value() * step[entry.row()][c];
          }
    }
    return first > 0;
  }

  internal::Supernodal_cholesky cholesky;
  internal::Cholesky_factor<double> double_factor; // at most one of the two has values
  internal::Cholesky_factor<float> single_factor;
};

CGAL_ARAP_INLINE_FUNCTION
bool Multifrontal_cholesky_solver::analyze(const Sparse_matrix& a)
{
  m_state.emplace(a, m_ordering);
  return true;
}

CGAL_ARAP_INLINE_FUNCTION
bool Multifrontal_cholesky_solver::factorize(const Sparse_matrix& a)
{
  State& state = *m_state;
  if(m_precision == Factor_precision::single_precision)
  {
    state.double_factor.remove();
    if(State::is_in_range(a) && state.single_factor.compute(state.cholesky, a) &&
       state.is_accurate(a))
      return true;
    state.single_factor.remove();
  }
  return state.double_factor.compute(state.cholesky, a);
}

CGAL_ARAP_INLINE_FUNCTION
bool Multifrontal_cholesky_solver::set_border(const Sparse_matrix& b, const Dense_matrix& d)
{
  const auto set = [&](auto& factor) {
    return factor.substitution.set_border(m_state->structure(), factor.values.get(), b, d);
  };
  return is_single_precision() ? set(m_state->single_factor) : set(m_state->double_factor);
}

CGAL_ARAP_INLINE_FUNCTION
bool Multifrontal_cholesky_solver::solve(std::size_t n, Coordinates* x)
{
  m_state->solve(n, x);
  return true;
}

CGAL_ARAP_INLINE_FUNCTION
bool Multifrontal_cholesky_solver::is_single_precision() const
{
  return m_state && m_state->single_factor.values;
}

CGAL_ARAP_INLINE_FUNCTION
std::size_t Multifrontal_cholesky_solver::factor_bytes() const
{
  return m_state->structure().number_of_bytes(is_single_precision() ? sizeof(float)
                                                                    : sizeof(double));
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_MULTIFRONTAL_CHOLESKY_SOLVER_IMPL_H
