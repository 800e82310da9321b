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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_BLOCKS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_BLOCKS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_pattern.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_transfer.h>
#include <CGAL/ARAP_deformation/internal/energy/Covariance_coefficients.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The slots of some nodes, with sums over the vertices of a cell or column, each of w s p^T, with a
// vector s, p = (x, y, z, 1), and the weight w of the vertex at the node.
struct Coarse_slots
{
  const int* slot_of; // each node, -1 for none
  Double4* sums;      // three for each slot, zero where it is not in use
  char* is_used;      // for each slot
  int* used;          // those in use

  // adds a vertex, with one to three entries of s
  template <int Rows>
  CGAL_ARAP_ALWAYS_INLINE void add_moments(const Coarse_view& view, int v, const double* s,
                                           int& number_used) const
  {
    const Double4 point = view.point(v, 1);
    const std::ptrdiff_t first = Coarse_space::most_nodes * std::ptrdiff_t(v);
    for(int k = 0; k < Coarse_space::most_nodes; ++k)
    {
      if(view.weights[first + k] == 0)
        continue;
      const int slot = slot_of[view.nodes[first + k]];
      if(!is_used[slot])
      {
        is_used[slot] = true;
        used[number_used++] = slot;
      }
      const Double4 p = Double4::all(view.weights[first + k]) * point;
      for(int r = 0; r < Rows; ++r)
        sums[3 * slot + r] = multiply_add(Double4::all(s[r]), p, sums[3 * slot + r]);
    }
  }

  // of a slot in use, after add_moments<Rows>()
  template <int Rows>
  CGAL_ARAP_ALWAYS_INLINE void clear(int slot) const
  {
    for(int r = 0; r < Rows; ++r)
      sums[3 * slot + r] = Double4::zero();
    is_used[slot] = false;
  }
};

// What a cell takes from the blocks of its nodes: B_a^T K^-1 B_b, with the derivative B of the axis
// sum of (R s) x (change of x) over its coefficients s, in the translation and the rotation of a
// node. A row of a block has eight numbers: three, a fourth of no meaning, and again.
struct Cell_blocks_kernel
{
  struct Derivative { Double4 translation[3], rotation[3]; };

  CGAL_ARAP_ALWAYS_INLINE static void run(const Coarse_view& view, const int* vertices,
                                          const Double4* vectors, int number_of_vertices,
                                          const double* rotation, const double* inverse,
                                          const Coarse_slots& slots, const Double4* origins,
                                          Derivative* derivatives, double* blocks)
  {
    int n = 0;
    for(int k = 0; k < number_of_vertices; ++k)
      if(view.is_moving(vertices[k]))
      {
        const double s[3] = {vectors[k][0], vectors[k][1], vectors[k][2]};
        slots.add_moments<3>(view, vertices[k], s, n);
      }
    for(int k = 0; k < n; ++k)
    {
      const Double4* const sum = slots.sums + 3 * slots.used[k];
      Double4 d[3];
      for(int r = 0; r < 3; ++r)
      {
        d[r] = Double4::zero(); // of R s instead of s
        for(int q = 0; q < 3; ++q)
          d[r] = multiply_add(Double4::all(rotation[3 * r + q]), sum[q], d[r]);
      }
      const double c0 = d[0][3], c1 = d[1][3], c2 = d[2][3];
      for(int r = 0; r < 3; ++r) // about the node
        d[r] = negative_multiply_add(Double4::all(d[r][3]), origins[slots.used[k]], d[r]);
      const double trace = d[0][0] + d[1][1] + d[2][2];
      derivatives[k] = {{Double4::of(0, -c2, c1), Double4::of(c2, 0, -c0), Double4::of(-c1, c0, 0)},
                        {Double4::of(trace - d[0][0], -d[1][0], -d[2][0]),
                         Double4::of(-d[0][1], trace - d[1][1], -d[2][1]),
                         Double4::of(-d[0][2], -d[1][2], trace - d[2][2])}};
      slots.clear<3>(slots.used[k]);
    }
    for(int k = 0; k < n; ++k)
    {
      Double4 scaled[6]; // K^-1 B_k
      for(int r = 0; r < 3; ++r)
      {
        scaled[r] = scaled[3 + r] = Double4::zero();
        for(int q = 0; q < 3; ++q)
        {
          const Double4 factor = Double4::all(inverse[3 * r + q]);
          scaled[r] = multiply_add(factor, derivatives[k].translation[q], scaled[r]);
          scaled[3 + r] = multiply_add(factor, derivatives[k].rotation[q], scaled[3 + r]);
        }
      }
      for(int l = 0; l < n; ++l)
        if(slots.used[l] <= slots.used[k])
        {
          const Derivative& other = derivatives[l];
          double* row = blocks + 48 * place_of_pair(slots.used[k], slots.used[l]);
          for(int i = 0; i < 6; ++i, row += 8)
          {
            const Double4* const column = scaled + (i < 3 ? 0 : 3);
            Double4 left = Double4::load(row), right = Double4::load(row + 4);
            for(int r = 0; r < 3; ++r)
            {
              const Double4 factor = Double4::all(column[r][i % 3]);
              left = multiply_add(factor, other.translation[r], left);
              right = multiply_add(factor, other.rotation[r], right);
            }
            left.store(row);
            right.store(row + 4);
          }
        }
    }
  }
};

