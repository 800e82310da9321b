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

// Time steps with inertia: against the dense reference, and by what mechanics says of motions.

#include "include/check.h"
#include "include/compiled_solvers.h"
#include "include/dense_reference.h"
#include "include/domains.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/ARAP_deformation_traits.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

using CGAL::ARAP::Coordinates;
using CGAL::ARAP::Dynamics;
using CGAL::ARAP::Minimizer;
using CGAL::ARAP::Status;
using CGAL::ARAP::Step_report;
using Eigen::Vector3d;
using Simplices = std::vector<Dense_reference::Simplex>;
using Terms = Dense_reference::Terms;

template <int Dimension>
using Soup = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;
template <int Dimension>
using Deformation = CGAL::ARAP_deformation<Soup<Dimension>>;

struct Model
{
  std::vector<Vector3d> points;
  Simplices simplices;
};

template <int Dimension>
Model make_model()
{
  if constexpr(Dimension == 3)
  {
    const Block solid = block(3, 1, 2);
    return {solid.points, as_polygons(solid.tetrahedra)};
  }
  else
  {
    const Shape sheet = grid("sheet", 5, 4, [](double u, double v) {
      return Vector3d(2 * u, 1.5 * v, 0.3 * std::sin(3 * u) * v);
    });
    return {sheet.points, as_polygons(sheet.triangles)};
  }
}

// the shares of the vertices in area or volume
std::vector<double> contents(const Model& model)
{
  std::vector<double> result(model.points.size(), 0);
  for(const auto& s : model.simplices)
  {
    const Vector3d a = model.points[s[1]] - model.points[s[0]],
                   b = model.points[s[2]] - model.points[s[0]];
    double content = a.cross(b).norm() / 2;
    if(s.size() == 4)
      content = std::abs(a.cross(b).dot(model.points[s[3]] - model.points[s[0]])) / 6;
    for(std::size_t v : s)
      result[v] += content / double(s.size());
  }
  return result;
}

Dense_reference::Cells dense(Cell_scheme cells)
{
  return cells.edge_set() == CGAL::ARAP::Edge_set::star ? Dense_reference::SPOKES
         : cells == Cell_scheme::spokes_and_rims()      ? Dense_reference::SPOKES_AND_RIMS
                                                        : Dense_reference::ELEMENTS;
}

Vector3d eigen(const Coordinates& c) { return {c[0], c[1], c[2]}; }

// some motion that is not rigid
Vector3d swirl(const Vector3d& p)
{
  return Vector3d(0.3 - p.y(), p.x() + 0.4 * p.z(), 0.5 * std::sin(2 * p.x()));
}

CGAL::ARAP::Options options(Cell_scheme cells, Minimizer minimizer, double tolerance = 1e-9)
{
  CGAL::ARAP::Options result = options_for(cells, minimizer);
  result.tolerance = tolerance;
  return result;
}

Terms terms_of(Cell_scheme cells)
{
  Terms terms;
  terms.rings = cells.rings();
  return terms;
}

// stiffness, bending and a frame at vertex 0
Terms some_terms(Cell_scheme cells, std::size_t n)
{
  Terms terms = terms_of(cells);
  for(std::size_t k = 0; k < n; ++k)
    terms.stiffness.push_back(0.5 + 0.2 * double(k % 7));
  terms.bending_length = 0.2;
  terms.frames[0] = Eigen::AngleAxisd(0.3, Vector3d(1, 2, 2) / 3).toRotationMatrix();
  return terms;
}

