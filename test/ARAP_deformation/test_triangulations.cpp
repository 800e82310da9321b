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

// The domain of 3D triangulations: all finite cells or some of them, each term of the energy,
// weights that are kept, caches that are renewed, the triangulation of tetrahedral remeshing, and
// vertices that are moved where they should not be.

#include "include/nasty_runs.h"
#include "include/term_runs.h"

#include <CGAL/ARAP_deformation/Triangulation_domain.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_with_circumcenter_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_with_weighted_circumcenter_3.h>
#include <CGAL/Tetrahedral_remeshing/Remeshing_triangulation_3.h>
#include <CGAL/Triangulation_3.h>

#include <algorithm>
#include <random>
#include <set>

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using CGAL::ARAP::Triangulation_domain;

std::vector<Eigen::Vector3d> random_points(int n)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(0, 3), y(0, 1);
  std::vector<Eigen::Vector3d> points;
  for(int k = 0; k < n; ++k)
    points.emplace_back(x(random), y(random), y(random));
  return points;
}

// a triangulation as points and tetrahedra, in the order of its finite vertices
template <typename Triangulation>
Block block_of(const Triangulation_domain<Triangulation>& domain)
{
  using Domain = Triangulation_domain<Triangulation>;
  Block block;
  std::set<typename Triangulation::Cell_handle> cells;
  for(auto v : domain.vertices())
  {
    const auto c = Domain::coordinates(domain.point(v));
    block.points.emplace_back(c[0], c[1], c[2]);
    domain.for_each_incident_simplex(v, [&](auto cell, const auto& corners) {
      if(cells.insert(cell).second)
        block.tetrahedra.push_back({domain.index(corners[0]), domain.index(corners[1]),
                                    domain.index(corners[2]), domain.index(corners[3])});
    });
  }
  return block;
}

template <typename Triangulation>
void compare_with_reference(Triangulation_domain<Triangulation> domain)
{
  using Vertex = typename Triangulation::Vertex_handle;
  check_conforms(domain);
  const Block shape = block_of(domain);
  const Scenario s = scenario(shape);
  const std::vector<Vertex> vertices(domain.vertices().begin(), domain.vertices().end());
  for(Cell_scheme cells : all_cell_schemes)
  {
    compare(reference<3>(shape.points, shape.tetrahedra, s, cells),
            deform(domain, vertices, s, cells), shape.diameter(), 1e-10,
            1e-7); // the triangulation of random points has slivers
    for(Vertex v : vertices)
      domain.set_point(v, Triangulation_domain<Triangulation>::make_point(
        {shape.points[domain.index(v)].x(), shape.points[domain.index(v)].y(),
         shape.points[domain.index(v)].z()}));
  }
}

template <typename Triangulation>
Triangulation triangulation()
{
  Triangulation t;
  for(const auto& p : random_points(150))
    t.insert(typename Triangulation::Geom_traits::Point_3(p.x(), p.y(), p.z()));
  return t;
}

void test_plain()
{
  test_case() = "Triangulation_3";
  using Triangulation = CGAL::Triangulation_3<Epick>;
  auto t = triangulation<Triangulation>();
  compare_with_reference(CGAL::ARAP::make_triangulation_domain(t));

  // the class finds the domain by itself
  CGAL::ARAP_deformation<Triangulation> deformation(t);
  static_assert(std::is_same_v<decltype(deformation)::Deformation_domain,
                               Triangulation_domain<Triangulation>>);
  CHECK(deformation.domain().vertices().size() == t.number_of_vertices());

  // without cells every vertex is isolated
  Triangulation flat;
  flat.insert(Epick::Point_3(0, 0, 0));
  flat.insert(Epick::Point_3(1, 0, 0));
  CGAL::ARAP_deformation<Triangulation> nothing(flat);
  for(auto v : flat.finite_vertex_handles())
    nothing.insert_control_vertex(v);
  nothing.translate(*flat.finite_vertex_handles().begin(), Epick::Vector_3(3, 0, 0));
  CHECK(nothing.deform().status == CGAL::ARAP::Status::no_simplex);
  CHECK((*flat.finite_vertex_handles().begin())->point() != Epick::Point_3(3, 0, 0));
}

