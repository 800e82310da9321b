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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SIMPLEX_ENERGY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SIMPLEX_ENERGY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/energy/Block_forces.h>
#include <CGAL/ARAP_deformation/internal/energy/Covariance_coefficients.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/energy/Joint_cell.h>
#include <CGAL/ARAP_deformation/internal/region/Index_ranges.h>
#include <CGAL/ARAP_deformation/internal/simd/Points.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/matrix_3x3.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Simplices as the kernels read them.
struct Simplex_view
{
  const int* first_corner;
  const int* corners;
  const int* first_weight;
  const double* weights;
  Points rest;
  Points x;
};

// N is the number of corners of each simplex, or 0 where it differs.
template <int N>
struct Simplex_covariances_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Simplex_view& simplices, int begin, int end,
                                          Matrix_3x3* covariances)
  {
    for(int s = begin; s < end; ++s)
    {
      const int first = simplices.first_corner[s];
      const int n = N > 0 ? N : simplices.first_corner[s + 1] - first;
      const int* corners = simplices.corners + first;
      const double* weight = simplices.weights + simplices.first_weight[s];
      Matrix_rows sum = Matrix_rows::zero();
      for(int a = 0; a < n; ++a)
        for(int b = a + 1; b < n; ++b, ++weight)
        {
          const int i = corners[a], j = corners[b];
          sum.add_outer_product(Double4::all(*weight) * (simplices.x[i] - simplices.x[j]),
                                simplices.rest[i] - simplices.rest[j]);
        }
      sum.store(covariances[s - begin]);
    }
  }
};

// The energies of simplices in all cells that they are in. Adds to the forces at the places of
// their corners minus the sum of k w r over the edges there and these cells, with r the residuals.
template <int N>
struct Simplex_residuals_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Simplex_view& simplices, int begin, int end,
                                          const Index_lists& cells, const double* stiffness,
                                          const Matrix_3x3* rotations, const int* places,
                                          Double4* forces, double* energy)
  {
    Double4 energies = Double4::zero();
    for(int s = begin; s < end; ++s)
    {
      const int* corners = simplices.corners + simplices.first_corner[s];
      const int* place = places + simplices.first_corner[s];
      const double* weight = simplices.weights + simplices.first_weight[s];
      Double4 simplex_energy = Double4::zero();
      if constexpr(N == 0)
      {
        const int n = simplices.first_corner[s + 1] - simplices.first_corner[s];
        const Joint_cell cell(cells, s, stiffness, rotations);
        const Matrix_columns mean = columns_of(cell.mean);
        const Matrix_columns spread = columns_of(cell.spread);
        for(int a = 0; a < n; ++a)
          for(int b = a + 1; b < n; ++b, ++weight)
          {
            const int i = corners[a], j = corners[b];
            const Double4 edge = simplices.rest[i] - simplices.rest[j];
            const Double4 residual = subtract_product(simplices.x[i] - simplices.x[j], mean, edge);
            const Double4 weighted = Double4::all(cell.stiffness * *weight) * residual;
            const Double4 spread_edge = subtract_product(Double4::zero(), spread, edge);
            simplex_energy = multiply_add(weighted, residual, simplex_energy) -
                             Double4::all(*weight) * edge * spread_edge;
            forces[place[a]] = forces[place[a]] - weighted;
            forces[place[b]] = forces[place[b]] + weighted;
          }
      }
      else
      {
        Double4 few_forces[std::size_t(N)]; // in registers
        for(int a = 0; a < N; ++a)
          few_forces[a] = Double4::zero();
        for(int k = cells.begin[s]; k < cells.begin[s + 1]; ++k)
        {
          const Matrix_columns rotation = Matrix_columns::of(rotations[cells.items[k]]);
          const Double4 factor = Double4::all(stiffness[cells.items[k]]);
          // of the edges from the first corner: others are their differences
          Double4 residuals[std::size_t(N)];
          const int o = corners[0];
          residuals[0] = Double4::zero();
          for(int a = 1; a < N; ++a)
          {
            const int i = corners[a];
            residuals[a] = subtract_product(simplices.x[o] - simplices.x[i], rotation,
                                            simplices.rest[o] - simplices.rest[i]);
          }
          const double* w = weight;
          for(int a = 0; a < N; ++a)
            for(int b = a + 1; b < N; ++b, ++w)
            {
              const Double4 residual = a == 0 ? residuals[b] : residuals[b] - residuals[a];
              const Double4 weighted = factor * Double4::all(*w) * residual;
              simplex_energy = multiply_add(weighted, residual, simplex_energy);
              few_forces[a] = few_forces[a] - weighted;
              few_forces[b] = few_forces[b] + weighted;
            }
        }
        for(int a = 0; a < N; ++a)
          forces[place[a]] = forces[place[a]] + few_forces[a];
      }
      energies = energies + simplex_energy; // sums of sums: less is lost in rounding
    }
    *energy = energies[0] + energies[1] + energies[2];
  }
};

