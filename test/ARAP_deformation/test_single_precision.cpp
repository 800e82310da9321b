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

// The factor in single precision: what its solutions are worth, when it gives way to one in double
// precision, and that the minimizers reach the same minimum with either.

#include "include/Single_precision_solver.h"
#include "include/check.h"
#include "include/conformance.h"
#include "include/rows.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/conformance/check_sparse_solver.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using namespace CGAL::ARAP;

// the Laplacian of a grid that is fixed along one side by weights of the size `hold`
Sparse_matrix grid_matrix(int columns, int rows, double hold, double factor = 1)
{
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_edge = [&](int i, int j, double weight) {
    entries.emplace_back(i, i, factor * weight);
    entries.emplace_back(j, j, factor * weight);
    entries.emplace_back((std::max)(i, j), (std::min)(i, j), -factor * weight);
  };
  for(int i = 0; i < columns; ++i)
    for(int j = 0; j < rows; ++j)
    {
      const double weight = 1 + 0.5 * std::sin(3 * i + 7 * j);
      if(i + 1 < columns) add_edge(i * rows + j, (i + 1) * rows + j, weight);
      if(j + 1 < rows) add_edge(i * rows + j, i * rows + j + 1, weight);
      if(i == 0) entries.emplace_back(j, j, factor * hold);
    }
  Sparse_matrix a(columns * rows, columns * rows);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

template <typename Solver>
Rows solution(Solver& solver, Rows b)
{
  CHECK(solver.solve(b.size(), b.data()));
  return b;
}

// the largest difference relative to the largest entry of `expected`
double relative_error(const Rows& x, const Rows& expected)
{
  double difference = 0, largest = 0;
  for(std::size_t k = 0; k < x.size(); ++k)
    for(int c = 0; c < 3; ++c)
    {
      difference = larger(difference, std::abs(x[k][c] - expected[k][c]));
      largest = larger(largest, std::abs(expected[k][c]));
      if(!std::isfinite(x[k][c]))
        return std::numeric_limits<double>::infinity();
    }
  return difference / largest;
}

template <typename Solver>
Solver factorized(const Sparse_matrix& a)
{
  Solver solver;
  CHECK(solver.analyze(a));
  CHECK(solver.factorize(a));
  return solver;
}

void test_accuracy()
{
  test_case() = "accuracy";
  const Sparse_matrix a = grid_matrix(80, 70, 1);
  auto single = factorized<Single_precision_solver>(a);
  auto twice = factorized<Multifrontal_cholesky_solver>(a);
  CHECK(single.is_single_precision());
  CHECK(single.factor_bytes() < 0.6 * twice.factor_bytes());
  const Rows b = random_rows(80 * 70), expected = solution(twice, b);
  const double error = relative_error(solution(single, b), expected);
  CHECK_AT_MOST(error, 1e-4);
  CHECK(error > 1e-9); // it is in single precision

  // in residual form it is as good as the other after few steps, as the minimizers need it
  Rows x(b.size(), Coordinates{0, 0, 0});
  for(int k = 0; k < 4; ++k)
  {
    Rows residual = b;
    as_matrix(residual) -= a.selfadjointView<Eigen::Lower>() * as_matrix(x);
    as_matrix(x) += as_matrix(solution(single, residual));
  }
  CHECK_AT_MOST(relative_error(x, expected), 1e-11);
}

// Neither right-hand sides nor matrices need be of the size of single precision's numbers.
void test_range()
{
  for(int exponent : {-250, -60, 60, 250})
  {
    test_case() = "a right-hand side of the size 1e" + std::to_string(exponent);
    const double size = std::pow(10.0, exponent);
    const Sparse_matrix a = grid_matrix(20, 15, 1);
    auto single = factorized<Single_precision_solver>(a);
    auto twice = factorized<Multifrontal_cholesky_solver>(a);
    CHECK(single.is_single_precision());
    const Rows b = random_rows(20 * 15, size);
    CHECK_AT_MOST(relative_error(solution(single, b), solution(twice, b)), 1e-5);
  }
  for(int exponent : {-200, -100, -60, -37, -36, -12, 12, 39, 43, 45, 60, 100, 200})
  {
    test_case() = "a matrix of the size 1e" + std::to_string(exponent);
    const double factor = std::pow(10.0, exponent);
    const Sparse_matrix a = grid_matrix(20, 15, 1, factor);
    auto single = factorized<Single_precision_solver>(a);
    auto twice = factorized<Multifrontal_cholesky_solver>(a);
    CHECK(single.is_single_precision() == (std::abs(exponent) < 15));
    Rows b = random_rows(20 * 15);
    CHECK_AT_MOST(relative_error(solution(single, b), solution(twice, b)), 1e-5);
    for(Coordinates& row : b) // smooth in one column, small in the others
      row = {1, 0, 1e-3 * row[2]};
    Rows x = solution(single, b), expected = solution(twice, b);
    CHECK_AT_MOST(relative_error(x, expected), 1e-5);
    for(Rows* rows : {&x, &expected})
      for(Coordinates& row : *rows)
        row[0] = 0;
    CHECK_AT_MOST(relative_error(x, expected), 1e-5);
  }
  test_case() = "zeros";
  auto single = factorized<Single_precision_solver>(grid_matrix(20, 15, 1));
  const Rows zeros(20 * 15, Coordinates{0, 0, 0});
  CHECK(solution(single, zeros) == zeros);
}

// The worse a grid is fixed, the worse is the matrix conditioned. Where the factor gives way, its
// solutions are those in double precision.
void test_fallback()
{
  Single_precision_solver solver;
  CHECK(solver.analyze(grid_matrix(60, 30, 1)));
  int number_of_singles = 0, number_of_doubles = 0;
  for(int exponent = 0; exponent >= -13; --exponent)
  {
    test_case() = "fixed by 1e" + std::to_string(exponent);
    const double hold = std::pow(10.0, exponent);
    const Sparse_matrix a = grid_matrix(60, 30, hold);
    CHECK(solver.factorize(a));
    auto twice = factorized<Multifrontal_cholesky_solver>(a);
    const Rows b = random_rows(60 * 30), expected = solution(twice, b);
    const double error = relative_error(solution(solver, b), expected);
    if(solver.is_single_precision())
    {
      ++number_of_singles;
      CHECK_AT_MOST(error, 2e-2);
      CHECK(number_of_doubles == 0);
    }
    else
    {
      ++number_of_doubles;
      CHECK(solver.factor_bytes() == twice.factor_bytes());
      CHECK(solution(solver, b) == expected);
    }
  }
  CHECK(number_of_singles > 2 && number_of_doubles > 1);
  CHECK(solver.factorize(grid_matrix(60, 30, 1)));
  CHECK(solver.is_single_precision()); // again
}

// The factor fails in a few rows only, of which the solution for most right-hand sides has little.
void test_fallback_of_a_part()
{
  test_case() = "a small, stiff part that is hardly fixed";
  const Sparse_matrix large = grid_matrix(100, 90, 1), small = grid_matrix(5, 5, 1e-12, 1e14);
  for(const bool is_bad : {false, true})
  {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&entries](const Sparse_matrix& a, int first) {
      for(int column = 0; column < a.cols(); ++column)
        for(Sparse_matrix::InnerIterator entry(a, column); entry; ++entry)
          entries.emplace_back(first + entry.row(), first + column, entry.value());
    };
    add(large, 0);
    add(is_bad ? small : grid_matrix(5, 5, 1, 1e14), 100 * 90);
    Sparse_matrix a(100 * 90 + 25, 100 * 90 + 25);
    a.setFromTriplets(entries.begin(), entries.end());
    CHECK(factorized<Single_precision_solver>(a).is_single_precision() == !is_bad);
  }
}

