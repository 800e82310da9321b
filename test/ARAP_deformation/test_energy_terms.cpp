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

// What the energy has beside the paper's: bending, stiffness, larger cells, groups of cells, frames
// and smooth rotations. Against the dense reference, and by what must be the same.

#include "include/check.h"
#include "include/dense_reference.h"
#include "include/domains.h"
#include "include/length.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation_traits.h>
#include <CGAL/arap_deform.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using CGAL::ARAP::Minimizer;
using CGAL::ARAP::of_simplices;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;
using Simplices = std::vector<Dense_reference::Simplex>;
using Terms = Dense_reference::Terms;

template <int Dimension>
using Soup = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;

// a shape of triangles, polygons or tetrahedra
struct Model
{
  std::string name;
  std::vector<Eigen::Vector3d> points;
  Simplices simplices;
};

Options options_of(Cell_scheme cells, const Terms& terms, Minimizer minimizer)
{
  Options options = options_for(cells, minimizer);
  options.bending_length = terms.bending_length;
  options.smoothing_length = terms.smoothing_length;
  return options;
}

template <typename Deformation>
void apply(Deformation& deformation, Cell_scheme cells, const Terms& terms,
           Minimizer minimizer = Minimizer::automatic)
{
  CHECK(deformation.set_options(options_of(cells, terms, minimizer)));
  if(!terms.stiffness.empty())
    deformation.set_stiffness(terms.stiffness);
  if(!terms.group.empty())
    deformation.set_groups(terms.group);
  for(const auto& [v, rotation] : terms.frames)
    CHECK(deformation.set_target_rotation(v, rotation));
}

