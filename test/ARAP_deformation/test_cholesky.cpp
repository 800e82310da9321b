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
// The factorization and substitution over supernodes: against dense solutions for graphs of all
// shapes, the same to the last bit for any number of threads, and with a border.

#include "include/check.h"
#include "include/dense_algebra.h"
#include "include/length.h"
#include "include/rows.h"

#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/dense_cholesky.h>
#include <CGAL/ARAP_deformation/internal/cholesky/fill_reducing_order.h>
#include <CGAL/ARAP_deformation/internal/cholesky/packed_values.h>
#include <CGAL/ARAP_deformation/internal/parallel/Task_memory.h>
#include <CGAL/ARAP_deformation/internal/parallel/largest_entry.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/solver/sparse_solver_requirements.h>
#include <CGAL/ARAP_deformation/Cholmod_solver.h>

#include <Eigen/Dense>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::ARAP;
using internal::run_with_threads;

using Edges = std::vector<std::pair<int, int>>;

std::mt19937 random_engine(3);

double random_number(double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random_engine);
}

int random_index(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_engine); }

// the Laplacian of a graph with random weights, plus `shift` times the identity
Sparse_matrix laplacian(int n, const Edges& edges, double shift)
{
  std::vector<Eigen::Triplet<double>> entries;
  for(const auto& [i, j] : edges)
  {
    const double w = random_number(0.5, 2);
    entries.emplace_back(i, i, w);
    entries.emplace_back(j, j, w);
    entries.emplace_back((std::max)(i, j), (std::min)(i, j), -w);
  }
  for(int i = 0; i < n; ++i)
    entries.emplace_back(i, i, shift);
  Sparse_matrix a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

Edges grid_edges(int columns, int rows)
{
  Edges edges;
  for(int i = 0; i < columns; ++i)
    for(int j = 0; j < rows; ++j)
    {
      if(i + 1 < columns) edges.emplace_back(i * rows + j, (i + 1) * rows + j);
      if(j + 1 < rows) edges.emplace_back(i * rows + j, i * rows + j + 1);
      if(i + 1 < columns && j + 1 < rows) edges.emplace_back(i * rows + j, (i + 1) * rows + j + 1);
    }
  return edges;
}

struct Problem
{
  std::string name;
  Sparse_matrix matrix;
};

std::vector<Problem> small_problems()
{
  std::vector<Problem> problems;
  const auto add = [&](const std::string& name, int n, const Edges& edges, double shift = 0.1) {
    problems.push_back({name, laplacian(n, edges, shift)});
  };
  add("one row", 1, {});
  add("no edges", 40, {});
  Edges chain, star, complete, bipartite, binary_tree;
  for(int i = 1; i < 200; ++i)
  {
    chain.emplace_back(i - 1, i);
    star.emplace_back(0, i);
    binary_tree.emplace_back((i - 1) / 2, i);
  }
  for(int i = 0; i < 45; ++i)
    for(int j = 0; j < i; ++j)
    {
      complete.emplace_back(i, j);
      if(i % 2 != j % 2) bipartite.emplace_back(i, j);
    }
  add("chain", 200, chain);
  add("star", 200, star);
  add("binary tree", 200, binary_tree);
  add("complete graph", 45, complete);
  add("bipartite graph", 45, bipartite);
  for(int size : {2, 3, 5, 12, 17})
    add("grid " + std::to_string(size), size * size, grid_edges(size, size));
  add("long grid", 4 * 75, grid_edges(75, 4));
  Edges components = grid_edges(15, 15);
  for(auto [i, j] : grid_edges(11, 12))
    components.emplace_back(i + 240, j + 240);
  add("two grids and isolated vertices", 400, components);
  for(int k = 0; k < 12; ++k)
  {
    const int n = 10 + random_index(250);
    Edges edges;
    for(int e = random_index(4 * n); e > 0; --e)
      if(const int i = random_index(n), j = random_index(n); i != j)
        edges.emplace_back(i, j);
    add("random graph " + std::to_string(k), n, edges, 0.01);
  }
  return problems;
}

// cut into blocks, as no small one is
Sparse_matrix large_matrix()
{
  Edges edges = grid_edges(170, 90);
  for(auto [i, j] : grid_edges(60, 50))
    edges.emplace_back(i + 15400, j + 15400);
  return laplacian(19000, edges, 0.01);
}

Eigen::MatrixXd dense(const Sparse_matrix& a)
{
  return Eigen::MatrixXd(a).selfadjointView<Eigen::Lower>();
}

// the largest difference to the dense solution, relative to its largest entry
double error(const Eigen::MatrixXd& a, const Rows& b, const Rows& x)
{
  const Eigen::MatrixXd expected = dense_solution(a, as_matrix(b));
  return largest_entry(as_matrix(x) - expected) / largest_entry(expected);
}

double relative_residual(const Sparse_matrix& a, const Rows& b, const Rows& x)
{
  const Eigen::MatrixXd product = a.selfadjointView<Eigen::Lower>() * as_matrix(x);
  return largest_entry(product - as_matrix(b)) / largest_entry(as_matrix(b));
}

Sparse_matrix sparse(const Eigen::MatrixXd& m)
{
  Sparse_matrix s = m.sparseView();
  s.makeCompressed();
  return s;
}

// Columns of all kinds: unit vectors, which fix a vertex or, with a negative entry of d, pull it,
// and rows of a Laplacian, which free one.
struct Border
{
  Eigen::MatrixXd b, d;
};

Border random_border(int n, int fixed, int freed, int pulled = 0)
{
  std::vector<int> vertices(n);
  for(int i = 0; i < n; ++i)
    vertices[i] = i;
  std::shuffle(vertices.begin(), vertices.end(), random_engine);
  Border border{Eigen::MatrixXd::Zero(n, fixed + freed),
                Eigen::MatrixXd::Zero(fixed + freed, fixed + freed)};
  for(int k = 0; k < fixed; ++k)
    border.b(vertices[k], k) = 1;
  for(int k = 0; k < fixed && k < pulled; ++k)
  {
    border.d(k, k) = -random_number(0.01, 100);
    border.b(vertices[(k + 1) % n], k) = -0.5; // a row of two entries
  }
  // diagonally dominant together with what the matrix has of its shift
  for(int k = fixed; k < fixed + freed; ++k)
  {
    for(int e = 0; e < 5; ++e)
      border.b(random_index(n), k) = -random_number(0.001, 0.01);
    border.d(k, k) = 3;
    if(k > fixed)
      border.d(k, k - 1) = border.d(k - 1, k) = -random_number(0.1, 1);
  }
  return border;
}

Eigen::MatrixXd bordered(const Sparse_matrix& a, const Border& border)
{
  const Eigen::Index n = a.rows(), k = border.d.rows();
  Eigen::MatrixXd m(n + k, n + k);
  m << dense(a), border.b, border.b.transpose(), border.d;
  return m;
}

template <typename Solver>
void test_borders(Solver& solver, const Sparse_matrix& a, double tolerance = 1e-9)
{
  const int n = static_cast<int>(a.rows());
  for(int pulled : {0, 2})
    for(const auto& [fixed, freed] :
        std::vector<std::pair<int, int>>{{1, 0}, {0, 1}, {4, 0}, {3, 2}, {0, 5}, {9, 4}})
    {
      if(fixed > n)
        continue;
      const Border border = random_border(n, fixed, freed, pulled);
      Eigen::MatrixXd lower = border.d;
      lower.triangularView<Eigen::StrictlyUpper>().setConstant(7); // is not read
      CHECK(solver.set_border(sparse(border.b), lower));
      const Rows b = random_rows(static_cast<std::size_t>(n + fixed + freed));
      Rows x = b;
      CHECK(solver.solve(x.size(), x.data()));
      CHECK_AT_MOST(error(bordered(a, border), b, x), tolerance);
    }

  // a multiplier for one or two further unknowns and, next to nothing, a vertex of the matrix
  for(double share : {1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 1e-17, 0.0})
    for(double first : {0.3, 0.5, 0.9, 1.0})
    {
      Border border{Eigen::MatrixXd::Zero(n, 3), Eigen::MatrixXd::Zero(3, 3)};
      border.b(n / 2, 0) = share;
      border.b(n / 3, 1) = border.b(n / 3, 2) = -0.01;
      border.d << 0, first, 1 - first, first, 3, -1, 1 - first, -1, 3;
      const bool is_set = solver.set_border(sparse(border.b), border.d);
      CHECK(is_set || share < 1e-2 || tolerance > 1e-9); // not all in single precision
      const Rows b = random_rows(static_cast<std::size_t>(n + 3));
      Rows x = b;
      if(is_set && CHECK(solver.solve(x.size(), x.data())))
        CHECK_AT_MOST(error(bordered(a, border), b, x), share < 1e-2 ? 1e-2 : tolerance);
    }

  // the same vertex fixed twice
  Eigen::MatrixXd twice = Eigen::MatrixXd::Zero(n, 2);
  twice.row(n / 2).setOnes();
  CHECK(!solver.set_border(sparse(twice), Eigen::MatrixXd::Zero(2, 2)));
  // a border that is not that of a minimum: a further unknown makes it indefinite
  Border indefinite = random_border(n, 0, 1);
  indefinite.d(0, 0) = 1e-12;
  CHECK(!solver.set_border(sparse(indefinite.b), indefinite.d));
  // a column of zeros
  CHECK(!solver.set_border(Sparse_matrix(n, 1), Eigen::MatrixXd::Zero(1, 1)));
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  CHECK(!solver.set_border(sparse(random_border(n, 1, 0).b),
                           Eigen::MatrixXd::Constant(1, 1, not_a_number)));
}

template <typename Solver>
void test_small(const std::string& name, const Solver& prototype)
{
  for(const Problem& problem : small_problems())
  {
    test_case() = name + ", " + problem.name;
    Solver solver(prototype);
    const Sparse_matrix& a = problem.matrix;
    CHECK(solver.analyze(a));
    for(double factor : {1.0, 3.0})
    {
      // of the same pattern
      const Sparse_matrix scaled = factor * a;
      CHECK(solver.factorize(scaled));
      const auto check_plain = [&] {
        const Rows b = random_rows(static_cast<std::size_t>(a.rows()));
        Rows x = b;
        CHECK(solver.solve(x.size(), x.data()));
        CHECK_AT_MOST(error(dense(scaled), b, x), 1e-10);
      };
      check_plain();
      test_borders(solver, scaled);
      check_plain(); // a border that was refused is none
      const Border border = random_border(static_cast<int>(a.rows()), 1, 0);
      CHECK(solver.set_border(sparse(border.b), border.d));
      CHECK(solver.set_border(Sparse_matrix(a.rows(), 0), Eigen::MatrixXd(0, 0)));
      check_plain();
      CHECK(solver.set_border(sparse(border.b), border.d));
    }
    CHECK(solver.factorize(a)); // takes the border away
    const Rows b = random_rows(static_cast<std::size_t>(a.rows()));
    Rows x = b, y = b;
    CHECK(solver.solve(x.size(), x.data()));
    CHECK_AT_MOST(error(dense(a), b, x), 1e-10);

    // moves keep the factor, copies need one
    Solver copy(solver), moved(std::move(solver));
    CHECK(moved.solve(y.size(), y.data()) && x == y);
    CHECK(copy.analyze(a) && copy.factorize(a));
    y = b;
    CHECK(copy.solve(y.size(), y.data()) && x == y);
    copy = moved;
    moved = Solver();
    CHECK(copy.analyze(a) && copy.factorize(a));
  }
}

template <typename Solver>
void test_refusals(const std::string& name, const Solver& prototype)
{
  test_case() = name;
  const Sparse_matrix a = laplacian(144, grid_edges(12, 12), 0.1);
  for(int row : {0, 77, 143})
    for(double value : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()})
    {
      Solver solver(prototype);
      CHECK(solver.analyze(a));
      Sparse_matrix wrong = a;
      wrong.coeffRef(row, row) = value;
      CHECK(!solver.factorize(wrong));
      CHECK(solver.factorize(a));
      const Rows b = random_rows(144);
      Rows x = b;
      CHECK(solver.solve(x.size(), x.data()));
      CHECK_AT_MOST(error(dense(a), b, x), 1e-10);
    }
}

