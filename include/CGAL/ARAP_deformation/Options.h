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

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/Status.h>

#include <cmath>
#include <string>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationOptions
/// where a run starts from; hard control vertices are at their targets in either case.
enum class Initial_guess
{
  previous, ///< the current positions: right for interaction, where each frame starts from the last
  laplacian ///< naive Laplacian editing: the minimizer of \f$\|L p' - L p\|^2\f$ under the fixed
            ///< positions and with all control vertices at their targets, soft ones too; \f$L\f$ is
            ///< the Laplacian of the weights of stars, whatever the cells, and \f$p\f$ the rest
            ///< shape. It costs a second factorization, of \f$L^T L\f$, at its first use after a
            ///< preprocessing.
};

/// \ingroup PkgARAPDeformationOptions
/// how the energy is minimized. By either its value never rises, and an iteration costs about the
/// same: one fit of the rotations and one solution of the linear system.
enum class Minimizer
{
  automatic,    ///< `quasi_newton` if `Options::tolerance` is positive, else `local_global`
  local_global, ///< the iteration of the paper: the most for the first few iterations of a frame,
                ///< and needs the least memory
  quasi_newton  ///< L-BFGS in the metric of the Laplacian: many times fewer iterations to the
                ///< minimum. It takes about 200 bytes more for each free vertex.
};

/// \ingroup PkgARAPDeformationOptions
/// what a program chooses at run time.
struct Options
{
  /// which edges share one rotation. Another choice asks for another preprocessing.
  Cell_scheme cells = Cell_scheme::spokes_and_rims();

  /// where each run starts from.
  Initial_guess initial_guess = Initial_guess::previous;

  /// how the energy is minimized.
  Minimizer minimizer = Minimizer::automatic;

  /// the largest number of iterations of a run; 0 only moves to the initial guess.
  /// Two or three a frame are enough in an interactive program.
  unsigned int iterations = 1000;

  /// the run ends when `Report::estimated_relative_gap` is at most this; not negative.
  /// 0 runs all iterations. The estimate is usually too large, so that the true gap is well below
  /// the tolerance.
  double tolerance = 1e-3;

  /// how many threads may be at work in a call; 0 for as many as TBB takes by itself. Without TBB
  /// (the macro `CGAL_LINKED_WITH_TBB`), and with `Sequential_tag` in the traits, there is one.
  /// Results are the same to the last bit, whatever the number.
  unsigned int threads = 0;

  /// returns `Status::success`, or `Status::invalid_option` and a sentence that names the option.
  Outcome check() const
  {
    if(!(tolerance >= 0) || !std::isfinite(tolerance))
      return Outcome(Status::invalid_option, "the option tolerance is " +
                     std::to_string(tolerance) + "; it must be a finite number, 0 or larger");
    return Outcome(Status::success, "the options are valid");
  }
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_OPTIONS_H
