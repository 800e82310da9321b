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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODAL_STRUCTURE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODAL_STRUCTURE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodes.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Tree_blocks.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// The supernodes of a factor, grouped by the blocks of the elimination tree. Each block has a local
// vector: its own columns and, after them, the rows below of its topmost supernode, which are all
// other rows that its supernodes refer to. So blocks of different branches are independent, and a
// block needs no more of its parent than those rows.
class Supernodal_structure
{
public:
  struct Supernode
  {
    std::size_t values; // where its values begin: block after block, in the order of a sweep
    std::size_t rows;   // where its rows below the triangle begin; they are places in local vectors
    int first;          // the place of its first column in the local vector of its block
    int width;
    int below;
    int parent;         // in the elimination tree, or -1
  };

  struct Block
  {
    int supernodes_begin, supernodes_end;
    int parent;             // -1 for block 0 only, the root
    int own, boundary;      // the parts of the local vector
    std::size_t vector;     // where the local vector begins, if all stand in a row
    std::size_t columns;    // where its own columns begin in order()
    std::size_t to_parent;  // where the places of its boundary in the parent's local vector begin
    int children_begin, children_end;
  };

  Supernodal_structure() = default;

  // `order` has for each column of the factor the row of the matrix that it belongs to.
  Supernodal_structure(const Supernodes& supernodes, const Array<int>& order)
  {
    const Array<int> supernode_of = list_of_each(supernodes.columns);
    Array<int> parent(supernodes.size());
    for(std::size_t s = 0; s < supernodes.size(); ++s)
      parent[s] = supernodes.below(s) == 0
                ? -1 : supernode_of[supernodes.rows[supernodes.rows_begin[s]]];
    Array<double> work(supernodes.size());
    for(std::size_t s = 0; s < supernodes.size(); ++s)
      work[s] = supernodes.width(s) * (0.5 * supernodes.width(s) + supernodes.below(s) + 8);
    const Tree_blocks blocks(parent, std::move(work));
    m_blocks.resize(blocks.size());
    for(std::size_t b = 0; b < blocks.size(); ++b)
    {
      m_blocks[b].parent = blocks.parent(b);
      m_blocks[b].children_begin = blocks.children_begin(b);
      m_blocks[b].children_end = blocks.children_end(b);
    }
    number_supernodes(supernodes, parent, blocks.block_of(), order);
    number_rows(supernodes, supernode_of, blocks.block_of());
  }

  const Array<Supernode>& supernodes() const { return m_supernodes; }
  const Array<Block>& blocks() const { return m_blocks; }

  // how many values a supernode has: those on and below the diagonal
  static std::size_t size(const Supernode& s)
  {
    const auto width = static_cast<std::size_t>(s.width);
    return width * (width + 1) / 2 + width * static_cast<std::size_t>(s.below);
  }

  // how many all have
  std::size_t values_size() const { return m_values_size; }

  // the memory that a sweep over the factor reads: the values and the rows
  std::size_t number_of_bytes(std::size_t size_of_number = sizeof(double)) const
  {
    return m_values_size * size_of_number + m_rows.size() * sizeof(int);
  }

  const int* rows(const Supernode& s) const { return m_rows.data() + s.rows; }
  const int* to_parent(const Block& b) const { return m_to_parent.data() + b.to_parent; }

  // the row of the matrix of each column, block after block
  const Array<int>& order() const { return m_order; }

  // the block of each supernode
  int block_of(int supernode) const { return m_block_of[supernode]; }

  // the supernode of a column, given by its place in order()
  int supernode_at(int position) const
  {
    const auto p = static_cast<std::size_t>(position);
    const auto block = std::upper_bound(m_blocks.begin(), m_blocks.end(), p,
      [](std::size_t column, const Block& b) {
        return column < b.columns + static_cast<std::size_t>(b.own);
      });
    const auto end = m_supernodes.begin() + block->supernodes_end;
    const auto next = std::upper_bound(m_supernodes.begin() + block->supernodes_begin, end,
      static_cast<int>(p - block->columns),
      [](int column, const Supernode& s) { return column < s.first; });
    return static_cast<int>(next - m_supernodes.begin()) - 1;
  }

  // the number here of each supernode of the constructor
  const Array<int>& numbers() const { return m_numbers; }

  // the length of all local vectors together
  std::size_t vectors_size() const
  {
    const Block& last = m_blocks.back();
    return last.vector + static_cast<std::size_t>(last.own + last.boundary);
  }

  // Calls f(block) for all blocks, children before their parent, in parallel for those of different
  // branches.
  template <typename Function>
  void for_each_block_upwards(const Function& f, int block = 0) const
  {
    const Block& b = m_blocks[block];
    for_each_task(static_cast<std::size_t>(b.children_end - b.children_begin), [&](std::size_t k) {
      for_each_block_upwards(f, b.children_begin + static_cast<int>(k));
    });
    f(block);
  }