// What a column of a lower triangle adds to the moments of its nodes: the sum of A_ij (w p)(w q)^T
// over its entries and their transposes, with p, q = (x, y, z, 1) of i and j, w of two nodes. The
// first entry is the diagonal one.
struct Column_moments_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Coarse_view& view, const int* rows,
                                          const double* entries, int number_of_entries,
                                          const Coarse_slots& slots, double* moments)
  {
    int n = 0;
    for(int k = 0; k < number_of_entries; ++k)
      if(view.is_moving(rows[k]) && has_slots(view, rows[k], slots.slot_of))
      {
        const double entry = k == 0 ? 0.5 * entries[0] : entries[k];
        slots.add_moments<1>(view, rows[k], &entry, n);
      }
    const Double4 point = view.point(rows[0], 1);
    const std::ptrdiff_t first = Coarse_space::most_nodes * std::ptrdiff_t(rows[0]);
    for(int k = 0; k < Coarse_space::most_nodes; ++k)
    {
      if(view.weights[first + k] == 0)
        continue;
      const int a = slots.slot_of[view.nodes[first + k]];
      const Double4 p = Double4::all(view.weights[first + k]) * point;
      for(int i = 0; i < n; ++i)
      {
        const int b = slots.used[i];
        const Double4 q = slots.sums[3 * b];
        if(a >= b)
          add_product(p, q, moments + 16 * place_of_pair(a, b));
        if(b >= a)
          add_product(q, p, moments + 16 * place_of_pair(b, a));
      }
    }
    for(int i = 0; i < n; ++i)
      slots.clear<1>(slots.used[i]);
  }

private:
  // rows of constraints may couple what nothing else does
  CGAL_ARAP_ALWAYS_INLINE static bool has_slots(const Coarse_view& view, int v, const int* slot_of)
  {
    const int* const nodes = view.nodes + Coarse_space::most_nodes * std::ptrdiff_t(v);
    for(int k = 0; k < Coarse_space::most_nodes; ++k)
      if(slot_of[nodes[k]] < 0)
        return false;
    return true;
  }

  CGAL_ARAP_ALWAYS_INLINE static void add_product(const Double4& p, const Double4& q, double* sum)
  {
    for(int r = 0; r < 4; ++r, sum += 4)
      multiply_add(Double4::all(p[r]), q, Double4::load(sum)).store(sum);
  }
};

// The 6 x 6 blocks that some cells and columns add to a coarse matrix, for each pair of some nodes,
// which have a slot each.
class Coarse_blocks
{
public:
  using Block = std::array<double, 36>; // row by row

