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

#ifndef CGAL_ARAP_DEFORMATION_SELF_INTERSECTIONS_H
#define CGAL_ARAP_DEFORMATION_SELF_INTERSECTIONS_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/domain/Default_domain.h>
#include <CGAL/ARAP_deformation/internal/domain/Simplex_list.h>
#include <CGAL/ARAP_deformation/internal/domain/triangles_of_polygon.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/region/contents.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The triangles with an area of a polygon that is cut from one of its corners: the one where there
// are most, as what lies beside one without area has a side in common with several others. If that
// folds it everywhere, as one that is not convex, its ears are cut.
template <typename Point>
std::vector<std::vector<std::size_t>> cut_polygon(const std::vector<std::size_t>& polygon,
                                                  const std::vector<Point>& points)
{
  const std::size_t n = polygon.size();
  Array<Coordinates> corners;
  for(std::size_t v : polygon)
    corners.push_back({points[v].x(), points[v].y(), points[v].z()});
  const Coordinates normal =
    without_scale(vector_area(n, [&](std::size_t k) { return corners[k]; }));
  std::vector<std::vector<std::size_t>> most, triangles;
  bool is_folded = false;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    if(CGAL::collinear(points[polygon[a]], points[polygon[b]], points[polygon[c]]))
      return;
    is_folded |= dot(normal, cross(difference(corners[b], corners[a]),
                                   difference(corners[c], corners[a]))) < 0;
    triangles.push_back({polygon[a], polygon[b], polygon[c]});
  };
  for(std::size_t first = 0; first < n && most.size() + 2 < n; ++first)
  {
    triangles.clear();
    is_folded = false;
    for(std::size_t k = 1; k + 1 < n; ++k)
      add(first, (first + k) % n, (first + k + 1) % n);
    if(!is_folded && triangles.size() > most.size())
      most = triangles;
  }
  if(!most.empty())
    return most;
  triangles.clear();
  for(const auto& [a, b, c] : triangles_of_polygon(corners))
    add(a, b, c);
  return triangles;
}

} // namespace internal

/// \ingroup PkgARAPDeformationQuality
/// \brief returns how many pairs of triangles of a surface, or of the boundary of tetrahedra,
/// intersect other than in common vertices or edges of the shape, by the exact predicates of
/// `CGAL::Polygon_mesh_processing::self_intersections()`.
///
/// Polygons are cut from one of their corners, into triangles with an area if that is possible;
/// those that are not convex into such that do not overlap.
/// Triangles without area do not count, nor do faces with a corner that is not finite. Those beside
/// a triangle without area may, and so may triangles where the surface is not an orientable
/// manifold, as at an edge of three faces or along a seam whose sides are not joined. Takes
/// \f$O(n \log^3 n + k)\f$ time for \f$n\f$ triangles, \f$k\f$ pairs of which have bounding boxes
/// that intersect, and \f$O(m^3)\f$ for a polygon of \f$m\f$ corners that is not convex. No other
/// header needs CGAL's package Polygon Mesh Processing.
///
/// \param shape the deformed shape: a mesh as the template parameter `Mesh` of `ARAP_deformation`,
///        with its own points, or a model of `ARAPDomain`, which may have others
template <typename Shape>
std::size_t number_of_self_intersections(const Shape& shape)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> triangles;
  internal::with_domain(shape, [&](const auto& domain) {
    using Domain = std::decay_t<decltype(domain)>;
    for(const auto& v : domain.vertices())
    {
      const Coordinates p = Domain::coordinates(domain.point(v));
      if(points.size() <= domain.index(v))
        points.resize(domain.index(v) + 1, Point(0, 0, 0));
      points[domain.index(v)] = Point(p[0], p[1], p[2]);
    }
    const auto is_finite = [&](std::size_t v) {
      return internal::is_finite({points[v].x(), points[v].y(), points[v].z()});
    };
    for(const auto& face : internal::Simplex_list<Domain>(domain).faces())
      if(std::all_of(face.begin(), face.end(), is_finite))
        for(auto& triangle : internal::cut_polygon(face, points))
          triangles.push_back(std::move(triangle));
  });
  PMP::orient_polygon_soup(points, triangles); // so that there is a mesh of them
  CGAL::Surface_mesh<Point> mesh;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  using Face = CGAL::Surface_mesh<Point>::Face_index;
  std::vector<std::pair<Face, Face>> pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_SELF_INTERSECTIONS_H
