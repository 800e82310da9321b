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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TETRAHEDRON_SEARCH_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TETRAHEDRON_SEARCH_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/Simplex_search.h>
#include <CGAL/ARAP_deformation/internal/domain/Triangle_tree.h>
#include <CGAL/ARAP_deformation/internal/domain/barycentric_coordinates.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Finds the tetrahedron that contains a point, or else the nearest one.
//
// Either one has the face nearest to the point: the segment to the nearest point of all faces
// crosses no other face, and so stays in the tetrahedron, or outside, where it starts. Several
// faces can be equally near, for example at an edge or a vertex. Of the tetrahedra of all faces
// that are nearest up to rounding, the one with the largest minimum barycentric coordinate is
// chosen: it contains the point if any of them does, and otherwise extrapolates least. Ties go to
// the first one. The distance is 0 if it contains the point up to rounding.
class Tetrahedron_search final : public Simplex_search<4>
{
public:
  // Tetrahedra without volume are ignored.
  explicit Tetrahedron_search(const std::vector<Corners>& tetrahedra)
    : Tetrahedron_search(tetrahedra, simplices_with_content(tetrahedra))
  {}

  // the tree refers to the faces
  Tetrahedron_search(const Tetrahedron_search&) = delete;
  Tetrahedron_search& operator=(const Tetrahedron_search&) = delete;

  bool is_empty() const override { return m_tree.is_empty(); }

  std::optional<Location> locate(const Coordinates& point) const override
  {
    const auto nearest = m_tree.nearest(point);
    if(!nearest)
      return std::nullopt;
    const double distance = nearest->distance;

    constexpr double tolerance = 1e-12;
    std::vector<const Face*> faces = {nearest->triangle};
    Location best = best_at(faces, point);
    if(smallest_coordinate(best) <= tolerance) // else no other tetrahedron contains the point
    {
      const double upper_bound = distance + tolerance * (1 + distance);
      m_tree.append_within(upper_bound, point, faces);
      best = best_at(faces, point);
    }
    const bool is_inside = smallest_coordinate(best) >= 0 || distance <= tolerance;
    best.distance = is_inside ? 0 : distance * m_tree.extent();
    if(!is_finite(smallest_coordinate(best)))
      return std::nullopt;
    return best;
  }

private:
  using Face = Triangle_tree::Triangle; // those with the same corners are given by the first

  Tetrahedron_search(const std::vector<Corners>& tetrahedra,
                     const std::vector<std::size_t>& numbers)
    : m_tetrahedra(tetrahedra), m_tree(tetrahedra, numbers)
  {
    for(std::size_t t : numbers)
      for(std::size_t k = 0; k < 4; ++k)
      {
        const Corners& c = m_tetrahedra[t];
        std::array<Coordinates, 3> corners = {m_tree.scaled(c[(k + 1) % 4]),
                                              m_tree.scaled(c[(k + 2) % 4]),
                                              m_tree.scaled(c[(k + 3) % 4])};
        std::sort(corners.begin(), corners.end());
        m_faces.push_back({corners, t});
      }
    std::sort(m_faces.begin(), m_faces.end(), [](const Face& a, const Face& b) {
      return std::tie(a.corners, a.simplex) < std::tie(b.corners, b.simplex);
    });
    for(std::size_t k = 0; k < m_faces.size(); ++k)
      if(k == 0 || m_faces[k].corners != m_faces[k - 1].corners)
        m_tree.insert(m_faces[k]);
    m_tree.build();
  }

  static double smallest_coordinate(const Location& location)
  {
    return *std::min_element(location.coordinates.begin(), location.coordinates.end());
  }

  // the best tetrahedron at any of these faces; does not set the distance
  Location best_at(const std::vector<const Face*>& faces, const Coordinates& point) const
  {
    std::vector<std::size_t> candidates;
    for(const Face* first : faces)
      for(const Face* face = first;
          face != m_faces.data() + m_faces.size() && face->corners == first->corners; ++face)
        candidates.push_back(face->simplex);
    std::sort(candidates.begin(), candidates.end());

    Location best = {0, {}, 0};
    best.coordinates.fill(-std::numeric_limits<double>::infinity());
    for(std::size_t t : candidates)
    {
      const Location location = {t, *barycentric_coordinates(m_tetrahedra[t], point), 0};
      if(smallest_coordinate(location) > smallest_coordinate(best))
        best = location;
    }
    return best;
  }

  std::vector<Corners> m_tetrahedra;
  Triangle_tree m_tree;
  std::vector<Face> m_faces; // faces with the same corners are consecutive
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_TETRAHEDRON_SEARCH_H
