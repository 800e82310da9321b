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

#ifndef CGAL_ARAP_DEFORMATION_REPORT_H
#define CGAL_ARAP_DEFORMATION_REPORT_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Status.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationRun
/// the wall-clock time of each phase of a call, in seconds.
struct Phase_seconds
{
  double preprocess = 0;    ///< region, weights, matrix and factorization; 0 if all was up to date
  double initial_guess = 0; ///< its factorization (once a preprocessing) and its solution
  double local_steps = 0;   ///< rotations, energy and gradient, over all iterations
  double global_steps = 0;  ///< substitutions over the factor, over all iterations
  double total = 0;         ///< the whole call
};

/// \ingroup PkgARAPDeformationRun
/// \brief tells which stages a call had to do again; all others served as they were.
///
/// Time: `region` and `order` are linear in the region, up to the ordering; `factor` is that of a
/// sparse Cholesky factorization; `border` follows the number of changed vertices.
struct Stages
{
  bool region = false;        ///< its vertices, simplices, weights and cells
  bool order = false;         ///< the fill-reducing order and the pattern of the factor
  bool factor = false;        ///< the numeric factorization
  bool border = false;        ///< a border of the factor, for few vertices that were fixed or freed
  bool initial_guess = false; ///< the factorization for the initial guess
};

/// \ingroup PkgARAPDeformationRun
/// \brief tells what a call of `CGAL::ARAP_deformation::deform()` or `CGAL::arap_deform()` did.
///
/// Where `succeeded(status)` is `false` the mesh and the object are as they were before the call.
struct Report : Outcome
{
  unsigned int iterations = 0; ///< the number of global steps taken

  /// the energy \f$E\f$, always with the best rotations for the positions: `energy[0]` at the
  /// initial guess, `energy[k]` after `k` iterations. Each edge of each cell counts
  /// \f$w \|e' - R e\|^2\f$, without any further factor, and each soft control vertex
  /// \f$m \|p' - t\|^2\f$.
  std::vector<double> energy;

  /// \f$s\f$, the energy's natural unit: \f$\sum k |w| \|e\|^2\f$ over the edges of all cells in
  /// the rest shape; larger with the square of what the positions and targets span, where that is
  /// more than what the rest shape does.
  double energy_scale = 0;

  /// \f$z\f$, what rounding the coordinates makes of an energy of zero: it is large where targets,
  /// or all, are far from the origin. Of an energy \f$E\f$ it makes about \f$16 \sqrt{E z}\f$.
  /// Differences that are below this, or below a rounding error of \f$E + s\f$, mean nothing.
  double rounding_level = 0;

  /// an estimate of \f$(E - E^*) / E^*\f$, with \f$E^*\f$ the minimum that the run tends to,
  /// extrapolated from the decreases of the energy; infinity where too few are known, or where they
  /// do not shrink. It is meant to be too large rather than too small, but it is not a bound: see
  /// \ref ARAPDeformation_Gap for how good it is.
  double estimated_relative_gap = (std::numeric_limits<double>::infinity)();

  std::size_t free_vertices = 0; ///< vertices whose positions were solved for
  std::size_t simplices = 0;     ///< simplices in the region that was considered

  /// tetrahedra among them that are inside out: the sign of their volume is no longer that in the
  /// rest shape. 0 on a surface, whose faces have no inside.
  std::size_t inverted_simplices = 0;

  /// the connected parts of the region that nothing holds, each by the smallest index of its
  /// vertices: no chain of edges of non-zero weight ties it to a vertex that is fixed or pulled to
  /// a target. They stayed where they were, and are not counted above. Always empty for
  /// `Surface_mesh_deformation`, which refuses them.
  std::vector<std::size_t> unconstrained_components;

  Stages stages; ///< what was done before the iterations, because of what had changed

  Phase_seconds seconds; ///< where the time went
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_REPORT_H
