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

#ifdef ARAP_DEFORMATION_BENCHMARK_LIBIGL // CMakeLists.txt defines it if libigl is found

#include "include/libigl_deformation.h"

#include "include/measure.h"

#include <igl/arap.h>

namespace benchmark {

struct Libigl_deformation::Data : igl::ARAPData
{};

Libigl_deformation::Libigl_deformation(const Libigl_scenario& scenario, Libigl_energy energy)
  : m_scenario(scenario)
{
  const Stopwatch stopwatch;
  m_data = std::make_unique<Data>();
  m_data->energy = energy == Libigl_energy::spokes ? igl::ARAP_ENERGY_TYPE_SPOKES
                                                   : igl::ARAP_ENERGY_TYPE_ELEMENTS;
  if(!igl::arap_precomputation(scenario.points, scenario.simplices, 3, scenario.fixed, *m_data))
    throw Failure("libigl: arap_precomputation() failed");
  m_preprocess_seconds = stopwatch.seconds();
}

Libigl_deformation::~Libigl_deformation() = default;

double Libigl_deformation::run(unsigned int iterations)
{
  m_points = m_scenario.points;
  m_data->max_iter = static_cast<int>(iterations);
  const Stopwatch stopwatch;
  if(!igl::arap_solve(m_scenario.targets, *m_data, m_points))
    throw Failure("libigl: arap_solve() failed");
  return stopwatch.seconds();
}

} // namespace benchmark

#endif // ARAP_DEFORMATION_BENCHMARK_LIBIGL
