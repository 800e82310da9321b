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

// Handles inside a face or a tetrahedron, hard and soft, and targets that are sets: against a dense
// computation, in their limits, with every solver, and over a history of changes.

#include "include/check.h"
#include "include/compiled_solvers.h"
#include "include/dense_reference.h"
#include "include/domains.h"
#include "include/shapes.h"
#include "include/Single_precision_solver.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/ARAP_deformation/target_sets.h>
#include <CGAL/ARAP_deformation_traits.h>
#include <CGAL/arap_deform.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <CGAL/AABB_tree.h>
#if __has_include(<CGAL/AABB_traits_3.h>) // the names since CGAL 6.0
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

using CGAL::ARAP::Control_point;
using CGAL::ARAP::Minimizer;
using CGAL::ARAP::Report;
using CGAL::ARAP::Status;

constexpr double infinite = std::numeric_limits<double>::infinity();

using Simplices = std::vector<std::vector<std::size_t>>;

// a shape with what is to be held inside its simplices
template <int Dimension>
struct Held_shape
{
  std::string name;
  std::vector<Eigen::Vector3d> points;
  Simplices simplices;
  Scenario scenario;

  double diameter() const { return diameter_of(points); }

  // simplices with so many free corners, or all, and none outside the region of interest, far from
  // each other
  std::vector<std::size_t> places(std::size_t count, std::size_t least_free = 1) const
  {
    std::vector<std::size_t> all;
    for(std::size_t s = 0; s < simplices.size(); ++s)
    {
      std::size_t free = 0, outside = 0;
      for(std::size_t v : simplices[s])
      {
        free += scenario.selection[v] == 1;
        outside += scenario.selection[v] == 0;
      }
      if(free >= (std::min)(least_free, simplices[s].size()) && outside == 0)
        all.push_back(s);
    }
    std::vector<std::size_t> some;
    for(std::size_t k = 0; k < count; ++k)
      some.push_back(all[k * (all.size() - 1) / (count - 1)]);
    return some;
  }
};

inline Held_shape<2> triangles()
{
  const Shape shape = grid("sheet", 7, 5, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0.2 * std::sin(5 * u) * v);
  });
  return {"triangles", shape.points, as_polygons(shape.triangles), scenario(shape, 0.5)};
}

inline Held_shape<2> quads()
{
  Held_shape<2> held{"quads", {}, {}, {}};
  const std::size_t n = 7, m = 5;
  for(std::size_t i = 0; i <= n; ++i)
    for(std::size_t j = 0; j <= m; ++j)
      held.points.emplace_back(0.3 * double(i), 0.2 * double(j), 0.1 * std::sin(double(i * j)));
  for(std::size_t i = 0; i < n; ++i)
    for(std::size_t j = 0; j < m; ++j)
    {
      const std::size_t a = i * (m + 1) + j, b = a + m + 1;
      held.simplices.push_back({a, b, b + 1, a + 1});
    }
  held.scenario = scenario(Shape{"", held.points, {}}, 0.5);
  return held;
}

inline Held_shape<3> tetrahedra()
{
  const Block solid = block(4, 2, 2);
  return {"tetrahedra", solid.points, as_polygons(solid.tetrahedra), scenario(solid, 0.5)};
}

template <int Dimension>
using Soup = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;

// A deformation of a shape: the object under test.
template <int Dimension, typename Solver = CGAL::Default>
struct Subject
{
  using Deformation =
    CGAL::ARAP_deformation<Soup<Dimension>, CGAL::ARAP_deformation_traits<Solver>>;

  explicit Subject(const Held_shape<Dimension>& shape_, bool is_prepared = true)
    : shape(shape_), points(points_of(shape.points)),
      deformation(Soup<Dimension>(points, shape.simplices))
  {
    if(is_prepared)
      prepare(deformation, shape.scenario, numbers(points.size()));
  }

  // inserts a control point, with a target at a shift from where it is
  Control_point insert(std::size_t simplex, const std::vector<double>& coordinates, double weight,
                       const Eigen::Vector3d& shift)
  {
    const auto inserted = deformation.insert_control_point(simplex, coordinates);
    CHECK(inserted);
    CHECK(deformation.is_control_point(inserted.point));
    CHECK(deformation.translate(inserted.point, shift));
    CHECK(deformation.set_target_weight(inserted.point, weight));
    return inserted.point;
  }

  // how far the hard control points are from their targets
  double miss() const
  {
    double largest = 0;
    for(Control_point p : deformation.control_points())
      if(deformation.target_weight(p) == infinite)
        largest = larger(largest, (vector(deformation.control_point_position(p)) -
                                   vector(deformation.target_position(p))).norm());
    return largest;
  }

  Held_shape<Dimension> shape;
  std::vector<Point> points;
  Deformation deformation;
};

// barycentric coordinates for so many corners, different for each k
inline std::vector<double> coordinates(std::size_t corners, std::size_t k)
{
  std::vector<double> result;
  double sum = 0;
  for(std::size_t c = 0; c < corners; ++c)
    sum += result.emplace_back(1 + double((k + 2 * c) % 3) + 0.3 * double(c));
  for(double& c : result)
    c /= sum;
  return result;
}

// Iterates and energies against the dense reference: hard and soft points, and ones with a plane.
namespace iterates {

template <typename Solver, int Dimension>
void compare(const Held_shape<Dimension>& shape, Cell_scheme cells, Dense_reference::Cells dense)
{
  Subject<Dimension, Solver> s(shape);
  auto& d = s.deformation;
  CHECK(d.set_options(options_for(cells, Minimizer::local_global)));
  Dense_reference::Terms terms_of_energy;
  terms_of_energy.rings = cells.rings();
  Dense_reference reference(shape.points, shape.simplices, Dimension, shape.scenario.selection,
                            dense, Dense_reference::SAFE, terms_of_energy);
  const Kernel::Plane_3 plane(Point(0.3, 0.2, 0.4), Kernel::Vector_3(1, 2, 3));
  const std::vector<std::size_t> places = shape.places(8);
  for(std::size_t k = 0; k < places.size(); ++k)
  {
    const auto& corners = shape.simplices[places[k]];
    const std::vector<double> b = coordinates(corners.size(), k);
    const double weight = k % 2 == 0 ? infinite : 0.3 * double(k);
    const Eigen::Vector3d shift(0.02 * double(k), -0.03, 0.1 - 0.02 * double(k));
    const Control_point p = s.insert(places[k], b, weight, shift);
    Dense_reference::Combination terms;
    for(std::size_t c = 0; c < corners.size(); ++c)
      terms.emplace_back(corners[c], b[c]);
    if(k == 3)
    {
      CHECK(d.set_target_set(p, CGAL::ARAP::projection_onto(plane)));
      reference.add_row(terms, weight, [plane](const Eigen::Vector3d& x) {
        return vector(plane.projection(point(x)));
      });
    }
    else
      reference.add_row(terms, weight, [t = vector(d.target_position(p))](const auto&) {
        return t;
      });
  }

  std::vector<Eigen::Vector3d> x = shape.scenario.targets;
  reference.start(x);
  compare_iterates(d, s.points, reference, x, 6, shape.diameter());
  CHECK_AT_MOST(s.miss(), 1e-13 * shape.diameter());
}

template <int Dimension>
void compare_all(const Held_shape<Dimension>& shape)
{
  const std::pair<Cell_scheme, Dense_reference::Cells> schemes[] = {
    {Cell_scheme::spokes(), Dense_reference::SPOKES},
    {Cell_scheme::k_ring(1), Dense_reference::SPOKES},
    {Cell_scheme::k_ring(2), Dense_reference::SPOKES},
    {Cell_scheme::spokes_and_rims(), Dense_reference::SPOKES_AND_RIMS},
    {Cell_scheme::elements(), Dense_reference::ELEMENTS}};
  for(const auto& [cells, dense] : schemes)
  {
    test_case() = shape.name + ", cells " + std::to_string(dense) + ", rings " +
                  std::to_string(cells.rings());
    compare<CGAL::Default>(shape, cells, dense);
    compare<Compiled_LDLT_solver>(shape, cells, dense);
  }
}

} // namespace iterates

// Every solver, minimizer and cell scheme, from either guess: hard points are met, the energy never
// rises.
namespace solvers {

template <typename Solver, int Dimension>
void test(const std::string& name, const Held_shape<Dimension>& shape)
{
  const auto run = [&](const CGAL::ARAP::Options& options) {
    test_case() = name + ", " + shape.name;
    Subject<Dimension, Solver> s(shape);
    CHECK(s.deformation.set_options(options));
    const std::vector<std::size_t> places = shape.places(6);
    for(std::size_t k = 0; k < places.size(); ++k)
      s.insert(places[k], coordinates(shape.simplices[places[k]].size(), k),
               k == 4 ? 2.0 : infinite, {0.1, 0.05 * double(k), -0.2});
    const Report report = s.deformation.deform(30, 0);
    CHECK(report);
    CHECK(report.stages.border);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    CHECK(report.energy[30] < report.energy[0]);
    CHECK_AT_MOST(s.miss(), 1e-12 * shape.diameter());
  };
  for_all_options(run);
  for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
    run(options_for(Cell_scheme::k_ring(2), minimizer));
}

template <int Dimension>
void test_all(const Held_shape<Dimension>& shape)
{
  test<CGAL::Default>("default", shape);
  test<Single_precision_solver>("single precision", shape);
  test<Compiled_LDLT_solver>("Eigen", shape);
  test<Compiled_conjugate_gradients>("conjugate gradients", shape);
#ifdef CGAL_LINKED_WITH_CHOLMOD
  test<Compiled_cholmod_solver>("CHOLMOD", shape);
#endif
}

} // namespace solvers

