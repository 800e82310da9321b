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

#ifndef CGAL_ARAP_DEFORMATION_TEST_DENSE_REFERENCE_H
#define CGAL_ARAP_DEFORMATION_TEST_DENSE_REFERENCE_H

// The energy and the iteration of local/global, written down a second time: dense matrices, each
// cell spelled out from the definition, nothing shared with the package. Slow, for small shapes.
// It takes long to compile, and so is linked with the tests that need it.

#include "check.h"
#include "shapes.h"

#include <CGAL/ARAP_deformation/Default_visitor.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/Status.h>

#include <boost/property_map/property_map.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

class Dense_reference
{
public:
  enum Cells { SPOKES, SPOKES_AND_RIMS, ELEMENTS };
  enum Weights { SAFE, COTANGENT, CLAMPED, UNIFORM };

  struct Edge
  {
    std::size_t i, j;
    double weight;
  };

  using Simplex = std::vector<std::size_t>; // a polygon, or a tetrahedron if the dimension is 3

  // what is more than the paper's energy
  struct Terms
  {
    unsigned int rings = 0;
    std::vector<double> stiffness; // of each vertex or simplex, else 1
    std::vector<int> group;        // of each vertex or simplex; negative: none
    double bending_length = 0;
    double smoothing_length = 0;
    std::map<std::size_t, Eigen::Matrix3d> frames; // rotations given at vertices
  };

  Dense_reference(const std::vector<Eigen::Vector3d>& points,
                  const std::vector<Simplex>& simplices, int dimension,
                  const std::vector<int>& selection, Cells cells, Weights weights)
    : Dense_reference(points, simplices, dimension, selection, cells, weights, Terms())
  {}

  Dense_reference(const std::vector<Eigen::Vector3d>& points,
                  const std::vector<Simplex>& simplices, int dimension,
                  const std::vector<int>& selection, Cells cells, Weights weights,
                  const Terms& terms);

  // pulls a free vertex to a target: one more term of the energy
  void add_soft_position(std::size_t v, double weight, const Eigen::Vector3d& target);

  // A linear combination of positions, and its target, which may depend on its value: it is pulled
  // there, or put there if the weight is infinite.
  using Combination = std::vector<std::pair<std::size_t, double>>;
  using Target = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

  void add_row(const Combination& terms, double weight, const Target& target);

  // The energy with the best rotations. If rotations are smooth these are what one step from the
  // last ones, the identities at first, makes of them; they are those of the next iterate().
  double energy(const std::vector<Eigen::Vector3d>& x);

  // one step of local/global: the minimizer of the energy for the rotations at x
  void iterate(std::vector<Eigen::Vector3d>& x);

  // moves x to where hard rows are met, the shortest way in the metric of the matrix
  void start(std::vector<Eigen::Vector3d>& x) const;

  // The step with rotations that are interpolated: `vectors` has the rotation vectors of the fixed
  // vertices, and is solved for those of the others. Cells are at vertices.
  void rotation_guess(std::vector<Eigen::Vector3d> vectors, std::vector<Eigen::Vector3d>& x);

  // naive Laplacian editing: the least-squares solution of L x = L p, L with a row for each vertex
  void laplacian_guess(std::vector<Eigen::Vector3d>& x) const;

  // of a covariance: Equation (6) of the paper
  static Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& s);

