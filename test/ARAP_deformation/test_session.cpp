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

// The session: region of interest, control vertices, targets, reset and rest shape.

#include "include/check.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>

#include <Eigen/Geometry>

#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

using Deformation = CGAL::ARAP_deformation<Mesh>;
using Vertex = Mesh::Vertex_index;
using CGAL::ARAP::Status;

static_assert(!std::is_copy_constructible<Deformation>::value, "two objects would share a mesh");
static_assert(std::is_move_constructible<Deformation>::value, "");

Shape sheet()
{
  return grid("sheet", 20, 10, [](double u, double v) { return Eigen::Vector3d(2 * u, v, 0); });
}

// the vertices with x in [low, high]
std::vector<Vertex> strip(const Mesh& mesh, double low, double high)
{
  std::vector<Vertex> found;
  for(Vertex v : mesh.vertices())
    if(low <= mesh.point(v).x() && mesh.point(v).x() <= high)
      found.push_back(v);
  return found;
}

void test_sets()
{
  test_case() = "sets";
  Mesh mesh = make_mesh<Mesh>(sheet());
  Deformation d(mesh);
  const Vertex a(3), b(4), c(5);
  CHECK(d.roi_vertices().empty() && d.control_vertices().empty());
  CHECK(d.insert_roi_vertex(a));
  CHECK(!d.insert_roi_vertex(a));
  CHECK(d.insert_control_vertex(a));
  CHECK(!d.insert_control_vertex(a));
  CHECK(d.insert_control_vertex(b)); // goes into the region as well
  CHECK(d.is_roi_vertex(b) && d.is_control_vertex(b));
  CHECK(!d.is_roi_vertex(c) && !d.is_control_vertex(c));
  CHECK(!d.erase_roi_vertex(c) && !d.erase_control_vertex(c));
  CHECK((d.roi_vertices() == std::vector<Vertex>{a, b}));
  CHECK(d.erase_control_vertex(a));
  CHECK(!d.erase_control_vertex(a));
  CHECK(d.is_roi_vertex(a) && !d.is_control_vertex(a));
  CHECK((d.control_vertices() == std::vector<Vertex>{b}));
  CHECK(d.erase_roi_vertex(b)); // is no control vertex any more either
  CHECK(!d.is_roi_vertex(b) && !d.is_control_vertex(b));
  d.insert_control_vertices(mesh.vertices().begin(), mesh.vertices().end());
  CHECK(d.control_vertices().size() == mesh.number_of_vertices());
  d.clear_control_vertices();
  CHECK(d.control_vertices().empty() && d.roi_vertices().size() == mesh.number_of_vertices());
  d.clear_roi_vertices();
  CHECK(d.roi_vertices().empty());
  d.insert_roi_vertices(mesh.vertices().begin(), mesh.vertices().end());
  CHECK(d.roi_vertices().size() == mesh.number_of_vertices());
}

void test_targets()
{
  test_case() = "targets";
  Mesh mesh = make_mesh<Mesh>(sheet());
  Deformation d(mesh);
  const Vertex v(17), w(18);
  const Point p = mesh.point(v), q = mesh.point(w);
  d.insert_control_vertex(v);
  d.insert_control_vertex(w);
  CHECK(d.target_position(v) == p);
  CHECK(d.set_target_position(v, Point(1, 2, 3)));
  CHECK(d.target_position(v) == Point(1, 2, 3));
  CHECK(d.translate(v, Kernel::Vector_3(1, 0, -1)));
  CHECK(d.translate(v, Eigen::Vector3d(0, 1, 0))); // moves the target there is
  CHECK(d.target_position(v) == Point(2, 3, 2));
  const Eigen::Quaterniond quarter(Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ()));
  CHECK(d.rotate(v, Eigen::Vector3d(2, 0, 0), quarter));
  CHECK((vector(d.target_position(v)) - Eigen::Vector3d(-1, 0, 2)).norm() < 1e-15);
  CHECK(mesh.point(v) == p); // until deform() is called
  const std::vector<Vertex> both = {v, w};
  d.set_target_position(v, p);
  CHECK(d.translate(both.begin(), both.end(), Eigen::Vector3d(0, 0, 1)));
  CHECK(d.rotate(both.begin(), both.end(), Eigen::Vector3d(0, 0, 1), quarter));
  CHECK((vector(d.target_position(v)) - Eigen::Vector3d(-p.y(), p.x(), 1)).norm() < 1e-14);
  CHECK((vector(d.target_position(w)) - Eigen::Vector3d(-q.y(), q.x(), 1)).norm() < 1e-14);
  d.erase_control_vertex(v);
  d.insert_control_vertex(v);
  CHECK(d.target_position(v) == p); // where it is, not where it was to go

  // a control vertex gets the very Point it was given, and lone ones move too
  const Point exact(1.0 / 3, 0.1, 1e-17);
  d.set_target_position(v, exact);
  CHECK(d.deform());
  CHECK(mesh.point(v) == exact);
}

