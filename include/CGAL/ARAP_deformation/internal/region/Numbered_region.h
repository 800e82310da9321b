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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_NUMBERED_REGION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_NUMBERED_REGION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/region/Paged_index_map.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// A region with the numbers that the vertices of a mesh have in it. Here is the part of collecting
// it that needs only the indices of vertices.
class Numbered_region
{
public:
  Region flat;
  // the simplices whose smallest vertex is v are first_simplex[v] to first_simplex[v + 1] - 1
  Array<int> first_simplex;
  Paged_index_map numbers; // from the index in the mesh to the number in the region

  // what is wrong with the last simplex, if it is refused, and the index of a vertex of it
  Status refusal() const { return m_refusal; }
  std::size_t refused_vertex() const { return flat.indices[first_simplex.size() - 1]; }

protected:
  // a movable vertex, which gets a number when it is found
  void add_movable(std::size_t index);

  // how many movable vertices have a number: they have the smallest ones
  const int& number_of_found() const { return m_number_of_found; }

  // the number of a vertex, which gets one if it has none
  int number(std::size_t index);

  // Adds a corner to the simplex that is visited at v. Returns false, and forgets the simplex, if
  // the corner is smaller: then it was visited there, and all of its corners have numbers.
  bool add_corner(int v, int corner);

  // Adds the simplex of these corners.
  void add_simplex(bool are_polygons_allowed);

  // whether a simplex was none, or had too many corners
  bool is_refused() const { return m_is_refused; }

  void shrink();

private:
  static constexpr int movable_without_number = -2;

  int m_number_of_found = 0;
  bool m_is_refused = false;
  Status m_refusal = Status::not_a_simplex;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/region/Numbered_region_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_NUMBERED_REGION_H