// Steps against the dense reference: the same iterates with local/global, the same minimum with
// both minimizers.
template <int Dimension>
void compare(Cell_scheme cells, bool has_handles, Minimizer minimizer, bool has_terms = false)
{
  const Model model = make_model<Dimension>();
  const Terms terms = has_terms ? some_terms(cells, model.points.size()) : terms_of(cells);
  const std::size_t n = model.points.size();
  std::vector<Point> points = points_of(model.points);
  Deformation<Dimension> deformation(Soup<Dimension>(points, model.simplices));
  deformation.insert_roi_vertices(numbers(n));
  const bool is_local_global = minimizer == Minimizer::local_global;
  CGAL::ARAP::Options o = options(cells, minimizer, is_local_global ? 0 : 1e-12);
  o.iterations = is_local_global ? 5 : 1000;
  o.bending_length = terms.bending_length;
  if(has_terms)
    deformation.set_stiffness(terms.stiffness);
  CHECK(deformation.set_options(o));
  Dynamics dynamics;
  dynamics.time_step = 0.05;
  dynamics.density = 3;
  dynamics.modulus = 20;
  dynamics.damping = 0.7;
  dynamics.acceleration = {0.5, -2, -9};
  const double h = dynamics.time_step, damping = 1 + dynamics.damping * h;
  const std::map<std::size_t, Vector3d> forces = {{1, {3, 0, -1}}, {n - 2, {0, 5, 2}}};
  std::vector<int> selection(n, 1);
  std::vector<Vector3d> x = model.points, v(n);
  for(std::size_t k = 0; k < n; ++k)
  {
    v[k] = swirl(x[k]);
    CHECK(deformation.set_velocity(k, v[k]));
  }
  const std::vector<double> content = contents(model);
  for(int step = 0; step < 3; ++step)
  {
    std::vector<Vector3d> before = x;
    if(has_handles)
      for(std::size_t k : {std::size_t(0), n - 1})
      {
        selection[k] = 2;
        x[k] += Vector3d(0.02, 0.01 * step, 0);
        deformation.insert_control_vertex(k, point(x[k]));
      }
    for(const auto& [k, rotation] : terms.frames)
      CHECK(deformation.set_target_rotation(k, rotation));
    Dense_reference reference(model.points, model.simplices, Dimension, selection, dense(cells),
                              Dense_reference::SAFE, terms);
    for(std::size_t k = 0; k < n; ++k)
      if(selection[k] == 1)
      {
        const double mass = dynamics.density * content[k];
        Vector3d a = eigen(dynamics.acceleration);
        if(forces.count(k))
          a += forces.at(k) / mass;
        x[k] += (h * v[k] + h * h * a) / damping;
        reference.add_soft_position(k, mass * damping / (2 * h * h * dynamics.modulus), x[k]);
      }
    const Step_report report = deformation.advance(dynamics, forces);
    if(!CHECK(report))
    {
      std::cerr << "    " << report.message << std::endl;
      return;
    }
    for(int k = 0; k < (is_local_global ? 5 : 100); ++k)
    {
      if(is_local_global)
        CHECK_AT_MOST(std::abs(report.energy[std::size_t(k)] - reference.energy(x)),
                      1e-10 * report.energy_scale);
      reference.iterate(x);
    }
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    CHECK_AT_MOST(report.final_energy() - reference.energy(x), 1e-10 * report.energy_scale);
    CHECK_AT_MOST(largest_distance(points, x), is_local_global ? 1e-10 : 1e-5);
    CHECK(report.stages.factor == (step == 0));
    // the quantities of the report, spelled out
    double mass = 0, kinetic = 0;
    Vector3d momentum(0, 0, 0), moment(0, 0, 0), center(0, 0, 0);
    for(std::size_t k = 0; k < n; ++k)
    {
      x[k] = vector(points[k]); // the next step starts where the package is
      v[k] = (x[k] - before[k]) / h;
      CHECK_AT_MOST((eigen(deformation.velocity(k)) - v[k]).norm(), 1e-11);
      if(selection[k] != 1)
        continue;
      const double m = dynamics.density * content[k];
      mass += m;
      kinetic += m * v[k].squaredNorm() / 2;
      momentum += m * v[k];
      center += m * x[k];
      moment += m * x[k].cross(v[k]);
    }
    center /= mass;
    CHECK_AT_MOST(std::abs(report.mass - mass), 1e-12 * mass);
    CHECK_AT_MOST((eigen(report.center_of_mass) - center).norm(), 1e-12);
    CHECK_AT_MOST((eigen(report.momentum) - momentum).norm(), 1e-10);
    CHECK_AT_MOST((eigen(report.angular_momentum) + center.cross(momentum) - moment).norm(), 1e-10);
    CHECK_AT_MOST(std::abs(report.kinetic_energy - kinetic), 1e-10);
    Dense_reference shape(model.points, model.simplices, Dimension, std::vector<int>(n, 1),
                          dense(cells), Dense_reference::SAFE, terms);
    CHECK_AT_MOST(std::abs(report.elastic_energy - dynamics.modulus * shape.energy(x)), 1e-10);
  }
}

