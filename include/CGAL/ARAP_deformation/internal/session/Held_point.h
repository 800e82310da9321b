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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_HELD_POINT_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_HELD_POINT_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// What a control vertex or a control point is moved to or pulled toward.
template <typename Point>
struct Handle_target
{
  // the weight of what is put there, and not only pulled
  static constexpr double hard = std::numeric_limits<double>::infinity();

  // not by a comparison: with -ffast-math there is no infinity
  static bool is_hard(double weight) { return !is_finite(weight); }

  bool is_hard() const { return is_hard(weight); }

  // whether it is a term of the energy
  bool is_pull() const { return 0 < weight && !is_hard(); }

  Point point;
  double weight = hard;
  std::function<Point(const Point&)> set = {}; // projects onto the target, if that is a set
  std::optional<Matrix_3x3> rotation = {};     // of the cells there, if it is given
};

// A control point: a handle inside a simplex, with its corners of non-zero barycentric coordinates.
template <typename Domain>
struct Held_point
{
  using vertex_descriptor = typename Domain::vertex_descriptor;

  // Where it is; `coordinates_of(v)` are those of a vertex.
  template <typename Function>
  Coordinates position(const Function& coordinates_of) const
  {
    return affine_combination(coordinates,
                              [&](std::size_t k) { return coordinates_of(corners[k]); });
  }

  std::vector<vertex_descriptor> corners;
  std::vector<double> coordinates;
  Handle_target<typename Domain::Point> target;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_HELD_POINT_H