namespace limits {

// At a corner it is the control vertex: a soft one to the last bit, a hard one where both end.
template <int Dimension>
void test_corner(const Held_shape<Dimension>& shape)
{
  const std::size_t place = shape.places(3)[1];
  const auto& simplex = shape.simplices[place];
  std::size_t corner = 0;
  while(shape.scenario.selection[simplex[corner]] != 1)
    ++corner;
  std::vector<double> b(simplex.size(), 0);
  b[corner] = 1;
  for(double weight : {infinite, 3.0})
  {
    test_case() = shape.name + ", corner, weight " + std::to_string(weight);
    Subject<Dimension> s(shape), t(shape);
    const Eigen::Vector3d shift(0.1, -0.05, 0.1);
    s.insert(place, b, weight, shift);
    t.deformation.insert_control_vertex(simplex[corner]);
    t.deformation.translate(simplex[corner], shift);
    CHECK(t.deformation.set_target_weight(simplex[corner], weight));
    CHECK(s.deformation.deform(400, 0));
    CHECK(t.deformation.deform(400, 0));
    CHECK_AT_MOST(largest_distance(s.points, t.points),
                  (weight < infinite ? 0 : 1e-10) * shape.diameter());
  }
}

// Soft points tend to hard ones with the weight.
template <int Dimension>
void test_weights(const Held_shape<Dimension>& shape)
{
  test_case() = shape.name + ", weights";
  const std::vector<std::size_t> places = shape.places(3, 4);
  const auto run = [&](double weight) {
    Subject<Dimension> s(shape);
    for(std::size_t k = 0; k < 3; ++k)
      s.insert(places[k], coordinates(shape.simplices[places[k]].size(), k), weight,
               {0.05, 0.05 * double(k), 0.05});
    const Report report = s.deformation.deform(500, 0);
    CHECK(report);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    return s.points;
  };
  const std::vector<Point> hard = run(infinite);
  double last = 1e300;
  for(double weight : {1.0, 1e2, 1e4, 1e6})
  {
    const double distance = largest_distance(run(weight), hard);
    CHECK(distance < 0.2 * last);
    last = distance;
  }
  CHECK_AT_MOST(last, 1e-5 * shape.diameter());
}

// Rigid in, rigid out, also where points are all that holds the shape.
template <int Dimension>
void test_rigid(const Held_shape<Dimension>& shape)
{
  const Affine_map motion = rigid_motion(1.2, {1, 2, 3}, {0.4, 0.5, -0.2});
  std::vector<Eigen::Vector3d> moved;
  for(const auto& p : shape.points)
    moved.push_back(motion * p);
  std::vector<Cell_scheme> schemes(all_cell_schemes.begin(), all_cell_schemes.end());
  schemes.push_back(Cell_scheme::k_ring(2));
  for(double weight : {infinite, 0.5})
    for(const Cell_scheme& cells : schemes)
    {
      if(Dimension == 2 && cells == Cell_scheme::elements())
        continue; // triangles fold
      test_case() = shape.name + ", rigid, weight " + std::to_string(weight);
      Subject<Dimension> s(shape, false);
      CHECK(s.deformation.set_options(options_for(cells)));
      for(std::size_t v = 0; v < s.points.size(); ++v)
        s.deformation.insert_roi_vertex(v);
      for(std::size_t place : shape.places(5))
      {
        const Control_point p =
          s.insert(place, coordinates(shape.simplices[place].size(), 1), weight, {0, 0, 0});
        CHECK(s.deformation.set_target_position(
          p, point(motion * vector(s.deformation.target_position(p)))));
      }
      const Report report = s.deformation.deform();
      CHECK(report.status == Status::converged);
      CHECK_AT_MOST(report.iterations, 3.0);
      CHECK_AT_MOST(largest_distance(s.points, moved), 1e-9 * shape.diameter());
      CHECK_AT_MOST(s.miss(), 1e-12 * shape.diameter());
      // what is translated again needs no other factor
      for(Control_point p : s.deformation.control_points())
        s.deformation.translate(p, Eigen::Vector3d(0, 0, 1));
      const Report again = s.deformation.deform();
      CHECK(again.status == Status::converged && !again.stages.factor && !again.stages.border);
    }
}

template <int Dimension>
void test_all(const Held_shape<Dimension>& shape)
{
  test_corner(shape);
  test_weights(shape);
  test_rigid(shape);
}

} // namespace limits

