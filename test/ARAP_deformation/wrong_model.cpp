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

// Wrong models do not compile. WRONG_MODEL is the number of the one that is tried; that of none, 0,
// compiles. The sentences that must come first are in CMakeLists.txt.

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Embedding.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/arap_deform.h>
#include <CGAL/Deformation_Eigen_polar_closest_rotation_traits_3.h>
#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Triangulation_3.h>

#include <Eigen/SparseCholesky>

#include <array>
#include <cstddef>
#include <map>
#include <vector>

using namespace CGAL::ARAP;

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

struct Solver
{
  bool analyze(const Sparse_matrix&) { return false; }
  bool factorize(const Sparse_matrix&) { return false; }
  bool solve(std::size_t, Coordinates*) { return false; }
};

struct Solver_without_solve
{
  bool analyze(const Sparse_matrix&) { return false; }
  bool factorize(const Sparse_matrix&) { return false; }
  bool solve(std::size_t, double*) { return false; }
};

struct Solver_without_copies : Solver
{
  Solver_without_copies() = default;
  Solver_without_copies(Solver_without_copies&&) = default;
  Solver_without_copies& operator=(Solver_without_copies&&) = default;
};

struct Rotation_that_changes
{
  void operator()(std::size_t, const Matrix_3x3*, Matrix_3x3*) {}
};

// as the concept was before it had the indices of the vertices
struct Weight_without_indices
{
  std::array<double, 3> simplex_weights(const std::array<Coordinates, 3>&) const { return {}; }
  double edge_weight(Edge_set, double sum) const { return sum; }
};

struct Weight_without_triangles
{
  double edge_weight(Edge_set, std::size_t, std::size_t, double sum) const { return sum; }
};

struct Traits_without_rotation
{
  using Sparse_solver = Multifrontal_cholesky_solver;
  using Edge_weight = Uniform_weight;
  Sparse_solver sparse_solver_object() const { return {}; }
  Edge_weight edge_weight_object() const { return {}; }
};

struct Traits_with_a_wrong_solver
{
  using Sparse_solver = Solver_without_solve;
  using Edge_weight = Uniform_weight;
  using Closest_rotation = Newton_closest_rotation;
  Sparse_solver sparse_solver_object() const { return {}; }
  Edge_weight edge_weight_object() const { return {}; }
  Closest_rotation closest_rotation_object() const { return {}; }
};

struct Domain_without_points : Face_graph_domain<Mesh>
{
  using Face_graph_domain<Mesh>::Face_graph_domain;
  void set_point(vertex_descriptor) const {}
};

// not a domain that works, but one with the interface of one for tetrahedra
struct Domain_of_tetrahedra : Face_graph_domain<Mesh>
{
  using Face_graph_domain<Mesh>::Face_graph_domain;
  static constexpr int dimension = 3;
};

struct Weight_of_triangles : Weight_without_triangles
{
  std::array<double, 3> simplex_weights(const std::array<Coordinates, 3>&) const { return {}; }
};

template <typename Traits, typename Domain = CGAL::Default>
void deform()
{
  Mesh mesh;
  CGAL::ARAP_deformation<Mesh, Traits, Domain> deformation(mesh);
  static_cast<void>(deformation.deform());
}

