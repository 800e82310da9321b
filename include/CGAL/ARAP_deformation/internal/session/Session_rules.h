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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_RULES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_RULES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core.h>

namespace CGAL {
namespace ARAP {
namespace internal {

// In what the class ARAP_deformation and the drop-in class differ.
struct Session_rules
{
  Minimization_order order = Minimization_order::local_first;

  // whether unconstrained components make a run fail, instead of staying where they are
  bool are_unconstrained_refused = false;

  // whether vertices that leave the region of interest return to the rest shape when it is next
  // used
  bool are_erased_put_back = false;

  // whether rotations survive a change of the region of interest before a run
  bool are_rotations_kept = false;
};

// those of CGAL's Surface_mesh_deformation
constexpr Session_rules cgal_rules()
{
  return {Minimization_order::global_first, true, true, true};
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SESSION_RULES_H
