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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_STAR_ENERGY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_STAR_ENERGY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/matrix_3x3.h>
#include <CGAL/ARAP_deformation/internal/region/Index_ranges.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Stars as the kernels read them. The weight of the edge (i, j) in the star of i is weights[e],
// that of (j, i) in the star of j opposite_weights[e].
struct Star_view
{
  const int* begin;
  const int* neighbours;
  const double* weights;
  const double* opposite_weights;
  const Double4* rest;
  const Double4* x;
};

struct Star_covariances_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Star_view& stars, int begin, int end,
                                          Matrix_3x3* covariances)
  {
    for(int i = begin; i < end; ++i)
    {
      const Double4 x = stars.x[i], p = stars.rest[i];
      Matrix_rows sum = Matrix_rows::zero();
      for(int e = stars.begin[i]; e < stars.begin[i + 1]; ++e)
      {
        const int j = stars.neighbours[e];
        sum.add_outer_product(Double4::all(stars.weights[e]) * (x - stars.x[j]),
                              p - stars.rest[j]);
      }
      sum.store(covariances[i - begin]);
    }
  }
};

// The energies of stars, and if asked for the force on their centres: minus the sum of w r over all
// edges there, with r the residuals, in the star of the centre and in those of its neighbours.
template <bool HasForce>
struct Star_residuals_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Star_view& stars, int begin, int end,
                                          const Matrix_3x3* rotations, Coordinates* force,
                                          double* energy)
  {
    Double4 energies = Double4::zero();
    for(int i = begin; i < end; ++i)
    {
      const Double4 x = stars.x[i], p = stars.rest[i];
      const Matrix_columns rotation = Matrix_columns::of(rotations[i]);
      Double4 sum = Double4::zero(), row_0 = sum, row_1 = sum, row_2 = sum, star_energy = sum;
      for(int e = stars.begin[i]; e < stars.begin[i + 1]; ++e)
      {
        const int j = stars.neighbours[e];
        const Double4 d = x - stars.x[j], rest = p - stars.rest[j];
        const Double4 residual = subtract_product(d, rotation, rest);
        const Double4 weighted = Double4::all(stars.weights[e]) * residual;
        star_energy = multiply_add(weighted, residual, star_energy);
        if constexpr(HasForce)
        {
          // The neighbour's rotation times the edge, row by row: what each lane has is added up
          // after the last neighbour only. The last row is loaded with the number before it.
          const Double4 opposite = Double4::all(stars.opposite_weights[e]);
          const Double4 edge = opposite * rest;
          const double* m = rotations[j].data();
          sum = sum + multiply_add(opposite, d, weighted);
          row_0 = multiply_add(Double4::load(m), edge, row_0);
          row_1 = multiply_add(Double4::load(m + 3), edge, row_1);
          row_2 = multiply_add(Double4::load(m + 5), shuffle<3, 0, 1, 2>(edge, edge), row_2);
        }
      }
      energies = energies + star_energy; // sums of sums: less is lost in rounding
      if constexpr(HasForce)
        force[i] = {row_0[0] + row_0[1] + row_0[2] - sum[0],
                    row_1[0] + row_1[1] + row_1[2] - sum[1],
                    row_2[1] + row_2[2] + row_2[3] - sum[2]};
    }
    *energy = energies[0] + energies[1] + energies[2];
  }
};

// The energy of cells of which each is one star: cell i is the star of vertex i. Forces are
// gathered, so that no two vertices write to one place.
class Star_energy
{
public:
  Star_energy() = default;

  // All neighbours of the first `number_of_movable_vertices` vertices have stars.
  Star_energy(Stars stars, int number_of_movable_vertices)
    : m_stars(std::move(stars)), m_number_of_movable_vertices(number_of_movable_vertices)
  {
    find_opposite_weights();
  }

  int number_of_cells() const { return m_stars.size(); }
  // calls f(i, j, w) for each edge of each cell
  template <typename Function>
  void for_each_edge(const Function& f) const { m_stars.for_each_edge(f); }

