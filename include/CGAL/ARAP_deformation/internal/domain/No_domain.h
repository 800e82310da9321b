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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_NO_DOMAIN_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_NO_DOMAIN_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/Point_conversion.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The domain of what is refused, so that there is no second error: it has what a domain needs, and
// takes every vertex.
struct No_domain : Point_conversion<Coordinates>
{
  struct Anything
  {
    template <typename T>
    Anything(const T&) {}
    friend bool operator==(const Anything&, const Anything&) { return true; }
  };
  using Point = Coordinates;
  using vertex_descriptor = Anything;
  using simplex_descriptor = Anything;
  static constexpr int dimension = 2;

  template <typename Mesh>
  explicit No_domain(Mesh&) {}

  std::size_t index(Anything) const { return 0; }
  Point point(Anything) const { return {}; }
  void set_point(Anything, const Point&) const {}
  bool is_in_place() const { return true; }
  std::array<Anything, 0> vertices() const { return {}; }
  bool is_isolated(Anything) const { return true; }
  std::array<Anything, 0> simplex_vertices(Anything) const { return {}; }
  template <typename Function>
  void for_each_incident_simplex(Anything, const Function&) const {}
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_NO_DOMAIN_H