// A free body spins and swings, and falls if there is gravity. The momentum is right with any
// tolerance.
template <int Dimension>
void conserve(Cell_scheme cells, Minimizer minimizer, double gravity, int steps,
              double tolerance = 1e-9)
{
  const Model model = make_model<Dimension>();
  std::vector<Point> points = points_of(model.points);
  Deformation<Dimension> deformation(Soup<Dimension>(points, model.simplices));
  deformation.insert_roi_vertices(numbers(points.size()));
  CHECK(deformation.set_options(options(cells, minimizer, tolerance)));
  Dynamics dynamics;
  dynamics.time_step = 0.01;
  dynamics.modulus = 10;
  dynamics.acceleration = {0, 0, -gravity};
  const std::vector<double> content = contents(model);
  Vector3d momentum(0, 0, 0);
  double energy = 0, largest_moment = 0, moment = 0;
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    const Vector3d velocity = swirl(model.points[v]);
    CHECK(deformation.set_velocity(v, velocity));
    momentum += content[v] * velocity;
    energy += content[v] * velocity.squaredNorm() / 2;
  }
  const double first_energy = energy; // without that of gravity
  for(std::size_t v = 0; v < points.size(); ++v)
    energy += content[v] * gravity * points[v].z();
  for(int step = 0; step < steps; ++step)
  {
    const Step_report report = deformation.advance(dynamics);
    if(!CHECK(report))
      return;
    CHECK(report.stages.region == (step == 0) && report.stages.factor == (step == 0));
    CHECK(report.unconstrained_components.empty());
    momentum += dynamics.time_step * report.mass * eigen(dynamics.acceleration);
    CHECK_AT_MOST((eigen(report.momentum) - momentum).norm(), 1e-10 * momentum.norm());
    if(tolerance > 1e-6)
      continue;
    const double sum = report.kinetic_energy + report.elastic_energy +
                       gravity * report.mass * report.center_of_mass[2];
    CHECK_AT_MOST(sum, energy + 1e-9 * first_energy);
    energy = sum;
    moment = eigen(report.angular_momentum).norm();
    if(step == 0)
      largest_moment = moment;
    CHECK_AT_MOST(moment, largest_moment * (1 + 1e-6));
    largest_moment = (std::max)(moment, largest_moment);
  }
  if(tolerance > 1e-6)
    return;
  if(gravity == 0)
    std::cout << test_case() << ": of the energy " << energy / first_energy
              << " is left, of the angular momentum " << moment / largest_moment << std::endl;
  CHECK(moment > 0.9 * largest_moment);
}

// A body without control vertices falls, and keeps its shape: after n steps without damping by
// n h v + n (n + 1) / 2 h^2 g.
template <int Dimension>
void fall(Cell_scheme cells, Minimizer minimizer)
{
  const Model model = make_model<Dimension>();
  std::vector<Point> points = points_of(model.points);
  Deformation<Dimension> deformation(Soup<Dimension>(points, model.simplices));
  deformation.insert_roi_vertices(numbers(points.size()));
  CHECK(deformation.set_options(options(cells, minimizer)));
  Dynamics dynamics;
  dynamics.time_step = 0.02;
  dynamics.acceleration = {0, 0, -10};
  const Vector3d velocity(1, 2, 3);
  for(std::size_t v = 0; v < points.size(); ++v)
    CHECK(deformation.set_velocity(v, velocity));
  Vector3d way(0, 0, 0), v = velocity;
  for(int step = 1; step <= 100; ++step)
  {
    dynamics.damping = step <= 50 ? 0 : 0.5; // another matrix
    v = (v + dynamics.time_step * eigen(dynamics.acceleration)) /
        (1 + dynamics.damping * dynamics.time_step);
    way += dynamics.time_step * v;
    const Step_report report = deformation.advance(dynamics);
    if(!CHECK(report))
      return;
    // rounding errors are known for what they are; the steps add them up, and large cells turn
    // after few of them
    CHECK_AT_MOST(report.iterations, cells.rings() > 0 ? 1.0 : 0.0);
    std::vector<Vector3d> expected = model.points;
    for(auto& p : expected)
      p += way;
    CHECK_AT_MOST(largest_distance(points, expected), 1e-11);
    CHECK_AT_MOST(std::abs(report.elastic_energy), 1e-20);
  }
}