void test_region()
{
  test_case() = "region";
  const Mesh rest = make_mesh<Mesh>(sheet());
  Mesh mesh = rest;
  Deformation d(mesh);
  const auto middle = strip(rest, 0.5, 1.5), handle = strip(rest, 0.95, 1.05);
  d.insert_roi_vertices(middle.begin(), middle.end());
  d.insert_control_vertices(handle.begin(), handle.end());
  d.translate(handle.begin(), handle.end(), Eigen::Vector3d(0, 0, 0.3));
  const auto report = d.deform();
  CHECK(report);
  CHECK(report.free_vertices == middle.size() - handle.size());
  for(Vertex v : mesh.vertices())
    CHECK((mesh.point(v) == rest.point(v)) == !d.is_roi_vertex(v));
  for(Vertex v : handle)
    CHECK(mesh.point(v) == rest.point(v) + Kernel::Vector_3(0, 0, 0.3));

  // another region: what was moved stays, and counts as fixed; the rest shape is still the first
  const Mesh deformed = mesh;
  d.clear_roi_vertices();
  const auto edge = strip(rest, 1.6, 2), tip = strip(rest, 1.9, 2);
  d.insert_roi_vertices(edge.begin(), edge.end());
  d.insert_control_vertices(tip.begin(), tip.end());
  d.translate(tip.begin(), tip.end(), Eigen::Vector3d(0, 0, 0.2));
  CHECK(d.deform());
  for(Vertex v : mesh.vertices())
    CHECK((mesh.point(v) == deformed.point(v)) == !d.is_roi_vertex(v));

  d.reset(); // everything that was ever moved
  CHECK(same_points(mesh, rest));
  CHECK(d.target_position(tip[0]) == rest.point(tip[0]));
  CHECK(std::isnan(d.energy()));
  const auto quiet = d.deform(3, 0); // nothing to do: nothing moves beyond rounding
  CHECK(quiet.energy[0] == 0);
  for(Vertex v : mesh.vertices())
    CHECK((vector(mesh.point(v)) - vector(rest.point(v))).norm() < 1e-14);
}

void test_rest_shape()
{
  test_case() = "rest shape";
  const Shape shape = sheet();
  const Scenario s = scenario(shape);
  Mesh mesh = make_mesh<Mesh>(shape);
  Deformation d(mesh);
  prepare(d, s, all_vertices(mesh));
  CHECK(std::isnan(d.energy()));
  CHECK(d.deform(20, 0));
  CHECK(d.energy() > 0);
  const Mesh deformed = mesh;
  d.overwrite_initial_geometry();
  CHECK(std::isnan(d.energy()));
  const auto report = d.deform(3, 0); // the deformed shape is at rest now
  CHECK(report.energy[0] <= 1e-28);
  for(Vertex v : mesh.vertices())
    CHECK((vector(mesh.point(v)) - vector(deformed.point(v))).norm() < 1e-13);
  d.translate(d.control_vertices()[0], Eigen::Vector3d(0.1, 0, 0));
  CHECK(d.deform());
  CHECK(!same_points(mesh, deformed));
  d.reset();
  CHECK(same_points(mesh, deformed));

  // the same as a new object on the deformed mesh
  Mesh other = deformed;
  Deformation fresh(other);
  prepare(fresh, s, all_vertices(other));
  for(Deformation* session : {&d, &fresh})
  {
    for(Vertex v : session->control_vertices())
      session->set_target_position(v, point(vector(deformed.point(v)) + Eigen::Vector3d(0, 0, 1)));
    CHECK(session->deform(5, 0));
  }
  CHECK(same_points(mesh, other));
}

