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

// The session: region of interest, control vertices, targets, reset and rest shape; the function
// arap_deform(); visitors and reports; bad data, failures and misuse; and that the cost follows the
// region.

#include "include/check.h"
#include "include/domains.h"
#include "include/misuse.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/ARAP_deformation/set_option.h>
#include <CGAL/arap_deform.h>

#include <boost/property_map/property_map.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <locale>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// The session: region of interest, control vertices, targets, reset and rest shape.
namespace session {

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
  CHECK(d.translate(both, Eigen::Vector3d(0, 0, 1)));
  CHECK(d.rotate(both, Eigen::Vector3d(0, 0, 1), quarter));
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
  d.translate(handle, Eigen::Vector3d(0, 0, 0.3));
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
  d.translate(tip, Eigen::Vector3d(0, 0, 0.2));
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
  auto d = prepared(mesh, s);
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
  auto fresh = prepared(other, s);
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
  auto d = prepared(mesh, s);
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
  d = std::move(moved);
  CHECK(d.deform(1, 0).energy.back() <= before);
}

void test_options()
{
  test_case() = "options";
  const Shape shape = sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  auto d = prepared(mesh, scenario(shape));
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
  CHECK(defaults.initial_guess == CGAL::ARAP::Initial_guess::automatic);
  CHECK(defaults.minimizer == CGAL::ARAP::Minimizer::automatic);
  CHECK(defaults.iterations == 1000 && defaults.tolerance == 1e-3 && defaults.threads == 0);
  CHECK(defaults.check());
  using Traits = CGAL::ARAP_deformation_traits<>;
  static_assert(std::is_same_v<Traits::Sparse_solver, CGAL::ARAP::Multifrontal_cholesky_solver>);
  static_assert(std::is_same_v<Traits::Closest_rotation, CGAL::ARAP::Newton_closest_rotation>);
  static_assert(std::is_same_v<Traits::Edge_weight, CGAL::ARAP::Safe_cotangent_weight>);
}

