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

// Other control vertices, other weights of their targets, and another region, without another
// factorization: the result is that of a solver that factorizes anew each time.

#include "include/check.h"
#include "include/domains.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#ifdef CGAL_LINKED_WITH_CHOLMOD
#include <CGAL/ARAP_deformation/Cholmod_solver.h>
#endif

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

using CGAL::ARAP::Coordinates;
using CGAL::ARAP::Sparse_matrix;
using CGAL::ARAP::Status;

// counts the analyses and the factorizations of a solver with borders
template <typename Solver>
struct Counting_solver : Solver
{
  std::shared_ptr<int> count = std::make_shared<int>(0);
  std::shared_ptr<int> analyses = std::make_shared<int>(0);

  bool analyze(const Sparse_matrix& a)
  {
    ++*analyses;
    return Solver::analyze(a);
  }

  bool factorize(const Sparse_matrix& a)
  {
    ++*count;
    return Solver::factorize(a);
  }
};

// a solver that has no borders
template <typename Solver>
struct Plain_solver
{
  Counting_solver<Solver> solver;

  bool analyze(const Sparse_matrix& a) { return solver.analyze(a); }
  bool factorize(const Sparse_matrix& a) { return solver.factorize(a); }
  bool solve(std::size_t n, Coordinates* x) { return solver.solve(n, x); }
};

// two deformations of one shape that differ in their solvers only
template <int Dimension, typename Simplices, typename Solver,
          typename Weight = CGAL::ARAP::Safe_cotangent_weight>
struct Pair
{
  using Domain = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;
  template <typename S>
  using Traits = CGAL::ARAP_deformation_traits_3<S, Weight>;
  template <typename S>
  using Deformation = CGAL::ARAP_deformation<Domain, Traits<S>>;

  Pair(const std::vector<Eigen::Vector3d>& vectors, const Simplices& simplices_, Cell_scheme cells,
       const Weight& weight = Weight())
    : simplices(simplices_), points(points_of(vectors)), other_points(points),
      deformation(Domain(points, simplices), Traits<Counting_solver<Solver>>(bordered, weight)),
      other(Domain(other_points, simplices), Traits<Plain_solver<Solver>>(plain, weight))
  {
    CGAL::ARAP::Options options;
    options.cells = cells;
    CHECK(deformation.set_options(options));
    CHECK(other.set_options(options));
  }

  template <typename Function>
  void with_both(const Function& f)
  {
    f(deformation);
    f(other);
  }

  // the same status, energies and positions
  Status deform_and_compare(unsigned int iterations = 5)
  {
    const CGAL::ARAP::Report a = deformation.deform(iterations, 0);
    const CGAL::ARAP::Report b = other.deform(iterations, 0);
    CHECK(a.status == b.status);
    CHECK(a.energy.size() == b.energy.size());
    for(std::size_t k = 0; k < a.energy.size() && k < b.energy.size(); ++k)
      CHECK_AT_MOST(std::abs(a.energy[k] - b.energy[k]), 1e-10 * (b.energy[k] + b.energy_scale));
    double largest = 0;
    for(std::size_t v = 0; v < points.size(); ++v)
      largest = larger(largest, std::sqrt(squared_distance(points[v], other_points[v])));
    CHECK_AT_MOST(largest, 1e-9);
    return a.status;
  }

  int factorizations() const { return *bordered.count; }
  int analyses() const { return *bordered.analyses; }
  int other_factorizations() const { return *plain.solver.count; }

  Counting_solver<Solver> bordered;
  Plain_solver<Solver> plain;
  Simplices simplices;
  std::vector<Point> points, other_points;
  Deformation<Counting_solver<Solver>> deformation;
  Deformation<Plain_solver<Solver>> other;
};