  // Forgets all blocks, and gives these nodes slots, of so many; `origins` are their positions.
  void begin(int number_of_nodes, Array<int> nodes, std::vector<Double4> origins)
  {
    m_slot_of.resize(static_cast<std::size_t>(number_of_nodes), -1);
    for(int node : m_nodes)
      m_slot_of[node] = -1;
    m_nodes = std::move(nodes);
    m_origins = std::move(origins);
    const std::size_t n = m_nodes.size(), pairs = n * (n + 1) / 2;
    for(std::size_t slot = 0; slot < n; ++slot)
      m_slot_of[m_nodes[slot]] = static_cast<int>(slot);
    m_is_used.assign(n, false);
    m_used.resize(n);
    m_derivatives.resize(n);
    m_sums.assign(3 * n, Double4::zero());
    m_blocks.assign(48 * pairs, 0);
    m_moments.assign(16 * pairs, 0);
  }

  int size() const { return static_cast<int>(m_nodes.size()); }
  int node(int slot) const { return m_nodes[slot]; }
  const Array<int>& slot_of() const { return m_slot_of; } // each node, -1 for none

  // Subtracts what a cell with the rotation R adds; `inverse` is R K^-1 R^T.
  void subtract_cell(const Coarse_view& view, const Covariance_coefficients& coefficients,
                     const Matrix_3x3& rotation, const Matrix_3x3& inverse)
  {
    run_kernel<Cell_blocks_kernel>(view, coefficients.vertices.data(), coefficients.vectors.data(),
                                   static_cast<int>(coefficients.size()), rotation.data(),
                                   inverse.data(), slots(), m_origins.data(),
                                   m_derivatives.data(), m_blocks.data());
  }

  // adds a column of a lower triangle, whose first entry is that of the diagonal
  void add_column(const Coarse_view& view, const int* rows, const double* entries,
                  int number_of_entries)
  {
    if(view.is_moving(rows[0]))
      run_kernel<Column_moments_kernel>(view, rows, entries, number_of_entries, slots(),
                                        m_moments.data());
  }

  // the block in the rows of slot a and the columns of b, a >= b
  Block block(int a, int b) const
  {
    const double* const m = m_moments.data() + 16 * place_of_pair(a, b);
    const Double4 &ya = m_origins[static_cast<std::size_t>(a)],
                  &yb = m_origins[static_cast<std::size_t>(b)];
    double s[4][4]; // about the nodes
    for(int r = 0; r < 4; ++r)
      for(int c = 0; c < 4; ++c)
        s[r][c] = m[4 * r + c] - m[4 * r + 3] * yb[c] - ya[r] * (m[12 + c] - m[15] * yb[c]);
    const double sum = s[3][3], trace = s[0][0] + s[1][1] + s[2][2];
    Block result = {sum, 0, 0, 0, s[3][2], -s[3][1],
                    0, sum, 0, -s[3][2], 0, s[3][0],
                    0, 0, sum, s[3][1], -s[3][0], 0,
                    0, -s[2][3], s[1][3], trace - s[0][0], -s[1][0], -s[2][0],
                    s[2][3], 0, -s[0][3], -s[0][1], trace - s[1][1], -s[2][1],
                    -s[1][3], s[0][3], 0, -s[0][2], -s[1][2], trace - s[2][2]};
    const double* const cells = m_blocks.data() + 48 * place_of_pair(a, b);
    for(std::size_t r = 0; r < 6; ++r)
      for(std::size_t c = 0; c < 6; ++c)
        result[6 * r + c] -= cells[8 * r + c + c / 3];
    return result;
  }

private:
  Coarse_slots slots()
  {
    return {m_slot_of.data(), m_sums.data(), m_is_used.data(), m_used.data()};
  }

  Array<int> m_slot_of, m_nodes;
  std::vector<Double4> m_origins;          // of the nodes; the fourth lane is 0
  std::vector<double> m_blocks, m_moments; // of each pair: what cells subtract, what columns add
  std::vector<Double4> m_sums;             // scratch, three for each slot
  Array<int> m_used;
  Array<char> m_is_used; // for each slot
  std::vector<Cell_blocks_kernel::Derivative> m_derivatives;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_BLOCKS_H