// the solution with that many threads, and the one with a border
template <typename Solver>
Rows solutions(Solver& solver, const Sparse_matrix& a, const Border& border, const Rows& b,
               unsigned int threads)
{
  const std::size_t n = static_cast<std::size_t>(a.rows());
  Rows x = b, y = b;
  run_with_threads(threads, [&] {
    CHECK(solver.factorize(a));
    CHECK(solver.solve(n, x.data()));
    CHECK(solver.set_border(sparse(border.b), border.d));
    CHECK(solver.solve(b.size(), y.data()));
  });
  x.resize(n);
  x.insert(x.end(), y.begin(), y.end());
  return x;
}

template <typename Solver>
void test_threads(const std::string& name, Solver solver)
{
  test_case() = name;
  const Sparse_matrix a = large_matrix();
  const Border border = random_border(static_cast<int>(a.rows()), 11, 6);
  const Rows b = random_rows(static_cast<std::size_t>(a.rows()) + 17);
  CHECK(solver.analyze(a));
  const Rows first = solutions(solver, a, border, b, 1);
  for(unsigned int threads : {1u, 2u, 8u, 0u})
    for(int k = 0; k < short_or_long(1, 5); ++k)
      CHECK(solutions(solver, a, border, b, threads) == first);

  const std::size_t n = static_cast<std::size_t>(a.rows());
  const Rows x(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(n));
  const Rows b_above(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(n));
  CHECK_AT_MOST(relative_residual(a, b_above, x), 1e-11);
  Sparse_matrix all(a.rows() + 17, a.rows() + 17);
  std::vector<Eigen::Triplet<double>> entries;
  for(int j = 0; j < a.cols(); ++j)
    for(Sparse_matrix::InnerIterator entry(a, j); entry; ++entry)
      entries.emplace_back(entry.row(), j, entry.value());
  for(int k = 0; k < 17; ++k)
  {
    for(int i = 0; i < a.rows(); ++i)
      if(border.b(i, k) != 0)
        entries.emplace_back(static_cast<int>(a.rows()) + k, i, border.b(i, k));
    for(int l = 0; l <= k; ++l)
      entries.emplace_back(static_cast<int>(a.rows()) + k, static_cast<int>(a.rows()) + l,
                           border.d(k, l));
  }
  all.setFromTriplets(entries.begin(), entries.end());
  const Rows y(first.begin() + static_cast<std::ptrdiff_t>(n), first.end());
  CHECK_AT_MOST(relative_residual(all, b, y), 1e-10);
}

