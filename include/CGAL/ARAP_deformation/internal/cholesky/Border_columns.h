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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDER_COLUMNS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDER_COLUMNS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_substitution.h>
#include <CGAL/ARAP_deformation/internal/cholesky/dense_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/elimination_tree.h>
#include <CGAL/ARAP_deformation/internal/cholesky/substitution_kernels.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The rows of a supernode in some columns of W, and in a vector with four numbers for each row.
template <typename Number>
struct Border_rows
{
  const double* border;
  std::size_t stride; // from row to row of the border
  Number* vector;
  int size;
};

// sums := the products of eight columns with the vector
struct Multiply_border
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void run(const std::vector<Border_rows<Number>>& rows,
                                          double* sums)
  {
    Double4 sum[8];
    for(int l = 0; l < 8; ++l)
      sum[l] = Double4::zero();
    for(const Border_rows<Number>& r : rows)
      for(int k = 0; k < r.size; ++k)
      {
        const Double4 row = Double4::load(r.vector + 4 * k);
        for(int l = 0; l < 8; ++l)
          sum[l] = multiply_add(Double4::all(r.border[k * r.stride + l]), row, sum[l]);
      }
    for(int l = 0; l < 8; ++l)
      sum[l].store(sums + 4 * l);
  }
};

// vector := vector - the columns times their factors, of which there are four for each column
struct Subtract_border
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void run(const Border_rows<Number>& r, const double* factors)
  {
    using Row = Vector4<Number>;
    for(int k = 0; k < r.size; ++k)
    {
      Row row = Row::load(r.vector + 4 * k);
      const double* const border = r.border + k * r.stride;
      for(std::size_t l = 0; l < r.stride; ++l)
        row = negative_multiply_add(Row::all(static_cast<Number>(border[l])),
                                    Row::load(factors + 4 * l), row);
      row.store(r.vector + 4 * k);
    }
  }
};

// The columns W = L^-1 P B of a border B of a factorized matrix. They are sorted, so that columns
// that begin near each other in the elimination tree stand together, and padded with zeros to a
// multiple of eight. For each supernode that the tree reaches from an entry of B, the rows of W are
// stored from the first to the last column that reaches it, row by row.
template <typename Number>
class Border_columns
{
public:
  void compute(const Supernodal_structure& structure, const Number* values, const Sparse_matrix& b)
  {
    sort_columns(structure, b);
    m_size = (m_order.size() + 7) / 8 * 8;
    std::vector<std::vector<int>> paths((m_order.size() + 3) / 4);
    std::vector<int> part_of(structure.supernodes().size(), -1);
    find_parts(structure, b, paths, part_of);
    for_each_task(paths.size(), [&](std::size_t g) {
      substitute_columns(structure, values, b, 4 * g, paths[g], part_of);
    });
  }

  // the column of B of each column here, without the padding
  const std::vector<int>& order() const { return m_order; }

  // the number of columns, with the padding
  std::size_t size() const { return m_size; }

  // the lower triangle of -W^T W, column by column
  std::vector<double> negative_square() const
  {
    constexpr std::size_t columns_at_once = 32;
    std::vector<double> square(m_size * m_size, 0);
    for_each_task((m_size + columns_at_once - 1) / columns_at_once, [&](std::size_t t) {
      const std::size_t begin = columns_at_once * t;
      const std::size_t end = (std::min)(m_size, begin + columns_at_once);
      for(const Part& part : m_parts)
      {
        const std::size_t first = (std::max)(begin, part.first);
        const std::size_t last = (std::min)(end, part.first + part.size);
        if(first < last)
          subtract_square(square.data() + part.first * (m_size + 1), m_size,
                          static_cast<int>(part.size), static_cast<int>(first - part.first),
                          static_cast<int>(last - part.first), m_values.data() + part.begin,
                          part.width, part.size);
      }
    });
    return square;
  }

  // products := W^T y for the local vectors y, four numbers for each column
  void multiply(const Supernodal_structure& structure,
                Supernodal_substitution<Number>& substitution, double* products) const
  {
    for_each_task(m_size / 8, [&](std::size_t t) {
      std::vector<Border_rows<Number>> rows;
      for(const Part& part : m_parts)
        if(part.first <= 8 * t && 8 * t < part.first + part.size)
        {
          rows.push_back(part_rows(structure, substitution, part));
          rows.back().border += 8 * t - part.first;
        }
      run_kernel<Multiply_border>(rows, products + 32 * t);
    });
  }

  // y := y - W z for the local vectors y; z has four numbers for each column
  void subtract(const Supernodal_structure& structure,
                Supernodal_substitution<Number>& substitution, const double* z) const
  {
    for_each_block(m_parts.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t k = begin; k < end; ++k)
        run_kernel<Subtract_border>(part_rows(structure, substitution, m_parts[k]),
                                    z + 4 * m_parts[k].first);
    }, 16);
  }

