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

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/energy/Bending.h>
#include <CGAL/ARAP_deformation/internal/energy/Covariance_coefficients.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/energy/Rotation_derivative.h>
#include <CGAL/ARAP_deformation/internal/energy/Rotation_groups.h>
#include <CGAL/ARAP_deformation/internal/energy/Rotation_steps.h>
#include <CGAL/ARAP_deformation/internal/energy/Sequential_fit.h>
#include <CGAL/ARAP_deformation/internal/energy/Simplex_energy.h>
#include <CGAL/ARAP_deformation/internal/energy/Smooth_rotations.h>
#include <CGAL/ARAP_deformation/internal/energy/Star_energy.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>
#include <CGAL/ARAP_deformation/internal/region/Index_ranges.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/Closest_rotations.h>
#include <CGAL/ARAP_deformation/internal/simd/Points.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/matrix_3x3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The energy that is minimized, but for the rows of the constraints: the rigidity
//   E(x, R) = sum over cells c, over edge sets u in c, over edges (i, j) in u of
//             k_c w_ij || (x_i - x_j) - R_c (p_i - p_j) ||^2,
// with p the rest shape and x the current positions, bending, and smooth rotations. Cells in which
// nothing moves do not count. All loops run over flat arrays, block by block and in parallel.
class Deformation_energy
{
public:
  // `cells` is a Star_energy or a Simplex_energy. The rest shape stays where it is.
  template <typename CellEnergy>
  Deformation_energy(CellEnergy cells, const Array<Coordinates>& rest,
                     int number_of_movable_vertices)
    : m_cells(std::move(cells)), m_number_of_movable_vertices(number_of_movable_vertices),
      m_rest(rest)
  {}

  void set_bending(Bending bending) { m_bending = std::move(bending); }
  void set_smooth_rotations(Smooth_rotations smooth) { m_smooth = std::move(smooth); }
  void set_sequential_fit(Sequential_fit fit) { m_sequential_fit = std::move(fit); }

  void set_groups(Index_lists groups)
  {
    m_groups = Rotation_groups(std::move(groups), number_of_cells());
  }

  void set_given_rotations(std::vector<std::pair<int, Matrix_3x3>> given)
  {
    m_groups.give(std::move(given));
  }

  // rotations that there are not yet become identities
  void complete(Array<Matrix_3x3>& rotations) const
  {
    rotations.resize(static_cast<std::size_t>(number_of_cells()), identity_matrix());
  }

  // What does not count has the identity.
  void clear_others(Array<Matrix_3x3>& rotations) const
  {
    for(std::size_t c = 0; c < m_is_chosen.size(); ++c)
      if(!m_is_chosen[c])
        rotations[c] = identity_matrix();
  }

  // whether the fit depends on the rotations before
  bool are_rotations_state() const { return !m_smooth.is_none(); }

  int number_of_movable_vertices() const { return m_number_of_movable_vertices; }

  int number_of_cells() const
  {
    return std::visit([](const auto& cells) { return cells.number_of_cells(); }, m_cells);
  }

  // Says which of the movable vertices are fixed. Only cells in which something moves count from
  // now on, unless `are_all_cells_counted`; the others cost nothing.
  void set_fixed(const Array<char>& is_fixed, bool are_all_cells_counted)
  {
    const auto is_free = [&](int v) { return v < m_number_of_movable_vertices && !is_fixed[v]; };
    Array<char> is_chosen(static_cast<std::size_t>(number_of_cells()));
    std::visit([&](const auto& cells) {
      for(int c = 0; c < cells.number_of_cells(); ++c)
        is_chosen[c] =
          are_all_cells_counted || are_rotations_state() || cells.is_moving(c, is_free);
    }, m_cells);
    m_groups.for_each_group([&](const int* begin, const int* end) {
      if(std::any_of(begin, end, [&](int c) { return is_chosen[c] != 0; }))
        std::for_each(begin, end, [&](int c) { is_chosen[c] = true; });
    });
    m_number_of_free_vertices = static_cast<int>(std::count(is_fixed.begin(), is_fixed.end(), 0));
    if(is_chosen != m_is_chosen)
    {
      m_is_chosen.clear(); // until all is done: what follows may throw
      std::visit([&](auto& cells) { cells.choose_cells(is_chosen); }, m_cells);
      if(!m_bending.is_none())
        m_bending.choose_cells(is_chosen);
      m_batches.choose(number_of_cells(), [&](int c) { return is_chosen[c] != 0; }, batch_size);
      measure(is_chosen);
      m_is_chosen = std::move(is_chosen);
    }
  }

