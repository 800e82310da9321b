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

// Control vertices that are pulled to their targets: the balance of forces at the minimum, the
// limits of large and small weights, rigid motions, and either minimizer.

#include "include/check.h"
#include "include/domains.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using CGAL::ARAP::Initial_guess;
using CGAL::ARAP::Minimizer;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;
using CGAL::ARAP::Status;

const double infinity = std::numeric_limits<double>::infinity();

// a deformation of ranges of points and simplices
template <int Dimension>
struct Soup
{
  using Simplices = std::vector<std::array<std::size_t, Dimension + 1>>;
  using Domain = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;

  Soup(const std::vector<Eigen::Vector3d>& rest_, const Simplices& simplices_,
       const Options& options)
    : rest(rest_), simplices(simplices_), points(points_of(rest)),
      deformation(Domain(points, simplices))
  {
    CHECK(deformation.set_options(options));
    for(std::size_t v = 0; v < points.size(); ++v)
      deformation.insert_roi_vertex(v);
  }

  Soup(const Soup&) = delete; // the domain refers to the points

  void control(std::size_t v, const Eigen::Vector3d& target, double weight)
  {
    deformation.insert_control_vertex(v);
    CHECK(deformation.set_target_position(v, point(target)));
    CHECK(deformation.set_target_weight(v, weight));
  }

  // all that a scenario holds or moves gets a target of this weight
  void control(const Scenario& s, double weight)
  {
    for(std::size_t v = 0; v < points.size(); ++v)
      if(s.selection[v] != 1)
        control(v, s.targets[v], weight);
  }

  double distance_to(const std::vector<Point>& others) const
  {
    return largest_distance(points, others);
  }

  std::vector<Eigen::Vector3d> rest;
  Simplices simplices;
  std::vector<Point> points;
  CGAL::ARAP_deformation<Domain> deformation;
};

Options options_for(Cell_scheme cells, Minimizer minimizer = Minimizer::quasi_newton)
{
  Options options;
  options.cells = cells;
  options.minimizer = minimizer;
  return options;
}

// whether moving the highest vertices bends the shape, and not only moves one of two parts
bool is_in_one_piece(const Shape& shape) { return shape.name.find("two of ") != 0; }

// calls f(name, rest positions, simplices, diameter) for surfaces and for tetrahedra
template <typename Function>
void for_each_shape(const Function& f)
{
  for(const Shape& shape : shapes())
    if(is_in_one_piece(shape))
      f(shape.name, shape.points, shape.triangles, shape.diameter());
  const Block solid = block(6, 2, 2);
  f("block", solid.points, solid.tetrahedra, solid.diameter());
}

template <typename Simplices>
using Soup_of =
  Soup<static_cast<int>(std::tuple_size<typename Simplices::value_type>::value) - 1>;

// The rigidity does not change when the whole moves rigidly. Hence at the minimum the pulls have
// neither a sum nor a torque, and after a step of local/global no sum: what is found by the package
// against a fact that it does not use. Neither minimizer goes upwards, nor quasi-Newton less far.
void test_balance_of_forces()
{
  for_each_shape([](const std::string& name, const auto& rest, const auto& simplices,
                    double diameter) {
    const Scenario s = scenario(Shape{"", rest, {}}, 0.7);
    for(Cell_scheme cells : all_cell_schemes)
      for(double weight : {1e-2, 1.0, 1e3})
      {
        test_case() = "balance of forces, " + name + ", weight " + std::to_string(weight);
        std::vector<double> minima;
        for(Minimizer minimizer : {Minimizer::quasi_newton, Minimizer::local_global})
        {
          const bool is_fast = minimizer == Minimizer::quasi_newton;
          Soup_of<std::decay_t<decltype(simplices)>> soup(rest, simplices,
                                                          options_for(cells, minimizer));
          soup.control(s, weight);
          const Report report = soup.deformation.deform(is_fast ? 600 : 150, 0);
          CHECK(report.status == Status::iteration_limit);
          CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
          minima.push_back(report.energy.back());

          Eigen::Vector3d sum(0, 0, 0), torque(0, 0, 0);
          double size = 0;
          for(std::size_t v = 0; v < rest.size(); ++v)
            if(s.selection[v] != 1)
            {
              const Eigen::Vector3d x = vector(soup.points[v]), pull = weight * (s.targets[v] - x);
              sum += pull;
              torque += x.cross(pull);
              size += pull.norm();
            }
          CHECK_AT_MOST(sum.norm(), (is_fast ? 1e-4 : 1e-9) * size);
          if(is_fast)
            CHECK_AT_MOST(torque.norm(), 1e-4 * size * diameter);
        }
        CHECK_AT_MOST(minima[0], minima[1] * (1 + 1e-5));
      }
  });
}