int main()
{
  using CGAL::ARAP_deformation_traits;
  using CGAL::Default;
#if WRONG_MODEL == 0
  deform<ARAP_deformation_traits<Solver, Weight_of_triangles>>();
#elif WRONG_MODEL == 1
  deform<ARAP_deformation_traits<Solver_without_solve>>();
#elif WRONG_MODEL == 2
  deform<ARAP_deformation_traits<Solver_without_copies>>();
#elif WRONG_MODEL == 3
  deform<ARAP_deformation_traits<Default, Default, Rotation_that_changes>>();
#elif WRONG_MODEL == 4
  deform<ARAP_deformation_traits<Default, Weight_without_indices>>();
#elif WRONG_MODEL == 5
  deform<ARAP_deformation_traits<Default, Weight_without_triangles>>();
#elif WRONG_MODEL == 6
  deform<Traits_without_rotation>();
#elif WRONG_MODEL == 7
  deform<Traits_with_a_wrong_solver>();
#elif WRONG_MODEL == 8
  Mesh mesh;
  const CGAL::Constant_property_map<Mesh::Vertex_index, bool> none(false);
  static_cast<void>(CGAL::arap_deform(
    mesh, none, mesh.points(), CGAL::parameters::weight_calculator(Weight_without_indices())));
#elif WRONG_MODEL == 9
  deform<Default, Domain_without_points>();
#elif WRONG_MODEL == 10
  deform<ARAP_deformation_traits<Default, Weight_of_triangles>, Domain_of_tetrahedra>();
#elif WRONG_MODEL == 11
  std::vector<std::array<double, 3>> points;
  CGAL::ARAP_deformation<decltype(points)> deformation(points);
#elif WRONG_MODEL == 12
  const Mesh mesh;
  CGAL::ARAP_deformation<const Mesh> deformation(mesh);
#elif WRONG_MODEL == 13
  const Mesh mesh;
  const CGAL::Constant_property_map<Mesh::Vertex_index, bool> none(false);
  static_cast<void>(CGAL::arap_deform(mesh, none, mesh.points()));
#elif WRONG_MODEL == 14
  Mesh mesh;
  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  static_cast<void>(deformation.deform(10));
#elif WRONG_MODEL == 15
  CGAL::Triangulation_3<CGAL::Simple_cartesian<double>> triangulation;
  CGAL::ARAP_deformation<decltype(triangulation)> deformation(triangulation);
#elif WRONG_MODEL == 16
  using CGAL_solver = CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<Sparse_matrix>>;
  deform<ARAP_deformation_traits<CGAL_solver>>();
#elif WRONG_MODEL == 17
  deform<ARAP_deformation_traits<Eigen::SimplicialLDLT<Sparse_matrix>>>();
#elif WRONG_MODEL == 18
  using CGAL_rotation = CGAL::Deformation_Eigen_polar_closest_rotation_traits_3;
  deform<ARAP_deformation_traits<Default, Default, CGAL_rotation>>();
#elif WRONG_MODEL == 19
  std::vector<std::array<double, 1>> points;
  const std::vector<std::array<int, 3>> triangles;
  auto domain = make_polygon_soup_domain(points, triangles);
  CGAL::ARAP_deformation<decltype(domain)> deformation(domain);
  static_cast<void>(deformation.deform());
#elif WRONG_MODEL == 20
  std::vector<std::array<double, 2>> points;
  const std::vector<std::array<int, 4>> tetrahedra;
  auto domain = make_tetrahedron_soup_domain(points, tetrahedra);
  CGAL::ARAP_deformation<decltype(domain)> deformation(domain);
  static_cast<void>(deformation.deform());
#elif WRONG_MODEL == 21
  Mesh mesh;
  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  static_cast<void>(deformation.deform([](const auto&) {}));
#elif WRONG_MODEL == 22
  struct Quaternion { double w, x, y, z; };
  Mesh mesh;
  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  deformation.rotate(Mesh::Vertex_index(0), CGAL::Simple_cartesian<double>::Vector_3(),
                     Quaternion());
#elif WRONG_MODEL == 23
  Mesh mesh;
  const CGAL::Constant_property_map<Mesh::Vertex_index, bool> none(false);
  const CGAL::Constant_property_map<Mesh::Vertex_index, int> zeros(0);
  static_cast<void>(CGAL::arap_deform(mesh, none, zeros));
#elif WRONG_MODEL == 24
  Mesh mesh;
  return bool(CGAL::arap_deform(mesh, std::vector<std::array<double, 3>>()));
#elif WRONG_MODEL == 25
  Mesh mesh;
  CGAL::ARAP_deformation deformation(mesh, CGAL::parameters::visitor(Default_visitor()));
#elif WRONG_MODEL == 26
  Mesh mesh;
  CGAL::ARAP_deformation deformation(mesh, CGAL::parameters::target_weight(1));
#elif WRONG_MODEL == 27
  Mesh mesh;
  const std::map<Mesh::Vertex_index, Mesh::Point> targets;
  const std::vector<Mesh::Vertex_index> fixed;
  return bool(CGAL::arap_deform(mesh, targets,
                                CGAL::parameters::vertex_is_constrained_map(fixed)));
#elif WRONG_MODEL == 28
  Mesh mesh;
  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  deformation.set_target_position(Mesh::Face_index(0), Mesh::Point());
#elif WRONG_MODEL == 29
  Mesh mesh;
  const std::map<Mesh::Vertex_index, Mesh::Point> targets;
  return bool(CGAL::arap_deform(mesh, targets, Options(),
                                CGAL::parameters::deformation_options(Options())));
#elif WRONG_MODEL == 30
  Mesh mesh;
  Locator locator(mesh);
#elif WRONG_MODEL == 31
  Mesh mesh;
  const std::map<Mesh::Vertex_index, Matrix_3x3> rotations;
  CGAL::ARAP_deformation deformation(mesh, CGAL::parameters::target_rotations(rotations));
#elif WRONG_MODEL == 32
  Mesh mesh;
  Embedding embedding(mesh, mesh.points());
#elif WRONG_MODEL == 33
  Mesh mesh;
  CGAL::ARAP_deformation deformation(mesh);
  return bool(deformation.set_target_rotation(Mesh::Vertex_index(0), Eigen::Rotation2Dd(1)));
#elif WRONG_MODEL == 34
  std::vector<Mesh::Point> points, others;
  const std::vector<std::array<int, 3>> triangles;
  const std::map<std::size_t, Mesh::Point> targets;
  auto domain = make_polygon_soup_domain(points, triangles);
  return bool(CGAL::arap_deform(
    domain, targets, CGAL::parameters::output_point_map(CGAL::make_property_map(others))));
#else
#error "there is no wrong model of that number"
#endif
}
