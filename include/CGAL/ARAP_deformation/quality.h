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

#ifndef CGAL_ARAP_DEFORMATION_QUALITY_H
#define CGAL_ARAP_DEFORMATION_QUALITY_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/domain/Default_domain.h>
#include <CGAL/ARAP_deformation/internal/parallel/largest_entry.h>
#include <CGAL/ARAP_deformation/internal/session/Shape_measures.h>

#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationQuality
/// \brief what a deformation has done to a whole shape: numbers without unit, except for the angle.
///
/// \f$l\f$ is a length, \f$A\f$ an area, \f$V\f$ a volume and \f$\alpha\f$ an angle in the
/// rest shape; \f$l'\f$, \f$A'\f$, \f$V'\f$ and \f$\alpha'\f$ are the same in the deformed
/// shape. After a rigid motion all that are defined are zero.
struct Quality
{
  /// \f$\sqrt{\sum (l' - l)^2 / \sum l^2}\f$ over all edges (Table 1 of
  /// \cgalCite{Sorkine2007AsRigidAs}); those of a polygon are its sides
  double edge_length_error = 0;

  /// \f$\sum A' / \sum A - 1\f$ over all faces of a surface, or of the boundary of tetrahedra. The
  /// area of a polygon is the length of its vector area. 0 if the shape had no area. A tetrahedron
  /// that is there twice has no face in the boundary.
  double area_change = 0;

  /// \f$V' / V - 1\f$, of the volume that a closed and oriented surface encloses, or of all
  /// tetrahedra, where \f$V'\f$ is negative for those that are inverted; not a number for other
  /// surfaces, and if the volume of the rest shape is zero
  double volume_change = std::numeric_limits<double>::quiet_NaN();

  /// the largest \f$|\alpha' - \alpha|\f$ of a corner of a face or of a face of a tetrahedron, in
  /// degrees
  double largest_angle_change = 0;

  /// the largest spike, see `Vertex_measure::spike`; 0 if it is negative
  double largest_spike = 0;

  /// the number of tetrahedra whose orientation is the opposite one; here and above, those that are
  /// flat up to 1e-12 of their size have no volume
  std::size_t inverted_simplices = 0;
};

/// \ingroup PkgARAPDeformationQuality
/// what `quality_at_vertices()` measures. Sums are over what is incident to the vertex \f$i\f$.
enum class Vertex_measure
{
  /// \f$\sqrt{\sum (l' - l)^2 / \sum l^2}\f$, over the edges of the simplices: an edge counts as
  /// often as there are simplices at it
  edge_length_error,

  /// \f$\sum (A' - A) / \sum A\f$, over the areas of faces or the volumes of tetrahedra, which are
  /// negative for those that are inverted
  size_change,

  /// the largest \f$|\alpha' - \alpha|\f$ of an angle between two edges of a simplex, in degrees
  angle_change,

  /// \f$s' - s\f$, where \f$s = \|\sum (p_j - p_i)\| / \sum \|p_j - p_i\|\f$ over the same
  /// edges: 0 in the middle of the neighbors \f$j\f$, and near 1 at the tip of a needle
  spike
};

/// \ingroup PkgARAPDeformationQuality
/// \brief measures what a deformation has done to a shape, in \f$O(n \log n)\f$ time for \f$n\f$
/// simplices, where a polygon with \f$k\f$ corners counts as \f$k^2\f$.
///
/// \param shape a mesh as the template parameter `Mesh` of `ARAP_deformation`, with its own points,
///        or a model of `ARAPDomain`, which may have others
/// \param rest_points the points of the vertices in the rest shape: a function object, a property
///        map, an associative container, where vertices without a value are where the shape has
///        them, or a vector by the indices of the vertices, which throws `std::out_of_range` if it
///        is too short
/// \param points the same for the deformed shape
template <typename Shape, typename RestPointMap, typename PointMap>
Quality quality(const Shape& shape, const RestPointMap& rest_points, const PointMap& points)
{
  return internal::with_domain(shape, [&](const auto& domain) {
    const internal::Shape_measures measures(domain, rest_points, points);
    const auto largest = [](const std::vector<double>& values) {
      return std::accumulate(values.begin(), values.end(), 0., internal::larger_or_nan);
    };
    Quality result;
    result.edge_length_error = measures.edge_length_error();
    result.area_change = measures.area_change();
    result.volume_change = measures.volume_change();
    result.largest_angle_change = largest(measures.angle_changes());
    result.largest_spike = largest(measures.spikes());
    result.inverted_simplices = measures.inverted_simplices();
    return result;
  });
}

/// \ingroup PkgARAPDeformationQuality
/// \brief measures what a deformation has done to a shape whose present points are the deformed
/// ones.
template <typename Shape, typename RestPointMap>
Quality quality(const Shape& shape, const RestPointMap& rest_points)
{
  return internal::with_domain(shape, [&](const auto& domain) {
    return quality(domain, rest_points, [&](const auto& v) { return domain.point(v); });
  });
}

/// \ingroup PkgARAPDeformationQuality
/// \brief returns what a deformation has done at each vertex, in linear time, where a polygon with
/// \f$k\f$ corners counts as \f$k^2\f$.
///
/// \param shape, rest_points, points as for `quality()`
/// \param measure what is measured
/// \returns a vector by the indices of the vertices: of the domain, of the mesh (its initialized
///          index map), or of the finite vertices of a triangulation in their order. It is 0 where
///          no simplex is, and at indices that no vertex has.
template <typename Shape, typename RestPointMap, typename PointMap>
std::vector<double> quality_at_vertices(const Shape& shape, Vertex_measure measure,
                                        const RestPointMap& rest_points, const PointMap& points)
{
  return internal::with_domain(shape, [&](const auto& domain) {
    const internal::Shape_measures measures(domain, rest_points, points);
    switch(measure)
    {
    case Vertex_measure::edge_length_error: return measures.edge_length_errors();
    case Vertex_measure::size_change: return measures.size_changes();
    case Vertex_measure::angle_change: return measures.angle_changes();
    case Vertex_measure::spike: break;
    }
    return measures.spikes();
  });
}

/// \ingroup PkgARAPDeformationQuality
/// \brief returns the same for a shape whose present points are the deformed ones.
template <typename Shape, typename RestPointMap>
std::vector<double> quality_at_vertices(const Shape& shape, Vertex_measure measure,
                                        const RestPointMap& rest_points)
{
  return internal::with_domain(shape, [&](const auto& domain) {
    return quality_at_vertices(domain, measure, rest_points,
                               [&](const auto& v) { return domain.point(v); });
  });
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_QUALITY_H
