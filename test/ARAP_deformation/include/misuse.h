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

#ifndef CGAL_ARAP_DEFORMATION_TEST_MISUSE_H
#define CGAL_ARAP_DEFORMATION_TEST_MISUSE_H

#include "check.h"
#include "shapes.h"

#include <CGAL/ARAP_deformation.h>

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

// Gives each call that sets a target of what has none to `check_refused`.
// Nothing may have changed by it.
template <typename CheckRefused>
void test_misuse(const CheckRefused& check_refused)
{
  Mesh mesh = make_mesh<Mesh>(octahedron());
  CGAL::ARAP_deformation<Mesh> d(mesh);
  const Mesh::Vertex_index control(2), free(5);
  const std::vector<Mesh::Vertex_index> vertices = {free, control};
  const Eigen::Vector3d t(0, 0, 1);
  const Eigen::Quaterniond q(1, 0, 0, 0);
  d.insert_control_vertex(control);
  const Point target = d.target_position(control);
  for(int pass = 0; pass < 2; ++pass) // outside of the region, and free in it
  {
    check_refused([&] { return d.set_target_position(free, Point(1, 2, 3)); });
    check_refused([&] { return d.translate(free, t); });
    check_refused([&] { return d.rotate(free, t, q); });
    check_refused([&] { return d.translate(vertices, t); });
    check_refused([&] { return d.rotate(vertices, t, q); });
    check_refused([&] { return d.set_target_weight(free, 1); });
    check_refused([&] { return d.set_target_weight(vertices, 1); });
    check_refused([&] { return d.set_target_set(free, [](const Point& p) { return p; }); });
    const CGAL::ARAP::Control_point none(1);
    check_refused([&] { return d.set_target_position(none, Point(1, 2, 3)); });
    check_refused([&] { return d.translate(none, t); });
    check_refused([&] { return d.rotate(none, t, q); });
    check_refused([&] { return d.set_target_weight(none, 1); });
    check_refused([&] { return d.set_target_set(none, [](const Point& p) { return p; }); });
    CHECK(!d.is_control_vertex(free));
    CHECK(d.target_position(control) == target);
    CHECK(std::isinf(d.target_weight(control)));
    d.insert_roi_vertex(free);
  }

  // a range stops where it is refused
  const Mesh::Vertex_index other(0);
  d.insert_control_vertex(other);
  const Point last = d.target_position(other);
  const std::vector<Mesh::Vertex_index> three = {control, free, other};
  check_refused([&] { return d.translate(three, t); });
  check_refused([&] { return d.set_target_weight(three, 1); });
  CHECK(d.target_position(control) == target + Kernel::Vector_3(0, 0, 1));
  CHECK(d.target_weight(control) == 1);
  CHECK(d.target_position(other) == last && std::isinf(d.target_weight(other)));
}

#endif // CGAL_ARAP_DEFORMATION_TEST_MISUSE_H