  // whether a vertex of cell i moves; is_free(v) tells for all vertices
  template <typename Predicate>
  bool is_moving(int i, const Predicate& is_free) const
  {
    const auto begin = m_stars.neighbours.items.begin();
    return is_free(i) || std::any_of(begin + m_stars.neighbours.begin[i],
                                     begin + m_stars.neighbours.begin[i + 1], is_free);
  }

  // over the cells that count
  Edge_sums edge_sums(const Double4* rest) const
  {
    return m_chosen.sum([&](int begin, int end) {
      Edge_sums sums;
      for(int i = begin; i < end; ++i)
        for(int e = m_stars.neighbours.begin[i]; e < m_stars.neighbours.begin[i + 1]; ++e)
          sums.add(m_stars.weights[e], rest[i] - rest[m_stars.neighbours.items[e]]);
      return sums;
    });
  }

  // for each vertex whether it is the centre of a cell that counts
  Array<char> vertices_of(const Array<char>& is_chosen) const { return is_chosen; }

  const Array<double>& weights() const { return m_stars.weights; }
  bool is_sum_of_squares() const { return m_stars.are_sums_of_squares(); }

  // the cells that count
  void choose_cells(const Array<char>& is_chosen)
  {
    m_chosen.choose(number_of_cells(), [&](int i) { return is_chosen[i] != 0; },
                    static_cast<int>(default_block_size));
  }

  // nothing to do: cells that consist of several edge sets have
  void prepare_covariances(const Double4*, const Double4*) {}

  // for the cells in [begin, end)
  void compute_covariances(const Double4* rest, const Double4* x, int begin, int end,
                           Matrix_3x3* covariances) const
  {
    run_kernel<Star_covariances_kernel>(view(rest, x), begin, end, covariances);
  }

  // Returns the energy of the chosen cells; `force` becomes minus half its gradient, for each
  // movable vertex that has neighbours in chosen cells only.
  double evaluate(const Double4* rest, const Double4* x, const Matrix_3x3* rotations,
                  Coordinates* force)
  {
    const Star_view stars = view(rest, x);
    return m_chosen.sum([&](int begin, int end) {
      const int middle = (std::max)(begin, (std::min)(m_number_of_movable_vertices, end));
      double movable_energy, other_energy;
      run_kernel<Star_residuals_kernel<true>>(stars, begin, middle, rotations, force,
                                              &movable_energy);
      run_kernel<Star_residuals_kernel<false>>(stars, middle, end, rotations, force,
                                               &other_energy);
      return movable_energy + other_energy;
    });
  }

private:
  // Most weights are symmetric: then there is nothing else to store.
  void find_opposite_weights()
  {
    Array<double> opposite(m_stars.neighbours.begin[m_number_of_movable_vertices]);
    bool is_symmetric = true;
    for(int i = 0; i < m_number_of_movable_vertices; ++i)
      for(int e = m_stars.neighbours.begin[i]; e < m_stars.neighbours.begin[i + 1]; ++e)
      {
        opposite[e] = m_stars.weights[m_stars.find(m_stars.neighbours.items[e], i)];
        is_symmetric &= opposite[e] == m_stars.weights[e];
      }
    if(!is_symmetric)
      m_opposite_weights = std::move(opposite);
  }

  Star_view view(const Double4* rest, const Double4* x) const
  {
    const Array<double>& opposite =
      m_opposite_weights.empty() ? m_stars.weights : m_opposite_weights;
    return {m_stars.neighbours.begin.data(), m_stars.neighbours.items.data(),
            m_stars.weights.data(), opposite.data(), rest, x};
  }

  Stars m_stars;
  Array<double> m_opposite_weights; // of the movable vertices; empty if they are the same
  int m_number_of_movable_vertices = 0;
  Index_ranges m_chosen;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_STAR_ENERGY_H
