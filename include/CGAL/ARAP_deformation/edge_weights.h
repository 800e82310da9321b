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
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationWeights
/// \brief cotangent weights as they are, of either sign.
///
/// The edge of a triangle weighs half the cotangent of the opposite angle, the edge of a star the
/// sum over its triangles: \f$w_{ij} = (\cot \alpha_{ij} + \cot \beta_{ij}) / 2\f$
/// \cgalCite{Pinkall1993Cotangent}. The edge \f$(i, j)\f$ of a tetrahedron \f$ijkl\f$ weighs
/// \f$|kl| \cot \theta_{kl} / 6\f$, with \f$\theta_{kl}\f$ the dihedral angle at the opposite
/// edge. For every linear map \f$D\f$ the sum of \f$w \|D e\|^2\f$ over the edges of a
/// simplex is then its area or volume times \f$\|D\|_F^2\f$, over its plane or space.
///
/// With simplices as edge sets the energy is never negative. With stars it can be where angles are
/// obtuse, and its minimum is then a distorted shape: prefer `Safe_cotangent_weight`.
///
/// All weights are finite, unless the arithmetic overflows (with edges longer than \f$10^{76}\f$).
/// Where a simplex is degenerate, or so thin that a weight would be larger than \f$10^6\f$ (in a
/// tetrahedron \f$10^6\f$ times its longest edge), its weights are multiplied by a common factor
/// that makes this the largest one; and the smaller the factor is, the more is added of the weights
/// of a regular simplex with the same longest edge. So the corners of a degenerate simplex are tied
/// together, unless it is a tetrahedron in one point, and its energy is still not negative.
///
/// \cgalModels{ARAPEdgeWeight_3}
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
  /// \f$(1,3)\f$, \f$(2,3)\f$ of a tetrahedron, a length.
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
  // this differs, the more of the weight of a regular simplex is added: a triangle on a line could
  // be sheared along it without any energy. Weights that are nothing but rounding do not count.
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
/// \brief cotangent weights, of which negative ones are replaced by 0.
///
/// It is the weight of an edge in its edge set that is clamped: in a star the sum over the
/// simplices at the edge. The energy is never negative, whatever the cells. With simplices as
/// edge sets obtuse ones lose an edge, and the identity of `Cotangent_weight` with the area or
/// volume is lost there too: prefer `Safe_cotangent_weight`.
///
/// \cgalModels{ARAPEdgeWeight_3}
class Clamped_cotangent_weight : public Cotangent_weight
{
public:
  /// returns `sum` or 0, whichever is larger; a `sum` that is not a number is returned.
  double edge_weight(Edge_set, std::size_t, std::size_t, double sum) const
  {
    return sum < 0 ? 0 : sum;
  }
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
  double edge_weight(Edge_set edge_set, std::size_t, std::size_t, double sum) const
  {
    return edge_set == Edge_set::star && sum < 0 ? 0 : sum;
  }
};

/// \ingroup PkgARAPDeformationWeights
/// \brief 1 for each edge of each edge set, whatever the shape; the diagonals of a polygon are
/// edges too.
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
