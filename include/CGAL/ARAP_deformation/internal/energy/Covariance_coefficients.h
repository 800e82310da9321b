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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_COVARIANCE_COEFFICIENTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_COVARIANCE_COEFFICIENTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The covariance of a cell as a linear function of the positions: the sum of x_v s_v^T over some
// vertices v, with constant vectors s_v, which add up to zero.
struct Covariance_coefficients
{
  Array<int> vertices;
  std::vector<Double4> vectors; // the fourth lane may hold anything

  std::size_t size() const { return vertices.size(); }

  void clear()
  {
    vertices.clear();
    vectors.clear();
  }

  // w (x_i - x_j) e^T, with the vector w e
  void add_edge(int i, int j, const Double4& weighted_edge)
  {
    add(i, weighted_edge);
    add(j, Double4::zero() - weighted_edge);
  }

private:
  // The edges of a cell have vertices in common, which are found if they were added lately.
  void add(int v, const Double4& s)
  {
    constexpr std::size_t lately = 16;
    const auto begin = vertices.begin() +
                       static_cast<std::ptrdiff_t>(size() > lately ? size() - lately : 0);
    const auto found = std::find(begin, vertices.end(), v);
    if(found == vertices.end())
    {
      vertices.push_back(v);
      vectors.push_back(s);
      return;
    }
    Double4& sum = vectors[static_cast<std::size_t>(found - vertices.begin())];
    sum = sum + s;
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_COVARIANCE_COEFFICIENTS_H
