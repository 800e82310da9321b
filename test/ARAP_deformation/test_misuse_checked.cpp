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

// Misuse of the interface where preconditions are checked: they fail.

#define CGAL_DEBUG 1

#include "include/domains.h"
#include "include/misuse.h"

#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>

#include <cstddef>
#include <type_traits>
#include <vector>

int main()
{
  CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {});
  const auto is_refused = [](const auto& call) {
    try
    {
      call();
    }
    catch(const CGAL::Precondition_exception&)
    {
      return true;
    }
    return false;
  };
  test_misuse([&](const auto& call) { CHECK(is_refused(call)); });

  Mesh mesh = make_mesh<Mesh>(octahedron());
  CGAL::ARAP_deformation<Mesh> d(mesh);
  CHECK(is_refused([&] { d.target_position(Mesh::Vertex_index(0)); }));
  // there is one for each vertex
  CHECK(is_refused([&] { d.simplex_rotation(Mesh::Face_index(0)); }));
  CGAL::ARAP::Options options;
  options.cells = CGAL::ARAP::Cell_scheme::elements();
  d.set_options(options);
  CHECK(is_refused([&] { d.rotation(Mesh::Vertex_index(0)); })); // there is one for each face

  // in a run, by a visitor
  d.insert_control_vertex(Mesh::Vertex_index(0));
  d.insert_roi_vertex(Mesh::Vertex_index(1));
  CHECK(is_refused([&] {
    d.deform([&](const auto&) {
      d.clear_roi_vertices();
      return CGAL::ARAP::Visitor_action::proceed;
    });
  }));
  CHECK(d.deform()); // the exception has ended the run

  // a vertex that there is not
  std::vector<Point> points = points_of(octahedron().points);
  const auto faces = octahedron().triangles;
  using Soup = CGAL::ARAP::Polygon_soup_domain<std::vector<Point>, std::decay_t<decltype(faces)>>;
  CGAL::ARAP_deformation<Soup> soup(Soup(points, faces));
  CHECK(is_refused([&] { soup.insert_roi_vertex(points.size()); }));
  CHECK(is_refused([&] { soup.insert_control_vertex(std::size_t(-1)); }));
  CHECK(soup.roi_vertices().empty());
  return checks_result();
}