Eigen::Matrix3d turn(double angle, const Eigen::Vector3d& axis)
{
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

// Iterates and energies against the dense reference.
namespace iterates {

// free vertices that get soft targets in some cases
std::vector<std::size_t> soft_vertices(const Scenario& s)
{
  std::vector<std::size_t> vertices;
  for(std::size_t v = 4; v < s.selection.size() && vertices.size() < 4; v += 7)
    if(s.selection[v] == 1)
      vertices.push_back(v);
  return vertices;
}

// Soft targets of free vertices, the last of which is a plane, and a soft control point.
template <typename Deformation>
void add_rows(const Model& model, const Scenario& s, Deformation& deformation,
              Dense_reference& reference)
{
  const std::vector<std::size_t> vertices = soft_vertices(s);
  const Eigen::Vector3d normal = Eigen::Vector3d(1, -2, 0.5).normalized();
  for(const std::size_t v : vertices)
  {
    const Eigen::Vector3d p = model.points[v], target = p + Eigen::Vector3d(0.1, -0.05, 0.02);
    const double weight = 0.5 + 0.1 * double(v);
    deformation.insert_control_vertex(v, point(target));
    CHECK(deformation.set_target_weight(v, weight));
    if(v != vertices.back())
      reference.add_soft_position(v, weight, target);
    else
    {
      const auto project = [=](const Eigen::Vector3d& x) {
        return Eigen::Vector3d(x - normal * normal.dot(x - target));
      };
      CHECK(deformation.set_target_set(v, [=](const Point& x) {
        return point(project(vector(x)));
      }));
      reference.add_row({{v, 1}}, weight, project);
    }
  }
  std::size_t number = model.simplices.size() / 2;
  const auto is_outside = [&](std::size_t v) { return s.selection[v] == 0; };
  while(std::any_of(model.simplices[number].begin(), model.simplices[number].end(), is_outside))
    ++number; // it would get into the region of interest
  const auto& corners = model.simplices[number];
  const std::vector<double> shares(corners.size(), 1 / double(corners.size()));
  const auto inserted = deformation.insert_control_point(number, shares);
  CHECK(inserted);
  CHECK(deformation.set_target_weight(inserted.point, 2));
  CHECK(deformation.translate(inserted.point, Eigen::Vector3d(0.03, 0.1, -0.05)));
  std::map<std::size_t, double> coefficients;
  Eigen::Vector3d target(0.03, 0.1, -0.05);
  for(std::size_t k = 0; k < corners.size(); ++k)
  {
    coefficients[corners[k]] = shares[k];
    target += shares[k] * vector(deformation.domain().point(corners[k]));
  }
  reference.add_row({coefficients.begin(), coefficients.end()}, 2,
                    [target](const Eigen::Vector3d&) { return target; });
}

template <int Dimension>
void compare(const Model& model, const Scenario& s, Cell_scheme cells,
             Dense_reference::Cells dense_cells, const Terms& terms, bool has_rows = false)
{
  std::vector<Point> points = points_of(model.points);
  CGAL::ARAP_deformation<Soup<Dimension>> deformation(Soup<Dimension>(points, model.simplices));
  prepare(deformation, s, numbers(points.size()));
  Dense_reference reference(model.points, model.simplices, Dimension, s.selection, dense_cells,
                            Dense_reference::SAFE, terms);
  if(has_rows)
    add_rows(model, s, deformation, reference);
  apply(deformation, cells, terms);
  compare_iterates(deformation, points, reference, s.targets, 6, diameter_of(model.points));
}

struct Case
{
  std::string name;
  Terms terms;
  bool is_for_elements = true;
  bool is_for_stars_only = false;
  bool has_rows = false;
};

std::vector<Case> cases(const Model& model, const Scenario& s, double diameter)
{
  std::mt19937 random(5);
  std::vector<Case> all;
  const auto add = [&](const std::string& name, bool is_for_elements = true) -> Terms& {
    all.push_back({name, {}, is_for_elements});
    return all.back().terms;
  };
  const auto random_stiffness = [&] {
    std::vector<double> values; // as many as there may be cells
    for(std::size_t c = 0; c < (std::max)(model.points.size(), model.simplices.size()); ++c)
      values.push_back(0.1 * double(random() % 40 + 1));
    return values;
  };
  const auto some_frames = [&](Terms& terms) {
    int number = 0;
    for(std::size_t v = 0; v < model.points.size(); ++v)
      if(s.selection[v] == 2 && number++ % 3 == 0)
        terms.frames[v] = turn(0.3 + 0.01 * double(v), {1, 0.2 * double(v % 5), -0.5});
  };
  add("stiffness").stiffness = random_stiffness();
  some_frames(add("frames"));
  {
    Terms& terms = add("groups");
    for(std::size_t c = 0; c < (std::max)(model.points.size(), model.simplices.size()); ++c)
      terms.group.push_back(c % 7 < 2 ? int(c / 14) : -1);
  }
  add("bending", false).bending_length = 0.1 * diameter;
  add("smooth rotations").smoothing_length = 0.1 * diameter;
  {
    Terms& terms = add("all but groups", false);
    terms.stiffness = random_stiffness();
    terms.bending_length = 0.03 * diameter;
    terms.smoothing_length = 0.05 * diameter;
    some_frames(terms);
  }
  {
    Terms& terms = add("bending, groups and frames", false);
    terms.bending_length = 0.2 * diameter;
    for(std::size_t c = 0; c < model.points.size(); ++c)
      terms.group.push_back(c % 5 < 2 ? int(c / 20) : -1);
    some_frames(terms);
  }
  for(const bool is_bent : {false, true})
  {
    const std::string with = is_bent ? "bending" : "smooth rotations";
    Terms& terms = add("rows, with " + with, !is_bent);
    terms.stiffness = random_stiffness();
    (is_bent ? terms.bending_length : terms.smoothing_length) = 0.05 * diameter;
    for(const std::size_t v : soft_vertices(s)) // frames that are soft
      if(v % 2 == 0)
        terms.frames[v] = turn(0.4, {0.3, 1, 0.1 * double(v)});
    all.back().has_rows = true;
  }
  add("2-ring").rings = 2;
  all.back().is_for_stars_only = true;
  {
    Terms& terms = add("1-ring, stiffness, bending and frames");
    terms.rings = 1;
    terms.stiffness = random_stiffness();
    terms.bending_length = 0.05 * diameter;
    some_frames(terms);
    all.back().is_for_stars_only = true;
  }
  {
    Terms& terms = add("1-ring, groups and smooth rotations");
    terms.rings = 1;
    terms.smoothing_length = 0.05 * diameter;
    for(std::size_t c = 0; c < model.points.size(); ++c)
      terms.group.push_back(c % 3 == 0 ? int(c / 15) : -1);
    all.back().is_for_stars_only = true;
  }
  return all;
}

template <int Dimension>
void compare_all(const Model& model)
{
  const double diameter = diameter_of(model.points);
  const Scenario part = scenario(Shape{"", model.points, {}}, 0.6);
  Scenario patch = part; // groups, and what has smooth rotations, are cut where it ends
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for(const Eigen::Vector3d& p : model.points)
    middle += p / double(model.points.size());
  for(std::size_t v = 0; v < model.points.size(); ++v)
    if((model.points[v] - middle).dot(Eigen::Vector3d(1, 0.9, 0.8)) < -0.05 * diameter)
    {
      patch.selection[v] = 0;
      patch.targets[v] = model.points[v];
    }
  static Every_nth is_run(Dimension == 2 ? 7 : 1); // there is one volume only
  for(const auto& [s, is_patch] :
      {std::pair(part, false), std::pair(patch, true), std::pair(in_whole(part), false)})
    for(const Case& c : cases(model, s, diameter))
      for(Dense_reference::Cells cells :
          {Dense_reference::SPOKES, Dense_reference::SPOKES_AND_RIMS, Dense_reference::ELEMENTS})
      {
        if((cells == Dense_reference::ELEMENTS && !c.is_for_elements) ||
           (cells != Dense_reference::SPOKES && c.is_for_stars_only) ||
           (is_patch && c.terms.group.empty() && c.terms.smoothing_length == 0) || !is_run())
          continue;
        test_case() = model.name + ", " + c.name + ", cells " + std::to_string(cells);
        const Cell_scheme scheme =
          cells == Dense_reference::SPOKES     ? Cell_scheme::k_ring(c.terms.rings)
          : cells == Dense_reference::ELEMENTS ? Cell_scheme::elements()
                                               : Cell_scheme::spokes_and_rims();
        compare<Dimension>(model, s, scheme, cells, c.terms, c.has_rows);
      }
}

std::vector<Model> surfaces()
{
  std::vector<Model> models;
  for(const Shape& shape : shapes())
    // not those with a component whose handles move rigidly: it would start at its minimum
    if(shape.points.size() <= 130 && shape.points.size() > 20 && shape.name.find("two of") != 0)
      models.push_back({shape.name, shape.points, as_polygons(shape.triangles)});
  Model polygons = {"polygons", {}, {}};
  polygons.points = sheet_of_polygons(6, 5, polygons.simplices).points;
  models.push_back(polygons);
  return models;
}

Model solid()
{
  const Block shape = block(4, 3, 3);
  return {"tetrahedra", shape.points, as_polygons(shape.tetrahedra)};
}

void test_all()
{
  for(const Model& model : surfaces())
    compare_all<2>(model);
  compare_all<3>(solid());
}

} // namespace iterates

// What must be the same, or must not be, whatever the numbers are.
namespace identities {

// a deformation of a model with handles turned, all that is not a handle free
template <int Dimension>
struct Run
{
  std::vector<Point> points;
  CGAL::ARAP_deformation<Soup<Dimension>> deformation;

  Run(const Model& model, const Scenario& s, Cell_scheme cells, const Terms& terms,
      Minimizer minimizer = Minimizer::automatic)
    : points(points_of(model.points)), deformation(Soup<Dimension>(points, model.simplices))
  {
    prepare(deformation, s, numbers(points.size()));
    apply(deformation, cells, terms, minimizer);
  }
};

Scenario whole_scenario(const Model& model)
{
  return in_whole(scenario(Shape{"", model.points, {}}, 0.8));
}

// with cells at vertices, of all kinds of terms
std::vector<std::pair<std::string, Terms>> all_terms(const Model& model, const Scenario& s)
{
  const double diameter = diameter_of(model.points);
  std::vector<std::pair<std::string, Terms>> all;
  for(const iterates::Case& c : iterates::cases(model, s, diameter))
    if(!c.is_for_stars_only && !c.has_rows)
      all.emplace_back(c.name, c.terms);
  return all;
}

// The energy never rises, and the quasi-Newton method ends no higher than local/global.
template <int Dimension>
void test_minimizers(const Model& model)
{
  const Scenario s = whole_scenario(model);
  for(const auto& [name, terms] : all_terms(model, s))
    for(Cell_scheme cells : {Cell_scheme::spokes_and_rims(), Cell_scheme::k_ring(1)})
    {
      test_case() = model.name + ", " + name;
      Run<Dimension> slow(model, s, cells, terms, Minimizer::local_global);
      Run<Dimension> fast(model, s, cells, terms, Minimizer::quasi_newton);
      const Report r = slow.deformation.deform(300, 1e-4), q = fast.deformation.deform(300, 1e-4);
      CHECK(r);
      CHECK(q);
      CHECK(CGAL::ARAP::first_rise_of_energy(r) == 0);
      CHECK(CGAL::ARAP::first_rise_of_energy(q) == 0);
      CHECK_AT_MOST(q.final_energy(), r.final_energy() * 1.01);
      CHECK_AT_MOST(q.iterations - q.looking_iterations, r.iterations);
    }
}

// Everything moved rigidly, or made ten times as large: the same, moved, or as much larger.
template <int Dimension>
void test_motions(const Model& model)
{
  const Scenario s = whole_scenario(model);
  const Eigen::Matrix3d q = turn(1.1, {1, 2, -1});
  const Eigen::Vector3d shift(3, -2, 1);
  for(const auto& [name, terms] : all_terms(model, s))
    for(const double size : {1.0, 10.0, 1e65, 1e-65})
    {
      test_case() = model.name + ", " + name;
      const auto move = [&](const Eigen::Vector3d& p) {
        return Eigen::Vector3d(size * (q * p + shift));
      };
      Model moved = model;
      Scenario moved_s = s;
      Terms moved_terms = terms;
      std::transform(model.points.begin(), model.points.end(), moved.points.begin(), move);
      std::transform(s.targets.begin(), s.targets.end(), moved_s.targets.begin(), move);
      moved_terms.bending_length *= size;
      moved_terms.smoothing_length *= size;
      for(auto& frame : moved_terms.frames)
        frame.second = q * frame.second * q.transpose();
      Run<Dimension> run(model, s, Cell_scheme::spokes_and_rims(), terms),
        moved_run(moved, moved_s, Cell_scheme::spokes_and_rims(), moved_terms);
      const Report a = run.deformation.deform(5, 0), b = moved_run.deformation.deform(5, 0);
      std::vector<Eigen::Vector3d> expected;
      for(const Point& p : run.points)
        expected.push_back(move(vector(p)));
      CHECK_AT_MOST(largest_distance(moved_run.points, expected), 1e-9 * size *
                                                                    diameter_of(model.points));
      CHECK_AT_MOST(std::abs(b.final_energy() - a.final_energy() * std::pow(size, Dimension)),
                    1e-9 * b.final_energy());
    }
}

// The vertices in another order: the same iterates, with all schemes and minimizers.
template <int Dimension>
void test_orders(const Model& model)
{
  const Scenario s = whole_scenario(model);
  const std::size_t n = model.points.size();
  const auto renamed = [n](std::size_t v) { return (n - v + 5) % n; };
  for(const auto& [name, terms] : all_terms(model, s))
    for(Cell_scheme cells :
        {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims(), Cell_scheme::k_ring(1)})
      for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
      {
        test_case() = model.name + ", " + name + ", another order";
        Model other = model;
        Scenario other_s = s;
        Terms other_terms = terms;
        other_terms.frames.clear();
        for(std::size_t v = 0; v < n; ++v)
        {
          other.points[renamed(v)] = model.points[v];
          other_s.targets[renamed(v)] = s.targets[v];
          other_s.selection[renamed(v)] = s.selection[v];
          if(v < terms.stiffness.size())
            other_terms.stiffness[renamed(v)] = terms.stiffness[v];
          if(v < terms.group.size())
            other_terms.group[renamed(v)] = terms.group[v];
        }
        for(const auto& [v, rotation] : terms.frames)
          other_terms.frames[renamed(v)] = rotation;
        for(auto& simplex : other.simplices)
          std::transform(simplex.begin(), simplex.end(), simplex.begin(), renamed);
        Run<Dimension> run(model, s, cells, terms, minimizer),
          other_run(other, other_s, cells, other_terms, minimizer);
        CHECK(run.deformation.deform(10, 0));
        CHECK(other_run.deformation.deform(10, 0));
        std::vector<Point> expected(n, Point(0, 0, 0));
        for(std::size_t v = 0; v < n; ++v)
          expected[renamed(v)] = run.points[v];
        // the pairs of the quasi-Newton method are in single precision
        CHECK_AT_MOST(largest_distance(other_run.points, expected),
                      (minimizer == Minimizer::local_global ? 1e-10 : 1e-5) *
                        diameter_of(model.points));
      }
}

// a stiffness of all cells, groups of one cell, a length of nothing, no rings: as without
template <int Dimension>
void test_limits(const Model& model)
{
  test_case() = model.name + ", limits";
  const Scenario s = whole_scenario(model);
  for(Cell_scheme cells : all_cell_schemes)
  {
    Run<Dimension> plain(model, s, cells, {});
    const Report a = plain.deformation.deform(5, 0);
    Terms terms;
    const std::size_t number_of_cells = (std::max)(model.points.size(), model.simplices.size());
    terms.stiffness.assign(number_of_cells, 1);
    Run<Dimension> one(model, s, cells, terms);
    CHECK(one.deformation.deform(5, 0).energy == a.energy);
    CHECK(one.points == plain.points);
    terms.stiffness.assign(number_of_cells, 4);
    Run<Dimension> four(model, s, cells, terms);
    CHECK_AT_MOST(std::abs(four.deformation.deform(5, 0).final_energy() - 4 * a.final_energy()),
                  1e-9 * a.final_energy());
    CHECK_AT_MOST(largest_distance(four.points, plain.points), 1e-10 * diameter_of(model.points));
    Terms apart; // each cell is a group
    for(std::size_t c = 0; c < number_of_cells; ++c)
      apart.group.push_back(int(c));
    Run<Dimension> alone(model, s, cells, apart);
    CHECK(alone.deformation.deform(5, 0));
    CHECK_AT_MOST(largest_distance(alone.points, plain.points), 1e-10 * diameter_of(model.points));
    for(double Terms::*length : {&Terms::bending_length, &Terms::smoothing_length})
    {
      if(cells == Cell_scheme::elements() && length == &Terms::bending_length)
        continue;
      double last = std::numeric_limits<double>::infinity();
      for(double b : {1e-2, 1e-4, 1e-6})
      {
        Terms short_length;
        short_length.*length = b * diameter_of(model.points);
        Run<Dimension> bent(model, s, cells, short_length);
        CHECK(bent.deformation.deform(5, 0));
        const double distance = largest_distance(bent.points, plain.points);
        CHECK(distance < last);
        last = distance;
      }
      CHECK_AT_MOST(last, 1e-8 * diameter_of(model.points));
    }
  }
  CHECK(Cell_scheme::k_ring(0) == Cell_scheme::spokes());
  CHECK(Cell_scheme::k_ring(1) != Cell_scheme::spokes());
}

// One vertex is fixed and turned: everything turns with it.
template <int Dimension>
void test_one_frame(const Model& model)
{
  const Eigen::Matrix3d rotation = turn(2, {1, -1, 3});
  const double diameter = diameter_of(model.points);
  for(Cell_scheme cells : all_cell_schemes)
    for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
    {
      test_case() = model.name + ", one frame";
      Scenario s{std::vector<int>(model.points.size(), 1), model.points};
      const std::size_t v = model.points.size() / 2;
      s.selection[v] = 2;
      Terms terms;
      terms.frames[v] = rotation;
      Run<Dimension> run(model, s, cells, terms, minimizer);
      const Report report = run.deformation.deform(100, 1e-6);
      CHECK(report.status == CGAL::ARAP::Status::converged);
      std::vector<Eigen::Vector3d> expected;
      for(const Eigen::Vector3d& p : model.points)
        expected.push_back(model.points[v] + rotation * (p - model.points[v]));
      CHECK(report.iterations <= 30);
      CHECK_AT_MOST(report.final_energy(), report.rounding_level);
      CHECK_AT_MOST(largest_distance(run.points, expected), 1e-9 * diameter);

      // the same as a transformation, whose translation does not count, and a target that turns
      Run<Dimension> same(model, s, cells, {}, minimizer);
      const auto& r = rotation;
      CHECK(same.deformation.set_target_rotation(v, CGAL::Aff_transformation_3<Kernel>(
        r(0, 0), r(0, 1), r(0, 2), 1, r(1, 0), r(1, 1), r(1, 2), 2, r(2, 0), r(2, 1), r(2, 2), 3)));
      CHECK(same.deformation.rotate(v, model.points[v], Eigen::Quaterniond(0, 1, 0, 0)));
      CHECK(same.deformation.deform(100, 1e-6).energy == report.energy);

      CHECK(run.deformation.erase_target_rotation(v));
    }
}

// A set of vertices tells its own frame, if it moves rigidly.
void test_frames_of_motions(const Model& model)
{
  test_case() = "frames of motions";
  Run<2> run(model, whole_scenario(model), Cell_scheme::spokes(), {});
  auto& d = run.deformation;
  const std::vector<std::size_t> all = d.control_vertices();
  std::vector<std::size_t> turned;
  for(std::size_t v : all)
    if(d.target_position(v) != run.points[v])
      turned.push_back(v);
  CHECK(turned.size() > 3);
  CHECK(d.set_target_rotations(turned));
  CHECK(d.deform());
  int number = 0;
  for(std::size_t v : turned)
  {
    const CGAL::ARAP::Matrix_3x3 r = d.rotation(v);
    if(r == CGAL::ARAP::Matrix_3x3{1, 0, 0, 0, 1, 0, 0, 0, 1}) // nothing moves in its cell
      continue;
    ++number;
    const Eigen::Vector3d edge = model.points[v] - model.points[turned[0]],
                          now = vector(run.points[v]) - vector(run.points[turned[0]]);
    for(std::size_t k = 0; k < 3; ++k)
      CHECK_AT_MOST(std::abs(r[3 * k] * edge[0] + r[3 * k + 1] * edge[1] + r[3 * k + 2] * edge[2] -
                             now[Eigen::Index(k)]), 1e-9);
  }
  CHECK(number > 0);
  CHECK(d.set_target_rotations(std::vector<std::size_t>{turned[0], turned[1]}).status ==
        CGAL::ARAP::Status::invalid_rotation);
  for(const double size : {1e-100, 1e100})
  {
    std::vector<Point> points = points_of(model.points);
    for(Point& p : points)
      p = Point(size * p.x(), size * p.y(), size * p.z());
    CGAL::ARAP_deformation<Soup<2>> scaled(Soup<2>(points, model.simplices));
    scaled.insert_control_vertices(turned);
    const Eigen::Quaterniond q(turn(2, {1, 2, 3}));
    CHECK(scaled.rotate(turned, Eigen::Vector3d(size, 0, 0), q));
    CHECK(scaled.set_target_rotations(turned));
    CHECK(scaled.translate(turned[0], Kernel::Vector_3(1e-6 * size, 0, 0))); // as of float
    CHECK(scaled.set_target_rotations(turned));
    CHECK(scaled.translate(turned[0], Kernel::Vector_3(1e-3 * size, 0, 0)));
    CHECK(scaled.set_target_rotations(turned).status == CGAL::ARAP::Status::invalid_rotation);
    CHECK(scaled.translate(turned[0], Kernel::Vector_3(size, 0, 0)));
    CHECK(scaled.set_target_rotations(turned).status == CGAL::ARAP::Status::invalid_rotation);
  }
  CHECK(d.set_target_rotations(std::vector<std::size_t>()));
  std::vector<Point> line; // up to rounding, and a vertex beside it
  for(int k = 0; k < 5; ++k)
    line.emplace_back(0.1 * k, 0.2 * k, 0.3 * k);
  line.emplace_back(1, 0, 0);
  Simplices fan;
  for(std::size_t k = 0; k < 4; ++k)
    fan.push_back({k, k + 1, 5});
  CGAL::ARAP_deformation<Soup<2>> on_line(Soup<2>(line, fan));
  std::vector<std::size_t> straight = {0, 1, 2, 3, 4};
  on_line.insert_control_vertices(straight);
  CHECK(on_line.set_target_rotations(straight).status == CGAL::ARAP::Status::invalid_rotation);
  straight.push_back(5);
  on_line.insert_control_vertex(5);
  CHECK(on_line.set_target_rotations(straight));
  d.translate(turned[0], Kernel::Vector_3(1, 0, 0));
  CHECK(d.set_target_rotations(turned).status == CGAL::ARAP::Status::invalid_rotation);
#ifdef CGAL_NDEBUG // else a precondition says so
  d.translate(turned[0], Kernel::Vector_3(-1, 0, 0));
  const std::size_t last = turned.back();
  CHECK(d.erase_control_vertex(last));
  for(std::size_t v : turned)
    d.erase_target_rotation(v);
  const auto state = d.state();
  CHECK(d.set_target_rotations(turned).status == CGAL::ARAP::Status::not_a_control_vertex);
  CHECK(d.deform(3, 0));
  const std::vector<Point> after = run.points;
  CHECK(d.restore(state) && d.deform(3, 0));
  CHECK(run.points == after); // no rotation was set
#endif
}

// the cells of a group have one rotation
void test_groups(const Model& model)
{
  test_case() = "groups";
  Terms terms;
  for(std::size_t c = 0; c < model.points.size(); ++c)
    terms.group.push_back(int(c % 3));
  Run<2> run(model, whole_scenario(model), Cell_scheme::spokes(), terms);
  CHECK(run.deformation.deform());
  for(std::size_t c = 3; c < model.points.size(); ++c)
    CHECK(run.deformation.rotation(c) == run.deformation.rotation(c - 3));
  CHECK(run.deformation.rotation(0) != run.deformation.rotation(1));
}

// what a change costs, and a session after changes equals a new one
void test_changes(const Model& model)
{
  test_case() = "changes";
  const Scenario s = whole_scenario(model);
  Run<2> run(model, s, Cell_scheme::spokes_and_rims(), {});
  auto& d = run.deformation;
  CHECK(d.deform(3, 0));
  Terms terms = all_terms(model, s).back().second;
  terms.group.clear();
  terms.bending_length = 0.1;
  apply(d, Cell_scheme::spokes_and_rims(), terms);
  Report report = d.deform(3, 0);
  CHECK(!report.stages.region);
  CHECK(report.stages.weights && report.stages.order && report.stages.factor);
  terms.bending_length = 0.2;
  apply(d, Cell_scheme::spokes_and_rims(), terms);
  report = d.deform(3, 0);
  CHECK(!report.stages.region && report.stages.weights);
  CHECK(!report.stages.order && report.stages.factor);
  for(auto& frame : terms.frames)
    CHECK(d.set_target_rotation(frame.first, frame.second = turn(0.1, {0, 1, 0})));
  report = d.deform(3, 0);
  CHECK(!report.stages.weights && !report.stages.factor && !report.stages.border);
  const auto state = d.state();
  d.reset(); // erases rotations that are prescribed, and puts targets back
  for(const auto& frame : terms.frames)
    CHECK(d.set_target_rotation(frame.first, frame.second));
  report = d.deform(4, 0);
  Run<2> fresh(model, s, Cell_scheme::spokes_and_rims(), terms);
  for(std::size_t v = 0; v < model.points.size(); ++v)
    if(s.selection[v] == 2)
      fresh.deformation.set_target_position(v, point(model.points[v]));
  CHECK(fresh.deformation.deform(4, 0));
  CHECK_AT_MOST(largest_distance(run.points, fresh.points), 1e-8);

  d.overwrite_initial_geometry(); // erases them, too: the shape stays as it is
  const std::vector<Point> overwritten = run.points;
  CHECK(d.deform(4, 0));
  CHECK_AT_MOST(largest_distance(run.points, overwritten), 1e-9);
  CHECK(d.restore(state));
  d.clear_stiffness();
  d.clear_groups();
  for(const auto& frame : terms.frames)
    CHECK(d.erase_target_rotation(frame.first));
  d.reset();
  apply(d, Cell_scheme::spokes_and_rims(), {});
  CHECK(d.deform(4, 0));
  Run<2> plain(model, s, Cell_scheme::spokes_and_rims(), {});
  plain.deformation.reset();
  CHECK(plain.deformation.deform(4, 0));
  CHECK_AT_MOST(largest_distance(run.points, plain.points), 1e-8);

  test_case() = "smooth rotations and groups, switched on and off";
  Run<2> undisturbed(model, s, Cell_scheme::spokes_and_rims(), {});
  CHECK(undisturbed.deformation.deform(4, 0));
  for(const auto& [number, smoothing, group] :
      {std::tuple(0, 0.1, std::vector<int>()), {1, 0., std::vector<int>(model.points.size(), 1)},
       {2, 0., std::vector<int>()}})
  {
    Terms others;
    others.smoothing_length = smoothing;
    others.group = group;
    d.reset();
    for(std::size_t v = 0; v < model.points.size(); ++v)
      if(s.selection[v] == 2)
        CHECK(d.set_target_position(v, point(s.targets[v])));
    d.clear_groups();
    apply(d, Cell_scheme::spokes_and_rims(), others);
    report = d.deform(4, 0);
    CHECK(report && !report.stages.region && report.stages.weights);
    Run<2> same(model, s, Cell_scheme::spokes_and_rims(), others);
    CHECK(same.deformation.deform(4, 0));
    CHECK_AT_MOST(largest_distance(run.points, same.points), 1e-8);
    CHECK((largest_distance(run.points, undisturbed.points) < 1e-8) == (number == 2));
  }
}

// Where rotations are state, a run starts from those of its positions alone, if there are none or
// the last ones are of a run where they were not.
void test_smooth_starts(const Model& model)
{
  test_case() = "smooth rotations, from others' positions";
  const Scenario s = whole_scenario(model);
  const double diameter = diameter_of(model.points);
  const auto cells = Cell_scheme::spokes_and_rims();
  Terms smooth;
  smooth.smoothing_length = 0.3 * diameter;
  const auto twist = [&](std::vector<Point>& points) {
    for(std::size_t v = 0; v < points.size(); ++v)
      if(s.selection[v] == 1)
        points[v] = point(turn(2 * model.points[v][0] / diameter, {1, 0, 0}) * model.points[v]);
  };
  {
    Run<2> run(model, s, cells, smooth);
    twist(run.points);
    const auto state = run.deformation.state();
    const Report first = run.deformation.deform(3, 1e-3);
    const std::vector<Point> points = run.points;
    CHECK(run.deformation.restore(state));
    const Report second = run.deformation.deform(3, 1e-3);
    CHECK(first && second && first.energy == second.energy);
    CHECK(points == run.points);
  }
  {
    test_case() = "smooth rotations, after others that were given";
    Terms turned = smooth;
    for(std::size_t v = 0; v < model.points.size(); ++v)
      if(s.selection[v] == 2)
        turned.frames[v] = turn(1.5, {0, 1, 1});
    Run<2> run(model, s, cells, turned), fresh(model, s, cells, smooth);
    CHECK(run.deformation.deform());
    run.deformation.reset();
    fresh.deformation.reset();
    twist(run.points);
    twist(fresh.points);
    const Report report = run.deformation.deform(3, 0), expected = fresh.deformation.deform(3, 0);
    CHECK(report && expected);
    CHECK_AT_MOST(std::abs(report.energy[0] - expected.energy[0]), 1e-9 * expected.energy[0]);
    CHECK_AT_MOST(largest_distance(run.points, fresh.points), 1e-8);
  }
  test_case() = "smooth rotations, after a state without";
  std::vector<std::vector<Point>> results;
  for(const bool is_prepared : {false, true})
    for(const bool is_other_region : {false, true})
    {
      Scenario part = s;
      const auto last = std::size_t(
        std::find(s.selection.rbegin(), s.selection.rend(), 1).base() - s.selection.begin() - 1);
      part.selection[last] = 0;
      Run<2> run(model, part, cells, {});
      auto& d = run.deformation;
      CHECK(d.deform(5, 0));
      const auto state = d.state();
      if(results.empty())
      {
        Run<2> fresh(model, part, cells, smooth);
        fresh.points = run.points;
        CHECK(fresh.deformation.deform(5, 0));
        results.push_back(fresh.points);
      }
      if(is_other_region)
        d.insert_roi_vertex(last);
      apply(d, cells, is_other_region ? Terms() : smooth);
      CHECK(d.deform(5, 0));
      apply(d, cells, {});
      CHECK(d.restore(state));
      if(is_prepared)
        CHECK(d.preprocess());
      apply(d, cells, smooth);
      CHECK(d.deform(5, 0));
      results.push_back(run.points);
    }
  for(const std::vector<Point>& points : results)
    CHECK_AT_MOST(largest_distance(points, results[0]), 1e-9 * diameter);
}

// Rigid motions with smooth rotations, and starts that are taken only where they lower the energy.
void test_rigid_motions(const Model& model)
{
  const double diameter = diameter_of(model.points);
  const Eigen::Matrix3d q = turn(2, {1, 2, 0});
  for(const double length : {0.03, 0.3, 3.0})
  {
    test_case() = "smooth rotations, rigid, length " + std::to_string(length);
    Scenario s{std::vector<int>(model.points.size(), 1), model.points};
    for(std::size_t v = 0; v < model.points.size() / 5; ++v)
    {
      s.selection[v] = 2;
      s.targets[v] = q * model.points[v];
    }
    Terms terms;
    terms.smoothing_length = length * diameter;
    Run<2> run(model, s, Cell_scheme::spokes_and_rims(), terms);
    const Report report = run.deformation.deform(100, 1e-3);
    CHECK(report.iterations <= 30);
    CHECK_AT_MOST(report.final_energy(), 1e-9 * report.energy_scale);
    std::vector<Eigen::Vector3d> expected;
    for(const Eigen::Vector3d& p : model.points)
      expected.push_back(q * p);
    CHECK_AT_MOST(largest_distance(run.points, expected), 1e-6 * diameter);
  }

  test_case() = "a group over two sheets that are turned differently";
  Model two = model;
  for(const Eigen::Vector3d& p : model.points)
    two.points.push_back(p + Eigen::Vector3d(0, 0, 2 * diameter));
  for(Dense_reference::Simplex simplex : model.simplices)
  {
    for(std::size_t& v : simplex)
      v += model.points.size();
    two.simplices.push_back(simplex);
  }
  Scenario s{std::vector<int>(two.points.size(), 1), two.points};
  Terms terms;
  for(std::size_t v = 0; v < two.points.size(); ++v)
  {
    const std::size_t k = v % model.points.size();
    terms.group.push_back(k < model.points.size() / 2 ? 0 : -1);
    if(k < model.points.size() / 5)
    {
      s.selection[v] = 2;
      s.targets[v] = v < model.points.size() ? two.points[v] : Eigen::Vector3d(q * two.points[v]);
    }
  }
  Run<2> run(two, s, Cell_scheme::spokes_and_rims(), terms);
  const Report first = run.deformation.deform(200, 0), again = run.deformation.deform(0, 0);
  CHECK(first.final_energy() > 1e-3);
  CHECK_AT_MOST(again.final_energy(), first.final_energy() * (1 + 1e-9));
  terms.group.resize((std::max)(two.points.size(), two.simplices.size()), 0);
  for(std::size_t v = 0; v < two.points.size(); ++v) // no rigid motion, or it starts at its minimum
    if(s.selection[v] == 2)
      s.targets[v][2] += 0.05 * diameter * std::sin(double(v));
  for(const double length : {0.0, 0.1, 1.0})
  {
    test_case() = "groups over two sheets, smoothing length " + std::to_string(length);
    terms.smoothing_length = length * diameter;
    iterates::compare<2>(two, s, Cell_scheme::spokes(), Dense_reference::SPOKES, terms);
    iterates::compare<2>(two, s, Cell_scheme::elements(), Dense_reference::ELEMENTS, terms);
  }
}

// Where every rotation is given none is left to smooth, and one step solves the linear problem.
void test_frames_everywhere(const Model& model)
{
  for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
  {
    test_case() = model.name + ", frames everywhere";
    const Eigen::Matrix3d rotation = turn(0.3, {1, 2, 0});
    Run<2> run(model, whole_scenario(model), Cell_scheme::spokes_and_rims(), {});
    auto& d = run.deformation;
    for(std::size_t v = 0; v < model.points.size(); ++v)
    {
      d.insert_control_vertex(v);
      CHECK(d.set_target_weight(v, 1));
      CHECK(d.set_target_rotation(v, rotation));
    }
    Options options = d.options();
    options.smoothing_length = 0.1 * diameter_of(model.points);
    options.minimizer = minimizer;
    options.tolerance = 1e-9;
    CHECK(d.set_options(options));
    const Report report = d.deform();
    CHECK(report.status == CGAL::ARAP::Status::converged && report.final_energy() > 0);
    CHECK_AT_MOST(std::abs(report.energy[1] - report.final_energy()), 1e-12 * report.energy[0]);
  }
}

// Frames of soft vertices, changed between runs, against the dense reference, with undo.
void test_soft_frames(const Model& model)
{
  const double diameter = diameter_of(model.points);
  const Scenario hard = whole_scenario(model);
  Scenario soft = hard; // for the reference, where soft vertices are free
  std::vector<std::size_t> pulled;
  for(std::size_t v = 0; v < model.points.size(); ++v)
    if(hard.selection[v] == 2 && hard.targets[v] != model.points[v])
    {
      pulled.push_back(v);
      soft.selection[v] = 1;
      soft.targets[v] = model.points[v];
    }
  const auto frames = [&](int step) { // other ones in each step, and of other vertices
    std::map<std::size_t, Eigen::Matrix3d> some;
    for(std::size_t k = 0; k < pulled.size(); ++k)
      if((int(k) + step) % 2 == 0)
        some[pulled[k]] = turn(0.3 + 0.2 * step, {1, 0.1 * double(k), -0.5});
    return some;
  };
  for(const auto& [cells, dense_cells] :
      {std::pair(Cell_scheme::spokes_and_rims(), Dense_reference::SPOKES_AND_RIMS),
       std::pair(Cell_scheme::elements(), Dense_reference::ELEMENTS)})
  {
    test_case() = model.name + ", frames of soft vertices";
    Run<2> run(model, hard, cells, {});
    auto& d = run.deformation;
    for(std::size_t v : pulled)
      CHECK(d.set_target_weight(v, 1 + double(v % 3)));
    std::vector<Eigen::Vector3d> x = soft.targets;
    std::vector<decltype(d.state())> states;
    std::vector<std::vector<Point>> points;
    for(int step = 0; step < 3; ++step)
    {
      Terms terms;
      terms.frames = frames(step);
      Dense_reference reference(model.points, model.simplices, 2, soft.selection, dense_cells,
                                Dense_reference::SAFE, terms);
      for(std::size_t v : pulled)
      {
        reference.add_soft_position(v, 1 + double(v % 3), hard.targets[v]);
        CHECK(terms.frames.count(v) ? d.set_target_rotation(v, terms.frames[v])
                                    : d.erase_target_rotation(v));
      }
      states.push_back(d.state());
      const Report report = d.deform(4, 0);
      CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
      CHECK(step == 0 || (!report.stages.weights && !report.stages.factor));
      for(int k = 0; k < 4; ++k)
        reference.iterate(x);
      CHECK_AT_MOST(largest_distance(run.points, x), 1e-10 * diameter);
      CHECK_AT_MOST(std::abs(report.final_energy() - reference.energy(x)),
                    1e-10 * report.final_energy());
      points.push_back(run.points);
    }
    for(const std::size_t step : {1, 2, 0})
    {
      CHECK(d.restore(states[step]));
      const Report report = d.deform(4, 0);
      CHECK(!report.stages.weights && !report.stages.factor);
      CHECK_AT_MOST(largest_distance(run.points, points[step]), 1e-12 * diameter);
    }
  }
}

// Rotations that are smooth over long lengths do not creep, and if they do nothing has converged.
// Over a very long length they are all one: a group of all cells.
template <int Dimension>
void test_long_lengths(const Model& model)
{
  const Scenario s = whole_scenario(model);
  for(Cell_scheme cells : {Cell_scheme::spokes_and_rims(), Cell_scheme::elements()})
  {
    Terms one;
    one.group.assign((std::max)(model.points.size(), model.simplices.size()), 0);
    Run<Dimension> group(model, s, cells, one, Minimizer::quasi_newton);
    const double limit = group.deformation.deform(300, 1e-6).final_energy();
    for(double length : {0.1, 1.0, 100.0})
    {
      test_case() = model.name + ", smoothing length " + std::to_string(length);
      Terms terms;
      terms.smoothing_length = length * diameter_of(model.points);
      Run<Dimension> fast(model, s, cells, terms, Minimizer::quasi_newton);
      const Report report = fast.deformation.deform(100, 1e-3);
      CHECK(report.status == CGAL::ARAP::Status::converged);
      CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
      const double lowest = fast.deformation.deform(200, 0).final_energy();
      CHECK_AT_MOST(report.final_energy(), lowest * (1 + 1e-3));
      CHECK_AT_MOST(lowest, limit * (1 + 1e-6));
      if(length == 100)
        CHECK_AT_MOST(limit, lowest * (1 + 1e-3));
      Run<Dimension> slow(model, s, cells, terms, Minimizer::local_global);
      const Report paper = slow.deformation.deform(200, 1e-3);
      if(paper.status == CGAL::ARAP::Status::converged)
        CHECK_AT_MOST(paper.final_energy(), lowest * (1 + 1e-3));
    }
  }
}

// A state has its rotations, which smooth ones start from, also if another region was collected
// since.
template <int Dimension>
void test_states(const Model& model)
{
  const Scenario s = whole_scenario(model);
  for(Cell_scheme cells : all_cell_schemes)
    for(const bool is_collected : {false, true})
    {
      test_case() = model.name + ", states";
      Terms terms;
      terms.smoothing_length = 0.3 * diameter_of(model.points);
      Run<Dimension> run(model, s, cells, terms, Minimizer::local_global);
      auto& d = run.deformation;
      CHECK(d.deform(5, 0));
      const auto state = d.state();
      CHECK(d.deform(5, 0));
      const std::vector<Point> expected = run.points;
      std::size_t v = 0;
      while(s.selection[v] != 1)
        ++v;
      CHECK(d.erase_roi_vertex(v));
      if(is_collected)
        CHECK(d.deform(2, 0));
      CHECK(d.restore(state));
      CHECK(d.restore(d.state()));
      CHECK(d.deform(5, 0));
      CHECK_AT_MOST(largest_distance(run.points, expected), 1e-10 * diameter_of(model.points));
    }
}

// Smooth rotations start from those of the shape as it is, also in a region that is new: a shape at
// its minimum stays there. Before, they started from identities, which turned it back.
template <int Dimension>
void test_other_regions(const Model& model)
{
  const Scenario s = whole_scenario(model);
  for(Cell_scheme cells : all_cell_schemes)
  {
    test_case() = model.name + ", smooth rotations in another region";
    Terms terms;
    terms.smoothing_length = 0.1 * diameter_of(model.points);
    Run<Dimension> run(model, s, cells, terms, Minimizer::quasi_newton);
    auto& d = run.deformation;
    const double energy = d.deform(2000, 1e-12).final_energy();
    std::size_t v = 0; // a vertex that is moved, and stays there
    while(s.selection[v] != 2 || s.targets[v] == model.points[v])
      ++v;
    CHECK(d.erase_roi_vertex(v));
    const Report report = d.deform(1, 0);
    CHECK(report.stages.region);
    CHECK_AT_MOST(report.energy[0], 1.01 * energy);
  }

  // points that the program writes back, without the rotations that belong to them
  enum Before { nothing, state_and_restore, another_region };
  for(Cell_scheme cells : all_cell_schemes)
    for(const Before before : {nothing, state_and_restore, another_region})
    {
      test_case() = model.name + ", smooth rotations of other points";
      Terms terms;
      terms.smoothing_length = 0.1 * diameter_of(model.points);
      Run<Dimension> run(model, s, cells, terms, Minimizer::quasi_newton);
      auto& d = run.deformation;
      const double energy = d.deform(2000, 1e-12).final_energy();
      const std::vector<Point> points = run.points;
      for(const bool is_other : {true, false})
      {
        for(const std::size_t v : d.control_vertices())
          d.set_target_position(v, is_other ? point(turn(2.5, {1, 2, 3}) * s.targets[v] * 1.5)
                                            : point(s.targets[v]));
        if(is_other)
          CHECK(d.deform(2000, 1e-6));
      }
      const auto state = d.state();
      if(before == another_region)
      {
        CHECK(d.erase_roi_vertex(d.control_vertices().front()));
        CHECK(d.deform(1, 0) && d.restore(state));
      }
      run.points = points;
      if(before == state_and_restore)
        CHECK(d.restore(d.state()));
      CHECK_AT_MOST(d.deform(0, 0).energy[0], 1.01 * energy);
    }

  // smoothed from now on, in the region that there is and in a new one
  for(Cell_scheme cells : all_cell_schemes)
  {
    test_case() = model.name + ", smooth rotations from now on";
    double energies[2];
    for(const bool is_new : {false, true})
    {
      Run<Dimension> run(model, s, cells, {}, Minimizer::quasi_newton);
      auto& d = run.deformation;
      CHECK(d.deform(200, 1e-6));
      Options options = d.options();
      options.smoothing_length = 0.1 * diameter_of(model.points);
      CHECK(d.set_options(options));
      for(std::size_t v = 0; v < model.points.size() && is_new; ++v)
        if(s.selection[v] == 2 && d.erase_roi_vertex(v))
          d.insert_control_vertex(v, run.points[v]);
      energies[is_new] = d.deform(0, 0).energy[0];
    }
    CHECK_AT_MOST(std::abs(energies[0] / energies[1] - 1), 1e-6);
  }
}

// Faces that lie on each other have no distance over which rotations could be smooth, in whatever
// order their corners are.
void test_double_faces(const Model& model)
{
  const Scenario s = whole_scenario(model);
  Terms terms;
  terms.smoothing_length = 0.2 * diameter_of(model.points);
  for(const int rotated : {0, 1, 2})
  {
    test_case() = model.name + ", double faces, rotated by " + std::to_string(rotated);
    Model twice = model;
    for(Dense_reference::Simplex face : model.simplices)
    {
      std::reverse(face.begin(), face.end());
      std::rotate(face.begin(), face.begin() + rotated, face.end());
      twice.simplices.push_back(face);
    }
    iterates::compare<2>(twice, s, Cell_scheme::elements(), Dense_reference::ELEMENTS, terms);

    // all of it is there twice, and nothing of it on the border bends
    Terms bending;
    bending.bending_length = terms.smoothing_length;
    Run<2> single(model, s, Cell_scheme::spokes(), bending);
    Run<2> both(twice, s, Cell_scheme::spokes(), bending);
    const Report expected = single.deformation.deform(10, 0);
    const Report found = both.deformation.deform(10, 0);
    CHECK(expected && found);
    for(std::size_t k = 0; k < expected.energy.size(); ++k)
      CHECK_AT_MOST(std::abs(found.energy.at(k) / (2 * expected.energy[k]) - 1), 1e-9);
  }
}

// cells of stiffness 0, now here and now there, keep the pattern of the matrix
void test_no_stiffness(const Model& model)
{
  test_case() = "stiffness 0";
  const Scenario s = whole_scenario(model);
  Terms terms;
  terms.bending_length = 0.1 * diameter_of(model.points);
  Run<2> run(model, s, Cell_scheme::spokes_and_rims(), terms);
  std::vector<std::size_t> free;
  for(std::size_t v = 0; v < model.points.size(); ++v)
    if(s.selection[v] == 1)
      free.push_back(v);
  for(std::size_t v : {free[free.size() / 3], free[free.size() / 2]})
  {
    const bool is_first = terms.stiffness.empty();
    terms.stiffness.assign(model.points.size(), 1);
    terms.stiffness[v] = 0;
    apply(run.deformation, Cell_scheme::spokes_and_rims(), terms);
    run.deformation.reset();
    prepare(run.deformation, s, numbers(model.points.size()));
    const Report report = run.deformation.deform(5, 0);
    CHECK(report && report.stages.factor && report.stages.order == is_first);
    Run<2> fresh(model, s, Cell_scheme::spokes_and_rims(), terms);
    CHECK(fresh.deformation.deform(5, 0));
    CHECK_AT_MOST(largest_distance(run.points, fresh.points), 1e-9);
  }
}

void test_wrong_values(const Model& model)
{
  test_case() = "wrong values";
  const Scenario s = whole_scenario(model);
  Run<2> run(model, s, Cell_scheme::spokes_and_rims(), {});
  auto& d = run.deformation;
  const std::vector<Point> before = run.points;
  for(double wrong : {-1.0, std::nan(""), HUGE_VAL})
  {
    Options options = d.options();
    options.bending_length = wrong;
    CHECK(d.set_options(options).status == CGAL::ARAP::Status::invalid_option);
    options = d.options();
    options.smoothing_length = wrong;
    CHECK(d.set_options(options).status == CGAL::ARAP::Status::invalid_option);
    std::vector<double> stiffness(model.points.size(), 1);
    stiffness[7] = wrong;
    d.set_stiffness(stiffness);
    const Report report = d.deform();
    CHECK(report.status == CGAL::ARAP::Status::invalid_stiffness);
    CHECK(report.message.find("vertex 7 ") == 0);
    CHECK(run.points == before);
  }
  Options options = d.options();
  options.cells = Cell_scheme::elements();
  options.bending_length = 0.1;
  CHECK(d.set_options(options).status == CGAL::ARAP::Status::invalid_option);
  d.clear_stiffness();
  options = d.options();
  options.cells = Cell_scheme::k_ring(101);
  CHECK(d.set_options(options).status == CGAL::ARAP::Status::invalid_option);
  const std::size_t v = d.control_vertices()[0];
  CHECK(d.set_target_rotation(v, Eigen::Matrix3d(-Eigen::Matrix3d::Identity())).status ==
        CGAL::ARAP::Status::invalid_rotation);
  CHECK(d.set_target_rotation(v, Eigen::Matrix3d(2 * Eigen::Matrix3d::Identity())).status ==
        CGAL::ARAP::Status::invalid_rotation);
  const auto set_almost_identity = [&](double error) {
    return d.set_target_rotation(v, Eigen::Matrix3d((1 + error) * Eigen::Matrix3d::Identity()));
  };
  CHECK(set_almost_identity(1e-4).status == CGAL::ARAP::Status::invalid_rotation);
  CHECK(set_almost_identity(1e-6));
  CHECK(d.deform());
}

// Lengths beside which nothing else is left are refused with a sentence, whatever the size.
void test_huge_lengths(const Model& model)
{
  Scenario s = whole_scenario(model);
  for(const double size : {1.0, 1e-9})
  {
    Model scaled = model;
    Scenario scaled_s = s;
    for(auto* points : {&scaled.points, &scaled_s.targets})
      for(Eigen::Vector3d& p : *points)
        p *= size;
    for(double length : {1e8, 1e77, 1e160, 1e300})
      for(const bool is_bending : {true, false})
      {
        test_case() = "a length of " + std::to_string(length);
        Terms terms;
        (is_bending ? terms.bending_length : terms.smoothing_length) = length;
        Run<2> run(scaled, scaled_s, Cell_scheme::spokes_and_rims(), terms);
        const std::vector<Point> before = run.points;
        const Report report = run.deformation.deform();
        CHECK(report.status == CGAL::ARAP::Status::invalid_option);
        CHECK(report.message.find("million") != std::string::npos);
        CHECK(run.points == before);
        apply(run.deformation, Cell_scheme::spokes_and_rims(), {});
        CHECK(run.deformation.deform());
      }
  }
}

// On a mesh, in one call, by the class, and with any number of threads: the cells are in several
// blocks, and a group reaches from the first one to the last.
void test_mesh()
{
  test_case() = "a mesh";
  const Shape shape = grid("sheet", 60, 45, [](double u, double v) {
    return Eigen::Vector3d(6 * u, 4 * v, std::sin(3 * u + v));
  });
  const Scenario s = scenario(shape, 0.8);
  const Mesh rest = make_mesh<Mesh>(shape);
  std::map<Mesh::Vertex_index, Point> targets;
  std::map<Mesh::Vertex_index, Eigen::Quaterniond> rotations;
  for(Mesh::Vertex_index v : rest.vertices())
    if(s.selection[v] != 1)
    {
      targets.emplace(v, point(s.targets[v]));
      if(v % 3 == 0)
        rotations.emplace(v, turn(0.2, {1, 0, 0}));
    }
  const auto stiffness = [](auto c) { return 1 + double(std::size_t(c) % 3); };
  const auto groups = [](auto c) { return std::size_t(c) % 900 < 3 ? 0 : -1; };
  for(Cell_scheme cells : {Cell_scheme::spokes_and_rims(), Cell_scheme::elements(),
                           Cell_scheme::k_ring(2)})
  {
    Options options = options_for(cells);
    options.iterations = 10;
    options.smoothing_length = 0.1;
    options.bending_length = cells.has_vertex_cells() ? 0.1 : 0;
    const auto in_one_call = [&](unsigned int threads) {
      Mesh mesh = rest;
      options.threads = threads;
      namespace np = CGAL::parameters;
      const auto deform = [&](const auto& stiffness_map, const auto& group_map) {
        return CGAL::arap_deform(
          mesh, targets,
          np::target_rotations(rotations,
            np::cell_stiffness(stiffness_map,
              np::cell_groups(group_map, np::deformation_options(options)))));
      };
      CHECK(cells.has_vertex_cells() ? deform(stiffness, groups)
                                     : deform(of_simplices(stiffness), of_simplices(groups)));
      return points_of(mesh);
    };
    const std::vector<Point> one = in_one_call(1);
    CHECK(one == in_one_call(4));

    Mesh mesh = rest;
    CGAL::ARAP_deformation<Mesh> d(mesh);
    CHECK(d.set_options(options));
    d.insert_roi_vertices(mesh.vertices());
    for(const auto& [v, target] : targets)
      d.insert_control_vertex(v, target);
    for(const auto& [v, rotation] : rotations)
      CHECK(d.set_target_rotation(v, rotation));
    if(cells.has_vertex_cells())
      CHECK(d.set_stiffness(stiffness) && d.set_groups(groups));
    else
      CHECK(d.set_stiffness(of_simplices(stiffness)) && d.set_groups(of_simplices(groups)));
    CHECK(d.deform());
    CHECK_AT_MOST(largest_distance(points_of(mesh), one), 1e-9);
  }
}

// Generic lambdas are asked for vertices, unless they are declared: their bodies may compile for
// one kind only. Where cells are of the other kind, one that does not tell is refused.
void test_generic_maps()
{
  test_case() = "generic maps";
  const Shape shape = shapes()[1];
  const Scenario s = scenario(shape, 0.8);
  Mesh keys = make_mesh<Mesh>(shape);
  auto of_vertex = keys.add_property_map<Mesh::Vertex_index, double>("v:stiffness").first;
  std::map<Mesh::Face_index, double> of_face;
  using Deformation = CGAL::ARAP_deformation<Mesh>;
  const auto run = [&](Cell_scheme cells, const std::function<void(Deformation&)>& set) {
    Mesh mesh = make_mesh<Mesh>(shape);
    for(Mesh::Vertex_index v : mesh.vertices())
      of_vertex[v] = 1 + double(v % 3);
    for(Mesh::Face_index f : mesh.faces())
      of_face[f] = 1 + double(f % 4);
    auto d = prepared(mesh, s, options_for(cells));
    set(d);
    Report report = d.deform(5, 0);
    if(!report)
    {
      CHECK(report.status == CGAL::ARAP::Status::undeclared_map);
      CHECK(report.message.find("of_simplices()") != std::string::npos);
      d.clear_stiffness();
      d.clear_groups();
      report = d.deform(5, 0);
      CHECK(report);
      report.energy.clear();
    }
    return report.energy;
  };
  const auto vertex_stiffness = [&](auto v) { return of_vertex[v]; };
  const auto vertex_group = [&](auto v) { return int(of_vertex[v]) - 2; };
  const auto face_stiffness = [&](auto f) { return of_face.at(f); };
  const auto face_group = [&](auto f) { return int(of_face.at(f)) - 2; };
  const auto plain = [&](Cell_scheme cells) { return run(cells, [](Deformation&) {}); };
  const auto vertices = Cell_scheme::spokes_and_rims(), faces = Cell_scheme::elements();
  const auto stiff = [&](Deformation& d) { d.set_stiffness(vertex_stiffness); };
  const auto grouped = [&](Deformation& d) { d.set_groups(vertex_group); };
  const auto stiff_faces = [&](Deformation& d) { d.set_stiffness(of_simplices(face_stiffness)); };
  const auto grouped_faces = [&](Deformation& d) { d.set_groups(of_simplices(face_group)); };
  CHECK(run(vertices, stiff) == run(vertices, [&](Deformation& d) { d.set_stiffness(of_vertex); }));
  CHECK(run(vertices, grouped) == run(vertices, [&](Deformation& d) {
    d.set_groups([&](Mesh::Vertex_index v) { return vertex_group(v); });
  }));
  CHECK(run(faces, stiff_faces) == run(faces, [&](Deformation& d) { d.set_stiffness(of_face); }));
  CHECK(run(faces, grouped_faces) == run(faces, [&](Deformation& d) {
    d.set_groups([&](Mesh::Face_index f) { return face_group(f); });
  }));
  CHECK(run(vertices, grouped) == run(vertices, [&](Deformation& d) {
    d.set_groups([&](Mesh::Vertex_index v) { // an int would not hold them
      return vertex_group(v) * (std::int64_t(1) << 32);
    });
  }));
  CHECK(run(faces, stiff).empty());
  CHECK(run(faces, grouped).empty());
  // a vector tells no keys, and faces of a mesh have no numbers that it could be by
  const std::vector<double> numbers(keys.number_of_faces(), 2);
  CHECK(run(faces, [&](Deformation& d) { d.set_stiffness(numbers); }).empty());
  CHECK(run(faces, [&](Deformation& d) { d.set_groups(numbers); }).empty());
  CHECK(!run(vertices, [&](Deformation& d) { d.set_stiffness(numbers); }).empty());
  CHECK(run(vertices, stiff_faces) == plain(vertices));
  CHECK(run(vertices, grouped_faces) == plain(vertices));
  CHECK(run(vertices, stiff) != plain(vertices) && run(faces, stiff_faces) != plain(faces));
  CHECK(run(vertices, grouped) != plain(vertices) && run(faces, grouped_faces) != plain(faces));
}

void test_all()
{
  const std::vector<Model> models = iterates::surfaces();
  test_minimizers<2>(models.front());
  test_minimizers<3>(iterates::solid());
  test_motions<2>(models.back());
  test_motions<3>(iterates::solid());
  test_orders<2>(models.back());
  test_orders<3>(iterates::solid());
  test_limits<2>(models.front());
  test_limits<2>(models.back());
  test_limits<3>(iterates::solid());
  test_one_frame<2>(models.front());
  test_one_frame<3>(iterates::solid());
  test_frames_of_motions(models.front());
  test_groups(models.front());
  test_changes(models.front());
  test_smooth_starts(models.front());
  test_rigid_motions(models.front());
  test_frames_everywhere(models.front());
  test_soft_frames(models.front());
  test_long_lengths<2>(models.front());
  test_long_lengths<3>(iterates::solid());
  test_states<2>(models.front());
  test_states<3>(iterates::solid());
  test_other_regions<2>(models.front());
  test_other_regions<3>(iterates::solid());
  for(const Model& model : models)
    test_double_faces(model);
  test_no_stiffness(models.front());
  test_wrong_values(models.front());
  test_huge_lengths(models.front());
  test_mesh();
  test_generic_maps();
}

} // namespace identities

// The rotations of the handles, interpolated: against a dense computation, and where they are
// taken.
namespace initial_guess {

using CGAL::ARAP::Initial_guess;

Report run(const Shape& shape, const Scenario& s, Initial_guess guess, Cell_scheme cells,
           unsigned int iterations, std::vector<Point>& points)
{
  Mesh mesh = make_mesh<Mesh>(shape);
  auto d = prepared(mesh, s, options_for(cells, Minimizer::quasi_newton, guess));
  const Report report = d.deform(iterations, iterations == 0 ? 0 : 1e-4);
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
  points = points_of(mesh);
  return report;
}

// The guess is the same whether the region was cut to what can move or not: here handles reach far,
// and are bent.
void test_cut_region(Initial_guess guess)
{
  test_case() = "a region that is cut";
  const Shape shape = grid("sheet", 15, 9, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0.1 * std::sin(5 * u) * v);
  });
  std::vector<std::size_t> held; // two thirds
  for(std::size_t v = 0; v < shape.points.size(); ++v)
    if(shape.points[v][0] < 0.7 || shape.points[v][0] > 1.35)
      held.push_back(v);
  const auto run = [&](bool is_whole) {
    Mesh mesh = make_mesh<Mesh>(shape);
    CGAL::ARAP_deformation<Mesh> d(mesh);
    CHECK(d.set_options(options_for(Cell_scheme::spokes_and_rims(), Minimizer::automatic, guess)));
    d.insert_roi_vertices(vertices(mesh));
    d.insert_control_vertex(Mesh::Vertex_index(0));
    if(is_whole)
      CHECK(d.deform(0, 0));
    for(std::size_t v : held)
    {
      const Eigen::Vector3d& p = shape.points[v];
      d.insert_control_vertex(Mesh::Vertex_index(v),
                              point(turn(0.6 * p[0] * p[0], {1, 0.3, 0}) * p));
    }
    const Report report = d.deform(0, 0);
    CHECK(report);
    CHECK(report.stages.region == !is_whole);
    return points_of(mesh);
  };
  const std::vector<Point> whole = run(true), cut = run(false);
  std::vector<Eigen::Vector3d> expected;
  for(const Point& p : whole)
    expected.push_back(vector(p));
  CHECK_AT_MOST(largest_distance(cut, expected), 1e-9);
}

