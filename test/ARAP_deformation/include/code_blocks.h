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

#ifndef CGAL_ARAP_DEFORMATION_TEST_CODE_BLOCKS_H
#define CGAL_ARAP_DEFORMATION_TEST_CODE_BLOCKS_H

// What the fragments of code in the manual and the README use without declaring it.

#include "compiled_sessions.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/Triangulation_domain.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/arap_deform.h>

#include <Eigen/Dense>

#include <array>
#include <cstddef>
#include <iostream>
#include <map>
#include <string>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point>;
using vertex_descriptor = Mesh::Vertex_index;
using Tr = CGAL::Mesh_triangulation_3<
  CGAL::Labeled_mesh_domain_3<CGAL::Exact_predicates_inexact_constructions_kernel>>::type;
using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<Tr>;

Mesh mesh, surface;
C3t3 c3t3;
C3t3::Vertex_handle vertex_handle;
CGAL::ARAP_deformation<Mesh> deformation(mesh);
vertex_descriptor v;
std::vector<vertex_descriptor> roi, region, handle;
Point target, other_target, picked;
Kernel::Plane_3 plane;
std::vector<Kernel::Aff_transformation_3> poses;
double tolerance = 0.1;
std::map<vertex_descriptor, Point> targets;
bool is_fixed(vertex_descriptor) { return false; }
bool is_cancelled() { return false; }
std::map<vertex_descriptor, bool> is_bone;
Mesh::Property_map<vertex_descriptor, Point> preview_map, rest_points;

#endif // CGAL_ARAP_DEFORMATION_TEST_CODE_BLOCKS_H
