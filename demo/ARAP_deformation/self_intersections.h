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


#ifndef CGAL_ARAP_DEFORMATION_DEMO_SELF_INTERSECTIONS_H
#define CGAL_ARAP_DEFORMATION_DEMO_SELF_INTERSECTIONS_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// The number of pairs of triangles that intersect, other than in a common corner or side. Triangles
// without area do not count.
template <typename Point>
std::size_t number_of_self_intersections(const std::vector<std::array<int, 3>>& triangles,
                                         const std::vector<Point>& points)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Exact_point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  std::vector<Exact_point> soup_points;
  for(const Point& p : points)
    soup_points.emplace_back(p.x(), p.y(), p.z());
  std::vector<std::vector<std::size_t>> soup;
  for(const auto& t : triangles)
    if(!CGAL::collinear(soup_points[t[0]], soup_points[t[1]], soup_points[t[2]]))
      soup.emplace_back(t.begin(), t.end());
  PMP::orient_polygon_soup(soup_points, soup); // so that there is a mesh of them
  CGAL::Surface_mesh<Exact_point> mesh;
  PMP::polygon_soup_to_polygon_mesh(soup_points, soup, mesh);
  using Face = CGAL::Surface_mesh<Exact_point>::Face_index;
  std::vector<std::pair<Face, Face>> pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_SELF_INTERSECTIONS_H