  // the bounding box of the points of all vertices that cells that count are at
  Bounding_box bounding_box(const Points& points) const
  {
    return sum_over_blocks(m_is_in_cell.size(), [&](std::size_t begin, std::size_t end) {
      Bounding_box box;
      for(std::size_t v = begin; v < end; ++v)
        if(const Double4 point = points[static_cast<int>(v)]; m_is_in_cell[v])
          box.include(Coordinates{point[0], point[1], point[2]});
      return box;
    });
  }

  // the natural unit of the energy: the sum of k |w| ||e||^2 over the cells that count, at rest
  double scale() const { return m_scale; }

  // the same, enlarged with the square of the size of what positions and targets span, if that is
  // larger
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
  // larger than those of the edges, the point is at its target. But those of inertia, with this
  // sum, count: they can be large at all vertices.
  double rounding_level(const Bounding_box& box, double inertia) const
  {
    const double error = 4 * rounding_error(box);
    return (m_sum_of_weights + inertia) * error * error + m_smooth.rounding_level();
  }

  // what rounding the positions makes of the force at a free vertex, on average
  double rounding_error_of_force(const Bounding_box& box, double inertia) const
  {
    return (m_sum_of_weights + inertia) * rounding_error(box) /
           (std::max)(1, m_number_of_free_vertices);
  }

  // Calls f(i, j, w) for each edge of each edge set, with the stiffness of its cells in the weight,
  // and for edges whose Laplacian is the matrix of the bending.
  template <typename Function>
  void for_each_edge(const Function& f) const
  {
    std::visit([&f](const auto& cells) { cells.for_each_edge(f); }, m_cells);
    m_bending.for_each_edge(f);
  }

  // whether no edge set has a negative energy, up to rounding
  bool is_sum_of_squares() const
  {
    return std::visit([](const auto& cells) { return cells.is_sum_of_squares(); }, m_cells);
  }

  // in a cell: a bending length that is too long is found by its size
  int find_vertex_of_non_finite_weight() const
  {
    return std::visit(
      [](const auto& cells) { return internal::find_vertex_of_non_finite_weight(cells); }, m_cells);
  }

  // Fits the rotations to the positions x, starting from those given, or identities where there are
  // none yet, and returns the energy.
  // `force`, unless it is nullptr, becomes minus half the gradient for each free vertex, and
  // anything for a fixed one.
  // Without `is_smooth` rotations are fitted as if they need not be smooth.
  double fit_and_evaluate(const Closest_rotations& closest_rotations,
                          const Array<Coordinates>& x, Array<Matrix_3x3>& rotations,
                          Array<Coordinates>* force, bool is_smooth = true)
  {
    complete(rotations);
    prepare_covariances(x);
    m_smooth.keep(rotations);
    const bool has_steps = is_smooth && m_number_of_rotation_steps > 0;
    const bool are_covariances_kept = has_steps || !m_groups.is_none();
    if(are_covariances_kept)
      m_covariances.resize(static_cast<std::size_t>(number_of_cells()));
    const auto compute_covariances = [&](int begin, int end, Matrix_3x3* covariances) {
      covariances_of_cells(x, begin, end, covariances);
      if(are_covariances_kept)
        std::copy_n(covariances, end - begin, m_covariances.data() + begin);
      if(is_smooth)
        m_smooth.add_covariances(begin, end, covariances);
    };
    for(int c : m_sequential_fit.order())
    {
      Matrix_3x3 covariance;
      compute_covariances(c, c + 1, &covariance);
      m_sequential_fit.add_covariance(c, rotations, covariance);
      closest_rotations(1, &covariance, &rotations[c]);
    }
    if(m_sequential_fit.is_none())
      m_batches.for_each([&](int begin, int end) {
        std::array<Matrix_3x3, batch_size> covariances;
        compute_covariances(begin, end, covariances.data());
        closest_rotations(static_cast<std::size_t>(end - begin), covariances.data(),
                          rotations.data() + begin);
      });
    m_groups.for_each_group([&](const int* begin, const int* end) {
      if(!m_is_chosen[*begin])
        return;
      const Matrix_3x3 sum = sum_of_kept_covariances(begin, end, is_smooth);
      closest_rotations(1, &sum, &rotations[*begin]);
      m_groups.set(*begin, rotations[*begin], rotations);
    });
    for(const auto& [c, rotation] : m_groups.given())
      if(m_is_chosen[c])
        m_groups.set(c, rotation, rotations);
    for(int k = 0; has_steps && k < m_number_of_rotation_steps; ++k)
      if(!m_rotation_steps->take(m_smooth, m_covariances, rotations))
        break;
    return evaluate_prepared(x, rotations, force);
  }

