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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_SCOPED_SECONDS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_SCOPED_SECONDS_H

#include <CGAL/license/ARAP_deformation.h>

#include <chrono>

namespace CGAL {
namespace ARAP {
namespace internal {

// adds the time from its construction to its destruction to a number of seconds
class Scoped_seconds
{
  using Clock = std::chrono::steady_clock;

public:
  explicit Scoped_seconds(double& seconds) : m_seconds(seconds), m_start(Clock::now()) {}
  Scoped_seconds(const Scoped_seconds&) = delete;
  Scoped_seconds& operator=(const Scoped_seconds&) = delete;

  ~Scoped_seconds()
  {
    m_seconds += std::chrono::duration<double>(Clock::now() - m_start).count();
  }

private:
  double& m_seconds;
  Clock::time_point m_start;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_SCOPED_SECONDS_H
