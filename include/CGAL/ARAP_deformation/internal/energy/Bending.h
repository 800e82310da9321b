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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_BENDING_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_BENDING_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/energy/Covariance_coefficients.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Index_ranges.h>
#include <CGAL/ARAP_deformation/internal/simd/Points.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/matrix_3x3.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// The forms f_i(x) = (L x)_i / m_i as the kernels read them. A vertex without a form has the factor
// 0.
struct Form_view
{
  const int* begin;
  const int* neighbors;
  const double* weights;
  const double* inverse_masses;
  const double* factors; // b^2 k_i
};

struct Form_values_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Form_view& forms, int begin, int end,
                                          const Points& x, Double4* values)
  {
    for(int i = begin; i < end; ++i)
    {
      Double4 sum = Double4::zero();
      for(int e = forms.begin[i]; e < forms.begin[i + 1]; ++e)
        sum = multiply_add(Double4::all(forms.weights[e]), x[i] - x[forms.neighbors[e]], sum);
      values[i] = Double4::all(forms.inverse_masses[i]) * sum;
    }
  }
};

// The residuals f_i(x) - R_i f_i(p), times their factors, take the place of the values f_i(x).
struct Form_residuals_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Form_view& forms, int begin, int end,
                                          const Double4* rest_values, const Matrix_3x3* rotations,
                                          Double4* values, double* energy)
  {
    Double4 sum = Double4::zero();
    for(int i = begin; i < end; ++i)
      if(forms.factors[i] > 0)
      {
        const Double4 residual =
          subtract_product(values[i], Matrix_columns::of(rotations[i]), rest_values[i]);
        values[i] = Double4::all(forms.factors[i]) * residual;
        sum = multiply_add(values[i] * Double4::all(1 / forms.inverse_masses[i]), residual, sum);
      }
      else
        values[i] = Double4::zero();
    *energy = sum[0] + sum[1] + sum[2];
  }
};

// Adds the forces: minus L times the residuals with their factors, which L^T = L makes of the
// gradient of the forms.
struct Form_forces_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Form_view& forms, int begin, int end,
                                          const Double4* residuals, Coordinates* force)
  {
    for(int v = begin; v < end; ++v)
    {
      Double4 sum = Double4::zero();
      for(int e = forms.begin[v]; e < forms.begin[v + 1]; ++e)
        sum = multiply_add(Double4::all(forms.weights[e]),
                           residuals[forms.neighbors[e]] - residuals[v], sum);
      force[v] = {force[v][0] + sum[0], force[v][1] + sum[1], force[v][2] + sum[2]};
    }
  }
};

// Bending, the second term of the energy, over the vertices i with a cell that are not on the
// border:
//   b^2 k_i m_i || f_i(x) - R_i f_i(p) ||^2,   f_i(x) = (L x)_i / m_i,
// with L the Laplacian of the cotangents as they are, m_i the share of vertex i in the area
// (volume) of its simplices, R_i and k_i the rotation and the stiffness of its cell (Oehri, Herholz
// and Sorkine-Hornung 2025, with a length b and rotations that are fitted to all of the energy). At
// the border (L x)_i is a force across it, which does not shrink with the area: no bending.
class Bending
{
public:
  Bending() = default; // none

  // `masses` are 0 where there is no form, `factors` b^2 k_i.
  Bending(Stars stars, Array<double> masses, Array<double> factors,
          const Array<Coordinates>& rest, int number_of_movable_vertices)
    : m_stars(std::move(stars)), m_inverse_masses(std::move(masses)), m_factors(std::move(factors)),
      m_number_of_movable_vertices(number_of_movable_vertices),
      m_rest_values(m_inverse_masses.size()), m_values(m_inverse_masses.size())
  {
    for(std::size_t i = 0; i < m_inverse_masses.size(); ++i)
      if(m_inverse_masses[i] > 0)
        m_inverse_masses[i] = 1 / m_inverse_masses[i];
      else
        m_factors[i] = 0;
    run_kernel<Form_values_kernel>(view(m_factors), 0, size(), Points(rest), m_rest_values.data());
  }

  bool is_none() const { return m_factors.empty(); }

  // Calls f(i, j, w) for edges whose graph Laplacian is the matrix of all forms, the sum of
  // b^2 k_i m_i times the outer product of the coefficients of f_i, which add up to zero.
  template <typename Function>
  void for_each_edge(const Function& f) const
  {
    for(int i = 0; i < size(); ++i)
    {
      if(!(m_inverse_masses[i] > 0)) // one of stiffness 0 counts: the pattern is that of the region
        continue;
      const double factor = m_factors[i] * m_inverse_masses[i];
      const int begin = m_stars.neighbors.begin[i], end = m_stars.neighbors.begin[i + 1];
      const double own = std::accumulate(m_stars.weights.begin() + begin,
                                         m_stars.weights.begin() + end, 0.0);
      for(int a = begin; a < end; ++a)
      {
        f(i, m_stars.neighbors.items[a], factor * own * m_stars.weights[a]);
        for(int b = a + 1; b < end; ++b)
          f(m_stars.neighbors.items[a], m_stars.neighbors.items[b],
            -factor * m_stars.weights[a] * m_stars.weights[b]);
      }
    }
  }