// Interaction: each frame starts from the last, and preprocesses only when the sets have changed.
void test_frames()
{
  test_case() = "frames";
  const Shape shape = sheet();
  const Scenario s = scenario(shape, 0);
  Mesh mesh = make_mesh<Mesh>(shape);
  Deformation d(mesh);
  prepare(d, s, all_vertices(mesh));
  CHECK(d.preprocess());
  for(int frame = 0; frame < 10; ++frame)
  {
    for(Vertex v : d.control_vertices())
      d.translate(v, Eigen::Vector3d(0, 0, 0.02));
    const auto report = d.deform(3, 0);
    CHECK(report.iterations == 3);
    CHECK(report.seconds.preprocess < report.seconds.total);
    CHECK(report.energy.back() <= report.energy.front());
    CHECK(report.energy.back() == d.energy());
  }
  // started where it ended: the energy goes on from there, with rotations fitted once more
  const double before = d.energy();
  CHECK_AT_MOST(std::abs(d.deform(1, 0).energy[0] - before), 1e-14 * before);

  // moved elsewhere, the object goes on as well
  Deformation moved(std::move(d));
  CHECK(moved.deform(1, 0).energy.back() <= before);
}

void test_options()
{
  test_case() = "options";
  const Shape shape = sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  Deformation d(mesh);
  prepare(d, scenario(shape), all_vertices(mesh));
  CGAL::ARAP::Options options;
  options.iterations = 1000;
  options.tolerance = 1e-2;
  CHECK(d.set_options(options));
  const auto report = d.deform();
  CHECK(report.status == Status::converged);
  CHECK(report.iterations < 1000);
  CHECK(report.estimated_relative_gap <= 1e-2);

  // what the estimate is worth: the minimum is what two thousand more iterations reach
  const double minimum = d.deform(2000, 0).energy.back();
  CHECK_AT_MOST((report.energy.back() - minimum) / minimum, report.estimated_relative_gap);

  options.tolerance = -1;
  const auto refused = d.set_options(options);
  CHECK(refused.status == Status::invalid_option);
  CHECK(refused.message.find("tolerance") != std::string::npos);
  CHECK(d.options().tolerance == 1e-2);
  const Mesh before = mesh;
  CHECK(d.deform(10, std::nan("")).status == Status::invalid_option);
  CHECK(same_points(mesh, before));

  // other cells, from the same positions: another energy
  const double energy = d.energy();
  options.tolerance = 0;
  options.iterations = 2;
  options.cells = CGAL::ARAP::Cell_scheme::spokes();
  CHECK(d.set_options(options));
  CHECK(std::isnan(d.energy()));
  const auto spokes = d.deform();
  CHECK(spokes.iterations == 2);
  CHECK(std::abs(spokes.energy[0] - energy) > 0.1 * energy);

  const CGAL::ARAP::Options defaults;
  CHECK(defaults.cells == CGAL::ARAP::Cell_scheme::spokes_and_rims());
  CHECK(defaults.initial_guess == CGAL::ARAP::Initial_guess::previous);
  CHECK(defaults.minimizer == CGAL::ARAP::Minimizer::automatic);
  CHECK(defaults.iterations == 1000 && defaults.tolerance == 1e-3);
}

// However small a motion is, the run goes on until the gap is as small as was asked for.
void test_small_motions()
{
  test_case() = "small motions";
  const Shape shape = grid("sheet", 20, 20, [](double u, double v) {
    return Eigen::Vector3d(20 * u, 20 * v, std::sin(9 * u) * std::cos(7 * v));
  });
  for(double height : {1.0, 1e-3, 1e-6, 1e-9})
  {
    Mesh mesh = make_mesh<Mesh>(shape);
    Deformation d(mesh);
    for(Vertex v : mesh.vertices())
      if(!mesh.is_border(v))
        d.insert_roi_vertex(v);
    const Vertex handle(10 * 21 + 10);
    d.insert_control_vertex(handle);
    d.translate(handle, Eigen::Vector3d(0, 0, height));
    const auto report = d.deform(5000, 1e-2);
    CHECK(report.status == Status::converged);
    const double minimum = d.deform(5000, 0).energy.back();
    CHECK_AT_MOST(report.energy.back(), 1.1 * minimum);
  }
}

