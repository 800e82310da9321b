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
#include <CGAL/ARAP_deformation/internal/energy/Covariance_coefficients.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/energy/Joint_cell.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/Points.h>
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
  const int* neighbors;
  const double* weights;
  const double* opposite_weights;
  Points rest;
  Points x;
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
        const int j = stars.neighbors[e];
        sum.add_outer_product(Double4::all(stars.weights[e]) * (x - stars.x[j]),
                              p - stars.rest[j]);
      }
      sum.store(covariances[i - begin]);
    }
  }
};

// The energies of stars, and if asked for the force on their centers: minus the sum of w r over all
// edges there, with r the residuals, in the star of the center and in those of its neighbors.
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
        const int j = stars.neighbors[e];
        const Double4 d = x - stars.x[j], rest = p - stars.rest[j];
        const Double4 residual = subtract_product(d, rotation, rest);
        const Double4 weighted = Double4::all(stars.weights[e]) * residual;
        star_energy = multiply_add(weighted, residual, star_energy);
        if constexpr(HasForce)
        {
          // The neighbor's rotation times the edge, row by row: what each lane has is added up
          // after the last neighbor only. The last row is loaded with the number before it.
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
      {
        const Double4 f =
          sums_of_lanes(row_0, row_1, shuffle<1, 2, 3, 0>(row_2, row_2)) - sum;
        force[i] = {f[0], f[1], f[2]};
      }
    }
    *energy = energies[0] + energies[1] + energies[2];
  }
};

// The energy of cells that consist of stars. Forces are gathered, so that no two vertices write to
// one place.
class Star_energy
{
public:
  // Cell i is the star of vertex i. All neighbors of the first `number_of_movable_vertices`
  // vertices have stars.
  Star_energy(Stars stars, int number_of_movable_vertices)
    : m_stars(std::move(stars)), m_number_of_movable_vertices(number_of_movable_vertices)
  {
    m_opposite_weights = opposite_weights(m_stars.weights);
  }

  // Cells consist of several stars, and stars may be in several cells.
  Star_energy(Stars stars, Cells cells, const Array<Coordinates>& rest,
              int number_of_movable_vertices)
    : m_stars(std::move(stars)), m_cells(std::move(cells)),
      m_cells_of_stars(lists_with(m_cells.sets, m_stars.size())),
      m_number_of_movable_vertices(number_of_movable_vertices),
      m_covariances(m_stars.size()), m_means(m_stars.size()), m_rest_covariances(m_stars.size())
  {
    run_kernel<Star_covariances_kernel>(view(rest, rest, m_stars.weights), 0, m_stars.size(),
                                        m_rest_covariances.data());
  }

  int number_of_cells() const { return has_stars_as_cells() ? m_stars.size() : m_cells.size(); }

  // calls f(i, j, w) for each edge of each star, with w the sum over the cells of the star
  template <typename Function>
  void for_each_edge(const Function& f) const
  {
    if(has_stars_as_cells())
      return m_stars.for_each_edge(f);
    const Array<double> stiffness = total_stiffness(m_cells.stiffness);
    m_stars.for_each_edge([&](int i, int j, double w) { f(i, j, stiffness[i] * w); });
  }

  // whether a vertex of cell c moves; is_free(v) tells for all vertices
  template <typename Predicate>
  bool is_moving(int c, const Predicate& is_free) const
  {
    const auto is_star_moving = [&](int i) {
      const auto [begin, end] = m_stars.neighbors.list(i);
      return is_free(i) || std::any_of(begin, end, is_free);
    };
    if(has_stars_as_cells())
      return is_star_moving(c);
    const auto [begin, end] = m_cells.sets.list(c);
    return std::any_of(begin, end, is_star_moving);
  }

  // over the cells that count
  Edge_sums edge_sums(const Points& rest) const
  {
    return m_chosen.sum([&](int begin, int end) {
      Edge_sums sums;
      for(int i = begin; i < end; ++i)
        for(int e = m_stars.neighbors.begin[i]; e < m_stars.neighbors.begin[i + 1]; ++e)
          sums.add(weights_of_cells()[e], rest[i] - rest[m_stars.neighbors.items[e]]);
      return sums;
    });
  }

  // for each vertex whether it is the center of a cell that counts
  Array<char> vertices_of(const Array<char>& is_chosen) const { return is_chosen; }

  bool is_sum_of_squares() const { return m_stars.are_sums_of_squares(); }

  // the cells that count
  void choose_cells(const Array<char>& is_chosen)
  {
    const auto block_size = static_cast<int>(default_block_size);
    if(has_stars_as_cells())
      return m_chosen.choose(number_of_cells(), [&](int i) { return is_chosen[i] != 0; },
                             block_size);
    m_stiffness = m_cells.stiffness;
    for(int c = 0; c < m_cells.size(); ++c)
      if(!is_chosen[c])
        m_stiffness[c] = 0;
    const Array<double> stiffness = total_stiffness(m_stiffness);
    m_weights_of_cells = m_stars.weights;
    for(int i = 0; i < m_stars.size(); ++i)
      for(int e = m_stars.neighbors.begin[i]; e < m_stars.neighbors.begin[i + 1]; ++e)
        m_weights_of_cells[e] *= stiffness[i];
    m_opposite_weights = opposite_weights(m_weights_of_cells);
    m_chosen.choose(m_stars.size(), [&](int i) {
      const auto [begin, end] = m_cells_of_stars.list(i);
      return std::any_of(begin, end, [&](int c) { return is_chosen[c] != 0; });
    }, block_size);
  }