// Rotations between handles that are turned differently, against the dense reference: on surfaces
// and tetrahedra, with cells at vertices.
template <int Dimension>
void test_two_handles(const Model& model)
{
  Scenario s = scenario(Shape{"", model.points, {}}, 1.2);
  const std::vector<int> handles = s.selection; // 0 and 2
  const auto moved = [&](int handle, double angle) {
    const Affine_map motion = rigid_motion(angle, {1, double(handle), -1}, {0.3, 0, 0.1});
    for(std::size_t v = 0; v < s.targets.size(); ++v)
      if(handles[v] == handle)
        s.targets[v] = motion * model.points[v];
    return Eigen::Vector3d(angle * Eigen::Vector3d(1, handle, -1).normalized());
  };
  const Eigen::Vector3d first = moved(0, -0.7), second = moved(2, 1.1);
  for(int& status : s.selection)
    status = status == 0 ? 2 : status;
  for(const bool has_rims : {false, true})
  {
    test_case() = model.name + ", guess between two handles";
    std::vector<Point> points = points_of(model.points);
    CGAL::ARAP_deformation<Soup<Dimension>> d(Soup<Dimension>(points, model.simplices));
    prepare(d, s, numbers(points.size()));
    CHECK(d.set_options(options_for(has_rims ? Cell_scheme::spokes_and_rims()
                                             : Cell_scheme::spokes(),
                                    Minimizer::local_global, Initial_guess::rotations)));
    CHECK(d.deform(0, 0));
    Dense_reference reference(model.points, model.simplices, Dimension, s.selection,
                              has_rims ? Dense_reference::SPOKES_AND_RIMS : Dense_reference::SPOKES,
                              Dense_reference::SAFE);
    std::vector<Eigen::Vector3d> x = s.targets, vectors(x.size(), Eigen::Vector3d::Zero());
    for(std::size_t v = 0; v < x.size(); ++v)
      if(handles[v] != 1)
        vectors[v] = handles[v] == 0 ? first : second;
    reference.rotation_guess(vectors, x);
    CHECK_AT_MOST(largest_distance(points, x), 1e-9 * diameter_of(model.points));
  }
}

