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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_GAP_ESTIMATE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_GAP_ESTIMATE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Report.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// below this, a difference between two evaluations of the energy means nothing
inline double energy_resolution(double energy, const Report& report)
{
  const double size = std::abs(energy);
  return std::numeric_limits<double>::epsilon() * (size + report.energy_scale) +
         16 * std::sqrt(size) * std::sqrt(report.rounding_level) + report.rounding_level;
}

// an energy below which nothing is left to be gained
inline double negligible_energy(const Report& report)
{
  return (std::max)(report.rounding_level,
                    (std::min)(1e-9 * report.energy_scale, 1e-6 * report.energy[0]));
}

// Estimates (E - E*) / E* for a run that has reached the energy E by some decreases and tends to
// E*. The decreases of the last tenth of the run and those of the tenth before it are taken for two
// terms of a geometric series, which is summed to its end. Two things keep the estimate from being
// too small, which is worse than too large: terms are not believed to shrink to less than half, and
// what counts is the largest of the sums that were found lately. A run often seems to be at its end
// when it has only moved what is local, or when it passes a saddle. From 1000 iterations on, not
// every one is looked at: a look takes time for a fifth of all decreases.
//
// No minimum is below zero, up to cells of negative energy. Where it is zero, or next to it, the
// gap is compared with a share of the energy's scale, below which nothing is left to be gained. For
// small motions that is a share of the energy at the start.
class Gap_estimate
{
public:
  void add(double decrease, const Report& report)
  {
    m_decreases.push_back(decrease);
    if(const double energy = report.energy.back(); energy < m_least_energy) // before this decrease
    {
      m_least_energy = energy;
      m_place_of_least = report.energy.size() - 1;
    }
    const std::size_t n = m_decreases.size(), stride = 1 + n / 1000;
    if(m_looks.empty() || n - m_looks.back().iteration >= stride)
      m_looks.push_back({n, extrapolated_gap(report)});
  }

  // infinity where too little is known, or where the decreases do not shrink
  double operator()(double energy, const Report& report) const
  {
    const double zero = negligible_energy(report);
    if(std::abs(energy) <= report.rounding_level ||
       (!m_decreases.empty() && m_decreases.back() == 0))
      return 0;
    // the gap is at most the energy
    const double largest = 0 < energy && energy <= zero ? energy / zero : infinity;
    const std::size_t n = share(15);
    if(m_decreases.size() < n)
      return largest;
    // Where weights are large, as those of thin simplices, a solution has larger errors than its
    // coordinates: what they make of zero goes up and down.
    if(std::abs(energy) <= epsilon * report.energy_scale && energy >= m_least_energy &&
       m_place_of_least + n < report.energy.size())
      return 0;
    double gap = -infinity;
    for(auto look = m_looks.rbegin();
        look != m_looks.rend() && look->iteration + n > m_decreases.size(); ++look)
      gap = (std::max)(gap, look->gap);
    const double minimum = energy - gap;
    return energy > 0 && minimum <= 0
             ? largest : (std::min)(largest, gap / (std::max)(std::abs(minimum), zero));
  }

private:
  struct Look
  {
    std::size_t iteration;
    double gap;
  };

  static constexpr double infinity = (std::numeric_limits<double>::infinity)();
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  // some percent of the number of iterations, but not too few to tell anything
  std::size_t share(std::size_t percent) const
  {
    return (std::max)(std::size_t(5), m_decreases.size() * percent / 100);
  }

  double extrapolated_gap(const Report& report) const
  {
    const std::size_t n = share(10);
    if(m_decreases.size() < 2 * n)
      return infinity;
    const double* const end = m_decreases.data() + m_decreases.size();
    const double last = std::accumulate(end - n, end, 0.0);
    const double earlier = std::accumulate(end - 2 * n, end - n, 0.0);
    if(std::abs(last) <= report.rounding_level) // nothing but rounding is left
      return 0;
    const double ratio = (std::max)(last / earlier, 0.5);
    return 0 < last && 0 < earlier && ratio < 1 ? last * ratio / (1 - ratio) : infinity;
  }

  std::vector<double> m_decreases;
  std::vector<Look> m_looks;
  double m_least_energy = infinity;
  std::size_t m_place_of_least = 0; // in the report
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_GAP_ESTIMATE_H
