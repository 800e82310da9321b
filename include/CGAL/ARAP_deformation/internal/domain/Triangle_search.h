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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGLE_SEARCH_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGLE_SEARCH_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/Simplex_search.h>
#include <CGAL/ARAP_deformation/internal/domain/Triangle_tree.h>
#include <CGAL/ARAP_deformation/internal/domain/barycentric_coordinates.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Finds the triangle nearest to a point. The coordinates are those of its nearest place, and not
// negative.
class Triangle_search final : public Simplex_search<3>
{
public:
  // Triangles without area, also such that have none beside the extent of all, are ignored.
  explicit Triangle_search(const std::vector<Corners>& triangles)
    : Triangle_search(triangles, simplices_with_content(triangles))
  {}

  // the tree refers to the triangles
  Triangle_search(const Triangle_search&) = delete;
  Triangle_search& operator=(const Triangle_search&) = delete;

  bool is_empty() const override { return m_tree.is_empty(); }

  std::optional<Location> locate(const Coordinates& point) const override
  {
    const auto nearest = m_tree.nearest(point);
    if(!nearest)
      return std::nullopt;
    const Triangle_tree::Triangle& triangle = *nearest->triangle;
    const Place place = nearest_place(triangle.corners, m_tree.scaled(point));
    return Location{triangle.simplex, place.coordinates, place.distance * m_tree.extent()};
  }

private:
  struct Place
  {
    std::array<double, 3> coordinates;
    double distance;
  };

  // The one below the point, or on an edge. CGAL's point is not taken: where a triangle is thin, an
  // error of its size may be anything in coordinates.
  static Place nearest_place(const Corners& corners, const Coordinates& point)
  {
    Place best = {{1, 0, 0}, (std::numeric_limits<double>::infinity)()};
    const auto look_at = [&](const std::array<double, 3>& coordinates) {
      Coordinates way = {0, 0, 0};
      for(std::size_t k = 0; k < 3; ++k)
        add(way, coordinates[k], difference(corners[k], point));
      const double distance = std::sqrt(dot(way, way));
      if(distance < best.distance)
        best = {coordinates, distance};
    };
    const auto below = *barycentric_coordinates(corners, point);
    if(*std::min_element(below.begin(), below.end()) >= 0)
      look_at(below);
    for(std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t next = (k + 1) % 3;
      const Coordinates edge = difference(corners[next], corners[k]);
      const double share = dot(difference(point, corners[k]), edge) / dot(edge, edge);
      std::array<double, 3> coordinates = {0, 0, 0};
      coordinates[next] = (std::max)(0.0, (std::min)(share, 1.0));
      coordinates[k] = 1 - coordinates[next];
      look_at(coordinates);
    }
    return best;
  }

  Triangle_search(const std::vector<Corners>& triangles, const std::vector<std::size_t>& numbers)
    : m_tree(triangles, numbers)
  {
    for(std::size_t t : numbers)
    {
      const Corners& c = triangles[t];
      const Triangle_tree::Triangle triangle = {
        {m_tree.scaled(c[0]), m_tree.scaled(c[1]), m_tree.scaled(c[2])}, t};
      if(barycentric_coordinates(triangle.corners, triangle.corners[0]))
        m_triangles.push_back(triangle);
    }
    for(const auto& triangle : m_triangles)
      m_tree.insert(triangle);
    m_tree.build();
  }

  Triangle_tree m_tree;
  std::vector<Triangle_tree::Triangle> m_triangles;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGLE_SEARCH_H