  // to be called once before compute_covariances() is called for the same positions
  void prepare_covariances(const Points& rest, const Points& x)
  {
    if(!has_stars_as_cells())
      m_chosen.for_each([&](int begin, int end) {
        run_kernel<Star_covariances_kernel>(view(rest, x, m_stars.weights), begin, end,
                                            m_covariances.data() + begin);
      });
  }

  // for the cells in [begin, end)
  void compute_covariances(const Points& rest, const Points& x, int begin, int end,
                           Matrix_3x3* covariances) const
  {
    if(has_stars_as_cells())
      return run_kernel<Star_covariances_kernel>(view(rest, x, m_stars.weights), begin, end,
                                                 covariances);
    add_up_covariances(m_cells, m_covariances, begin, end, covariances);
  }

  // adds what the covariance of cell c consists of
  void add_coefficients(int c, const Points& rest, Covariance_coefficients& sum) const
  {
    if(has_stars_as_cells())
      return add_star(c, 1, rest, sum);
    for(int k = m_cells.sets.begin[c]; k < m_cells.sets.begin[c + 1]; ++k)
      add_star(m_cells.sets.items[k], m_cells.stiffness[c], rest, sum);
  }

  // Returns the energy of the chosen cells; `force`, unless it is nullptr, becomes minus half its
  // gradient, for each movable vertex that has neighbors in chosen cells only.
  double evaluate(const Points& rest, const Points& x, const Matrix_3x3* rotations,
                  Coordinates* force)
  {
    Star_view stars = view(rest, x, m_stars.weights);
    double spread_energy = 0;
    if(!has_stars_as_cells())
    {
      spread_energy = m_chosen.sum([&](int begin, int end) {
        double energy;
        run_kernel<Joint_cells_kernel>(m_cells_of_stars, begin, end, m_stiffness.data(), rotations,
                                       m_rest_covariances.data(), m_means.data(), &energy);
        return energy;
      });
      rotations = m_means.data();
      stars = view(rest, x, m_weights_of_cells);
    }
    const int number_of_forces = force ? m_number_of_movable_vertices : 0;
    return spread_energy + m_chosen.sum([&](int begin, int end) {
      const int middle = (std::max)(begin, (std::min)(number_of_forces, end));
      double movable_energy, other_energy;
      run_kernel<Star_residuals_kernel<true>>(stars, begin, middle, rotations, force,
                                              &movable_energy);
      run_kernel<Star_residuals_kernel<false>>(stars, middle, end, rotations, force,
                                               &other_energy);
      return movable_energy + other_energy;
    });
  }

private:
  bool has_stars_as_cells() const { return m_cells.sets.items.empty(); }

  void add_star(int i, double stiffness, const Points& rest, Covariance_coefficients& sum) const
  {
    for(int e = m_stars.neighbors.begin[i]; e < m_stars.neighbors.begin[i + 1]; ++e)
    {
      const int j = m_stars.neighbors.items[e];
      sum.add_edge(i, j, Double4::all(stiffness * m_stars.weights[e]) * (rest[i] - rest[j]));
    }
  }

  // with the stiffness of the cells that count
  const Array<double>& weights_of_cells() const
  {
    return has_stars_as_cells() ? m_stars.weights : m_weights_of_cells;
  }

  // for each star the sum over its cells
  Array<double> total_stiffness(const Array<double>& stiffness) const
  {
    Array<double> sums(m_stars.size(), 0);
    for(int i = 0; i < m_stars.size(); ++i)
      for(int k = m_cells_of_stars.begin[i]; k < m_cells_of_stars.begin[i + 1]; ++k)
        sums[i] += stiffness[m_cells_of_stars.items[k]];
    return sums;
  }

  // Those of the edges at movable vertices. Most weights are symmetric: then there is nothing to
  // store.
  Array<double> opposite_weights(const Array<double>& weights) const
  {
    // adds up f(e, w) over the edges e with their opposite weights w
    const auto sum = [&](const auto& f) {
      return sum_over_blocks(static_cast<std::size_t>(m_number_of_movable_vertices),
                             [&](std::size_t begin, std::size_t end) {
        int result = 0;
        for(int i = static_cast<int>(begin); i < static_cast<int>(end); ++i)
          for(int e = m_stars.neighbors.begin[i]; e < m_stars.neighbors.begin[i + 1]; ++e)
            result += f(e, weights[m_stars.find(m_stars.neighbors.items[e], i)]);
        return result;
      });
    };
    Array<double> opposite;
    if(sum([&](int e, double w) { return w != weights[e]; }) > 0)
    {
      opposite.resize(static_cast<std::size_t>(
        m_stars.neighbors.begin[m_number_of_movable_vertices]));
      sum([&](int e, double w) {
        opposite[e] = w;
        return 0;
      });
    }
    return opposite;
  }

  Star_view view(const Points& rest, const Points& x, const Array<double>& weights) const
  {
    return {m_stars.neighbors.begin.data(), m_stars.neighbors.items.data(), weights.data(),
            (m_opposite_weights.empty() ? weights : m_opposite_weights).data(), rest, x};
  }

  Stars m_stars;
  Cells m_cells;                // empty if each star is a cell
  Index_lists m_cells_of_stars;
  Array<double> m_opposite_weights; // of the movable vertices; empty if they are the same
  int m_number_of_movable_vertices = 0;
  Index_ranges m_chosen;         // the stars of the cells that count
  Array<double> m_stiffness;     // of the cells, 0 for those that do not count
  Array<double> m_weights_of_cells;
  Array<Matrix_3x3> m_covariances; // of the stars, all that follows too
  Array<Matrix_3x3> m_means;       // of the rotations of its cells
  Array<Matrix_3x3> m_rest_covariances;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_STAR_ENERGY_H
