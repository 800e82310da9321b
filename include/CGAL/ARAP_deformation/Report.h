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

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
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
  double preprocess = 0;    ///< region, weights, matrix, factorization; near 0 if up to date
  double transfer = 0;      ///< targets and points read, and points written
  double initial_guess = 0; ///< the initial guess
  double local_steps = 0;   ///< rotations, energy and gradient, over all iterations
  double global_steps = 0;  ///< solves with the factor, over all iterations, and coarse metrics
  double visitor = 0;       ///< in the visitor
  double total = 0;         ///< the whole call: the sum of these and of all other work
};

/// \ingroup PkgARAPDeformationRun
/// what the second derivative of the energy tells of where a run ended, see
/// \ref ARAPDeformation_Ends.
enum class End
{
  unknown, ///< nothing: the run did not converge, or did not look, or a solver failed as it looked
  minimum, ///< a local minimum: no direction of negative curvature was found, and the gap is within
           ///< the tolerance by the second derivative, too; or the energy is next to zero, and the
           ///< weights allow none below
  flat,    ///< there is a direction of negative curvature, but following the last ones gained less
           ///< than a hundredth of what the tolerance allows, or nothing, or ten moves were made
  undecided ///< the gap is within the tolerance as far as is known, but the look was too short to
            ///< exclude a negative curvature, or there is one of zero, up to rounding; or by the
            ///< second derivative the gap is larger, but the energy does not fall, up to rounding;
            ///< or it falls slowly along a curved valley, where the second derivative tells little
};

/// \ingroup PkgARAPDeformationRun
/// returns the name of the enumerator `end`.
inline const char* to_string(End end)
{
  switch(end)
  {
  case End::unknown: return "unknown";
  case End::minimum: return "minimum";
  case End::flat: return "flat";
  case End::undecided: return "undecided";
  }
  return "unknown";
}

/// \ingroup PkgARAPDeformationRun
/// \brief tells which stages a run did, and calls of `preprocess()` since the run before; all
/// others served as they were.
///
/// Time: `region`, `weights` and `order` are linear in the region, up to the ordering; `factor` is
/// that of a sparse Cholesky factorization; `border` follows the part of the factor that the
/// changed vertices reach in the elimination tree, after a pass over the region.
struct Stages
{
  bool region = false;        ///< its vertices, simplices and cells
  bool weights = false;       ///< the weights of its edges
  bool order = false;         ///< the fill-reducing order and the pattern of the factor
  bool factor = false;        ///< the numeric factorization
  bool border = false;        ///< a border of the factor, for few vertices that were fixed, freed
                              ///< or given another weight, few soft control points that changed,
                              ///< and the constraints of hard control points
};

/// \ingroup PkgARAPDeformationRun
/// \brief describes what a call of `CGAL::ARAP_deformation::deform()` or `CGAL::arap_deform()` did.
///
/// If `succeeded(status)` is `false`, the mesh and the object are as they were before the call.
struct Report : Outcome
{
  unsigned int iterations = 0; ///< the number of iterations; each costs about one solve

  /// the initial guess that the run took: `rotations` if any part starts from these; never
  /// `automatic`; `previous` where it could not have the Laplacian one.
  Initial_guess initial_guess = Initial_guess::previous;

  /// returns the last of the energies below; not a number if the call failed before the first one.
  double final_energy() const
  {
    return energy.empty() ? std::numeric_limits<double>::quiet_NaN() : energy.back();
  }

  /// the energy \f$E\f$, always with the optimal rotations for the positions: `energy[0]` for the
  /// initial guess, `energy[k]` after `k` iterations. Each edge of each cell contributes
  /// \f$k w \|e' - R e\|^2\f$ with the stiffness \f$k\f$ of the cell, without any further factor,
  /// and each soft control vertex or control point \f$m \|p' - t\|^2\f$, except for control
  /// points of which no corner can move; bending and smooth rotations add their terms. Smooth
  /// rotations are those that one fit makes of the last ones. With cotangent weights it is an area
  /// on a surface and a volume in tetrahedra, in the unit of the points.
  std::vector<double> energy;

  /// \f$s\f$, the natural unit of the energy: the sum of \f$|w| \|e\|^2\f$ over the edges of all
  /// cells in the rest shape. Scaled with the squared diagonal of the bounding box of positions and
  /// targets where that is larger than that of the rest shape.
  double energy_scale = 0;

  /// \f$z\f$, the rounding level of the energy: the value that rounding the coordinates makes of a
  /// zero energy. It is large if the targets, or the whole shape, are far from the origin. The
  /// rounding error of an energy \f$E\f$ is about \f$16 \sqrt{E z}\f$. Differences below this, or
  /// below the rounding error of \f$E + s\f$, are meaningless.
  double rounding_level = 0;

  /// an estimate of \f$(E - E^*) / E^*\f$, where \f$E^*\f$ is the minimum that the run converges
  /// to, extrapolated from the decreases of the energy; infinity if there are too few of them, or
  /// if they do not shrink. A look at the second derivative may raise it. It is infinity, too, if
  /// the iterations run out, or a visitor stops, after a look found it wrong or found a negative
  /// curvature. Next to a minimum of zero it is relative to \f$10^{-9} s\f$, or to
  /// \f$10^{-6} E_0\f$ where that is less. It errs on the large side, but is not a bound: see
  /// \ref ARAPDeformation_Gap for its accuracy.
  double estimated_relative_gap = (std::numeric_limits<double>::infinity)();

  End end = End::unknown; ///< what kind of place the run ended at.

  /// the number of saddle points that the run would have ended at, and has left: they had a
  /// direction of negative curvature.
  unsigned int saddles_left = 0;

  /// the number of plateaus that the run has left in the same way: there the gap was larger than
  /// estimated, or could not be determined from the second derivative.
  unsigned int plateaus_left = 0;

  /// the number of iterations that looked at the second derivative, or tried where it leads, and
  /// moved nothing.
  unsigned int looking_iterations = 0;

  std::size_t free_vertices = 0; ///< the number of vertices that were solved for
  /// the number of simplices in and around the region of interest; where hard control vertices are
  /// more than half of it, those far from everything that can move may be left out
  std::size_t simplices = 0;

  /// the number of these tetrahedra that are inverted: the sign of their volume differs from that
  /// in the rest shape. 0 on a surface.
  std::size_t inverted_simplices = 0;

  /// the unconstrained components of the region, each given by its smallest vertex index: no path
  /// of edges of non-zero weight connects them to a vertex that is fixed or has a target of
  /// positive weight, and no control points hold them. (One control point with corners in two
  /// components holds neither of them if nothing else does; with a hard target that is an error.)
  /// They stay where they are, and `free_vertices` does not count them. Always empty for
  /// `Surface_mesh_deformation`, where they are an error.
  std::vector<std::size_t> unconstrained_components;

  Stages stages; ///< what was done before the iterations, because of what had changed

  Phase_seconds seconds; ///< the time of each phase
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_REPORT_H