// Options by name: what is set is read again; what is refused changes nothing.
void test_options_by_name()
{
  using CGAL::ARAP::option_value;
  using CGAL::ARAP::set_option;
  test_case() = "options by name";
  CGAL::ARAP::Options options;
  const std::vector<std::pair<std::string, std::vector<std::string>>> valid = {
    {"cells", {"elements", "spokes_and_rims", "k_ring:2", "spokes"}},
    {"minimizer", {"local_global", "quasi_newton", "automatic"}},
    {"initial_guess", {"rotations", "laplacian", "previous", "automatic"}},
    {"iterations", {"0", "4294967295"}}, {"threads", {"3", "0"}}, {"tolerance", {"0", "0.25"}},
    {"verify_minimum", {"false", "true"}}, {"coarse_metric", {"false", "true"}},
    {"bending_length", {"1", "0.5"}}, {"smoothing_length", {"7"}}};
  for(const auto& [name, values] : valid)
    for(const std::string& value : values)
    {
      CHECK(set_option(options, name, value));
      CHECK(option_value(options, name) == value);
    }
  CHECK(options.cells == CGAL::ARAP::Cell_scheme::spokes());
  CHECK(options.tolerance == 0.25 && options.smoothing_length == 7);
  options.tolerance = 0.1 + 0.2; // has seventeen digits
  CHECK(set_option(options, "tolerance", option_value(options, "tolerance")));
  CHECK(options.tolerance == 0.1 + 0.2);
  struct Comma : std::numpunct<char>
  {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale global = std::locale::global(std::locale(std::locale::classic(), new Comma));
  CHECK(option_value(options, "smoothing_length") == "7");
  CHECK(set_option(options, "tolerance", "0.25"));
  CHECK(option_value(options, "tolerance") == "0.25");
  CHECK(!set_option(options, "iterations", "1.000"));
  std::locale::global(global);
  CHECK(option_value(options, "color").empty());

  const CGAL::ARAP::Options before = options;
  const std::vector<std::array<std::string, 3>> invalid = {
    {"cells", "stars", "cells 'stars' is not known; use one of spokes, spokes_and_rims, elements"},
    {"cells", "k_ring:", "cells k_ring '' is not a whole number"},
    {"cells", "k_ring:101", "at most k_ring:100"},
    {"cells", "elements", "bending_length needs cells at vertices"},
    {"minimizer", "", "minimizer '' is not known; use one of automatic, local_global"},
    {"iterations", "-1", "iterations '-1' is not a whole number from 0 to 4294967295"},
    {"threads", "4294967296", "threads '4294967296' is not"}, {"tolerance", "1e-3x", "'1e-3x'"},
    {"verify_minimum", "1", "verify_minimum '1' is not known; use one of true, false"},
    {"tolerance", "nan", "'nan' is not a number"}, {"smoothing_length", "-1", "smoothing_length"},
    {"tolerance", "-1e-9", "the option tolerance must be finite and not negative"},
    {"Cells", "spokes", "the option 'Cells' is not known; use one of cells, minimizer"}};
  for(const auto& [name, value, sentence] : invalid)
  {
    const CGAL::ARAP::Outcome outcome = set_option(options, name, value);
    CHECK(outcome.status == Status::invalid_option);
    CHECK(outcome.message.find(sentence) != std::string::npos);
  }
  for(const auto& option : valid)
    CHECK(option_value(options, option.first) == option_value(before, option.first));

  // several are valid together, whatever their order, or none is set
  using Values = std::vector<std::pair<std::string, std::string>>;
  for(const Values& values : {Values{{"cells", "elements"}, {"bending_length", "0"}},
                              Values{{"bending_length", "0.5"}, {"cells", "spokes"}}})
  {
    CHECK(CGAL::ARAP::set_options(options, values));
    for(const auto& [name, value] : values)
      CHECK(option_value(options, name) == value);
  }
  CHECK(!CGAL::ARAP::set_options(options, Values{{"threads", "2"}, {"cells", "elements"}}));
  CHECK(!CGAL::ARAP::set_options(options, Values{{"threads", "2"}, {"cells", "rims"}}));
  CHECK(option_value(options, "threads") == "0" && option_value(options, "cells") == "spokes");
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

const CGAL::ARAP::Matrix_3x3 identity = {1, 0, 0, 0, 1, 0, 0, 0, 1};

// Fits as the default does, and notes with which rotations it was asked to start.
struct Recording_rotation : CGAL::ARAP::SVD_closest_rotation
{
  static std::vector<CGAL::ARAP::Matrix_3x3> given, returned;

  void operator()(std::size_t n, const CGAL::ARAP::Matrix_3x3* covariances,
                  CGAL::ARAP::Matrix_3x3* rotations) const
  {
    given.insert(given.end(), rotations, rotations + n);
    CGAL::ARAP::SVD_closest_rotation::operator()(n, covariances, rotations);
    returned.insert(returned.end(), rotations, rotations + n);
  }
};
std::vector<CGAL::ARAP::Matrix_3x3> Recording_rotation::given, Recording_rotation::returned;

// Each fit starts from the rotations of the last one, over iterations and runs.
void test_warm_start()
{
  test_case() = "warm start";
  using Traits =
    CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::Default, Recording_rotation>;
  const Shape shape = sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh, Traits> d(mesh);
  CGAL::ARAP::Options options;
  options.initial_guess = CGAL::ARAP::Initial_guess::previous;
  CHECK(d.set_options(options));
  prepare(d, scenario(shape), all_vertices(mesh));
  std::vector<CGAL::ARAP::Matrix_3x3> last;
  for(int run = 0; run < 3; ++run)
    CHECK(d.deform(3, 0, [&](const auto& iterate) {
      if(last.empty())
        last.assign(Recording_rotation::given.size(), identity);
      CHECK(Recording_rotation::given == last);
      last = Recording_rotation::returned;
      CHECK(run > 0 || iterate.iteration() > 0 || last != Recording_rotation::given);
      Recording_rotation::given.clear();
      Recording_rotation::returned.clear();
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
  auto d = prepared(mesh, scenario(shape));
  CHECK(d.deform(2, 0).free_vertices > 0);
  d.clear_control_vertices(); // all of the region is free, and stays at rest where it can
  CHECK(d.deform(2, 0).free_vertices == d.roi_vertices().size());
  d.clear_roi_vertices();
  CHECK(d.deform(2, 0).free_vertices == 0);

  // after a reset the rotations are identities, as in the beginning
  Mesh other = rest;
  auto e = prepared(other, scenario(shape));
  const Vertex v(100);
  CHECK(e.rotation(v) == identity);
  CHECK(e.deform(2, 0));
  CHECK(e.rotation(v) != identity);
  e.reset();
  CHECK(e.rotation(v) == identity);
  CHECK(same_points(other, rest));
}

// What comes between two runs and has no result, or one that is taken back, leaves no trace in the
// rotations, not even in those of cells that did not count in between, or, if nearly all vertices
// are fixed there, were not in its region.
void test_rotations_between_runs(double low, double high)
{
  test_case() = "rotations between runs, fixed from " + std::to_string(low);
  const Shape shape = grid("sheet", 11, 17, [](double u, double v) {
    return Eigen::Vector3d(11 * u, 17 * v, 0);
  });
  std::size_t middle_index = 0;
  while(std::abs(shape.points[middle_index].y() - 8) > 0.1)
    ++middle_index;
  const Vertex middle(static_cast<Mesh::size_type>(middle_index));
  const auto run = [&](const auto& between) {
    Mesh mesh = make_mesh<Mesh>(shape);
    Deformation d(mesh);
    CGAL::ARAP::Options options;
    options.initial_guess = CGAL::ARAP::Initial_guess::previous;
    CHECK(d.set_options(options));
    d.insert_roi_vertices(mesh.vertices());
    std::vector<Vertex> inner;
    for(Vertex v : mesh.vertices())
      if(const double y = mesh.point(v).y(); y < 0.5 || y > 16.5)
      {
        d.insert_control_vertex(v);
        if(y > 16.5)
          d.set_target_position(v, Point(mesh.point(v).x(), 9, 8));
      }
      else if(y > low && y < high)
        inner.push_back(v);
    CHECK(d.deform());
    const CGAL::ARAP::Matrix_3x3 rotation = d.rotation(middle);
    for(Vertex v : inner)
      d.insert_control_vertex(v);
    between(d, inner);
    for(Vertex v : inner)
      d.erase_control_vertex(v);
    options.smoothing_length = 3; // a fit depends on the rotations before
    CHECK(d.set_options(options));
    const CGAL::ARAP::Report report = d.deform(3, 0);
    CHECK(report && rotation != identity);
    return report.energy;
  };
  const std::vector<double> expected = run([](Deformation&, const std::vector<Vertex>&) {});
  CHECK(run([middle](Deformation& d, const std::vector<Vertex>&) {
    const CGAL::ARAP::Matrix_3x3 before = d.rotation(middle);
    CHECK(d.deform([](const auto&) { return CGAL::ARAP::Visitor_action::cancel; }).status ==
          Status::cancelled);
    CHECK(d.rotation(middle) == before);
  }) == expected);
  CHECK(run([](Deformation& d, const std::vector<Vertex>& inner) {
    const Point target = d.target_position(inner[0]);
    d.set_target_position(inner[0], Point(std::nan(""), 0, 0));
    CHECK(d.deform().status == Status::non_finite_point);
    d.set_target_position(inner[0], target);
  }) == expected);
  CHECK(run([](Deformation& d, const std::vector<Vertex>&) { CHECK(d.preprocess()); }) == expected);
  CHECK(run([middle](Deformation& d, const std::vector<Vertex>&) {
    const CGAL::ARAP::Matrix_3x3 before = d.rotation(middle);
    const auto state = d.state();
    CHECK(d.deform(3, 0));
    CHECK(d.rotation(middle) == identity);
    CHECK(d.restore(state));
    CHECK(d.rotation(middle) == before);
    CHECK(d.preprocess());
    CHECK(d.restore(d.state()));
    CHECK(d.rotation(middle) == before);
  }) == expected);

  const std::vector<double> after_a_run =
    run([](Deformation& d, const std::vector<Vertex>&) { CHECK(d.deform(3, 0)); });
  CHECK(after_a_run != expected);
  const std::vector<double> after_a_detour =
    run([&](Deformation& d, const std::vector<Vertex>&) {
      const auto state = d.state();
      CHECK(d.deform(3, 0));
      CHECK(d.restore(state));
      CHECK(d.deform(3, 0));
      CHECK(d.rotation(middle) == identity);
    });
  for(std::size_t k = 0; k < after_a_run.size(); ++k)
    CHECK_AT_MOST(std::abs(after_a_detour[k] - after_a_run[k]), 1e-9 * after_a_run[k]);
}

// Smooth rotations depend on those of fixed cells, which a region without smoothing may leave out:
// after that, a state starts from rotations that are fitted to its positions, not from identities.
void test_smooth_rotations_through_a_smaller_region()
{
  test_case() = "smooth rotations through a smaller region";
  Mesh mesh = make_mesh<Mesh>(grid("sheet", 11, 17, [](double u, double v) {
    return Eigen::Vector3d(11 * u, 17 * v, 0);
  }));
  Deformation d(mesh);
  d.insert_roi_vertices(mesh.vertices());
  for(Vertex v : mesh.vertices())
    if(const Point& p = mesh.point(v); p.y() > 10.5)
      d.insert_control_vertex(v, Point(p.x(), 10, p.y() - 10));
    else if(p.y() < 7.5)
      d.insert_control_vertex(v);
  CGAL::ARAP::Options options, smooth;
  smooth.smoothing_length = 3;
  CHECK(d.set_options(smooth));
  const CGAL::ARAP::Report first = d.deform(200, 1e-9);
  const auto state = d.state();
  CHECK(first && d.set_options(options) && d.deform(1, 0).stages.region);
  CHECK(d.restore(state) && d.set_options(smooth));
  const CGAL::ARAP::Report again = d.deform(0, 0);
  CHECK(again.stages.region);
  CHECK_AT_MOST(again.energy[0], 1.25 * first.final_energy());
}

Shape bumpy_sheet()
{
  return grid("bumpy sheet", 8, 8, [](double u, double v) {
    return Eigen::Vector3d(8 * u, 8 * v, std::sin(5 * u) * std::cos(4 * v));
  });
}

// A region that was changed and is restored before a run needs no work, and has its energy again;
// one that was prepared meanwhile has the energy, too.
void test_energy_after_undo()
{
  test_case() = "the energy after undo";
  const Shape shape = bumpy_sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  Deformation d(mesh);
  const Vertex last(shape.points.size() - 1);
  for(Vertex v : mesh.vertices())
    if(v != last)
      d.insert_roi_vertex(v);
  d.insert_control_vertex(Vertex(0));
  d.insert_control_vertex(Vertex(20));
  d.insert_control_vertex(Vertex(40), Point(1, 2, 3));
  CHECK(d.deform(5, 0));
  const double energy = d.energy();
  const auto rotation = d.rotation(Vertex(30));
  const auto state = d.state();
  for(bool is_run : {false, true})
  {
    CHECK(d.insert_roi_vertex(last) && std::isnan(d.energy()));
    CHECK(!is_run || d.deform(5, 0));
    CHECK(d.restore(state) && d.energy() == energy);
    CHECK(is_run || d.rotation(Vertex(30)) == rotation);
    const CGAL::ARAP::Report report = d.deform(0, 0);
    CHECK(report.stages.region == is_run && report.stages.weights == is_run);
    CHECK(report.stages.factor == is_run);
    CHECK_AT_MOST(std::abs(report.final_energy() / energy - 1), 1e-12);
    CHECK(d.restore(state));
  }
  CGAL::ARAP::Options options = d.options();
  const CGAL::ARAP::Options before = options;
  options.cells = CGAL::ARAP::Cell_scheme::k_ring(1);
  options.bending_length = 1;
  CHECK(d.set_options(options));
  options.cells = before.cells;
  CHECK(d.set_options(options) && d.restore(state) && std::isnan(d.energy()));
  CHECK(d.deform(0, 0).stages.weights && d.set_options(before) && d.restore(state));
  CHECK(d.set_stiffness([](Vertex) { return 2.0; }));
  CHECK(d.restore(state) && std::isnan(d.energy()));
}

// The energy is that of the last run until something changes on which it depends.
void test_energy_after_changes()
{
  test_case() = "the energy after changes";
  Mesh mesh = make_mesh<Mesh>(bumpy_sheet());
  Deformation d(mesh);
  const Vertex pulled(40), last(static_cast<Vertex::size_type>(mesh.number_of_vertices() - 1));
  for(Vertex v : mesh.vertices())
    if(v != last)
      d.insert_roi_vertex(v);
  d.insert_control_vertex(Vertex(0));
  d.insert_control_vertex(Vertex(20));
  d.insert_control_vertex(pulled, Point(1, 2, 3));
  const std::array<double, 3> middle = {0.5, 0.25, 0.25};
  CGAL::ARAP::Control_point inside;
  const auto set_options = [&](const auto& change) {
    CGAL::ARAP::Options options = d.options();
    change(options);
    CHECK(d.set_options(options));
  };
  const std::vector<std::function<void()>> changes = {
    [&] { CHECK(d.set_stiffness([](Vertex v) { return 1 + 0.1 * int(v); })); },
    [&] { CHECK(d.clear_stiffness()); },
    [&] { CHECK(d.set_groups([](Vertex v) { return int(v) / 3; })); },
    [&] { CHECK(d.clear_groups()); },
    [&] { set_options([](auto& o) { o.bending_length = 0.1; }); },
    [&] { set_options([](auto& o) { o.smoothing_length = 0.1; }); },
    [&] { set_options([](auto& o) { o.cells = CGAL::ARAP::Cell_scheme::k_ring(1); }); },
    [&] { CHECK(d.set_target_weight(pulled, 3)); },
    [&] { CHECK(d.set_target_weight(pulled, 4)); },
    [&] { inside = d.insert_control_point(Mesh::Face_index(7), middle).point; },
    [&] { CHECK(d.set_target_weight(inside, 2)); },
    [&] { CHECK(d.erase_control_point(inside)); },
    [&] { d.insert_control_vertex(Vertex(30)); },
    [&] { d.erase_control_vertex(Vertex(30)); },
    [&] { d.insert_roi_vertex(last); },
    [&] { d.erase_roi_vertex(last); },
    [&] { d.overwrite_initial_geometry(); },
    [&] { d.reset(); }};
  for(const auto& change : changes)
  {
    CHECK(d.translate(Vertex(20), Kernel::Vector_3(0, 0, 1)));
    CHECK(d.deform(2, 0) && d.energy() > 0);
    const double energy = d.energy();
    CHECK(d.set_target_position(pulled, Point(0, 2, 3)));
    set_options([](auto& o) { o.tolerance *= 0.5; });
    CHECK(d.energy() == energy);
    change();
    CHECK(std::isnan(d.energy()));
  }
}

// What a run leaves behind in the energy is of no effect when other vertices are free.
void test_freed_vertices()
{
  using CGAL::ARAP::Cell_scheme;
  const Shape shape = bumpy_sheet();
  for(const Cell_scheme cells : {Cell_scheme::spokes(), Cell_scheme::k_ring(1),
                                 Cell_scheme::k_ring(2), Cell_scheme::spokes_and_rims(),
                                 Cell_scheme::elements()})
  {
    test_case() = "vertices that were fixed in the run before";
    std::vector<std::vector<Point>> results;
    for(const bool is_first_run : {false, true})
    {
      Mesh mesh = make_mesh<Mesh>(shape);
      Deformation d(mesh);
      CHECK(d.set_options(options_for(cells, CGAL::ARAP::Minimizer::quasi_newton)));
      d.insert_roi_vertices(mesh.vertices());
      const Vertex first(0), last(static_cast<Vertex::size_type>(mesh.number_of_vertices() - 1));
      d.insert_control_vertex(first);
      d.insert_control_vertex(last);
      if(is_first_run)
      {
        for(Vertex v : mesh.vertices()) // so few that the region is not cut
          if(std::size_t(v) < mesh.number_of_vertices() / 3)
            d.insert_control_vertex(v);
        CHECK(d.translate(last, Kernel::Vector_3(0, 0, 1)) && d.deform(5, 0));
        for(Vertex v : mesh.vertices())
          if(v != first && v != last)
            d.erase_control_vertex(v);
        d.reset();
      }
      CHECK(d.translate(last, Kernel::Vector_3(0, 0.5, 0.5)) && d.deform(10, 0));
      results.push_back(points_of(mesh));
    }
    CHECK_AT_MOST(largest_distance(results[0], results[1]), 1e-9);
  }
}

// A transformation that changes the object is asked before targets are touched.
void test_transformation_that_inserts()
{
  test_case() = "a transformation that inserts control vertices";
  Mesh mesh = make_mesh<Mesh>(bumpy_sheet());
  Deformation d(mesh);
  d.insert_roi_vertices(vertices(mesh));
  d.insert_control_vertex(Vertex(0));
  CHECK(d.transform(Vertex(0), [&](const Point& p) {
    for(int v = 1; v < 40; ++v)
      d.insert_control_vertex(Vertex(v));
    return p + Kernel::Vector_3(0, 0, 1);
  }));
  CHECK(d.target_position(Vertex(0)) == mesh.point(Vertex(0)) + Kernel::Vector_3(0, 0, 1));
  CHECK(d.transform(Vertex(5), [&](const Point& p) {
    d.erase_control_vertex(Vertex(5));
    return p;
  }).status == Status::not_a_control_vertex);
}

// A state from before the first run knows the rest shape of what is found around the region later,
// also if that was overwritten meanwhile.
void test_state_before_the_first_run()
{
  test_case() = "a state from before the first run";
  const Shape shape = grid("sheet", 9, 4, [](double u, double v) {
    return Eigen::Vector3d(8 * u, 3 * v, 0);
  });
  const Mesh rest = make_mesh<Mesh>(shape);
  Mesh mesh = rest;
  Deformation d(mesh);
  const auto insert_column = [&](int column) {
    for(Vertex v : mesh.vertices())
      if(std::abs(rest.point(v).x() - column) < 0.1)
        d.insert_roi_vertex(v);
  };
  for(int column = 0; column < 5; ++column)
    insert_column(column);
  for(Vertex v : mesh.vertices())
    if(const Point& p = rest.point(v); p.x() < 0.1)
      d.insert_control_vertex(v, Point(p.x(), p.y(), 1));
  const auto state = d.state();
  const CGAL::ARAP::Report report = d.deform(10, 0);
  const Mesh first = mesh;
  insert_column(5); // what was around the region enters it, and moves
  CHECK(report && d.deform(10, 0));
  d.overwrite_initial_geometry();
  CHECK(d.restore(state));
  CHECK(same_points(mesh, rest));
  CHECK(d.deform(10, 0).energy == report.energy);
  CHECK(same_points(mesh, first));
  insert_column(5);
  d.reset();
  CHECK(same_points(mesh, rest));
}

// Handles on a line leave a turn about it open: there is none, up to rounding.
void test_handles_on_a_line()
{
  test_case() = "handles on a line";
  const Shape shape = sheet();
  const Mesh rest = make_mesh<Mesh>(shape);
  const auto check = [&](const Eigen::Affine3d& motion, double most_x, double tolerance) {
    Mesh mesh = rest;
    Deformation d(mesh);
    d.insert_roi_vertices(mesh.vertices());
    const auto moved = [&motion](const Point& p) {
      const Eigen::Vector3d q = motion * Eigen::Vector3d(p.x(), p.y(), p.z());
      return Point(q.x(), q.y(), q.z());
    };
    for(Vertex v : mesh.vertices())
      if(const Point& p = rest.point(v); p.y() < 1e-9 && p.x() < most_x)
        d.insert_control_vertex(v, moved(p));
    CHECK_AT_MOST(d.deform().final_energy(), 1e-24);
    for(Vertex v : mesh.vertices())
      CHECK_AT_MOST(std::sqrt(squared_distance(mesh.point(v), moved(rest.point(v)))), tolerance);
  };
  const auto about = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::Translation3d(3, -1, 2) * Eigen::AngleAxisd(angle, axis.normalized());
  };
  for(const double most_x : {0.15, 3.0}) // two handles, and all of an edge
  {
    check(about(0, {0, 0, 1}), most_x, 1e-13);
    for(const double angle : {1e-3, 1.0, 2.0, 3.0})
      for(const double t : {0.0, 0.4, 2.0}) // axes that are orthogonal to the line
        check(about(angle, {0, std::cos(t), std::sin(t)}), most_x, 1e-12);
    const double anywhere = std::numeric_limits<double>::infinity(); // but with no energy
    check(about(std::acos(-1.0), {0, 0, 1}), most_x, anywhere);
  }
}

void test_all()
{
  test_energy_after_undo();
  test_energy_after_changes();
  test_freed_vertices();
  test_transformation_that_inserts();
  test_state_before_the_first_run();
  test_handles_on_a_line();
  test_rotations_between_runs(6.5, 10.5);
  test_rotations_between_runs(1.5, 16);
  test_smooth_rotations_through_a_smaller_region();
  test_sets();
  test_targets();
  test_region();
  test_rest_shape();
  test_frames();
  test_options();
  test_options_by_name();
  test_small_motions();
  test_change_of_sets();
  test_warm_start();
}

} // namespace session

// The function arap_deform() and its named parameters: the same as the class.
namespace function {

using Vertex = Mesh::Vertex_index;
using CGAL::ARAP::Status;
namespace params = CGAL::parameters;

// Keeps a count: it must be called itself, and not a copy.
struct Counter
{
  int count = 0;

  template <typename Iterate>
  CGAL::ARAP::Visitor_action operator()(const Iterate& iterate)
  {
    ++count;
    return iterate.iteration() == 4 ? CGAL::ARAP::Visitor_action::stop
                                    : CGAL::ARAP::Visitor_action::proceed;
  }
};

void test_all()
{
  const Shape shape = grid("sheet", 10, 5, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0.2 * u * u);
  });
  const Scenario s = in_whole(scenario(shape)); // a function call constrains all that does not move
  const Mesh rest = make_mesh<Mesh>(shape);
  std::map<Vertex, bool> is_constrained;
  std::map<Vertex, Point> targets;
  for(Vertex v : rest.vertices())
  {
    is_constrained[v] = s.selection[v] == 2;
    if(is_constrained[v])
      targets[v] = point(s.targets[v]);
  }
  const auto constrained_map = boost::make_assoc_property_map(is_constrained);
  const auto target_map = boost::make_assoc_property_map(targets);
  CGAL::ARAP::Options options;
  options.cells = CGAL::ARAP::Cell_scheme::spokes();
  options.tolerance = 0;
  options.iterations = 12;

  const auto by_class = [&](auto traits, unsigned int iterations) {
    Mesh mesh = rest;
    CGAL::ARAP_deformation<Mesh, decltype(traits)> d(mesh, traits);
    prepare(d, s, all_vertices(mesh));
    // in the order of the function: the positions depend on it by rounding
    CHECK(d.set_options(options));
    CHECK(d.deform(iterations, 0));
    return mesh;
  };
  const CGAL::ARAP_deformation_traits<> traits;

  Mesh mesh = rest;
  auto report = CGAL::arap_deform(mesh, constrained_map, target_map, options);
  CHECK(report.iterations == 12);
  CHECK(same_points(mesh, by_class(traits, 12)));

  test_case() = "number_of_iterations";
  mesh = rest;
  report = CGAL::arap_deform(mesh, constrained_map, target_map, options,
                             params::number_of_iterations(4u));
  CHECK(report.iterations == 4);
  CHECK(same_points(mesh, by_class(traits, 4)));

  test_case() = "weight_calculator and sparse_linear_solver";
  mesh = rest;
  CHECK(CGAL::arap_deform(mesh, constrained_map, target_map, options,
                          params::weight_calculator(CGAL::ARAP::Uniform_weight())
                            .sparse_linear_solver(CGAL::ARAP::Multifrontal_cholesky_solver())));
  const CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::ARAP::Uniform_weight> uniform;
  CHECK(same_points(mesh, by_class(uniform, 12)));

  test_case() = "visitor";
  mesh = rest;
  Counter counter;
  report = CGAL::arap_deform(mesh, constrained_map, target_map, options,
                             params::visitor(std::ref(counter)));
  CHECK(report.status == Status::stopped);
  CHECK(counter.count == 5);
  CHECK(same_points(mesh, by_class(traits, 4)));

  test_case() = "vertex_point_map and vertex_index_map";
  mesh = rest;
  std::map<Vertex, Point> points;
  std::map<Vertex, int> indices;
  for(Vertex v : mesh.vertices())
  {
    points[v] = mesh.point(v);
    indices[v] = 3 * int(mesh.number_of_vertices() - v); // with gaps
  }
  CHECK(CGAL::arap_deform(mesh, constrained_map, target_map, options,
                          params::vertex_point_map(boost::make_assoc_property_map(points))
                            .vertex_index_map(boost::make_assoc_property_map(indices))));
  CHECK(same_points(mesh, rest));
  for(Vertex v : mesh.vertices())
    mesh.point(v) = points[v];
  CHECK(same_points(mesh, by_class(traits, 12)));

  test_case() = "default options";
  mesh = rest;
  report = CGAL::arap_deform(mesh, constrained_map, target_map);
  CHECK(report);
  CHECK(report.energy.back() < report.energy.front());

  test_case() = "failures";
  mesh = rest;
  options.tolerance = -1;
  CHECK(CGAL::arap_deform(mesh, constrained_map, target_map, options).status ==
        Status::invalid_option);
  for(auto& [v, constrained] : is_constrained)
    constrained = false;
  CHECK(CGAL::arap_deform(mesh, constrained_map, target_map).status == Status::no_fixed_vertex);
  CHECK(same_points(mesh, rest));
}

} // namespace function

// Visitors and reports: what a run tells while it goes on and when it is over, stop, cancel, and
// exceptions.
namespace visitor_and_report {

using Deformation = CGAL::ARAP_deformation<Mesh>;
using Vertex = Mesh::Vertex_index;
using CGAL::ARAP::Report;
using CGAL::ARAP::Status;
using CGAL::ARAP::Visitor_action;

const Shape shape = grid("sheet", 12, 6, [](double u, double v) {
  return Eigen::Vector3d(2 * u, v, 0.1 * u * u);
});

void test_statuses()
{
  const Status all[] = {
    Status::not_run, Status::success, Status::converged, Status::iteration_limit, Status::stopped,
    Status::cancelled, Status::invalid_option, Status::in_a_run, Status::foreign_state,
    Status::invalid_stiffness, Status::undeclared_map, Status::invalid_rotation,
    Status::not_a_control_vertex, Status::invalid_weight, Status::invalid_coordinates,
    Status::dependent_target, Status::too_many_control_points, Status::not_a_simplex,
    Status::too_many_corners, Status::no_tetrahedron, Status::no_simplex, Status::non_finite_point,
    Status::non_finite_weight, Status::no_fixed_vertex, Status::singular_matrix,
    Status::solver_failed, Status::non_finite_energy};
  for(std::size_t k = 0; k < std::size(all); ++k)
    CHECK(all[k] == static_cast<Status>(k));
  CHECK(to_string(static_cast<Status>(std::size(all))) == std::string("unknown"));
  std::set<std::string> names, sentences;
  for(Status status : all)
  {
    names.insert(to_string(status));
    sentences.insert(CGAL::ARAP::internal::outcome(status).message);
  }
  CHECK(names.size() == std::size(all) && !names.count("unknown"));
  CHECK(sentences.size() == std::size(all));
  const Report report;
  CHECK(report.status == Status::not_run && !report && !report.message.empty());
}

void test_iterates()
{
  Mesh mesh = make_mesh<Mesh>(shape);
  const Mesh rest = mesh;
  auto d = prepared(mesh, scenario(shape));
  std::vector<double> seen;
  Mesh copy = mesh;
  const Report report = d.deform(9, 0, [&](const Deformation::Iterate& iterate) {
    CHECK(iterate.iteration() == seen.size());
    seen.push_back(iterate.energy());
    CHECK(same_points(mesh, rest)); // written when the run is over
    iterate.put_points(copy.points());
    return Visitor_action::proceed;
  });
  CHECK(seen == report.energy);
  CHECK(same_points(mesh, copy));
  CHECK(report.iterations == 9);
  CHECK(report.free_vertices > 0 && report.simplices > 0 && report.energy_scale > 0);
  CHECK(report.seconds.total > 0);
  CHECK(report.seconds.local_steps + report.seconds.global_steps + report.seconds.preprocess <=
        report.seconds.total);
}

void test_stop()
{
  const auto at = [](unsigned int k, Visitor_action action) {
    return [k, action](const auto& iterate) {
      return iterate.iteration() == k ? action : Visitor_action::proceed;
    };
  };
  Mesh five = make_mesh<Mesh>(shape);
  auto d = prepared(five, scenario(shape));
  CHECK(d.deform(5, 0));

  Mesh mesh = make_mesh<Mesh>(shape);
  auto e = prepared(mesh, scenario(shape));
  const Report stopped = e.deform(100, 0, at(5, Visitor_action::stop));
  CHECK(stopped.status == Status::stopped);
  CHECK(stopped && stopped.iterations == 5);
  CHECK(same_points(mesh, five));

  const Mesh before = mesh;
  const double energy = e.energy();
  const auto rotation = e.rotation(Vertex(40));
  for(Vertex v : e.control_vertices())
    e.translate(v, Kernel::Vector_3(0, 0, 1));
  const auto check_unchanged = [&] {
    CHECK(same_points(mesh, before));
    CHECK(e.energy() == energy);
    CHECK(e.rotation(Vertex(40)) == rotation);
  };
  const Report cancelled = e.deform(100, 0, at(5, Visitor_action::cancel));
  CHECK(cancelled.status == Status::cancelled);
  CHECK(!cancelled);
  check_unchanged();

  bool is_caught = false;
  try
  {
    CHECK(!e.deform(100, 0, [](const auto& iterate) {
      if(iterate.iteration() == 3)
        throw std::runtime_error("the user's own");
      return Visitor_action::proceed;
    }));
  }
  catch(const std::runtime_error&)
  {
    is_caught = true;
  }
  CHECK(is_caught);
  check_unchanged();

  // and it still does what it would have done
  for(Vertex v : d.control_vertices())
    d.translate(v, Kernel::Vector_3(0, 0, 1));
  CHECK(d.deform(7, 0) && e.deform(7, 0));
  CHECK(same_points(mesh, five));
}

void test_checks()
{
  // what is not a number is never lost
  const double nan = std::nan("");
  CHECK(larger(1, 2) == 2 && larger(2, 1) == 2);
  CHECK(std::isnan(larger(1, nan)) && std::isnan(larger(nan, 1)));
  const std::vector<Point> lost = {Point(0, nan, 0), Point(3, 0, 0)};
  CHECK(std::isnan(largest_distance(lost, std::vector<Point>(2, Point(1, 0, 0)))));

  Report report;
  report.energy_scale = 1;
  report.energy = {3, 2, 1, 1};
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
  report.energy = {3, 2, 2 + 1e-17, 2.1, 1};
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 3);
  report.energy = {1, std::nan("")};
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 1);
  CHECK(CGAL::ARAP::is_rotation({0, -1, 0, 1, 0, 0, 0, 0, 1}));
  CHECK(!CGAL::ARAP::is_rotation({0, 1, 0, 1, 0, 0, 0, 0, 1}));    // a reflection
  CHECK(!CGAL::ARAP::is_rotation({0, -1, 0, 1, 0, 1e-9, 0, 0, 1})); // sheared a little
}