  // Prepares steps of all rotations together, where they are to be smooth and given rotations are
  // known. Each fit takes so many from now on.
  void prepare_rotation_steps(const Linear_solver& prototype, int steps_of_a_fit)
  {
    const int n = number_of_cells();
    if(!m_rotation_steps)
    {
      compute_covariances(m_rest);
      Array<int> leader(n);
      Array<double> bounds(n);
      for(int c = 0; c < n; ++c)
      {
        leader[c] = m_groups.leader(c);
        bounds[c] = m_covariances[c][0] + m_covariances[c][4] + m_covariances[c][8];
      }
      m_rotation_steps.emplace(prototype.copy(), m_smooth, std::move(leader), bounds);
    }
    Array<int> given;
    for(const auto& cell : m_groups.given())
      given.push_back(cell.first);
    if(!m_rotation_steps->set_given(given))
      return clear_rotation_steps();
    m_number_of_rotation_steps = steps_of_a_fit;
  }

  // Until they are prepared again no steps are taken.
  void pause_rotation_steps() { m_number_of_rotation_steps = -1; }

  void clear_rotation_steps()
  {
    m_rotation_steps.reset();
    pause_rotation_steps();
  }

  // about by how much a step of all rotations together would lower the energy at the positions x;
  // 0 if none is prepared
  double gain_of_rotation_step(const Array<Coordinates>& x,
                               const Array<Matrix_3x3>& rotations)
  {
    if(m_number_of_rotation_steps < 0)
      return 0;
    compute_covariances(x);
    return m_rotation_steps->gain(m_smooth, m_covariances, rotations);
  }

  // The energy and the force with the rotations given.
  double evaluate(const Array<Coordinates>& x, Array<Matrix_3x3>& rotations,
                  Array<Coordinates>& force)
  {
    complete(rotations);
    m_bending.prepare(x);
    return evaluate_prepared(x, rotations, &force);
  }

  // Prepares change_of_force() at positions x that the rotations are fitted to. Not where these are
  // state: they depend on each other.
  void prepare_second_derivative(const Array<Coordinates>& x,
                                 const Array<Matrix_3x3>& rotations)
  {
    m_derivatives.assign(rotations.size(), Rotation_derivative());
    m_changes.assign(rotations.size(), Matrix_3x3{}); // where rotations do not change it stays zero
    m_is_fitted = fitted_cells();
    for_each_fitted_cell(x, [&](int c, const Matrix_3x3& covariance) {
      m_derivatives[c] = Rotation_derivative(covariance, rotations[c]);
    });
  }

  // How the force changes with the positions, to first order; for free vertices. `step` is zero at
  // all others. The force is linear in positions and rotations together.
  void change_of_force(const Array<Coordinates>& step,
                       const Array<Matrix_3x3>& rotations, Array<Coordinates>& change)
  {
    for_each_fitted_cell(step, [&](int c, const Matrix_3x3& covariance) {
      const auto k = static_cast<std::size_t>(c);
      m_groups.set(c, m_derivatives[c](covariance, rotations[k]), m_changes);
    });
    evaluate_prepared(step, m_changes, &change);
  }

  void clear_second_derivative()
  {
    m_derivatives = Array<Rotation_derivative>();
    m_changes = Array<Matrix_3x3>();
    m_is_fitted = Array<char>();
  }

  // For each cell whether its rotation is fitted, to its own covariance or, for the first cell of a
  // group, to that of the group.
  Array<char> fitted_cells() const { return m_groups.fitted_cells(m_is_chosen); }

  // The covariance that the rotation of a cell is fitted to, as a function of the positions; for
  // the first cell of a group that of the group, for the others nothing.
  void coefficients(int c, Covariance_coefficients& result) const
  {
    result.clear();
    std::visit([&](const auto& cells) {
      if(c == m_groups.leader(c))
        m_groups.for_each_of_group(c, [&](int cell) {
          cells.add_coefficients(cell, m_rest, result);
          m_bending.add_coefficients(cell, result);
        });
    }, m_cells);
  }

  // its value in the rest shape
  Matrix_3x3 rest_covariance(const Covariance_coefficients& coefficients) const
  {
    Matrix_rows sum = Matrix_rows::zero();
    for(std::size_t k = 0; k < coefficients.size(); ++k)
      sum.add_outer_product(m_rest[coefficients.vertices[k]],
                            coefficients.vectors[k]);
    Matrix_3x3 result;
    sum.store(result);
    return result;
  }

private:
  static constexpr int batch_size = 256; // cells whose covariances fit in a core's cache

  // the sums of what the chosen cells depend on, in the rest shape
  void measure(const Array<char>& is_chosen)
  {
    std::visit([&](const auto& cells) {
      const Edge_sums sums = cells.edge_sums(m_rest) + m_bending.sums();
      m_sum_of_weights = sums.weights;
      m_scale = sums.squares;
      m_is_in_cell = cells.vertices_of(is_chosen);
    }, m_cells);
    m_squared_length = bounding_box(m_rest).squared_length();
  }

