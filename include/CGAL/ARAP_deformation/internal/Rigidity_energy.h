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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_RIGIDITY_ENERGY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_RIGIDITY_ENERGY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/Region.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// the edge sets of all cells: those of cell c are sets[begin[c]] to sets[begin[c + 1] - 1], and
// they share one rotation and the stiffness of the cell
struct Cells
{
  std::vector<int> begin = {0};
  std::vector<int> sets;
  std::vector<double> stiffness;

  int size() const { return static_cast<int>(stiffness.size()); }
};

// each of the first edge sets is a cell
inline Cells separate_cells(int number_of_sets)
{
  Cells cells;
  cells.begin.resize(number_of_sets + 1);
  std::iota(cells.begin.begin(), cells.begin.end(), 0);
  cells.sets.assign(cells.begin.begin(), cells.begin.end() - 1);
  cells.stiffness.assign(number_of_sets, 1);
  return cells;
}

// the simplices at each centre are a cell
inline Cells vertex_cells(const Region& region)
{
  Cells cells;
  cells.begin.assign(region.number_of_centres + 1, 0);
  for(int v : region.corners)
    if(v < region.number_of_centres)
      ++cells.begin[v + 1];
  std::partial_sum(cells.begin.begin(), cells.begin.end(), cells.begin.begin());
  cells.sets.resize(cells.begin.back());
  std::vector<int> next(cells.begin.begin(), cells.begin.end() - 1);
  for(int s = 0; s < region.number_of_simplices(); ++s)
    for(int k = region.first_corner[s]; k < region.first_corner[s + 1]; ++k)
      if(const int v = region.corners[k]; v < region.number_of_centres)
        cells.sets[next[v]++] = s;
  cells.stiffness.assign(region.number_of_centres, 1);
  return cells;
}

// The energy of rigidity
//   E(x, R) = sum over cells c, over edge sets u in c, over edges (i, j) in u of
//             k_c w_ij || (x_i - x_j) - R_c (p_i - p_j) ||^2,
// with p the rest shape and x the current positions.
class Rigidity_energy
{
public:
  Rigidity_energy() = default;

  Rigidity_energy(Edge_sets sets, Cells cells)
    : m_sets(std::move(sets)), m_cells(std::move(cells)),
      m_set_stiffness(m_sets.size(), 0), m_set_covariances(m_sets.size()),
      m_covariances(m_cells.size())
  {
    for(int c = 0; c < m_cells.size(); ++c)
      for(int k = m_cells.begin[c]; k < m_cells.begin[c + 1]; ++k)
        m_set_stiffness[m_cells.sets[k]] += m_cells.stiffness[c];
    for_each_edge([this](const Weighted_edge& e, double stiffness) {
      m_sum_of_weights += std::abs(stiffness * e.weight);
      m_scale += std::abs(stiffness * e.weight) * dot(e.rest, e.rest);
    });
  }

  int number_of_cells() const { return m_cells.size(); }
  int number_of_edge_sets() const { return m_sets.size(); }

  // sum of k w ||e||^2: the natural unit of the energy
  double scale() const { return m_scale; }

  // What rounding the positions x makes of an energy of zero. The residuals are squared, so that it
  // is far below the rounding error of the scale.
  double rounding_error_of_zero(const std::vector<Coordinates>& x) const
  {
    double largest = 0;
    for(const Coordinates& p : x)
      for(double coordinate : p)
        largest = (std::max)(largest, std::abs(coordinate));
    const double error = 4 * std::numeric_limits<double>::epsilon() * largest;
    return m_sum_of_weights * error * error;
  }

  // calls f(edge, k) for each edge of each edge set, with k the stiffness of its cells added up
  template <typename Function>
  void for_each_edge(const Function& f) const
  {
    for(int u = 0; u < m_sets.size(); ++u)
      for(int e = m_sets.begin[u]; e < m_sets.begin[u + 1]; ++e)
        f(m_sets.edges[e], m_set_stiffness[u]);
  }