template <typename Pair>
void test_random_changes(Pair& pair, unsigned int seed)
{
  std::mt19937 generator(seed);
  const std::size_t n = pair.points.size();
  std::uniform_int_distribution<std::size_t> vertex(0, n - 1), number_of_changes(1, 6);
  std::uniform_int_distribution<int> kind(0, 9);
  std::uniform_real_distribution<double> shift(-0.1, 0.1), exponent(-3, 3);
  pair.with_both([n](auto& d) {
    for(std::size_t v = 0; v < n; ++v)
      d.insert_roi_vertex(v);
    for(std::size_t v : {std::size_t(0), n / 2, n - 1})
      d.insert_control_vertex(v);
  });
  for(int step = 0; step < 25; ++step)
  {
    for(std::size_t k = number_of_changes(generator); k > 0; --k)
    {
      const std::size_t v = vertex(generator);
      switch(kind(generator))
      {
      case 0: case 1: case 2:
        pair.with_both([v](auto& d) { d.erase_control_vertex(v); });
        break;
      case 3:
        pair.with_both([v](auto& d) { d.erase_roi_vertex(v); });
        break;
      case 4:
        pair.with_both([v](auto& d) { d.insert_roi_vertex(v); });
        break;
      default:
        pair.with_both([v](auto& d) { d.insert_control_vertex(v); });
      }
    }
    pair.with_both([](auto& d) { d.insert_control_vertex(0); });
    for(std::size_t v : pair.deformation.control_vertices())
    {
      const Kernel::Vector_3 t(shift(generator), shift(generator), shift(generator));
      pair.with_both([v, t](auto& d) { CHECK(d.translate(v, t)); });
      if(v == 0 || kind(generator) > 2)
        continue;
      const bool is_hard = kind(generator) < 3;
      const double weight = is_hard ? std::numeric_limits<double>::infinity()
                                    : std::pow(10, exponent(generator));
      pair.with_both([v, weight](auto& d) { CHECK(d.set_target_weight(v, weight)); });
    }
    CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  }
  CHECK(pair.factorizations() == 1);
  CHECK(pair.other_factorizations() > 20);
}

template <typename Solver>
void test_random_changes(const char* name)
{
  const Shape sheet = grid("sheet", 30, 20, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0.2 * std::sin(7 * u) * std::cos(5 * v));
  });
  const Block solid = block(7, 4, 4);
  unsigned int seed = 1;
  for(Cell_scheme cells : all_cell_schemes)
  {
    test_case() = std::string(name) + ", seed " + std::to_string(seed);
    Pair<2, decltype(sheet.triangles), Solver> triangles(sheet.points, sheet.triangles, cells);
    test_random_changes(triangles, seed++);
    test_case() = std::string(name) + ", tetrahedra, seed " + std::to_string(seed);
    Pair<3, decltype(solid.tetrahedra), Solver> tetrahedra(solid.points, solid.tetrahedra, cells);
    test_random_changes(tetrahedra, seed++);
  }
}

const Shape large_sheet()
{
  return grid("large sheet", 40, 30, [](double u, double v) {
    return Eigen::Vector3d(3 * u, 2 * v, 0.1 * std::sin(9 * u));
  });
}

using Triangles = std::vector<std::array<std::size_t, 3>>;
using Solver = CGAL::ARAP::Multifrontal_cholesky_solver;

void test_many_changes()
{
  test_case() = "many changes";
  const Shape shape = large_sheet();
  Pair<2, Triangles, Solver> pair(shape.points, shape.triangles, Cell_scheme::spokes());
  const std::size_t n = shape.points.size();
  pair.with_both([n](auto& d) {
    for(std::size_t v = 0; v < n; ++v)
      d.insert_roi_vertex(v);
    for(std::size_t v = 0; v < 400; ++v)
      d.insert_control_vertex(v);
  });
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == 1);
  pair.with_both([](auto& d) { d.clear_control_vertices(); d.insert_control_vertex(0); });
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == 2);
}

// what fails leaves the factor for the next attempt
void test_failure()
{
  test_case() = "failure";
  const Shape shape = large_sheet();
  Pair<2, Triangles, Solver> pair(shape.points, shape.triangles, Cell_scheme::spokes_and_rims());
  const std::size_t n = shape.points.size();
  pair.with_both([n](auto& d) {
    for(std::size_t v = 0; v < n; ++v)
      d.insert_roi_vertex(v);
    d.insert_control_vertex(5);
    d.insert_control_vertex(n - 1);
  });
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  pair.with_both([](auto& d) { d.clear_control_vertices(); });
  CHECK(pair.deform_and_compare() == Status::no_fixed_vertex);
  pair.with_both([](auto& d) {
    d.insert_control_vertex(3);
    d.insert_control_vertex(700);
    CHECK(d.translate(700, Kernel::Vector_3(0, 0.1, 0.3)));
  });
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == 1);
}

// weights that change while the object lives, which it need not be told
struct Changing_weight : CGAL::ARAP::Uniform_weight
{
  using Function = std::function<double(std::size_t, std::size_t)>;