// For a geometric series of decreases the extrapolated gap is that of some iterations before: never
// too small, and not much too large. A run that seems to end and does not is waited for.
void test_gap()
{
  using CGAL::ARAP::internal::Gap_estimate;
  CGAL::ARAP::Report report; // no scale, no rounding
  report.energy = {1000};
  for(const double ratio : {0.3, 0.8, 0.99})
  {
    Gap_estimate estimate;
    CHECK(std::isinf(estimate(3, report)));
    for(int k = 1; k < 300 && std::pow(ratio, k) > 1e-12; ++k)
    {
      estimate.add(std::pow(ratio, k - 1) - std::pow(ratio, k), report);
      const double gap = std::pow(ratio, k), estimated = estimate(2 + gap, report);
      if(k < 10)
        CHECK(std::isinf(estimated));
      else if(k >= 15)
      {
        CHECK_AT_MOST(gap / 2, estimated * (1 + 1e-6));
        const double earlier_gap = gap / std::pow(ratio, 9 + 0.25 * k);
        if(earlier_gap < 1)
          CHECK_AT_MOST(estimated, earlier_gap);
      }
    }
  }

  report.rounding_level = 1e-19;
  Gap_estimate estimate;
  CHECK(estimate(1e-20, report) == 0); // nothing but rounding is left
  for(int k = 0; k < 50; ++k)
    estimate.add(1, report);
  CHECK(std::isinf(estimate(1000, report))); // no end in sight
  estimate.add(0, report);
  CHECK(estimate(1000, report) == 0);

  Gap_estimate rising; // weights that are negative, or rounding
  for(int k = 0; k < 20; ++k)
    rising.add(-1, report);
  CHECK(std::isinf(rising(1000, report)));

  Gap_estimate pausing;
  for(int k = 0; k < 20; ++k)
    pausing.add(std::pow(0.5, k), report);
  CHECK(pausing(100, report) < 1e-4);
  for(int k = 0; k < 3; ++k)
    pausing.add(1, report);
  for(int k = 0; k < 4; ++k)
    pausing.add(1e-9, report);
  CHECK(pausing(100, report) > 1e-2);
}

