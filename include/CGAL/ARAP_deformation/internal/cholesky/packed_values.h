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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_PACKED_VALUES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_PACKED_VALUES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>

#include <algorithm>
#include <cstddef>

// The values of a supernode in the order in which a forward substitution reads them, and a backward
// substitution from the end: then the processor fetches them from memory in time. A few columns at
// a time, first the inverse of their triangle, row after row, and then the rows below it. With the
// inverse, no column waits for the one before.

namespace CGAL {
namespace ARAP {
namespace internal {

constexpr int most_columns_together = 8;

// how many of the remaining columns of a supernode stand together: most, or 1 to 4
constexpr int columns_together(int remaining)
{
  return remaining >= most_columns_together ? most_columns_together : (std::min)(remaining, 4);
}

// how many of so many columns from the first one on stand together at their end
constexpr int last_columns_together(int columns)
{
  const int remainder = columns % most_columns_together;
  return remainder == 0 ? most_columns_together : remainder > 4 ? remainder - 4 : remainder;
}

// The size of the columns of a supernode before they are packed: each has all rows of the front.
inline std::size_t size_of_columns(const Supernodal_structure::Supernode& s)
{
  return static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.width + s.below);
}

// From these columns, with the reciprocals of the diagonal.
template <typename Number>
void pack_values(const Supernodal_structure::Supernode& s, const double* columns, Number* values)
{
  const std::ptrdiff_t height = s.width + s.below;
  values += s.values;
  for(int first = 0; first < s.width;)
  {
    const int width = columns_together(s.width - first);
    const double* const triangle = columns + first * (height + 1);
    double inverse[most_columns_together][most_columns_together];
    for(int i = 0; i < width; ++i)
      for(int j = 0; j <= i; ++j)
      {
        double sum = i == j ? 1 : 0;
        for(int k = j; k < i; ++k)
          sum -= triangle[k * height + i] * inverse[k][j];
        inverse[i][j] = sum * triangle[i * height + i];
        *values++ = static_cast<Number>(inverse[i][j]);
      }
    for(std::ptrdiff_t i = width; i < height - first; ++i)
      for(int j = 0; j < width; ++j)
        *values++ = static_cast<Number>(triangle[j * height + i]);
    first += width;
  }
}

// the reciprocal of the diagonal entry in column j of a supernode
template <typename Number>
Number reciprocal_of_diagonal(const Supernodal_structure::Supernode& s, const Number* values, int j)
{
  values += s.values;
  std::ptrdiff_t height = s.width + s.below;
  for(int remaining = s.width;; )
  {
    const int width = columns_together(remaining);
    if(j < width)
      return values[j * (j + 3) / 2];
    values += width * (width + 1) / 2 + width * (height - width);
    height -= width;
    remaining -= width;
    j -= width;
  }
}

// whether all diagonal entries of a factor are positive and finite
template <typename Number>
bool has_positive_diagonal(const Supernodal_structure& structure, const Number* values)
{
  for(const Supernodal_structure::Supernode& s : structure.supernodes())
    for(int j = 0; j < s.width; ++j)
    {
      const Number reciprocal = reciprocal_of_diagonal(s, values, j);
      if(!(reciprocal > 0 && is_finite(reciprocal)))
        return false;
    }
  return true;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_PACKED_VALUES_H