  std::shared_ptr<Function> function = std::make_shared<Function>([](std::size_t, std::size_t) {
    return 1.0;
  });

  double edge_weight(CGAL::ARAP::Edge_set, std::size_t i, std::size_t j, double) const
  {
    return (*function)((std::min)(i, j), (std::max)(i, j));
  }
};

// the large sheet with changing weights, of which the vertices given are fixed
using Weighted_pair = Pair<2, Triangles, Solver, Changing_weight>;
void hold(Weighted_pair& pair, const std::vector<std::size_t>& controls)
{
  pair.with_both([&](auto& d) {
    for(std::size_t v = 0; v < pair.points.size(); ++v)
      d.insert_roi_vertex(v);
    d.clear_control_vertices();
    d.insert_control_vertices(controls.begin(), controls.end());
    CHECK(d.translate(controls.back(), Kernel::Vector_3(0, 0.1, 0.4)));
  });
}

void test_changed_matrix()
{
  test_case() = "another matrix";
  const Shape shape = large_sheet();
  const Changing_weight weight;
  Weighted_pair pair(shape.points, shape.triangles, Cell_scheme::spokes(), weight);
  hold(pair, {0, shape.points.size() - 1});
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  *weight.function = [](std::size_t i, std::size_t j) { return (i + j) % 3 == 0 ? 4 : 1; };
  pair.with_both([](auto& d) { d.insert_control_vertex(300); });
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == 2);

  pair.with_both([](auto& d) { d.overwrite_initial_geometry(); d.erase_control_vertex(300); });
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));

  const int count = pair.factorizations();
  CGAL::ARAP::Options options;
  options.cells = Cell_scheme::elements();
  pair.with_both([&options](auto& d) { CHECK(d.set_options(options)); });
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == count + 1);
}

// weights of which the sums at the vertices stay the same
void test_changed_matrix_of_same_diagonal()
{
  test_case() = "another matrix with the same diagonal";
  const Shape shape = large_sheet();
  const Changing_weight weight;
  Weighted_pair pair(shape.points, shape.triangles, Cell_scheme::spokes(), weight);
  hold(pair, {0, shape.points.size() - 1});
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  // around one square of the grid, whose columns have 31 vertices
  const std::size_t a = 310, b = a + 31, c = b + 1, d = a + 1;
  *weight.function = [=](std::size_t i, std::size_t j) {
    const bool is_more = (i == a && j == b) || (i == d && j == c);
    const bool is_less = (i == b && j == c) || (i == a && j == d);
    return is_more ? 1.9 : is_less ? 0.1 : 1;
  };
  hold(pair, {0, 500, shape.points.size() - 1});
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == 2);
}

// What a factorization refuses is refused with the factor of other free vertices too.
void test_indefinite_matrix()
{
  test_case() = "an indefinite matrix";
  const Shape shape = large_sheet();
  const Changing_weight weight;
  const std::size_t a = 400, b = a + 31, last = shape.points.size() - 1;
  *weight.function = [=](std::size_t i, std::size_t j) {
    return i == a && j == b ? -2.5 : 1;
  };
  Weighted_pair pair(shape.points, shape.triangles, Cell_scheme::spokes(), weight);
  hold(pair, {0, a, b, last});
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  hold(pair, {0, last});
  CHECK(pair.deform_and_compare() == Status::singular_matrix);
  hold(pair, {0, b, a, last});
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  hold(pair, {a, b, last - 5});
  const int count = pair.factorizations();
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == count);
}

// An exception, here of the weights, leaves an object that can go on.
void test_exception()
{
  test_case() = "an exception";
  const Shape shape = large_sheet();
  const Changing_weight weight;
  Weighted_pair pair(shape.points, shape.triangles, Cell_scheme::spokes(), weight);
  const std::size_t last = shape.points.size() - 1;
  hold(pair, {0, last});
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  const Changing_weight::Function ones = *weight.function;
  for(int repetition = 0; repetition < 2; ++repetition)
  {
    *weight.function = [](std::size_t, std::size_t) -> double { throw std::runtime_error("none"); };
    hold(pair, {0, 300 + std::size_t(repetition), last});
    const std::vector<Point> before = pair.points;
    int caught = 0;
    pair.with_both([&](auto& d) {
      try { d.deform(); } catch(const std::runtime_error&) { ++caught; }
    });
    CHECK(caught == 2);
    CHECK(pair.points == before);
    *weight.function = ones;
    CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  }
}

