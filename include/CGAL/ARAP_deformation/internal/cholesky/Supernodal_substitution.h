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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODAL_SUBSTITUTION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODAL_SUBSTITUTION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/substitution_kernels.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <algorithm>

namespace CGAL {
namespace ARAP {
namespace internal {

// Substitution with a factor in supernodes, for three right-hand sides at once. The local vectors
// of all blocks are filled on the way up; on the way down, they hold the solution.
template <typename Number>
class Supernodal_substitution
{
public:
  // The local vectors := L^-1 P x times `scale`. The values are those of the factor, with the
  // reciprocals of its diagonal.
  void forward(const Supernodal_structure& structure, const Number* values, const Coordinates* x,
               double scale = 1)
  {
    m_vectors.resize(4 * structure.vectors_size());
    structure.for_each_block_upwards([&](int k) {
      const Block& b = structure.blocks()[k];
      Number* const vector = local_vector(b);
      const int* const order = structure.order().data() + b.columns;
      for(int j = 0; j < b.own; ++j)
      {
        const Coordinates& row = x[order[j]];
        Row::of(static_cast<Number>(scale * row[0]), static_cast<Number>(scale * row[1]),
                static_cast<Number>(scale * row[2])).store(vector + 4 * j);
      }
      std::fill(vector + 4 * b.own, vector + 4 * (b.own + b.boundary), Number(0));
      for(int c = b.children_begin; c < b.children_end; ++c)
        add_contribution(structure, structure.blocks()[c], vector);
      run_forward(structure, b.supernodes_begin, b.supernodes_end, values, vector);
    });
  }

  // x := P^T L^-T of the local vectors, times `scale`.
  void backward(const Supernodal_structure& structure, const Number* values, Coordinates* x,
                double scale = 1)
  {
    structure.for_each_block_downwards([&](int k) {
      const Block& b = structure.blocks()[k];
      Number* const vector = local_vector(b);
      if(b.boundary > 0)
      {
        const Number* const above = local_vector(structure.blocks()[b.parent]);
        const int* const place = structure.to_parent(b);
        for(int j = 0; j < b.boundary; ++j)
          Row::load(above + 4 * place[j]).store(vector + 4 * (b.own + j));
      }
      run_backward(structure, b.supernodes_begin, b.supernodes_end, values, vector);
      const int* const order = structure.order().data() + b.columns;
      for(int j = 0; j < b.own; ++j)
      {
        const Number* const row = vector + 4 * j;
        x[order[j]] = {scale * row[0], scale * row[1], scale * row[2]};
      }
    });
  }

  Number* local_vector(const Supernodal_structure::Block& b)
  { return m_vectors.data() + 4 * b.vector; }

private:
  using Row = Vector4<Number>;
  using Block = Supernodal_structure::Block;

  void add_contribution(const Supernodal_structure& structure, const Block& child, Number* vector)
  {
    const Number* const boundary = local_vector(child) + 4 * child.own;
    const int* const place = structure.to_parent(child);
    for(int j = 0; j < child.boundary; ++j)
    {
      Number* const row = vector + 4 * place[j];
      (Row::load(row) + Row::load(boundary + 4 * j)).store(row);
    }
  }

  Array<Number> m_vectors; // four numbers for each row
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_SUPERNODAL_SUBSTITUTION_H