void test_all()
{
  test_statuses();
  test_iterates();
  test_stop();
  test_checks();
  test_gap();
}

} // namespace visitor_and_report

// Bad data and numerical failure: a status with a sentence that names the culprit, and mesh and
// object as they were.
namespace failures {

using CGAL::ARAP::Outcome;
using CGAL::ARAP::Status;
using Vertex = Mesh::Vertex_index;

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

Shape sheet()
{
  return grid("sheet", 8, 4, [](double u, double v) { return Eigen::Vector3d(2 * u, v, u * v); });
}

// as same_points(), where points may not be numbers
bool same_or_bad_points(const Mesh& a, const Mesh& b)
{
  for(Vertex v : a.vertices())
    for(int k = 0; k < 3; ++k)
      if(a.point(v)[k] != b.point(v)[k] &&
         !(std::isnan(a.point(v)[k]) && std::isnan(b.point(v)[k])))
        return false;
  return true;
}

void check_refused(const Outcome& outcome, Status status, const std::string& culprit)
{
  CHECK(outcome.status == status);
  CHECK(!outcome);
  if(!CHECK(outcome.message.find(culprit) != std::string::npos))
    std::cerr << "    the message was: " << outcome.message << std::endl;
}

// After a failed call the mesh is as it was, and the object works once the cause is removed.
template <typename Deformation, typename Repair>
void check_failure(Mesh& mesh, Deformation& d, Status status, const std::string& culprit,
                   const Repair& repair)
{
  const Mesh before = mesh;
  check_refused(d.deform(), status, culprit);
  CHECK(same_or_bad_points(mesh, before));
  repair();
  const auto report = d.deform(5, 0);
  if(!CHECK(report))
    std::cerr << "    the message was: " << report.message << std::endl;
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
}

void test_points()
{
  for(double bad : {not_a_number, infinity, -infinity})
  {
    test_case() = "a point that is not finite";
    const Shape shape = sheet();
    const Scenario s = scenario(shape);
    Mesh mesh = make_mesh<Mesh>(shape);
    Mesh rest = mesh;
    mesh.point(Vertex(20)) = Point(0, bad, 0);
    {
      auto d = prepared(mesh, s);
      check_failure(mesh, d, Status::non_finite_point, "vertex 20 ", [&] {
        mesh.point(Vertex(20)) = rest.point(Vertex(20));
        d.overwrite_initial_geometry();
      });
    }
    test_case() = "a target that is not finite";
    mesh = rest;
    auto d = prepared(mesh, s);
    const Vertex handle = d.control_vertices()[1];
    const Point target = d.target_position(handle);
    CHECK(d.set_target_position(handle, Point(0, 0, bad)));
    check_failure(mesh, d, Status::non_finite_point,
                  "the target of vertex " + std::to_string(std::size_t(handle)) + " ",
                  [&] { d.set_target_position(handle, target); });
  }
}

void test_overflow()
{
  test_case() = "overflow";
  const Shape shape = sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  auto d = prepared(mesh, scenario(shape));
  const Vertex handle = d.control_vertices()[0];
  d.set_target_position(handle, Point(1e200, 0, 0));
  check_failure(mesh, d, Status::non_finite_energy, "overflow",
                [&] { d.set_target_position(handle, Point(9, 0, 0)); });
}

// not a number for the triangles at one corner of the sheet
struct Undefined_weight : CGAL::ARAP::Uniform_weight
{
  std::array<double, 3>
  simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>& triangle) const
  {
    const double w = triangle[0][0] + triangle[1][0] + triangle[2][0] > 5.6 ? not_a_number : 1;
    return {w, 1, 1};
  }
};

