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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_TREE_BLOCKS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_TREE_BLOCKS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace CGAL {
namespace ARAP {
namespace internal {

// Cuts the elimination tree into blocks, which are connected parts of it: subtrees of about equal
// work at the bottom, and above them what lies between two branchings. Blocks are numbered breadth
// first from block 0, the root, so that the children of a block are consecutive. The root has all
// that is small, of several trees too, and may be empty.
class Tree_blocks
{
public:
  // from the parent of each supernode, or -1 for roots, and its work, as numbers of the factor
  Tree_blocks(const Array<int>& parent, Array<double> work)
  {
    const int n = static_cast<int>(parent.size());
    const double total = std::accumulate(work.begin(), work.end(), 0.0);
    for(int s = 0; s < n; ++s)
      if(parent[s] >= 0)
        work[parent[s]] += work[s]; // of subtrees
    const double subtree = (std::max)(total / number_of_subtrees, least_work);
    const double twig = subtree / 8; // too small for a block of its own

    Array<int> heavy_children(n + 1, 0); // the last for the roots
    for(int s = 0; s < n; ++s)
      heavy_children[parent[s] < 0 ? n : parent[s]] += work[s] > subtree;

    m_block_of = Array<int>(n);
    Array<int> block_parent(1, -1);
    Array<char> is_subtree(1, 0);
    for(int s = n; s-- > 0;)
    {
      const int above = parent[s] < 0 ? 0 : m_block_of[parent[s]];
      const bool is_continued = work[s] > subtree
                              ? heavy_children[parent[s] < 0 ? n : parent[s]] == 1
                              : work[s] < twig;
      m_block_of[s] = above;
      if(!is_subtree[above] && !is_continued)
      {
        m_block_of[s] = static_cast<int>(block_parent.size());
        block_parent.push_back(above);
        is_subtree.push_back(work[s] <= subtree);
      }
    }
    number_breadth_first(block_parent);
  }

  std::size_t size() const { return m_parent.size(); }

  // the block of each supernode
  const Array<int>& block_of() const { return m_block_of; }

  // the parent of a block, -1 for block 0
  int parent(std::size_t block) const { return m_parent[block]; }

  int children_begin(std::size_t block) const { return m_children_begin[block]; }
  int children_end(std::size_t block) const { return m_children_begin[block + 1]; }

private:
  // About a hundred subtrees keep a dozen threads busy. A subtree with less work than the least, in
  // numbers to be read from the factor, does not pay for its task.
  static constexpr double number_of_subtrees = 100;
  static constexpr double least_work = 6000;

  void number_breadth_first(const Array<int>& parent)
  {
    const int n = static_cast<int>(parent.size());
    Array<Array<int>> children(n);
    for(int b = 1; b < n; ++b)
      children[parent[b]].push_back(b);
    Array<int> queue(1, 0), number(n, 0);
    m_parent.assign(1, -1);
    for(int k = 0; k < n; ++k)
    {
      m_children_begin.push_back(static_cast<int>(queue.size()));
      for(int child : children[queue[k]])
      {
        number[child] = static_cast<int>(queue.size());
        m_parent.push_back(k);
        queue.push_back(child);
      }
    }
    m_children_begin.push_back(n);
    for(int& b : m_block_of)
      b = number[b];
  }

  Array<int> m_block_of, m_parent, m_children_begin;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_TREE_BLOCKS_H