// Fits as the default does, and notes with which rotations it was asked to start.
struct Recording_rotation : CGAL::ARAP::SVD_closest_rotation
{
  static std::vector<CGAL::ARAP::Matrix_3x3> given, returned;

  void operator()(std::size_t n, const CGAL::ARAP::Matrix_3x3* covariances,
                  CGAL::ARAP::Matrix_3x3* rotations) const
  {
    given.assign(rotations, rotations + n);
    CGAL::ARAP::SVD_closest_rotation::operator()(n, covariances, rotations);
    returned.assign(rotations, rotations + n);
  }
};
std::vector<CGAL::ARAP::Matrix_3x3> Recording_rotation::given, Recording_rotation::returned;

// what a program gets that asks for nothing
void test_defaults()
{
  test_case() = "defaults";
  using Traits = CGAL::ARAP_deformation_traits_3<>;
  static_assert(std::is_same_v<Traits::Sparse_solver, CGAL::ARAP::Multifrontal_cholesky_solver>);
  static_assert(std::is_same_v<Traits::Closest_rotation, CGAL::ARAP::Newton_closest_rotation>);
  static_assert(std::is_same_v<Traits::Edge_weight, CGAL::ARAP::Safe_cotangent_weight>);
  const CGAL::ARAP::Options options;
  CHECK(options.threads == 0);
  CHECK(options.minimizer == CGAL::ARAP::Minimizer::automatic);
  CHECK(options.check());
}

// Each fit starts from the rotations of the last one, over iterations and runs.
void test_warm_start()
{
  test_case() = "warm start";
  using Traits =
    CGAL::ARAP_deformation_traits_3<CGAL::Default, CGAL::Default, Recording_rotation>;
  const Shape shape = sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh, Traits> d(mesh);
  prepare(d, scenario(shape), all_vertices(mesh));
  std::vector<CGAL::ARAP::Matrix_3x3> last;
  for(int run = 0; run < 3; ++run)
    CHECK(d.deform(3, 0, [&](const auto& iterate) {
      if(last.empty())
        last.assign(Recording_rotation::given.size(), CGAL::ARAP::internal::identity_matrix());
      CHECK(Recording_rotation::given == last);
      last = Recording_rotation::returned;
      CHECK(run > 0 || iterate.iteration() > 0 || last != Recording_rotation::given);
      return CGAL::ARAP::Visitor_action::proceed;
    }));
}

// The regions of two runs have nothing to do with each other.
void test_change_of_sets()
{
  test_case() = "change of sets";
  const Shape shape = sheet();
  const Mesh rest = make_mesh<Mesh>(shape);
  Mesh mesh = rest;
  Deformation d(mesh);
  prepare(d, scenario(shape), all_vertices(mesh));
  CHECK(d.deform(2, 0).free_vertices > 0);
  d.clear_control_vertices(); // all of the region is free, and stays at rest where it can
  CHECK(d.deform(2, 0).free_vertices == d.roi_vertices().size());
  d.clear_roi_vertices();
  CHECK(d.deform(2, 0).free_vertices == 0);

  // after a reset the rotations are identities, as in the beginning
  Mesh other = rest;
  Deformation e(other);
  prepare(e, scenario(shape), all_vertices(other));
  const Vertex v(100);
  const auto identity = e.rotation(v);
  CHECK(e.deform(2, 0));
  CHECK(e.rotation(v) != identity);
  e.reset();
  CHECK(e.rotation(v) == identity);
  CHECK(same_points(other, rest));
}

int main()
{
  test_sets();
  test_targets();
  test_region();
  test_rest_shape();
  test_frames();
  test_options();
  test_small_motions();
  test_change_of_sets();
  test_defaults();
  test_warm_start();
  return checks_result();
}
