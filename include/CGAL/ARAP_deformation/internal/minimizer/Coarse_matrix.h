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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_COARSE_MATRIX_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_COARSE_MATRIX_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/energy/Covariance_coefficients.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Coarse_blocks.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Coarse_transfer.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/solver/Laplacian.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// C = P^T (L - sum over cells of A^T K^-1 A) P, half the second derivative of the energy on a
// coarse space of deformations P: A is the change of the axis by which the rotation of a cell
// turns, and K = tr(S) I - S with its covariance S, for which that of the rest shape, turned, is
// taken. Then C is positive semidefinite wherever the shape is, as the energy of each cell is with
// the rotation that follows best. Work is divided into groups of cells and columns, those next to
// each node.
class Coarse_matrix
{
public:
  // what depends on neither positions nor constraints
  Coarse_matrix(const Coarse_transfer& transfer, const Deformation_energy& energy,
                const Sparse_matrix& laplacian)
  {
    find_cells(transfer.space(), energy);
    set_pattern(transfer.space().number_of_nodes(), find_coupled(transfer, energy, laplacian));
  }

  // Computes C at the positions of `transfer` and factorizes it. `matrix` is L with the rows of the
  // constraints.
  bool build(const Coarse_transfer& transfer, const Deformation_energy& energy,
             const Sparse_matrix& matrix, const std::vector<Matrix_3x3>& rotations)
  {
    const Array<char> is_fitted = energy.fitted_cells();
    std::fill_n(m_matrix.valuePtr(), m_matrix.nonZeros(), 0.0);
    constexpr int batch_size = 64; // groups, which are added up in their order
    std::vector<Coarse_blocks> batch(batch_size);
    for(int first = 0; first < m_cells.size(); first += batch_size)
    {
      const int count = (std::min)(batch_size, m_cells.size() - first);
      for_each_task(static_cast<std::size_t>(count), [&](std::size_t k) {
        const int group = first + static_cast<int>(k);
        Array<int> nodes(m_nodes_of.items.begin() + m_nodes_of.begin[group],
                         m_nodes_of.items.begin() + m_nodes_of.begin[group + 1]);
        std::vector<Double4> origins;
        for(int node : nodes)
          origins.push_back(transfer.origin(node));
        batch[k].begin(m_cells.size(), std::move(nodes), std::move(origins));
        subtract_cells(group, energy, is_fitted, rotations, transfer, batch[k]);
        add_columns(group, matrix, transfer, batch[k]);
      });
      for(int k = 0; k < count; ++k)
        add_blocks(transfer, batch[static_cast<std::size_t>(k)]);
    }
    // where the vertices of a node are few, or in a row, some of its motions are the same
    for(int c = 0; c < m_matrix.cols(); ++c)
    {
      double& diagonal = diagonal_entry(m_matrix, c);
      if(!is_finite(diagonal)) // as where positions are too large for single precision
        return false;
      diagonal = diagonal > 0 ? diagonal * (1 + 1e-6) : 1;
    }
    m_is_analyzed = m_is_analyzed || m_solver.analyze(m_matrix);
    return m_is_analyzed && m_solver.factorize(m_matrix);
  }

  // The lower triangle of C, with six unknowns for each node: its translation and rotation vector.
  // The diagonal is raised by a millionth.
  const Sparse_matrix& matrix() const { return m_matrix; }

  // u := C^-1 u, with two vectors for each node
  bool solve(std::vector<Coordinates>& u)
  {
    std::vector<Coordinates> columns(3 * u.size()); // of which two are zero
    for(std::size_t k = 0; k < columns.size(); ++k)
      columns[k] = {u[k / 3][k % 3], 0, 0};
    if(!m_solver.solve(columns.size(), columns.data()))
      return false;
    for(std::size_t k = 0; k < columns.size(); ++k)
      u[k / 3][k % 3] = columns[k][0];
    return true;
  }

private:
  // A cell with more nodes is left out, which only makes the matrix stiffer: where many cells are
  // one rigid part, it would become dense.
  static constexpr std::size_t most_nodes_of_cell = 24;

  // adds those of a vertex to a list of different ones
  static void add_nodes(const Coarse_space& space, int v, Array<int>& nodes)
  {
    if(v < space.number_of_vertices() && space.has_nodes(v))
      for(int k = 0; k < Coarse_space::most_nodes; ++k)
        if(const int node = space.nodes(v)[k];
           std::find(nodes.begin(), nodes.end(), node) == nodes.end())
          nodes.push_back(node);
  }

