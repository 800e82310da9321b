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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_BOUNDING_BOX_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_BOUNDING_BOX_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace ARAP {
namespace internal {

// the bounding box of points
class Bounding_box
{
public:
  void include(const Coordinates& p)
  {
    for(std::size_t c = 0; c < 3; ++c)
    {
      m_least[c] = (std::min)(m_least[c], p[c]);
      m_most[c] = (std::max)(m_most[c], p[c]);
    }
  }

  void include(const Array<Coordinates>& points)
  {
    for(const Coordinates& p : points)
      include(p);
  }

  // of an empty box, infinite ones
  const Coordinates& least() const { return m_least; }
  const Coordinates& most() const { return m_most; }

  // negative if the box is empty
  double longest_side() const
  {
    double longest = m_most[0] - m_least[0];
    for(std::size_t c = 1; c < 3; ++c)
      longest = (std::max)(longest, m_most[c] - m_least[c]);
    return longest;
  }

  friend Bounding_box operator+(Bounding_box a, const Bounding_box& b) // of the points of both
  {
    for(std::size_t c = 0; c < 3; ++c)
    {
      a.m_least[c] = (std::min)(a.m_least[c], b.m_least[c]);
      a.m_most[c] = (std::max)(a.m_most[c], b.m_most[c]);
    }
    return a;
  }

  // of its diagonal; 0 without any points
  double squared_length() const
  {
    const Coordinates diagonal = difference(m_most, m_least);
    return diagonal[0] >= 0 ? dot(diagonal, diagonal) : 0;
  }

  // the largest absolute value of a coordinate
  double largest_coordinate() const
  {
    double largest = 0;
    if(m_least[0] <= m_most[0])
      for(std::size_t c = 0; c < 3; ++c)
        largest = (std::max)({largest, -m_least[c], m_most[c]});
    return largest;
  }

private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Coordinates m_least = {infinity, infinity, infinity};
  Coordinates m_most = {-infinity, -infinity, -infinity};
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_BOUNDING_BOX_H