// Borders hold to single precision where the factor has it, and for other threads too.
void test_borders_in_single_precision()
{
  Multifrontal_cholesky_solver solver(Factor_precision::single_precision);
  int number_of_singles = 0;
  for(const Problem& problem : small_problems())
  {
    test_case() = "single precision, " + problem.name;
    CHECK(solver.analyze(problem.matrix));
    CHECK(solver.factorize(problem.matrix));
    number_of_singles += solver.is_single_precision();
    test_borders(solver, problem.matrix, 1e-3);
  }
  CHECK(number_of_singles > 20);
}

// the bits are not compared of a factor in one piece
void test_blocks()
{
  test_case() = "blocks";
  const Sparse_matrix a = large_matrix();
  const internal::Supernodal_cholesky cholesky(
    a, internal::fill_reducing_order(a, Fill_reducing_ordering::minimum_degree));
  CHECK(cholesky.structure().blocks().size() > 20);
}

// the columns of a supernode and the update below them, with that many threads
Eigen::MatrixXd eliminated(Eigen::MatrixXd front, int width, unsigned int threads)
{
  const int height = static_cast<int>(front.rows()), below = height - width;
  Eigen::MatrixXd panel = front.leftCols(width), update = front.bottomRightCorner(below, below);
  run_with_threads(threads, [&] {
    internal::factor_panel(panel.data(), width, height);
    internal::subtract_square(update.data(), below, below, 0, below, panel.data() + width, width,
                              height);
  });
  front.leftCols(width) = panel;
  front.bottomRightCorner(below, below) = update;
  return front.triangularView<Eigen::Lower>();
}

