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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDER_PARTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDER_PARTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/dense_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/elimination_tree.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// The storage of the columns W = L^-1 P B for a border B of a factorized matrix. The columns are
// sorted, so that those that begin near each other in the elimination tree stand together, and
// padded with zeros to a multiple of eight. For each supernode that the tree reaches from an entry
// of B, the rows of W are stored from the first to the last column that reaches it, row by row.
class Border_parts
{
public:
  // the column of B of each column here, without the padding
  const Array<int>& order() const { return m_order; }

  // the number of columns, with the padding
  std::size_t size() const { return m_size; }

  // the lower triangle of -W^T W, column by column
  Array<double> negative_square() const
  {
    constexpr std::size_t columns_at_once = 32;
    Array<double> square(m_size * m_size, 0);
    for_each_task((m_size + columns_at_once - 1) / columns_at_once, [&](std::size_t t) {
      const std::size_t begin = columns_at_once * t;
      const std::size_t end = (std::min)(m_size, begin + columns_at_once);
      for(const Part& part : m_parts)
      {
        const std::size_t first = (std::max)(begin, part.first);
        const std::size_t last = (std::min)(end, part.first + part.size);
        if(first < last)
          subtract_square(square.data() + part.first * (m_size + 1),
                          static_cast<std::ptrdiff_t>(m_size),
                          static_cast<int>(part.size), static_cast<int>(first - part.first),
                          static_cast<int>(last - part.first), m_values.data() + part.begin,
                          part.width, static_cast<std::ptrdiff_t>(part.size));
      }
    });
    return square;
  }

protected:
  using Supernode = Supernodal_structure::Supernode;

  // the rows of a supernode, in some columns that stand together
  struct Part
  {
    int supernode, width;
    std::size_t first, size; // the columns, multiples of eight
    std::size_t begin;       // in the values
  };

  // Finds the supernodes that each four columns reach, from them the parts, and the part of each
  // supernode. The values become zero.
  void find_parts(const Supernodal_structure& structure, const Sparse_matrix& b,
                  Array<Array<int>>& paths, Array<int>& part_of)
  {
    sort_columns(structure, b);
    m_size = (m_order.size() + 7) / 8 * 8;
    paths.resize((m_order.size() + 3) / 4);
    part_of.assign(structure.supernodes().size(), -1);
    const Array<Supernode>& supernodes = structure.supernodes();
    Array<int> seen(supernodes.size(), -1); // the last four columns that reach it
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

  // the blocks upwards, and the supernodes of each
  static void sort_path(const Supernodal_structure& structure, Array<int>& path)
  {
    const auto rank = [&](int s) { return std::make_pair(-structure.block_of(s), s); };
    std::sort(path.begin(), path.end(), [&](int s, int t) { return rank(s) < rank(t); });
  }

  Array<int> m_order;
  std::size_t m_size = 0;
  Array<Part> m_parts; // of ascending supernodes
  Array<double> m_values;
  Array<int> m_position; // of the rows of the matrix

private:
  void sort_columns(const Supernodal_structure& structure, const Sparse_matrix& b)
  {
    if(m_position.empty())
    {
      m_position = inverse_permutation(structure.order());
      m_rank = inverse_permutation(structure.numbers());
    }
    // in postorder a subtree is a range
    Array<std::array<int, 3>> keys;
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
      keys.push_back({first.first, first.second, j});
    }
    std::sort(keys.begin(), keys.end());
    m_order.clear();
    for(const auto& key : keys)
      m_order.push_back(key[2]);
  }

  Array<int> m_rank; // of the supernodes, in postorder
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDER_PARTS_H
