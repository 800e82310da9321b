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

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationWeights
/// \brief unmodified cotangent weights, of either sign.
///
/// The weight of an edge in a triangle is half the cotangent of the opposite angle; in a star it is
/// the sum over the triangles, \f$w_{ij} = (\cot \alpha_{ij} + \cot \beta_{ij}) / 2\f$
/// \cgalCite{Pinkall1993Cotangent}. The weight of the edge \f$(i, j)\f$ in a tetrahedron
/// \f$ijkl\f$ is \f$|kl| \cot \theta_{kl} / 6\f$, with \f$\theta_{kl}\f$ the dihedral angle at the
/// opposite edge. For every linear map \f$D\f$, restricted to the plane of a triangle, the sum of
/// \f$w \|D e\|^2\f$ over the edges of a simplex is its area or volume times \f$\|D\|_F^2\f$.
///
/// With simplices as edge sets the energy is never negative. With stars it can be negative where
/// angles are obtuse, and its minimum is then a distorted shape: prefer `Safe_cotangent_weight`.
///
/// All weights are finite, unless the computation overflows (edges longer than \f$10^{76}\f$).
/// If a simplex is degenerate, or so thin that a weight would exceed \f$10^6\f$ (in a tetrahedron
/// \f$10^6\f$ times its longest edge), its weights are scaled down to this maximum. The smaller the
/// scale factor, the larger the added share of the weights of a regular simplex with the same
/// longest edge. This connects the corners of degenerate simplices, except of a tetrahedron in a
/// single point, and keeps their energy non-negative.
///
/// \cgalModels{ARAPEdgeWeight}
class Cotangent_weight
{
public:
  /// returns the weights of the edges \f$(0,1)\f$, \f$(0,2)\f$, \f$(1,2)\f$ of a triangle.
  std::array<double, 3> simplex_weights(const std::array<Coordinates, 3>& triangle) const
  {
    // the weight of an edge is the product of the other two, divided by twice the doubled area
    const auto& [p0, p1, p2] = triangle;
    const Coordinates a = internal::difference(p1, p0), b = internal::difference(p2, p0),
                      c = internal::difference(p2, p1);
    const Coordinates normal = internal::cross(a, b);
    std::array<double, 3> weights = {internal::dot(b, c), -internal::dot(a, c),
                                     internal::dot(a, b)};
    const double doubled_area = std::hypot(normal[0], normal[1], normal[2]);
    return quotients(weights, 2 * doubled_area, 1, smallest, std::sqrt(1.0 / 12));
  }

  /// returns the weights of the edges \f$(0,1)\f$, \f$(0,2)\f$, \f$(0,3)\f$, \f$(1,2)\f$,
  /// \f$(1,3)\f$, \f$(2,3)\f$ of a tetrahedron; they are lengths.
  std::array<double, 6> simplex_weights(const std::array<Coordinates, 4>& tetrahedron) const
  {
    // The gradients of the barycentric coordinates are g / (6 V), and the weight of an edge (i, j)
    // is -V times the product of those of i and j.
    const auto& [p0, p1, p2, p3] = tetrahedron;
    const Coordinates a = internal::difference(p1, p0), b = internal::difference(p2, p0),
                      c = internal::difference(p3, p0);
    const Coordinates g1 = internal::cross(b, c), g2 = internal::cross(c, a),
                      g3 = internal::cross(a, b);
    const Coordinates g0 = {-g1[0] - g2[0] - g3[0], -g1[1] - g2[1] - g3[1], -g1[2] - g2[2] - g3[2]};
    std::array<double, 6> weights = {-internal::dot(g0, g1), -internal::dot(g0, g2),
                                     -internal::dot(g0, g3), -internal::dot(g1, g2),
                                     -internal::dot(g1, g3), -internal::dot(g2, g3)};
    const double longest_edge = std::sqrt((std::max)(
      {internal::dot(a, a), internal::dot(b, b), internal::dot(c, c), squared_distance(p1, p2),
       squared_distance(p1, p3), squared_distance(p2, p3)}));
    const double rounding = 1e-12 * longest_edge * longest_edge; // of an area
    return quotients(weights, 6 * std::abs(internal::dot(a, g1)), longest_edge,
                     (std::max)(rounding * rounding, smallest),
                     std::sqrt(1.0 / 288) * longest_edge);
  }

