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

#ifndef CGAL_ARAP_DEFORMATION_EDGE_WEIGHTS_H
#define CGAL_ARAP_DEFORMATION_EDGE_WEIGHTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/flat_types.h>

#include <array>
#include <cmath>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationWeights
/// \brief cotangent weights as they are, of either sign.
///
/// The edge of a triangle weighs half the cotangent of the opposite angle, the edge of a star the
/// sum over its triangles: \f$w_{ij} = (\cot \alpha_{ij} + \cot \beta_{ij}) / 2\f$
/// \cgalCite{Pinkall1993Cotangent}. With simplices as edge sets the energy is never negative. With
/// stars it can be where angles are obtuse, and its minimum is then a distorted shape:
/// prefer `Safe_cotangent_weight`.
///
/// \cgalModels{ARAPEdgeWeight_3}
class Cotangent_weight
{
public:
  /// returns the weights of the edges \f$(0,1)\f$, \f$(0,2)\f$, \f$(1,2)\f$ of a triangle.
  /// They are not finite if the triangle has no area.
  std::array<double, 3> simplex_weights(const std::array<Coordinates, 3>& triangle) const
  {
    return {half_cotangent(triangle[2], triangle[0], triangle[1]),
            half_cotangent(triangle[1], triangle[0], triangle[2]),
            half_cotangent(triangle[0], triangle[1], triangle[2])};
  }

  /// returns `sum`.
  double edge_weight(Edge_set, double sum) const { return sum; }

private:
  static double half_cotangent(const Coordinates& apex, const Coordinates& p, const Coordinates& q)
  {
    const Coordinates a = {p[0] - apex[0], p[1] - apex[1], p[2] - apex[2]};
    const Coordinates b = {q[0] - apex[0], q[1] - apex[1], q[2] - apex[2]};
    const double sine = std::hypot(a[1] * b[2] - a[2] * b[1],
                                   a[2] * b[0] - a[0] * b[2],
                                   a[0] * b[1] - a[1] * b[0]);
    const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return 0.5 * cosine / sine;
  }
};

/// \ingroup PkgARAPDeformationWeights
/// \brief cotangent weights, of which negative ones are replaced by 0.
///
/// It is the weight of an edge in its edge set that is clamped: in a star the sum over the
/// triangles at the edge. The energy is never negative, whatever the cells. With simplices as
/// edge sets obtuse triangles lose an edge, and the identity of `Cotangent_weight` with the area
/// is lost there too: prefer `Safe_cotangent_weight`.
///
/// \cgalModels{ARAPEdgeWeight_3}
class Clamped_cotangent_weight : public Cotangent_weight
{
public:
  /// returns `sum` or 0, whichever is larger; a `sum` that is not a number is returned.
  double edge_weight(Edge_set, double sum) const { return sum < 0 ? 0 : sum; }
};

/// \ingroup PkgARAPDeformationWeights
/// \brief clamped cotangents for stars, cotangents for simplices: the default.
///
/// The closest to the cotangent weights for which no cell scheme has a negative energy.
///
/// \cgalModels{ARAPEdgeWeight_3}
class Safe_cotangent_weight : public Cotangent_weight
{
public:
  /// returns `sum`, or 0 if `edge_set` is a star and `sum` is negative.
  double edge_weight(Edge_set edge_set, double sum) const
  {
    return edge_set == Edge_set::star && sum < 0 ? 0 : sum;
  }
};

/// \ingroup PkgARAPDeformationWeights
/// \brief 1 for each edge of each edge set, whatever the shape.
///
/// Needs no geometry and never fails, but the result depends on how the shape is meshed (Figure 2
/// of \cgalCite{Sorkine2007AsRigidAs}).
///
/// \cgalModels{ARAPEdgeWeight_3}
class Uniform_weight
{
public:
  /// returns 1 for each edge.
  std::array<double, 3> simplex_weights(const std::array<Coordinates, 3>&) const
  {
    return {1, 1, 1};
  }

  /// returns 1.
  double edge_weight(Edge_set, double) const { return 1; }
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_EDGE_WEIGHTS_H