namespace refusals {

template <typename Subject>
void check_refused(Subject& s, Status status, const std::string& text)
{
  const std::vector<Point> before = s.points;
  const Report report = s.deformation.deform();
  CHECK(report.status == status);
  CHECK(report.message.find(text) != std::string::npos);
  CHECK(largest_distance(before, s.points) == 0);
}

// Points that others determine.
template <typename Solver>
void test_dependent()
{
  const Held_shape<2> shape = triangles();
  const std::size_t place = shape.places(3)[1];
  const Eigen::Vector3d shift(0, 0, 0.1);
  {
    test_case() = "four points in a triangle";
    Subject<2, Solver> s(shape);
    for(std::size_t k = 0; k < 3; ++k)
      s.insert(place, coordinates(3, k), infinite, shift);
    CHECK(s.deformation.deform());
    const Control_point fourth = s.insert(place, {0.4, 0.3, 0.3}, infinite, shift);
    check_refused(s, Status::dependent_target, "control point 4");
    CHECK(s.deformation.set_target_weight(fourth, 2));
    CHECK(s.deformation.deform());
    CHECK(s.deformation.set_target_weight(fourth, infinite));
    check_refused(s, Status::dependent_target, "control point 4");
    CHECK(s.deformation.erase_control_point(s.deformation.control_points().front()));
    CHECK(s.deformation.deform());
    CHECK_AT_MOST(s.miss(), 1e-12 * shape.diameter());
  }
  {
    test_case() = "twice the same";
    Subject<2, Solver> s(shape);
    s.insert(place, {0.2, 0.3, 0.5}, infinite, shift);
    s.insert(place, {0.2, 0.3 + 1e-9, 0.5 - 1e-9}, infinite, shift);
    check_refused(s, Status::dependent_target, "control point 2");
  }
  for(double distance : {0.3, 0.1, 0.03, 0.02, 0.01, 0.003, 0.001, 1e-4})
  {
    test_case() = "four points in a triangle, two of them at " + std::to_string(distance);
    Subject<2, Solver> s(shape);
    s.insert(place, {0.2, 0.3, 0.5}, infinite, shift);
    s.insert(place, {0.2, 0.3 + distance, 0.5 - distance}, infinite, shift);
    s.insert(place, {0.6, 0.2, 0.2}, infinite, shift);
    CHECK(s.deformation.deform());
    CHECK_AT_MOST(s.miss(), 1e-12 * shape.diameter());
    s.insert(place, {0.3, 0.5, 0.2}, infinite, shift);
    check_refused(s, Status::dependent_target, "control point 4");
  }
  for(double distance : {3e-6, 1e-3}) // from a line through two points
    for(int k = 0; k < 20; ++k)
    {
      test_case() = "three points nearly on a line, and a fourth, " + std::to_string(k);
      Subject<2, Solver> s(shape);
      const double a = 0.8 + 0.0093 * k, b = 0.02 + 0.0077 * k, c = 0.36 + 0.013 * k;
      s.insert(place, {a, 1 - a, 0}, infinite, shift);
      s.insert(place, {b, 1 - b, 0}, infinite, shift);
      s.insert(place, {c - distance / 2, 1 - c - distance / 2, distance}, infinite, shift);
      CHECK(s.deformation.deform());
      s.insert(place, {0.3 + 0.01 * k, 0.4, 0.3 - 0.01 * k}, infinite, shift);
      check_refused(s, Status::dependent_target, "control point 4");
    }
  for(const bool has_others : {false, true}) // elsewhere: they determine nothing here
  {
    test_case() = has_others ? "beside three points nearly on a line elsewhere" : "alone";
    Subject<2, Solver> s(shape);
    const auto insert_three = [&](std::size_t triangle, double distance) {
      s.insert(triangle, {0.8, 0.2, 0}, infinite, shift);
      s.insert(triangle, {0.02, 0.98, 0}, infinite, shift);
      s.insert(triangle, {0.36 - distance / 2, 0.64 - distance / 2, distance}, infinite, shift);
    };
    const auto& corners = shape.simplices[place];
    const auto is_corner = [&](std::size_t v) {
      return std::find(corners.begin(), corners.end(), v) != corners.end();
    };
    std::size_t other = place;
    for(std::size_t candidate : shape.places(8, 3))
      if(std::none_of(shape.simplices[candidate].begin(), shape.simplices[candidate].end(),
                      is_corner))
        other = candidate;
    CHECK(other != place);
    if(has_others)
      insert_three(other, 3e-6);
    insert_three(place, 0.005);
    CHECK(s.deformation.deform());
    CHECK_AT_MOST(s.miss(), 1e-12 * shape.diameter());
  }
  {
    test_case() = "many more points than vertices"; // what depends on others must not fill the rows
    Subject<2, Solver> s(shape, false);
    for(std::size_t k = 0; k < 2900; ++k)
      s.insert(k % shape.simplices.size(),
               {0.2 + 1e-4 * double(k % 997), 0.3, 0.5 - 1e-4 * double(k % 997)}, infinite, shift);
    const Report report = s.deformation.deform();
    CHECK(report.status == Status::dependent_target);
  }
  {
    test_case() = "all corners fixed";
    Subject<2, Solver> s(shape);
    for(std::size_t v : shape.simplices[place])
      s.deformation.insert_control_vertex(v);
    const Control_point p = s.insert(place, {0.2, 0.3, 0.5}, infinite, shift);
    check_refused(s, Status::dependent_target, "control point 1");
    // a soft one is a constant of the energy
    CHECK(s.deformation.set_target_weight(p, 2));
    CHECK(s.deformation.deform());
    s.deformation.erase_control_vertex(shape.simplices[place][0]);
    CHECK(s.deformation.set_target_weight(p, infinite));
    CHECK(s.deformation.deform());
    CHECK_AT_MOST(s.miss(), 1e-12 * shape.diameter());
  }
  {
    test_case() = "next to nothing is free";
    Subject<2, Solver> s(shape);
    const Control_point p = s.insert(place, {1e-9, 0.4, 0.6 - 1e-9}, infinite, shift);
    for(std::size_t k : {1, 2})
      CHECK(s.deformation.erase_roi_vertex(shape.simplices[place][k]));
    check_refused(s, Status::dependent_target, "control point 1");
    CHECK(s.deformation.set_target_weight(p, 2));
    CHECK(s.deformation.deform());
    CHECK_AT_MOST(largest_distance(s.points, points_of(shape.points)), 2 * shape.diameter());
  }
  {
    test_case() = "nothing free";
    Subject<2, Solver> s(shape);
    for(std::size_t v = 0; v < s.points.size(); ++v)
      s.deformation.insert_control_vertex(v);
    const Control_point p = s.insert(place, {0.2, 0.3, 0.5}, infinite, shift);
    check_refused(s, Status::dependent_target, "control point 1");
    CHECK(s.deformation.set_target_weight(p, 0));
    const Report without = s.deformation.deform();
    CHECK(without);
    CHECK(s.deformation.set_target_weight(p, 2));
    const Report report = s.deformation.deform();
    CHECK(report);
    CHECK(report.final_energy() == without.final_energy()); // its pull is constant
  }
}

// a simplex with coordinates
using Location = std::pair<std::size_t, std::vector<double>>;

// Two locations in a triangle.
std::vector<Location> close_inside(std::size_t simplex, double distance)
{
  return {{simplex, {0.2, 0.3, 0.5}}, {simplex, {0.2, 0.3 + distance, 0.5 - distance}}};
}

// Two locations on both sides of an edge.
std::vector<Location> close_to_edge(const Simplices& simplices, std::size_t simplex,
                                    double distance)
{
  const auto is_in = [&](std::size_t s, std::size_t v) {
    return std::count(simplices[s].begin(), simplices[s].end(), v) > 0;
  };
  std::size_t other = 0;
  while(std::count_if(simplices[other].begin(), simplices[other].end(),
                      [&](std::size_t v) { return is_in(simplex, v); }) != 2)
    ++other;
  const auto location = [&](std::size_t s, std::size_t neighbor) {
    Location result{s, {}};
    for(std::size_t v : simplices[s])
      result.second.push_back(is_in(neighbor, v) ? 0.5 - distance / 2 : distance);
    return result;
  };
  return {location(simplex, other), location(other, simplex)};
}

// Pairs of points that are close to each other, in a triangle or across an edge: with a factor in
// single precision too.
void test_close_pairs()
{
  using Solver = CGAL::ARAP::Multifrontal_cholesky_solver;
  using Traits = CGAL::ARAP_deformation_traits<Solver>;
  const Held_shape<2> shape = triangles();
  for(double distance : {1e-2, 1e-3, 1e-4, 1e-5})
  {
    test_case() = "pairs of points at " + std::to_string(distance);
    std::vector<Point> results[2];
    for(bool is_single : {false, true})
    {
      std::vector<Point>& points = results[is_single] = points_of(shape.points);
      const Solver solver(is_single ? CGAL::ARAP::Factor_precision::single_precision
                                    : CGAL::ARAP::Factor_precision::double_precision);
      CGAL::ARAP_deformation<Soup<2>, Traits> d(Soup<2>(points, shape.simplices), Traits(solver));
      prepare(d, shape.scenario, numbers(points.size()));
      for(std::size_t place : shape.places(10, 3))
        for(const Location& location : place % 2 == 0
                                         ? close_inside(place, distance)
                                         : close_to_edge(shape.simplices, place, distance))
        {
          const auto inserted = d.insert_control_point(location.first, location.second);
          CHECK(d.translate(inserted.point, Eigen::Vector3d(0, 0.02, 0.1)));
        }
      CHECK(d.deform(30, 0));
      for(Control_point p : d.control_points())
        CHECK_AT_MOST((vector(d.control_point_position(p)) - vector(d.target_position(p))).norm(),
                      1e-12 * shape.diameter());
    }
    CHECK_AT_MOST(largest_distance(results[0], results[1]), 1e-5 * shape.diameter());
  }
}

void test_input()
{
  test_case() = "input";
  Mesh mesh = make_mesh<Mesh>(shapes()[2]);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  const Mesh::Face_index f(7);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for(const std::vector<double>& b :
      {std::vector<double>{0.2, 0.3, 0.4}, {1e6, -1e6, 1.0001}, {0.5, 0.5},
       {1e200, -1e200, 1}, {0.25, 0.25, 0.25, 0.25}, {nan, 0.5, 0.5},
       {infinite, -infinite, 1}, {}})
  {
    const auto refused = d.insert_control_point(f, b);
    CHECK(refused.status == Status::invalid_coordinates);
    CHECK(!d.is_control_point(refused.point));
  }
  CHECK(d.insert_control_point(Mesh::Face_index(), {1, 0, 0}).status == Status::not_a_simplex);
  CHECK(d.insert_control_point(Mesh::Face_index(100000), {1, 0, 0}).status ==
        Status::not_a_simplex);
  CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  CHECK(d.insert_control_point(f, {0.2, 0.3, 0.5}).status == Status::not_a_simplex);
  CHECK(d.roi_vertices().empty() && d.control_points().empty());
  Subject<2> soup(triangles());
  CHECK(soup.deformation.insert_control_point(soup.shape.simplices.size(), {1, 0, 0}).status ==
        Status::not_a_simplex);

  // only corners that count enter the region of interest
  const auto inserted = d.insert_control_point(Mesh::Face_index(9), {0, 0.4, 0.6});
  CHECK(inserted);
  CHECK(d.roi_vertices().size() == 2 && d.control_vertices().empty());
  CHECK(!d.erase_control_point(Control_point()) && !d.erase_control_point(Control_point(9)));
  CHECK(d.translate(inserted.point, Eigen::Vector3d(0.1, 0, 0)));
  CHECK(d.rotate(inserted.point, Eigen::Vector3d(0, 0, 0), Eigen::Quaterniond(1, 0, 0, 0)));
  CHECK(d.transform(d.control_points(), [](const Point& p) { return p; },
                    CGAL::ARAP::Transformed::rest_shape));
  CHECK(d.set_target_weight(inserted.point, -1).status == Status::invalid_weight);
  CHECK(d.deform());
  const double inf = infinite;
  CHECK(d.set_target_position(inserted.point, Point(inf, 0, 0)));
  const Report report = d.deform();
  CHECK(report.status == Status::non_finite_point);
  CHECK(report.message.find("the target of control point 1") != std::string::npos);
  d.clear_control_vertices();
  CHECK(d.control_points().empty());
  CHECK(d.insert_control_point(Mesh::Face_index(9), {0.5, 0.25, 0.25}).point == Control_point(2));
  d.clear_roi_vertices();
  CHECK(d.control_points().empty() && d.roi_vertices().empty());
}

} // namespace refusals

