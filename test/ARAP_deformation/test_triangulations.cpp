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

// The domain of 3D triangulations: some of the cells, each term of the energy, and vertices that
// are moved where they should not be. test_triangulation_types has other types of triangulations.

#include "include/nasty_runs.h"
#include "include/term_runs.h"
#include "include/triangulation.h"

#include <CGAL/ARAP_deformation/Triangulation_domain.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/arap_deform.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

using CGAL::ARAP::Triangulation_domain;

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
  for(auto cell : t.finite_cell_handles())
    CHECK(domain.is_simplex(cell) == (selected.count(cell) > 0));
  compare_with_reference(domain);
}

// What only reads takes a triangulation or its domain, also a const one.
void test_measures()
{
  test_case() = "quality and places of a triangulation";
  using Triangulation = CGAL::Delaunay_triangulation_3<Epick>;
  const auto t = triangulation<Triangulation>();
  const auto rest = [](Triangulation::Vertex_handle v) {
    return Epick::Point_3(v->point().x(), 2 * v->point().y(), v->point().z());
  };
  CHECK_AT_MOST(std::abs(CGAL::ARAP::quality(t, rest).volume_change + 0.5), 1e-12);
  const auto found = CGAL::ARAP::locate(t, t.finite_vertices_begin()->point());
  CHECK(found && found->distance <= 1e-12);
}

// The infinite vertex has no point, and is none of the domain.
void test_infinite_vertex()
{
  test_case() = "infinite vertex";
  using Triangulation = CGAL::Delaunay_triangulation_3<Epick>;
  auto t = triangulation<Triangulation>();
  const auto rest = t;
  const auto v = t.finite_vertices_begin();
  using Targets = std::vector<std::pair<Triangulation::Vertex_handle, Epick::Point_3>>;
  const CGAL::ARAP::Report report = CGAL::arap_deform(
    t, Targets{{v, Epick::Point_3(0, 0, 9)}, {t.infinite_vertex(), Epick::Point_3(0, 0, 0)}});
  CHECK(report.status == CGAL::ARAP::Status::not_a_control_vertex);
  CHECK(report.message == "element 1 of the targets: the mesh has no such vertex");
  CHECK(t == rest);
  CHECK(!CGAL::ARAP::make_triangulation_domain(t).is_vertex(t.infinite_vertex()));

  CGAL::ARAP_deformation<Triangulation> deformation(t);
  CHECK(!deformation.is_roi_vertex(t.infinite_vertex()));
  CHECK(!deformation.is_control_vertex(t.infinite_vertex()));
  CHECK(!deformation.erase_roi_vertex(t.infinite_vertex()));
  CHECK(!deformation.erase_control_vertex(t.infinite_vertex()));
  CHECK(deformation.velocity(t.infinite_vertex()) == (CGAL::ARAP::Coordinates{0, 0, 0}));
#ifdef CGAL_NDEBUG // else a precondition says so
  CHECK(!deformation.insert_roi_vertex(t.infinite_vertex()));
  CHECK(!deformation.insert_control_vertex(t.infinite_vertex()));
  CHECK(!deformation.insert_control_vertex(t.infinite_vertex(), Epick::Point_3(0, 0, 0)));
  const auto refused = deformation.set_target_position(t.infinite_vertex(),
                                                       Epick::Point_3(0, 0, 0));
  CHECK(refused.status == CGAL::ARAP::Status::not_a_control_vertex);
  CHECK(refused.message.find("a vertex that the mesh does not have") == 0);
#endif
  for(auto cell : {Triangulation::Cell_handle(), t.infinite_cell()})
    CHECK(deformation.insert_control_point(cell, {0.25, 0.25, 0.25, 0.25}).status ==
          CGAL::ARAP::Status::not_a_simplex);
  CHECK(deformation.roi_vertices().empty());
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
  test_some_cells();
  test_terms_of_cells();
  test_measures();
  test_infinite_vertex();
  test_shelf();
  return checks_result();
}