// A soft target is a spring: what a free body gains of momentum are its forces and the weight.
template <int Dimension>
void pull(Cell_scheme cells, Minimizer minimizer)
{
  const Model model = make_model<Dimension>();
  std::vector<Point> points = points_of(model.points);
  Deformation<Dimension> deformation(Soup<Dimension>(points, model.simplices));
  deformation.insert_roi_vertices(numbers(points.size()));
  CHECK(deformation.set_options(options(cells, minimizer)));
  const std::map<std::size_t, double> weights = {{0, 0.3}, {7, 2}};
  std::map<std::size_t, Vector3d> targets;
  for(const auto& [v, weight] : weights)
  {
    targets[v] = model.points[v] + Vector3d(0.3, -0.2, 0.5);
    deformation.insert_control_vertex(v, point(targets[v]));
    CHECK(deformation.set_target_weight(v, weight));
  }
  Dynamics dynamics;
  dynamics.time_step = 0.02;
  dynamics.modulus = 5;
  dynamics.damping = 0.4;
  dynamics.acceleration = {0, 0, -10};
  const double h = dynamics.time_step;
  Vector3d momentum(0, 0, 0);
  for(int step = 0; step < 30; ++step)
  {
    const Step_report report = deformation.advance(dynamics);
    if(!CHECK(report))
      return;
    Vector3d force = report.mass * eigen(dynamics.acceleration);
    for(const auto& [v, weight] : weights)
      force += 2 * dynamics.modulus * weight * (targets[v] - vector(points[v]));
    momentum = (momentum + h * force) / (1 + h * dynamics.damping);
    CHECK_AT_MOST((eigen(report.momentum) - momentum).norm(), 1e-7 * h * force.norm());
    momentum = eigen(report.momentum);
  }
}

// A hanging body comes to rest where its elastic forces bear its weight.
template <int Dimension>
void hang(Cell_scheme cells, Minimizer minimizer)
{
  const Model model = make_model<Dimension>();
  const std::size_t n = model.points.size();
  std::vector<Point> points = points_of(model.points);
  Deformation<Dimension> deformation(Soup<Dimension>(points, model.simplices));
  deformation.insert_roi_vertices(numbers(n));
  std::vector<int> selection(n, 1);
  for(std::size_t v : {0, 1, 2, 3})
  {
    deformation.insert_control_vertex(v);
    selection[v] = 0;
  }
  const bool is_local_global = minimizer == Minimizer::local_global;
  CHECK(deformation.set_options(options(cells, minimizer, is_local_global ? 1e-9
                                                                                     : 1e-12)));
  Dynamics dynamics;
  dynamics.time_step = 1;
  dynamics.modulus = 40;
  dynamics.damping = 2;
  dynamics.acceleration = {1, 0, -3};
  for(int step = 0; step < 40; ++step)
  {
    const Step_report report = deformation.advance(dynamics);
    CHECK(report);
    if(step == 39)
      CHECK_AT_MOST(report.kinetic_energy, is_local_global ? 1e-10 : 1e-14);
  }
  std::vector<Vector3d> x;
  for(const Point& p : points)
    x.push_back(vector(p));
  CHECK(largest_distance(x, model.points) > 0.02);
  Dense_reference reference(model.points, model.simplices, Dimension, selection, dense(cells),
                            Dense_reference::SAFE, terms_of(cells));
  const std::vector<double> content = contents(model);
  for(std::size_t v = 4; v < n; ++v)
    for(int k = 0; k < 3; ++k) // the derivative of mu E - m a x
    {
      const double eps = 1e-5;
      auto shifted = [&](double s) {
        std::vector<Vector3d> y = x;
        y[v][k] += s;
        return dynamics.modulus * reference.energy(y);
      };
      const double force = content[v] * dynamics.acceleration[std::size_t(k)];
      // larger cells have as many times the energy as they have stars
      CHECK_AT_MOST(std::abs((shifted(eps) - shifted(-eps)) / (2 * eps) - force),
                    (is_local_global ? 1e-3 : 1e-6) * (1 + 6 * cells.rings()));
    }
}

