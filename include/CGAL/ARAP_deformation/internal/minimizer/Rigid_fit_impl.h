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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_FIT_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_FIT_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Rigid_fit.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/Svd_rotation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace CGAL {
namespace ARAP {
namespace internal {

inline Coordinates centroid(const Array<Coordinates>& points)
{
  Coordinates sum = {0, 0, 0};
  for(const Coordinates& p : points)
    add(sum, 1 / static_cast<double>(points.size()), p);
  return sum;
}

// The smallest rotation that is closest to a covariance of rank one, up to rounding, as that of
// points on a line is; nothing for others.
inline std::optional<Matrix_3x3> rotation_of_line(const Matrix_3x3& covariance)
{
  const auto unit = [](const Coordinates& v) {
    const Coordinates direction = without_scale(v);
    return scaled(direction, 1 / std::sqrt(dot(direction, direction)));
  };
  Coordinates from = {0, 0, 0}; // the row with the largest entry
  for(std::size_t row = 0; row < 3; ++row)
  {
    const double* r = covariance.data() + 3 * row;
    if(const Coordinates entries = {r[0], r[1], r[2]};
       largest_absolute_value(entries) > largest_absolute_value(from))
      from = entries;
  }
  if(!(largest_absolute_value(from) > 0) || !is_finite(from))
    return std::nullopt;
  from = unit(from);
  const Coordinates to = product(covariance, from);
  double left = 0;
  for(std::size_t row = 0; row < 3; ++row)
    for(std::size_t k = 0; k < 3; ++k)
      left = (std::max)(left, std::abs(covariance[3 * row + k] - to[row] * from[k]));
  if(!(left <= 1e-12 * largest_absolute_value(to)))
    return std::nullopt;
  return Svd_rotation::smallest_rotation(from, unit(to));
}

CGAL_ARAP_INLINE_FUNCTION
Rigid_fit::Rigid_fit(const Array<Coordinates>& from, const Array<Coordinates>& to)
  : m_from(centroid(from)), m_to(centroid(to))
{
  Matrix_3x3 covariance{};
  double size = 0;
  for(std::size_t k = 0; k < from.size(); ++k)
  {
    const Coordinates p = difference(from[k], m_from), q = difference(to[k], m_to);
    add_product(covariance, q, p);
    size += dot(p, p);
  }
  if(const std::optional<Matrix_3x3> rotation = rotation_of_line(covariance))
    m_rotation = *rotation;
  else
    // A little is added of the last rotation, the identity at first: it decides where nothing else
    // does, and what it does elsewhere is gone after some steps.
    for(int step = 0; step < 3; ++step)
    {
      Matrix_3x3 sum = covariance;
      add(sum, 1e-11 * size, m_rotation);
      m_rotation = Svd_rotation::closest(sum);
    }
  for(std::size_t k = 0; k < from.size(); ++k)
  {
    const Coordinates error = difference(to[k], (*this)(from[k]));
    if(!(dot(error, error) <= m_squared_error)) // nor if it is no number
      m_squared_error = dot(error, error);
  }
}

CGAL_ARAP_INLINE_FUNCTION
std::optional<Matrix_3x3> rotation_of_motion(const Array<Coordinates>& from,
                                             const Array<Coordinates>& to)
{
  double length = 0, width = 0; // squares
  Coordinates longest = {0, 0, 0};
  for(const Coordinates& p : from)
    if(const Coordinates edge = difference(p, from[0]); dot(edge, edge) > length)
    {
      longest = edge;
      length = dot(edge, edge);
    }
  for(const Coordinates& p : from)
  {
    const Coordinates normal = cross(without_scale(longest), difference(p, from[0]));
    width = (std::max)(width, dot(normal, normal));
  }
  if(!(width > 1e-12 * length)) // of squares
    return std::nullopt;
  const Rigid_fit fit(from, to);
  if(!(fit.squared_error() <= 1e-8 * length)) // they may be rounded to float
    return std::nullopt;
  return fit.rotation();
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_FIT_IMPL_H
