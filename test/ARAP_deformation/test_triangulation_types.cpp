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

// Triangulations of types that are dear to compile: a plain one, caches that are renewed, weights
// that are kept, and that of tetrahedral remeshing.

#include "include/domains.h"
#include "include/triangulation.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Triangulation_domain.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_with_circumcenter_3.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_with_weighted_circumcenter_3.h>
#include <CGAL/Tetrahedral_remeshing/Remeshing_triangulation_3.h>
#include <CGAL/Triangulation_3.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <type_traits>
#include <vector>

using CGAL::ARAP::Triangulation_domain;

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

using Triangulation_with_circumcenters = CGAL::Delaunay_triangulation_3<
  Epick, CGAL::Triangulation_data_structure_3<
           CGAL::Triangulation_vertex_base_3<Epick>,
           CGAL::Delaunay_triangulation_cell_base_with_circumcenter_3<Epick>>>;

// what cells have cached is computed from the new points
void test_circumcenters()
{
  test_case() = "cached circumcenters";
  using Triangulation = Triangulation_with_circumcenters;
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
  using Triangulation = Triangulation_with_circumcenters;
  Triangulation t;
  for(const auto& p : random_points(3000))
    t.insert(Epick::Point_3(p.x(), p.y(), p.z()));
  CGAL::ARAP_deformation<Triangulation> deformation(t);
  const auto& domain = deformation.domain();
  const std::vector<Triangulation::Vertex_handle> vertices(t.finite_vertex_handles().begin(),
                                                           t.finite_vertex_handles().end());
  prepare(deformation, scenario(block_of(domain)), vertices);
  const double infinity = std::numeric_limits<double>::infinity();
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

int main()
{
  test_plain();
  test_circumcenters();
  test_seconds();
  test_weights();
  test_remeshing();
  return checks_result();
}