// Histories of changes against an object that has none.
namespace histories {

template <typename Solver, int Dimension>
void test_random_changes(const Held_shape<Dimension>& shape, bool is_held, Cell_scheme cells)
{
  std::mt19937 generator(5);
  const auto random = [&](std::size_t n) { return generator() % n; };
  Subject<Dimension, Solver> s(shape, false);
  auto& d = s.deformation;
  CHECK(d.set_options(options_for(cells)));
  for(std::size_t v = 0; v < s.points.size(); ++v)
    d.insert_roi_vertex(v);
  if(is_held)
    for(std::size_t v : {std::size_t(0), s.points.size() / 2})
      d.insert_control_vertex(v);
  struct Held
  {
    std::size_t place;
    std::vector<double> coordinates;
    double weight;
  };
  std::map<Control_point, Held> held;
  int number_of_factors = 0, number_of_regions = 0;
  for(int step = 0; step < 20; ++step)
  {
    test_case() = shape.name + ", changes, step " + std::to_string(step);
    for(int change = 0; change < 3; ++change)
    {
      const std::size_t kind = random(6);
      if(kind == 0 && held.size() > 3)
      {
        const auto p = std::next(held.begin(), std::ptrdiff_t(random(held.size())));
        CHECK(d.erase_control_point(p->first));
        held.erase(p);
      }
      else if(kind == 1 && held.size() > 3)
      {
        auto& [p, h] = *std::next(held.begin(), std::ptrdiff_t(random(held.size())));
        h.weight = random(2) ? infinite : 0.1 + double(random(5));
        CHECK(d.set_target_weight(p, h.weight));
      }
      else if(kind == 2 && is_held)
      {
        const std::size_t v = 1 + random(s.points.size() - 1);
        if(!d.insert_control_vertex(v))
          d.erase_control_vertex(v);
      }
      else
      {
        const std::size_t place = random(shape.simplices.size());
        const bool is_taken = std::any_of(held.begin(), held.end(), [&](const auto& h) {
          return h.second.place == place;
        });
        const double weight = random(3) && !is_taken ? infinite : 0.7;
        const std::vector<double> b = coordinates(shape.simplices[place].size(), random(3));
        const Control_point p = s.insert(place, b, weight, {0.05, 0.02, -0.05});
        held[p] = {place, b, weight};
      }
    }
    // a fresh object in the same state; its rest shape is what it finds first
    Subject<Dimension, Solver> t(shape, false);
    auto& fresh = t.deformation;
    CHECK(fresh.set_options(options_for(cells)));
    for(std::size_t v = 0; v < t.points.size(); ++v)
      fresh.insert_roi_vertex(v);
    t.points = s.points;
    for(std::size_t v : d.control_vertices())
      fresh.insert_control_vertex(v, d.target_position(v));
    for(const auto& [p, h] : held)
    {
      const auto inserted = fresh.insert_control_point(h.place, h.coordinates);
      CHECK(fresh.set_target_position(inserted.point, d.target_position(p)));
      CHECK(fresh.set_target_weight(inserted.point, h.weight));
    }
    const std::vector<Point> before = s.points;
    const auto state = d.state();
    const Report a = d.deform(5, 0), b = fresh.deform(5, 0);
    CHECK(a.status == b.status);
    number_of_factors += a.stages.factor;
    number_of_regions += a.stages.region;
    if(!a) // by chance points depend on each other
    {
      CHECK(a.status == Status::dependent_target);
      CHECK(d.erase_control_point(held.rbegin()->first));
      held.erase(std::prev(held.end()));
      continue;
    }
    CHECK_AT_MOST(largest_distance(s.points, t.points), 1e-9 * shape.diameter());
    CHECK_AT_MOST(s.miss(), 1e-12 * shape.diameter());
    CHECK(CGAL::ARAP::first_rise_of_energy(a) == 0);
    // undo, and again
    const std::vector<Point> after = s.points;
    CHECK(d.restore(state));
    CHECK(largest_distance(s.points, before) == 0);
    CHECK(d.control_points().size() == held.size());
    CHECK(d.deform(5, 0));
    CHECK_AT_MOST(largest_distance(s.points, after), 1e-10 * shape.diameter());
  }
  CHECK(number_of_regions == 1);
  if constexpr(std::is_same_v<Solver, CGAL::Default>)
    CHECK_AT_MOST(number_of_factors, is_held ? 2.0 : 5.0);
}

// What changes of points cost.
void test_stages()
{
  test_case() = "stages";
  const Shape sheet = grid("sheet", 40, 40, [](double u, double v) {
    return Eigen::Vector3d(u, v, 0.1 * std::sin(5 * u * v));
  });
  const Held_shape<2> shape{"", sheet.points, as_polygons(sheet.triangles), {}};
  Subject<2> s(shape, false);
  auto& d = s.deformation;
  for(std::size_t v = 0; v < s.points.size(); ++v)
  {
    d.insert_roi_vertex(v);
    if(v <= 40)
      d.insert_control_vertex(v);
  }
  Report report = d.deform(2, 0);
  CHECK(report.stages.region && report.stages.factor && !report.stages.border);
  const Control_point p = s.insert(1000, {0.2, 0.3, 0.5}, infinite, {0, 0, 0.1});
  report = d.deform(2, 0);
  CHECK(!report.stages.region && !report.stages.factor && report.stages.border);
  d.translate(p, Eigen::Vector3d(0, 0, 0.1));
  report = d.deform(2, 0);
  CHECK(!report.stages.factor && !report.stages.border);
  CHECK(d.erase_control_point(p));
  report = d.deform(2, 0);
  CHECK(!report.stages.region && !report.stages.factor && !report.stages.border);

  // 500 soft points, and 500 others
  const auto insert_soft = [&](std::size_t first) {
    d.clear_control_points();
    for(std::size_t k = 0; k < 500; ++k)
      s.insert(200 + 6 * k + first, coordinates(3, k), 0.5, {0, 0, 0.1});
  };
  for(std::size_t round = 0; round < 3; ++round)
  {
    insert_soft(round);
    report = d.deform(2, 0);
    CHECK(report);
    CHECK(!report.stages.region && !report.stages.weights && !report.stages.order &&
          report.stages.factor);
  }
  // more hard ones than a border takes
  d.clear_control_points();
  for(std::size_t k = 0; k < 300; ++k)
    s.insert(200 + 10 * k, coordinates(3, k), infinite, {0, 0, 0.01});
  report = d.deform(10, 0);
  CHECK(report);
  CHECK(!report.stages.region && !report.stages.order && report.stages.border);
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
  CHECK_AT_MOST(s.miss(), 1e-12);
  for(std::size_t k = 0; k < 2800; ++k)
    CHECK(d.insert_control_point(200 + k, coordinates(3, k)));
  report = d.deform(2, 0);
  CHECK(report.status == Status::too_many_control_points);
  d.clear_control_points();
  CHECK(d.deform(2, 0));
}

void test_reset()
{
  test_case() = "reset";
  const Held_shape<2> shape = triangles();
  Subject<2> s(shape);
  auto& d = s.deformation;
  for(std::size_t v : d.control_vertices())
    d.erase_control_vertex(v);
  const Control_point p = s.insert(shape.places(3)[1], {0.2, 0.3, 0.5}, infinite, {0, 0, 0.2});
  CHECK(d.deform());
  CHECK(largest_distance(s.points, shape.points) > 0.1);
  d.overwrite_initial_geometry();
  CHECK(d.is_control_point(p));
  const Report still = d.deform();
  CHECK_AT_MOST(still.final_energy(), still.rounding_level + 1e-25);
  CHECK(d.translate(p, Eigen::Vector3d(0, 0, 0.2)));
  CHECK(d.deform());
  const std::vector<Point> moved = s.points;
  d.reset();
  CHECK(largest_distance(s.points, moved) > 0.1);
  CHECK_AT_MOST((vector(d.target_position(p)) - vector(d.control_point_position(p))).norm(), 1e-15);
  const std::vector<Point> rest = s.points;
  CHECK(d.deform());
  CHECK_AT_MOST(largest_distance(s.points, rest), 1e-12);
}

// Corners that leave the region of interest, or are fixed far from what is free, are fixed where
// they are.
void test_fixed_corners()
{
  test_case() = "fixed corners";
  const Held_shape<2> shape = triangles();
  for(double weight : {infinite, 2.0})
  {
    Subject<2> s(shape);
    auto& d = s.deformation;
    const std::size_t place = shape.places(3)[1];
    const Control_point p = s.insert(place, {0.2, 0.3, 0.5}, weight, {0, 0, 0.1});
    const std::size_t v = shape.simplices[place][2];
    CHECK(d.erase_roi_vertex(v));
    CHECK(d.deform());
    CHECK(s.points[v] == point(shape.points[v]));
    CHECK_AT_MOST(s.miss(), 1e-12);
    const double gap = (vector(d.control_point_position(p)) - vector(d.target_position(p))).norm();
    CHECK(weight == infinite ? gap < 1e-12 : gap > 1e-6 && gap < 0.2);
    // all but its neighborhood is fixed: another region
    for(std::size_t w = 0; w < s.points.size(); ++w)
      if(w != shape.simplices[place][0])
        d.insert_control_vertex(w, s.points[w]);
    CHECK(d.deform());
    CHECK_AT_MOST(s.miss(), 1e-12);
  }

  test_case() = "fixed corners, far from the origin";
  double scales[2];
  for(const double offset : {0., 1e5})
  {
    Held_shape<2> far = shape;
    for(std::size_t w = 0; w < far.points.size(); ++w)
    {
      far.points[w].array() += offset;
      far.scenario.targets[w].array() += offset;
    }
    Subject<2> s(far);
    const std::size_t place = far.places(3)[1];
    s.insert(place, {0.2, 0.3, 0.5}, 2, {0, 0, 0.1});
    CHECK(s.deformation.erase_roi_vertex(far.simplices[place][2]));
    scales[offset > 0] = s.deformation.deform().energy_scale;
  }
  CHECK_AT_MOST(std::abs(scales[1] / scales[0] - 1), 1e-3);
}

// A soft point all of whose corners have left the region has no effect: its pull is no part of the
// energy, relative to which runs end.
void test_fixed_soft_point()
{
  test_case() = "a soft point outside the region";
  std::vector<Report> reports;
  std::vector<std::vector<Point>> results;
  for(const bool has_point : {true, false})
  {
    Subject<2> s(triangles());
    const std::size_t place = s.shape.places(3)[1];
    Control_point p;
    if(has_point)
      p = s.insert(place, {0.2, 0.3, 0.5}, 20, {0, 0, 20});
    for(std::size_t v : s.shape.simplices[place])
      CHECK(s.deformation.erase_roi_vertex(v));
    if(has_point) // but nothing that is wrong is accepted
    {
      const Point target = s.deformation.target_position(p);
      CHECK(s.deformation.set_target_position(p, Point(0, std::nan(""), 0)));
      CHECK(s.deformation.deform().status == Status::non_finite_point);
      CHECK(s.deformation.set_target_position(p, target));
    }
    reports.push_back(s.deformation.deform());
    CHECK(reports.back());
    results.push_back(s.points);
  }
  CHECK(reports[0].iterations == reports[1].iterations && results[0] == results[1]);
  CHECK_AT_MOST(std::abs(reports[0].final_energy() / reports[1].final_energy() - 1), 1e-12);
}

// factorizes, but solves nothing
struct Solves_nothing : CGAL::ARAP::Multifrontal_cholesky_solver
{
  bool solve(std::size_t, CGAL::ARAP::Coordinates*) { return false; }
  bool set_border(const CGAL::ARAP::Sparse_matrix&, const CGAL::ARAP::Dense_matrix&)
  {
    return false;
  }
};

void test_failing_solver()
{
  test_case() = "a solver that fails, hard points";
  Subject<2, Solves_nothing> s(triangles());
  s.insert(s.shape.places(3)[1], {0.2, 0.3, 0.5}, infinite, {0, 0, 0.1});
  refusals::check_refused(s, Status::solver_failed, "solve");
}

// Soft control points in a part that nothing holds, and that stays, as stiffness of zero makes one:
// their pull is no part of the energy, by whose size it is judged when the run is at its end.
void test_constant_pull()
{
  test_case() = "the pull of what stays";
  const Shape shape = grid("sheet", 12, 12, [](double u, double v) {
    return Eigen::Vector3d(u, v, 0.05 * std::sin(7 * u) * std::cos(5 * v));
  });
  std::vector<Report> reports;
  std::vector<std::vector<Point>> points;
  for(const double weight : {0.0, 1.0, 1e6})
  {
    Mesh mesh = make_mesh<Mesh>(shape);
    CGAL::ARAP_deformation<Mesh> d(mesh);
    CHECK(d.set_options(options_for(Cell_scheme::spokes())));
    prepare(d, scenario(shape), all_vertices(mesh));
    const Mesh::Face_index face(12 * 12 + 12); // in the middle
    std::set<Mesh::Vertex_index> loose;
    for(auto v : vertices_around_face(mesh.halfedge(face), mesh))
      for(auto w : vertices_around_target(v, mesh))
        loose.insert(w);
    CHECK(d.set_stiffness([&](Mesh::Vertex_index v) { // 0 at all their edges
      const auto around = vertices_around_target(v, mesh);
      return loose.count(v) == 1 || std::any_of(around.begin(), around.end(), [&](auto w) {
        return loose.count(w) == 1;
      }) ? 0 : 1;
    }));
    if(weight > 0)
    {
      const auto inserted = d.insert_control_point(face, {0.2, 0.3, 0.5});
      CHECK(d.set_target_weight(inserted.point, weight));
      CHECK(d.translate(inserted.point, Kernel::Vector_3(0, 0, shape.diameter())));
    }
    reports.push_back(d.deform());
    CHECK(reports.back() && reports.back().unconstrained_components.size() >= loose.size());
    points.push_back(points_of(mesh));
    CHECK(reports.back().energy == reports[0].energy && reports.back().energy[0] > 0);
    CHECK(points.back() == points[0]);
  }
}

} // namespace histories

