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
#include <map>
#include <random>
#include <string>
#include <vector>

using CGAL::ARAP::Minimizer;
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

template <int Dimension>
void compare(const Model& model, const Scenario& s, Cell_scheme cells,
             Dense_reference::Cells dense_cells, const Terms& terms)
{
  std::vector<Point> points = points_of(model.points);
  CGAL::ARAP_deformation<Soup<Dimension>> deformation(Soup<Dimension>(points, model.simplices));
  prepare(deformation, s, numbers(points.size()));
  apply(deformation, cells, terms);
  Dense_reference reference(model.points, model.simplices, Dimension, s.selection, dense_cells,
                            Dense_reference::SAFE, terms);
  std::vector<Eigen::Vector3d> x = s.targets;
  std::vector<double> energies = {reference.energy(x)};
  std::vector<std::vector<Eigen::Vector3d>> iterates = {x};
  for(unsigned int k = 0; k < 6; ++k)
  {
    reference.iterate(x);
    energies.push_back(reference.energy(x));
    iterates.push_back(x);
  }
  const Report report = deformation.deform(6, 0, [&](const auto& iterate) {
    std::vector<Point> copy = points;
    iterate.put_points(boost::make_iterator_property_map(
      copy.begin(), boost::typed_identity_property_map<std::size_t>()));
    CHECK_AT_MOST(largest_distance(copy, iterates[iterate.iteration()]),
                  1e-10 * diameter_of(model.points));
    return CGAL::ARAP::Visitor_action::proceed;
  });
  if(!CHECK(report.energy.size() == energies.size()))
    return;
  for(std::size_t k = 0; k < energies.size(); ++k)
    CHECK_AT_MOST(std::abs(report.energy[k] - energies[k]),
                  1e-10 * std::abs(energies[k]) + 1e-14 * report.energy_scale);
}

struct Case
{
  std::string name;
  Terms terms;
  bool is_for_elements = true;
  bool is_for_stars_only = false;
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
  return all;
}

template <int Dimension>
void compare_all(const Model& model)
{
  const double diameter = diameter_of(model.points);
  const Scenario part = scenario(Shape{"", model.points, {}}, 0.6);
  Scenario whole = part; // all but the handles: the region is the whole shape
  for(int& status : whole.selection)
    if(status == 0)
      status = 2;
  for(const Scenario& s : {part, whole})
    for(const Case& c : cases(model, s, diameter))
      for(Dense_reference::Cells cells :
          {Dense_reference::SPOKES, Dense_reference::SPOKES_AND_RIMS, Dense_reference::ELEMENTS})
      {
        const bool needs_all = !c.terms.group.empty() || c.terms.smoothing_length > 0;
        if((cells == Dense_reference::ELEMENTS && !c.is_for_elements) ||
           (cells != Dense_reference::SPOKES && c.is_for_stars_only) ||
           (needs_all && &s != &whole && s.selection != whole.selection))
          continue;
        test_case() = model.name + ", " + c.name + ", cells " + std::to_string(cells);
        const Cell_scheme scheme = cells == Dense_reference::SPOKES ? Cell_scheme::k_ring(c.terms.rings)
                                   : cells == Dense_reference::ELEMENTS
                                     ? Cell_scheme::elements()
                                     : Cell_scheme::spokes_and_rims();
        compare<Dimension>(model, s, scheme, cells, c.terms);
      }
}

std::vector<Model> surfaces()
{
  std::vector<Model> models;
  for(const Shape& shape : shapes())
    if(shape.points.size() <= 130 && shape.points.size() > 20)
    {
      models.push_back({shape.name, shape.points, {}});
      for(const auto& t : shape.triangles)
        models.back().simplices.emplace_back(t.begin(), t.end());
    }
  Simplices polygons;
  const Shape quads = tube(polygons);
  if(quads.points.size() <= 200)
    models.push_back({"polygons", quads.points, polygons});
  return models;
}

Model solid()
{
  const Block shape = block(4, 3, 3);
  Model model = {"tetrahedra", shape.points, {}};
  for(const auto& t : shape.tetrahedra)
    model.simplices.emplace_back(t.begin(), t.end());
  return model;
}

void test_all()
{
  static Every_nth is_run(2);
  bool is_first = true;
  for(const Model& model : surfaces())
    if(is_first || is_run())
    {
      compare_all<2>(model);
      is_first = false;
    }
  compare_all<3>(solid());
}

} // namespace iterates

int main()
{
  iterates::test_all();
  return checks_result();
}
