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

// What holds for every shape, cell scheme and minimizer, over a thousand iterations: the energy
// never rises, rotations are rotations, fixed vertices keep their points, and rigid motions change
// nothing.

#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using Deformation = CGAL::ARAP_deformation<Mesh>;
using CGAL::ARAP::Cell_scheme;
using CGAL::ARAP::Minimizer;

const Eigen::Isometry3d motion = rigid_motion(1.1, {-1, 0.4, 2}, {3, -1, 0.5});

double largest_distance(const Mesh& a, const Mesh& b, const Eigen::Isometry3d& m)
{
  double distance = 0;
  for(auto v : a.vertices())
    distance = larger(distance, (m * vector(a.point(v)) - vector(b.point(v))).norm());
  return distance;
}

void set_options(Deformation& deformation, Cell_scheme cells, Minimizer minimizer)
{
  CGAL::ARAP::Options options;
  options.cells = cells;
  options.minimizer = minimizer;
  CHECK(deformation.set_options(options));
}

void check_run(const Shape& shape, Cell_scheme cells, Minimizer minimizer)
{
  const Scenario s = scenario(shape);
  const Mesh rest = make_mesh<Mesh>(shape);
  Mesh mesh = rest;
  Deformation deformation(mesh);
  set_options(deformation, cells, minimizer);
  prepare(deformation, s, all_vertices(mesh));
  const auto report = deformation.deform(1000, 0);
  CHECK(report.iterations == 1000);
  CHECK(report.energy.size() == 1001);
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
  CHECK(report.energy.back() < report.energy.front());
  CHECK(report.energy.back() >= 0);
  CHECK(report.energy.back() == deformation.energy());
  for(auto v : mesh.vertices())
  {
    if(s.selection[v] == 0)
      CHECK(mesh.point(v) == rest.point(v));
    else if(s.selection[v] == 2)
      CHECK(mesh.point(v) == point(s.targets[v]));
    if(cells.has_vertex_cells())
      CHECK(CGAL::ARAP::is_rotation(deformation.rotation(v)));
  }
  if(!cells.has_vertex_cells())
    for(auto f : mesh.faces())
      CHECK(CGAL::ARAP::is_rotation(deformation.simplex_rotation(f)));
}

// The same run after a rigid motion of rest shape and targets: the same energies, the moved result.
// The memory of the quasi-Newton method is in single precision.
void check_moved_run(const Shape& shape, Cell_scheme cells, Minimizer minimizer)
{
  const Scenario s = scenario(shape);
  Shape moved_shape = shape;
  Scenario moved = s;
  for(auto& p : moved_shape.points)
    p = motion * p;
  for(auto& p : moved.targets)
    p = motion * p;

  Mesh mesh = make_mesh<Mesh>(shape), moved_mesh = make_mesh<Mesh>(moved_shape);
  Deformation deformation(mesh), moved_deformation(moved_mesh);
  set_options(deformation, cells, minimizer);
  set_options(moved_deformation, cells, minimizer);
  prepare(deformation, s, all_vertices(mesh));
  prepare(moved_deformation, moved, all_vertices(moved_mesh));
  const auto report = deformation.deform(10, 0), moved_report = moved_deformation.deform(10, 0);
  const double accuracy = minimizer == Minimizer::local_global ? 1e-10 : 1e-4;
  for(std::size_t k = 0; k < report.energy.size(); ++k)
    CHECK_AT_MOST(std::abs(report.energy[k] - moved_report.energy[k]),
                  accuracy * report.energy[k] + 1e-14 * report.energy_scale);
  CHECK_AT_MOST(largest_distance(mesh, moved_mesh, motion), accuracy * shape.diameter());
}

// A rigidly moved guess whose fixed vertices agree with it stays where it is, at energy zero.
void check_rigid_guess(const Shape& shape, Cell_scheme cells, Minimizer minimizer)
{
  const Scenario s = scenario(shape);
  const Mesh rest = make_mesh<Mesh>(shape);
  Mesh mesh = rest;
  Deformation deformation(mesh);
  set_options(deformation, cells, minimizer);
  const auto vertices = all_vertices(mesh);
  deformation.insert_control_vertices(vertices.begin(), vertices.end());
  for(auto v : vertices)
    deformation.set_target_position(v, point(motion * vector(rest.point(v))));
  CHECK(deformation.deform());
  CHECK(largest_distance(rest, mesh, motion) == 0);

  for(auto v : vertices)
    if(s.selection[v] == 1)
      deformation.erase_control_vertex(v);
  const auto report = deformation.deform(1000, 0);
  for(double energy : report.energy)
    CHECK_AT_MOST(energy, 1e-15 * report.energy_scale);
  CHECK(deformation.deform(1000, 1e-2).iterations <= 1); // at its minimum, and it knows

  // the rotations are that of the motion, in each cell of the region; a rank-one cell has others
  std::size_t number_of_cells = 0, number_of_turned_cells = 0;
  const auto count = [&](const CGAL::ARAP::Matrix_3x3& r) {
    ++number_of_cells;
    double distance = 0;
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j < 3; ++j)
        distance = larger(distance, std::abs(r[3 * i + j] - motion.linear()(i, j)));
    number_of_turned_cells += distance < 1e-7;
  };
  if(cells.has_vertex_cells())
  {
    for(auto v : vertices)
      if(s.selection[v] == 1)
        count(deformation.rotation(v));
  }
  else
    for(auto f : mesh.faces())
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        if(s.selection[v] == 1)
        {
          count(deformation.simplex_rotation(f));
          break;
        }
  CHECK(number_of_cells > 0 && number_of_turned_cells == number_of_cells);
  CHECK_AT_MOST(largest_distance(rest, mesh, motion), 1e-12 * shape.diameter());
}

int main()
{
  CHECK(shapes().size() == 12);
  for(const Shape& shape : shapes())
    for(Cell_scheme cells :
        {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims(), Cell_scheme::elements()})
      for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
      {
        test_case() = shape.name + (cells == Cell_scheme::spokes() ? ", spokes" :
                                    cells.has_vertex_cells() ? ", spokes and rims" : ", elements") +
                      (minimizer == Minimizer::local_global ? ", local/global" : ", quasi-Newton");
        check_run(shape, cells, minimizer);
        check_moved_run(shape, cells, minimizer);
        check_rigid_guess(shape, cells, minimizer);
      }
  return checks_result();
}
