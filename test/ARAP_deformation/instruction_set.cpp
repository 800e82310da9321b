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

// Defines the function CGAL_ARAP_TEST_FUNCTION, for test_instruction_sets.

#undef CGAL_ARAP_DEFORMATION_COMPILED

#include "include/instruction_set.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <typeinfo>
#include <vector>

Findings CGAL_ARAP_TEST_FUNCTION()
{
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  using Triangles = std::vector<std::array<int, 3>>;
  using Domain = CGAL::ARAP::Simplex_soup_domain<2, std::vector<Point>, Triangles>;

  const int n = 40;
  std::vector<Point> points;
  Triangles triangles;
  std::vector<std::size_t> roi, handle;
  for(int y = 0; y < n; ++y)
    for(int x = 0; x < n; ++x)
    {
      const int v = n * y + x;
      points.emplace_back(x, y, std::sin(0.5 * x) * std::cos(0.3 * y));
      (x == 0 || x + 1 == n ? handle : roi).push_back(static_cast<std::size_t>(v));
      if(x == 0 || y == 0)
        continue;
      triangles.push_back({v - n - 1, v - n, v});
      triangles.push_back({v - n - 1, v, v - 1});
    }

  CGAL::ARAP_deformation<Domain> deformation(Domain(points, triangles));
  deformation.insert_roi_vertices(roi.begin(), roi.end());
  deformation.insert_control_vertices(handle.begin(), handle.end());
  for(std::size_t v : handle)
    if(points[v].x() > 0)
      deformation.set_target_position(v, Point(points[v].x(), 0.5 * points[v].y(), 5));
  Findings result;
  if(deformation.deform(5, 0))
    for(const Point& p : points)
      result.points.push_back({p.x(), p.y(), p.z()});
  result.vector_type = typeid(CGAL::ARAP::internal::Double4).name();
  result.plain_columns = CGAL::ARAP::internal::plain_columns;
  return result;
}
