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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_DEFORMATION_ENERGY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_DEFORMATION_ENERGY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_weight_model.h>
#include <CGAL/ARAP_deformation/internal/energy/Simplex_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/Star_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/weighted_edge_sets.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>
#include <CGAL/ARAP_deformation/internal/region/Index_ranges.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/Closest_rotations.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The rigidity, the first sum of the energy that is minimized,
//   E(x, R) = sum over cells c, over edge sets u in c, over edges (i, j) in u of
//             k_c w_ij || (x_i - x_j) - R_c (p_i - p_j) ||^2,
// with p the rest shape and x the current positions. Cells in which nothing moves do not count. All
// loops run over flat arrays, block by block and in parallel.
class Deformation_energy
{
public:
  Deformation_energy() = default;

  // `cells` is a Star_energy or a Simplex_energy
  template <typename CellEnergy>
  Deformation_energy(CellEnergy cells, const std::vector<Coordinates>& rest,
                     int number_of_movable_vertices)
    : m_cells(std::move(cells)), m_number_of_movable_vertices(number_of_movable_vertices)
  {
    assign(m_rest, rest);
  }

  int number_of_movable_vertices() const { return m_number_of_movable_vertices; }

  int number_of_cells() const
  {
    return std::visit([](const auto& cells) { return cells.number_of_cells(); }, m_cells);
  }

  // Says which of the movable vertices are fixed. Only cells in which something moves count from
  // now on, unless `are_all_cells_counted`; the others cost nothing, and their rotations become
  // identities.
  void set_fixed(const Array<char>& is_fixed, bool are_all_cells_counted,
                 std::vector<Matrix_3x3>& rotations)
  {
    const auto is_free = [&](int v) { return v < m_number_of_movable_vertices && !is_fixed[v]; };
    Array<char> is_chosen(static_cast<std::size_t>(number_of_cells()));
    std::visit([&](const auto& cells) {
      for(int c = 0; c < cells.number_of_cells(); ++c)
      {
        is_chosen[c] = are_all_cells_counted || cells.is_moving(c, is_free);
        if(!is_chosen[c])
          rotations[static_cast<std::size_t>(c)] = identity_matrix();
      }
    }, m_cells);
    m_number_of_free_vertices = static_cast<int>(std::count(is_fixed.begin(), is_fixed.end(), 0));
    if(is_chosen == m_is_chosen)
      return;
    std::visit([&](auto& cells) { cells.choose_cells(is_chosen); }, m_cells);
    m_batches.choose(number_of_cells(), [&](int c) { return is_chosen[c] != 0; }, batch_size);
    m_is_chosen = std::move(is_chosen);
    measure();
  }

  // the bounding box of the points of all vertices that cells that count are at
  Bounding_box bounding_box(const std::vector<Coordinates>& points) const
  {
    Bounding_box box;
    for(std::size_t v = 0; v < m_is_in_cell.size(); ++v)
      if(m_is_in_cell[v])
        box.include(points[v]);
    return box;
  }

  // The natural unit of the energy: the sum of k |w| ||e||^2 in the rest shape, enlarged with the
  // square of the size of what positions and targets span, if that is larger.
  double scale(const Bounding_box& box) const
  {
    const double size = box.squared_length();
    if(size <= m_squared_length)
      return m_scale;
    const double ratio = size / m_squared_length; // infinite for a rest shape in one point
    return is_finite(ratio) ? m_scale * ratio : m_sum_of_weights * size;
  }

  // What rounding the positions makes of an energy of zero. The residuals are squared, so that it
  // is far below the rounding error of the scale. The weights of rows do not count: where one is
  // larger than those of the edges, the point is at its target.
  double rounding_level(const Bounding_box& box) const
  {
    const double error = 4 * rounding_error(box);
    return m_sum_of_weights * error * error;
  }

  // what rounding the positions makes of the force at a free vertex, on average
  double rounding_error_of_force(const Bounding_box& box) const
  {
    return m_sum_of_weights * rounding_error(box) / (std::max)(1, m_number_of_free_vertices);
  }

  // calls f(i, j, w) for each edge of each edge set; the stiffness of its cells is in the weight
  template <typename Function>
  void for_each_edge(const Function& f) const
  {
    std::visit([&f](const auto& cells) { cells.for_each_edge(f); }, m_cells);
  }

  // whether no edge set has a negative energy, up to rounding
  bool is_sum_of_squares() const
  {
    return std::visit([](const auto& cells) { return cells.is_sum_of_squares(); }, m_cells);
  }

