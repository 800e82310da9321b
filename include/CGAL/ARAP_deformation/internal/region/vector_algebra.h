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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_VECTOR_ALGEBRA_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_VECTOR_ALGEBRA_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

inline double dot(const Coordinates& a, const Coordinates& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Coordinates cross(const Coordinates& a, const Coordinates& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Coordinates scaled(const Coordinates& a, double factor)
{
  return {factor * a[0], factor * a[1], factor * a[2]};
}

inline Coordinates difference(const Coordinates& a, const Coordinates& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// target += factor * a
template <std::size_t n>
void add(std::array<double, n>& target, double factor, const std::array<double, n>& a)
{
  for(std::size_t k = 0; k < n; ++k)
    target[k] += factor * a[k];
}

// Whether there are factors that add up to 1, up to rounding errors. Their squares must be finite,
// too.
inline bool add_up_to_one(const std::vector<double>& factors)
{
  double sum = -1, squares = 0, largest = 0;
  for(double factor : factors)
  {
    sum += factor;
    squares += factor * factor;
    largest = (std::max)(largest, std::abs(factor));
  }
  return is_finite(squares) && std::abs(sum) <= (std::max)(1e-9, 1e-14 * largest);
}

// The sum of factors that add up to 1 times vectors, which a function of their numbers returns:
// differences keep digits where the vectors are large.
template <typename Factors, typename Function>
Coordinates affine_combination(const Factors& factors, const Function& vector)
{
  const Coordinates first = vector(0);
  Coordinates sum = first;
  for(std::size_t k = 1; k < factors.size(); ++k)
    add(sum, factors[k], difference(vector(k), first));
  return sum;
}

inline double largest_absolute_value(const Coordinates& a)
{
  return (std::max)({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

// a divided by its largest entry, so that fewer products underflow; zero stays zero
inline Coordinates without_scale(const Coordinates& a)
{
  const double size = largest_absolute_value(a);
  return size > 0 ? Coordinates{a[0] / size, a[1] / size, a[2] / size} : a;
}

inline Coordinates product(const Matrix_3x3& m, const Coordinates& a)
{
  return {m[0] * a[0] + m[1] * a[1] + m[2] * a[2],
          m[3] * a[0] + m[4] * a[1] + m[5] * a[2],
          m[6] * a[0] + m[7] * a[1] + m[8] * a[2]};
}

// m += a b^T
inline void add_product(Matrix_3x3& m, const Coordinates& a, const Coordinates& b)
{
  for(std::size_t r = 0; r < 3; ++r)
    for(std::size_t c = 0; c < 3; ++c)
      m[3 * r + c] += a[r] * b[c];
}

inline Matrix_3x3 product(const Matrix_3x3& a, const Matrix_3x3& b)
{
  Matrix_3x3 c{};
  for(std::size_t i = 0; i < 3; ++i)
    for(std::size_t j = 0; j < 3; ++j)
      c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
  return c;
}

// a b^T
inline Matrix_3x3 product_with_transpose(const Matrix_3x3& a, const Matrix_3x3& b)
{
  Matrix_3x3 c{};
  for(std::size_t i = 0; i < 3; ++i)
    for(std::size_t j = 0; j < 3; ++j)
      c[3 * i + j] =
        a[3 * i] * b[3 * j] + a[3 * i + 1] * b[3 * j + 1] + a[3 * i + 2] * b[3 * j + 2];
  return c;
}

// a with m b - m^T b = a x b for all b
inline Coordinates axial_vector(const Matrix_3x3& m)
{
  return {m[7] - m[5], m[2] - m[6], m[3] - m[1]};
}

constexpr Matrix_3x3 identity_matrix()
{
  return {1, 0, 0, 0, 1, 0, 0, 0, 1};
}

inline double determinant(const Matrix_3x3& m)
{
  return dot({m[0], m[1], m[2]}, cross({m[3], m[4], m[5]}, {m[6], m[7], m[8]}));
}

// whether R R^T = I and det R = 1, each entry up to a tolerance; not if there is an NaN
inline bool is_rotation(const Matrix_3x3& r, double tolerance)
{
  const Coordinates rows[3] = {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 3; ++j)
      if(!(std::abs(dot(rows[i], rows[j]) - (i == j)) <= tolerance))
        return false;
  return std::abs(determinant(r) - 1) <= tolerance;
}

// the index of the first point with a coordinate that is infinite or not a number, or -1
inline int find_non_finite(const Array<Coordinates>& points)
{
  for(std::size_t k = 0; k < points.size(); ++k)
    if(!is_finite(points[k]))
      return static_cast<int>(k);
  return -1;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_VECTOR_ALGEBRA_H
