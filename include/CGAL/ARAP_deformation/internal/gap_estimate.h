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

// Estimates (E - E*) / E* for a run that has reached the energy E by some decreases and tends to E*.
class Gap_estimate
{
public:
  Gap_estimate() = default;
  explicit Gap_estimate(double) {}
  void add(double decrease) { m_decreases.push_back(decrease); }
  // An energy of at most `zero`, its rounding error, is at its minimum.
  double operator()(double energy, double zero) const
  {
  const std::vector<double>& decreases = m_decreases;
  const double infinity = (std::numeric_limits<double>::infinity)();
  const std::size_t k = decreases.size(), half = k / 2;
  if(std::abs(energy) <= zero || (k > 0 && decreases.back() == 0))
    return 0;
  if(half < 2)
    return infinity;
  const double last = decreases[k - 1], earlier = decreases[half - 1];
  if(!(0 < last && last < earlier))
    return infinity;
  const double ratio = std::pow(last / earlier, 1.0 / static_cast<double>(k - half));
  const double gap = last * ratio / (1 - ratio);
  return gap / (std::max)(std::abs(energy - gap), zero);
  }
private:
  std::vector<double> m_decreases;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_GAP_ESTIMATE_H
