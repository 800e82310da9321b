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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_TIME_STEP_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_TIME_STEP_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Dynamics.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>

namespace CGAL {
namespace ARAP {
namespace internal {

// A step of implicit Euler over the time h with damping d: with m (v' - v) / h = f - m d v', where
// v' = (x' - x) / h and f has the elastic force -mu grad E(x'), x' minimizes
//   E(x') + sum_v w_v || x'_v - y_v ||^2,   w_v = m_v (1 + d h) / (2 mu h^2),
// and y_v is where the vertex would go without E.
struct Time_step
{
  Dynamics dynamics;
  Array<Coordinates> start = {}, goals = {}; // x and y, of the vertices of the region

  double damping() const { return 1 + dynamics.damping * dynamics.time_step; }

  // of the dynamics, one by one and together
  Outcome check() const;

  // w_v for a unit of area or volume
  double inertia() const;

  // y_v of a vertex at x without a force of its own
  Coordinates goal(Coordinates x, const Coordinates& velocity) const;

  // what a force adds to y_v, over the force, for a share in the area or volume
  double mobility(double content) const;

  // Fills in the motion after the step, with these energies. Returns E, which times mu is the
  // elastic energy.
  double measure(const Array<double>& contents, const Array<Coordinates>& x,
                 Step_report& report) const;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/session/Time_step_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_TIME_STEP_H