void test_faces()
{
  test_case() = "a degenerate triangle";
  Shape flat = sheet();
  flat.points[13] = (flat.points[12] + flat.points[14]) / 2; // already collinear in the sheet
  flat.points[18] = flat.points[13];
  Mesh degenerate = make_mesh<Mesh>(flat);
  auto e = prepared(degenerate, scenario(flat));
  const auto report = e.deform();
  CHECK(report);
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);

  test_case() = "a weight that is not finite";
  Mesh mesh = make_mesh<Mesh>(sheet());
  const Mesh before = mesh;
  using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, Undefined_weight>;
  CGAL::ARAP_deformation<Mesh, Traits> u(mesh);
  prepare(u, scenario(sheet()), all_vertices(mesh));
  const auto refused = u.deform();
  CHECK(refused.status == Status::non_finite_weight);
  CHECK(refused.message.find("the face with the vertices ") == 0);
  CHECK(refused.message.find("has edges whose weights are not finite") != std::string::npos);
  CHECK(same_points(mesh, before));
}

void test_nothing_fixed()
{
  test_case() = "no fixed vertex";
  const Shape shape = sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  d.insert_roi_vertices(mesh.vertices().begin(), mesh.vertices().end());
  check_failure(mesh, d, Status::no_fixed_vertex, "vertex 0 is free",
                [&] { d.insert_control_vertex(Vertex(7)); });

  test_case() = "one of two components is not fixed";
  const Shape two = two_components(shape);
  Mesh pair = make_mesh<Mesh>(two);
  CGAL::ARAP_deformation<Mesh> e(pair);
  e.insert_roi_vertices(pair.vertices().begin(), pair.vertices().end());
  e.insert_control_vertex(Vertex(7));
  CHECK(e.set_target_position(Vertex(7), Point(0, 0, 3)));
  const Mesh rest = pair;
  for(int call = 0; call < 2; ++call) // the second one has nothing to do
    CHECK(e.preprocess().message.find("unconstrained component") != std::string::npos);
  for(int run = 0; run < 2; ++run) // both have nothing to preprocess
  {
    const auto report = e.deform();
    CHECK(report);
    CHECK(report.unconstrained_components == std::vector<std::size_t>(1, shape.points.size()));
    CHECK(report.message.find("component of vertex " + std::to_string(shape.points.size())) !=
          std::string::npos);
    CHECK(report.free_vertices == shape.points.size() - 1);
  }
  for(std::size_t v = 0; v < two.points.size(); ++v)
    CHECK((pair.point(Vertex(v)) == rest.point(Vertex(v))) == (v >= shape.points.size()));
  e.insert_control_vertex(Vertex(shape.points.size() + 3));
  const auto all_fixed = e.deform();
  CHECK(all_fixed && all_fixed.unconstrained_components.empty());
  CHECK(all_fixed.free_vertices == two.points.size() - 2);

  test_case() = "three of four components are not fixed";
  Mesh four = make_mesh<Mesh>(two_components(two));
  CGAL::ARAP_deformation<Mesh> g(four);
  g.insert_roi_vertices(four.vertices());
  g.insert_control_vertex(Vertex(7));
  CHECK(g.deform().message.find("; left in place: 3 unconstrained components, the first that of "
                                "vertex " + std::to_string(shape.points.size())) !=
        std::string::npos);

  test_case() = "a control point that counts for nothing";
  CGAL::ARAP_deformation<Mesh> h(pair);
  h.insert_roi_vertices(pair.vertices());
  const auto inserted = h.insert_control_point(Mesh::Face_index(0), std::array{0.5, 0.25, 0.25});
  CHECK(inserted && h.set_target_weight(inserted.point, 0));
  check_refused(h.deform(), Status::no_fixed_vertex, "vertex 0 is free");
  CHECK(h.deform().message.find("there is no control vertex") == std::string::npos);

  test_case() = "isolated vertices";
  const Vertex isolated = mesh.add_vertex(Point(5, 5, 5));
  CGAL::ARAP_deformation<Mesh> f(mesh);
  f.insert_roi_vertices(mesh.vertices().begin(), mesh.vertices().end());
  f.insert_control_vertex(Vertex(7));
  CHECK(f.deform()); // stay where they are
  CHECK(mesh.point(isolated) == Point(5, 5, 5));
  f.insert_control_vertex(isolated); // goes to its target, whether that is a hard one or a soft one
  CHECK(f.set_target_position(isolated, Point(6, 5, 4)));
  CHECK(f.set_target_weight(isolated, 0.5));
  CHECK(f.deform());
  CHECK_AT_MOST(std::sqrt(CGAL::squared_distance(mesh.point(isolated), Point(6, 5, 4))), 1e-12);
  const std::string moves_nothing = ": a control vertex without an incident simplex moves nothing";
  CHECK(f.deform().message.find(std::to_string(isolated) + moves_nothing) != std::string::npos);
  const Vertex another = mesh.add_vertex(Point(7, 5, 5));
  f.insert_control_vertex(another);
  CHECK(f.deform().message.find(" and 1 more" + moves_nothing) != std::string::npos);
}

