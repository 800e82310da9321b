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

// Shapes that are not clean in data structures: surfaces in those for halfedges, also where the
// points are written to another place, and volumes in cell complexes and triangulations, whose
// vertices are moved to where they should not be.

#include "include/nasty_runs.h"

#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/Linear_cell_complex_domain_3.h>
#include <CGAL/ARAP_deformation/Triangulation_domain_3.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_cell_complex_for_bgl_combinatorial_map_helper.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/graph_traits_Linear_cell_complex_for_combinatorial_map.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

using Traits = CGAL::Linear_cell_complex_traits<3, Kernel>;
using Surface_complex =
  CGAL::Linear_cell_complex_for_bgl_combinatorial_map_helper<2, 3, Traits>::type;
using Volume_complex = CGAL::Linear_cell_complex_for_combinatorial_map<3, 3, Traits>;
using Triangulation =
  CGAL::Delaunay_triangulation_3<CGAL::Exact_predicates_inexact_constructions_kernel>;

template <typename Graph, std::size_t N>
void test_as_graph(const std::string& structure, const Nasty_shape<N>& shape)
{
  Graph mesh = make_mesh<Graph>(shape.points, shape.simplices);
  test_in_place_of(structure, CGAL::ARAP::Face_graph_domain<Graph>(mesh), all_vertices(mesh),
                   shape);
}

template <std::size_t N>
void test_with_output_map(const Nasty_shape<N>& shape)
{
  const Mesh mesh = make_mesh<Mesh>(shape.points, shape.simplices);
  for_each_case(shape, "output map", [&](const Handles& handles, const Options& options) {
    std::map<Mesh::Vertex_index, Point> output;
    const auto output_map = boost::make_assoc_property_map(output);
    using Domain = CGAL::ARAP::Face_graph_domain<const Mesh, CGAL::Default, CGAL::Default,
                                                 decltype(output_map)>;
    CGAL::ARAP_deformation<Domain> deformation(
      Domain(mesh, mesh.points(), get(boost::vertex_index, mesh), output_map));
    const bool is_done = run(deformation, all_vertices(mesh), [&](auto v) {
      const auto written = output.find(v);
      return written == output.end() ? mesh.point(v) : written->second;
    }, handles, options);
    CHECK(output.size() == (is_done ? num_vertices(mesh) : 0));
  });
}

template <std::size_t N>
void test_as_graphs(const std::vector<Nasty_shape<N>>& shelf)
{
  for(const Nasty_shape<N>& shape : manifold(shelf))
  {
    test_as_graph<Mesh>("Surface_mesh", shape);
    test_as_graph<CGAL::Polyhedron_3<Kernel>>("Polyhedron_3", shape);
    test_as_graph<Surface_complex>("linear cell complex", shape);
    test_with_output_map(shape);
  }
}

int main()
{
  test_as_graphs(nasty_surfaces());
  test_as_graphs(nasty_polygons());

  const std::vector<Nasty_volume> volumes = nasty_points_of_a_volume();
  const Nasty_volume& good = volumes.front();
  Volume_complex complex;
  for(const auto& t : good.simplices)
    complex.make_tetrahedron(point(good.points[t[0]]), point(good.points[t[1]]),
                             point(good.points[t[2]]), point(good.points[t[3]]));
  complex.sew3_same_facets();
  const CGAL::ARAP::Linear_cell_complex_domain_3<Volume_complex> cells(complex);
  std::map<Point, decltype(cells)::vertex_descriptor> places;
  for(auto v : cells.vertices())
    places.emplace(cells.point(v), v);
  std::vector<decltype(cells)::vertex_descriptor> vertices_of_cells;

  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> vertices_of_triangulation;
  for(const auto& p : good.points)
  {
    vertices_of_cells.push_back(places.at(point(p)));
    vertices_of_triangulation.push_back(
      triangulation.insert(Triangulation::Point(p.x(), p.y(), p.z())));
  }
  for(const Nasty_volume& shape : volumes)
  {
    test_in_place_of("linear cell complex", cells, vertices_of_cells, shape);
    test_in_place_of("triangulation", CGAL::ARAP::make_triangulation_domain(triangulation),
                     vertices_of_triangulation, shape);
  }
  print_ends();
  return checks_result();
}