// A border has at most 256 columns; the only fixed vertex may be another one.
void test_limits()
{
  test_case() = "the largest border";
  const Shape shape = large_sheet();
  Weighted_pair pair(shape.points, shape.triangles, Cell_scheme::spokes(), Changing_weight());
  hold(pair, {0});
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  hold(pair, {700});
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == 1);
  std::vector<std::size_t> controls = numbers(257);
  hold(pair, controls); // vertex 0 is fixed already
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == 1);
  controls.push_back(257);
  hold(pair, controls);
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == 2);
}

// Other weights of targets: a finite one that changes takes two columns of a border. Beyond the
// largest border the matrix is factorized again, but not analyzed.
void test_weights_of_targets()
{
  const Shape shape = large_sheet();
  for(std::size_t number_of_changes : {1, 128, 129, 500})
  {
    test_case() = std::to_string(number_of_changes) + " weights of targets";
    Weighted_pair pair(shape.points, shape.triangles, Cell_scheme::spokes(), Changing_weight());
    const std::vector<std::size_t> controls = numbers(500);
    hold(pair, controls); // and then nothing
    pair.with_both([&](auto& d) {
      CHECK(d.set_target_weight(controls.begin(), controls.end(), 1));
    });
    CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
    CHECK(pair.factorizations() == 1 && pair.analyses() == 1);
    for(double weight : {1e-3, 1e3})
    {
      pair.with_both([&](auto& d) {
        CHECK(d.set_target_weight(controls.begin(), controls.begin() + number_of_changes, weight));
      });
      CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
    }
    CHECK(pair.factorizations() == (number_of_changes <= 128 ? 1 : 3));
    CHECK(pair.analyses() == 1);
    // none at all, of as many as a border takes
    pair.with_both([&](auto& d) {
      CHECK(d.set_target_weight(controls.begin(), controls.begin() + 100, 0));
    });
    CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
    CHECK(pair.analyses() == 1);
    // and hard ones again, which asks for another analysis if there are many
    pair.with_both([&](auto& d) {
      CHECK(d.set_target_weight(controls.begin(), controls.end(),
                                std::numeric_limits<double>::infinity()));
    });
    CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
    CHECK(pair.analyses() == 2);
  }
}

// Another rest shape has other weights.
void test_rest_shape()
{
  test_case() = "another rest shape";
  const Shape shape = large_sheet();
  Pair<2, Triangles, Solver> pair(shape.points, shape.triangles, Cell_scheme::spokes());
  pair.with_both([&](auto& d) {
    for(std::size_t v = 0; v < shape.points.size(); ++v)
      d.insert_roi_vertex(v);
    for(std::size_t v : {std::size_t(0), shape.points.size() - 1})
      d.insert_control_vertex(v);
    CHECK(d.translate(shape.points.size() - 1, Kernel::Vector_3(0, 0.1, 0.4)));
  });
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  pair.with_both([](auto& d) { d.overwrite_initial_geometry(); });
  CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  CHECK(pair.factorizations() == 2);
}

// Other targets need no factorization, and neither do other options of a run.
void test_targets()
{
  test_case() = "targets";
  const Shape shape = large_sheet();
  Weighted_pair pair(shape.points, shape.triangles, Cell_scheme::spokes(), Changing_weight());
  hold(pair, {0, shape.points.size() - 1});
  for(int step = 0; step < 5; ++step)
  {
    pair.with_both([&](auto& d) {
      CHECK(d.translate(shape.points.size() - 1, Kernel::Vector_3(0.1, 0, 0.1)));
      CGAL::ARAP::Options options = d.options();
      options.iterations = 3 + step;
      CHECK(d.set_options(options));
    });
    CHECK(CGAL::ARAP::succeeded(pair.deform_and_compare()));
  }
  CHECK(pair.factorizations() == 1);
  CHECK(pair.other_factorizations() == 1);
}

int main()
{
  test_random_changes<Solver>("Multifrontal_cholesky_solver");
#ifdef CGAL_LINKED_WITH_CHOLMOD
  test_random_changes<CGAL::ARAP::Cholmod_solver>("Cholmod_solver");
#endif
  test_many_changes();
  test_failure();
  test_changed_matrix();
  test_changed_matrix_of_same_diagonal();
  test_indefinite_matrix();
  test_exception();
  test_limits();
  test_weights_of_targets();
  test_rest_shape();
  test_targets();
  return checks_result();
}
