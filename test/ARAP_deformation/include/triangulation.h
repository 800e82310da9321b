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

#ifndef CGAL_ARAP_DEFORMATION_TEST_TRIANGULATION_H
#define CGAL_ARAP_DEFORMATION_TEST_TRIANGULATION_H

// A triangulation of any type is deformed as ranges of points and tetrahedra are.

#include "check.h"
#include "domains.h"

#include <CGAL/ARAP_deformation/Triangulation_domain.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <random>
#include <set>
#include <vector>

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;

inline std::vector<Eigen::Vector3d> random_points(int n)
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
Block block_of(const CGAL::ARAP::Triangulation_domain<Triangulation>& domain)
{
  using Domain = CGAL::ARAP::Triangulation_domain<Triangulation>;
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
void compare_with_reference(CGAL::ARAP::Triangulation_domain<Triangulation> domain)
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
      domain.set_point(v, CGAL::ARAP::Triangulation_domain<Triangulation>::make_point(
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

#endif // CGAL_ARAP_DEFORMATION_TEST_TRIANGULATION_H