  // what the energy is measured by, see Deformation_energy::scale() and rounding_level()
  Edge_sums sums() const
  {
    return m_chosen.sum([&](int begin, int end) {
      Edge_sums result;
      for(int i = begin; i < end; ++i)
      {
        double weights = 0;
        for(int e = m_stars.neighbors.begin[i]; e < m_stars.neighbors.begin[i + 1]; ++e)
          weights += 2 * std::abs(m_stars.weights[e]);
        const double factor = m_chosen_factors[i];
        const Double4 square = m_rest_values[i] * m_rest_values[i];
        if(factor > 0)
        {
          result.weights += factor * m_inverse_masses[i] * weights * weights;
          result.squares += factor * (square[0] + square[1] + square[2]) / m_inverse_masses[i];
        }
      }
      return result;
    });
  }

  // the cells that count
  void choose_cells(const Array<char>& is_chosen)
  {
    m_chosen_factors = m_factors;
    const auto is_counted = [&](int i) { // larger cells have centers around them without a cell
      return i < static_cast<int>(is_chosen.size()) && is_chosen[i];
    };
    for(int i = 0; i < size(); ++i)
      if(!is_counted(i))
        m_chosen_factors[i] = 0;
    m_chosen.choose(size(), is_counted, static_cast<int>(default_block_size));
    std::fill(m_values.begin(), m_values.end(), Double4::zero());
  }

  // to be called once before add_covariances() and evaluate() are called for the same positions
  void prepare(const Points& x)
  {
    if(!is_none())
      m_chosen.for_each([&](int begin, int end) {
        run_kernel<Form_values_kernel>(view(m_chosen_factors), begin, end, x, m_values.data());
      });
  }

  // adds b^2 k_i m_i f_i(x) f_i(p)^T for the cells in [begin, end)
  void add_covariances(int begin, int end, Matrix_3x3* covariances) const
  {
    if(is_none())
      return;
    for(int i = begin; i < end; ++i)
      if(m_chosen_factors[i] > 0)
      {
        const double factor = m_chosen_factors[i], mass = 1 / m_inverse_masses[i];
        for(int r = 0; r < 3; ++r)
          for(int c = 0; c < 3; ++c) // in this order no product overflows before the others do
            covariances[i - begin][static_cast<std::size_t>(3 * r + c)] +=
              factor * m_values[i][r] * m_rest_values[i][c] * mass;
      }
  }

  // adds what the form of cell c makes of its covariance
  void add_coefficients(int c, Covariance_coefficients& sum) const
  {
    if(is_none() || !(m_chosen_factors[c] > 0))
      return;
    for(int e = m_stars.neighbors.begin[c]; e < m_stars.neighbors.begin[c + 1]; ++e)
      sum.add_edge(c, m_stars.neighbors.items[e],
                   Double4::all(m_chosen_factors[c] * m_stars.weights[e]) * m_rest_values[c]);
  }

  // Returns the energy of the forms in chosen cells, and adds their forces on movable vertices,
  // unless `force` is nullptr. prepare() must have been called since the last call.
  double evaluate(const Matrix_3x3* rotations, Coordinates* force)
  {
    if(is_none())
      return 0;
    const double energy = m_chosen.sum([&](int begin, int end) {
      double range_energy;
      run_kernel<Form_residuals_kernel>(view(m_chosen_factors), begin, end, m_rest_values.data(),
                                        rotations, m_values.data(), &range_energy);
      return range_energy;
    });
    const int number_of_forces = force ? m_number_of_movable_vertices : 0;
    for_each_block(static_cast<std::size_t>(number_of_forces),
                   [&](std::size_t begin, std::size_t end) {
      run_kernel<Form_forces_kernel>(view(m_chosen_factors), static_cast<int>(begin),
                                     static_cast<int>(end), m_values.data(), force);
    });
    return energy;
  }

private:
  int size() const { return static_cast<int>(m_factors.size()); }

  Form_view view(const Array<double>& factors) const
  {
    return {m_stars.neighbors.begin.data(), m_stars.neighbors.items.data(),
            m_stars.weights.data(), m_inverse_masses.data(), factors.data()};
  }

  Stars m_stars;
  Array<double> m_inverse_masses; // 0 where there is no form
  Array<double> m_factors;        // b^2 k_i, 0 where there is no form
  Array<double> m_chosen_factors; // 0 also where the cell does not count
  Index_ranges m_chosen;
  int m_number_of_movable_vertices = 0;
  Array<Double4> m_rest_values;
  Array<Double4> m_values; // of the forms, then of the residuals with their factors
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_BENDING_H
