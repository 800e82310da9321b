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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_PSEUDORANDOM_VECTORS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_PSEUDORANDOM_VECTORS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// A pseudorandom vector for each of the first points of an array, which outlives it. It depends on
// where the point is and not on the order of the points, but for those at the same place, as in two
// layers: these are told apart by how many come before.
class Pseudorandom_vectors
{
public:
  Pseudorandom_vectors(const Array<Coordinates>& points, std::size_t number_of_points)
    : m_points(points)
  {
    std::vector<std::size_t> order(number_of_points);
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return points[a] != points[b] ? points[a] < points[b] : a < b;
    });
    for(std::size_t k = 1; k < number_of_points; ++k)
      if(points[order[k]] == points[order[k - 1]])
      {
        m_copies.resize(number_of_points, 0);
        m_copies[order[k]] = m_copies[order[k - 1]] + 1;
      }
  }

  // three numbers between -1/2 and 1/2
  Coordinates operator()(std::size_t k) const
  {
    const Coordinates& p = m_points[k];
    const Coordinates place = {p[0] + 0., p[1] + 0., p[2] + 0.}; // -0 is 0
    std::array<std::uint32_t, 6> words;
    static_assert(sizeof(words) == sizeof(place));
    std::memcpy(words.data(), place.data(), sizeof(words));
    words[0] += m_copies.empty() ? 0 : m_copies[k];
    std::seed_seq(words.begin(), words.end()).generate(words.begin(), words.begin() + 3);
    Coordinates result;
    for(std::size_t i = 0; i < result.size(); ++i)
      result[i] = words[i] / 4294967296.0 - 0.5;
    return result;
  }

private:
  const Array<Coordinates>& m_points;
  std::vector<std::uint32_t> m_copies; // none if no points are at the same place
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_PSEUDORANDOM_VECTORS_H
