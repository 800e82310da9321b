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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_MATRIX_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_MATRIX_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_blocks.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_pattern.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_transfer.h>
#include <CGAL/ARAP_deformation/internal/energy/Covariance_coefficients.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
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
// taken. Then C is positive semidefinite at all positions, as the energy of each cell is with
// the rotation that follows best. Work is divided into groups of cells and columns, those next to
// each node.
class Coarse_matrix
{
public:
  // what depends on neither positions nor constraints
  Coarse_matrix(const Coarse_transfer& transfer, const Deformation_energy& energy,
                const Sparse_matrix& laplacian)
    : m_pattern(transfer, energy, laplacian)
  {
    if(m_pattern.is_sparse)
      set_pattern(transfer.space().number_of_nodes());
  }

  // Computes C at the positions of `transfer` and factorizes it; false if that is not possible.
  // `matrix` is L with the rows of the constraints.
  bool build(const Coarse_transfer& transfer, const Deformation_energy& energy,
             const Sparse_matrix& matrix, const Array<Matrix_3x3>& rotations)
  {
    if(!m_pattern.is_sparse)
      return false;
    const Array<char> is_fitted = energy.fitted_cells();
    std::fill_n(m_matrix.valuePtr(), m_matrix.nonZeros(), 0.0);
    constexpr int batch_size = 64; // groups, which are added up in their order
    std::vector<Coarse_blocks> batch(batch_size);
    for(int first = 0; first < m_pattern.cells.size(); first += batch_size)
    {
      const int count = (std::min)(batch_size, m_pattern.cells.size() - first);
      for_each_task(static_cast<std::size_t>(count), [&](std::size_t k) {
        const int group = first + static_cast<int>(k);
        const Index_range list = m_pattern.nodes.list(group);
        Array<int> nodes(list.begin(), list.end());
        std::vector<Double4> origins;
        for(int node : nodes)
          origins.push_back(transfer.origin(node));
        batch[k].begin(m_pattern.cells.size(), std::move(nodes), std::move(origins));
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
  bool solve(Array<Coordinates>& u)
  {
    Array<Coordinates> columns(3 * u.size()); // of which two are zero
    for(std::size_t k = 0; k < columns.size(); ++k)
      columns[k] = {u[k / 3][k % 3], 0, 0};
    if(!m_solver.solve(columns.size(), columns.data()))
      return false;
    for(std::size_t k = 0; k < columns.size(); ++k)
      u[k / 3][k % 3] = columns[k][0];
    return true;
  }

private:
  void set_pattern(int m)
  {
    const Index_lists& rows = m_pattern.rows;
    m_matrix.resize(6 * m, 6 * m);
    int* const outer = m_matrix.outerIndexPtr();
    for(int c = 0; c < 6 * m; ++c)
      outer[c + 1] = outer[c] + 6 * (rows.begin[c / 6 + 1] - rows.begin[c / 6]) - c % 6;
    m_matrix.resizeNonZeros(outer[6 * m]);
    int* row = m_matrix.innerIndexPtr();
    for(int c = 0; c < 6 * m; ++c)
      for(int k = rows.begin[c / 6]; k < rows.begin[c / 6 + 1]; ++k)
        for(int r = 6 * rows.items[k]; r < 6 * rows.items[k] + 6; ++r)
          if(r >= c)
            *row++ = r;
  }

  void subtract_cells(int group, const Deformation_energy& energy, const Array<char>& is_fitted,
                      const Array<Matrix_3x3>& rotations, const Coarse_transfer& transfer,
                      Coarse_blocks& blocks) const
  {
    Covariance_coefficients coefficients;
    for(int k = m_pattern.cells.begin[group]; k < m_pattern.cells.begin[group + 1]; ++k)
    {
      const int c = m_pattern.cells.items[k];
      if(!is_fitted[c])
        continue;
      energy.coefficients(c, coefficients);
      const Matrix_3x3& rotation = rotations[c];
      const Matrix_3x3 inverse = inverse_stiffness(energy.rest_covariance(coefficients), rotation);
      if(is_finite(inverse[0]))
        blocks.subtract_cell(transfer.view(), coefficients, rotation, inverse);
    }
  }

  // R K^-1 R^T. K is raised a little: where a cell is a line, all rotations about it are the same.
  static Matrix_3x3 inverse_stiffness(const Matrix_3x3& s, const Matrix_3x3& rotation)
  {
    const double trace = s[0] + s[4] + s[8], raised = trace * (1 + 1e-6);
    const Coordinates k0{raised - s[0], -s[1], -s[2]}, k1{-s[3], raised - s[4], -s[5]},
                      k2{-s[6], -s[7], raised - s[8]};
    const Coordinates rows[] = {cross(k1, k2), cross(k2, k0), cross(k0, k1)};
    const double factor = 1 / dot(k0, rows[0]);
    Matrix_3x3 inverse;
    for(std::size_t entry = 0; entry < 9; ++entry)
      inverse[entry] = factor * rows[entry / 3][entry % 3];
    return product(rotation, product_with_transpose(inverse, rotation));
  }

  static void add_columns(int group, const Sparse_matrix& matrix, const Coarse_transfer& transfer,
                          Coarse_blocks& blocks)
  {
    for(int v : transfer.vertices_of(group))
    {
      const int begin = matrix.outerIndexPtr()[v], end = matrix.outerIndexPtr()[v + 1];
      blocks.add_column(transfer.view(), matrix.innerIndexPtr() + begin,
                        matrix.valuePtr() + begin, end - begin);
    }
  }

  void add_blocks(const Coarse_transfer& transfer, const Coarse_blocks& blocks)
  {
    for(int a = 0; a < blocks.size(); ++a)
      for(int b = 0; b <= a; ++b)
      {
        if(transfer.is_fixed(blocks.node(a)) || transfer.is_fixed(blocks.node(b)))
          continue;
        const auto [column, row] = std::minmax({blocks.node(a), blocks.node(b)});
        const int* const begin = m_pattern.rows.items.data() + m_pattern.rows.begin[column];
        const int* const end = m_pattern.rows.items.data() + m_pattern.rows.begin[column + 1];
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

  Coarse_pattern m_pattern;
  Sparse_matrix m_matrix;
  Multifrontal_cholesky_solver m_solver;
  bool m_is_analyzed = false;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_MATRIX_H
