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

// The drop-in class with its header first and CGAL's second; points of `float` and of an exact
// kernel.

#include <CGAL/ARAP_deformation/Surface_mesh_deformation.h>

#include <CGAL/Surface_mesh_deformation.h>

#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

using Float_mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<float>::Point_3>;
using Exact_mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>;

// the coordinates of all points after a run
template <typename Deformation>
std::vector<Eigen::Vector3d> run(const Shape& shape)
{
  typename Deformation::Triangle_mesh mesh =
    make_mesh<typename Deformation::Triangle_mesh>(shape);
  Deformation deformation(mesh);
  prepare(deformation, scenario(shape), all_vertices(mesh));
  deformation.deform(5, 0);
  std::vector<Eigen::Vector3d> points;
  for(auto v : vertices(mesh))
  {
    const auto& p = mesh.point(v);
    points.emplace_back(CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]));
  }
  return points;
}

double largest_distance(const std::vector<Eigen::Vector3d>& a,
                        const std::vector<Eigen::Vector3d>& b)
{
  double largest = 0;
  for(std::size_t k = 0; k < a.size(); ++k)
    largest = larger(largest, (a[k] - b[k]).norm());
  return largest;
}

int main()
{
  using Ours = CGAL::ARAP::Surface_mesh_deformation<Mesh>;
  using Cgals = CGAL::Surface_mesh_deformation<Mesh>;
  static_assert(std::is_same_v<Ours::Point, Cgals::Point>);
  static_assert(std::is_same_v<Ours::Weight_calculator, Cgals::Weight_calculator>);
  static_assert(std::is_same_v<Ours::Vertex_index_map, Cgals::Vertex_index_map>);
  static_assert(std::is_same_v<Ours::Hedge_index_map, Cgals::Hedge_index_map>);
  static_assert(std::is_same_v<Ours::Roi_vertex_range, Cgals::Roi_vertex_range>);
  for(const Shape& shape : {shapes()[2], shapes()[7]})
  {
    test_case() = shape.name;
    const auto ours = run<Ours>(shape);
    CHECK(largest_distance(ours, shape.points) > 0.01 * shape.diameter());
    CHECK_AT_MOST(largest_distance(ours, run<Cgals>(shape)), 1e-8 * shape.diameter());
    CHECK_AT_MOST(largest_distance(
                    ours, run<CGAL::ARAP::Surface_mesh_deformation<Float_mesh>>(shape)),
                  1e-5 * shape.diameter());
    CHECK_AT_MOST(largest_distance(
                    ours, run<CGAL::ARAP::Surface_mesh_deformation<Exact_mesh>>(shape)),
                  1e-12 * shape.diameter());
  }
  return checks_result();
}