// each term of the energy, over all cells and over some
void test_terms_of_cells()
{
  using Triangulation = CGAL::Delaunay_triangulation_3<Epick>;
  for(const double height : {2.0, 0.7})
  {
    test_case() = "terms, cells below " + std::to_string(height);
    const auto make = [&](const auto& compare_with) {
      auto t = triangulation<Triangulation>();
      std::set<Triangulation::Cell_handle> selected;
      for(auto cell : t.finite_cell_handles())
        if(cell->vertex(0)->point().y() < height)
          selected.insert(cell);
      const Triangulation_domain domain(
        t, [&](Triangulation::Cell_handle cell) { return selected.count(cell) > 0; });
      compare_with(domain, std::vector<Triangulation::Vertex_handle>(domain.vertices().begin(),
                                                                     domain.vertices().end()));
    };
    Block shape;
    make([&](const auto& domain, const auto&) { shape = block_of(domain); });
    test_terms<3>(shape.points, shape.tetrahedra, scenario(shape), make);
  }
}

void test_some_cells()
{
  test_case() = "some cells";
  using Triangulation = CGAL::Delaunay_triangulation_3<Epick>;
  auto t = triangulation<Triangulation>();
  // decided once: the points will move
  std::set<Triangulation::Cell_handle> selected;
  for(auto cell : t.finite_cell_handles())
    if(CGAL::centroid(cell->vertex(0)->point(), cell->vertex(1)->point(),
                      cell->vertex(2)->point(), cell->vertex(3)->point()).y() < 0.7)
      selected.insert(cell);
  const Triangulation_domain domain(
    t, [&](Triangulation::Cell_handle cell) { return selected.count(cell) > 0; });
  CHECK(block_of(domain).tetrahedra.size() == selected.size());
  CHECK(selected.size() < t.number_of_finite_cells());
  compare_with_reference(domain);
}

// what cells have cached is computed from the new points
void test_circumcenters()
{
  test_case() = "cached circumcenters";
  using Vertex_base = CGAL::Triangulation_vertex_base_3<Epick>;
  using Cell_base = CGAL::Delaunay_triangulation_cell_base_with_circumcenter_3<Epick>;
  using Structure = CGAL::Triangulation_data_structure_3<Vertex_base, Cell_base>;
  using Triangulation = CGAL::Delaunay_triangulation_3<Epick, Structure>;
  auto t = triangulation<Triangulation>();
  const Block shape = block_of(CGAL::ARAP::make_triangulation_domain(t));
  CGAL::ARAP_deformation<Triangulation> deformation(t);
  const std::vector<Triangulation::Vertex_handle> vertices(t.finite_vertex_handles().begin(),
                                                           t.finite_vertex_handles().end());
  prepare(deformation, scenario(shape), vertices);
  for(int run = 0; run < 3; ++run)
  {
    for(auto cell : t.finite_cell_handles())
      cell->circumcenter();
    CHECK(deformation.deform(5, 0));
    for(auto cell : t.finite_cell_handles())
    {
      const auto p = [&](int k) { return cell->vertex(k)->point(); };
      CHECK(cell->circumcenter() == CGAL::circumcenter(p(0), p(1), p(2), p(3)));
    }
  }
}