  // Fits the rotations to the positions x, starting from those given, and returns the energy.
  // `force` becomes minus half the gradient, for each vertex.
  template <typename ClosestRotation>
  double evaluate(const ClosestRotation& closest_rotation, const std::vector<Coordinates>& x,
                  std::vector<Matrix_3x3>& rotations, std::vector<Coordinates>& force)
  {
    compute_covariances(x);
    closest_rotation(rotations.size(), m_covariances.data(), rotations.data());
    return evaluate(x, rotations, force);
  }

  // The same with the rotations given.
  double evaluate(const std::vector<Coordinates>& x, const std::vector<Matrix_3x3>& rotations,
                  std::vector<Coordinates>& force) const
  {
    double energy = 0;
    force.assign(x.size(), Coordinates{0, 0, 0});
    for(int c = 0; c < m_cells.size(); ++c)
    {
      const Matrix_3x3& rotation = rotations[c];
      double cell_energy = 0;
      for(int k = m_cells.begin[c]; k < m_cells.begin[c + 1]; ++k)
      {
        const int u = m_cells.sets[k];
        for(int e = m_sets.begin[u]; e < m_sets.begin[u + 1]; ++e)
        {
          const Weighted_edge& edge = m_sets.edges[e];
          const Coordinates residual = difference(difference(x[edge.i], x[edge.j]),
                                                  product(rotation, edge.rest));
          cell_energy += edge.weight * dot(residual, residual);
          const double factor = m_cells.stiffness[c] * edge.weight;
          add(force[edge.i], -factor, residual);
          add(force[edge.j], factor, residual);
        }
      }
      energy += m_cells.stiffness[c] * cell_energy;
    }
    return energy;
  }

private:
  // for each cell the sum of w (x_i - x_j) (p_i - p_j)^T: its closest rotation minimizes the energy
  void compute_covariances(const std::vector<Coordinates>& x)
  {
    for(int u = 0; u < m_sets.size(); ++u)
    {
      Matrix_3x3& covariance = m_set_covariances[u];
      covariance.fill(0);
      for(int e = m_sets.begin[u]; e < m_sets.begin[u + 1]; ++e)
      {
        const Weighted_edge& edge = m_sets.edges[e];
        const Coordinates d = scaled(difference(x[edge.i], x[edge.j]), edge.weight);
        for(int row = 0; row < 3; ++row)
          for(int column = 0; column < 3; ++column)
            covariance[3 * row + column] += d[row] * edge.rest[column];
      }
    }
    for(int c = 0; c < m_cells.size(); ++c)
    {
      Matrix_3x3& sum = m_covariances[c];
      sum.fill(0);
      for(int k = m_cells.begin[c]; k < m_cells.begin[c + 1]; ++k)
        for(int entry = 0; entry < 9; ++entry)
          sum[entry] += m_set_covariances[m_cells.sets[k]][entry];
    }
  }

  Edge_sets m_sets;
  Cells m_cells;
  std::vector<double> m_set_stiffness;       // for each edge set, its cells' stiffness added up
  std::vector<Matrix_3x3> m_set_covariances; // scratch: for each edge set
  std::vector<Matrix_3x3> m_covariances;     // scratch: for each cell
  double m_scale = 0;
  double m_sum_of_weights = 0;
};

template <typename EdgeWeight>
Rigidity_energy make_rigidity_energy(const EdgeWeight& weight, const Simplex_weights& weights,
                                     Cell_scheme scheme, const Region& region)
{
  if(scheme.edge_set() == Edge_set::star)
    return Rigidity_energy(star_edge_sets(weight, weights, region),
                           separate_cells(region.number_of_centres));
  return Rigidity_energy(simplex_edge_sets(weight, weights, region),
                         scheme.grouped_at_vertices()
                           ? vertex_cells(region)
                           : separate_cells(region.number_of_free_simplices));
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_RIGIDITY_ENERGY_H