namespace sets {

// The ends of a sheet are held, and points inside are pulled to a plane above it.
struct Pulled_sheet
{
  explicit Pulled_sheet(double weight) : s(triangles())
  {
    for(std::size_t place : s.shape.places(6, 3))
      points.push_back(s.insert(place, coordinates(3, 0), weight, {0, 0, 0}));
  }

  Subject<2> s;
  std::vector<Control_point> points;
  Kernel::Plane_3 plane = Kernel::Plane_3(Point(0, 0, 0.6), Kernel::Vector_3(0.2, 0.1, 1));
};

void test_plane()
{
  test_case() = "plane";
  for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
  {
    Pulled_sheet glides(1e6), holds(1e6);
    double energies[2];
    for(Pulled_sheet* sheet : {&glides, &holds})
    {
      auto& d = sheet->s.deformation;
      CHECK(d.set_options(options_for(Cell_scheme::spokes_and_rims(), minimizer)));
      for(Control_point p : sheet->points)
        if(sheet == &glides)
          CHECK(d.set_target_set(p, CGAL::ARAP::projection_onto(sheet->plane)));
        else
          CHECK(d.set_target_position(p, sheet->plane.projection(d.target_position(p))));
      const Report report = d.deform(300, 0);
      CHECK(report);
      CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
      energies[sheet == &holds] = report.final_energy();
      for(Control_point p : sheet->points)
        CHECK_AT_MOST(
          std::sqrt(CGAL::squared_distance(d.control_point_position(p), sheet->plane)), 1e-4);
    }
    CHECK(energies[0] < 0.999 * energies[1]);
  }
}

void test_line_at_vertex()
{
  test_case() = "line";
  Subject<2> s(triangles());
  const std::size_t v = 20;
  const Kernel::Line_3 line(Point(0, 0, 0.5), Kernel::Vector_3(1, 0.3, 0));
  s.deformation.insert_control_vertex(v);
  CHECK(s.deformation.set_target_weight(v, 1e6));
  CHECK(s.deformation.set_target_set(v, CGAL::ARAP::projection_onto(line)));
  for(auto guess : {CGAL::ARAP::Initial_guess::previous, CGAL::ARAP::Initial_guess::laplacian})
  {
    CHECK(s.deformation.set_options(
      options_for(Cell_scheme::spokes_and_rims(), Minimizer::quasi_newton, guess)));
    const Report report = s.deformation.deform(200, 0);
    CHECK(report);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    CHECK_AT_MOST(std::sqrt(CGAL::squared_distance(s.points[v], line)), 1e-4);
    CHECK_AT_MOST((vector(s.deformation.target_position(v)) -
                   vector(line.projection(s.points[v]))).norm(), 1e-12);
  }
  // moving the target makes it a point
  CHECK(s.deformation.translate(v, Eigen::Vector3d(0, 0, 0.1)));
  const Point target = s.deformation.target_position(v);
  CHECK_AT_MOST(std::abs(target.z() - 0.6), 1e-12);
  CHECK(s.deformation.set_target_weight(v, infinite));
  CHECK(s.deformation.deform());
  CHECK(s.points[v] == target);
}

// A roof above the sheet, whose nearest points jump below its ridge.
void test_surface()
{
  using Triangles = std::vector<Kernel::Triangle_3>;
  const auto height = [](double x) { return 0.9 - std::abs(x - 1); };
  const auto corner = [&](double x, double y) { return Point(x, y, height(x)); };
  Triangles roof;
  for(double x : {-2., 1.})
  {
    roof.emplace_back(corner(x, -3), corner(x + 3, -3), corner(x + 3, 4));
    roof.emplace_back(corner(x, -3), corner(x + 3, 4), corner(x, 4));
  }
#if __has_include(<CGAL/AABB_traits_3.h>)
  using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>;
  const CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>> tree(roof.begin(), roof.end());
#else
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
  const CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(roof.begin(), roof.end());
#endif
  const auto onto_roof = CGAL::ARAP::projection_onto(tree);
  for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
  {
    test_case() = "surface, minimizer " + std::to_string(int(minimizer));
    Pulled_sheet sheet(1e6);
    auto& d = sheet.s.deformation;
    CHECK(d.set_options(options_for(Cell_scheme::spokes_and_rims(), minimizer)));
    CHECK(d.set_target_set(sheet.points, onto_roof));
    const std::vector<Point> before = sheet.s.points;
    const auto state = d.state();
    const Report report = d.deform(300, 0);
    CHECK(report);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    CHECK(report.final_energy() < 1e-3 * report.energy[0]);
    std::set<bool> sides;
    for(Control_point p : sheet.points)
    {
      const Point q = d.control_point_position(p);
      CHECK_AT_MOST(std::abs(q.z() - height(q.x())), 1e-4);
      CHECK(d.target_position(p) == onto_roof(q));
      sides.insert(q.x() < 1);
    }
    CHECK(sides.size() == 2);

    test_case() += ", undone";
    const std::vector<Point> after = sheet.s.points;
    for(Control_point p : sheet.points)
      CHECK(d.set_target_position(p, Point(0, 0, 0))); // no set any more
    CHECK(d.restore(state));
    CHECK(largest_distance(sheet.s.points, before) == 0);
    CHECK(d.deform(300, 0).energy == report.energy);
    CHECK(largest_distance(sheet.s.points, after) == 0);
  }
}

void test_refusals()
{
  test_case() = "sets that are refused";
  Pulled_sheet sheet(infinite);
  auto& d = sheet.s.deformation;
  const Control_point p = sheet.points[0];
  const auto onto_plane = CGAL::ARAP::projection_onto(sheet.plane);
  const CGAL::ARAP::Outcome refused = d.set_target_set(p, onto_plane);
  CHECK(refused.status == Status::invalid_weight);
  CHECK(refused.message.find("control point 1 ") == 0);
  CHECK(d.set_target_weight(p, 1));
  CHECK(d.set_target_set(p, onto_plane));
  CHECK(d.set_target_weight(p, infinite).status == Status::invalid_weight);
  CHECK(d.target_weight(p) == 1);
  CHECK(d.deform());

  // a function that is none is refused, and the set remains
  bool is_refused = false;
  try
  {
    CHECK(!d.set_target_set(p, std::function<Point(const Point&)>()));
  }
  catch(const std::bad_function_call&)
  {
    is_refused = true;
  }
  CHECK(is_refused && d.set_target_weight(p, infinite).status == Status::invalid_weight);

  // an exception rolls back, and what is not finite is a status
  const std::vector<Point> before = sheet.s.points;
  int calls = 0;
  CHECK(d.set_target_set(p, [&calls](const Point& q) {
    if(++calls == 5)
      throw std::runtime_error("no such point");
    return Point(q.x(), q.y(), 3);
  }));
  bool has_thrown = false;
  try
  {
    [[maybe_unused]] const Report report = d.deform();
  }
  catch(const std::runtime_error&)
  {
    has_thrown = true;
  }
  CHECK(has_thrown && calls == 5);
  CHECK(largest_distance(before, sheet.s.points) == 0);
  CHECK(d.set_target_set(p, [](const Point& q) {
    return Point(q.x(), q.y(), std::numeric_limits<double>::quiet_NaN());
  }));
  const Report report = d.deform();
  CHECK(report.status == Status::non_finite_point);
  CHECK(report.message.find("the target of control point 1") == 0);
  CHECK(largest_distance(before, sheet.s.points) == 0);
  CHECK(d.set_target_set(p, onto_plane));
  const CGAL::ARAP::Control_point second = d.insert_control_point(5, {0.5, 0.25, 0.25}).point;
  CHECK(d.set_target_weight(second, 1) && d.set_target_set(second, [](const Point&) {
    return Point(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  }));
  CHECK(d.deform().message.find("the target of control point " +
                                std::to_string(sheet.points.size() + 1)) == 0);
  CHECK(d.erase_control_point(second));
  CHECK(d.set_target_set(p, onto_plane));
  CHECK(d.deform());

  // the point that was the target before is not read any more, and a set is not asked when it goes
  CHECK(d.set_target_position(p, Point(0, 0, std::numeric_limits<double>::quiet_NaN())));
  CHECK(!d.deform());
  CHECK(d.set_target_set(p, onto_plane));
  CHECK(d.deform());
  const std::size_t v = 20;
  d.insert_control_vertex(v);
  const auto is_asked = [](const Point&) -> Point { throw std::runtime_error("asked"); };
  CHECK(d.set_target_weight(v, 1));
  for(int k = 0; k < 4; ++k)
  {
    CHECK(d.set_target_set(v, is_asked));
    if(k == 0)
      CHECK(d.set_target_position(v, sheet.s.points[v]));
    else if(k == 1)
      CHECK(!d.insert_control_vertex(v, sheet.s.points[v]));
    else if(k == 2)
      d.reset();
    else
      CHECK(d.transform(v, [](const Point& q) { return q; }, CGAL::ARAP::Transformed::rest_shape));
    CHECK(d.deform(1, 0));
  }
}

// Frames of handles that glide turn with where these are.
void test_frames_of_sets()
{
  test_case() = "frames of targets that are sets";
  Subject<2> s(triangles());
  auto& d = s.deformation;
  const std::vector<std::size_t> handles = {20, 21, 30};
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for(std::size_t v : handles)
  {
    d.insert_control_vertex(v);
    CHECK(d.set_target_weight(v, 1));
    const Point turned = point(turn * vector(s.points[v]));
    CHECK(d.set_target_set(v, [turned](const Point&) { return turned; }));
  }
  CHECK(d.set_target_rotations(handles));
  CHECK(d.deform(0, 0));
  const CGAL::ARAP::Matrix_3x3 rotation = d.rotation(handles[0]);
  for(int k = 0; k < 9; ++k)
    CHECK_AT_MOST(std::abs(rotation[std::size_t(k)] - turn(k / 3, k % 3)), 1e-12);
}

} // namespace sets

namespace locations {

template <typename Domain>
Eigen::Vector3d place(const Domain& domain,
                      const CGAL::ARAP::Location<typename Domain::simplex_descriptor>& location)
{
  Eigen::Vector3d sum(0, 0, 0);
  std::size_t k = 0;
  for(auto v : domain.simplex_vertices(location.simplex))
  {
    const CGAL::ARAP::Coordinates c = Domain::coordinates(domain.point(v));
    sum += location.coordinates[k++] * Eigen::Vector3d(c[0], c[1], c[2]);
  }
  return sum;
}

template <int Dimension>
void test(const Held_shape<Dimension>& shape)
{
  test_case() = shape.name + ", locate";
  std::vector<Point> points = points_of(shape.points);
  const Soup<Dimension> domain(points, shape.simplices);
  const CGAL::ARAP::Locator<Soup<Dimension>> locator(domain);
  std::vector<CGAL::ARAP::Location<std::size_t>> all;
  for(std::size_t s = 0; s < shape.simplices.size(); s += 3)
  {
    const std::size_t corners = shape.simplices[s].size();
    if(corners > 3 && Dimension == 2) // a quad that is not plane has no point of its own
      continue;
    const Eigen::Vector3d p = place(domain, {s, coordinates(corners, s), 0});
    const auto found = locator.locate(point(p));
    CHECK(found && found->simplex == s);
    CHECK_AT_MOST((place(domain, *found) - p).norm(), 1e-14);
    CHECK_AT_MOST(found->distance, 1e-14);
    all.push_back(*found);
  }
  // from a point outside to the nearest one
  const Point outside(-1, 0.3, 0.2);
  const auto found = CGAL::ARAP::locate(domain, outside);
  if(!CHECK(found))
    return;
  CHECK(found->coordinates.size() == shape.simplices[found->simplex].size());
  const double distance = (place(domain, *found) - vector(outside)).norm();
  CHECK(found->distance > 0);
  for(const auto& p : shape.points)
    CHECK(found->distance <= (p - vector(outside)).norm() + 1e-13);
  if(Dimension == 2)
  {
    CHECK_AT_MOST(std::abs(distance - found->distance), 1e-13);
    for(double c : found->coordinates)
      CHECK(c >= 0);
  }
  else
    CHECK_AT_MOST(distance, 1e-13);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(!CGAL::ARAP::locate(domain, Point(nan, 0, 0)));
  // places follow an affine map of the shape
  all.push_back(*found);
  const Affine_map map = {Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()) *
                            Eigen::Matrix3d(Eigen::Vector3d(2, 0.5, 3).asDiagonal()),
                          Eigen::Vector3d(1e6, 0, -1e6)};
  std::vector<Eigen::Vector3d> moved;
  for(const auto& location : all)
    moved.push_back(map * place(domain, location));
  for(Point& p : points)
    p = point(map * vector(p));
  for(std::size_t k = 0; k < all.size(); ++k)
    CHECK_AT_MOST((vector(CGAL::ARAP::construct_point(domain, all[k])) - moved[k]).norm(), 1e-9);
}

// The halfedge of a face may point to any of its corners: coordinates begin there.
void test_turned_halfedges()
{
  test_case() = "locate, faces that begin elsewhere";
  Mesh mesh = make_mesh<Mesh>(shapes()[2]);
  for(auto f : mesh.faces())
    for(std::size_t turns = f.idx() % 3; turns-- > 0;)
      mesh.set_halfedge(f, mesh.next(mesh.halfedge(f)));
  CGAL::ARAP_deformation<Mesh> deformation(mesh);
  const CGAL::ARAP::Locator<CGAL::ARAP::Face_graph_domain<Mesh>> locator{
    CGAL::ARAP::Face_graph_domain<Mesh>(mesh)};
  for(auto f : mesh.faces())
  {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    std::size_t number = 0;
    for(auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      p += ++number * vector(mesh.point(v));
    p /= static_cast<double>(number * (number + 1) / 2);
    const auto found = locator.locate(point(p));
    if(!CHECK(found))
      return;
    const auto inserted = deformation.insert_control_point(*found);
    CHECK(inserted);
    const auto q = deformation.control_point_position(inserted.point);
    CHECK_AT_MOST((vector(q) - p).norm(), 1e-12);
  }
}

// A polygon need not be convex. Compared with the distance from its sides, and a count of those
// that a ray crosses.
void test_polygons()
{
  const std::vector<std::vector<Eigen::Vector2d>> polygons = {
    {{0, 0}, {2, 1}, {4, 0}, {2, 4}},                                 // an arrow head
    {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},                 // an L
    {{0, 0}, {5, 0}, {5, 3}, {4, 1}, {3, 3}, {2, 1}, {1, 3}, {0, 3}}, // a comb
    {{0, 0}, {2, 0}, {4, 0}, {4, 4}, {1, 4}, {1, 2}, {2, 2}, {2, 3}, {3, 3}, {3, 1}, {0, 1}},
    // with a corner on the diagonal of an ear
    {{0, 0}, {2, 0}, {2, 2}, {1.5, 4}, {1, 1}, {0.75, 4}, {0.5, 2.5}, {0.25, 4}}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 6);
  const Eigen::Matrix3d turned(
    Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix());
  for(const std::vector<Eigen::Vector2d>& polygon : polygons)
    for(std::size_t first = 0; first < 2 * polygon.size(); ++first)
    {
      const double scale = first % 4 == 1 ? 1e-90 : 1;
      const Eigen::Matrix3d turn = first % 3 == 0 ? Eigen::Matrix3d::Identity() : turned;
      const std::size_t n = polygon.size();
      test_case() = "locate, polygon of " + std::to_string(n) + ", from " + std::to_string(first);
      std::vector<Eigen::Vector2d> corners(n);
      for(std::size_t k = 0; k < n; ++k) // in both directions
        corners[k] = polygon[first < n ? (first + k) % n : (2 * n - 1 + first - k) % n];
      std::vector<Point> points;
      std::vector<std::size_t> face;
      for(const auto& c : corners)
      {
        face.push_back(points.size());
        points.push_back(point(scale * (turn * Eigen::Vector3d(c.x(), c.y(), 1))));
      }
      const std::vector<std::vector<std::size_t>> faces = {face};
      const auto domain = CGAL::ARAP::make_polygon_soup_domain(points, faces);
      const CGAL::ARAP::Locator<std::decay_t<decltype(domain)>> locator(domain);
      for(int k = 0; k < 50; ++k)
      {
        const double x = coordinate(random), y = coordinate(random);
        const Eigen::Vector2d p(x, y);
        bool is_inside = false;
        double distance = std::numeric_limits<double>::infinity();
        for(std::size_t i = 0; i < n; ++i)
        {
          const Eigen::Vector2d a = corners[i], b = corners[(i + 1) % n], side = b - a;
          const double t = std::clamp(side.dot(p - a) / side.squaredNorm(), 0.0, 1.0);
          distance = (std::min)(distance, (a + t * side - p).norm());
          if((a.y() > p.y()) != (b.y() > p.y()))
            is_inside ^= p.x() < a.x() + (p.y() - a.y()) / side.y() * side.x();
        }
        if(is_inside)
          distance = 0;
        const Eigen::Vector3d q = scale * (turn * Eigen::Vector3d(p.x(), p.y(), 1));
        const auto found = locator.locate(point(q));
        if(!CHECK(found && found->coordinates.size() == n))
          return;
        CHECK_AT_MOST(std::abs(found->distance / scale - distance), 1e-13);
        CHECK_AT_MOST(std::abs(((place(domain, *found) - q) / scale).norm() - distance), 1e-13);
      }
    }
  test_case() = "locate, polygons that are not simple";
  for(const std::vector<Point>& corners : std::vector<std::vector<Point>>{
        {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                 // meets itself, has no area
        {{0, 0, 0}, {3, 3, 0}, {3, 0, 0}, {0, 2, 0}},                 // meets itself
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}},                 // on a line
        {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}})     // a corner twice
  {
    std::vector<Point> points = corners;
    std::vector<std::size_t> face(points.size());
    std::iota(face.begin(), face.end(), std::size_t(0));
    const std::vector<std::vector<std::size_t>> faces = {face};
    const auto domain = CGAL::ARAP::make_polygon_soup_domain(points, faces);
    const auto found = CGAL::ARAP::locate(domain, Point(0.9, 0.2, 0.5));
    const bool is_on_a_line = corners[3].y() == 0;
    CHECK(found.has_value() != is_on_a_line);
    if(found)
      CHECK_AT_MOST(std::abs((place(domain, *found) -
                              Eigen::Vector3d(0.9, 0.2, 0.5)).norm() - found->distance), 1e-13);
  }
}

// A triangle without area is ignored, however far away its corners are.
void test_far_flat_triangle()
{
  test_case() = "locate, beside a triangle without area";
  for(double x : {1e13, 1e20, 1e300})
  {
    std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {x, 0, 0}};
    const std::vector<std::array<std::size_t, 3>> triangles = {{0, 1, 2}, {0, 1, 3}};
    const auto found = CGAL::ARAP::locate(CGAL::ARAP::make_polygon_soup_domain(points, triangles),
                                          Point(0.2, 0.3, 0.5));
    if(CHECK(found && found->simplex == 0))
      CHECK_AT_MOST(std::abs(found->coordinates[1] - 0.2) + std::abs(found->distance - 0.5), 1e-14);
  }
}

