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

#ifndef CGAL_ARAP_DEFORMATION_DYNAMICS_H
#define CGAL_ARAP_DEFORMATION_DYNAMICS_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>

#include <string>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationOptions
/// \brief what a time step of `CGAL::ARAP_deformation::advance()` needs, in any consistent units:
/// with kilograms, meters and seconds, the modulus is in Pascal for tetrahedra, and in Newton per
/// meter for surfaces. See \ref ARAPDeformation_DynamicsTheory for the equations.
struct Dynamics
{
  /// \f$h\f$, positive and finite. A new value requires a factorization.
  double time_step = 1.0 / 60;

  /// \f$\rho\f$, the mass of a unit of the volume, or of the area of a surface; positive and
  /// finite. A vertex has its share in the rest shape: an equal part of each of its simplices.
  /// A new value requires a factorization.
  double density = 1;

  /// \f$\mu\f$, which makes an elastic energy \f$\mu E\f$ of the energy \f$E\f$; positive and
  /// finite. \f$\mu\f$ is an energy per volume for tetrahedra, and per area for surfaces. It
  /// multiplies soft targets, too: one of weight \f$m\f$ pulls like a spring of the constant
  /// \f$2 \mu m\f$. A new value requires a factorization.
  double modulus = 1;

  /// \f$d\f$, the rate at which velocities decay, one over a time, not negative and finite: 0 for
  /// none. A new value requires a factorization.
  double damping = 0;

  /// the acceleration of all vertices, such as that of gravity; of points with two coordinates the
  /// third does not count
  Coordinates acceleration = {0, 0, 0};

  /// returns `Status::success`, or `Status::invalid_option` and a message that names the member.
  Outcome check() const
  {
    const auto is_positive = [](double x) { return x > 0 && internal::is_finite(x); };
    const char* const wrong = !is_positive(time_step) ? "time_step"
                              : !is_positive(density) ? "density"
                              : !is_positive(modulus) ? "modulus" : nullptr;
    if(wrong)
      return Outcome(Status::invalid_option,
                     std::string(wrong) + " of the dynamics must be positive and finite");
    if(!(damping >= 0) || !internal::is_finite(damping))
      return Outcome(Status::invalid_option,
                     "damping of the dynamics must be finite and not negative");
    for(double a : acceleration)
      if(!internal::is_finite(a))
        return Outcome(Status::invalid_option, "acceleration of the dynamics must be finite");
    return Outcome(Status::success, "the dynamics are valid");
  }
};

/// \ingroup PkgARAPDeformationRun
/// \brief describes a time step, and the motion after it: that of the free vertices.
///
/// `energy` is what was minimized, \f$E + \sum_v w_v \|p'_v - y_v\|^2\f$.
struct Step_report : Report
{
  double mass = 0;                            ///< of all free vertices
  Coordinates center_of_mass = {0, 0, 0};     ///< their center of mass
  Coordinates momentum = {0, 0, 0};           ///< \f$\sum_v m_v v_v\f$
  Coordinates angular_momentum = {0, 0, 0};   ///< about the center of mass
  double kinetic_energy = 0;                  ///< \f$\sum_v m_v \|v_v\|^2 / 2\f$
  double elastic_energy = 0; ///< \f$\mu E\f$, with what soft targets store
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_DYNAMICS_H
