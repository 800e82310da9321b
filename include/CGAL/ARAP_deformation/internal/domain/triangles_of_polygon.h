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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGLES_OF_POLYGON_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGLES_OF_POLYGON_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/region/contents.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Cuts a polygon into triangles, of numbers of its corners: clips ears, as seen along its vector
// area. Where there is none, as where the polygon meets itself, what is left is cut from a corner.
// The triangles do not depend on which corner is the first one.
inline std::vector<std::array<std::size_t, 3>>
triangles_of_polygon(const Array<Coordinates>& points)
{
  using Index = std::size_t;
  const Coordinates normal =
    without_scale(vector_area(points.size(), [&](Index k) { return points[k]; }));
  const auto area = [&](Index a, Index b, Index c) { // up to a factor
    return dot(normal, cross(difference(points[b], points[a]), difference(points[c], points[a])));
  };
  std::vector<Index> left(points.size()); // the corners that are not cut off
  const auto first = std::min_element(points.begin(), points.end()) - points.begin();
  for(Index k = 0; k < left.size(); ++k)
    left[k] = (static_cast<Index>(first) + k) % left.size();
  const auto is_ear = [&](Index a, Index b, Index c) {
    return area(a, b, c) > 0 && std::none_of(left.begin(), left.end(), [&](Index d) {
      return points[d] != points[a] && points[d] != points[b] && points[d] != points[c] &&
             area(a, b, d) >= 0 && area(b, c, d) >= 0 && area(c, a, d) >= 0;
    });
  };
  std::vector<std::array<Index, 3>> triangles;
  for(Index tried = 0; left.size() > 3 && tried < left.size();)
    if(is_ear(left[0], left[1], left[2]))
    {
      triangles.push_back({left[0], left[1], left[2]});
      left.erase(left.begin() + 1);
      tried = 0;
    }
    else
    {
      std::rotate(left.begin(), left.begin() + 1, left.end());
      ++tried;
    }
  for(Index k = 1; k + 1 < left.size(); ++k)
    triangles.push_back({left[0], left[k], left[k + 1]});
  return triangles;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGLES_OF_POLYGON_H