void test_threads()
{
  test_case() = "threads";
  const Sparse_matrix a = grid_matrix(170, 110, 1);
  const Rows b = random_rows(170 * 110);
  Rows first;
  for(unsigned int threads : {1u, 2u, 8u, 0u})
    internal::run_with_threads(threads, [&] {
      auto solver = factorized<Single_precision_solver>(a);
      const Rows x = solution(solver, b);
      CHECK(solver.is_single_precision());
      if(first.empty())
        first = x;
      CHECK(x == first);
    });
}

struct Run
{
  Report report;
  std::vector<Point> points;
};

template <typename Solver>
Run run(const Shape& shape, const Options& options, unsigned int iterations, double tolerance)
{
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh, CGAL::ARAP_deformation_traits<Solver>> deformation(mesh);
  CHECK(deformation.set_options(options));
  prepare(deformation, scenario(shape), all_vertices(mesh));
  Run result;
  result.report = deformation.deform(iterations, tolerance);
  CHECK(succeeded(result.report.status));
  result.points = points_of(mesh);
  CHECK(CGAL::ARAP::first_rise_of_energy(result.report) == 0);
  return result;
}

// Each iterate to the accuracy of a solution, and the minimum exactly.
void test_minima()
{
  int number_of_minima = 0, number_of_differences = 0;
  for(const Shape& shape : shapes())
    for(Cell_scheme cells :
        {Cell_scheme::spokes(), Cell_scheme::spokes_and_rims(), Cell_scheme::elements()})
    {
      test_case() = shape.name;
      Options options;
      options.cells = cells;
      options.initial_guess = CGAL::ARAP::Initial_guess::previous;
      options.minimizer = Minimizer::local_global;
      const Run few = run<Single_precision_solver>(shape, options, 10, 0);
      const Run few_expected = run<Multifrontal_cholesky_solver>(shape, options, 10, 0);
      const double difference =
        largest_distance(few.points, few_expected.points) / shape.diameter();
      CHECK_AT_MOST(difference, 1e-5);
      number_of_differences += difference > 1e-11;

      options.minimizer = Minimizer::quasi_newton;
      const Run all = run<Single_precision_solver>(shape, options, 2000, 1e-10);
      const Run all_expected = run<Multifrontal_cholesky_solver>(shape, options, 2000, 1e-10);
      CHECK(all.report.status == all_expected.report.status);
      if(cells == Cell_scheme::elements())
        continue; // a surface that may be folded in many ways, with energies close to each other
      ++number_of_minima;
      CHECK_AT_MOST(std::abs(all.report.energy.back() - all_expected.report.energy.back()),
                    1e-9 * all_expected.report.energy.back() + 1e-15 * all.report.energy_scale);
      CHECK_AT_MOST(all.report.iterations, 1.2 * all_expected.report.iterations + 10);
    }
  CHECK(number_of_minima > 20);
  CHECK(number_of_differences > 5); // else nothing was in single precision
}