// A step starts from where the vertices are and how they move, whatever the initial guess of the
// options.
void initial_guess()
{
  test_case() = "a step whatever the initial guess";
  const Model model = make_model<3>();
  const std::size_t n = model.points.size();
  std::vector<std::vector<Point>> results;
  for(const auto guess : {CGAL::ARAP::Initial_guess::previous, CGAL::ARAP::Initial_guess::automatic,
                          CGAL::ARAP::Initial_guess::laplacian})
  {
    std::vector<Point> points = points_of(model.points);
    Deformation<3> deformation(Soup<3>(points, model.simplices));
    CGAL::ARAP::Options options = deformation.options();
    options.initial_guess = guess;
    options.iterations = 2;
    CHECK(deformation.set_options(options));
    deformation.insert_roi_vertices(numbers(n));
    deformation.insert_control_vertex(0);
    deformation.insert_control_vertex(n - 1, point(model.points[n - 1] + Vector3d(0, 0, 2)));
    const Step_report report = deformation.advance(Dynamics());
    CHECK(report && report.initial_guess == CGAL::ARAP::Initial_guess::previous);
    results.push_back(points);
  }
  CHECK(results[0] == results[1] && results[0] == results[2]);
  std::vector<Point> falling = points_of(model.points); // nothing has to be held
  Deformation<3> free(Soup<3>(falling, model.simplices));
  free.insert_roi_vertices(numbers(n));
  CHECK(free.advance(Dynamics()).message.find("control") == std::string::npos);
}

// What is held moves with the velocity that takes it to its target, also far from all that is free.
void velocities_of_controls()
{
  test_case() = "velocities of control vertices";
  const Model model = make_model<2>();
  const std::size_t n = model.points.size();
  std::vector<Point> points = points_of(model.points);
  Deformation<2> deformation(Soup<2>(points, model.simplices));
  deformation.insert_roi_vertices(numbers(n));
  const auto step_of = [](std::size_t v) { return Vector3d(0, 0.1, 0.01 * double(v)); };
  for(std::size_t v = 1; v < n; ++v)
    deformation.insert_control_vertex(v, point(model.points[v] + step_of(v)));
  Dynamics dynamics;
  dynamics.time_step = 0.5;
  CHECK(deformation.advance(dynamics));
  for(std::size_t v = 1; v < n; ++v)
    CHECK_AT_MOST((eigen(deformation.velocity(v)) - 2 * step_of(v)).norm(), 1e-12);
}

// The energy does not depend on the unit of the modulus, even where the elastic energy would lose
// digits.
void tiny_modulus()
{
  test_case() = "a tiny modulus";
  const Model model = make_model<3>();
  std::vector<double> energies;
  for(const double unit : {1.0, std::ldexp(1.0, -1010)})
  {
    std::vector<Point> points = points_of(model.points);
    Deformation<3> deformation(Soup<3>(points, model.simplices));
    deformation.insert_roi_vertices(numbers(model.points.size()));
    CHECK(deformation.set_velocity(0, Vector3d(1e-6, 0, 0)));
    Dynamics dynamics;
    dynamics.time_step = 1;
    dynamics.density = dynamics.modulus = unit;
    CHECK(deformation.advance(dynamics));
    energies.push_back(deformation.energy());
  }
  CHECK(energies[0] > 0);
  CHECK_AT_MOST(std::abs(energies[1] / energies[0] - 1), 1e-12);
}