// A triangle that is next to nothing beside another one is ignored.
void test_small_triangle()
{
  test_case() = "locate, beside a much larger triangle";
  std::vector<Point> points = {{0, 0, 0}, {1e-17, 0, 0}, {0, 1e-17, 0}, {1, 0, 0}, {2, 0, 0},
                               {1, 1, 0}};
  const std::vector<std::array<std::size_t, 3>> triangles = {{0, 1, 2}, {3, 4, 5}};
  const auto found = CGAL::ARAP::locate(CGAL::ARAP::make_polygon_soup_domain(points, triangles),
                                        Point(0, 0, 0));
  CHECK(found && found->simplex == 1 && found->coordinates[0] == 1 && found->distance == 1);
}

// The place that is found is the nearest one in a thin triangle, too, where an error of CGAL's
// nearest point of the height of the triangle is any error along it.
void test_thin_triangle()
{
  test_case() = "locate, in a thin triangle";
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto any = [&] {
    const double x = uniform(random), y = uniform(random);
    return Kernel::Vector_3(x, y, uniform(random));
  };
  for(double height : {1e-3, 1e-8, 1e-9, 1e-10, 1e-11})
    for(int k = 0; k < 1000; ++k)
    {
      const Point a = CGAL::ORIGIN + any(), b = CGAL::ORIGIN + any();
      const Point c = a + (0.5 + 0.4 * uniform(random)) * (b - a) + height * any();
      std::vector<Point> points = {a, b, c};
      const std::vector<std::array<std::size_t, 3>> triangles = {{0, 1, 2}};
      const auto domain = CGAL::ARAP::make_polygon_soup_domain(points, triangles);
      const Point query = c + (0.5 + 0.5 * uniform(random)) * (b - c);
      if(const auto found = CGAL::ARAP::locate(domain, query)) // not without area
      {
        const Point place = CGAL::ARAP::construct_point(domain, *found);
        CHECK_AT_MOST(std::sqrt(CGAL::squared_distance(place, query)), 1e-14);
        CHECK_AT_MOST(found->distance, 1e-14);
      }
      else
        CHECK(height < 1e-10);
    }
}