void test_nothing_free()
{
  test_case() = "nothing is free";
  const Shape shape = sheet();
  const Mesh rest = make_mesh<Mesh>(shape);
  Mesh mesh = rest;
  CGAL::ARAP_deformation<Mesh> d(mesh);
  CHECK(d.deform()); // not even a region
  CHECK(same_or_bad_points(mesh, rest));
  d.insert_control_vertices(mesh.vertices().begin(), mesh.vertices().end());
  d.translate(mesh.vertices(), Kernel::Vector_3(1, 0, 0));
  CGAL::ARAP::Options options;
  for(auto guess : {CGAL::ARAP::Initial_guess::previous, CGAL::ARAP::Initial_guess::laplacian})
  {
    options.initial_guess = guess;
    CHECK(d.set_options(options));
    const auto report = d.deform();
    CHECK(report.status == Status::converged);
    CHECK(report.end == CGAL::ARAP::End::minimum);
    CHECK(report.energy == std::vector<double>{0});
    for(Vertex v : mesh.vertices())
      CHECK(mesh.point(v) == rest.point(v) + Kernel::Vector_3(1, 0, 0));
  }

  test_case() = "nothing is free but smooth rotations";
  options.smoothing_length = 0.5 * shape.diameter();
  options.tolerance = 1e-6;
  CHECK(d.set_options(options));
  for(Vertex v : mesh.vertices())
    d.set_target_position(v, point(
      Eigen::AngleAxisd(shape.points[v].x(), Eigen::Vector3d::UnitX()) * shape.points[v]));
  const auto first = d.deform(), second = d.deform();
  CHECK(first.status == Status::converged && first.iterations > 0);
  CHECK_AT_MOST(first.final_energy() - second.final_energy(), 1e-5 * first.final_energy());
  options.smoothing_length = 2 * shape.diameter();
  CHECK(d.set_options(options));
  const auto short_run = d.deform(1, 1e-9);
  CHECK(short_run.status == Status::iteration_limit);
  for(const char* part : {"number of iterations", "nothing is free"})
    CHECK(short_run.message.find(part) != std::string::npos);
}

// weights under which the matrix is not positive definite, or not finite
struct Bad_weight : CGAL::ARAP::Uniform_weight
{
  double value;
  Eigen::Vector3d bad_triangle = Eigen::Vector3d::Constant(infinity); // the one with this centroid
  explicit Bad_weight(double v = -1) : value(v) {}

  using CGAL::ARAP::Uniform_weight::simplex_weights;
  std::array<double, 3> simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>& p) const
  {
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for(const CGAL::ARAP::Coordinates& corner : p)
      centroid += Eigen::Vector3d(corner.data()) / 3;
    return {centroid.isApprox(bad_triangle) ? not_a_number : 1, 1, 1};
  }

  double edge_weight(CGAL::ARAP::Edge_set, std::size_t i, std::size_t j, double) const
  {
    return std::isnan(value) && (i + j) % 3 != 0 ? 1 : value; // they are sorted with numbers
  }
};

