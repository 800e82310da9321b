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

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/Default_domain.h>
#include <CGAL/ARAP_deformation/internal/domain/Simplex_list.h>
#include <CGAL/ARAP_deformation/internal/parallel/largest_entry.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/vertex_maps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
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
  /// area of a polygon is the length of its vector area. 0 if the shape had no area.
  double area_change = 0;

  /// \f$V' / V - 1\f$, of the volume that a closed and oriented surface encloses, or of all
  /// tetrahedra, where \f$V'\f$ is negative for those that are inverted; not a number for other
  /// surfaces
  double volume_change = std::numeric_limits<double>::quiet_NaN();

  /// the largest \f$|\alpha' - \alpha|\f$ of a corner of a face or of a face of a tetrahedron, in
  /// degrees
  double largest_angle_change = 0;

  /// the largest spike, see `Vertex_measure::spike`; 0 if it is negative
  double largest_spike = 0;

  /// the number of tetrahedra whose orientation is the opposite one
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

namespace internal {

// What is measured of a shape, of the points of which there are two versions.
template <typename Domain>
class Quality_measures
{
  static constexpr bool is_volume = Domain::dimension == 3;

public:
  template <typename RestPointMap, typename PointMap>
  Quality_measures(const Domain& domain, const RestPointMap& rest_points, const PointMap& points)
    : m_list(domain), m_rest(coordinates_of(domain, rest_points)),
      m_points(coordinates_of(domain, points))
  {}

  template <typename RestPointMap>
  Quality_measures(const Domain& domain, const RestPointMap& rest_points)
    : Quality_measures(domain, rest_points,
                       [&](typename Domain::vertex_descriptor v) { return domain.point(v); })
  {}

  std::vector<double> at_vertices(Vertex_measure measure) const
  {
    const std::size_t n = m_points.size();
    std::vector<double> result(n, 0.), weights(n, 0.), rest_weights(n, 0.);
    std::vector<Coordinates> sums(n, Coordinates{0, 0, 0}), rest_sums = sums;
    for(const std::vector<std::size_t>& s : m_list.simplices())
    {
      const double rest_size = size(s, m_rest);
      const double sign = rest_size < 0 ? -1 : 1; // tetrahedra may have either orientation
      if(measure == Vertex_measure::size_change)
        for(std::size_t v : s)
        {
          result[v] += sign * (size(s, m_points) - rest_size);
          weights[v] += sign * rest_size;
        }
      if(measure == Vertex_measure::angle_change)
        for_each_angle(s, [&](std::size_t v, double change) {
          result[v] = larger_or_nan(result[v], change);
        });
      for_each_edge(s, [&](std::size_t v, std::size_t w) {
        const Coordinates e = difference(m_rest[w], m_rest[v]),
                          f = difference(m_points[w], m_points[v]);
        if(measure == Vertex_measure::edge_length_error)
        {
          result[v] += std::pow(length(f) - length(e), 2);
          weights[v] += squared_length(e);
        }
        if(measure == Vertex_measure::spike)
        {
          add(sums[v], 1, f);
          add(rest_sums[v], 1, e);
          weights[v] += length(f);
          rest_weights[v] += length(e);
        }
      });
    }
    for(std::size_t v = 0; v < n; ++v)
      if(measure == Vertex_measure::edge_length_error)
        result[v] = weights[v] != 0 ? std::sqrt(result[v] / weights[v]) : 0;
      else if(measure == Vertex_measure::size_change)
        result[v] = weights[v] != 0 ? result[v] / weights[v] : 0;
      else if(measure == Vertex_measure::spike && weights[v] != 0 && rest_weights[v] != 0)
        result[v] = length(sums[v]) / weights[v] - length(rest_sums[v]) / rest_weights[v];
    return result;
  }

