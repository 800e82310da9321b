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

#include <algorithm>
#include <cstddef>

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
    m_structure.for_each_block_upwards([&](int k) {
      const Block& b = m_structure.blocks()[k];
      Array<int> places;
      Array<double> columns; // of a supernode
      Array<double> spare;   // the memory of an update that is not needed any more
      for(int s = b.supernodes_begin; s < b.supernodes_end; ++s)
      {
        const Supernode& supernode = m_structure.supernodes()[s];
        columns.assign(size_of_columns(supernode), 0);
        assemble(s, columns.data());
        factorize_supernode(k, s, columns.data(), places, spare);
        if(m_single_values)
          pack_values(supernode, columns.data(), m_single_values);
        else
          pack_values(supernode, columns.data(), m_values);
      }
    });
  }

private:
  using Supernode = Supernodal_structure::Supernode;
  using Block = Supernodal_structure::Block;

  Multifrontal_cholesky(const Supernodal_structure& structure, double* values,
                        float* single_values)
    : m_structure(structure), m_values(values), m_single_values(single_values),
      m_updates(structure.supernodes().size()), m_first_child(structure.supernodes().size(), -1),
      m_next_child(structure.supernodes().size(), -1)
  {
    for(int s = static_cast<int>(m_next_child.size()); s-- > 0;)
      if(const int parent = structure.supernodes()[s].parent; parent >= 0)
      {
        m_next_child[s] = m_first_child[parent];
        m_first_child[parent] = s;
      }
  }

  void factorize_supernode(int block, int index, double* panel, Array<int>& places,
                           Array<double>& spare)
  {
    const Supernode& s = m_structure.supernodes()[index];
    const std::size_t below = static_cast<std::size_t>(s.below);
    Array<double>& update = m_updates[index];
    if(spare.capacity() < below * below)
      Array<double>().swap(spare); // before there is another one
    update.swap(spare);
    update.assign(below * below, 0);
    for(int child = m_first_child[index]; child >= 0; child = m_next_child[child])
    {
      find_places(block, s, child, places);
      add_update(s, m_updates[child], places, panel, update.data());
      if(spare.capacity() < m_updates[child].capacity())
        spare.swap(m_updates[child]);
      Array<double>().swap(m_updates[child]);
    }
    factor_panel(panel, s.width, s.width + s.below);
    if(below > 0)
      subtract_square(update.data(), s.below, s.below, 0, s.below, panel + s.width, s.width,
                      s.width + s.below);
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

  static void add_update(const Supernode& s, const Array<double>& child_update,
                         const Array<int>& places, double* panel, double* update)
  {
    const std::size_t n = places.size();
    const std::ptrdiff_t height = s.width + s.below, below = s.below;
    for(std::size_t j = 0; j < n; ++j)
    {
      const double* const from = child_update.data() + j * n;
      const int column = places[j];
      double* const to = column < s.width
                       ? panel + column * height
                       : update + (column - s.width) * below - s.width;
      for(std::size_t i = j; i < n; ++i)
        to[places[i]] += from[i];
    }
  }

  const Supernodal_structure& m_structure;
  double* m_values; // one of the two arrays is null
  float* m_single_values;
  Array<Array<double>> m_updates; // of supernodes whose parents are not factorized yet
  Array<int> m_first_child, m_next_child;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_MULTIFRONTAL_CHOLESKY_H
