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

// A program compiled with -ffast-math, for which std::isfinite() is always true: what is not a
// number is refused nevertheless.

#undef CGAL_ARAP_DEFORMATION_COMPILED

#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Dynamics.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/parallel/largest_entry.h>

#include <cstddef>
#include <limits>
#include <vector>

using namespace CGAL::ARAP;

struct Weight : Uniform_weight
{
  double edge_weight(Edge_set, std::size_t i, std::size_t j, double) const
  {
    return i + j == 3 ? value : 1;
  }
  double value;
};

// one vertex is moved
Report deform(double target, double coordinate, double weight)
{
  using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, Weight>;
  Mesh mesh = make_mesh<Mesh>(octahedron());
  mesh.point(Mesh::Vertex_index(4)) = Point(0.1, coordinate, 0.2);
  CGAL::ARAP_deformation<Mesh, Traits> deformation(mesh, Traits({}, Weight{{}, weight}));
  for(auto v : mesh.vertices())
    deformation.insert_roi_vertex(v);
  for(int v : {0, 5})
    deformation.insert_control_vertex(Mesh::Vertex_index(v));
  deformation.set_target_position(Mesh::Vertex_index(0), Point(1, target, 0));
  return deformation.deform(5, 0);
}

// Three of them depend on each other, but for rounding errors.
void test_points_on_an_edge()
{
  Mesh mesh = make_mesh<Mesh>(octahedron());
  for(double share : {0.5, 0.3, 0.6, 0.43})
  {
    CGAL::ARAP_deformation<Mesh> deformation(mesh);
    for(auto v : mesh.vertices())
      deformation.insert_roi_vertex(v);
    for(double a : {1.0, share, 0.0})
      CHECK(deformation.insert_control_point(Mesh::Face_index(0), {a, 1 - a, 0}));
    CHECK(deformation.deform().status == Status::dependent_target);
  }
}

int main()
{
  CHECK(deform(1, 1, 1));
  CHECK(deform(1e200, 1, 1).status == Status::non_finite_energy);
  test_points_on_an_edge();
  for(std::size_t k : {0, 4000, 9999})
  {
    std::vector<Coordinates> rows(10000, {1, -2, 0});
    rows[k][1] = std::numeric_limits<double>::quiet_NaN();
    CHECK(internal::is_nan(internal::largest_entry(rows.data(), rows.size())));
  }
  for(double bad : {std::numeric_limits<double>::quiet_NaN(),
                    std::numeric_limits<double>::infinity()})
  {
    CHECK(deform(bad, 1, 1).status == Status::non_finite_point);
    CHECK(deform(1, bad, 1).status == Status::non_finite_point);
    CHECK(deform(1, 1, bad).status == Status::non_finite_weight);
    for(double Dynamics::* member : {&Dynamics::time_step, &Dynamics::density, &Dynamics::modulus,
                                     &Dynamics::damping})
    {
      Dynamics dynamics;
      dynamics.*member = bad;
      CHECK(dynamics.check().status == Status::invalid_option);
    }
    Dynamics dynamics;
    dynamics.acceleration[1] = bad;
    CHECK(dynamics.check().status == Status::invalid_option);
    for(double Options::* member : {&Options::tolerance, &Options::bending_length})
    {
      Options options;
      options.*member = bad;
      CHECK(options.check().status == Status::invalid_option);
    }
  }
  return checks_result();
}
