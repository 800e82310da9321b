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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_TETRAHEDRON_SEARCH_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_TETRAHEDRON_SEARCH_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#if __has_include(<CGAL/AABB_traits_3.h>) // the name since CGAL 6.0
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

using Barycentric_coordinates = std::array<double, 4>;
using Tetrahedron_corners = std::array<Coordinates, 4>;

// The barycentric coordinates of a point, or nothing if the tetrahedron has no volume up to
// rounding. They add up to 1. The solution is backward stable: they reproduce the point also
// where the tetrahedron is thin.
inline std::optional<Barycentric_coordinates>
barycentric_coordinates(const Tetrahedron_corners& corners, const Coordinates& point)
{
  Eigen::Matrix3d edges;
  Eigen::Vector3d from_first;
  for(int r = 0; r < 3; ++r)
  {
    from_first[r] = point[r] - corners[0][r];
    for(int c = 0; c < 3; ++c)
      edges(r, c) = corners[c + 1][r] - corners[0][r];
  }
  Eigen::FullPivLU<Eigen::Matrix3d> decomposition;
  decomposition.setThreshold(1e-12);
  if(!decomposition.compute(edges).isInvertible())
    return std::nullopt;
  const Eigen::Vector3d solution = decomposition.solve(from_first);
  return Barycentric_coordinates{1 - solution.sum(), solution[0], solution[1], solution[2]};
}

// Finds the tetrahedron that contains a point, or else the nearest one.
//
// Both have the face that is nearest to the point: the segment to the nearest point of all faces
// crosses no other face, and so does not leave the tetrahedron, or the outside, where it begins.
// Several faces can be equally near, those at an edge or a vertex for example. Of the tetrahedra of
// all faces that are nearest up to rounding, the one with the largest smallest barycentric
// coordinate is taken: it contains the point if one of them does, and else extrapolates least. If
// there are several even then, the first one is taken.
class Tetrahedron_search
{
public:
  struct Location
  {
    std::size_t tetrahedron;             // its number in the order of the constructor
    Barycentric_coordinates coordinates;
    double distance;                     // from the tetrahedron, 0 if it contains the point
  };

  // Tetrahedra without volume are left out.
  explicit Tetrahedron_search(std::vector<Tetrahedron_corners> tetrahedra)
    : m_tetrahedra(std::move(tetrahedra))
  {
    fit_to(m_tetrahedra);
    m_scaled.reserve(m_tetrahedra.size()); // the tree refers to its elements
    for(std::size_t t = 0; t < m_tetrahedra.size(); ++t)
    {
      const Tetrahedron_corners& c = m_tetrahedra[t];
      m_scaled.push_back({scaled(c[0]), scaled(c[1]), scaled(c[2]), scaled(c[3])});
      if(barycentric_coordinates(c, c[0]))
        for(int corner = 0; corner < 4; ++corner)
          m_tree.insert(Face(m_scaled[t], 4 * t + corner));
    }
    m_tree.build();
  }

  // the tree refers to the tetrahedra
  Tetrahedron_search(const Tetrahedron_search&) = delete;
  Tetrahedron_search& operator=(const Tetrahedron_search&) = delete;

  bool is_empty() const { return m_tree.empty(); }

  // returns nothing if the point is so far away that squares overflow
  std::optional<Location> locate(const Coordinates& point) const
  {
    const Point query = scaled(point);
    if(!(std::abs(query.x()) + std::abs(query.y()) + std::abs(query.z()) < 1e100))
      return std::nullopt;
    const auto [nearest_point, nearest_face] = m_tree.closest_point_and_primitive(query);
    const double distance = std::sqrt(CGAL::squared_distance(query, nearest_point));
    const double upper_bound = distance + 1e-12 * (1 + distance);
    std::vector<std::size_t> candidates = {nearest_face};
    m_tree.all_intersected_primitives(Kernel::Sphere_3(query, upper_bound * upper_bound),
                                      std::back_inserter(candidates));
    for(std::size_t& face : candidates)
      face /= 4; // now the tetrahedron
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());

    std::optional<Location> best;
    double best_smallest = -std::numeric_limits<double>::infinity();
    for(std::size_t t : candidates)
    {
      const auto coordinates = barycentric_coordinates(m_tetrahedra[t], point);
      const double smallest = *std::min_element(coordinates->begin(), coordinates->end());
      if(smallest > best_smallest)
      {
        best_smallest = smallest;
        best = Location{t, *coordinates, smallest >= 0 ? 0 : distance * m_extent};
      }
    }
    return best;
  }

private:
  using Kernel = CGAL::Simple_cartesian<double>;
  using Point = Kernel::Point_3;

  using Scaled_corners = std::array<Point, 4>;

  // the face of a tetrahedron opposite to one of its corners: a model of AABBPrimitive
  class Face
  {
  public:
    using Id = std::size_t;
    using Point = Kernel::Point_3;
    using Datum = Kernel::Triangle_3;

    Face(const Scaled_corners& corners, Id id) : m_corners(&corners), m_id(id) {}

    Id id() const { return m_id; }
    Datum datum() const { return Datum(corner(1), corner(2), corner(3)); }
    Point reference_point() const { return corner(1); }

  private:
    const Point& corner(int k) const { return (*m_corners)[(m_id + k) % 4]; }

    const Scaled_corners* m_corners;
    Id m_id;
  };

#if __has_include(<CGAL/AABB_traits_3.h>)
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Face>>;
#else
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Face>>;
#endif

  // The tree sees the complex at the origin and with the extent 1, so that squares neither overflow
  // nor vanish.
  void fit_to(const std::vector<Tetrahedron_corners>& tetrahedra)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Coordinates lowest = {infinity, infinity, infinity};
    Coordinates highest = {-infinity, -infinity, -infinity};
    for(const Tetrahedron_corners& corners : tetrahedra)
      for(const Coordinates& c : corners)
        for(int k = 0; k < 3; ++k)
        {
          lowest[k] = (std::min)(lowest[k], c[k]);
          highest[k] = (std::max)(highest[k], c[k]);
        }
    for(int k = 0; k < 3; ++k)
    {
      m_centre[k] = 0.5 * lowest[k] + 0.5 * highest[k];
      m_extent = (std::max)(m_extent, highest[k] - lowest[k]);
    }
  }

  Point scaled(const Coordinates& c) const
  {
    return Point((c[0] - m_centre[0]) / m_extent, (c[1] - m_centre[1]) / m_extent,
                 (c[2] - m_centre[2]) / m_extent);
  }

  std::vector<Tetrahedron_corners> m_tetrahedra;
  std::vector<Scaled_corners> m_scaled;
  Coordinates m_centre = {0, 0, 0};
  double m_extent = 0;
  Tree m_tree;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_TETRAHEDRON_SEARCH_H