// The energy of cells that consist of simplices.
class Simplex_energy
{
public:
  Simplex_energy(Simplices simplices, Cells cells, int number_of_movable_vertices)
    : m_simplices(std::move(simplices)), m_cells(std::move(cells)),
      m_cells_of_simplices(lists_with(m_cells.sets, m_simplices.size())),
      m_forces(m_simplices.corners, number_of_movable_vertices)
  {
    for(int s = 0; s < m_simplices.size(); ++s)
      m_number_of_corners = s == 0 || m_simplices.number_of_corners(s) == m_number_of_corners
                              ? m_simplices.number_of_corners(s) : 0;
    for(int c = 0; c < m_cells.size(); ++c)
      m_is_each_a_cell &= m_cells.sets.begin[c + 1] == c + 1 && m_cells.sets.items[c] == c;
    if(!m_is_each_a_cell)
      m_covariances = Array<Matrix_3x3>(m_simplices.size());
  }

  int number_of_cells() const { return m_cells.size(); }

  // calls f(i, j, w) for each edge of each simplex, with w the sum over the cells of the simplex
  template <typename Function>
  void for_each_edge(const Function& f) const
  {
    for(int s = 0; s < m_simplices.size(); ++s)
    {
      const double stiffness = total_stiffness(s, m_cells.stiffness);
      m_simplices.for_each_edge_of(s, [&](int i, int j, double w) { f(i, j, stiffness * w); });
    }
  }

  // over the cells that count
  Edge_sums edge_sums(const Points& rest) const
  {
    return m_chosen.sum([&](int begin, int end) {
      Edge_sums sums;
      for(int s = begin; s < end; ++s)
      {
        const double stiffness = total_stiffness(s, m_stiffness);
        m_simplices.for_each_edge_of(s, [&](int i, int j, double w) {
          sums.add(stiffness * w, rest[i] - rest[j]);
        });
      }
      return sums;
    });
  }

  // for each vertex whether it is the center of a cell that counts, or a corner of one that is a
  // simplex
  Array<char> vertices_of(const Array<char>& is_chosen) const
  {
    if(!m_is_each_a_cell)
      return is_chosen;
    Array<char> vertices;
    for(int s = 0; s < m_cells.size(); ++s)
      if(is_chosen[s])
        for(int v : m_simplices.corners.list(s))
        {
          if(static_cast<std::size_t>(v) >= vertices.size())
            vertices.resize(static_cast<std::size_t>(v) + 1, false);
          vertices[v] = true;
        }
    return vertices;
  }

  bool is_sum_of_squares() const { return m_simplices.is_sum_of_squares; }

  // whether a vertex of cell c moves; is_free(v) tells for all vertices
  template <typename Predicate>
  bool is_moving(int c, const Predicate& is_free) const
  {
    const auto [begin, end] = m_cells.sets.list(c);
    return std::any_of(begin, end, [&](int s) {
      const Index_range corners = m_simplices.corners.list(s);
      return std::any_of(corners.begin(), corners.end(), is_free);
    });
  }