// counts its solutions and factorizations
struct Counting_solver : CGAL::ARAP::Multifrontal_cholesky_solver
{
  static int& count() { static int n = 0; return n; }
  static int& factorizations() { static int n = 0; return n; }

  bool factorize(const CGAL::ARAP::Sparse_matrix& a)
  {
    ++factorizations();
    return CGAL::ARAP::Multifrontal_cholesky_solver::factorize(a);
  }

  bool solve(std::size_t n, CGAL::ARAP::Coordinates* x)
  {
    ++count();
    return CGAL::ARAP::Multifrontal_cholesky_solver::solve(n, x);
  }
};

using Counted = CGAL::ARAP_deformation<Mesh, CGAL::ARAP_deformation_traits<Counting_solver>>;

// of a frame with three iterations
int number_of_solutions(Counted& d)
{
  const int before = Counting_solver::count();
  CHECK(d.deform(3, 0));
  return Counting_solver::count() - before;
}

// A part that has been turned rigidly, and is settled, stays there, whatever the angle, also where
// cells of another part share their rotation.
void test_settled_part()
{
  test_case() = "a settled part beside one with a group";
  const Shape shape = two_components(grid("sheet", 5, 3, [](double u, double v) {
    return Eigen::Vector3d(5 * u + 0.3 * v * v, 3 * v, 0.2 * std::sin(7 * u * v));
  }));
  const int n = int(shape.points.size()) / 2;
  for(int k = 0; k < 20; ++k)
  {
    Mesh mesh = make_mesh<Mesh>(shape);
    CGAL::ARAP_deformation<Mesh> d(mesh);
    CHECK(d.set_options(options_for(Cell_scheme::spokes_and_rims(), Minimizer::automatic,
                                    Initial_guess::rotations)));
    d.insert_roi_vertices(vertices(mesh));
    d.set_groups([](Mesh::Vertex_index v) { return int(v) == 8 || int(v) == 9 ? 0 : -1; });
    const Affine_map motion = rigid_motion(0.7 + 0.01 * k, {1, 2, 3}, {0, 0, 0});
    for(int v = n; v < 2 * n; ++v)
      mesh.point(Mesh::Vertex_index(v)) = point(motion * shape.points[v]);
    for(int v : {0, 1, n, 2 * n - 1})
      d.insert_control_vertex(Mesh::Vertex_index(v));
    const Report report = d.deform(0, 0);
    CHECK(report);
    CHECK_AT_MOST(report.energy[0], 1e-20);
  }
}

