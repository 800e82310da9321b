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

// The other one: both have the templates, and the library what is no template.

#include <CGAL/ARAP_deformation.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <utility>

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

std::pair<CGAL::ARAP::Report, CGAL::ARAP::Report>
bend(Mesh& mesh, const std::map<Mesh::Vertex_index, Point>& targets);

int main()
{
  Mesh mesh;
  CGAL::make_grid(10, 10, mesh);
  std::map<Mesh::Vertex_index, Point> targets;
  for(int k = 0; k < 11; ++k)
    targets[Mesh::Vertex_index(k)] = mesh.point(Mesh::Vertex_index(k));
  targets[Mesh::Vertex_index(120)] = Point(10, 8, 3);
  const auto [bent, bent_by_other] = bend(mesh, targets);

  CGAL::ARAP_deformation deformation(mesh);
  deformation.insert_roi_vertices(vertices(mesh));
  deformation.insert_control_vertex(Mesh::Vertex_index(0));
  const CGAL::ARAP::Report same = deformation.deform();
  std::cout << bent.message << ", " << bent_by_other.message << ", " << same.message << std::endl;
  const double energy = bent.final_energy();
  const bool is_well = bent && bent_by_other && energy > 0 &&
                       std::abs(bent_by_other.final_energy() - energy) < 1e-9 * energy && same &&
                       same.iterations == 0;
  return is_well ? EXIT_SUCCESS : EXIT_FAILURE;
}
