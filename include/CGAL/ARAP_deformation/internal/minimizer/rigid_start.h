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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_START_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_START_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/Svd_rotation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The rigid motion that takes points nearest to others, in the sense of least squares.
class Rigid_fit
{
public:
  // Where several motions are nearest, that with the smallest rotation.
  Rigid_fit(const std::vector<Coordinates>& from, const std::vector<Coordinates>& to)
    : m_from(centroid(from)), m_to(centroid(to))
  {
    Matrix_3x3 covariance{};
    for(std::size_t k = 0; k < from.size(); ++k)
    {
      const Coordinates p = difference(from[k], m_from), q = difference(to[k], m_to);
      for(std::size_t r = 0; r < 3; ++r)
        for(std::size_t c = 0; c < 3; ++c)
          covariance[3 * r + c] += q[r] * p[c];
    }
    m_rotation = Svd_rotation::closest(covariance);
    for(std::size_t k = 0; k < from.size(); ++k)
    {
      const Coordinates error = difference(to[k], (*this)(from[k]));
      m_squared_error = (std::max)(m_squared_error, dot(error, error));
    }
  }

  Coordinates operator()(const Coordinates& p) const
  {
    Coordinates q = product(m_rotation, difference(p, m_from));
    add(q, 1, m_to);
    return q;
  }

  // the largest squared distance that is left between two corresponding points
  double squared_error() const { return m_squared_error; }

private:
  static Coordinates centroid(const std::vector<Coordinates>& points)
  {
    Coordinates sum = {0, 0, 0};
    for(const Coordinates& p : points)
      add(sum, 1 / static_cast<double>(points.size()), p);
    return sum;
  }

  Coordinates m_from, m_to;
  Matrix_3x3 m_rotation;
  double m_squared_error = 0;
};

// Where the free vertices are a rigid copy of the rest shape, and all that constrains them is
// another one, moves them there: the minimum is zero, and many iterations of any minimizer away.
// `is_ignored` tells which fixed vertices nothing ties to the free ones, and `size` is the squared
// diagonal of the bounding box of the rest shape.
inline void start_rigidly(const Region& region, double size, const Constraints& constraints,
                          const std::vector<char>& is_ignored, const Targets& targets,
                          std::vector<Coordinates>& x)
{
  const std::size_t n = constraints.is_fixed.size();
  std::vector<Coordinates> rest, place;
  for(std::size_t v = 0; v < x.size(); ++v)
    if(v >= n || (constraints.is_fixed[v] && !is_ignored[v]))
    {
      rest.push_back(region.rest[v]);
      place.push_back(x[v]);
    }
  if(!targets.sets.empty())
    return;
  bool are_points = true; // rows whose coefficients add up to one move as points do
  for(const Weighted_rows* rows : {&constraints.rows, &constraints.hard_rows})
  {
    rows->for_each_row([&](auto, auto, double sum, double) {
      are_points &= std::abs(sum - 1) <= 1e-12;
    });
    for(int r = 0; r < rows->size(); ++r)
      rest.push_back(rows->value(r, region.rest.data()));
  }
  if(!are_points)
    return;
  place.insert(place.end(), targets.soft.begin(), targets.soft.end());
  place.insert(place.end(), targets.hard.begin(), targets.hard.end());
  constexpr double tolerance = 1e-12; // of squares, also of points of type float
  if(rest.empty() || !(Rigid_fit(rest, place).squared_error() <= tolerance * size))
    return;

  std::vector<Coordinates> free_rest, free_place;
  for(std::size_t v = 0; v < n; ++v)
    if(!constraints.is_fixed[v])
    {
      free_rest.push_back(region.rest[v]);
      free_place.push_back(x[v]);
    }
  const Rigid_fit before(free_rest, free_place);
  if(!(before.squared_error() <= tolerance * size))
    return;
  // The second fit is relative to the first: a single target, or targets on a line, leave the
  // rotation undetermined.
  std::transform(rest.begin(), rest.end(), rest.begin(), before);
  double motion = 0;
  for(std::size_t k = 0; k < rest.size(); ++k)
  {
    const Coordinates step = difference(place[k], rest[k]);
    motion = (std::max)(motion, dot(step, step));
  }
  const Rigid_fit after(rest, place);
  if(motion < 1e-18 * size || !(after.squared_error() <= tolerance * motion))
    return;
  for(std::size_t v = 0; v < n; ++v)
    if(!constraints.is_fixed[v])
      x[v] = after(before(region.rest[v]));
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_START_H