private:
  using Supernode = Supernodal_structure::Supernode;
  using Block = Supernodal_structure::Block;

  // the rows of a supernode, in some columns that stand together
  struct Part
  {
    int supernode, width;
    std::size_t first, size; // the columns, multiples of eight
    std::size_t begin;       // in the values
  };

  void sort_columns(const Supernodal_structure& structure, const Sparse_matrix& b)
  {
    if(m_position.empty())
    {
      m_position = inverse_permutation(structure.order());
      m_rank = inverse_permutation(structure.numbers());
    }
    // in postorder a subtree is a range
    std::vector<std::tuple<int, int, int>> keys;
    for(int j = 0; j < b.cols(); ++j)
    {
      std::pair<int, int> first(0, 0);
      for(Sparse_matrix::InnerIterator entry(b, j); entry; ++entry)
      {
        const int position = m_position[entry.row()];
        const std::pair<int, int> at(m_rank[structure.supernode_at(position)], position);
        if(entry.index() == b.innerIndexPtr()[b.outerIndexPtr()[j]] || at < first)
          first = at;
      }
      keys.emplace_back(first.first, first.second, j);
    }
    std::sort(keys.begin(), keys.end());
    m_order.clear();
    for(const auto& key : keys)
      m_order.push_back(std::get<2>(key));
  }

  // The supernodes that each four columns reach, and from them the parts.
  void find_parts(const Supernodal_structure& structure, const Sparse_matrix& b,
                  std::vector<std::vector<int>>& paths, std::vector<int>& part_of)
  {
    const std::vector<Supernode>& supernodes = structure.supernodes();
    std::vector<int> seen(supernodes.size(), -1); // the last four columns that reach it
    m_parts.clear();
    for(std::size_t k = 0; k < m_order.size(); ++k)
    {
      const int g = static_cast<int>(k / 4);
      const std::size_t first = k / 8 * 8;
      for(Sparse_matrix::InnerIterator entry(b, m_order[k]); entry; ++entry)
        for(int s = structure.supernode_at(m_position[entry.row()]); s >= 0 && seen[s] != g;
            s = supernodes[s].parent)
        {
          if(seen[s] < 0)
          {
            part_of[s] = static_cast<int>(m_parts.size());
            m_parts.push_back({s, supernodes[s].width, first, 8, 0});
          }
          seen[s] = g;
          m_parts[part_of[s]].size = first + 8 - m_parts[part_of[s]].first;
          paths[g].push_back(s);
        }
    }
    std::sort(m_parts.begin(), m_parts.end(),
              [](const Part& p, const Part& q) { return p.supernode < q.supernode; });
    std::size_t size = 0;
    for(std::size_t k = 0; k < m_parts.size(); ++k)
    {
      part_of[m_parts[k].supernode] = static_cast<int>(k);
      m_parts[k].begin = size;
      size += m_parts[k].size * static_cast<std::size_t>(m_parts[k].width);
    }
    m_values.assign(size, 0);
  }

  // Up to four columns of W, from the entries of B upwards.
  void substitute_columns(const Supernodal_structure& structure, const Number* values,
                          const Sparse_matrix& b, std::size_t first, std::vector<int>& path,
                          const std::vector<int>& part_of)
  {
    const std::vector<Block>& blocks = structure.blocks();
    // the blocks upwards, and the supernodes of each
    const auto rank = [&](int s) { return std::make_pair(-structure.block_of(s), s); };
    std::sort(path.begin(), path.end(), [&](int s, int t) { return rank(s) < rank(t); });

    std::vector<std::size_t> begin(blocks.size(), 0); // of the local vectors of blocks on the path
    std::size_t size = 0;
    for(std::size_t k = 0; k < path.size(); ++k)
      if(const int block = structure.block_of(path[k]);
         k == 0 || block != structure.block_of(path[k - 1]))
      {
        begin[block] = size;
        size += 4 * static_cast<std::size_t>(blocks[block].own + blocks[block].boundary);
      }
    std::vector<Number> vectors(size, 0);
    for(std::size_t l = 0; l < 4 && first + l < m_order.size(); ++l)
      for(Sparse_matrix::InnerIterator entry(b, m_order[first + l]); entry; ++entry)
      {
        const int position = m_position[entry.row()];
        const int block = structure.block_of(structure.supernode_at(position));
        const std::size_t row = static_cast<std::size_t>(position) - blocks[block].columns;
        vectors[begin[block] + 4 * row + l] += static_cast<Number>(entry.value());
      }

    for(std::size_t k = 0; k < path.size();)
    {
      const int index = structure.block_of(path[k]);
      const Block& block = blocks[index];
      Number* const vector = vectors.data() + begin[index];
      for(; k < path.size() && structure.block_of(path[k]) == index; ++k)
      {
        run_forward(structure, path[k], path[k] + 1, values, vector);
        const Part& part = m_parts[part_of[path[k]]];
        const Number* from = vector + 4 * structure.supernodes()[path[k]].first;
        double* to = m_values.data() + part.begin + (first - part.first);
        for(int row = 0; row < part.width; ++row, from += 4, to += part.size)
          std::copy(from, from + 4, to);
      }
      for(int j = 0; j < block.boundary; ++j)
        for(std::size_t l = 0; l < 4; ++l)
          vectors[begin[block.parent] + 4 * structure.to_parent(block)[j] + l] +=
            vector[4 * (block.own + j) + l];
    }
  }

  Border_rows<Number> part_rows(const Supernodal_structure& structure,
                                Supernodal_substitution<Number>& substitution,
                                const Part& part) const
  {
    const Block& block = structure.blocks()[structure.block_of(part.supernode)];
    return {m_values.data() + part.begin, part.size,
            substitution.local_vector(block) + 4 * structure.supernodes()[part.supernode].first,
            part.width};
  }

  std::vector<int> m_order;
  std::size_t m_size = 0;
  std::vector<Part> m_parts; // of ascending supernodes
  std::vector<double> m_values;
  std::vector<int> m_position, m_rank; // of rows of the matrix, and of supernodes in postorder
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDER_COLUMNS_H
