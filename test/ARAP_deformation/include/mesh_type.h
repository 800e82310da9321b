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

template <typename Mesh_>
void test_mesh_type(const std::string& name, double tolerance = 1e-10)
{
  test_case() = name;
  static_assert(std::is_same_v<typename CGAL::ARAP_deformation<Mesh_>::Deformation_domain,
                               CGAL::ARAP::Face_graph_domain<Mesh_>>);
  for(const Shape& shape : shapes())
  {
    const Scenario s = scenario(shape);
    for(Cell_scheme cells : all_cell_schemes)
    {
      Mesh_ mesh = make_mesh<Mesh_>(shape);
      const CGAL::ARAP::Face_graph_domain<Mesh_> domain(mesh);
      if(cells == all_cell_schemes[0])
        check_conforms(domain);
      compare(reference<2>(shape.points, shape.triangles, s, cells),
              deform(domain, all_vertices(mesh), s, cells), shape.diameter(), tolerance);
    }
  }
}

#endif // CGAL_ARAP_DEFORMATION_TEST_MESH_TYPE_H
