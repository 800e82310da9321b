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

#ifndef CGAL_ARAP_DEFORMATION_CHECK_DOMAIN_H
#define CGAL_ARAP_DEFORMATION_CHECK_DOMAIN_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationChecks
/// \brief tests a model of `ARAPDomain_3` on a mesh: not only that it compiles, but that what its
/// functions say of each vertex and simplex agrees.
///
/// Each point is moved and put back, so that the mesh is afterwards as it was, if the domain conforms.
/// Takes time in proportion to the incidences of the mesh.
///
/// \returns a sentence for each requirement that the domain does not fulfil, with the first vertex
/// where this is seen; nothing if the domain conforms.
template <typename Domain>
std::vector<std::string> check_domain(const Domain& domain)
{
  using vertex_descriptor = typename Domain::vertex_descriptor;
  using simplex_descriptor = typename Domain::simplex_descriptor;
  using Point = typename Domain::Point;

  std::vector<std::string> violations;
  const auto require = [&violations](bool condition, const std::string& sentence, std::size_t vertex) {
    const auto is_known = [&](const std::string& s) { return s.compare(0, sentence.size(), sentence) == 0; };
    if(!condition && std::none_of(violations.begin(), violations.end(), is_known))
      violations.push_back(sentence + ", for vertex " + std::to_string(vertex));
  };

  // the vertices are different
  std::map<std::size_t, vertex_descriptor> vertices;
  for(vertex_descriptor v : domain.vertices())
    require(vertices.emplace(domain.index(v), v).second,
            "index() is the same for two vertices of vertices()", domain.index(v));

  // each simplex is seen in the same way from each of its corners
  const auto corners_of = [&domain](const auto& range) {
    std::vector<std::size_t> corners;
    for(vertex_descriptor v : range)
      corners.push_back(domain.index(v));
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  const auto is_seen_from = [&](simplex_descriptor s, vertex_descriptor v) {
    std::size_t times = 0;
    domain.for_each_incident_simplex(v, [&](simplex_descriptor t, const auto&) { times += t == s; });
    return times == 1;
  };
  for(const auto& [index, v] : vertices)
  {
    const std::size_t i = index;
    bool is_isolated = true;
    domain.for_each_incident_simplex(v, [&](simplex_descriptor s, const auto& corners) {
      is_isolated = false;
      const std::vector<std::size_t> sorted = corners_of(corners);
      require(std::binary_search(sorted.begin(), sorted.end(), i),
              "for_each_incident_simplex() gives a simplex without the vertex itself", i);
      require(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end(),
              "for_each_incident_simplex() gives a simplex with a corner twice", i);
      require(Domain::dimension == 2 ? sorted.size() >= 3 : sorted.size() == 4,
              "the number of corners of a simplex is not that of the dimension", i);
      require(sorted == corners_of(domain.simplex_vertices(s)),
              "simplex_vertices() and for_each_incident_simplex() give different corners", i);
      for(vertex_descriptor w : corners)
      {
        require(vertices.count(domain.index(w)) == 1, "a corner of a simplex is not in vertices()", i);
        require(is_seen_from(s, w), "a simplex is not given exactly once at each of its corners", i);
      }
    });
    require(is_isolated == domain.is_isolated(v),
            "is_isolated() and for_each_incident_simplex() disagree", i);
  }

  // what is written is read, by copies too, up to rounding: a mesh may have coordinates in float
  const auto are_close = [](const Coordinates& a, const Coordinates& b) {
    const double error = std::numeric_limits<float>::epsilon() *
                         (std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]));
    return std::abs(a[0] - b[0]) <= error && std::abs(a[1] - b[1]) <= error &&
           std::abs(a[2] - b[2]) <= error;
  };
  const Domain copy = domain;
  for(const auto& [index, v] : vertices)
  {
    const Point before = domain.point(v);
    const Coordinates c = Domain::coordinates(before);
    const Coordinates moved = {c[0] + 1, c[1] - 2, c[2] + 3};
    domain.set_point(v, Domain::make_point(moved));
    const Coordinates& expected = domain.is_in_place() ? moved : c;
    require(are_close(Domain::coordinates(domain.point(v)), expected),
            "point() is not what set_point() and is_in_place() make it", index);
    require(are_close(Domain::coordinates(copy.point(v)), expected),
            "a copy of the domain does not stand for the same mesh", index);
    domain.set_point(v, before);
    require(are_close(Domain::coordinates(domain.point(v)), c),
            "set_point() does not put a point back", index);
    require(are_close(Domain::coordinates(Domain::make_point(c)), c),
            "coordinates() and make_point() are not inverse to each other", index);
  }
  return violations;
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CHECK_DOMAIN_H