// What a state holds, what is refused, and what the other constraints do in a step.
void undo_and_refuse()
{
  const Model model = make_model<3>();
  const std::size_t n = model.points.size();
  std::vector<Point> points = points_of(model.points);
  Deformation<3> deformation(Soup<3>(points, model.simplices));
  deformation.insert_roi_vertices(numbers(n));
  deformation.erase_roi_vertex(5);
  CHECK(!deformation.set_velocity(5, Vector3d(1, 0, 0)));
  CHECK(deformation.set_velocity(6, Vector3d(1, 0, 0))); // it is at rest when it comes back
  CHECK(deformation.erase_roi_vertex(6) && deformation.insert_roi_vertex(6));
  CHECK(deformation.velocity(6) == (Coordinates{0, 0, 0}));
  deformation.insert_control_vertex(0);
  deformation.insert_control_vertex(n - 1, point(model.points[n - 1] + Vector3d(0, 0, 0.2)));
  CHECK(deformation.set_target_weight(n - 1, 0.7));
  const auto insertion = deformation.insert_control_point(7, {0.25, 0.25, 0.25, 0.25});
  CHECK(insertion);
  const CGAL::ARAP::Control_point inside = insertion.point;
  Dynamics dynamics;
  dynamics.acceleration = {0, 0, -9.81};
  CHECK(deformation.velocity(3) == (Coordinates{0, 0, 0}));
  const Point held = deformation.control_point_position(inside);
  const auto run = [&] {
    for(int step = 0; step < 5; ++step)
    {
      const Step_report report = deformation.advance(dynamics);
      CHECK(report);
      CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
      CHECK_AT_MOST(sum_of_phases(report.seconds), report.seconds.total + 1e-6);
      CHECK_AT_MOST(std::abs(deformation.energy() * dynamics.modulus - report.elastic_energy),
                    1e-15);
    }
    std::vector<Coordinates> velocities;
    for(std::size_t v = 0; v < n; ++v)
      velocities.push_back(deformation.velocity(v));
    return velocities;
  };
  run();
  CHECK_AT_MOST((vector(deformation.control_point_position(inside)) - vector(held)).norm(), 1e-12);
  const auto state = deformation.state();
  const std::vector<Point> before = points;
  const std::vector<Coordinates> velocities = run();
  const std::vector<Point> after = points;
  CHECK(deformation.restore(state));
  CHECK(points == before);
  CHECK(run() == velocities && points == after); // bit by bit: the factor is the same

  // a restored state has velocities, also after runs without inertia, which make them zero
  CHECK(deformation.deform());
  CHECK(deformation.velocity(3) == (Coordinates{0, 0, 0}));
  CHECK(deformation.restore(state));
  CHECK(points == before && deformation.velocity(3) != (Coordinates{0, 0, 0}));
  run();
  CHECK_AT_MOST(largest_distance(points, after), 1e-10);
  CHECK(deformation.restore(state));
  const double energy = deformation.energy();
  const CGAL::ARAP::Report alone = deformation.deform(3, 0);
  CHECK(alone); // no inertia is left in it
  CHECK_AT_MOST(std::abs(alone.energy[0] - energy), 1e-12);

  // nothing is changed by what is refused
  CHECK(deformation.restore(state));
  const auto refused = [&](auto change, const std::string& name) {
    Dynamics wrong = dynamics;
    change(wrong);
    const Step_report report = deformation.advance(wrong);
    CHECK(report.status == Status::invalid_option);
    CHECK(report.message.find(name) != std::string::npos);
    CHECK(points == before);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](Dynamics& d) { d.time_step = 0; }, "time_step");
  refused([&](Dynamics& d) { d.density = nan; }, "density");
  for(const double time_step : {1e-160, 1e200}) // alone it is right
    refused([=](Dynamics& d) { d.time_step = time_step; }, "inertia");
  refused([](Dynamics& d) { d.modulus = -1; }, "modulus");
  refused([](Dynamics& d) { d.damping = -1; }, "damping");
  refused([&](Dynamics& d) { d.acceleration[1] = nan; }, "acceleration");
  const std::map<std::size_t, Vector3d> forces = {{4, {0, nan, 0}}};
  const Step_report report = deformation.advance(dynamics, forces);
  CHECK(report.status == Status::non_finite_point);
  CHECK(report.message.find("vertex 4") != std::string::npos);
  CHECK(points == before && deformation.velocity(4) != (Coordinates{0, 0, 0}));

  // a visitor sees each iterate; what it cancels has not happened
  using CGAL::ARAP::Visitor_action;
  const std::map<std::size_t, Vector3d> no_forces;
  const Coordinates velocity = deformation.velocity(4);
  int visits = 0;
  const Step_report cancelled = deformation.advance(dynamics, no_forces, [&](const auto&) {
    return ++visits < 2 ? Visitor_action::proceed : Visitor_action::cancel;
  });
  CHECK(cancelled.status == Status::cancelled && visits == 2);
  CHECK(points == before && deformation.velocity(4) == velocity);
  std::vector<double> energies;
  const Step_report seen = deformation.advance(dynamics, no_forces, [&](const auto& iterate) {
    energies.push_back(iterate.energy());
    return Visitor_action::proceed;
  });
  CHECK(seen && energies.size() > 1 && energies == seen.energy);

  deformation.reset();
  CHECK(deformation.velocity(4) == (Coordinates{0, 0, 0}));
  deformation.clear_roi_vertices();
  CHECK(deformation.advance(dynamics));

  // preprocess() is for deform(), which has no inertia that holds a body
  deformation.insert_roi_vertices(numbers(n));
  CHECK(deformation.advance(dynamics));
  CHECK(deformation.preprocess().status == Status::no_fixed_vertex);
}

