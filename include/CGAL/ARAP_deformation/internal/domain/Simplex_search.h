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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_SIMPLEX_SEARCH_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_SIMPLEX_SEARCH_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>

#include <array>
#include <cstddef>
#include <optional>

namespace CGAL {
namespace ARAP {
namespace internal {

// Finds the triangle (of 3 corners) or the tetrahedron (of 4) that is nearest to a point.
template <std::size_t number_of_corners>
class Simplex_search
{
public:
  using Corners = std::array<Coordinates, number_of_corners>;

  struct Location
  {
    std::size_t simplex; // its index in the argument of make_simplex_search()
    std::array<double, number_of_corners> coordinates; // barycentric; their sum is 1
    double distance; // from the simplex
  };

  virtual ~Simplex_search() = default;
  virtual bool is_empty() const = 0;

  // returns none if the point is so far away that the computation overflows
  virtual std::optional<Location> locate(const Coordinates& point) const = 0;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_SIMPLEX_SEARCH_H