  Quality of_all() const
  {
    Quality result;
    std::vector<std::pair<std::size_t, std::size_t>> edges;
    double volume = 0, rest_volume = 0;
    for(const std::vector<std::size_t>& s : m_list.simplices())
    {
      for_each_edge(s, [&](std::size_t v, std::size_t w) {
        if(v < w)
          edges.emplace_back(v, w);
      });
      if constexpr(is_volume)
      {
        const double rest = size(s, m_rest), now = size(s, m_points);
        volume += rest < 0 ? -now : now;
        rest_volume += std::abs(rest);
        result.inverted_simplices += (rest < 0 && now > 0) || (rest > 0 && now < 0);
      }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    double errors = 0, lengths = 0; // of squares
    for(const auto& [v, w] : edges)
    {
      const double rest = length(difference(m_rest[w], m_rest[v]));
      errors += std::pow(length(difference(m_points[w], m_points[v])) - rest, 2);
      lengths += rest * rest;
    }
    result.edge_length_error = lengths == 0 ? 0 : std::sqrt(errors / lengths);

    const auto faces = m_list.faces();
    double area = 0, rest_area = 0;
    for(const std::vector<std::size_t>& face : faces)
    {
      area += length(vector_area(face, m_points));
      rest_area += length(vector_area(face, m_rest));
    }
    if(rest_area > 0)
      result.area_change = area / rest_area - 1;
    if(!is_volume && is_closed(faces))
    {
      volume = enclosed_volume(faces, m_points);
      rest_volume = enclosed_volume(faces, m_rest);
    }
    if(rest_volume != 0)
      result.volume_change = volume / rest_volume - 1;
    const auto largest = [this](Vertex_measure measure) {
      double value = 0;
      for(double at_vertex : at_vertices(measure))
        value = larger_or_nan(value, at_vertex);
      return value;
    };
    result.largest_angle_change = largest(Vertex_measure::angle_change);
    result.largest_spike = largest(Vertex_measure::spike);
    return result;
  }

private:
  using Simplex = std::vector<std::size_t>;
  using Points = std::vector<Coordinates>;

  // of each vertex in a map, by its index
  template <typename PointMap>
  static Points coordinates_of(const Domain& domain, const PointMap& map)
  {
    Points result;
    for(const auto& v : domain.vertices())
    {
      const std::size_t i = domain.index(v);
      if(result.size() <= i)
        result.resize(i + 1, Coordinates{0, 0, 0});
      result[i] = Domain::coordinates(domain.point(v));
      with_value(map, v, i, [&](const auto& p) { result[i] = Domain::coordinates(p); });
    }
    return result;
  }

  static double squared_length(const Coordinates& v) { return dot(v, v); }
  static double length(const Coordinates& v) { return std::sqrt(dot(v, v)); }

  // Calls f(v, w) for each edge in both directions; those of a polygon are its sides.
  template <typename Function>
  static void for_each_edge(const Simplex& s, const Function& f)
  {
    const std::size_t n = s.size();
    for(std::size_t i = 0; i < n; ++i)
      for(std::size_t j = 1; j < n; j += is_volume ? 1 : n - 2)
        f(s[i], s[(i + j) % n]);
  }

  // Calls f(v, change of the angle) for each two edges at v.
  template <typename Function>
  void for_each_angle(const Simplex& s, const Function& f) const
  {
    const std::size_t n = s.size();
    for(std::size_t i = 0; i < n; ++i)
      for(std::size_t j = is_volume ? 2 : n - 1; j < n; ++j)
        for(std::size_t k = 1; k < (is_volume ? j : 2); ++k)
        {
          const std::size_t a = s[i], b = s[(i + j) % n], c = s[(i + k) % n];
          f(a, std::abs(angle(m_points, a, b, c) - angle(m_rest, a, b, c)));
        }
  }

  // in degrees, at a
  static double angle(const Points& p, std::size_t a, std::size_t b, std::size_t c)
  {
    const Coordinates e = difference(p[b], p[a]), f = difference(p[c], p[a]);
    return std::atan2(length(cross(e, f)), dot(e, f)) * 180 / std::acos(-1.0);
  }

  // half the sum of the cross products around it
  static Coordinates vector_area(const Simplex& face, const Points& p)
  {
    Coordinates area = {0, 0, 0};
    for(std::size_t k = 1; k + 1 < face.size(); ++k)
      add(area, 0.5, cross(difference(p[face[k]], p[face[0]]),
                           difference(p[face[k + 1]], p[face[0]])));
    return area;
  }

  // an area, or the signed volume of a tetrahedron
  static double size(const Simplex& s, const Points& p)
  {
    if constexpr(is_volume)
      return dot(difference(p[s[3]], p[s[0]]), cross(difference(p[s[1]], p[s[0]]),
                                                     difference(p[s[2]], p[s[0]]))) / 6;
    else
      return length(vector_area(s, p));
  }

  // The volume that closed faces enclose, negative if they are oriented inwards. Polygons are cut
  // from the mean of their corners.
  static double enclosed_volume(const std::vector<Simplex>& faces, const Points& p)
  {
    double volume = 0;
    for(const Simplex& face : faces)
    {
      Coordinates mean = {0, 0, 0};
      for(std::size_t v : face)
        add(mean, 1 / static_cast<double>(face.size()), difference(p[v], p[faces[0][0]]));
      volume += dot(mean, vector_area(face, p)) / 3;
    }
    return volume;
  }

  // Whether each side of a face is that of another one, in the other direction.
  static bool is_closed(const std::vector<Simplex>& faces)
  {
    std::vector<std::pair<std::size_t, std::size_t>> sides, opposite;
    for(const Simplex& face : faces)
      for(std::size_t k = 0; k < face.size(); ++k)
      {
        sides.emplace_back(face[k], face[(k + 1) % face.size()]);
        opposite.emplace_back(sides.back().second, sides.back().first);
      }
    std::sort(sides.begin(), sides.end());
    std::sort(opposite.begin(), opposite.end());
    return sides == opposite && !sides.empty();
  }

  Simplex_list<Domain> m_list;
  Points m_rest, m_points;
};

} // namespace internal

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
    return internal::Quality_measures(domain, rest_points, points).of_all();
  });
}

/// \ingroup PkgARAPDeformationQuality
/// \brief measures what a deformation has done to a shape whose present points are the deformed
/// ones.
template <typename Shape, typename RestPointMap>
Quality quality(const Shape& shape, const RestPointMap& rest_points)
{
  return internal::with_domain(shape, [&](const auto& domain) {
    return internal::Quality_measures(domain, rest_points).of_all();
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
    return internal::Quality_measures(domain, rest_points, points).at_vertices(measure);
  });
}

/// \ingroup PkgARAPDeformationQuality
/// \brief returns the same for a shape whose present points are the deformed ones.
template <typename Shape, typename RestPointMap>
std::vector<double> quality_at_vertices(const Shape& shape, Vertex_measure measure,
                                        const RestPointMap& rest_points)
{
  return internal::with_domain(shape, [&](const auto& domain) {
    return internal::Quality_measures(domain, rest_points).at_vertices(measure);
  });
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_QUALITY_H
