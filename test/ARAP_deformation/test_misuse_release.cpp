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

// Misuse of the interface in Release, where preconditions are not checked: refused calls that say
// so.

#define CGAL_NDEBUG 1

#include "include/misuse.h"

int main()
{
  test_misuse([](const auto& call) {
    const CGAL::ARAP::Outcome outcome = call();
    CHECK(outcome.status == CGAL::ARAP::Status::not_a_control_vertex);
    CHECK(outcome.message.find("vertex 5 is not a control vertex") != std::string::npos);
  });

  // what has no status answers with something harmless
  Mesh mesh = make_mesh<Mesh>(octahedron());
  CGAL::ARAP_deformation<Mesh> d(mesh);
  const Mesh::Vertex_index v(3), w(1);
  CHECK(d.target_position(v) == mesh.point(v));
  CHECK(d.target_weight(v) == 0);
  d.insert_control_vertex(w);
  d.insert_roi_vertex(v);
  CHECK(d.target_position(v) == mesh.point(v));
  CHECK(d.target_weight(v) == 0);
  d.set_target_position(w, Point(3, 1, 2));
  const auto identity = CGAL::ARAP::internal::identity_matrix();

  // a visitor that changes the object is refused
  bool was_called = false;
  CHECK(d.deform([&](const auto&) {
    was_called = true;
    CHECK(!d.erase_roi_vertex(v) && !d.insert_control_vertex(v));
    d.clear_roi_vertices();
    d.reset();
    d.overwrite_initial_geometry();
    CHECK(d.set_target_position(w, Point(0, 0, 0)).status == CGAL::ARAP::Status::in_a_run);
    CHECK(d.set_target_weight(w, 1).status == CGAL::ARAP::Status::in_a_run);
    CHECK(d.set_options(CGAL::ARAP::Options()).status == CGAL::ARAP::Status::in_a_run);
    CHECK(d.deform().status == CGAL::ARAP::Status::in_a_run);
    return CGAL::ARAP::Visitor_action::proceed;
  }));
  CHECK(was_called && mesh.point(w) == Point(3, 1, 2));
  CHECK(d.rotation(v) != identity);
  CHECK(d.simplex_rotation(Mesh::Face_index(0)) == identity);
  return checks_result();
}
