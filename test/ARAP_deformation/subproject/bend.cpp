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

// A translation unit of its own, of a program that links with the library.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/arap_deform.h>

#include <map>

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

CGAL::ARAP::Report bend(Mesh& mesh, const std::map<Mesh::Vertex_index, Point>& targets)
{
  return CGAL::arap_deform(mesh, targets);
}