// supernodes of all sizes that are divided, and not divided, into blocks
void test_supernodes()
{
  Every_nth is_run(7);
  for(int width : {1, 3, 4, 62, 64, 67, 128, 131, 194, 330})
    for(int below : {0, 1, 6, 61, 192, 193, 251, 390, 579})
    {
      if(!is_run())
        continue;
      test_case() = "supernode " + std::to_string(width) + ", " + std::to_string(below);
      const int height = width + below;
      const Eigen::MatrixXd random = Eigen::MatrixXd::Random(height, height);
      const Eigen::MatrixXd front =
        random + random.transpose() + 3 * height * Eigen::MatrixXd::Identity(height, height);
      const Eigen::MatrixXd result = eliminated(front, width, 1);
      CHECK(result == eliminated(front, width, 2) && result == eliminated(front, width, 8));

      // the columns times their transposes, and what is left, are the matrix
      Eigen::MatrixXd columns = result.leftCols(width);
      columns.diagonal() = columns.diagonal().cwiseInverse().eval(); // the factor has the inverses
      Eigen::MatrixXd difference = columns * columns.transpose() - front;
      difference.bottomRightCorner(below, below) += result.bottomRightCorner(below, below);
      difference.triangularView<Eigen::StrictlyUpper>().setZero();
      CHECK_AT_MOST(largest_entry(difference) / height, 1e-13);

      for(int wrong : {0, width / 2, width - 1})
      {
        Eigen::MatrixXd indefinite = front;
        indefinite(wrong, wrong) = -1;
        CHECK(std::isnan(eliminated(indefinite, width, 2)(wrong, wrong)));
      }
    }
}