  // the cells that count
  void choose_cells(const Array<char>& is_chosen)
  {
    m_stiffness = m_cells.stiffness;
    for(int c = 0; c < m_cells.size(); ++c)
      if(!is_chosen[c])
        m_stiffness[c] = 0;
    m_chosen.choose(m_simplices.size(), [&](int s) {
      const auto [begin, end] = m_cells_of_simplices.list(s);
      return std::any_of(begin, end, [&](int c) { return is_chosen[c] != 0; });
    }, m_forces.block_size());
    m_forces.clear();
  }

  // to be called once before compute_covariances() is called for the same positions
  void prepare_covariances(const Points& rest, const Points& x)
  {
    if(m_is_each_a_cell)
      return;
    m_chosen.for_each([&](int begin, int end) {
      run<Simplex_covariances_kernel>(view(rest, x), begin, end, m_covariances.data() + begin);
    });
  }

  // for the cells in [begin, end)
  void compute_covariances(const Points& rest, const Points& x, int begin, int end,
                           Matrix_3x3* covariances) const
  {
    if(!m_is_each_a_cell)
      return add_up_covariances(m_cells, m_covariances, begin, end, covariances);
    run<Simplex_covariances_kernel>(view(rest, x), begin, end, covariances);
    for(int c = begin; c < end; ++c)
      if(m_cells.stiffness[c] != 1)
        for(double& entry : covariances[c - begin])
          entry *= m_cells.stiffness[c];
  }

  // adds what the covariance of cell c consists of
  void add_coefficients(int c, const Points& rest, Covariance_coefficients& sum) const
  {
    for(int k = m_cells.sets.begin[c]; k < m_cells.sets.begin[c + 1]; ++k)
      m_simplices.for_each_edge_of(m_cells.sets.items[k], [&](int i, int j, double w) {
        sum.add_edge(i, j, Double4::all(m_cells.stiffness[c] * w) * (rest[i] - rest[j]));
      });
  }

  // Returns the energy of the chosen cells; `force`, unless it is nullptr, becomes minus half its
  // gradient, for each movable vertex that is in chosen cells only.
  double evaluate(const Points& rest, const Points& x, const Matrix_3x3* rotations,
                  Coordinates* force)
  {
    const double energy = m_chosen.sum([&](int begin, int end) {
      double range_energy;
      run<Simplex_residuals_kernel>(view(rest, x), begin, end, m_cells_of_simplices,
                                    m_stiffness.data(), rotations, m_forces.places(),
                                    m_forces.data(), &range_energy);
      return range_energy;
    }, [&](int begin) { m_forces.clear_block_of(begin); });
    if(force)
      m_forces.gather(force);
    return energy;
  }

private:
  // the sum over the cells of simplex s
  double total_stiffness(int s, const Array<double>& stiffness) const
  {
    double sum = 0;
    for(int k = m_cells_of_simplices.begin[s]; k < m_cells_of_simplices.begin[s + 1]; ++k)
      sum += stiffness[m_cells_of_simplices.items[k]];
    return sum;
  }

  template <template <int> class Kernel, typename... Arguments>
  void run(const Arguments&... arguments) const
  {
    switch(m_number_of_corners)
    {
    case 3: return run_kernel<Kernel<3>>(arguments...);
    case 4: return run_kernel<Kernel<4>>(arguments...);
    default: return run_kernel<Kernel<0>>(arguments...);
    }
  }

  Simplex_view view(const Points& rest, const Points& x) const
  {
    return {m_simplices.corners.begin.data(), m_simplices.corners.items.data(),
            m_simplices.first_weight.data(), m_simplices.weights.data(), rest, x};
  }

  Simplices m_simplices;
  Cells m_cells;
  Index_lists m_cells_of_simplices;
  Block_forces m_forces;
  Array<double> m_stiffness; // of the cells, 0 for those that do not count
  Index_ranges m_chosen;     // the simplices of the other cells
  Array<Matrix_3x3> m_covariances; // of the simplices; empty if each is a cell
  int m_number_of_corners = 0; // of each simplex, 0 if they differ
  bool m_is_each_a_cell = true;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SIMPLEX_ENERGY_H