// Parts from which handles are torn away take the guess each by itself, or all together if they are
// many. One that ends with a spike, where the guess does no better, stays as it is.
void test_torn_parts()
{
  const int m = 30, n = 6, k = 8;
  const Shape strip = grid("strip", m, n, [](double u, double v) {
    return Eigen::Vector3d(5 * u, v, 0);
  });
  const Shape sheet = grid("sheet", k, k, [](double u, double v) {
    return Eigen::Vector3d(3 * u, 3 * v, 0);
  });
  // by how much the energy is higher when the handles of strips are torn away
  const auto rise = [&](int number_of_strips, bool has_spike) {
    test_case() = std::to_string(number_of_strips) + " torn strips";
    Shape shape;
    for(int s = 0; s < number_of_strips; ++s)
      shape = joined(shape, strip, {0, 2.0 * s, 0});
    const std::size_t first_of_sheet = shape.points.size();
    if(has_spike)
      shape = joined(shape, sheet, {10, 0, 0});
    Mesh mesh = make_mesh<Mesh>(shape);
    CGAL::ARAP_deformation<Mesh> d(mesh);
    d.insert_roi_vertices(vertices(mesh));
    std::vector<Mesh::Vertex_index> handles;
    for(Mesh::Vertex_index v : mesh.vertices())
    {
      const double x = shape.points[v].x(), y = shape.points[v].y();
      const bool is_of_strip = std::size_t(v) < first_of_sheet;
      if(is_of_strip ? x == 0 || x == 5 : x == 10 || x == 13 || y == 0 || y == 3)
        d.insert_control_vertex(v);
      if(is_of_strip && x == 5)
        handles.push_back(v);
    }
    if(has_spike)
    {
      const Mesh::Vertex_index middle(first_of_sheet + std::size_t(k) / 2 * (k + 2));
      d.insert_control_vertex(middle, Point(11.5, 1.5, 12));
    }
    const Report before = d.deform(1000, 1e-4);
    CHECK(before);
    d.translate(handles, Kernel::Vector_3(-4, 0, 2));
    const Report after = d.deform([](const auto&) { return CGAL::ARAP::Visitor_action::stop; });
    CHECK(after && after.initial_guess == Initial_guess::rotations);
    return after.final_energy() - before.final_energy();
  };
  const double of_one = rise(1, false);
  CHECK_AT_MOST(std::abs(rise(1, true) / of_one - 1), 1e-3);
  CHECK_AT_MOST(std::abs(rise(2, true) / of_one - 2), 1e-3);
  CHECK_AT_MOST(std::abs(rise(9, false) / of_one - 9), 1e-3);
}

