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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_MULTIFRONTAL_CHOLESKY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_MULTIFRONTAL_CHOLESKY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/dense_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/packed_values.h>
#include <CGAL/ARAP_deformation/internal/parallel/Task_memory.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The numeric factorization. Each supernode passes to its parent, as a dense matrix, what its
// columns subtract from the rows below; so subtrees are independent, and all arithmetic is dense.
// See Liu, The multifrontal method for sparse matrix solution: theory and practice. All arithmetic
// is done in double precision; the factor may be stored in single precision.
class Multifrontal_cholesky
{
public:
  Multifrontal_cholesky(const Supernodal_structure& structure, double* values)
    : Multifrontal_cholesky(structure, values, nullptr) {}

  Multifrontal_cholesky(const Supernodal_structure& structure, float* values)
    : Multifrontal_cholesky(structure, nullptr, values) {}

  // Stores the factor in the array of the constructor. The reciprocals of its diagonal are positive
  // if the matrix is positive definite. assemble(s, panel) adds the entries of the matrix to the
  // columns of supernode s, which are zero; it is called from several threads.
  template <typename Assemble>
  void factorize(const Assemble& assemble)
  {
    std::vector<std::size_t> sizes;
    for(std::size_t block = 0; block < m_structure.blocks().size(); ++block)
      sizes.push_back(memory_of_block(static_cast<int>(block)));
    Task_memory memory(sizes);
    m_structure.for_each_block_upwards([&](int block) {
      Task_memory::Piece piece = memory.take(sizes[static_cast<std::size_t>(block)]);
      factorize_block(block, assemble, piece.numbers.get());
      memory.give_back(std::move(piece));
    });
  }

private:
  using Supernode = Supernodal_structure::Supernode;
  using Block = Supernodal_structure::Block;

  Multifrontal_cholesky(const Supernodal_structure& structure, double* values,
                        float* single_values)
    : m_structure(structure), m_values(values), m_single_values(single_values),
      m_first_child(structure.supernodes().size(), -1),
      m_next_child(structure.supernodes().size(), -1)
  {
    for(int s = static_cast<int>(m_next_child.size()); s-- > 0;)
      if(const int parent = structure.supernodes()[s].parent; parent >= 0)
      {
        m_next_child[s] = m_first_child[parent];
        m_first_child[parent] = s;
      }
    place_block_updates();
  }

  // The update of the topmost supernode of a block takes the place of those of the blocks below,
  // which have been added to it.
  void place_block_updates()
  {
    const Array<Block>& blocks = m_structure.blocks();
    Array<std::size_t> sizes(blocks.size());
    for(std::size_t k = blocks.size(); k-- > 0;)
    {
      const auto begin = sizes.begin() + blocks[k].children_begin,
                 end = sizes.begin() + blocks[k].children_end;
      sizes[k] = (std::max)(size_of_triangle(blocks[k].boundary),
                            std::accumulate(begin, end, std::size_t(0)));
    }
    m_block_updates_begin.resize(blocks.size(), 0);
    for(std::size_t k = 0; k < blocks.size(); ++k) // parents before their children
    {
      std::size_t begin = m_block_updates_begin[k];
      for(int child = blocks[k].children_begin; child < blocks[k].children_end; ++child)
      {
        m_block_updates_begin[child] = begin;
        begin += sizes[child];
      }
    }
    m_block_updates.reset(new double[sizes[0]]); // first touched by the threads
  }

  double* block_update(int block) const
  {
    return m_block_updates.get() + m_block_updates_begin[block];
  }

  // `memory` is a stack of the updates whose supernodes wait for their parents in the block, the
  // lower triangle of each, column by column. The supernodes are in postorder: the updates of the
  // children of the next one are on top. Its own columns and update are computed above them.
  template <typename Assemble>
  void factorize_block(int block, const Assemble& assemble, double* memory)
  {
    const Block& b = m_structure.blocks()[block];
    Array<int> places;
    for(int index = b.supernodes_begin; index < b.supernodes_end; ++index)
    {
      const Supernode& s = m_structure.supernodes()[index];
      double* const panel = memory;
      double* const update = panel + size_of_columns(s);
      std::fill(panel, panel + size_of_front(s), 0.0);
      assemble(index, panel);
      memory -= size_of_child_updates(block, index);
      add_child_updates(block, index, memory, places, panel, update);
      factor_panel(panel, s.width, s.width + s.below);
      if(s.below > 0)
        subtract_square(update, s.below, s.below, 0, s.below, panel + s.width, s.width,
                        s.width + s.below);
      if(m_single_values)
        pack_values(s, panel, m_single_values);
      else
        pack_values(s, panel, m_values);
      if(index + 1 < b.supernodes_end)
        memory = copy_triangle(update, s.below, memory);
      else
        copy_triangle(update, s.below, block_update(block));
    }
  }

