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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_DIAGNOSIS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_DIAGNOSIS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Status.h>

namespace CGAL {
namespace ARAP {
namespace internal {

// a status with the vertex, simplex or hard row that it is about, where there is one
struct Diagnosis
{
  Status status = Status::success;
  int vertex = -1;
  int simplex = -1;
  int hard_row = -1;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_DIAGNOSIS_H