// A strip that is twisted by a full turn holds it, also if something is far away.
void test_far_part()
{
  test_case() = "a twisted strip, and something far away";
  const int m = 40, n = 4;
  const Shape strip = grid("strip", m, n, [](double u, double v) {
    return Eigen::Vector3d(5 * u, 0.5 * v - 0.25, 0);
  });
  const Shape shape = joined(strip, grid("sheet", 2, 2, [](double u, double v) {
    return Eigen::Vector3d(u, v, 0);
  }), {1e6, 0, 0});
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  d.insert_roi_vertices(vertices(mesh));
  std::vector<Mesh::Vertex_index> handle;
  for(std::size_t v = 0; v <= strip.points.size(); ++v) // one of the sheet, too
    if(const double x = shape.points[v].x(); x == 0 || x >= 5)
    {
      d.insert_control_vertex(Mesh::Vertex_index(v));
      if(x == 5)
        handle.emplace_back(v);
    }
  for(int step = 1; step <= 12; ++step)
  {
    const Eigen::AngleAxisd turn(step * std::acos(-1.0) / 6, Eigen::Vector3d::UnitX());
    for(Mesh::Vertex_index v : handle)
      d.set_target_position(v, step == 12 ? point(shape.points[v]) : point(turn * shape.points[v]));
    const Report report = d.deform();
    CHECK(report && report.final_energy() > 0);
    if(step == 12)
      CHECK(report.final_energy() > 0.09);
  }
}