  // how many numbers a block needs for that
  std::size_t memory_of_block(int block) const
  {
    const Block& b = m_structure.blocks()[block];
    std::size_t most = 0, updates = 0;
    for(int index = b.supernodes_begin; index < b.supernodes_end; ++index)
    {
      const Supernode& s = m_structure.supernodes()[index];
      most = (std::max)(most, updates + size_of_front(s));
      updates = updates - size_of_child_updates(block, index) + size_of_triangle(s.below);
    }
    return most;
  }

  // columns and update
  static std::size_t size_of_front(const Supernode& s)
  {
    const auto below = static_cast<std::size_t>(s.below);
    return size_of_columns(s) + below * below;
  }

  static std::size_t size_of_triangle(int n)
  {
    return static_cast<std::size_t>(n) * (static_cast<std::size_t>(n) + 1) / 2;
  }

  // of the children in the same block
  std::size_t size_of_child_updates(int block, int index) const
  {
    std::size_t size = 0;
    for(int child = m_first_child[index]; child >= 0; child = m_next_child[child])
      if(m_structure.block_of(child) == block)
        size += size_of_triangle(m_structure.supernodes()[child].below);
    return size;
  }

  static double* copy_triangle(const double* square, std::ptrdiff_t n, double* to)
  {
    for(std::ptrdiff_t j = 0; j < n; ++j)
      to = std::copy(square + j * (n + 1), square + (j + 1) * n, to);
    return to;
  }

  // `updates` are those of the children in the same block
  void add_child_updates(int block, int index, const double* updates, Array<int>& places,
                         double* panel, double* update)
  {
    const Supernode& s = m_structure.supernodes()[index];
    for(int child = m_first_child[index]; child >= 0; child = m_next_child[child])
    {
      find_places(block, s, child, places);
      const int child_block = m_structure.block_of(child);
      if(child_block == block)
        updates = add_update(s, updates, places, panel, update);
      else
        add_update(s, block_update(child_block), places, panel, update);
    }
  }

  // The rows of `child` below among the rows of `s`. Both are in ascending order.
  void find_places(int block, const Supernode& s, int child, Array<int>& places) const
  {
    const Supernode& c = m_structure.supernodes()[child];
    const Block& child_block = m_structure.blocks()[m_structure.block_of(child)];
    const bool is_in_block = m_structure.block_of(child) == block;
    const int* const rows = m_structure.rows(c);
    const int* const to_parent = m_structure.to_parent(child_block);
    const int* const parent_rows = m_structure.rows(s);
    places.resize(static_cast<std::size_t>(c.below));
    int k = 0;
    for(int i = 0; i < c.below; ++i)
    {
      const int row = is_in_block ? rows[i] : to_parent[rows[i] - child_block.own];
      if(row < s.first + s.width)
      {
        places[i] = row - s.first;
        continue;
      }
      while(parent_rows[k] != row)
        ++k;
      places[i] = s.width + k;
    }
  }

  // Returns the end of the update of the child.
  static const double* add_update(const Supernode& s, const double* child_update,
                                  const Array<int>& places, double* panel, double* update)
  {
    const std::size_t n = places.size();
    const std::ptrdiff_t height = s.width + s.below, below = s.below;
    for(std::size_t j = 0; j < n; ++j)
    {
      const int column = places[j];
      double* const to = column < s.width
                       ? panel + column * height
                       : update + (column - s.width) * below - s.width;
      for(std::size_t i = j; i < n; ++i)
        to[places[i]] += *child_update++;
    }
    return child_update;
  }

  const Supernodal_structure& m_structure;
  double* m_values; // one of the two arrays is null
  float* m_single_values;
  std::unique_ptr<double[]> m_block_updates; // of their topmost supernodes, for the blocks above
  Array<std::size_t> m_block_updates_begin;
  Array<int> m_first_child, m_next_child;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_MULTIFRONTAL_CHOLESKY_H
