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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_COARSE_BLOCKS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_COARSE_BLOCKS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Coarse_transfer.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The sums of w v p^T over the vertices of a cell or column, for each slot: with p = (x, y, z, 1)
// and one to three rows of v.
template <int Rows>
CGAL_ARAP_ALWAYS_INLINE void add_moments(const Coarse_vertex& vertex, const double* v,
                                         Double4* sums)
{
  for(std::size_t k = 0; k < Coarse_space::most_nodes; ++k)
  {
    const Double4 p = Double4::all(vertex.weights[k]) * vertex.point;
    Double4* const sum = sums + 3 * vertex.slots[k];
    for(int r = 0; r < Rows; ++r)
      sum[r] = multiply_add(Double4::all(v[r]), p, sum[r]);
  }
}

// Where the pair of two slots is, the larger one first.
CGAL_ARAP_ALWAYS_INLINE std::ptrdiff_t place_of_pair(int a, int b)
{
  return std::ptrdiff_t(a) * (a + 1) / 2 + b;
}

// What a cell takes from the blocks of its nodes: B_a^T K^-1 B_b, with the derivative B of the axis
// sum of (R s) x (change of x) over its coefficients s, in the translation and the rotation of a
// node. A row of a block has eight numbers: three, a fourth of no meaning, and again.
struct Cell_blocks_kernel
{
  struct Derivative { Double4 translation[3], rotation[3]; };

  CGAL_ARAP_ALWAYS_INLINE static void run(const std::vector<Coarse_vertex>& vertices,
                                          const double* turned, const double* inverse,
                                          const Array<int>& slots, const Double4* origins,
                                          Double4* sums, Derivative* derivatives, double* blocks)
  {
    for(std::size_t k = 0; k < vertices.size(); ++k)
      add_moments<3>(vertices[k], turned + 3 * k, sums);
    const int n = static_cast<int>(slots.size());
    for(int k = 0; k < n; ++k)
    {
      Double4* const sum = sums + 3 * slots[k];
      Double4 d[3]; // about the node
      for(int r = 0; r < 3; ++r)
        d[r] = negative_multiply_add(Double4::all(sum[r][3]), origins[slots[k]], sum[r]);
      const double c0 = sum[0][3], c1 = sum[1][3], c2 = sum[2][3];
      const double trace = d[0][0] + d[1][1] + d[2][2];
      derivatives[k] = {{Double4::of(0, -c2, c1), Double4::of(c2, 0, -c0), Double4::of(-c1, c0, 0)},
                        {Double4::of(trace - d[0][0], -d[1][0], -d[2][0]),
                         Double4::of(-d[0][1], trace - d[1][1], -d[2][1]),
                         Double4::of(-d[0][2], -d[1][2], trace - d[2][2])}};
      for(int r = 0; r < 3; ++r)
        sum[r] = Double4::zero();
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
        if(slots[l] <= slots[k])
        {
          const Derivative& other = derivatives[l];
          double* row = blocks + 48 * place_of_pair(slots[k], slots[l]);
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
// over its entries and their transposes, with p, q = (x, y, z, 1) of i and j, w of two nodes.
struct Column_moments_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const std::vector<Coarse_vertex>& vertices,
                                          const double* entries, const Array<int>& slots,
                                          Double4* sums, double* moments)
  {
    for(std::size_t k = 0; k < vertices.size(); ++k)
      add_moments<1>(vertices[k], entries + k, sums);
    const Coarse_vertex& own = vertices[0];
    for(std::size_t k = 0; k < Coarse_space::most_nodes; ++k)
    {
      const int a = own.slots[k];
      const Double4 p = Double4::all(own.weights[k]) * own.point;
      for(int b : slots)
      {
        const Double4 q = sums[3 * b];
        if(a >= b)
          add_product(p, q, moments + 16 * place_of_pair(a, b));
        if(b >= a)
          add_product(q, p, moments + 16 * place_of_pair(b, a));
      }
    }
    for(int b : slots)
      sums[3 * b] = Double4::zero();
  }

private:
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
    m_is_found.assign(n, false);
    m_sums.assign(3 * n, Double4::zero());
    m_blocks.assign(48 * pairs, 0);
    m_moments.assign(16 * pairs, 0);
  }

  int size() const { return static_cast<int>(m_nodes.size()); }
  int node(int slot) const { return m_nodes[slot]; }
  const Array<int>& slot_of() const { return m_slot_of; } // each node, -1 for none

  // of a cell with these vectors R s of its vertices, and the inverse of its K
  void subtract_cell(const std::vector<Coarse_vertex>& vertices,
                     const std::vector<Coordinates>& turned, const Matrix_3x3& inverse)
  {
    find_slots(vertices);
    m_derivatives.resize(m_slots.size());
    run_kernel<Cell_blocks_kernel>(vertices, turned.data()->data(), inverse.data(), m_slots,
                                   m_origins.data(), m_sums.data(), m_derivatives.data(),
                                   m_blocks.data());
  }

  // The first vertex is that of the diagonal, half of whose entry is given.
  void add_column(const std::vector<Coarse_vertex>& vertices, const Array<double>& entries)
  {
    find_slots(vertices);
    run_kernel<Column_moments_kernel>(vertices, entries.data(), m_slots, m_sums.data(),
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
  // those of some vertices, each once
  void find_slots(const std::vector<Coarse_vertex>& vertices)
  {
    m_slots.clear();
    for(const Coarse_vertex& vertex : vertices)
      for(int slot : vertex.slots)
        if(!m_is_found[slot])
        {
          m_is_found[slot] = true;
          m_slots.push_back(slot);
        }
    for(int slot : m_slots)
      m_is_found[slot] = false;
  }

  Array<int> m_slot_of, m_nodes;
  std::vector<Double4> m_origins;          // of the nodes; the fourth lane is 0
  std::vector<double> m_blocks, m_moments; // of each pair: what cells subtract, what columns add
  std::vector<Double4> m_sums;             // scratch, three for each slot
  Array<int> m_slots;
  Array<char> m_is_found; // for each slot
  std::vector<Cell_blocks_kernel::Derivative> m_derivatives;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_COARSE_BLOCKS_H