  // Calls f(block) for all blocks, parents before their children.
  template <typename Function>
  void for_each_block_downwards(const Function& f, int block = 0) const
  {
    const Block& b = m_blocks[block];
    f(block);
    for_each_task(static_cast<std::size_t>(b.children_end - b.children_begin), [&](std::size_t k) {
      for_each_block_downwards(f, b.children_begin + static_cast<int>(k));
    });
  }

private:
  void number_supernodes(const Supernodes& supernodes, const Array<int>& parent,
                         const Array<int>& block_of, const Array<int>& order)
  {
    const std::size_t n = supernodes.size();
    for(int b : block_of)
      ++m_blocks[b].supernodes_end;
    Array<int> next; // the next free number in each block
    int end = 0;
    for(Block& b : m_blocks)
    {
      next.push_back(end);
      b.supernodes_begin = end;
      end = b.supernodes_end += end;
    }
    m_numbers.resize(n);
    m_block_of.resize(n);
    for(std::size_t s = 0; s < n; ++s)
    {
      m_numbers[s] = next[block_of[s]]++;
      m_block_of[m_numbers[s]] = block_of[s];
    }

    Array<std::size_t> first(m_blocks.size()); // the own columns so far
    m_supernodes.resize(n);
    for(std::size_t s = 0; s < n; ++s)
    {
      Supernode& supernode = m_supernodes[m_numbers[s]];
      supernode.width = supernodes.width(s);
      supernode.below = supernodes.below(s);
      supernode.first = static_cast<int>(first[block_of[s]]);
      supernode.parent = parent[s] < 0 ? -1 : m_numbers[parent[s]];
      first[block_of[s]] += static_cast<std::size_t>(supernode.width);
    }
    std::size_t columns = 0;
    for(std::size_t b = 0; b < m_blocks.size(); ++b)
    {
      m_blocks[b].own = static_cast<int>(first[b]);
      m_blocks[b].columns = columns;
      columns += first[b];
    }
    m_order.resize(order.size());
    for(std::size_t s = 0; s < n; ++s)
      std::copy(order.data() + supernodes.columns[s], order.data() + supernodes.columns[s + 1],
                m_order.data() + m_blocks[block_of[s]].columns + m_supernodes[m_numbers[s]].first);
  }

  void number_rows(const Supernodes& supernodes, const Array<int>& supernode_of,
                   const Array<int>& block_of)
  {
    // the first supernode of a block comes last
    Array<std::size_t> top(m_blocks.size(), supernodes.size());
    for(std::size_t s = 0; s < supernodes.size(); ++s)
      top[block_of[s]] = s;
    const auto boundary = [&](int b) {
      const std::size_t s = top[b];
      return s == supernodes.size()
           ? std::make_pair(supernodes.rows.data(), supernodes.rows.data())
           : std::make_pair(supernodes.rows.data() + supernodes.rows_begin[s],
                            supernodes.rows.data() + supernodes.rows_begin[s + 1]);
    };
    // the place of a row in the local vector of a block
    const auto place = [&](int b, int row) {
      const int s = supernode_of[row];
      if(block_of[s] == b)
        return m_supernodes[m_numbers[s]].first + row - supernodes.columns[s];
      const auto [begin, end] = boundary(b);
      return m_blocks[b].own + static_cast<int>(std::lower_bound(begin, end, row) - begin);
    };

    std::size_t vectors = 0;
    for(std::size_t k = 0; k < m_blocks.size(); ++k)
    {
      Block& b = m_blocks[k];
      const auto [begin, end] = boundary(static_cast<int>(k));
      b.boundary = static_cast<int>(end - begin);
      b.vector = vectors;
      vectors += static_cast<std::size_t>(b.own + b.boundary);
      b.to_parent = m_to_parent.size();
      for(auto row = begin; row != end; ++row)
        m_to_parent.push_back(place(b.parent, *row));
    }
    std::size_t rows = 0;
    for(Supernode& s : m_supernodes)
    {
      s.values = std::exchange(m_values_size, m_values_size + size(s));
      s.rows = std::exchange(rows, rows + static_cast<std::size_t>(s.below));
    }
    m_rows.resize(rows);
    for_each_block(supernodes.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t s = begin; s < end; ++s)
        std::transform(supernodes.rows.data() + supernodes.rows_begin[s],
                       supernodes.rows.data() + supernodes.rows_begin[s + 1],
                       m_rows.data() + m_supernodes[m_numbers[s]].rows,
                       [&](int row) { return place(block_of[s], row); });
    });
  }

  Array<Supernode> m_supernodes; // block after block
  Array<Block> m_blocks;
  Array<int> m_rows, m_to_parent, m_order, m_block_of, m_numbers;
  std::size_t m_values_size = 0;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODAL_STRUCTURE_H