private:
  static double cotangent(const Eigen::Vector3d& apex, const Eigen::Vector3d& p,
                          const Eigen::Vector3d& q);

  static bool contains(const Simplex& s, std::size_t v);

  // all ways to cut a polygon into triangles
  static std::vector<std::vector<Simplex>> triangulations(const Simplex& polygon);

  // the weight of the edge (i, j) in a simplex, before it is clamped or replaced
  double cotangent_weight(const Simplex& s, std::size_t i, std::size_t j) const;

  double edge_weight(bool is_star, double sum) const;

  double star_weight(std::size_t i, std::size_t j) const;

  std::set<std::size_t> neighbors(std::size_t i) const;

  std::vector<Edge> simplex_edges(const Simplex& s) const;

  // a linear combination of positions whose coefficients add up to zero
  struct Form
  {
    double weight;
    std::map<std::size_t, double> coefficients;

    Eigen::Vector3d value(const std::vector<Eigen::Vector3d>& x) const;
  };

  // The positions of the free vertices with which forms are nearest to what is expected of them; at
  // a start only the way from x to where hard rows are met.
  using Expected = std::function<Eigen::Vector3d(std::size_t cell, const Form&)>;
  void solve(std::vector<Eigen::Vector3d>& x, const Expected& expected,
             bool is_start = false) const;

  struct Cell
  {
    std::vector<Form> forms;
    std::vector<std::size_t> names; // its vertex or simplex, or all those of a group
    bool is_moving = false;
  };

  // the Laplacian over the area or volume of a vertex, if it is not on the border
  bool make_bending_form(std::size_t i, double factor, Form& form) const;

  double stiffness(std::size_t name) const;

  // All cells that have an edge set with a free vertex, whole; where rotations are smooth, and of a
  // group in which something moves, all that have one with a vertex of the region of interest.
  void make_cells(Cells scheme);

  // the weight between two vertices or simplices that are neighbors
  double coupling(Cells scheme, std::size_t i, std::size_t j) const;

  // the weights between neighboring cells; that of groups is the sum over what is in them
  void couple(Cells scheme);

  // fits the rotations to x, all at once
  void fit(const std::vector<Eigen::Vector3d>& x);

  struct Row
  {
    Combination terms;
    double weight;
    Target target;

    Eigen::Vector3d value(const std::vector<Eigen::Vector3d>& x) const;
  };

  std::vector<Eigen::Vector3d> m_rest;
  std::vector<Simplex> m_simplices;
  int m_dimension;
  std::vector<int> m_selection;
  Weights m_weights;
  std::vector<std::size_t> m_free;
  std::vector<int> m_row; // of the free vertices among the unknowns, or -1
  std::vector<Cell> m_cells;
  std::vector<Eigen::Matrix3d> m_rotations; // of the cells
  std::map<std::pair<std::size_t, std::size_t>, double> m_couplings; // of cells
  Terms m_terms;
  bool m_is_element = false;
  std::vector<Row> m_soft_rows, m_hard_rows;
};

// Runs local/global from x, and compares each iterate and its energy with those of the reference.
template <typename Deformation>
void compare_iterates(Deformation& deformation, const std::vector<Point>& points,
                      Dense_reference& reference, std::vector<Eigen::Vector3d> x,
                      unsigned int iterations, double diameter)
{
  std::vector<double> energies = {reference.energy(x)};
  std::vector<std::vector<Eigen::Vector3d>> iterates = {x};
  for(unsigned int k = 0; k < iterations; ++k)
  {
    reference.iterate(x);
    energies.push_back(reference.energy(x));
    iterates.push_back(x);
  }
  const std::vector<Point> before = points; // they are written at the end
  const CGAL::ARAP::Report report = deformation.deform(iterations, 0, [&](const auto& iterate) {
    std::vector<Point> copy = before;
    iterate.put_points(boost::make_iterator_property_map(
      copy.begin(), boost::typed_identity_property_map<std::size_t>()));
    CHECK_AT_MOST(largest_distance(copy, iterates[iterate.iteration()]), 1e-10 * diameter);
    return CGAL::ARAP::Visitor_action::proceed;
  });
  CHECK(report.status == CGAL::ARAP::Status::iteration_limit);
  if(!CHECK(report.energy.size() == energies.size()))
    return;
  for(std::size_t k = 0; k < energies.size(); ++k)
    CHECK_AT_MOST(std::abs(report.energy[k] - energies[k]),
                  1e-10 * std::abs(energies[k]) + 1e-14 * report.energy_scale);
}

#endif // CGAL_ARAP_DEFORMATION_TEST_DENSE_REFERENCE_H
