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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODAL_CHOLESKY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODAL_CHOLESKY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Multifrontal_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodes.h>
#include <CGAL/ARAP_deformation/internal/cholesky/elimination_tree.h>
#include <CGAL/ARAP_deformation/internal/cholesky/packed_values.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace CGAL {
namespace ARAP {
namespace internal {

// Sparse Cholesky factorization for a given ordering. The symbolic part is done once.
class Supernodal_cholesky
{
public:
  // The symbolic part, for all matrices with the pattern of `a`; `order` has the row of the matrix
  // for each row of the factor.
  Supernodal_cholesky(const Sparse_matrix& a, Array<int> order)
  {
    // before the supernodes, which are released soon and would leave a gap below it
    m_entries = Array<Entry>(static_cast<int>(a.nonZeros()));
    const Supernodes supernodes = find_supernodes(a, order);
    m_structure = Supernodal_structure(supernodes, order);
    for(const Supernodal_structure::Supernode& s : m_structure.supernodes())
      if(size_of_columns(s) > (std::numeric_limits<std::uint32_t>::max)())
        throw std::length_error("a supernode of more than 32 GB"); // see Entry
    find_entries(a, supernodes, inverse_permutation(order));
  }

  const Supernodal_structure& structure() const { return m_structure; }

  // Computes the factor of `a`. The array is allocated if it is null. Returns `false` if `a` is not
  // positive definite, or if a diagonal entry leaves the range of Number.
  template <typename Number>
  bool factorize(const Sparse_matrix& a, std::unique_ptr<Number[]>& values) const
  {
    if(!values)
      values.reset(new Number[m_structure.values_size()]); // first touched by the threads
    factorize(a, Multifrontal_cholesky(m_structure, values.get()));
    return has_positive_diagonal(m_structure, values.get());
  }

private:
  // an entry of the matrix, and where it goes in the columns of its supernode
  struct Entry
  {
    int index;
    std::uint32_t place;
  };

  void factorize(const Sparse_matrix& a, Multifrontal_cholesky cholesky) const
  {
    cholesky.factorize([&](int s, double* panel) {
      for(std::size_t k = m_entries_begin[s]; k < m_entries_begin[s + 1]; ++k)
        panel[m_entries[k].place] += a.valuePtr()[m_entries[k].index];
    });
  }

  void find_entries(const Sparse_matrix& a, const Supernodes& supernodes,
                    const Array<int>& position)
  {
    const Array<int> supernode_of = list_of_each(supernodes.columns);
    const int* const begin = a.outerIndexPtr();
    const int* const row = a.innerIndexPtr();
    m_entries_begin.assign(supernodes.size() + 2, 0);
    for(int j = 0; j < a.cols(); ++j)
      for(int k = begin[j]; k < begin[j + 1]; ++k)
      {
        const int s = supernode_of[(std::min)(position[row[k]], position[j])];
        ++m_entries_begin[m_structure.numbers()[s] + 2];
      }
    std::partial_sum(m_entries_begin.begin(), m_entries_begin.end(), m_entries_begin.begin());
    // at first with the column instead of the place
    for(int j = 0; j < a.cols(); ++j)
      for(int k = begin[j]; k < begin[j + 1]; ++k)
      {
        const int s = supernode_of[(std::min)(position[row[k]], position[j])];
        m_entries[m_entries_begin[m_structure.numbers()[s] + 1]++] =
          {k, static_cast<std::uint32_t>(position[j])};
      }
    m_entries_begin.pop_back();
    for_each_block(supernodes.size(), [&](std::size_t first, std::size_t last) {
      for(std::size_t s = first; s < last; ++s)
      {
        const int number = m_structure.numbers()[s];
        for(std::size_t k = m_entries_begin[number]; k < m_entries_begin[number + 1]; ++k)
        {
          Entry& entry = m_entries[k];
          const auto [column, other] =
            std::minmax({position[row[entry.index]], static_cast<int>(entry.place)});
          entry.place = place(supernodes, s, other, column);
        }
      }
    });
  }

  // where an entry of the lower triangle of the factor is among those of its supernode
  static std::uint32_t place(const Supernodes& supernodes, std::size_t s, int row, int column)
  {
    const auto rows = supernodes.rows.begin();
    const auto begin = rows + static_cast<std::ptrdiff_t>(supernodes.rows_begin[s]);
    const auto end = rows + static_cast<std::ptrdiff_t>(supernodes.rows_begin[s + 1]);
    const int width = supernodes.width(s), first = supernodes.columns[s];
    const std::ptrdiff_t height = width + (end - begin);
    const std::ptrdiff_t i = row < first + width
                           ? row - first : width + (std::lower_bound(begin, end, row) - begin);
    return static_cast<std::uint32_t>((column - first) * height + i);
  }

  Supernodal_structure m_structure;
  Array<std::size_t> m_entries_begin; // for each supernode
  Array<Entry> m_entries;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODAL_CHOLESKY_H