  // each cell belongs to the node next to one of its vertices
  void find_cells(const Coarse_space& space, const Deformation_energy& energy)
  {
    Index_lists node_of;
    Covariance_coefficients coefficients;
    Array<int> nodes;
    for(int c = 0; c < energy.number_of_cells(); ++c)
    {
      energy.coefficients(c, coefficients);
      nodes.clear();
      for(std::size_t k = 0; k < coefficients.size() && nodes.size() <= most_nodes_of_cell; ++k)
        add_nodes(space, coefficients.vertices[k], nodes);
      if(!nodes.empty() && nodes.size() <= most_nodes_of_cell)
        node_of.items.push_back(nodes[0]);
      node_of.begin.push_back(static_cast<int>(node_of.items.size()));
    }
    m_cells = lists_with(node_of, space.number_of_nodes());
  }

  // Nodes are coupled that move vertices of one cell or column: pairs of these, in order, the
  // smaller one first.
  Array<std::pair<int, int>> find_coupled(const Coarse_transfer& transfer,
                                          const Deformation_energy& energy,
                                          const Sparse_matrix& laplacian)
  {
    const Coarse_space& space = transfer.space();
    const int m = space.number_of_nodes();
    Array<std::pair<int, int>> pairs;
    Array<int> slot_of(m), last_group(m, -1), near;
    Array<char> is_coupled; // for each pair of slots
    const auto couple = [&](int group) {
      for(int& node : near)
      {
        if(last_group[node] != group)
        {
          last_group[node] = group;
          slot_of[node] = static_cast<int>(m_nodes_of.items.size()) - m_nodes_of.begin[group];
          m_nodes_of.items.push_back(node);
          is_coupled.resize(is_coupled.size() + static_cast<std::size_t>(slot_of[node]) + 1, false);
        }
        node = slot_of[node];
      }
      for(int a : near)
        for(int b : near)
          if(a >= b)
            is_coupled[place_of_pair(a, b)] = true;
      near.clear();
    };
    Covariance_coefficients coefficients;
    for(int group = 0; group < m; ++group)
    {
      transfer.for_each_vertex(group, [&](int v) {
        for(Sparse_matrix::InnerIterator entry(laplacian, v); entry; ++entry)
          add_nodes(space, static_cast<int>(entry.row()), near);
        couple(group);
      });
      for(int k = m_cells.begin[group]; k < m_cells.begin[group + 1]; ++k)
      {
        energy.coefficients(m_cells.items[k], coefficients);
        for(int v : coefficients.vertices)
          add_nodes(space, v, near);
        couple(group);
      }
      const int* const nodes = m_nodes_of.items.data() + m_nodes_of.begin[group];
      m_nodes_of.begin.push_back(static_cast<int>(m_nodes_of.items.size()));
      for(int a = 0; a < m_nodes_of.begin[group + 1] - m_nodes_of.begin[group]; ++a)
        for(int b = 0; b <= a; ++b)
          if(is_coupled[place_of_pair(a, b)])
            pairs.push_back(std::minmax({nodes[a], nodes[b]}));
      is_coupled.clear();
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  void set_pattern(int m, const Array<std::pair<int, int>>& pairs)
  {
    m_rows.begin = Array<int>(m + 1, 0);
    for(const auto& [column, row] : pairs)
    {
      m_rows.items.push_back(row);
      m_rows.begin[column + 1] = static_cast<int>(m_rows.items.size());
    }
    m_matrix.resize(6 * m, 6 * m);
    int* const outer = m_matrix.outerIndexPtr();
    for(int c = 0; c < 6 * m; ++c)
      outer[c + 1] = outer[c] + 6 * (m_rows.begin[c / 6 + 1] - m_rows.begin[c / 6]) - c % 6;
    m_matrix.resizeNonZeros(outer[6 * m]);
    int* row = m_matrix.innerIndexPtr();
    for(int c = 0; c < 6 * m; ++c)
      for(int k = m_rows.begin[c / 6]; k < m_rows.begin[c / 6 + 1]; ++k)
        for(int r = 6 * m_rows.items[k]; r < 6 * m_rows.items[k] + 6; ++r)
          if(r >= c)
            *row++ = r;
  }

  void subtract_cells(int group, const Deformation_energy& energy, const Array<char>& is_fitted,
                      const std::vector<Matrix_3x3>& rotations, const Coarse_transfer& transfer,
                      Coarse_blocks& blocks) const
  {
    Covariance_coefficients coefficients;
    std::vector<Coarse_vertex> vertices;
    std::vector<Coordinates> turned;
    for(int k = m_cells.begin[group]; k < m_cells.begin[group + 1]; ++k)
    {
      const int c = m_cells.items[k];
      if(!is_fitted[c])
        continue;
      energy.coefficients(c, coefficients);
      const Matrix_3x3& rotation = rotations[static_cast<std::size_t>(c)];
      vertices.clear();
      turned.clear();
      for(std::size_t i = 0; i < coefficients.size(); ++i)
        if(const int v = coefficients.vertices[i]; v < transfer.space().number_of_vertices())
        {
          const Double4& s = coefficients.vectors[i];
          vertices.push_back(transfer.vertex(v, blocks.slot_of()));
          turned.push_back(product(rotation, Coordinates{s[0], s[1], s[2]}));
        }
      const Matrix_3x3 inverse = inverse_stiffness(energy.rest_covariance(coefficients), rotation);
      if(is_finite(inverse[0]))
        blocks.subtract_cell(vertices, turned, inverse);
    }
  }

  // R K^-1 R^T. K is raised a little: where a cell is a line, all rotations about it are the same.
  static Matrix_3x3 inverse_stiffness(const Matrix_3x3& s, const Matrix_3x3& rotation)
  {
    const double trace = s[0] + s[4] + s[8], raised = trace * (1 + 1e-6);
    const Coordinates k0{raised - s[0], -s[1], -s[2]}, k1{-s[3], raised - s[4], -s[5]},
                      k2{-s[6], -s[7], raised - s[8]};
    const Coordinates rows[] = {cross(k1, k2), cross(k2, k0), cross(k0, k1)};
    const double determinant = dot(k0, rows[0]);
    Matrix_3x3 half{}, result{};
    for(std::size_t r = 0; r < 3; ++r)
      for(std::size_t c = 0; c < 3; ++c)
        for(std::size_t i = 0; i < 3; ++i)
          half[3 * r + c] += rotation[3 * r + i] * rows[i][c] / determinant;
    for(std::size_t r = 0; r < 3; ++r)
      for(std::size_t c = 0; c < 3; ++c)
        for(std::size_t i = 0; i < 3; ++i)
          result[3 * r + c] += half[3 * r + i] * rotation[3 * c + i];
    return result;
  }

  static void add_columns(int group, const Sparse_matrix& matrix, const Coarse_transfer& transfer,
                          Coarse_blocks& blocks)
  {
    std::vector<Coarse_vertex> vertices;
    Array<double> entries;
    transfer.for_each_vertex(group, [&](int v) {
      vertices.clear();
      entries.clear();
      for(Sparse_matrix::InnerIterator entry(matrix, v); entry; ++entry)
      {
        const Coarse_vertex vertex =
          transfer.vertex(static_cast<int>(entry.row()), blocks.slot_of());
        if(std::find(vertex.slots.begin(), vertex.slots.end(), -1) != vertex.slots.end())
          continue; // rows of constraints may couple what nothing else does
        vertices.push_back(vertex);
        entries.push_back(entry.row() == v ? 0.5 * entry.value() : entry.value());
      }
      blocks.add_column(vertices, entries);
    });
  }

  void add_blocks(const Coarse_transfer& transfer, const Coarse_blocks& blocks)
  {
    for(int a = 0; a < blocks.size(); ++a)
      for(int b = 0; b <= a; ++b)
      {
        if(transfer.is_fixed(blocks.node(a)) || transfer.is_fixed(blocks.node(b)))
          continue;
        const auto [column, row] = std::minmax({blocks.node(a), blocks.node(b)});
        const int* const begin = m_rows.items.data() + m_rows.begin[column];
        const int* const end = m_rows.items.data() + m_rows.begin[column + 1];
        const int* const found = std::lower_bound(begin, end, row);
        if(found == end || *found != row)
          continue;
        const Coarse_blocks::Block block = blocks.block(a, b);
        const bool is_transposed = blocks.node(a) != row;
        for(int c = 0; c < 6; ++c)
        {
          double* const value = m_matrix.valuePtr() + m_matrix.outerIndexPtr()[6 * column + c] +
                                6 * (found - begin) - c;
          for(int r = row == column ? c : 0; r < 6; ++r)
            value[r] += block[static_cast<std::size_t>(is_transposed ? 6 * c + r : 6 * r + c)];
        }
      }
  }

  Index_lists m_cells;    // of each group
  Index_lists m_nodes_of; // those that the cells and columns of each group couple
  Index_lists m_rows;     // for each node itself and the later ones that it is coupled with
  Sparse_matrix m_matrix;
  Multifrontal_cholesky_solver m_solver;
  bool m_is_analyzed = false;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_COARSE_MATRIX_H