// A quad that is not plane is cut along the same diagonal, whichever of its corners is the first.
void test_folded_quad()
{
  test_case() = "locate, a folded quad";
  std::vector<Point> points = {{0, 0, 0}, {1, 0, 0.6}, {1, 1, 0}, {0, 1, 0.7}};
  std::vector<double> distances;
  for(std::size_t first = 0; first < 4; ++first)
  {
    const std::vector<std::array<std::size_t, 4>> faces = {
      {first, (first + 1) % 4, (first + 2) % 4, (first + 3) % 4}};
    const auto found = CGAL::ARAP::locate(CGAL::ARAP::make_polygon_soup_domain(points, faces),
                                          Point(0.5, 0.5, 2));
    CHECK(found);
    distances.push_back(found ? found->distance : 0);
    CHECK_AT_MOST(std::abs(distances.back() - distances[0]), 1e-15);
  }
}

// a cell with five corners is no tetrahedron, and found by no point in it
void test_cell_of_other_size()
{
  test_case() = "a cell with five corners";
  std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const std::vector<std::vector<std::size_t>> cells = {{0, 1, 2, 3, 4}, {0, 1, 2, 3}};
  const auto found = CGAL::ARAP::locate(CGAL::ARAP::make_tetrahedron_soup_domain(points, cells),
                                        Point(0.2, 0.2, 0.2));
  CHECK(found && found->simplex == 1 && found->coordinates.size() == 4);
}