  /// returns `sum`.
  double edge_weight(Edge_set, std::size_t, std::size_t, double sum) const { return sum; }

private:
  static constexpr double smallest = 1e-300; // products below it have lost digits

  // Divides the weights by the divisor, or by what makes the largest of them 10^6 units. The more
  // these differ, the more of the weight of a regular simplex is added: otherwise a triangle on a
  // line could be sheared along it without any energy. Weights below `rounding` are dropped.
  template <std::size_t N>
  static std::array<double, N> quotients(std::array<double, N> weights, double divisor, double unit,
                                         double rounding, double regular)
  {
    double largest = 0, sum = 0;
    for(double w : weights)
    {
      largest = (std::max)(largest, std::abs(w));
      sum += std::abs(w);
    }
    const bool is_nothing_left = sum <= rounding; // not if one is not a number
    const double smallest_divisor = 1e-6 * largest / unit;
    const double share = is_nothing_left ? 1 : (std::max)(0.0, 1 - divisor / smallest_divisor);
    for(double& w : weights)
      w = (is_nothing_left ? 0 : w / (std::max)(divisor, smallest_divisor)) + share * regular;
    return weights;
  }

  static double squared_distance(const Coordinates& p, const Coordinates& q)
  {
    const Coordinates d = internal::difference(p, q);
    return internal::dot(d, d);
  }
};

/// \ingroup PkgARAPDeformationWeights
/// \brief cotangent weights, with negative weights replaced by 0.
///
/// Clamps the weight of an edge in its edge set: in a star, the sum over the simplices at the edge.
/// The energy is never negative, whatever the cells. With simplices as edge sets, obtuse simplices
/// lose an edge, and the identity of `Cotangent_weight` with the area or volume no longer holds
/// there: prefer `Safe_cotangent_weight`.
///
/// \cgalModels{ARAPEdgeWeight}
class Clamped_cotangent_weight : public Cotangent_weight
{
public:
  /// returns the larger of `sum` and 0; not a number if `sum` is not a number.
  double edge_weight(Edge_set, std::size_t, std::size_t, double sum) const
  {
    return sum < 0 ? 0 : sum;
  }
};

/// \ingroup PkgARAPDeformationWeights
/// \brief clamped cotangents for stars, unmodified cotangents for simplices: the default.
///
/// These weights change cotangents no more than is needed for the energy to be non-negative with
/// every cell scheme.
///
/// \cgalModels{ARAPEdgeWeight}
class Safe_cotangent_weight : public Cotangent_weight
{
public:
  /// returns `sum`, or 0 if `edge_set` is a star and `sum` is negative.
  double edge_weight(Edge_set edge_set, std::size_t, std::size_t, double sum) const
  {
    return edge_set == Edge_set::star && sum < 0 ? 0 : sum;
  }
};

/// \ingroup PkgARAPDeformationWeights
/// \brief weight 1 for each edge of each edge set, diagonals of polygons included.
///
/// Uses no geometry and never fails, but the result depends on the meshing of the shape (Figure 2
/// of \cgalCite{Sorkine2007AsRigidAs}).
///
/// \cgalModels{ARAPEdgeWeight}
class Uniform_weight
{
public:
  /// returns 1 for each edge.
  std::array<double, 3> simplex_weights(const std::array<Coordinates, 3>&) const
  {
    return {1, 1, 1};
  }

  /// returns 1 for each edge.
  std::array<double, 6> simplex_weights(const std::array<Coordinates, 4>&) const
  {
    return {1, 1, 1, 1, 1, 1};
  }

  /// returns 1.
  double edge_weight(Edge_set, std::size_t, std::size_t, double) const { return 1; }
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_EDGE_WEIGHTS_H
