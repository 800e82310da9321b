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

// The domain of a complex that 3D mesh generation made: its cells only, one subdomain of several,
// all terms of the energy, and weights of points and caches of cells.

#include "include/nasty_runs.h"
#include "include/term_runs.h"

#include <CGAL/ARAP_deformation/Triangulation_domain.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>

#include <map>
#include <set>

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh_domain = CGAL::Labeled_mesh_domain_3<Epick>;
using Triangulation = CGAL::Mesh_triangulation_3<Mesh_domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Vertex = Triangulation::Vertex_handle;
using Domain = CGAL::ARAP::Triangulation_domain<Triangulation>;

// an ellipsoid: subdomain 1 in the left half, 2 in the right half
Complex make_complex()
{
  using namespace CGAL::parameters;
  const auto label = [](const Epick::Point_3& p) {
    const double value = p.x() * p.x() / 4 + p.y() * p.y() + p.z() * p.z();
    return value > 1 ? 0 : p.x() < 0 ? 1 : 2;
  };
  const Mesh_domain domain(label, Epick::Sphere_3(CGAL::ORIGIN, 9.));
  const CGAL::Mesh_criteria_3<Triangulation> criteria(facet_angle = 25, facet_size = 0.5,
                                                      cell_radius_edge_ratio = 2, cell_size = 0.5);
  return CGAL::make_mesh_3<Complex>(domain, criteria, no_perturb(), no_exude());
}

Epick::Point_3 point_at(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Block block_of(const Domain& domain, const std::set<Triangulation::Cell_handle>& cells)
{
  Block block;
  for(Vertex v : domain.vertices())
  {
    const auto c = Domain::coordinates(domain.point(v));
    block.points.emplace_back(c[0], c[1], c[2]);
  }
  for(Triangulation::Cell_handle cell : cells)
    block.tetrahedra.push_back({domain.index(cell->vertex(0)), domain.index(cell->vertex(1)),
                                domain.index(cell->vertex(2)), domain.index(cell->vertex(3))});
  return block;
}

void compare_with_reference(const Domain& domain, const std::set<Triangulation::Cell_handle>& cells)
{
  CHECK(!cells.empty());
  check_conforms(domain);
  const Block shape = block_of(domain, cells);
  Scenario s = scenario(shape);
  const std::vector<Vertex> vertices(domain.vertices().begin(), domain.vertices().end());
  for(std::size_t v = 0; v < vertices.size(); ++v)
    if(domain.is_isolated(vertices[v]))
      s.selection[v] = 0;
  for(Cell_scheme scheme : all_cell_schemes)
  {
    compare(reference<3>(shape.points, shape.tetrahedra, s, scheme),
            deform(domain, vertices, s, scheme), shape.diameter());
    for(Vertex v : vertices)
      domain.set_point(v, point_at(shape.points[domain.index(v)]));
  }
  test_terms<3>(shape.points, shape.tetrahedra, s, [&](const auto& compare_with) {
    compare_with(domain, vertices);
    for(Vertex v : vertices)
      domain.set_point(v, point_at(shape.points[domain.index(v)]));
  });
}

// half of the cells, so that some vertices are isolated
void test_shelf()
{
  const std::vector<Nasty_volume> shelf = nasty_points_of_a_volume();
  Complex complex;
  std::vector<Vertex> vertices;
  for(const auto& p : shelf.front().points)
    vertices.push_back(
      complex.triangulation().insert(Triangulation::Weighted_point(point_at(p), 0)));
  const double middle = shelf.front().points[shelf.front().points.size() / 2].x();
  for(auto cell : complex.triangulation().finite_cell_handles())
  {
    bool is_left = true;
    for(int k = 0; k < 4; ++k)
      is_left &= cell->vertex(k)->point().x() <= middle;
    if(is_left)
      complex.add_to_complex(cell, 1);
  }
  const Domain domain = CGAL::ARAP::make_complex_domain(complex);
  CHECK(complex.number_of_cells_in_complex() > 0);
  CHECK(domain.is_isolated(vertices.back()));
  for(const Nasty_volume& shape : shelf)
    test_in_place_of("mesh complex", domain, vertices, shape);
  print_ends();
}

int main()
{
  test_shelf();
  Complex complex = make_complex();
  Triangulation& triangulation = complex.triangulation();
  const auto& traits = triangulation.geom_traits();
  std::set<Triangulation::Cell_handle> all, right;
  for(auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
  {
    all.insert(cell);
    if(complex.subdomain_index(cell) == 2)
      right.insert(cell);
  }
  CHECK(right.size() < all.size() && all.size() < triangulation.number_of_finite_cells());

  test_case() = "all subdomains";
  compare_with_reference(CGAL::ARAP::make_complex_domain(complex), all);
  test_case() = "one subdomain";
  compare_with_reference(CGAL::ARAP::make_complex_domain(complex, 2), right);

  test_case() = "weights and caches";
  std::map<Vertex, double> weights;
  for(Vertex v : triangulation.finite_vertex_handles())
  {
    v->set_point(Triangulation::Weighted_point(v->point().point(),
                                               1e-4 * (1 + weights.size() % 3)));
    weights[v] = v->point().weight();
  }
  for(auto cell : triangulation.finite_cell_handles())
  {
    cell->invalidate_weighted_circumcenter_cache();
    cell->weighted_circumcenter(traits);
    cell->set_sliver_value(0.5);
  }
  CGAL::ARAP_deformation<Complex> deformation(complex); // finds its domain by itself
  static_assert(std::is_same_v<decltype(deformation)::Deformation_domain, Domain>);
  Vertex lowest = *triangulation.finite_vertex_handles().begin(), highest = lowest;
  for(Vertex v : triangulation.finite_vertex_handles())
  {
    if(deformation.domain().is_isolated(v))
      continue;
    deformation.insert_roi_vertex(v);
    if(v->point().x() < lowest->point().x()) lowest = v;
    if(v->point().x() > highest->point().x()) highest = v;
  }
  deformation.insert_control_vertex(lowest);
  deformation.insert_control_vertex(highest);
  deformation.translate(highest, Epick::Vector_3(0, 0, 0.5));
  const Epick::Point_3 target = deformation.target_position(highest);
  CHECK(deformation.deform(5, 0));
  CHECK(highest->point().point() == target);
  for(Vertex v : triangulation.finite_vertex_handles())
    CHECK(v->point().weight() == weights[v]);
  for(auto cell : all)
  {
    const auto p = [&](int k) { return cell->vertex(k)->point(); };
    CHECK(cell->weighted_circumcenter(traits) ==
          traits.construct_weighted_circumcenter_3_object()(p(0), p(1), p(2), p(3)));
    CHECK(!cell->is_cache_valid());
  }
  return checks_result();
}