// As the weight grows the result tends to that of hard targets, by a tenth for ten times the
// weight. A weight of zero makes a free vertex.
void test_limits()
{
  for_each_shape([](const std::string& name, const auto& rest, const auto& simplices,
                    double diameter) {
    test_case() = "limits, " + name;
    const Scenario s = scenario(Shape{"", rest, {}}, 0.3);
    const Options options = options_for(Cell_scheme::spokes_and_rims());
    using Soup_ = Soup_of<std::decay_t<decltype(simplices)>>;
    Soup_ hard(rest, simplices, options);
    hard.control(s, infinity);
    CHECK(hard.deformation.deform(400, 0));
    const auto distance = [&](double weight) {
      Soup_ soft(rest, simplices, options);
      soft.control(s, weight);
      CHECK(soft.deformation.deform(400, 0));
      return soft.distance_to(hard.points);
    };
    const double near = distance(1e4);
    CHECK_AT_MOST(near, 1e-3 * diameter);
    CHECK_AT_MOST(std::abs(near / distance(1e5) - 10), 0.5);
    for(double weight : {1e12, 1e30, 1e100})
      CHECK_AT_MOST(distance(weight), 1e-8 * diameter);

    Soup_ none(rest, simplices, options), zero(rest, simplices, options);
    none.control(s, infinity);
    zero.control(s, infinity);
    const auto last = none.deformation.control_vertices().back();
    none.deformation.erase_control_vertex(last);
    CHECK(zero.deformation.set_target_weight(last, 0));
    CHECK(none.deformation.deform(10, 0) && zero.deformation.deform(10, 0));
    CHECK_AT_MOST(zero.distance_to(none.points), 1e-10 * diameter);
  });
}

// Targets that are a rigid motion of the rest shape, also to far away, move the whole rigidly,
// whatever their weights, and then it stays where it is.
void test_rigid_motion()
{
  for_each_shape([](const std::string& name, const auto& rest, const auto& simplices,
                    double diameter) {
    for(double distance : {1.0, 1e4})
    {
      test_case() = "rigid motion, " + name + ", by " + std::to_string(distance);
      const Eigen::Isometry3d motion = rigid_motion(
        0.8, Eigen::Vector3d(1, 3, 2), Eigen::Vector3d(0.5, 0.1, 0.7) * (distance * diameter));
      const double rounding = distance * distance * 1e-20; // of the energy
      Soup_of<std::decay_t<decltype(simplices)>> soup(
        rest, simplices,
        options_for(distance > 1 ? Cell_scheme::spokes() : Cell_scheme::spokes_and_rims()));
      std::vector<Point> moved;
      for(std::size_t v = 0; v < rest.size(); ++v)
      {
        moved.push_back(point(motion * rest[v]));
        if(v % 3 == 0 || rest.size() < 7)
          soup.control(v, motion * rest[v], 0.01 + double(v % 7));
      }
      const Report report = soup.deformation.deform(1000, 1e-12);
      CHECK(report.status == Status::converged);
      CHECK_AT_MOST(report.energy.back(), rounding * report.energy_scale);
      CHECK_AT_MOST(soup.distance_to(moved), 1e-8 * distance * diameter);

      const std::vector<Point> before = soup.points;
      CHECK_AT_MOST(soup.deformation.deform(20, 0).energy[0], rounding * report.energy_scale);
      CHECK_AT_MOST(soup.distance_to(before), 1e-8 * distance * diameter);
    }
  });
}

