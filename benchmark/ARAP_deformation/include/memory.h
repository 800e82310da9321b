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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_MEMORY_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_MEMORY_H

// The memory of this process, as Linux tells it.

#include <fstream>
#include <limits>
#include <string>

namespace benchmark {

// of VmHWM, the peak of the resident set, or of VmRSS, its present size
inline double megabytes(const std::string& name)
{
  std::ifstream file("/proc/self/status");
  for(std::string word; file >> word;)
    if(double units; word == name + ':' && file >> units)
      return units * 1024 / 1e6;
  return std::numeric_limits<double>::quiet_NaN();
}

// The next peak is of what comes now. Returns whether that succeeded.
inline bool reset_peak()
{
  return bool(std::ofstream("/proc/self/clear_refs") << "5" << std::flush);
}

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_MEMORY_H
