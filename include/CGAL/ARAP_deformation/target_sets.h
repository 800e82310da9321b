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

#ifndef CGAL_ARAP_DEFORMATION_TARGET_SETS_H
#define CGAL_ARAP_DEFORMATION_TARGET_SETS_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/Line_3.h>
#include <CGAL/Plane_3.h>
#include <CGAL/Point_3.h>

namespace CGAL {

#ifndef DOXYGEN_RUNNING
template <typename AABBTraits>
class AABB_tree; // programs that have one include its header
#endif

namespace ARAP {

/// \ingroup PkgARAPDeformationRef
/// returns the function that projects a point onto a plane, for
/// `CGAL::ARAP_deformation::set_target_set()`.
template <typename Kernel>
auto projection_onto(const Plane_3<Kernel>& plane)
{
  return [plane](const Point_3<Kernel>& p) { return plane.projection(p); };
}

/// \ingroup PkgARAPDeformationRef
/// returns the function that projects a point onto a line, for
/// `CGAL::ARAP_deformation::set_target_set()`.
template <typename Kernel>
auto projection_onto(const Line_3<Kernel>& line)
{
  return [line](const Point_3<Kernel>& p) { return line.projection(p); };
}

/// \ingroup PkgARAPDeformationRef
/// returns the function that finds the point of a surface that is nearest to a point, for
/// `CGAL::ARAP_deformation::set_target_set()`. It refers to the tree, of the triangles of the
/// surface, which must not be empty.
template <typename AABBTraits>
auto projection_onto(const AABB_tree<AABBTraits>& tree)
{
  return [&tree](const typename AABB_tree<AABBTraits>::Point& p) { return tree.closest_point(p); };
}

template <typename AABBTraits>
auto projection_onto(const AABB_tree<AABBTraits>&& tree) = delete; // it would be gone

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_TARGET_SETS_H