// The estimated gap counts the pulls as well: a run to a tolerance ends about that close to the
// minimum. Weak pulls take longest: the whole has to turn, which costs nothing but iterations.
void test_tolerance()
{
  for(const Shape& shape : shapes())
    for(double weight : {1e-3, 1e-2, 1.0, 1e2})
    {
      test_case() = "tolerance, " + shape.name + ", weight " + std::to_string(weight);
      const Scenario s = scenario(shape, 0.5);
      Soup<2> soup(shape.points, shape.triangles, options_for(Cell_scheme::spokes_and_rims()));
      soup.control(s, weight);
      const Report report = soup.deformation.deform(2000, 1e-3);
      CHECK(report.status == Status::converged);
      const double minimum = soup.deformation.deform(1000, 0).energy.back();
      if(is_in_one_piece(shape))
        CHECK_AT_MOST(report.energy.back(), minimum * (1 + 2e-3));
      else
        CHECK_AT_MOST(report.energy.back(), 1e-20 * report.energy_scale);
    }
}

// What tells about a control vertex.
void test_targets_and_weights()
{
  test_case() = "targets and weights";
  const Shape shape = shapes()[5];
  Soup<2> soup(shape.points, shape.triangles, Options());
  auto& d = soup.deformation;
  const std::size_t a = 0, b = shape.points.size() - 1;
  const Point target(3, 2, 1);
  CHECK(d.insert_control_vertex(a) && d.insert_control_vertex(b));
  CHECK(d.target_weight(a) == infinity);
  CHECK(d.set_target_position(b, target));
  CHECK(d.set_target_weight(b, 0.25));
  CHECK(!d.insert_control_vertex(b)); // as it is already
  CHECK(d.is_control_vertex(b) && d.target_weight(b) == 0.25 && d.target_position(b) == target);
  const Report report = d.deform();
  CHECK(report.free_vertices == shape.points.size() - 1);
  CHECK(soup.points[a] == point(shape.points[a]));
  CHECK(soup.points[b] != target && soup.points[b] != point(shape.points[b]));
  CHECK(d.target_position(b) == target);

  // refused, and nothing is changed
  const std::vector<Point> before = soup.points;
  for(double bad : {-1.0, -infinity, std::nan("")})
  {
    const CGAL::ARAP::Outcome outcome = d.set_target_weight(b, bad);
    CHECK(outcome.status == Status::invalid_weight);
    CHECK(outcome.message.find("vertex " + std::to_string(b)) == 0);
    CHECK(d.target_weight(b) == 0.25);
  }
  CHECK(d.set_target_position(b, Point(0, std::nan(""), 0)));
  const Report refused = d.deform();
  CHECK(refused.status == Status::non_finite_point);
  CHECK(refused.message.find("the target of vertex " + std::to_string(b)) == 0);
  CHECK(soup.points == before);
  CHECK(d.set_target_position(b, target));

  // the same weight again needs no preprocessing, and keeps the energy
  CHECK(d.set_target_weight(b, 0.25));
  CHECK(d.energy() == report.energy.back());
  CHECK(d.set_target_weight(b, 0.5));
  CHECK(std::isnan(d.energy()));

  // a range, up to the first that is refused
  const std::size_t both[] = {a, b};
  CHECK(d.set_target_weight(std::begin(both), std::end(both), 7));
  CHECK(d.target_weight(a) == 7 && d.target_weight(b) == 7);

  // a control vertex that was none begins hard
  CHECK(d.erase_control_vertex(b) && d.insert_control_vertex(b));
  CHECK(d.target_weight(b) == infinity);
  CHECK(d.set_target_weight(b, 2));
  d.reset();
  CHECK(soup.points == points_of(shape.points));
  CHECK(d.target_weight(b) == 2 && d.target_position(b) == point(shape.points[b]));
  const Report rest = d.deform(10, 0);
  CHECK_AT_MOST(rest.energy[0], 1e-20);
  CHECK_AT_MOST(soup.distance_to(points_of(shape.points)), 1e-12);

  // a visitor that cancels
  CHECK(d.set_target_position(b, target));
  CHECK(d.deform([](const auto& iterate) {
    return iterate.iteration() == 2 ? CGAL::ARAP::Visitor_action::cancel
                                    : CGAL::ARAP::Visitor_action::proceed;
  }).status == Status::cancelled);
  CHECK_AT_MOST(soup.distance_to(points_of(shape.points)), 1e-12);
}

