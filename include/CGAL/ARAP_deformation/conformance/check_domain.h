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

#ifndef CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_DOMAIN_H
#define CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_DOMAIN_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/conformance/internal/Violations.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/domain_requirements.h>
#include <CGAL/ARAP_deformation/internal/domain/is_in_domain.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace CGAL {
namespace ARAP {

namespace internal {

template <typename Domain>
class Domain_check
{
  static_assert(Domain_requirements<Domain, Uniform_weight>::are_met);

  using vertex_descriptor = typename Domain::vertex_descriptor;
  using simplex_descriptor = typename Domain::simplex_descriptor;
  using Point = typename Domain::Point;

public:
  explicit Domain_check(const Domain& domain) : m_domain(domain) {}

  std::vector<std::string> operator()()
  {
    m_violations.run("the domain", [this] {
      for(vertex_descriptor v : m_domain.vertices())
        require(m_vertices.emplace(m_domain.index(v), v).second,
                "index() is the same for two vertices of vertices()", v);
      for(const auto& [index, v] : m_vertices)
        check_simplices(v);
      const Domain copy = m_domain;
      for(const auto& [index, v] : m_vertices)
        check_points(v, copy);
    });
    return m_violations.sentences();
  }

private:
  // reports each message once, for the first vertex
  void require(bool holds, const std::string& sentence, vertex_descriptor v)
  {
    if(!holds && m_known.insert(sentence).second)
      m_violations.check(false, sentence, ", for vertex ", m_domain.index(v));
  }

  template <typename Range>
  std::vector<std::size_t> sorted_indices(const Range& corners) const
  {
    std::vector<std::size_t> indices;
    for(vertex_descriptor v : corners)
      indices.push_back(m_domain.index(v));
    std::sort(indices.begin(), indices.end());
    return indices;
  }

  bool is_seen_once_from(vertex_descriptor v, simplex_descriptor s) const
  {
    std::size_t times = 0;
    m_domain.for_each_incident_simplex(
      v, [&](simplex_descriptor t, const auto&) { times += t == s; });
    return times == 1;
  }

  // each simplex must be the same when visited from any of its corners
  void check_simplices(vertex_descriptor v)
  {
    require(internal::is_vertex_of(m_domain, v), "is_vertex() denies a vertex of vertices()", v);
    bool is_isolated = true;
    m_domain.for_each_incident_simplex(v, [&](simplex_descriptor s, const auto& corners) {
      is_isolated = false;
      const std::vector<vertex_descriptor> own(std::begin(corners), std::end(corners));
      const std::vector<std::size_t> sorted = sorted_indices(own); // corners end with the next call
      require(std::binary_search(sorted.begin(), sorted.end(), m_domain.index(v)),
              "for_each_incident_simplex() gives a simplex without the vertex itself", v);
      require(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end(),
              "for_each_incident_simplex() gives a simplex with a corner twice", v);
      require(Domain::dimension == 2 ? sorted.size() >= 3 : sorted.size() == 4,
              "the number of corners of a simplex is not that of the dimension", v);
      require(internal::is_simplex_of(m_domain, s),
              "is_simplex() denies what for_each_incident_simplex() gives", v);
      require(sorted == sorted_indices(m_domain.simplex_vertices(s)),
              "simplex_vertices() and for_each_incident_simplex() give different corners", v);
      for(vertex_descriptor w : own)
      {
        require(m_vertices.count(m_domain.index(w)) == 1,
                "a corner of a simplex is not in vertices()", v);
        require(is_seen_once_from(w, s),
                "a simplex is not given exactly once at each of its corners", v);
      }
    });
    require(is_isolated == m_domain.is_isolated(v),
            "is_isolated() and for_each_incident_simplex() disagree", v);
  }

  // up to rounding: a mesh may have float coordinates
  static bool are_close(const Coordinates& a, const Coordinates& b)
  {
    const double error = std::numeric_limits<float>::epsilon() *
                         (std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]));
    return std::abs(a[0] - b[0]) <= error && std::abs(a[1] - b[1]) <= error &&
           std::abs(a[2] - b[2]) <= error;
  }

  // a coordinate that is away from x by more than are_close() allows for
  static double away_from(double x, double distance)
  {
    return x + distance * (std::max)(1.0, std::abs(x) * 1e-3);
  }

  // points that are written must be read back, also by copies
  void check_points(vertex_descriptor v, const Domain& copy)
  {
    const Point before = m_domain.point(v);
    const Coordinates c = Domain::coordinates(before);
    const Point moved =
      Domain::make_point({away_from(c[0], 1), away_from(c[1], -2), away_from(c[2], 3)});
    m_domain.set_point(v, moved);
    const Coordinates expected = m_domain.is_in_place() ? Domain::coordinates(moved) : c;
    require(are_close(Domain::coordinates(m_domain.point(v)), expected),
            "point() is not what set_point() and is_in_place() make it", v);
    require(are_close(Domain::coordinates(copy.point(v)), expected),
            "a copy of the domain does not stand for the same mesh", v);
    m_domain.set_point(v, before);
    require(are_close(Domain::coordinates(m_domain.point(v)), c),
            "set_point() does not restore a point", v);
    require(are_close(Domain::coordinates(Domain::make_point(c)), c),
            "coordinates() and make_point() are not inverse to each other", v);
  }

  const Domain& m_domain;
  Violations m_violations;
  std::set<std::string> m_known;
  std::map<std::size_t, vertex_descriptor> m_vertices; // by their indices
};

} // namespace internal

/// \ingroup PkgARAPDeformationChecks
/// \brief tests a model of `ARAPDomain` on a mesh: its functions must agree at each vertex and
/// simplex.
///
/// The mesh must have no cells that are not valid simplices: the concept allows them, but they get
/// a message here. Moves each point and restores it: the mesh is unchanged afterwards if the domain
/// conforms and does not throw; what is written to another place gets the points of the mesh. Takes
/// time proportional to the sum of the squared numbers of simplices at the vertices.
///
/// \returns a message for each requirement that the domain violates, with the first vertex where it
/// does; none if the domain conforms.
template <typename Domain>
std::vector<std::string> check_domain(const Domain& domain)
{
  return internal::Domain_check<Domain>(domain)();
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_DOMAIN_H