// The values of one supernode of all widths: their number, where the diagonal is, and that a sweep
// forward and one backward solve with the factor.
void test_packed_values()
{
  for(int width = 1; width <= 40; ++width)
  {
    test_case() = "packed values, " + std::to_string(width);
    const Eigen::MatrixXd random = Eigen::MatrixXd::Random(width, width);
    Eigen::MatrixXd front = random * random.transpose() + Eigen::MatrixXd::Identity(width, width);
    const Eigen::MatrixXd matrix = front;
    internal::factor_panel(front.data(), width, width);

    internal::Supernodes supernodes;
    supernodes.columns = {0, width};
    supernodes.rows_begin = {0, 0};
    internal::Array<int> order(width);
    std::iota(order.begin(), order.end(), 0);
    const internal::Supernodal_structure structure(supernodes, order);
    const internal::Supernodal_structure::Supernode& s = structure.supernodes()[0];
    const double untouched = -7;
    internal::Array<double> values(structure.values_size() + 1, untouched);
    internal::pack_values(s, front.data(), values.data());
    CHECK(structure.values_size() == static_cast<std::size_t>(width * (width + 1) / 2));
    CHECK(values[structure.values_size()] == untouched);
    for(int j = 0; j < width; ++j)
      CHECK_AT_MOST(std::abs(internal::reciprocal_of_diagonal(s, values.data(), j)
                             / front(j, j) - 1), 1e-15);
    CHECK(internal::has_positive_diagonal(structure, values.data()));

    const Rows b = random_rows(static_cast<std::size_t>(width));
    Rows x = b;
    internal::Supernodal_substitution<double> substitution;
    substitution.forward(structure, values.data(), x.data());
    substitution.backward(structure, values.data(), x.data());
    CHECK_AT_MOST(relative_residual(sparse(matrix), b, x), 1e-10);
  }
}

// As many pieces as threads, of the largest sizes; and new ones where these do not serve.
void test_task_memory()
{
  test_case() = "memory of tasks";
  run_with_threads(2, [] {
    internal::Task_memory memory({10, 40, 20, 30});
    const std::size_t smallest = internal::number_of_threads() == 2 ? 30 : 40;
    internal::Task_memory::Piece first = memory.take(5);
    CHECK(first.size == smallest);
    internal::Task_memory::Piece second = memory.take(35);
    CHECK(second.size == (smallest == 30 ? 40 : 35));
    CHECK(memory.take(7).size == 7);
    const double* const place = first.numbers.get();
    memory.give_back(std::move(second));
    memory.give_back(std::move(first));
    CHECK(memory.take(41).size == 41);
    CHECK(smallest == 40 || memory.take(1).numbers.get() == place);
  });
}

template <typename Solver>
void test_solver(const std::string& name, const Solver& solver)
{
  static_assert(internal::can_have_border<Solver>);
  test_small(name, solver);
  test_refusals(name, solver);
}

// Of several blocks, and a NaN in any of them is not lost.
void test_largest_entry()
{
  test_case() = "largest entry";
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  Rows rows(20000, {1, -2, 0});
  rows[15000][1] = -7;
  CHECK(CGAL::ARAP::internal::largest_entry(rows.data(), rows.size()) == 7);
  for(std::size_t k : {std::size_t(0), std::size_t(9000), rows.size() - 1})
  {
    Rows with_nan = rows;
    with_nan[k][0] = not_a_number;
    CHECK(std::isnan(CGAL::ARAP::internal::largest_entry(with_nan.data(), with_nan.size())));
  }
}

int main()
{
#ifdef CGAL_LINKED_WITH_TBB
  // as many threads as are asked for, and not only as many as there are cores
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 8);
#endif
  test_blocks();
  test_largest_entry();
  test_supernodes();
  test_packed_values();
  test_task_memory();
  test_borders_in_single_precision();
  for(Fill_reducing_ordering ordering :
      {Fill_reducing_ordering::minimum_degree, Fill_reducing_ordering::nested_dissection})
  {
    const std::string suffix =
      ordering == Fill_reducing_ordering::minimum_degree ? "" : ", nested dissection";
    test_solver("Multifrontal_cholesky_solver" + suffix, Multifrontal_cholesky_solver(ordering));
    test_threads("Multifrontal_cholesky_solver" + suffix, Multifrontal_cholesky_solver(ordering));
#ifdef CGAL_LINKED_WITH_CHOLMOD
    test_solver("Cholmod_solver" + suffix, Cholmod_solver(ordering));
    test_threads("Cholmod_solver" + suffix, Cholmod_solver(ordering));
#endif
  }
  return checks_result();
}
