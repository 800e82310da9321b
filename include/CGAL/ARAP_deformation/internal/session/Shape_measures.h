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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SHAPE_MEASURES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SHAPE_MEASURES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/Simplex_list.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/parallel/largest_entry.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>
#include <CGAL/ARAP_deformation/internal/region/contents.h>
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
namespace internal {

// What a deformation has done to a shape, in the measures of Quality and Vertex_measure.
template <typename Domain>
class Shape_measures
{
  static constexpr bool is_volume = Domain::dimension == 3;

public:
  template <typename RestPointMap, typename PointMap>
  Shape_measures(const Domain& domain, const RestPointMap& rest_points, const PointMap& points)
    : m_list(domain), m_rest(coordinates_of(domain, rest_points)),
      m_points(coordinates_of(domain, points))
  {
    // no measure has a unit: so that no square of a length of the rest shape overflows or
    // underflows, both shapes are scaled by a power of two
    Bounding_box box;
    for(const Simplex& s : m_list.simplices())
      for(std::size_t v : s)
        box.include(m_rest[v]);
    const double side = box.longest_side();
    if(!(side > 0) || !is_finite(side))
      return;
    const int exponent = -std::ilogb(side);
    for(Points* all : {&m_rest, &m_points})
      for(Coordinates& p : *all)
        for(double& x : p)
          x = std::ldexp(x, exponent);
  }

  // of the whole shape

  double edge_length_error() const
  {
    std::vector<std::pair<std::size_t, std::size_t>> edges;
    for(const Simplex& s : m_list.simplices())
      for_each_edge(s, [&](std::size_t v, std::size_t w) {
        if(v < w)
          edges.emplace_back(v, w);
      });
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    double errors = 0, lengths = 0; // of squares
    for(const auto& [v, w] : edges)
    {
      const double rest = length(difference(m_rest[w], m_rest[v]));
      errors += std::pow(length(difference(m_points[w], m_points[v])) - rest, 2);
      lengths += rest * rest;
    }
    return lengths == 0 ? 0 : std::sqrt(errors / lengths);
  }

  double area_change() const
  {
    double area = 0, rest_area = 0;
    for(const Simplex& face : m_list.faces())
    {
      area += length(vector_area(face, m_points));
      rest_area += length(vector_area(face, m_rest));
    }
    return rest_area == 0 ? 0 : area / rest_area - 1;
  }

  double volume_change() const
  {
    double volume = 0, rest_volume = 0;
    if constexpr(is_volume)
      for(const Simplex& s : m_list.simplices())
      {
        const double rest = size(s, m_rest);
        volume += rest < 0 ? -size(s, m_points) : size(s, m_points);
        rest_volume += std::abs(rest);
      }
    else if(is_closed(m_list.simplices()))
    {
      volume = enclosed_volume(m_list.simplices(), m_points);
      rest_volume = enclosed_volume(m_list.simplices(), m_rest);
    }
    return rest_volume != 0 ? volume / rest_volume - 1 : std::numeric_limits<double>::quiet_NaN();
  }

  std::size_t inverted_simplices() const
  {
    std::size_t result = 0;
    if constexpr(is_volume)
      for(const Simplex& s : m_list.simplices())
        result += is_inverted([&](std::size_t k) { return m_points[s[k]]; },
                              [&](std::size_t k) { return m_rest[s[k]]; });
    return result;
  }

  // at each vertex, by its index

  std::vector<double> edge_length_errors() const
  {
    std::vector<double> errors(m_points.size(), 0.), lengths = errors; // of squares
    for(const Simplex& s : m_list.simplices())
      for_each_edge(s, [&](std::size_t v, std::size_t w) {
        const double rest = length(difference(m_rest[w], m_rest[v]));
        errors[v] += std::pow(length(difference(m_points[w], m_points[v])) - rest, 2);
        lengths[v] += rest * rest;
      });
    for(std::size_t v = 0; v < errors.size(); ++v)
      errors[v] = lengths[v] != 0 ? std::sqrt(errors[v] / lengths[v]) : 0;
    return errors;
  }

  std::vector<double> size_changes() const
  {
    std::vector<double> changes(m_points.size(), 0.), sizes = changes;
    for(const Simplex& s : m_list.simplices())
    {
      const double rest = size(s, m_rest);
      const double sign = rest < 0 ? -1 : 1; // tetrahedra may have either orientation
      for(std::size_t v : s)
      {
        changes[v] += sign * (size(s, m_points) - rest);
        sizes[v] += sign * rest;
      }
    }
    for(std::size_t v = 0; v < changes.size(); ++v)
      changes[v] = sizes[v] != 0 ? changes[v] / sizes[v] : 0;
    return changes;
  }

  std::vector<double> angle_changes() const
  {
    std::vector<double> changes(m_points.size(), 0.);
    for(const Simplex& s : m_list.simplices())
      for_each_angle(s, [&](std::size_t v, double change) {
        changes[v] = larger_or_nan(changes[v], change);
      });
    return changes;
  }

  std::vector<double> spikes() const
  {
    const std::vector<Fan> rest = fans(m_rest), now = fans(m_points);
    std::vector<double> result(rest.size(), 0.);
    for(std::size_t v = 0; v < rest.size(); ++v)
      if(now[v].length != 0 && rest[v].length != 0)
        result[v] = length(now[v].sum) / now[v].length - length(rest[v].sum) / rest[v].length;
    return result;
  }

private:
  using Simplex = std::vector<std::size_t>;
  using Points = std::vector<Coordinates>;

  struct Fan // the edges at a vertex
  {
    Coordinates sum = {0, 0, 0};
    double length = 0; // of all
  };

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

  static double length(const Coordinates& v) { return std::sqrt(dot(v, v)); }

  std::vector<Fan> fans(const Points& points) const
  {
    std::vector<Fan> result(points.size());
    for(const Simplex& s : m_list.simplices())
      for_each_edge(s, [&](std::size_t v, std::size_t w) {
        const Coordinates edge = difference(points[w], points[v]);
        add(result[v].sum, 1, edge);
        result[v].length += length(edge);
      });
    return result;
  }

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

  static Coordinates vector_area(const Simplex& face, const Points& p)
  {
    return internal::vector_area(face.size(), [&](std::size_t k) { return p[face[k]]; });
  }

  // an area, or the signed volume of a tetrahedron
  static double size(const Simplex& s, const Points& p)
  {
    if constexpr(is_volume)
      return rounded_volume([&](std::size_t k) { return p[s[k]]; });
    else
      return length(vector_area(s, p));
  }

  // The volume that closed faces enclose, negative if they are oriented inwards. Polygons are cut
  // from the mean of their corners.
  static double enclosed_volume(const std::vector<Simplex>& faces, const Points& p)
  {
    double volume = 0, largest = 0; // what it would be if all faces were seen from the front
    for(const Simplex& face : faces)
    {
      Coordinates mean = {0, 0, 0};
      for(std::size_t v : face)
        add(mean, 1 / static_cast<double>(face.size()), difference(p[v], p[faces[0][0]]));
      const Coordinates area = vector_area(face, p);
      volume += dot(mean, area) / 3;
      largest += length(mean) * length(area) / 3;
    }
    return std::abs(volume) <= 1e-12 * largest ? 0 : volume; // of what is flat: rounding errors
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
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SHAPE_MEASURES_H
