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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGLE_TREE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGLE_TREE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#if __has_include(<CGAL/AABB_traits_3.h>) // the name since CGAL 6.0
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Nearest triangles by CGAL's AABB tree. The tree stores a complex centered at the origin and
// scaled to longest side 1, so that squares neither overflow nor underflow.
class Triangle_tree
{
public:
  // a triangle of a simplex
  struct Triangle
  {
    std::array<Coordinates, 3> corners; // scaled
    std::size_t simplex;
  };

  // in the unit of the tree
  struct Nearest
  {
    const Triangle* triangle;
    double distance;
  };

  // an empty tree for triangles of those simplices that have these numbers
  template <typename Simplices>
  Triangle_tree(const Simplices& simplices, const std::vector<std::size_t>& numbers)
  {
    Bounding_box box;
    for(std::size_t s : numbers)
      for(const Coordinates& c : simplices[s])
        box.include(c);
    for(std::size_t k = 0; k < 3; ++k)
      m_center[k] = 0.5 * box.least()[k] + 0.5 * box.most()[k];
    m_extent = box.longest_side();
  }

  // the longest side of the complex
  double extent() const { return m_extent; }

  Coordinates scaled(const Coordinates& c) const
  {
    return {(c[0] - m_center[0]) / m_extent, (c[1] - m_center[1]) / m_extent,
            (c[2] - m_center[2]) / m_extent};
  }

  // The tree refers to the triangle. build() must be called after the last one.
  void insert(const Triangle& triangle) { m_tree.insert(Primitive(triangle)); }
  void build() { m_tree.build(); }
  bool is_empty() const { return m_tree.empty(); }

  // None if the point, which is not scaled, is so far away, or the complex is so large, that the
  // computation overflows.
  std::optional<Nearest> nearest(const Coordinates& point) const
  {
    const Coordinates c = scaled(point);
    if(!(std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]) < 1e100) || !is_finite(m_extent))
      return std::nullopt;
    const Point query(c[0], c[1], c[2]);
    const auto [nearest, triangle] = m_tree.closest_point_and_primitive(query);
    return Nearest{triangle, std::sqrt(CGAL::squared_distance(query, nearest))};
  }

  // adds the triangles within a distance, in the unit of the tree, of a point that is not scaled
  void append_within(double distance, const Coordinates& point,
                     std::vector<const Triangle*>& triangles) const
  {
    const Coordinates c = scaled(point);
    m_tree.all_intersected_primitives(
      Kernel::Sphere_3(Point(c[0], c[1], c[2]), distance * distance),
      std::back_inserter(triangles));
  }

private:
  using Kernel = CGAL::Simple_cartesian<double>;
  using Point = Kernel::Point_3;

  // a model of AABBPrimitive
  class Primitive
  {
  public:
    using Id = const Triangle*;
    using Point = Kernel::Point_3;
    using Datum = Kernel::Triangle_3;

    explicit Primitive(const Triangle& triangle) : m_triangle(&triangle) {}

    Id id() const { return m_triangle; }
    Datum datum() const { return Datum(corner(0), corner(1), corner(2)); }
    Point reference_point() const { return corner(0); }

  private:
    Point corner(std::size_t k) const
    {
      const Coordinates& c = m_triangle->corners[k];
      return Point(c[0], c[1], c[2]);
    }

    Id m_triangle;
  };

#if __has_include(<CGAL/AABB_traits_3.h>)
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
#else
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
#endif

  Coordinates m_center = {0, 0, 0};
  double m_extent = 0;
  Tree m_tree;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TRIANGLE_TREE_H