  static double rounding_error(const Bounding_box& box) // of a position
  {
    return std::numeric_limits<double>::epsilon() * box.largest_coordinate();
  }

  // the covariances of all cells for some positions, without what makes them smooth
  void compute_covariances(const Points& x)
  {
    m_covariances.resize(static_cast<std::size_t>(number_of_cells()));
    prepare_covariances(x);
    m_batches.for_each([&](int begin, int end) {
      covariances_of_cells(x, begin, end, m_covariances.data() + begin);
    });
  }

  // Calls f(c, S) for each cell that counts whose rotation is fitted to its own covariance S alone,
  // at the positions x, and for the first one of each group with the sum of theirs; as m_is_fitted
  // has them.
  // It is no template: for each f there would be another copy of its loops.
  void for_each_fitted_cell(const Points& x,
                            const std::function<void(int, const Matrix_3x3&)>& f)
  {
    if(!m_groups.is_none())
      m_covariances.resize(static_cast<std::size_t>(number_of_cells()));
    prepare_covariances(x);
    m_batches.for_each([&](int begin, int end) {
      std::array<Matrix_3x3, batch_size> covariances;
      covariances_of_cells(x, begin, end, covariances.data());
      if(!m_groups.is_none())
        std::copy_n(covariances.data(), end - begin, m_covariances.data() + begin);
      for(int c = begin; c < end; ++c)
        if(m_is_fitted[c] && m_groups.is_alone(c))
          f(c, covariances[static_cast<std::size_t>(c - begin)]);
    });
    m_groups.for_each_group([&](const int* begin, const int* end) {
      if(m_is_fitted[*begin])
        f(*begin, sum_of_kept_covariances(begin, end, false));
    });
  }

  // to be called before the covariances of cells are asked for at these positions
  void prepare_covariances(const Points& x)
  {
    m_bending.prepare(x);
    std::visit([&](auto& cells) { cells.prepare_covariances(m_rest, x); }, m_cells);
  }

  // Of the cells in [begin, end), without what makes them smooth. The only place that asks which
  // kind of cells there is: else all loops over cells would be compiled for each.
  void covariances_of_cells(const Points& x, int begin, int end, Matrix_3x3* covariances) const
  {
    std::visit([&](const auto& cells) {
      cells.compute_covariances(m_rest, x, begin, end, covariances);
    }, m_cells);
    m_bending.add_covariances(begin, end, covariances);
  }

  // at positions that the bending is prepared for
  double evaluate_prepared(const Points& x, const Array<Matrix_3x3>& rotations,
                           Array<Coordinates>* force)
  {
    if(force)
      force->resize(static_cast<std::size_t>(m_number_of_movable_vertices));
    Coordinates* const forces = force ? force->data() : nullptr;
    const double rigidity = std::visit([&](auto& cells) {
      return cells.evaluate(m_rest, x, rotations.data(), forces);
    }, m_cells);
    return rigidity + m_bending.evaluate(rotations.data(), forces) + m_smooth.evaluate(rotations);
  }

  // of the cells of a group
  Matrix_3x3 sum_of_kept_covariances(const int* begin, const int* end, bool is_smooth) const
  {
    Matrix_3x3 sum{};
    for(const int* c = begin; c != end; ++c)
    {
      Matrix_3x3 covariance = m_covariances[*c];
      if(is_smooth)
        m_smooth.add_covariances(*c, *c + 1, &covariance);
      add(sum, 1, covariance);
    }
    return sum;
  }

  std::variant<Star_energy, Simplex_energy> m_cells;
  Bending m_bending;
  Smooth_rotations m_smooth;
  Sequential_fit m_sequential_fit; // then there are no groups
  Rotation_groups m_groups;
  int m_number_of_movable_vertices = 0;
  int m_number_of_free_vertices = 0;
  Array<char> m_is_chosen;  // for each cell whether it counts
  Array<char> m_is_in_cell; // for each of the first vertices: is a cell that counts there
  Index_ranges m_batches;   // of the cells that count
  Points m_rest;
  double m_scale = 0;          // in the rest shape
  double m_squared_length = 0; // of the diagonal of the box of the vertices in these cells
  double m_sum_of_weights = 0;
  std::optional<Rotation_steps> m_rotation_steps; // with the factor of a run before
  Array<Matrix_3x3> m_covariances;                // for these, and for groups
  Array<Rotation_derivative> m_derivatives;       // of all cells; empty if not prepared
  Array<Matrix_3x3> m_changes;                    // of the rotations
  Array<char> m_is_fitted;                        // for each cell, with these
  int m_number_of_rotation_steps = -1;            // of each fit; negative if not prepared
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_DEFORMATION_ENERGY_H
