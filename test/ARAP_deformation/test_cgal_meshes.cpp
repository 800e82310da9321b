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

// Meshes of CGAL's data folder: energies fall, edges keep their lengths, and twice the run gives
// twice the same. Says so when the folder is not there.

#include "include/check.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/checks.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;

// the lowest tenth of the vertices is fixed, the highest is lifted by a tenth of the height
CGAL::ARAP::Report deform(Mesh& mesh, CGAL::ARAP::Cell_scheme cells)
{
  std::vector<Vertex> order(mesh.vertices().begin(), mesh.vertices().end());
  std::stable_sort(order.begin(), order.end(), [&](Vertex a, Vertex b) {
    return mesh.point(a).y() < mesh.point(b).y();
  });
  const std::size_t tenth = order.size() / 10 + 1;
  const double height = mesh.point(order.back()).y() - mesh.point(order.front()).y();
  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  CGAL::ARAP::Options options;
  options.cells = cells;
  deformation.set_options(options);
  deformation.insert_roi_vertices(order.begin() + tenth, order.end());
  for(auto v = order.end() - tenth; v != order.end(); ++v)
  {
    deformation.insert_control_vertex(*v);
    deformation.translate(*v, Kernel::Vector_3(0, height / 10, 0));
  }
  return deformation.deform(10, 0);
}

int main()
{
  std::size_t found = 0;
  for(const std::string name : {"armadillo", "camel", "dino", "elephant", "femur", "hand"})
  {
    const std::string file = CGAL::data_file_path("meshes/" + name + ".off");
    Mesh rest;
    if(!std::filesystem::exists(file) || !CGAL::IO::read_polygon_mesh(file, rest))
      continue;
    ++found;
    test_case() = name;
    using CGAL::ARAP::Cell_scheme;
    for(auto cells : {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims()})
    {
      Mesh first = rest, second = rest;
      const auto report = deform(first, cells), again = deform(second, cells);
      if(!CHECK(report))
      {
        std::cerr << "    " << report.message << std::endl;
        continue;
      }
      CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
      CHECK(report.energy.back() < 0.5 * report.energy.front());
      CHECK_AT_MOST(CGAL::ARAP::relative_edge_length_error(first, rest.points(), first.points()),
                    0.2);
      CHECK(report.energy == again.energy);
      CHECK(std::equal(first.points().begin(), first.points().end(), second.points().begin()));
    }
  }
  if(found == 0)
  {
    std::cout << "NOTICE: CGAL's data meshes are missing; nothing was tested on them. script/setup "
                 "gets them, CGAL_DATA_DIR tells where they are." << std::endl;
    return EXIT_SUCCESS;
  }
  return checks_result();
}
