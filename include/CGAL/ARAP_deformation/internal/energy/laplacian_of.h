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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_LAPLACIAN_OF_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_LAPLACIAN_OF_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/solver/Laplacian.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

inline Laplacian laplacian_of(const Deformation_energy& energy)
{
  // the off-diagonal entries of each column, with one entry for each edge set
  const int n = energy.number_of_movable_vertices();
  using Entry = std::pair<int, double>;
  Laplacian laplacian;
  laplacian.is_tied = Array<char>(n);
  laplacian.is_sum_of_squares = energy.is_sum_of_squares();
  Array<int> first(n + 1, 0);
  Array<double> diagonal(n, 0);
  energy.for_each_edge([&](int i, int j, double w) {
    if(i < n) diagonal[i] += w;
    if(j < n) diagonal[j] += w;
    if(i < n && j < n)
      ++first[(std::min)(i, j) + 1];
    else if(w != 0 && (i < n || j < n))
      laplacian.is_tied[(std::min)(i, j)] = true;
  });
  add_up(first);
  Array<Entry> entries(first.back());
  Array<int> next(first.begin(), first.end() - 1);
  energy.for_each_edge([&](int i, int j, double w) {
    if(i < n && j < n) entries[next[(std::min)(i, j)]++] = {(std::max)(i, j), -w};
  });

  // sorted, and those of the same row added up: of column j there are sizes[j], and the diagonal
  Array<int>& sizes = next;
  for_each_block(first.size() - 1, [&](std::size_t begin, std::size_t end) {
    for(std::size_t j = begin; j < end; ++j)
      sizes[j] = sort_and_add_up(entries.begin() + first[j], entries.begin() + first[j + 1]);
  });
  Sparse_matrix& matrix = laplacian.matrix;
  matrix.resize(n, n);
  int* outer = matrix.outerIndexPtr();
  for(int j = 0; j < n; ++j)
    outer[j + 1] = checked_sum(outer[j], sizes[j] + 1);
  matrix.resizeNonZeros(outer[n]);
  for_each_block(first.size() - 1, [&](std::size_t begin, std::size_t end) {
    for(std::size_t j = begin; j < end; ++j)
    {
      int* row = matrix.innerIndexPtr() + outer[j];
      double* value = matrix.valuePtr() + outer[j];
      *row++ = static_cast<int>(j);
      *value++ = diagonal[j];
      for(int k = 0; k < sizes[j]; ++k)
      {
        *row++ = entries[first[j] + k].first;
        *value++ = entries[first[j] + k].second;
      }
    }
  });
  return laplacian;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_LAPLACIAN_OF_H
