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
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// A step of implicit Euler over the time h with damping d: with m (v' - v) / h = f - m d v', where
// v' = (x' - x) / h and f has the elastic force -mu grad E(x'), x' minimizes
//   E(x') + sum_v w_v || x'_v - y_v ||^2,   w_v = m_v (1 + d h) / (2 mu h^2),
// and y_v is where the vertex would go without E.
template <typename Vertex>
struct Time_step
{
  Dynamics dynamics;
  std::function<Coordinates(Vertex)> force; // none if it is empty
  Array<Coordinates> start = {}, goals = {}; // x and y, of the vertices of the region

  double damping() const { return 1 + dynamics.damping * dynamics.time_step; }

  // w_v for a unit of area or volume
  double inertia() const
  {
    return dynamics.density * damping() /
           (2 * dynamics.modulus * dynamics.time_step * dynamics.time_step);
  }

  // y_v of a vertex at x with its share in the area or volume
  Coordinates goal(Vertex v, Coordinates x, const Coordinates& velocity, double content) const
  {
    const double h = dynamics.time_step;
    add(x, h / damping(), velocity);
    add(x, h * h / damping(), dynamics.acceleration);
    if(force)
      add(x, h * h / (damping() * dynamics.density * content), force(v));
    return x;
  }

  // Fills in the motion after the step, with these energies.
  void measure(const Array<double>& contents, const Array<Coordinates>& x,
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
    report.elastic_energy = dynamics.modulus * (report.final_energy() - inertia_energy);
    if(!(report.mass > 0))
      return;
    report.center_of_mass = scaled(report.center_of_mass, 1 / report.mass);
    for_each([&](std::size_t v, double mass, const Coordinates& velocity) {
      add(report.angular_momentum, mass, cross(difference(x[v], report.center_of_mass), velocity));
    });
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_TIME_STEP_H