void test_matrices()
{
  using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, Bad_weight>;
  const Shape shape = sheet();
  const Scenario s = scenario(shape);
  const Mesh rest = make_mesh<Mesh>(shape);
  const auto try_weight = [&](const Bad_weight& weight, Status status, const std::string& culprit) {
    Mesh mesh = rest;
    CGAL::ARAP_deformation<Mesh, Traits> d(mesh, Traits({}, weight));
    prepare(d, s, all_vertices(mesh));
    check_refused(d.deform(), status, culprit);
    const CGAL::ARAP::Outcome outcome = d.preprocess();
    check_refused(outcome, status, culprit);
    CHECK(same_or_bad_points(mesh, rest));
    return outcome.message;
  };
  test_case() = "singular and non-finite matrices";
  try_weight(Bad_weight(-1), Status::singular_matrix, "vertex ");
  try_weight(Bad_weight(3e307), Status::singular_matrix, "vertex "); // their sum overflows
  try_weight(Bad_weight(not_a_number), Status::non_finite_weight, "vertex ");
  try_weight(Bad_weight(infinity), Status::non_finite_weight, "vertex ");
  for(std::size_t k : {std::size_t(0), std::size_t(1), shape.triangles.size() - 1})
  {
    Bad_weight weight(1);
    weight.bad_triangle.setZero();
    for(std::size_t v : shape.triangles[k])
      weight.bad_triangle += shape.points[v] / 3;
    const std::string phrase = "the face with the vertices ";
    std::istringstream names(
      try_weight(weight, Status::non_finite_weight, phrase).substr(phrase.size()));
    std::set<std::size_t> named;
    for(std::size_t v; names >> v; names.ignore(1)) // a comma
      named.insert(v);
    CHECK((named == std::set<std::size_t>(shape.triangles[k].begin(), shape.triangles[k].end())));
  }

  using CGAL::ARAP::Cell_scheme;
  for(const Cell_scheme cells : {Cell_scheme::spokes(), Cell_scheme::k_ring(2),
                                 Cell_scheme::spokes_and_rims(), Cell_scheme::elements()})
  {
    test_case() = "stiffness times a weight that is not finite";
    Mesh mesh = rest;
    CGAL::ARAP_deformation<Mesh, Traits> d(mesh, Traits({}, Bad_weight(1e200)));
    prepare(d, s, all_vertices(mesh));
    CGAL::ARAP::Options options = d.options();
    options.cells = cells;
    CHECK(d.set_options(options) && d.preprocess());
    if(cells.has_vertex_cells())
      CHECK(d.set_stiffness([](Mesh::Vertex_index) { return 1e200; }));
    else
      CHECK(d.set_stiffness([](Mesh::Face_index) { return 1e200; }));
    check_refused(d.deform(), Status::non_finite_weight, "vertex ");
    CHECK(same_or_bad_points(mesh, rest));
  }
}

// not finite in stars, which the default cells do not have
struct Bad_in_stars : CGAL::ARAP::Uniform_weight
{
  double edge_weight(CGAL::ARAP::Edge_set edge_set, std::size_t i, std::size_t, double sum) const
  {
    return edge_set == CGAL::ARAP::Edge_set::star && i == 7 ? not_a_number : sum;
  }
};

void test_weights_of_laplacian_guess()
{
  test_case() = "weights that only the Laplacian guess needs";
  using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, Bad_in_stars>;
  const Shape shape = sheet();
  const Mesh rest = make_mesh<Mesh>(shape);
  Mesh mesh = rest;
  CGAL::ARAP_deformation<Mesh, Traits> d(mesh);
  prepare(d, scenario(shape), all_vertices(mesh));
  CHECK(d.preprocess());
  CGAL::ARAP::Options options = d.options();
  options.initial_guess = CGAL::ARAP::Initial_guess::laplacian;
  CHECK(d.set_options(options));
  for(int call = 0; call < 2; ++call)
    check_refused(d.deform(), Status::non_finite_weight, "vertex 7 ");
  CHECK(same_or_bad_points(mesh, rest));
  options.initial_guess = CGAL::ARAP::Initial_guess::automatic;
  CHECK(d.set_options(options) && d.deform());
}

// a solver that fails where it is told to
struct Failing_solver : CGAL::ARAP::Multifrontal_cholesky_solver
{
  static int solves_left;
  static bool can_factorize;

  bool factorize(const CGAL::ARAP::Sparse_matrix& a)
  {
    return can_factorize && CGAL::ARAP::Multifrontal_cholesky_solver::factorize(a);
  }

  bool solve(std::size_t n, CGAL::ARAP::Coordinates* x)
  {
    return solves_left-- > 0 && CGAL::ARAP::Multifrontal_cholesky_solver::solve(n, x);
  }
};
int Failing_solver::solves_left = 0;
bool Failing_solver::can_factorize = true;

void test_solver()
{
  using Traits = CGAL::ARAP_deformation_traits<Failing_solver>;
  const Shape shape = sheet();
  for(auto guess : {CGAL::ARAP::Initial_guess::previous, CGAL::ARAP::Initial_guess::laplacian})
  {
    test_case() = "a solver that fails";
    Mesh mesh = make_mesh<Mesh>(shape);
    CGAL::ARAP_deformation<Mesh, Traits> d(mesh);
    CGAL::ARAP::Options options;
    options.initial_guess = guess;
    CHECK(d.set_options(options));
    prepare(d, scenario(shape), all_vertices(mesh));
    Failing_solver::can_factorize = false;
    check_failure(mesh, d, Status::singular_matrix, "factorized",
                  [] { Failing_solver::can_factorize = true; Failing_solver::solves_left = 99; });
    for(int left : {0, 1, 2, 3})
    {
      Failing_solver::solves_left = left;
      check_failure(mesh, d, Status::solver_failed, "the solver failed",
                    [] { Failing_solver::solves_left = 99; });
    }
  }
}

// A solver whose solutions are too large: steps are shortened, so that the energy never rises.
// Where they point the wrong way that is found out before anything is written.
struct Overshooting_solver : CGAL::ARAP::Multifrontal_cholesky_solver
{
  static double factor;

  bool solve(std::size_t n, CGAL::ARAP::Coordinates* x)
  {
    const bool is_solved = CGAL::ARAP::Multifrontal_cholesky_solver::solve(n, x);
    for(std::size_t v = 0; v < n; ++v)
      for(double& coordinate : x[v])
        coordinate *= factor;
    return is_solved;
  }
};
double Overshooting_solver::factor = 1;

void test_rising_energy()
{
  using Traits = CGAL::ARAP_deformation_traits<Overshooting_solver>;
  for(auto minimizer : {CGAL::ARAP::Minimizer::local_global, CGAL::ARAP::Minimizer::quasi_newton})
  {
    test_case() = "a solver that makes the energy rise";
    Mesh mesh = make_mesh<Mesh>(sheet());
    CGAL::ARAP_deformation<Mesh, Traits> d(mesh);
    CGAL::ARAP::Options options;
    options.minimizer = minimizer;
    CHECK(d.set_options(options));
    prepare(d, scenario(sheet()), all_vertices(mesh));
    for(const double factor : {2.005, 10.0})
    {
      Overshooting_solver::factor = factor;
      const CGAL::ARAP::Report report = d.deform(30, 0);
      CHECK(report);
      CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
      CHECK(report.final_energy() < 0.9 * report.energy[0]);
      d.reset();
      prepare(d, scenario(sheet()), all_vertices(mesh));
    }
    options.tolerance = 1e-6;
    CHECK(d.set_options(options));
    for(const double factor : {-1.0, -1e-3}) // the energy rises by more, and by less, than 1%
    {
      Overshooting_solver::factor = factor;
      check_failure(mesh, d, Status::solver_failed, "the solver failed",
                    [] { Overshooting_solver::factor = 1; });
      d.reset();
      prepare(d, scenario(sheet()), all_vertices(mesh));
    }
  }
}

void test_all()
{
  test_points();
  test_overflow();
  test_faces();
  test_nothing_fixed();
  test_nothing_free();
  test_matrices();
  test_weights_of_laplacian_guess();
  test_solver();
  test_rising_energy();
}

} // namespace failures