// Vertices and points that are held alone have no rotations. But where they have moved almost as a
// rigid motion does, in each of two components, the guess has it.
void test_single_handles()
{
  const Shape shape = two_components(grid("sheet", 8, 5, [](double u, double v) {
    return Eigen::Vector3d(8 * u + 0.3 * v * v, 5 * v, 0.2 * std::sin(7 * u * v));
  }));
  const std::size_t number_of_triangles = shape.triangles.size() / 2;
  const std::array<Affine_map, 2> motions = {rigid_motion(2, {1, 2, 3}, {0, 0, 0}),
                                             rigid_motion(-1.3, {1, 0, -1}, {0, 0, 5})};
  enum Kind { vertices_alone, soft_vertices, points };
  for(const Kind kind : {vertices_alone, soft_vertices, points})
    for(const Initial_guess guess : {Initial_guess::rotations, Initial_guess::automatic})
    {
      test_case() = "handles without rotations, " + std::to_string(kind);
      Mesh mesh = make_mesh<Mesh>(shape);
      CGAL::ARAP_deformation<Mesh> d(mesh);
      CHECK(d.set_options(options_for(Cell_scheme::spokes_and_rims(), Minimizer::local_global,
                                      guess)));
      d.insert_roi_vertices(vertices(mesh));
      for(std::size_t component = 0; component < 2; ++component)
        for(std::size_t k = 0; k < 4; ++k)
        {
          const std::size_t face =
            component * number_of_triangles + k * (number_of_triangles - 1) / 3;
          const auto& [a, b, c] = shape.triangles[face];
          const Eigen::Vector3d place =
            kind == points ? Eigen::Vector3d((shape.points[a] + shape.points[b]) / 2)
                           : shape.points[a];
          const Point target = point(motions[component] * place +
                                     Eigen::Vector3d(0, 0, k % 2 == 0 ? 0.01 : -0.01));
          if(kind == points)
          {
            const auto inserted =
              d.insert_control_point(Mesh::Face_index(face), {0.5, 0.5, 0});
            CHECK(inserted && d.set_target_position(inserted.point, target));
            continue;
          }
          d.insert_control_vertex(Mesh::Vertex_index(a), target);
          if(kind == soft_vertices)
            CHECK(d.set_target_weight(Mesh::Vertex_index(a), 1000));
        }
      const Report report = d.deform(0, 0);
      CHECK(report);
      // a control point moves what is around it, smoothly, and is never torn away
      if(guess == Initial_guess::automatic && kind == points)
        continue;
      CHECK(report.initial_guess == Initial_guess::rotations);
      double largest = 0;
      for(std::size_t v = 0; v < shape.points.size(); ++v)
      {
        const Eigen::Vector3d expected =
          motions[v >= shape.points.size() / 2] * shape.points[v];
        largest = larger(largest, (vector(mesh.point(Mesh::Vertex_index(v))) - expected).norm());
      }
      CHECK_AT_MOST(largest, 0.1);
    }
}

// Two square tubes, the second of which is twisted by three quarters of a turn, in steps. When the
// handle of the first one is torn away, it stays.
void test_other_part()
{
  test_case() = "a twisted part beside a torn one";
  const std::array<std::array<double, 2>, 8> square = {
    {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}}};
  const std::size_t rings = 25;
  Shape tube;
  for(std::size_t ring = 0; ring < rings; ++ring)
    for(const auto& [y, z] : square)
      tube.points.emplace_back(double(ring), y, z);
  for(std::size_t v = 0; v + 8 < tube.points.size(); ++v)
  {
    const std::size_t next = v % 8 == 7 ? v - 7 : v + 1;
    tube.triangles.push_back({v, next, next + 8});
    tube.triangles.push_back({v, next + 8, v + 8});
  }
  const Shape shape = two_components(tube);
  const std::size_t n = tube.points.size();
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  d.insert_roi_vertices(vertices(mesh));
  std::vector<Mesh::Vertex_index> handles[2];
  for(std::size_t v = 0; v < 2 * n; ++v)
    if(const std::size_t ring = v % n / 8; ring == 0 || ring == rings - 1)
    {
      d.insert_control_vertex(Mesh::Vertex_index(v));
      if(ring > 0)
        handles[v / n].emplace_back(v);
    }
  for(int step = 0; step < 9; ++step)
  {
    d.rotate(handles[1], Eigen::Vector3d(0, 0, 0),
             Eigen::AngleAxisd(std::acos(-1.0) / 6, Eigen::Vector3d::UnitX()));
    CHECK(d.deform());
  }
  const std::vector<Point> before = points_of(mesh);
  d.translate(handles[0], Kernel::Vector_3(-3, 0, 8));
  CHECK(d.deform());
  for(std::size_t v = n; v < 2 * n; ++v)
    CHECK_AT_MOST(distance(vector(mesh.point(Mesh::Vertex_index(v))), vector(before[v])), 0.1);
}

// A sheet that is held by one handle, which is turned again and again by quaternions in single
// precision: it turns with the handle.
void test_rounded_targets()
{
  test_case() = "targets that are rounded to float";
  const Shape shape = grid("sheet", 20, 20, [](double u, double v) {
    return Eigen::Vector3d(u, v, 0.02 * std::sin(14 * u) * std::cos(10 * v));
  });
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh> d(mesh);
  d.insert_roi_vertices(vertices(mesh));
  std::vector<Mesh::Vertex_index> handle;
  for(Mesh::Vertex_index v : mesh.vertices())
    if(const Eigen::Vector3d& p = shape.points[v]; p[0] > 0.85 && std::abs(p[1] - 0.5) < 0.15)
    {
      d.insert_control_vertex(v);
      handle.push_back(v);
    }
  const Eigen::Vector3f axis(0, 1, 0), center(1, 0.5f, 0);
  for(int frame = 1; frame <= 60; ++frame)
  {
    d.rotate(handle, center, Eigen::Quaternionf(Eigen::AngleAxisf(0.02f, axis)));
    CHECK(d.deform(3, 0));
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.02 * frame, axis.cast<double>()).matrix();
    const Eigen::Vector3d c = center.cast<double>();
    for(Mesh::Vertex_index v : mesh.vertices())
      CHECK_AT_MOST(distance(vector(mesh.point(v)), turn * (shape.points[v] - c) + c), 1e-4);
    CHECK(d.set_target_rotations(handle));
    for(Mesh::Vertex_index v : handle)
      d.erase_target_rotation(v);
  }
}

// What is torn away does not depend on the corner with which faces begin.
void test_first_corners()
{
  test_case() = "faces that begin elsewhere";
  Shape shape = grid("sheet", 6, 6, [](double u, double v) {
    return Eigen::Vector3d(6 * u, 6 * v, 0.2 * std::sin(6 * u + 12 * v));
  });
  const std::size_t handle = 24, neighbor = 23;
  std::vector<double> energies;
  for(const std::size_t place : {0u, 1u, 2u})
  {
    for(auto& t : shape.triangles)
      if(const auto v = std::find(t.begin(), t.end(), neighbor); v != t.end())
      {
        std::rotate(t.begin(), v, t.end());
        std::rotate(t.begin(), t.end() - place, t.end());
      }
    const auto faces = as_polygons(shape.triangles);
    std::vector<Point> points = points_of(shape.points);
    CGAL::ARAP_deformation<Soup<2>> d(Soup<2>(points, faces));
    d.insert_roi_vertices(numbers(points.size()));
    for(std::size_t v = 0; v < points.size(); ++v)
      if(shape.points[v][1] == 0)
        d.insert_control_vertex(v);
    const Eigen::Vector3d side = shape.points[handle] - shape.points[neighbor];
    d.insert_control_vertex(handle, point(shape.points[handle] + 0.95 * side));
    const Report report = d.deform(0, 0);
    CHECK(report);
    energies.push_back(report.energy[0]);
    CHECK_AT_MOST(std::abs(energies.back() / energies[0] - 1), 1e-12);
  }
}

// A frame whose target has no weight is no handle: the guess beside single ones is not made of
// rounding errors, which depend on the order of the vertices.
void test_frame_without_weight()
{
  test_case() = "a frame of weight 0";
  const Shape shape = grid("sheet", 11, 7, [](double u, double v) {
    return Eigen::Vector3d(11 * u + 0.3 * v * v, 7 * v, 0.2 * std::sin(7 * u * v));
  });
  std::vector<std::size_t> place;
  const Shape other = shuffled(shape, place);
  const auto energy = [&](const Shape& s, const auto& vertex) {
    Mesh mesh = make_mesh<Mesh>(s);
    CGAL::ARAP_deformation<Mesh> d(mesh);
    CHECK(d.set_options(options_for(Cell_scheme::spokes_and_rims(), Minimizer::automatic,
                                    Initial_guess::rotations)));
    d.insert_roi_vertices(vertices(mesh));
    for(std::size_t v : {0u, 7u, 95u, 40u})
      d.insert_control_vertex(vertex(v));
    d.translate(vertex(7), Kernel::Vector_3(0, 0, 1));
    CHECK(d.set_target_weight(vertex(40), 0));
    CHECK(d.set_target_rotation(vertex(40), Eigen::AngleAxisd(1.3, Eigen::Vector3d::UnitX())));
    const Report report = d.deform(0, 0);
    CHECK(report);
    return report.energy[0];
  };
  const double first =
    energy(shape, [](std::size_t v) { return Mesh::Vertex_index(v); });
  const double second =
    energy(other, [&](std::size_t v) { return Mesh::Vertex_index(place[v]); });
  CHECK_AT_MOST(std::abs(first / second - 1), 1e-9);
}

// A guess is tried, but not in the frames of a drag after that; `between` is done before them.
template <typename Function>
void check_tried_once(Counted& d, const std::vector<Mesh::Vertex_index>& handle,
                      const Function& between)
{
  CHECK(number_of_solutions(d) > 3);
  between();
  for(int frame = 0; frame < 5; ++frame)
  {
    d.translate(handle, Kernel::Vector_3(0, 0, 0.01));
    CHECK(number_of_solutions(d) == 3);
  }
}

Shape flat_sheet()
{
  return grid("sheet", 20, 10, [](double u, double v) { return Eigen::Vector3d(2 * u, v, 0); });
}

// A soft target of little weight that stays far away: the guess is tried once, not in each frame of
// a drag.
void test_far_soft_target()
{
  test_case() = "a soft target far away";
  const Shape shape = flat_sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  Counted d(mesh);
  CHECK(d.set_options(options_for(Cell_scheme::spokes_and_rims(), Minimizer::local_global,
                                  Initial_guess::automatic)));
  d.insert_roi_vertices(vertices(mesh));
  std::vector<Mesh::Vertex_index> handle;
  for(Mesh::Vertex_index v : mesh.vertices())
    if(const double u = shape.points[v][0]; u == 0)
      d.insert_control_vertex(v);
    else if(u == 2)
    {
      d.insert_control_vertex(v);
      handle.push_back(v);
    }
    else if(v % 10 == 5 && 0.9 < u && u < 1.1)
    {
      d.insert_control_vertex(v, point(shape.points[v] + Eigen::Vector3d(0, 0, 1.5)));
      CHECK(d.set_target_weight(v, 0.01));
    }
  check_tried_once(d, handle, [] {});
}

// A handle that has turned, on a coarse mesh, and then moves on. It is torn away once.
void test_turned_handle()
{
  test_case() = "a handle that has turned";
  const Shape shape = grid("sheet", 4, 2, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0);
  });
  Mesh mesh = make_mesh<Mesh>(shape);
  Counted d(mesh);
  CHECK(d.set_options(options_for(Cell_scheme::spokes_and_rims(), Minimizer::local_global,
                                  Initial_guess::automatic)));
  d.insert_roi_vertices(vertices(mesh));
  std::vector<Mesh::Vertex_index> handle;
  for(Mesh::Vertex_index v : mesh.vertices())
    if(const double u = shape.points[v][0]; u == 0 || u == 2)
    {
      d.insert_control_vertex(v);
      if(u == 2)
        handle.push_back(v);
    }
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
  d.rotate(handle, Eigen::Vector3d(1, 0, 0), Eigen::AngleAxisd(1.5, axis));
  check_tried_once(d, handle, [&d] { CHECK(d.deform()); });
}

// The guess costs two solutions of the system: of the rotations, and the global step.
void test_cost_of_guess()
{
  test_case() = "the cost of a guess";
  const Shape shape = flat_sheet();
  const Scenario s = scenario(shape, 1.2);
  Mesh mesh = make_mesh<Mesh>(shape);
  Counted d(mesh);
  CHECK(d.set_options(options_for(Cell_scheme::spokes_and_rims(), Minimizer::local_global,
                                  Initial_guess::rotations)));
  prepare(d, s, all_vertices(mesh));
  CHECK(d.preprocess());
  const int before = Counting_solver::count();
  CHECK(d.deform(0, 0));
  CHECK(Counting_solver::count() == before + 2);
}