// a handle moves only what is near to it, and most of the rest is fixed
void near_a_handle()
{
  const Model model = make_model<2>();
  std::vector<Point> points = points_of(model.points);
  Deformation<2> deformation(Soup<2>(points, model.simplices));
  deformation.insert_roi_vertices(numbers(points.size()));
  for(std::size_t v = 0; v < points.size(); ++v)
    if(v != 12 && v != 13)
      deformation.insert_control_vertex(v, point(model.points[v] + Vector3d(1, 0, 0)));
  Dynamics dynamics;
  CHECK(deformation.advance(dynamics));
  for(std::size_t v = 0; v < points.size(); ++v)
    if(v != 12 && v != 13)
      CHECK_AT_MOST(std::abs(deformation.velocity(v)[0] - 60), 1e-10);
  CHECK(deformation.velocity(12)[0] > 0);
}

// A vertex in a thin simplex only, which has next to no mass: the momentum is what the forces have
// given to all, and no vertex is thrown away.
template <int Dimension>
void force_a_thin_simplex(Minimizer minimizer)
{
  for(double height : {0.3, 1e-6, 1e-9, 1e-13, 1e-16, 0.0})
  {
    test_case() = std::to_string(Dimension) + "D, a simplex of height " + std::to_string(height);
    Model model = make_model<Dimension>();
    const auto first = model.simplices[0];
    std::vector<std::size_t> facet(first.begin() + 1, first.end());
    Vector3d center = Vector3d::Zero();
    for(std::size_t v : facet)
      center += model.points[v] / double(facet.size());
    std::reverse(facet.begin(), facet.end()); // oriented as the first one
    facet.push_back(model.points.size());
    model.points.push_back(center + height * (center - model.points[first[0]]));
    model.simplices.push_back(facet);
    const std::size_t n = model.points.size();
    std::vector<Point> points = points_of(model.points);
    Deformation<Dimension> deformation(Soup<Dimension>(points, model.simplices));
    deformation.insert_roi_vertices(numbers(n));
    CHECK(deformation.set_options(options(Cell_scheme::spokes_and_rims(), minimizer, 1e-3)));
    Dynamics dynamics;
    dynamics.time_step = 0.1;
    const Vector3d force(0, 0, 0.01);
    const Step_report report =
      deformation.advance(dynamics, std::vector<Vector3d>(n, force));
    CHECK(report.status == Status::converged);
    const Vector3d momentum = double(n) * dynamics.time_step * force;
    CHECK_AT_MOST((eigen(report.momentum) - momentum).norm(), 1e-6 * momentum.norm());
    CHECK_AT_MOST(largest_distance(points, model.points), 0.1);
  }
}

