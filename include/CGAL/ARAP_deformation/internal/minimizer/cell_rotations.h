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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_CELL_ROTATIONS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_CELL_ROTATIONS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/Svd_rotation.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Rotations at vertices as those of cells, which are at vertices, or are the movable simplices.

// The closest rotation to the mean of those at the corners of a simplex, if there is one;
// rotation_at(v) may be null.
template <typename Function>
std::optional<Matrix_3x3> mean_at_corners(const Region& region, int s, const Function& rotation_at)
{
  Matrix_3x3 sum{};
  bool has_one = false;
  for(int v : region.corners_of(s))
    if(const Matrix_3x3* const rotation = rotation_at(v))
    {
      has_one = true;
      add(sum, 1, *rotation);
    }
  return has_one ? std::optional<Matrix_3x3>(Svd_rotation::closest(sum)) : std::nullopt;
}

// A frame holds for the cell of its vertex, which is one of the first vertices, or for all
// simplices at it; a simplex with several frames gets their mean.
inline std::vector<std::pair<int, Matrix_3x3>>
rotations_of_cells(const Region& region, bool are_at_vertices, int number_of_cells,
                   const std::vector<Frame>& frames)
{
  std::vector<std::pair<int, Matrix_3x3>> given;
  if(are_at_vertices)
  {
    for(const Frame& frame : frames)
      if(frame.vertex < number_of_cells)
        given.emplace_back(frame.vertex, frame.rotation);
    return given;
  }
  if(frames.empty())
    return given;
  Array<const Matrix_3x3*> frame_of(region.number_of_vertices(), nullptr);
  for(const Frame& frame : frames)
    frame_of[frame.vertex] = &frame.rotation;
  for(int s = 0; s < region.number_of_movable_simplices; ++s)
    if(const auto mean = mean_at_corners(region, s, [&](int v) { return frame_of[v]; }))
      given.emplace_back(s, *mean);
  return given;
}

// Sets the rotations of cells, from rotation_at(v) of vertices.
template <typename Function>
void set_rotations_of_cells(const Region& region, bool are_at_vertices, const Function& rotation_at,
                            Array<Matrix_3x3>& rotations)
{
  if(are_at_vertices)
  {
    for(std::size_t v = 0; v < rotations.size(); ++v)
      rotations[v] = rotation_at(v);
    return;
  }
  Array<Matrix_3x3> of_vertices;
  of_vertices.reserve(region.rest.size());
  for(std::size_t v = 0; v < region.rest.size(); ++v)
    of_vertices.push_back(rotation_at(v));
  for(int s = 0; s < region.number_of_movable_simplices; ++s)
    rotations[s] = *mean_at_corners(region, s, [&](int v) { return &of_vertices[v]; });
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_CELL_ROTATIONS_H