// The system of smooth rotations is factorized once, also if a run in between does not need it.
void test_factor_of_rotations()
{
  test_case() = "the factor of smooth rotations";
  const Shape shape = flat_sheet();
  Mesh mesh = make_mesh<Mesh>(shape);
  Counted d(mesh);
  Options options = d.options();
  options.smoothing_length = 0.1;
  CHECK(d.set_options(options));
  prepare(d, scenario(shape, 1.2), all_vertices(mesh));
  const int before = Counting_solver::factorizations();
  CHECK(d.deform(2, 1e-3));
  CHECK(Counting_solver::factorizations() == before + 2);
  CHECK(d.deform(3, 0) && d.deform(2, 1e-3));
  CHECK(Counting_solver::factorizations() == before + 2);
}

// A Laplacian guess that is not found is given up when that is known: 300 iterations, two solutions
// each.
void test_cost_of_lost_guess()
{
  test_case() = "the cost of a Laplacian guess that is not found";
  const Shape shape = grid("sheet", 40, 40, [](double u, double v) {
    return Eigen::Vector3d(u, v, 0.05 * std::sin(7 * u) * std::cos(5 * v));
  });
  Mesh mesh = make_mesh<Mesh>(shape);
  Counted d(mesh);
  Options options = options_for(Cell_scheme::spokes(), Minimizer::local_global,
                                Initial_guess::laplacian);
  options.bending_length = 0.2 * shape.diameter();
  CHECK(d.set_options(options));
  prepare(d, scenario(shape), all_vertices(mesh));
  CHECK(d.preprocess());
  const int before = Counting_solver::count();
  const Report report = d.deform(0, 0);
  CHECK(report && report.initial_guess == Initial_guess::previous);
  CHECK(Counting_solver::count() - before == 600);
}

void test_all()
{
  test_cut_region(Initial_guess::rotations);
  test_cut_region(Initial_guess::automatic);
  test_settled_part();
  test_single_handles();
  test_other_part();
  test_torn_parts();
  test_far_part();
  test_first_corners();
  test_rounded_targets();
  test_frame_without_weight();
  test_far_soft_target();
  test_turned_handle();
  test_cost_of_guess();
  test_factor_of_rotations();
  test_cost_of_lost_guess();
  test_two_handles<2>(iterates::surfaces().back());
  test_two_handles<3>(iterates::solid());
  int number_of_lower = 0;
  for(const Shape& shape : shapes())
  {
    if(shape.points.size() > 180 || shape.points.size() < 20 || shape.name.find("two of") == 0)
      continue;
    test_case() = shape.name + ", initial guess";
    for(const bool is_far : {false, true})
    {
      Scenario s = scenario(shape, 1.2);
      for(std::size_t v = 0; v < s.targets.size() && !is_far; ++v)
        s.targets[v] = shape.points[v] + Eigen::Vector3d(s.selection[v] == 2 ? 0.02 : 0, 0, 0) *
                                           shape.diameter();
      std::vector<Point> points, rotated, before;
      const Report rotations =
        run(shape, s, Initial_guess::rotations, Cell_scheme::spokes(), 0, rotated);
      Dense_reference reference(shape.points, as_polygons(shape.triangles), 2, s.selection,
                                Dense_reference::SPOKES, Dense_reference::SAFE);
      std::vector<Eigen::Vector3d> x = s.targets, vectors(x.size(), Eigen::Vector3d::Zero());
      std::vector<Eigen::Vector3d> handle, place; // its rotation, from two directions of its motion
      for(std::size_t v = 0; v < x.size(); ++v)
        if(s.selection[v] == 2)
        {
          handle.push_back(shape.points[v]);
          place.push_back(x[v]);
        }
      Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
      for(std::size_t k = 1; k < handle.size(); ++k)
        covariance += (handle[k] - handle[0]) * (place[k] - place[0]).transpose();
      const Eigen::AngleAxisd motion(Dense_reference::closest_rotation(covariance));
      for(std::size_t v = 0; v < x.size(); ++v)
        if(s.selection[v] == 2)
          vectors[v] = motion.angle() * motion.axis();
      reference.rotation_guess(vectors, x);
      CHECK_AT_MOST(largest_distance(rotated, x), 1e-6 * shape.diameter());

      // by itself, where handles are torn away and the energy is lower
      const Report previous =
        run(shape, s, Initial_guess::previous, Cell_scheme::spokes(), 0, before);
      const Report automatic =
        run(shape, s, Initial_guess::automatic, Cell_scheme::spokes(), 0, points);
      const bool is_lower = is_far && rotations.energy[0] < previous.energy[0];
      number_of_lower += is_lower;
      CHECK(points == (is_lower ? rotated : before));
      CHECK(previous.initial_guess == Initial_guess::previous);
      CHECK(rotations.initial_guess == Initial_guess::rotations);
      CHECK(automatic.initial_guess == (is_lower ? rotations : previous).initial_guess);
      // by which no run ends higher than it does without
      for(Cell_scheme cells : {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims(),
                               Cell_scheme::elements(), Cell_scheme::k_ring(1)})
      {
        const Report with = run(shape, s, Initial_guess::automatic, cells, 300, points);
        const Report without = run(shape, s, Initial_guess::previous, cells, 300, points);
        CHECK(with && without);
        CHECK_AT_MOST(with.final_energy() / without.final_energy(), 1 + 1e-4);
      }
    }
  }
  CHECK(number_of_lower > 3);
}

} // namespace initial_guess

// A pulled vertex is no spike: the shape around it is the same at every resolution.
namespace spikes {

// A square or a cube whose border is fixed, with the vertex in its middle, and others at distances
// from it.
struct Pulled
{
  Model model;
  std::size_t middle;
  std::vector<std::size_t> places;
};

Pulled square(int quads)
{
  Pulled pulled;
  const Shape shape = grid("square", quads, quads, [](double u, double v) {
    return Eigen::Vector3d(u, v, 0);
  });
  pulled.model = {shape.name, shape.points, as_polygons(shape.triangles)};
  const auto vertex = [=](int i, int j) { return std::size_t(i * (quads + 1) + j); };
  pulled.middle = vertex(quads / 2, quads / 2);
  for(int k : {0, 1, 2, 3, 4, 6}) // distances of 0, .05, ... .3
    pulled.places.push_back(vertex(quads / 2 + k * quads / 20, quads / 2));
  return pulled;
}

Pulled cube(int edges)
{
  Pulled pulled;
  const Block cubes = unit_cubes(edges, edges, edges);
  for(const auto& p : cubes.points)
    pulled.model.points.push_back(p / edges);
  pulled.model.simplices = as_polygons(cubes.tetrahedra);
  const auto vertex = [=](int x, int y, int z) {
    return std::size_t((x * (edges + 1) + y) * (edges + 1) + z);
  };
  const int m = edges / 2;
  pulled.middle = vertex(m, m, m);
  for(int k : {edges / 8, edges / 4, 3 * edges / 8})
  {
    pulled.places.push_back(vertex(m + k, m, m));
    pulled.places.push_back(vertex(m, m, m + k));
  }
  return pulled;
}

// how high these are lifted when the middle is lifted by a fifth of the size
template <int Dimension>
std::vector<double> heights(const Pulled& pulled, Cell_scheme cells, double bending_length,
                            Report& report, double size = 1)
{
  std::vector<Point> points;
  for(const Eigen::Vector3d& p : pulled.model.points)
    points.push_back(point(size * p));
  const std::vector<Point> rest = points;
  CGAL::ARAP_deformation<Soup<Dimension>> d(Soup<Dimension>(points, pulled.model.simplices));
  Options options;
  options.cells = cells;
  options.bending_length = bending_length * size * std::sqrt(double(Dimension));
  options.tolerance = 1e-6;
  CHECK(d.set_options(options));
  d.insert_roi_vertices(numbers(points.size()));
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    const Eigen::Vector3d p = pulled.model.points[v];
    if((p.head<Dimension>().array() == 0).any() || (p.head<Dimension>().array() == 1).any())
      d.insert_control_vertex(v);
  }
  d.insert_control_vertex(pulled.middle);
  d.translate(pulled.middle, Eigen::Vector3d(0, 0, 0.2 * size));
  report = d.deform();
  CHECK(report);
  std::vector<double> result;
  for(std::size_t v : pulled.places)
    result.push_back((points[v].z() - rest[v].z()) / size);
  return result;
}

// The largest change of a height from each resolution to the next one.
template <int Dimension>
std::vector<double> changes(const std::vector<int>& resolutions, Cell_scheme cells,
                            double bending_length)
{
  std::vector<double> result, last;
  for(int resolution : resolutions)
  {
    Report report;
    const std::vector<double> now = heights<Dimension>(
      Dimension == 2 ? square(resolution) : cube(resolution), cells, bending_length, report);
    std::cout << test_case() << ", length " << bending_length << ", " << resolution
              << " edges a side: energy " << report.final_energy() << ", " << report.iterations
              << " iterations, heights";
    for(double height : now)
      std::cout << ' ' << height;
    std::cout << std::endl;
    for(std::size_t k = 0; k < last.size(); ++k)
      if(k == 0)
        result.push_back(std::abs(now[k] - last[k]));
      else
        result.back() = larger(result.back(), std::abs(now[k] - last[k]));
    last = now;
  }
  return result;
}

void test_square()
{
  std::vector<int> resolutions = {40, 80};
  if(is_long_run())
    resolutions.push_back(160);
  for(const auto& [name, cells, length] :
      {std::tuple("spokes and rims", Cell_scheme::spokes_and_rims(), 0.1),
       std::tuple("spokes and rims", Cell_scheme::spokes_and_rims(), 0.02), // about an edge
       std::tuple("spokes", Cell_scheme::spokes(), 0.02),
       std::tuple("1-ring", Cell_scheme::k_ring(1), 0.1)})
  {
    test_case() = std::string("a pulled vertex of a sheet, ") + name;
    for(double change : changes<2>(resolutions, cells, length))
      CHECK_AT_MOST(change, 2e-3);
  }
  test_case() = "a pulled vertex of a sheet, without bending";
  for(double change : changes<2>(resolutions, Cell_scheme::spokes_and_rims(), 0))
    CHECK(change > 4e-3);
}

// Around a vertex of a volume the shape has a tip, so that more edges are needed. Without bending
// there is nothing but a spike, as thin as the edges are long.
void test_cube()
{
  std::vector<int> resolutions = {8, 16};
  if(is_long_run())
    resolutions.push_back(24);
  for(const auto& cells : {Cell_scheme::spokes_and_rims(), Cell_scheme::spokes()})
  {
    if(cells == Cell_scheme::spokes() && !is_long_run())
      continue;
    test_case() = "a pulled vertex of a cube";
    const std::vector<double> bent = changes<3>(resolutions, cells, 0.2);
    CHECK_AT_MOST(bent[0], 8e-3);
    if(bent.size() > 1)
      CHECK_AT_MOST(bent[1], 2e-3);
  }
  test_case() = "a pulled vertex of a cube, without bending";
  for(double change : changes<3>(resolutions, Cell_scheme::spokes_and_rims(), 0))
    CHECK(change > 1e-2);
}

void test_all()
{
  test_square();
  test_cube();
  test_case() = "a pulled vertex, ten times the size";
  const auto rims = Cell_scheme::spokes_and_rims();
  Report report;
  const std::vector<double> one = heights<2>(square(20), rims, 0.1, report),
                            ten = heights<2>(square(20), rims, 0.1, report, 10);
  for(std::size_t k = 0; k < one.size(); ++k)
    CHECK_AT_MOST(std::abs(one[k] - ten[k]), 1e-6);
  Report report_without;
  const std::vector<double> bent = heights<2>(square(40), rims, 0.1, report),
                            without = heights<2>(square(40), rims, 0, report_without);
  CHECK(report.iterations < report_without.iterations);
  for(std::size_t k = 1; k < bent.size(); ++k)
    CHECK(bent[k] > without[k] + 0.01); // no spike
}

} // namespace spikes

int main()
{
  iterates::test_all();
  identities::test_all();
  initial_guess::test_all();
  spikes::test_all();
  return checks_result();
}
