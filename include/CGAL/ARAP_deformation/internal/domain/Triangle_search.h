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

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Finds the triangle nearest to a point. The coordinates are those of the nearest point, and not
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
    const auto found = *barycentric_coordinates(triangle.corners, nearest->point);
    // rounding errors at an edge make no coordinate negative
    const double b = (std::min)((std::max)(found[1], 0.0), 1.0);
    const double c = (std::min)((std::max)(found[2], 0.0), 1 - b);
    return Location{triangle.simplex, {1 - b - c, b, c}, nearest->distance * m_tree.extent()};
  }

private:
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
