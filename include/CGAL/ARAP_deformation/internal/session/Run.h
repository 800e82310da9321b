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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_RUN_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_RUN_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Observer.h>
#include <CGAL/ARAP_deformation/internal/session/Built_core.h>
#include <CGAL/ARAP_deformation/internal/session/Region_constraints.h>

namespace CGAL {
namespace ARAP {
namespace internal {

// A run of a core, and what it works on.
class Run
{
public:
  // starts at the present positions, and reports what moves
  Run(Built_core& core, const Region_rows& rows, Report& report);
  ~Run();

  Array<Coordinates> positions;
  Targets targets;

  // moves the positions
  Outcome run(const Options& options, const Observer& observe, Report& report);

  // to be called when they have become those of the core: its rotations become those of the run
  void finish(Report& report);

private:
  Built_core& m_core;
  const Region_rows& m_rows;
  Array<Matrix_3x3> m_rotations;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/session/Run_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_RUN_H