// Misuse of the interface in Release, where preconditions are not checked: refused calls that say
// so.
namespace misuse {

// a point map that calls a function when a point is written
struct Calling_map
{
  using category = boost::read_write_property_map_tag;
  using key_type = Mesh::Vertex_index;
  using value_type = Point;
  using reference = Point;

  Mesh* mesh;
  const std::function<void()>* call;

  friend Point get(const Calling_map& map, key_type v) { return map.mesh->point(v); }
  friend void put(const Calling_map& map, key_type v, const Point& p)
  {
    (*map.call)();
    map.mesh->point(v) = p;
  }
};

void test_writing_map()
{
  Mesh mesh = make_mesh<Mesh>(octahedron());
  std::function<void()> call = [] {};
  CGAL::ARAP_deformation d(mesh, CGAL::parameters::vertex_point_map(Calling_map{&mesh, &call}));
  const Mesh::Vertex_index first(0), second(1), third(2);
  d.insert_control_vertex(first);
  const auto state = d.state();
  d.insert_roi_vertex(second);
  int calls = 0;
  call = [&] {
    ++calls;
    CHECK(!d.insert_roi_vertex(third) && d.deform().status == CGAL::ARAP::Status::in_a_run);
  };
  CHECK(d.deform());
  d.reset();
  CHECK(d.restore(state));
  CHECK(calls > 3 && !d.is_roi_vertex(third));
  call = [] {};
  CHECK(d.insert_roi_vertex(third));
}

void test_all()
{
  test_writing_map();
  test_misuse([](const auto& call) {
    const CGAL::ARAP::Outcome outcome = call();
    CHECK(outcome.status == CGAL::ARAP::Status::not_a_control_vertex);
    CHECK(outcome.message.find("vertex 5 is not a control vertex") != std::string::npos ||
          outcome.message.find("control point 1 has no target") != std::string::npos);
  });

  // what has no status answers with something harmless
  Mesh mesh = make_mesh<Mesh>(octahedron());
  CGAL::ARAP_deformation<Mesh> d(mesh);
  const Mesh::Vertex_index v(3), w(1);
  CHECK(d.target_position(v) == mesh.point(v));
  CHECK(d.target_weight(v) == 0);
  d.insert_control_vertex(w);
  d.insert_roi_vertex(v);
  CHECK(d.target_position(v) == mesh.point(v));
  CHECK(d.target_weight(v) == 0);
  const CGAL::ARAP::Control_point none(1);
  CHECK(d.control_point_position(none) == Point(0, 0, 0) && d.target_weight(none) == 0);
  CHECK(d.target_position(none) == Point(0, 0, 0));
  d.set_target_position(w, Point(3, 1, 2));
  const CGAL::ARAP::Matrix_3x3 identity = {1, 0, 0, 0, 1, 0, 0, 0, 1};

  // a visitor that changes the object is refused
  bool was_called = false;
  CHECK(d.deform([&](const auto&) {
    was_called = true;
    CHECK(!d.erase_roi_vertex(v) && !d.insert_control_vertex(v));
    d.insert_roi_vertices(mesh.vertices());
    CHECK(d.roi_vertices().size() == 2);
    d.clear_roi_vertices();
    d.reset();
    d.overwrite_initial_geometry();
    d.clear_control_vertices();
    d.clear_control_points();
    CHECK(!d.erase_control_point(none) && !d.set_velocity(w, Kernel::Vector_3(1, 0, 0)));
    const auto zero = [](Mesh::Vertex_index) { return 0; };
    const std::array<double, 3> middle = {0.5, 0.25, 0.25};
    for(const CGAL::ARAP::Outcome& outcome :
        std::initializer_list<CGAL::ARAP::Outcome>{
          d.set_target_position(w, Point(0, 0, 0)), d.set_target_weight(w, 1),
          d.set_target_set(w, [](const Point& p) { return p; }),
          d.set_target_rotation(w, identity), d.erase_target_rotation(w),
          d.set_target_rotations(std::vector<Mesh::Vertex_index>{v}),
          d.set_stiffness(zero), d.clear_stiffness(), d.set_groups(zero), d.clear_groups(),
          d.insert_control_point(Mesh::Face_index(0), middle),
          d.set_options(CGAL::ARAP::Options()), d.preprocess(), d.deform(),
          d.advance(CGAL::ARAP::Dynamics()), d.advance(CGAL::ARAP::Dynamics{-1})})
      CHECK(outcome.status == CGAL::ARAP::Status::in_a_run);
    return CGAL::ARAP::Visitor_action::proceed;
  }));
  CHECK(was_called && mesh.point(w) == Point(3, 1, 2) && d.is_control_vertex(w));
  CHECK(d.rotation(v) != identity);
  CHECK(d.simplex_rotation(Mesh::Face_index(0)) == identity);
  CHECK(d.simplex_rotation(Mesh::null_face()) == identity);

  // and so is a force, or the stiffness of a cell
  const auto state = d.state();
  const auto is_refused = [&] {
    return d.restore(state).status == CGAL::ARAP::Status::in_a_run && !d.erase_control_vertex(w);
  };
  CHECK(d.advance(CGAL::ARAP::Dynamics(), [&](Mesh::Vertex_index) {
    CHECK(is_refused());
    return Kernel::Vector_3(0, 0, 0);
  }));
  CHECK(d.is_control_vertex(w));
  d.set_stiffness([&](Mesh::Vertex_index) {
    CHECK(is_refused());
    return 2.0;
  });
  CHECK(d.preprocess() && d.is_control_vertex(w));
}

} // namespace misuse

// The cost follows the region of interest: a deformation of a few vertices touches the points of
// these and their neighbors, whatever the size of the mesh.
namespace region_cost {

struct Touched
{
  std::set<std::size_t> read, written, indexed;
};

// the points of a mesh, with a record of whose were read and written
struct Recording_point_map
{
  using key_type = Mesh::Vertex_index;
  using value_type = Point;
  using reference = Point;
  using category = boost::read_write_property_map_tag;

  Mesh* mesh;
  Touched* touched;

  friend Point get(const Recording_point_map& map, key_type v)
  {
    map.touched->read.insert(v);
    return map.mesh->point(v);
  }

  friend void put(const Recording_point_map& map, key_type v, const Point& p)
  {
    map.touched->written.insert(v);
    map.mesh->point(v) = p;
  }
};

struct Recording_index_map
{
  using key_type = Mesh::Vertex_index;
  using value_type = std::size_t;
  using reference = std::size_t;
  using category = boost::readable_property_map_tag;

  Touched* touched;

  friend std::size_t get(const Recording_index_map& map, key_type v)
  {
    map.touched->indexed.insert(v);
    return v;
  }
};

Touched deform_patch(int side)
{
  Mesh mesh = make_mesh<Mesh>(grid("sheet", side, side, [side](double u, double v) {
    return Eigen::Vector3d(side * u, side * v, 0);
  }));
  Touched touched;
  using Domain = CGAL::ARAP::Face_graph_domain<Mesh, Recording_point_map, Recording_index_map>;
  CGAL::ARAP_deformation<Mesh, CGAL::Default, Domain> deformation(
    Domain(mesh, Recording_point_map{&mesh, &touched}, Recording_index_map{&touched}));
  const auto vertex = [side](int i, int j) { return Mesh::Vertex_index(i * (side + 1) + j); };
  for(int i = 10; i < 20; ++i)
    for(int j = 10; j < 20; ++j)
      deformation.insert_roi_vertex(vertex(i, j));
  deformation.insert_control_vertex(vertex(15, 15));
  deformation.translate(vertex(15, 15), Eigen::Vector3d(0, 0, 2));
  const auto report = deformation.deform(10, 0);
  CHECK(report);
  CHECK(report.free_vertices == 99);
  deformation.reset();
  return touched;
}

void test_all()
{
  const Touched small = deform_patch(40), large = deform_patch(400);
  CHECK(small.written.size() == 100);
  CHECK(large.written.size() == 100);
  CHECK(large.read.size() == small.read.size());
  CHECK(large.indexed.size() == small.indexed.size());
  CHECK(large.read.size() <= 14 * 14);
  CHECK(large.indexed.size() <= 14 * 14);
}

} // namespace region_cost

int main()
{
  session::test_all();
  function::test_all();
  visitor_and_report::test_all();
  failures::test_all();
#ifdef CGAL_NDEBUG
  misuse::test_all();
#endif
  region_cost::test_all();
  return checks_result();
}