// What nothing holds, or pulls with more than nothing, stays where it is.
void test_components()
{
  test_case() = "components";
  const Shape shape = two_components(shapes()[4]);
  Soup<2> soup(shape.points, shape.triangles, Options());
  const std::size_t n = shape.points.size();
  soup.control(n - 1, shape.points[n - 1] + Eigen::Vector3d(0, 0, 1), 0);
  CHECK(soup.deformation.deform().status == Status::no_fixed_vertex);
  soup.control(0, shape.points[0], 1e-9);
  const Report report = soup.deformation.deform();
  CHECK(report);
  CHECK(report.unconstrained_components == std::vector<std::size_t>(1, n / 2));
  CHECK(soup.points[n - 1] == point(shape.points[n - 1]));
  CHECK(soup.deformation.set_target_weight(n - 1, 3));
  CHECK(soup.deformation.deform().unconstrained_components.empty());
  const Eigen::Vector3d moved = vector(soup.points[n - 1]) - shape.points[n - 1];
  CHECK_AT_MOST((moved - Eigen::Vector3d(0, 0, 1)).norm(), 1e-6); // nothing holds it back
}

// A vertex without simplices goes to its target if anything pulls it there.
void test_isolated_vertex()
{
  test_case() = "isolated vertex";
  Shape shape = shapes()[4];
  const std::size_t isolated = shape.points.size();
  const Eigen::Vector3d place(7, 7, 7), target(9, 1, 2);
  shape.points.push_back(place);
  for(Cell_scheme cells : all_cell_schemes)
    for(double weight : {0.0, 1e-3, 1e3, infinity})
    {
      Soup<2> soup(shape.points, shape.triangles, options_for(cells));
      soup.control(0, shape.points[0], 1);
      soup.control(isolated, target, weight);
      CHECK(soup.deformation.deform(5, 0));
      CHECK_AT_MOST((vector(soup.points[isolated]) - (weight > 0 ? target : place)).norm(), 1e-12);
    }
}

// For the initial guess of naive Laplacian editing all targets are hard.
void test_initial_guess()
{
  for(const Shape& shape : shapes())
  {
    test_case() = "initial guess, " + shape.name;
    const Scenario s = scenario(shape, 0.5);
    Options options;
    options.initial_guess = Initial_guess::laplacian;
    std::vector<std::vector<Point>> guesses;
    for(double weight : {infinity, 1.0})
    {
      Soup<2> soup(shape.points, shape.triangles, options);
      soup.control(s, weight);
      CHECK(soup.deformation.deform(0, 0));
      guesses.push_back(soup.points);
      if(weight != infinity)
        CHECK_AT_MOST(soup.distance_to(guesses[0]), 1e-9 * shape.diameter());
      const Report report = soup.deformation.deform(30, 0);
      CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    }
    // nothing but soft control vertices
    Soup<2> soup(shape.points, shape.triangles, options);
    for(std::size_t v = 0; v < shape.points.size(); ++v)
      soup.control(v, s.targets[v], 1);
    CHECK(soup.deformation.deform(0, 0));
    CHECK(soup.points == points_of(s.targets));
  }
}

// The result does not depend on the unit of length; on a surface weights have none, and in a solid
// they are lengths.
void test_units()
{
  for_each_shape([](const std::string& name, const auto& rest, const auto& simplices,
                    double diameter) {
    test_case() = "units, " + name;
    using Soup_ = Soup_of<std::decay_t<decltype(simplices)>>;
    const bool is_solid = simplices[0].size() == 4;
    const Scenario s = scenario(Shape{"", rest, {}}, 0.5);
    Soup_ usual(rest, simplices, Options());
    usual.control(s, 1);
    CHECK(usual.deformation.deform(8, 0));
    for(double factor : {1e-12, 1e12})
    {
      std::vector<Eigen::Vector3d> scaled_rest = rest;
      Scenario scaled = s;
      for(auto* points : {&scaled_rest, &scaled.targets})
        for(auto& p : *points)
          p *= factor;
      Soup_ soup(scaled_rest, simplices, Options());
      soup.control(scaled, is_solid ? factor : 1);
      CHECK(soup.deformation.deform(8, 0));
      for(std::size_t v = 0; v < rest.size(); ++v)
        CHECK_AT_MOST((vector(soup.points[v]) / factor - vector(usual.points[v])).norm(),
                      1e-10 * diameter);
    }
  });
}

int main()
{
  test_balance_of_forces();
  test_limits();
  test_rigid_motion();
  test_tolerance();
  test_targets_and_weights();
  test_components();
  test_isolated_vertex();
  test_initial_guess();
  test_units();
  return checks_result();
}
