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

// Weights that the user gives for each edge: those of cotangents give what cotangents give, on
// meshes with and without indices and on tetrahedra, and an edge without a weight does not hold.

#include "include/domains.h"

#include <CGAL/ARAP_deformation/Edge_map_weight.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/Polyhedron_3.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

using CGAL::ARAP::Edge_map_weight;
using CGAL::ARAP::Status;
using Traits = CGAL::ARAP_deformation_traits_3<CGAL::Default, Edge_map_weight>;

// for each edge the sum of its weights in all simplices, as a star has it
template <std::size_t N>
Edge_map_weight star_weights(const std::vector<Eigen::Vector3d>& points,
                             const std::vector<std::array<std::size_t, N>>& simplices)
{
  std::map<std::pair<std::size_t, std::size_t>, double> sums;
  for(const auto& simplex : simplices)
  {
    std::array<CGAL::ARAP::Coordinates, N> corners;
    for(std::size_t k = 0; k < N; ++k)
      corners[k] = {points[simplex[k]].x(), points[simplex[k]].y(), points[simplex[k]].z()};
    const auto weights = CGAL::ARAP::Cotangent_weight().simplex_weights(corners);
    auto w = weights.begin();
    for(std::size_t a = 0; a < N; ++a)
      for(std::size_t b = a + 1; b < N; ++b)
        sums[std::minmax(simplex[a], simplex[b])] += *w++;
  }
  Edge_map_weight weight;
  for(const auto& [edge, sum] : sums)
    weight.set_weight(edge.second, edge.first, sum < 0 ? 0 : sum); // in either direction
  return weight;
}

template <typename Domain, typename Vertices>
std::vector<double> energies(const Domain& domain, const Vertices& vertices, const Scenario& s,
                             const Edge_map_weight& weight)
{
  CGAL::ARAP_deformation<Domain, Traits> deformation(domain, Traits({}, weight));
  CGAL::ARAP::Options options;
  options.cells = Cell_scheme::spokes();
  deformation.set_options(options);
  prepare(deformation, s, vertices);
  const CGAL::ARAP::Report report = deformation.deform(10, 0);
  CHECK(report);
  return report.energy;
}

void compare(const std::vector<double>& a, const std::vector<double>& b)
{
  CHECK(a.size() == b.size());
  for(std::size_t k = 0; k < a.size() && k < b.size(); ++k)
    CHECK_AT_MOST(std::abs(a[k] - b[k]), 1e-10 * b[0]);
}

// the same from a property map of the mesh's edges
template <typename Mesh_>
void test_mesh(const Shape& shape)
{
  const Scenario s = scenario(shape);
  const std::vector<double> expected =
    reference<2>(shape.points, shape.triangles, s, Cell_scheme::spokes()).energy;
  Mesh_ mesh = make_mesh<Mesh_>(shape);
  const auto all = all_vertices(mesh);
  std::map<typename boost::graph_traits<Mesh_>::vertex_descriptor, std::size_t> numbers;
  for(std::size_t k = 0; k < all.size(); ++k)
    numbers[all[k]] = k;
  const Edge_map_weight by_index = star_weights(shape.points, shape.triangles);
  std::map<typename boost::graph_traits<Mesh_>::edge_descriptor, double> weights;
  for(auto e : edges(mesh))
    weights[e] = by_index.edge_weight(CGAL::ARAP::Edge_set::star, numbers[source(e, mesh)],
                                      numbers[target(e, mesh)], 0);
  compare(energies(CGAL::ARAP::Face_graph_domain<Mesh_>(mesh), all, s,
                   CGAL::ARAP::make_edge_map_weight(mesh,
                                                    boost::make_assoc_property_map(weights))),
          expected);
}

int main()
{
  for(const Shape& shape : shapes())
  {
    test_case() = shape.name;
    test_mesh<Mesh>(shape);
    test_mesh<CGAL::Polyhedron_3<Kernel>>(shape);
  }

  test_case() = "tetrahedra";
  const Block solid = block(4, 2, 2);
  const Scenario s = scenario(solid);
  std::vector<Point> points = points_of(solid.points);
  using Soup = CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>, decltype(solid.tetrahedra)>;
  compare(energies(Soup(points, solid.tetrahedra), numbers(points.size()), s,
                   star_weights(solid.points, solid.tetrahedra)),
          reference<3>(solid.points, solid.tetrahedra, s, Cell_scheme::spokes()).energy);

  test_case() = "edges without a weight";
  points = points_of(solid.points);
  CGAL::ARAP_deformation<Soup, Traits> loose(Soup(points, solid.tetrahedra));
  prepare(loose, s, numbers(points.size()));
  const CGAL::ARAP::Report report = loose.deform();
  CHECK(report); // each free vertex is a part that nothing holds
  CHECK(report.unconstrained_components.size() ==
        std::size_t(std::count(s.selection.begin(), s.selection.end(), 1)));
  return checks_result();
}
