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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_TIME_STEP_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_TIME_STEP_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Time_step.h>

#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
Outcome Time_step::check() const
{
  Outcome checked = dynamics.check();
  if(checked && !(inertia() > 0 && is_finite(inertia())))
    return Outcome(Status::invalid_option, "time_step, density, modulus and damping of the "
                   "dynamics differ too much in size: their inertia is zero or infinite");
  return checked;
}

CGAL_ARAP_INLINE_FUNCTION
double Time_step::inertia() const
{
  return dynamics.density * damping() /
         (2 * dynamics.modulus * dynamics.time_step * dynamics.time_step);
}

CGAL_ARAP_INLINE_FUNCTION
Coordinates Time_step::goal(Coordinates x, const Coordinates& velocity) const
{
  const double h = dynamics.time_step;
  add(x, h / damping(), velocity);
  add(x, h * h / damping(), dynamics.acceleration);
  return x;
}

CGAL_ARAP_INLINE_FUNCTION
double Time_step::mobility(double content) const
{
  return dynamics.time_step * dynamics.time_step / (damping() * dynamics.density * content);
}

CGAL_ARAP_INLINE_FUNCTION
double Time_step::measure(const Array<double>& contents, const Array<Coordinates>& x,
                          Step_report& report) const
{
  const auto for_each = [&](const auto& f) { // f(v, m_v, v_v)
    for(std::size_t v = 0; v < contents.size(); ++v)
      if(contents[v] > 0)
        f(v, dynamics.density * contents[v],
          scaled(difference(x[v], start[v]), 1 / dynamics.time_step));
  };
  double inertia_energy = 0;
  for_each([&](std::size_t v, double mass, const Coordinates& velocity) {
    report.mass += mass;
    add(report.center_of_mass, mass, x[v]);
    add(report.momentum, mass, velocity);
    report.kinetic_energy += 0.5 * mass * dot(velocity, velocity);
    const Coordinates residual = difference(x[v], goals[v]);
    inertia_energy += inertia() * contents[v] * dot(residual, residual);
  });
  const double energy = report.final_energy() - inertia_energy;
  report.elastic_energy = dynamics.modulus * energy;
  if(!(report.mass > 0))
    return energy;
  report.center_of_mass = scaled(report.center_of_mass, 1 / report.mass);
  for_each([&](std::size_t v, double mass, const Coordinates& velocity) {
    add(report.angular_momentum, mass, cross(difference(x[v], report.center_of_mass), velocity));
  });
  return energy;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_TIME_STEP_IMPL_H
