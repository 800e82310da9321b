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

// A translation unit of its own, which bends the mesh once with each of two solvers.

#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/arap_deform.h>

#include <Eigen/SparseCholesky>

#include <map>
#include <utility>

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Eigen_solver =
  CGAL::ARAP::Eigen_sparse_solver<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>;

std::pair<CGAL::ARAP::Report, CGAL::ARAP::Report>
bend(Mesh& mesh, const std::map<Mesh::Vertex_index, Point>& targets)
{
  Mesh other = mesh;
  const CGAL::ARAP::Report report = CGAL::arap_deform(
    other, targets, CGAL::parameters::sparse_linear_solver(Eigen_solver()));
  return {CGAL::arap_deform(mesh, targets), report};
}
