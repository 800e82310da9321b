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

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_TARGET_SETS_H
