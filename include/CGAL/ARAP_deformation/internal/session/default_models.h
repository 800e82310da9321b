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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_DEFAULT_MODELS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_DEFAULT_MODELS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>

namespace CGAL {
namespace ARAP {
namespace internal {

using Default_solver = Multifrontal_cholesky_solver;

using Default_closest_rotation = Newton_closest_rotation;

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_DEFAULT_MODELS_H
