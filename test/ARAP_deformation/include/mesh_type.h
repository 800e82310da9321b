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

#ifndef CGAL_ARAP_DEFORMATION_TEST_MESH_TYPE_H
#define CGAL_ARAP_DEFORMATION_TEST_MESH_TYPE_H

// Meshes of a type are deformed as ranges of points and triangles are.

#include "check.h"
#include "domains.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>

#include <string>
#include <type_traits>

// What a function makes of each shape, with each cell scheme, is what becomes of ranges.
template <typename Deformed>
void compare_all(const std::string& name, const Deformed& deformed, double tolerance = 1e-10)
{
  for(const Shape& shape : shapes())
  {
    test_case() = name + ", " + shape.name;
    const Scenario s = scenario(shape);
    for(Cell_scheme cells : all_cell_schemes)
      compare(reference<2>(shape.points, shape.triangles, s, cells), deformed(shape, s, cells),
              shape.diameter(), tolerance);
  }
}

template <typename Mesh_>
void test_mesh_type(const std::string& name, double tolerance = 1e-10)
{
  static_assert(std::is_same_v<typename CGAL::ARAP_deformation<Mesh_>::Deformation_domain,
                               CGAL::ARAP::Face_graph_domain<Mesh_>>);
  compare_all(name, [](const Shape& shape, const Scenario& s, Cell_scheme cells) {
    Mesh_ mesh = make_mesh<Mesh_>(shape);
    const CGAL::ARAP::Face_graph_domain<Mesh_> domain(mesh);
    if(cells == all_cell_schemes[0])
      check_conforms(domain);
    return deform(domain, all_vertices(mesh), s, cells);
  }, tolerance);
}

#endif // CGAL_ARAP_DEFORMATION_TEST_MESH_TYPE_H
