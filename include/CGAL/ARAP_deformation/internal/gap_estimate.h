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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_GAP_ESTIMATE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_GAP_ESTIMATE_H

#include <CGAL/license/ARAP_deformation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// below this, a difference between two evaluations of the energy means nothing
inline double energy_resolution(double energy, double scale)
{
  return std::numeric_limits<double>::epsilon() * (std::abs(energy) + scale);
}

// Estimates (E - E*) / E* from the energies E_0, ..., E_k = E of a run that tends to E*: the
// decreases over the second half of the run are taken for a geometric series and summed to the end.
// Infinity where there are too few of them, or where they do not shrink; 0 where the last one is
// too small to be seen.
inline double estimate_relative_gap(const std::vector<double>& energy, double scale)
{
  const double infinity = (std::numeric_limits<double>::infinity)();
  const std::size_t k = energy.size() - 1, half = k / 2;
  if(k < 1)
    return infinity;
  const double resolution = energy_resolution(energy[k], scale);
  const double last = energy[k - 1] - energy[k];
  if(std::abs(last) <= resolution)
    return 0;
  if(half < 2)
    return infinity;
  const double earlier = energy[half - 1] - energy[half];
  if(!(0 < last && last < earlier))
    return infinity;
  const double ratio = std::pow(last / earlier, 1.0 / static_cast<double>(k - half));
  const double gap = last * ratio / (1 - ratio);
  return gap / (std::max)(std::abs(energy[k] - gap), resolution);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_GAP_ESTIMATE_H