// The phases of a frame add up to its total, and writing the points back is one of them.
void test_seconds()
{
  test_case() = "seconds";
  using Vertex_base = CGAL::Triangulation_vertex_base_3<Epick>;
  using Cell_base = CGAL::Delaunay_triangulation_cell_base_with_circumcenter_3<Epick>;
  using Structure = CGAL::Triangulation_data_structure_3<Vertex_base, Cell_base>;
  using Triangulation = CGAL::Delaunay_triangulation_3<Epick, Structure>;
  Triangulation t;
  for(const auto& p : random_points(3000))
    t.insert(Epick::Point_3(p.x(), p.y(), p.z()));
  CGAL::ARAP_deformation<Triangulation> deformation(t);
  const auto& domain = deformation.domain();
  const std::vector<Triangulation::Vertex_handle> vertices(t.finite_vertex_handles().begin(),
                                                           t.finite_vertex_handles().end());
  prepare(deformation, scenario(block_of(domain)), vertices);
  double outside = infinity, transfer = infinity, writing = infinity; // the least: others interrupt
  for(int frame = 0; frame < 5; ++frame)
  {
    const CGAL::ARAP::Phase_seconds s = deformation.deform(2, 0).seconds;
    outside = (std::min)(outside, s.total - 1.05 * sum_of_phases(s));
    transfer = (std::min)(transfer, s.transfer);
    CGAL::ARAP::Phase_seconds written;
    {
      CGAL::ARAP::internal::Scoped_seconds seconds(written.transfer);
      for(auto v : vertices)
        domain.set_point(v, domain.point(v));
    }
    writing = (std::min)(writing, written.transfer);
  }
  CHECK_AT_MOST(outside, 1e-3);
  CHECK_AT_MOST(0.5 * writing, transfer);
}

void test_weights()
{
  test_case() = "Regular_triangulation_3";
  using Vertex_base = CGAL::Regular_triangulation_vertex_base_3<Epick>;
  using Cell_base = CGAL::Regular_triangulation_cell_base_with_weighted_circumcenter_3<Epick>;
  using Structure = CGAL::Triangulation_data_structure_3<Vertex_base, Cell_base>;
  using Triangulation = CGAL::Regular_triangulation_3<Epick, Structure>;
  Triangulation t;
  double weight = 0;
  for(const auto& p : random_points(150))
    t.insert(Epick::Weighted_point_3(Epick::Point_3(p.x(), p.y(), p.z()), weight += 1e-5));
  std::map<Triangulation::Vertex_handle, double> weights;
  for(auto v : t.finite_vertex_handles())
    weights[v] = v->point().weight();
  for(auto cell : t.finite_cell_handles())
    cell->weighted_circumcenter(Epick());
  compare_with_reference(CGAL::ARAP::make_triangulation_domain(t));

  CGAL::ARAP_deformation<Triangulation> deformation(t);
  const std::vector<Triangulation::Vertex_handle> vertices(t.finite_vertex_handles().begin(),
                                                           t.finite_vertex_handles().end());
  prepare(deformation, scenario(block_of(deformation.domain())), vertices);
  CHECK(deformation.deform(5, 0));
  for(auto v : vertices)
    CHECK(v->point().weight() == weights[v]);
  for(auto cell : t.finite_cell_handles())
  {
    const auto p = [&](int k) { return cell->vertex(k)->point(); };
    CHECK(cell->weighted_circumcenter(Epick()) ==
          Epick().construct_weighted_circumcenter_3_object()(p(0), p(1), p(2), p(3)));
  }
}

void test_remeshing()
{
  test_case() = "Remeshing_triangulation_3";
  using Triangulation = CGAL::Tetrahedral_remeshing::Remeshing_triangulation_3<Epick>;
  auto t = triangulation<Triangulation>();
  std::size_t inside = 0;
  for(auto cell : t.finite_cell_handles())
  {
    const bool is_inside = cell->vertex(0)->point().x() < 2;
    cell->set_subdomain_index(is_inside ? 1 : 0);
    inside += is_inside;
  }
  const auto domain = CGAL::ARAP::make_triangulation_domain(t);
  CHECK(block_of(domain).tetrahedra.size() == inside);
  compare_with_reference(domain);
}

void test_shelf()
{
  const std::vector<Nasty_volume> shelf = nasty_points_of_a_volume();
  CGAL::Delaunay_triangulation_3<Epick> t;
  std::vector<decltype(t)::Vertex_handle> vertices;
  for(const auto& p : shelf.front().points)
    vertices.push_back(t.insert(Epick::Point_3(p.x(), p.y(), p.z())));
  for(const Nasty_volume& shape : shelf)
    test_in_place_of("triangulation", CGAL::ARAP::make_triangulation_domain(t), vertices, shape);
  print_ends();
}

int main()
{
  test_plain();
  test_some_cells();
  test_terms_of_cells();
  test_circumcenters();
  test_seconds();
  test_weights();
  test_remeshing();
  test_shelf();
  return checks_result();
}
