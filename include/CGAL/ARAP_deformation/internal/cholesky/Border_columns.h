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
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Border_parts.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_substitution.h>
#include <CGAL/ARAP_deformation/internal/cholesky/substitution_kernels.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The rows of a supernode in some columns of W, and in a vector with four numbers for each row.
template <typename Number>
struct Border_rows
{
  const double* border;
  std::ptrdiff_t stride; // from row to row of the border
  Number* vector;
  int size;
};

// sums := the products of eight columns with the vector
struct Multiply_border
{
  template <typename Number>
  CGAL_ARAP_ALWAYS_INLINE static void run(const Array<Border_rows<Number>>& rows, double* sums)
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
      for(std::ptrdiff_t l = 0; l < r.stride; ++l)
        row = negative_multiply_add(Row::all(static_cast<Number>(border[l])),
                                    Row::load(factors + 4 * l), row);
      row.store(r.vector + 4 * k);
    }
  }
};

// The columns W = L^-1 P B of a border. They are computed in the precision of the factor, and
// stored in double precision.
template <typename Number>
class Border_columns : public Border_parts
{
public:
  void compute(const Supernodal_structure& structure, const Number* values, const Sparse_matrix& b)
  {
    Array<Array<int>> paths;
    Array<int> part_of;
    find_parts(structure, b, paths, part_of);
    for_each_task(paths.size(), [&](std::size_t g) {
      substitute_columns(structure, values, b, 4 * g, paths[g], part_of);
    });
  }

  // products := W^T y for the local vectors y, four numbers for each column
  void multiply(const Supernodal_structure& structure,
                Supernodal_substitution<Number>& substitution, double* products) const
  {
    for_each_task(m_size / 8, [&](std::size_t t) {
      Array<Border_rows<Number>> rows;
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
  using Block = Supernodal_structure::Block;

  // Up to four columns of W, from the entries of B upwards.
  void substitute_columns(const Supernodal_structure& structure, const Number* values,
                          const Sparse_matrix& b, std::size_t first, Array<int>& path,
                          const Array<int>& part_of)
  {
    const Array<Block>& blocks = structure.blocks();
    sort_path(structure, path);
    Array<std::size_t> begin(blocks.size(), 0); // of the local vectors of blocks on the path
    std::size_t size = 0;
    for(std::size_t k = 0; k < path.size(); ++k)
      if(const int block = structure.block_of(path[k]);
         k == 0 || block != structure.block_of(path[k - 1]))
      {
        begin[block] = size;
        size += 4 * static_cast<std::size_t>(blocks[block].own + blocks[block].boundary);
      }
    Array<Number> vectors(size, 0);
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
      {
        Number* const row =
          vectors.data() + begin[block.parent] + 4 * structure.to_parent(block)[j];
        for(int l = 0; l < 4; ++l)
          row[l] += vector[4 * (block.own + j) + l];
      }
    }
  }

  Border_rows<Number> part_rows(const Supernodal_structure& structure,
                                Supernodal_substitution<Number>& substitution,
                                const Part& part) const
  {
    const Block& block = structure.blocks()[structure.block_of(part.supernode)];
    return {m_values.data() + part.begin, static_cast<std::ptrdiff_t>(part.size),
            substitution.local_vector(block) + 4 * structure.supernodes()[part.supernode].first,
            part.width};
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDER_COLUMNS_H
