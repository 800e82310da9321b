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

#ifndef CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECKS_H
#define CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECKS_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/minimizer/gap_estimate.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationChecks
/// returns whether \f$R^T R = I\f$ and \f$\det R = +1\f$, each entry up to `tolerance`.
inline bool is_rotation(const Matrix_3x3& r, double tolerance = 1e-12)
{
  const Coordinates rows[3] = {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 3; ++j)
      if(!(std::abs(internal::dot(rows[i], rows[j]) - (i == j)) <= tolerance))
        return false;
  return std::abs(internal::dot(internal::cross(rows[0], rows[1]), rows[2]) - 1) <= tolerance;
}

/// \ingroup PkgARAPDeformationChecks
/// returns the number of the first iteration that makes the energy rise, or 0 if none does.
/// Differences below the rounding error of the energy do not count.
inline std::size_t first_rise_of_energy(const Report& report)
{
  for(std::size_t k = 1; k < report.energy.size(); ++k)
  {
    const double before = report.energy[k - 1];
    if(!(report.energy[k] <= before + internal::energy_resolution(before, report)))
      return k;
  }
  return 0;
}

namespace internal {

// sums over edges, each given by its end points in the rest shape and in the deformed shape
class Edge_length_error
{
public:
  template <typename Rest_point, typename Point>
  void add_edge(const Rest_point& rest_p, const Rest_point& rest_q, const Point& p, const Point& q)
  {
    const double rest = length(rest_p, rest_q), error = length(p, q) - rest;
    m_sum_of_errors += error * error;
    m_sum_of_lengths += rest * rest;
  }

  double relative() const
  {
    return m_sum_of_lengths == 0 ? 0 : std::sqrt(m_sum_of_errors / m_sum_of_lengths);
  }

private:
  template <typename Point>
  static double length(const Point& p, const Point& q)
  {
    return std::hypot(CGAL::to_double(p[0] - q[0]), CGAL::to_double(p[1] - q[1]),
                      CGAL::to_double(p[2] - q[2]));
  }

  double m_sum_of_errors = 0, m_sum_of_lengths = 0; // of squares
};

} // namespace internal

/// \ingroup PkgARAPDeformationChecks
/// \brief returns the relative root mean square error of the edge lengths,
/// \f$\sqrt{\sum (l' - l)^2 / \sum l^2}\f$ over all edges (Table 1 of
/// \cgalCite{Sorkine2007AsRigidAs}).
///
/// \param mesh a model of `EdgeListGraph`
/// \param rest_points a readable property map to the points of the rest shape, with lengths
///        \f$l\f$
/// \param points a readable property map to the points of the deformed shape, with lengths
///        \f$l'\f$
template <typename Mesh, typename RestPointMap, typename VertexPointMap>
double relative_edge_length_error(const Mesh& mesh, RestPointMap rest_points, VertexPointMap points)
{
  internal::Edge_length_error error;
  for(auto edge : edges(mesh))
  {
    const auto v = source(edge, mesh), w = target(edge, mesh);
    error.add_edge(get(rest_points, v), get(rest_points, w), get(points, v), get(points, w));
  }
  return error.relative();
}

/// \ingroup PkgARAPDeformationChecks
/// \brief returns the relative root mean square error of the edge lengths, as above, over all edges
/// of the simplices of a domain. The edges of a polygon are its sides.
///
/// \param domain a model of `ARAPDomain` from which the points of the deformed shape are read
/// \param rest_points a range with `operator[]`: the point of `v` in the rest shape is
///        `rest_points[domain.index(v)]`
template <typename Domain, typename PointRange>
double relative_edge_length_error(const Domain& domain, const PointRange& rest_points)
{
  using vertex_descriptor = typename Domain::vertex_descriptor;
  internal::Edge_length_error error;
  std::vector<std::pair<std::size_t, vertex_descriptor>> neighbors; // of v, with a larger index
  for(vertex_descriptor v : domain.vertices())
  {
    const std::size_t i = domain.index(v);
    neighbors.clear();
    const auto insert = [&](vertex_descriptor w) {
      if(const std::size_t j = domain.index(w); j > i)
        neighbors.emplace_back(j, w);
    };
    domain.for_each_incident_simplex(v, [&](const auto&, const auto& corners) {
      const auto begin = std::begin(corners), end = std::end(corners);
      for(auto corner = begin; corner != end; ++corner)
      {
        const auto next = std::next(corner) == end ? begin : std::next(corner);
        if(Domain::dimension == 3)
          insert(*corner);
        else if(domain.index(*corner) == i)
          insert(*next);
        else if(domain.index(*next) == i)
          insert(*corner);
      }
    });
    const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
    const auto equal = [](const auto& a, const auto& b) { return a.first == b.first; };
    std::sort(neighbors.begin(), neighbors.end(), less);
    const auto end = std::unique(neighbors.begin(), neighbors.end(), equal);
    for(auto neighbor = neighbors.begin(); neighbor != end; ++neighbor)
      error.add_edge(Domain::coordinates(rest_points[i]),
                     Domain::coordinates(rest_points[neighbor->first]),
                     Domain::coordinates(domain.point(v)),
                     Domain::coordinates(domain.point(neighbor->second)));
  }
  return error.relative();
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECKS_H
