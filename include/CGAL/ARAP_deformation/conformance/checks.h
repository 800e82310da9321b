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

#ifndef CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECKS_H
#define CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECKS_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/minimizer/gap_estimate.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationChecks
/// returns whether \f$R^T R = I\f$ and \f$\det R = +1\f$, each entry up to `tolerance`.
inline bool is_rotation(const Matrix_3x3& r, double tolerance = 1e-12)
{
  return internal::is_rotation(r, tolerance);
}

/// \ingroup PkgARAPDeformationChecks
/// returns the number of the first iteration that makes the energy rise, or 0 if none does.
/// Differences below the rounding error of the energy do not count.
inline std::size_t first_rise_of_energy(const Report& report)
{
  for(std::size_t k = 1; k < report.energy.size(); ++k)
  {
    const double before = report.energy[k - 1];
    if(!(report.energy[k] <= before + internal::energy_resolution(before, report)))
      return k;
  }
  return 0;
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECKS_H