// Far away, the coordinates of a point are large, and so are the rounding errors of their sum.
void test_far_away()
{
  test_case() = "a point far away from a tetrahedron";
  Subject<3> s(tetrahedra());
  for(double distance : {1e3, 1e6, 1e8})
    for(double angle : {0.1, 1.2, 2.3, 3.4, 4.5, 5.6})
    {
      const Point far(distance * std::cos(angle), distance * std::sin(angle), distance / 3);
      const auto found = CGAL::ARAP::locate(s.deformation.domain(), far);
      const auto inserted = s.deformation.insert_control_point(*found);
      CHECK(inserted);
      CHECK_AT_MOST((vector(s.deformation.control_point_position(inserted.point)) -
                     vector(far)).norm(), 1e-12 * distance);
    }
}

void test_function()
{
  test_case() = "arap_deform";
  Mesh mesh = make_mesh<Mesh>(shapes()[2]);
  const auto found = CGAL::ARAP::locate(mesh, Point(0.1, 0.2, 2));
  if(!CHECK(found))
    return;
  const std::vector<std::tuple<Mesh::Face_index, std::vector<double>, Point>> held = {
    {found->simplex, found->coordinates, Point(0.1, 0.2, 1.5)}};
  const std::map<Mesh::Vertex_index, Point> targets = {{Mesh::Vertex_index(5), Point(0, 0, -1)}};
  CHECK(CGAL::arap_deform(mesh, targets, CGAL::parameters::control_points(held)));
  CHECK_AT_MOST((vector(CGAL::ARAP::construct_point(mesh, *found)) -
                 Eigen::Vector3d(0.1, 0.2, 1.5)).norm(), 1e-12);
  const std::vector<std::tuple<Mesh::Face_index, std::array<double, 3>, Point>> wrong = {
    {found->simplex, {1, 1, 1}, Point(0, 0, 0)}};
  const auto refused = CGAL::arap_deform(mesh, targets, CGAL::parameters::control_points(wrong));
  CHECK(refused.status == Status::invalid_coordinates);
  CHECK(refused.message.find("element 0 of control_points: ") == 0);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  CHECK(d.insert_control_point(*found));

  test_case() = "arap_deform, sets and weights";
  using Vertex = Mesh::Vertex_index;
  const Kernel::Plane_3 plane(Point(0, 0, -1), Kernel::Vector_3(1, 2, 3));
  Mesh by_function = make_mesh<Mesh>(shapes()[2]), by_class = by_function;
  const std::map<Vertex, double> weights = {{Vertex(9), 4.0}, {Vertex(12), 0.5}};
  const std::vector<std::pair<Vertex, Point>> points = {{Vertex(5), Point(0, 0, -1)},
                                                        {Vertex(12), Point(0.2, 0.1, 1)}};
  const auto sets = [&plane](int v) {
    return std::map{std::pair(Vertex(v), CGAL::ARAP::projection_onto(plane))};
  };
  const auto np = CGAL::parameters::target_weight(
    weights, CGAL::parameters::target_sets(sets(9), CGAL::parameters::control_points(held)));
  CHECK(CGAL::arap_deform(by_function, points, np));
  CGAL::ARAP_deformation<Mesh> e(by_class);
  e.insert_roi_vertices(by_class.vertices());
  for(const auto& [v, target] : points)
    e.insert_control_vertex(v, target);
  e.insert_control_vertex(Vertex(9));
  for(const auto& [v, weight] : weights)
    CHECK(e.set_target_weight(v, weight));
  CHECK(e.set_target_set(Vertex(9), CGAL::ARAP::projection_onto(plane)));
  const auto inserted = e.insert_control_point(*found);
  CHECK(inserted && e.set_target_position(inserted.point, std::get<2>(held[0])));
  CHECK(e.deform());
  CHECK(same_points(by_function, by_class));
  CHECK(by_class.point(Vertex(5)) == points[0].second);
  CHECK(by_class.point(Vertex(12)) != points[1].second);
  const auto hard = CGAL::arap_deform(by_function, points, CGAL::parameters::target_weight(
    weights, CGAL::parameters::target_sets(sets(10), CGAL::parameters::control_points(held))));
  CHECK(hard.status == Status::invalid_weight); // 10 has an infinite one
  CHECK(hard.message.find("element 0 of target_sets: ") == 0);
  const auto negative = CGAL::arap_deform(
    by_function, std::map<Vertex, Point>(),
    CGAL::parameters::target_weight(-1.0, CGAL::parameters::control_points(held)));
  CHECK(negative.status == Status::invalid_weight);
  CHECK(negative.message.find("element 0 of control_points: ") == 0);
  CHECK(same_points(by_function, by_class));
}

} // namespace locations

template <int Dimension>
void test_all(const Held_shape<Dimension>& shape)
{
  iterates::compare_all(shape);
  solvers::test_all(shape);
  limits::test_all(shape);
  for(bool is_held : {true, false})
    for(const Cell_scheme& cells :
        {Cell_scheme::spokes_and_rims(), Cell_scheme::k_ring(1), Cell_scheme::k_ring(2)})
    {
      histories::test_random_changes<CGAL::Default>(shape, is_held, cells);
      histories::test_random_changes<Compiled_LDLT_solver>(shape, is_held, cells);
    }
  locations::test(shape);
}

// Control points have no rotation, and do not hold the guess of rotations back: one where it goes
// without changes nothing, and several little.
namespace guess {

template <int Dimension>
void test(Held_shape<Dimension> shape)
{
  shape.scenario = scenario(Shape{"", shape.points, {}}, 1.5);
  const auto options = options_for(Cell_scheme::spokes_and_rims(), Minimizer::local_global,
                                   CGAL::ARAP::Initial_guess::rotations);
  Subject<Dimension> without(shape);
  CHECK(without.deformation.set_options(options));
  CHECK(without.deformation.deform(0, 0));
  std::vector<Eigen::Vector3d> expected;
  for(const Point& p : without.points)
    expected.push_back(vector(p));
  const std::vector<std::size_t> places = shape.places(5, 4);
  for(const double weight : {infinite, 1.0, 1e4})
    for(const std::size_t count : {0, 1, 5}) // 0: one at a corner
    {
      test_case() = shape.name + ", guess with " + std::to_string(count) + " points of weight " +
                    std::to_string(weight);
      Subject<Dimension> with(shape);
      CHECK(with.deformation.set_options(options));
      for(std::size_t k = 0; k < (std::max)(count, std::size_t(1)); ++k)
      {
        const std::size_t place = places[count < 5 ? 2 : k];
        const auto& corners = shape.simplices[place];
        std::vector<double> c = coordinates(corners.size(), k);
        if(count == 0)
        {
          c.assign(corners.size(), 0);
          c[0] = 1;
        }
        Eigen::Vector3d shift(0, 0, 0);
        for(std::size_t i = 0; i < corners.size(); ++i)
          shift += c[i] * (expected[corners[i]] - vector(with.points[corners[i]]));
        with.insert(place, c, weight, shift);
      }
      CHECK(with.deformation.deform(0, 0));
      CHECK_AT_MOST(largest_distance(with.points, expected),
                    (count < 5 ? 1e-8 : 0.06) * shape.diameter());
    }
}

void test_all()
{
  test(triangles());
  test(quads());
  test(tetrahedra());
}

} // namespace guess

int main()
{
  test_all(triangles());
  test_all(quads());
  test_all(tetrahedra());
  refusals::test_dependent<CGAL::Default>();
  refusals::test_dependent<Compiled_LDLT_solver>();
  refusals::test_close_pairs();
  refusals::test_input();
  histories::test_stages();
  histories::test_reset();
  histories::test_fixed_corners();
  histories::test_fixed_soft_point();
  histories::test_failing_solver();
  histories::test_constant_pull();
  sets::test_plane();
  sets::test_line_at_vertex();
  sets::test_surface();
  sets::test_refusals();
  sets::test_frames_of_sets();
  locations::test_turned_halfedges();
  locations::test_polygons();
  locations::test_far_flat_triangle();
  locations::test_small_triangle();
  locations::test_thin_triangle();
  locations::test_folded_quad();
  locations::test_cell_of_other_size();
  locations::test_function();
  locations::test_far_away();
  guess::test_all();
  return checks_result();
}