  // a vertex with an edge whose weight is not finite, or -1
  int find_vertex_of_non_finite_weight() const
  {
    int vertex = -1;
    const auto& weights = std::visit(
      [](const auto& cells) -> const Array<double>& { return cells.weights(); }, m_cells);
    if(!std::all_of(weights.begin(), weights.end(), [](double w) { return is_finite(w); }))
      for_each_edge([&](int i, int, double weight) {
        if(!is_finite(weight))
          vertex = i;
      });
    return vertex;
  }

  // Fits the rotations to the positions x, starting from those given, and returns the energy.
  // `force` becomes minus half the gradient for each free vertex, and anything for a fixed one.
  double fit_and_evaluate(const Closest_rotations& closest_rotations,
                          const std::vector<Coordinates>& x, std::vector<Matrix_3x3>& rotations,
                          std::vector<Coordinates>& force)
  {
    assign(m_x, x);
    std::visit([&](auto& cells) {
      cells.prepare_covariances(m_rest.data(), m_x.data());
      m_batches.for_each([&](int begin, int end) {
        std::array<Matrix_3x3, batch_size> covariances;
        cells.compute_covariances(m_rest.data(), m_x.data(), begin, end, covariances.data());
        closest_rotations(static_cast<std::size_t>(end - begin), covariances.data(),
                          rotations.data() + begin);
      });
    }, m_cells);
    return evaluate(rotations, force);
  }

  // The same with the rotations given.
  double evaluate(const std::vector<Coordinates>& x, const std::vector<Matrix_3x3>& rotations,
                  std::vector<Coordinates>& force)
  {
    assign(m_x, x);
    return evaluate(rotations, force);
  }

private:
  static constexpr int batch_size = 256; // cells whose covariances fit in a core's cache

  // of the cells that count, in the rest shape
  void measure()
  {
    std::visit([&](const auto& cells) {
      const Edge_sums sums = cells.edge_sums(m_rest.data());
      m_sum_of_weights = sums.weights;
      m_scale = sums.squares;
      m_is_in_cell = cells.vertices_of(m_is_chosen);
    }, m_cells);
    Bounding_box box;
    for(std::size_t v = 0; v < m_is_in_cell.size(); ++v)
      if(m_is_in_cell[v])
        box.include(Coordinates{m_rest[v][0], m_rest[v][1], m_rest[v][2]});
    m_squared_length = box.squared_length();
  }

  static double rounding_error(const Bounding_box& box) // of a position
  {
    return std::numeric_limits<double>::epsilon() * box.largest_coordinate();
  }

  // points, with a fourth coordinate that is zero, so that each is loaded at once
  static void assign(std::vector<Double4>& padded, const std::vector<Coordinates>& points)
  {
    padded.resize(points.size());
    for_each_block(points.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t k = begin; k < end; ++k)
        padded[k] = Double4::of(points[k][0], points[k][1], points[k][2]);
    }, 16 * default_block_size);
  }

  // at the positions m_x
  double evaluate(const std::vector<Matrix_3x3>& rotations, std::vector<Coordinates>& force)
  {
    force.resize(static_cast<std::size_t>(m_number_of_movable_vertices));
    return std::visit([&](auto& cells) {
      return cells.evaluate(m_rest.data(), m_x.data(), rotations.data(), force.data());
    }, m_cells);
  }

  std::variant<Star_energy, Simplex_energy> m_cells;
  int m_number_of_movable_vertices = 0;
  int m_number_of_free_vertices = 0;
  Array<char> m_is_chosen;  // for each cell whether it counts
  Array<char> m_is_in_cell; // for each of the first vertices: is a cell that counts there
  Index_ranges m_batches;   // of the cells that count
  std::vector<Double4> m_rest;
  std::vector<Double4> m_x;    // of the last evaluation
  double m_scale = 0;          // in the rest shape
  double m_squared_length = 0; // of the diagonal of the bounding box of the rest shape
  double m_sum_of_weights = 0;
};

inline Deformation_energy make_deformation_energy(const Edge_weight_model& model,
                                                  Simplices simplices, Cell_scheme scheme,
                                                  const Region& region)
{
  const int n = region.number_of_movable_vertices;
  if(scheme.edge_set() == Edge_set::star)
    return Deformation_energy(Star_energy(star_edge_sets(model, simplices, region), n), region.rest,
                              n);
  simplices = simplex_edge_sets(model, std::move(simplices), region);
  Cells cells = scheme.grouped_at_vertices()
                  ? vertex_cells(simplices.corners, region.number_of_centres)
                  : separate_cells(region.number_of_movable_simplices);
  return Deformation_energy(Simplex_energy(std::move(simplices), std::move(cells), n), region.rest,
                            n);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_DEFORMATION_ENERGY_H