// A mesh, another solver and several threads: the same motion as with ranges. With threads alone,
// the same bits.
template <typename Deformed>
std::vector<Point> falling_mesh(const Shape& shape, unsigned int threads)
{
  Mesh mesh = make_mesh<Mesh>(shape);
  Deformed deformation(mesh);
  CGAL::ARAP::Options o;
  o.threads = threads;
  o.tolerance = 1e-10;
  CHECK(deformation.set_options(o));
  deformation.insert_roi_vertices(mesh.vertices());
  deformation.insert_control_vertex(Mesh::Vertex_index(4));
  Dynamics dynamics;
  dynamics.acceleration = {0, 1, -10};
  for(int step = 0; step < 20; ++step)
    CHECK(deformation.advance(dynamics, [](Mesh::Vertex_index v) {
      return Kernel::Vector_3(v == Mesh::Vertex_index(9) ? 0.1 : 0, 0, 0);
    }));
  return points_of(mesh);
}

void falling_meshes()
{
  using Traits = CGAL::ARAP_deformation_traits<Compiled_LDLT_solver>;
  const Shape sheet = grid("sheet", 60, 45, [](double u, double v) { // several blocks of cells
    return Eigen::Vector3d(6 * u, 4 * v, 0);
  });
  CHECK(falling_mesh<CGAL::ARAP_deformation<Mesh>>(sheet, 1) ==
        falling_mesh<CGAL::ARAP_deformation<Mesh>>(sheet, 4));

  const Shape shape = shapes()[5];
  const auto one = falling_mesh<CGAL::ARAP_deformation<Mesh>>(shape, 1);
  const auto ldlt = falling_mesh<CGAL::ARAP_deformation<Mesh, Traits>>(shape, 1);
  CHECK_AT_MOST(largest_distance(one, ldlt), 1e-7);

  std::vector<Point> points = points_of(shape.points);
  const Simplices triangles = as_polygons(shape.triangles);
  Deformation<2> deformation(Soup<2>(points, triangles));
  CGAL::ARAP::Options o;
  o.tolerance = 1e-10;
  CHECK(deformation.set_options(o));
  deformation.insert_roi_vertices(numbers(points.size()));
  deformation.insert_control_vertex(4);
  Dynamics dynamics;
  dynamics.acceleration = {0, 1, -10};
  std::vector<Vector3d> forces(points.size(), Vector3d(0, 0, 0));
  forces[9] = {0.1, 0, 0};
  for(int step = 0; step < 20; ++step)
    CHECK(deformation.advance(dynamics, forces));
  CHECK_AT_MOST(largest_distance(points, one), 1e-7);
  CHECK(largest_distance(points, shape.points) > 0.1);
}

template <int Dimension>
void run_all()
{
  for(Cell_scheme cells : all_cell_schemes)
    for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
    {
      test_case() = std::to_string(Dimension) + "D, cells " +
                    std::to_string(int(dense(cells))) + ", rings " +
                    std::to_string(cells.rings()) + ", minimizer " +
                    std::to_string(int(minimizer));
      compare<Dimension>(cells, false, minimizer);
      compare<Dimension>(cells, true, minimizer);
      if(cells.rings() > 0)
        compare<Dimension>(cells, true, minimizer, true);
      const bool is_default = cells == Cell_scheme::spokes_and_rims();
      conserve<Dimension>(cells, minimizer, 0, is_default ? 500 : 50);
      conserve<Dimension>(cells, minimizer, 5, is_default ? 500 : 50);
      conserve<Dimension>(cells, minimizer, 5, 50, 0.1);
      fall<Dimension>(cells, minimizer);
      pull<Dimension>(cells, minimizer);
      if(minimizer == Minimizer::quasi_newton || is_default)
        hang<Dimension>(cells, minimizer); // the other one takes long
    }
}

int main()
{
  run_all<2>();
  run_all<3>();
  test_case() = "";
  initial_guess();
  velocities_of_controls();
  tiny_modulus();
  undo_and_refuse();
  near_a_handle();
  for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
  {
    force_a_thin_simplex<2>(minimizer);
    force_a_thin_simplex<3>(minimizer);
  }
  falling_meshes();
  return checks_result();
}