// A long strip that is fixed at its ends, and one with triangles of all shapes, needles among them:
// the energy does not rise (see run()), and the minimum is the same.
void test_badly_conditioned_shapes()
{
  const auto strip = [](const std::string& name, double u_power, double height) {
    return grid(name, 1500, 2, [=](double u, double v) {
      return Eigen::Vector3d(40 * std::pow(u, u_power), height * v, 0.5 * std::sin(30 * u));
    });
  };
  for(const Shape& shape : {strip("a long strip", 1, 0.1), strip("a strip of needles", 3, 0.1),
                            strip("a narrow strip", 1, 1e-6)})
    for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
    {
      test_case() = shape.name;
      Options options;
      options.minimizer = minimizer;
      const double tolerance = minimizer == Minimizer::quasi_newton ? 1e-8 : 0;
      const Run single = run<Single_precision_solver>(shape, options, 300, tolerance);
      const Run expected = run<Multifrontal_cholesky_solver>(shape, options, 300, tolerance);
      CHECK_AT_MOST(std::abs(single.report.energy.back() - expected.report.energy.back()),
                    1e-6 * expected.report.energy.front());
    }
}

int main()
{
#ifdef CGAL_LINKED_WITH_TBB
  // as many threads as are asked for, and not only as many as there are cores
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 8);
#endif
  CHECK_CONFORMS(check_sparse_solver(Single_precision_solver(), 2e-2));
  CHECK_CAUGHT(check_sparse_solver(Single_precision_solver()), "relative residual");
  test_accuracy();
  test_range();
  test_fallback();
  test_fallback_of_a_part();
  test_threads();
  test_minima();
  test_badly_conditioned_shapes();
  return checks_result();
}
