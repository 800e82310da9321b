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

#ifndef CGAL_ARAP_DEFORMATION_OPTIONS_H
#define CGAL_ARAP_DEFORMATION_OPTIONS_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationOptions
/// the initial guess of a run. Hard control vertices always start at their targets.
enum class Initial_guess
{
  automatic, ///< `previous`, except for connected parts where the distance of a fixed vertex from a
             ///< neighbor has changed by more than a tenth of the diagonal of the bounding box of
             ///< the part, or a soft target is that far from its vertex: these start from
             ///< `rotations` if that lowers the energy. Quasi-Newton runs on surfaces with 20,000
             ///< free vertices or more then deform a coarser surface
             ///< (\ref ARAPDeformation_CoarseStart).
  previous, ///< the current positions: for interaction, where each frame starts from the last
  rotations, ///< Poisson editing \cgalCite{Zayer2005Harmonic}: the rotations of the handles against
             ///< the rest shape are interpolated harmonically, and one global step with them gives
             ///< the positions. Costs two solves with the factor. A handle of several connected
             ///< vertices has the rotation of its motion. A single vertex has none, unless it is a
             ///< frame, and a control point has none: they cost two more solves. If no handle of a
             ///< connected part has one, the part has the rotation of their motion as a whole.
  laplacian ///< naive Laplacian editing: minimizes \f$\|L p' - L p\|^2\f$ with the fixed vertices
            ///< where they are, and the control vertices, soft ones of positive weight included, at
            ///< their targets. \f$L\f$ is the Laplacian with star weights, whatever the cells, and
            ///< \f$p\f$ the rest shape. Costs about as much as some tens of iterations. Where 300
            ///< do not suffice, as with a bending length of many edges, or the result is of no
            ///< use, far larger than the shape, it is `previous`; `Report::initial_guess` tells.
};

/// \ingroup PkgARAPDeformationOptions
/// returns the name of the enumerator `guess`.
inline const char* to_string(Initial_guess guess)
{
  switch(guess)
  {
  case Initial_guess::automatic: return "automatic";
  case Initial_guess::previous: return "previous";
  case Initial_guess::rotations: return "rotations";
  case Initial_guess::laplacian: return "laplacian";
  }
  return "unknown";
}

/// \ingroup PkgARAPDeformationOptions
/// the minimization algorithm. With either one the energy never rises, and an iteration is one fit
/// of the rotations and one solve of the linear system; with `Options::smoothing_length` the
/// quasi-Newton one takes two more solves, of another system.
enum class Minimizer
{
  automatic,    ///< `quasi_newton` if `Options::tolerance` is positive, else `local_global`
  local_global, ///< the iteration of the paper \cgalCite{Sorkine2007AsRigidAs}: its iterates can be
                ///< compared with those of other programs, and it needs the least memory; see
                ///< \ref ARAPDeformation_LocalGlobal
  quasi_newton  ///< L-BFGS in the metric of the Laplacian: is ahead from the second iteration on,
                ///< needs an eighth to a thirtieth of the iterations to the minimum, and about 200
                ///< bytes more for each vertex of the region; see \ref ARAPDeformation_QuasiNewton
};

/// \ingroup PkgARAPDeformationOptions
/// the run-time options.
struct Options
{
  /// which edges share a rotation. A new value requires preprocessing again.
  Cell_scheme cells = Cell_scheme::spokes_and_rims();

  /// \f$b\f$, the length over which a sharp bend is spread, in the unit of the points; 0 for none,
  /// else positive and finite. The energy gains \f$b^2 m_i \|f_i(p') - R_i f_i(p)\|^2\f$ at each
  /// vertex, as \cgalCite{Oehri2025HigherOrder} proposes, see \ref ARAPDeformation_BendingTheory;
  /// \ref ARAPDeformation_Bending says which to choose. Needs cells at
  /// vertices. A new value requires weights and a factorization, and 0 instead of another one, or
  /// the other way round, an ordering too. More than a million times the size of what can move is
  /// refused.
  double bending_length = 0;

  /// \f$\ell\f$, the length over which rotations are made smooth, in the unit of the points; 0 for
  /// none, else positive and finite, with the same largest value. The energy gains
  /// \f$\ell^2 s_{cd} \|R_c - R_d\|^2\f$ for neighboring cells, after \cgalCite{levismooth},
  /// see \ref ARAPDeformation_SmoothRotationsTheory. Rotations are then part of the state, and the
  /// energy is minimized over positions and rotations in turns: see
  /// \ref ARAPDeformation_SmoothRotations. A new value requires weights and a factorization.
  double smoothing_length = 0;

  /// the initial guess of each run.
  Initial_guess initial_guess = Initial_guess::automatic;

  /// the minimization algorithm.
  Minimizer minimizer = Minimizer::automatic;

  /// the maximum number of iterations of a run; 0 only moves to the initial guess.
  /// For the frames of a drag call `deform(3, 0)`: with a positive tolerance
  /// `Minimizer::automatic` would be the quasi-Newton method.
  unsigned int iterations = 1000;

  /// a run stops when `Report::estimated_relative_gap` is at most this; finite and not negative.
  /// 0 runs all iterations. The estimate is usually too large, so that the true gap is well below
  /// the tolerance.
  double tolerance = 1e-3;

  /// whether a quasi-Newton run that would end with `Status::converged` first looks at the second
  /// derivative of the energy, and goes on if it is at a saddle point or on a plateau: see
  /// \ref ARAPDeformation_Ends. A look takes some tens of iterations, at most about 310; a run may
  /// look several times. It takes about 450 bytes per vertex, in place of what the quasi-Newton
  /// steps need. Local/global runs, time steps and runs with `smoothing_length` do not look.
  bool verify_minimum = true;

  /// whether a quasi-Newton run with 30,000 free vertices or more adds a coarse metric to that of
  /// the Laplacian, after its first five iterations and where it looks at the second derivative:
  /// see \ref ARAPDeformation_CoarseMetric. It then takes about 0.3 to 0.8 of the iterations, and
  /// about 160 bytes more for each vertex of the region. To prepare it takes as long as some ten
  /// iterations; this is done when it is first needed, and kept until the weights change.
  /// Local/global runs, time steps, runs with `smoothing_length` or with control points that are
  /// not soft, weights for which the energy may be negative, and thousands of small parts, do
  /// without.
  bool coarse_metric = true;

  /// the maximum number of threads at a time; 0 lets TBB choose. Without TBB (the macro
  /// `CGAL_LINKED_WITH_TBB`), and with `Sequential_tag` in the traits, there is only one.
  /// Results are the same to the last bit for any number.
  unsigned int threads = 0;

  /// returns `Status::success`, or `Status::invalid_option` and a message that names the option.
  Outcome check() const;
};

} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/Options_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_OPTIONS_H
