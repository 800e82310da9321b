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

#ifndef CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_SPARSE_SOLVER_H
#define CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_SPARSE_SOLVER_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/conformance/internal/Violations.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/solver/Linear_solver.h>
#include <CGAL/ARAP_deformation/internal/solver/sparse_solver_requirements.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {

namespace internal {

class Sparse_solver_check
{
public:
  Sparse_solver_check(const Linear_solver& prototype, double tolerance)
    : m_prototype(prototype), m_tolerance(tolerance)
  {}

  std::vector<std::string> operator()()
  {
    m_violations.run("the solver", [this] {
      check_family("a matrix with one row", [this] { return path(1); });
      check_family("a path", [this] { return path(10); });
      check_family("a grid", [this] { return grid(9, 7, 0.1); });
      check_family("a grid with some edges of weight zero",
                   [this] { return grid(12, 11, 0.1, 0.3); });
      check_family("an ill-conditioned grid", [this] { return grid(14, 14, 1e-5); });
      check_copies();
      if(m_prototype.can_have_border())
        check_borders();
      check_refusals();
    });
    return m_violations.sentences();
  }

private:
  using Rows = Array<Coordinates>;
  using Solver = std::unique_ptr<Linear_solver>;

  double random(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(m_random);
  }

  // The Laplacian of a graph with random weights, a fraction of them zero, plus a random diagonal
  // from `shift` to `2 * shift`. The pattern does not depend on the weights.
  Sparse_matrix laplacian(int n, const std::vector<std::pair<int, int>>& edges, double shift,
                          double fraction_of_zeros)
  {
    std::vector<Eigen::Triplet<double, int>> entries;
    for(const auto& [i, j] : edges)
    {
      const double weight = random(0, 1) < fraction_of_zeros ? 0 : random(0.5, 2);
      entries.emplace_back(i, i, weight);
      entries.emplace_back(j, j, weight);
      entries.emplace_back((std::max)(i, j), (std::min)(i, j), -weight);
    }
    for(int i = 0; i < n; ++i)
      entries.emplace_back(i, i, shift * random(1, 2));
    Sparse_matrix a(n, n);
    a.setFromTriplets(entries.begin(), entries.end());
    return a;
  }

  Sparse_matrix path(int n)
  {
    std::vector<std::pair<int, int>> edges;
    for(int i = 0; i + 1 < n; ++i)
      edges.emplace_back(i, i + 1);
    return laplacian(n, edges, 0.5, 0);
  }

  Sparse_matrix grid(int columns, int rows, double shift, double fraction_of_zeros = 0)
  {
    std::vector<std::pair<int, int>> edges;
    for(int i = 0; i < columns; ++i)
      for(int j = 0; j < rows; ++j)
      {
        if(i + 1 < columns) edges.emplace_back(i * rows + j, (i + 1) * rows + j);
        if(j + 1 < rows) edges.emplace_back(i * rows + j, i * rows + j + 1);
      }
    return laplacian(columns * rows, edges, shift, fraction_of_zeros);
  }

  Rows random_rows(const Sparse_matrix& a)
  {
    Rows rows(static_cast<std::size_t>(a.rows()));
    for(Coordinates& row : rows)
      row = {random(-1, 1), random(-10, 10), random(-0.1, 0.1)};
    return rows;
  }

  static double largest_in_column(const Rows& rows, std::size_t column)
  {
    double largest = 0;
    for(const Coordinates& row : rows)
    {
      if(!internal::is_finite(row[column]))
        return std::abs(row[column]);
      largest = (std::max)(largest, std::abs(row[column]));
    }
    return largest;
  }

  // the residual of each column, relative to the right-hand side
  static std::array<double, 3> residuals(const Sparse_matrix& a, const Rows& x, const Rows& b)
  {
    Rows difference = b;
    for(int column = 0; column < a.outerSize(); ++column)
      for(Sparse_matrix::InnerIterator entry(a, column); entry; ++entry)
        for(std::size_t c = 0; c < 3; ++c)
        {
          difference[entry.row()][c] -= entry.value() * x[column][c];
          if(entry.row() != column)
            difference[column][c] -= entry.value() * x[entry.row()][c];
        }
    std::array<double, 3> result;
    for(std::size_t c = 0; c < 3; ++c)
    {
      const double scale = largest_in_column(b, c);
      result[c] = largest_in_column(difference, c) / (scale > 0 ? scale : 1);
    }
    return result;
  }

  // Solves in an array with a margin on both sides, which must not be touched.
  void check_solution(const Solver& solver, const Sparse_matrix& a, const Rows& b,
                      const std::string& name)
  {
    const std::size_t n = b.size(), margin = 4;
    const Coordinates untouched = {12345, -6789, 0.125};
    Rows array(n + 2 * margin, untouched);
    std::copy(b.begin(), b.end(), array.begin() + margin);
    if(!solver->solve(n, array.data() + margin))
      return m_violations.check(false, "solve() returns false for ", name);
    for(std::size_t k = 0; k < margin; ++k)
      m_violations.check(array[k] == untouched && array[margin + n + k] == untouched,
                         "solve() writes outside the n rows of x for ", name);
    const auto errors = residuals(a, Rows(array.data() + margin, array.data() + margin + n), b);
    for(std::size_t c = 0; c < 3; ++c)
      m_violations.check(errors[c] <= m_tolerance, "solve() leaves in column ", c, " a relative "
                         "residual of ", errors[c], ", above ", m_tolerance, ", for ", name);
  }

  // with full right-hand sides, twice, then with one nonzero column at a time, then with zeros
  void check_solutions(const Solver& solver, const Sparse_matrix& a, const std::string& name)
  {
    check_solution(solver, a, random_rows(a), name);
    check_solution(solver, a, random_rows(a), name + ", when it is called again");
    for(std::size_t column = 0; column < 3; ++column)
    {
      Rows b = random_rows(a);
      for(Coordinates& row : b)
        for(std::size_t c = 0; c < 3; ++c)
          row[c] = c == column ? row[c] : 0;
      check_solution(solver, a, b, name + " and a right-hand side in which only column " +
                     std::to_string(column) + " is not zero");
    }
    check_solution(solver, a, Rows(static_cast<std::size_t>(a.rows()), Coordinates{0, 0, 0}),
                   name + " and a right-hand side of zeros");
  }

  bool prepare(const Solver& solver, const Sparse_matrix& a, const std::string& name)
  {
    // copies, since a solver must not refer to the matrix after the call
    const bool is_analyzed = solver->analyze(Sparse_matrix(a));
    m_violations.check(is_analyzed, "analyze() returns false for ", name);
    return is_analyzed && factorize(solver, a, name);
  }

  bool factorize(const Solver& solver, const Sparse_matrix& a, const std::string& name)
  {
    const bool is_factorized = solver->factorize(Sparse_matrix(a));
    m_violations.check(is_factorized, "factorize() returns false for ", name,
                       ", which is positive definite");
    return is_factorized;
  }

  template <typename Make>
  void check_family(const std::string& name, const Make& make)
  {
    const Solver solver = m_prototype.copy();
    const Sparse_matrix a = make(), same_pattern = make();
    if(!prepare(solver, a, name))
      return;
    check_solutions(solver, a, name);
    const std::string again = name + ", factorized after another matrix of the same pattern";
    if(factorize(solver, same_pattern, again))
      check_solutions(solver, same_pattern, again);
    const Sparse_matrix other = path(6);
    const std::string analyzed_again = "a path, analyzed after " + name;
    if(prepare(solver, other, analyzed_again))
      check_solutions(solver, other, analyzed_again);
  }

  void check_copies()
  {
    // of one size, so that a solver that takes the wrong one does not leave its arrays
    const Sparse_matrix a = grid(6, 5, 0.2), b = path(30);
    const Solver first = m_prototype.copy(), second = m_prototype.copy();
    if(!prepare(first, a, "a grid") || !prepare(second, b, "a path"))
      return;
    check_solution(first, a, random_rows(a), "a grid after a copy has factorized a path");
    check_solution(second, b, random_rows(b), "a path after a copy has factorized a grid");

    const Solver copy = first->copy();
    if(prepare(copy, b, "a path, in a copy of a solver with a factor"))
      check_solution(copy, b, random_rows(b), "a path, in a copy of a solver with a factor");
    check_solution(first, a, random_rows(a), "a grid after a copy has analyzed another matrix");
  }

  // A border with multipliers and with further unknowns, removed and set again.
  void check_borders()
  {
    const Sparse_matrix a = grid(9, 8, 0.3);
    const int n = static_cast<int>(a.rows());
    const Sparse_matrix none(n, 0);
    const Solver solver = m_prototype.copy();
    if(!prepare(solver, a, "a grid that will get a border"))
      return;
    const auto is_border_set = [&](Sparse_matrix b, Eigen::MatrixXd d) {
      const bool is_set = solver->set_border(b, d);
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      b *= nan; // a solver must not refer to them after the call
      d *= nan;
      return is_set;
    };
    const auto set_border = [&](const Sparse_matrix& b, const Eigen::MatrixXd& d) {
      const bool is_set = is_border_set(b, d);
      m_violations.check(is_set, "set_border() returns false for ", b.cols(), " columns");
      return is_set;
    };
    // multipliers that depend on each other: two that are the same, and one without entries
    for(const int entries_of_second : {1, 0})
    {
      Sparse_matrix b(n, 2);
      b.insert(5, 0) = 1;
      if(entries_of_second > 0)
        b.insert(5, 1) = 1;
      b.makeCompressed();
      m_violations.check(!is_border_set(b, Eigen::MatrixXd::Zero(2, 2)),
                         "set_border() returns true for multipliers that depend on each other");
    }
    for(int repetition = 0; repetition < 4; ++repetition)
    {
      const int size = repetition < 2 ? 7 : 40, number_of_multipliers = repetition < 2 ? 3 : 20;
      const double diagonal = 3 * size;
      std::vector<Eigen::Triplet<double, int>> entries;
      Eigen::MatrixXd d = Eigen::MatrixXd::Zero(size, size);
      for(int k = 0; k < number_of_multipliers; ++k)
        entries.emplace_back((11 * k + repetition) % n, k, 1);
      d(0, 0) = -0.5 * (repetition % 2); // every second time a penalty instead of a constraint
      for(int k = number_of_multipliers; k < size; ++k)
      {
        d(k, k) = diagonal;
        for(int j = 0; j < 3; ++j)
          entries.emplace_back((17 * k + 5 * j + repetition) % n, k, -random(0.5, 1));
      }
      d(size - 1, size - 2) = -0.5;
      Sparse_matrix b(n, size);
      b.setFromTriplets(entries.begin(), entries.end());
      if(!set_border(b, d))
        return;
      const Sparse_matrix whole = bordered(a, b, d);
      check_solution(solver, whole, random_rows(whole), "a matrix with a border");

      d(size - 1, size - 1) = 1e-3; // not a multiplier, and too small for a minimum
      m_violations.check(!is_border_set(b, d), "set_border() returns true for a matrix that "
                         "is not positive definite");
      check_solution(solver, a, random_rows(a), "a matrix after a border was refused");
      d(size - 1, size - 1) = diagonal;
      if(set_border(b, d) && set_border(none, Eigen::MatrixXd()))
        check_solution(solver, a, random_rows(a), "a matrix without the border that it had");
      if(set_border(b, d) && factorize(solver, a, "a grid that had a border"))
        check_solution(solver, a, random_rows(a), "a matrix that was factorized with a border set");
    }
  }

  // the bordered matrix, its lower triangle
  static Sparse_matrix bordered(const Sparse_matrix& a, const Sparse_matrix& b,
                                const Eigen::MatrixXd& d)
  {
    std::vector<Eigen::Triplet<double, int>> entries;
    const int n = static_cast<int>(a.rows()), size = static_cast<int>(b.cols());
    for(int column = 0; column < n; ++column)
      for(Sparse_matrix::InnerIterator entry(a, column); entry; ++entry)
        entries.emplace_back(entry.row(), column, entry.value());
    for(int column = 0; column < size; ++column)
    {
      for(Sparse_matrix::InnerIterator entry(b, column); entry; ++entry)
        entries.emplace_back(n + column, entry.row(), entry.value());
      for(int row = column; row < size; ++row)
        entries.emplace_back(n + row, n + column, d(row, column));
    }
    Sparse_matrix result(n + size, n + size);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  // A matrix that is not positive definite must be refused, or solved correctly.
  void check_refusals()
  {
    const auto matrix = [](int n, double diagonal, double off_diagonal) {
      std::vector<Eigen::Triplet<double, int>> entries;
      for(int i = 0; i < n; ++i)
      {
        entries.emplace_back(i, i, diagonal);
        if(i + 1 < n) entries.emplace_back(i + 1, i, off_diagonal);
      }
      Sparse_matrix a(n, n);
      a.setFromTriplets(entries.begin(), entries.end());
      return a;
    };
    const auto check = [&](const Sparse_matrix& a, const std::string& name) {
      const Solver solver = m_prototype.copy();
      if(!solver->analyze(a))
        return;
      const Rows b = random_rows(a);
      Rows x = b;
      if(solver->factorize(a) && solver->solve(x.size(), x.data()))
        for(double error : residuals(a, x, b))
          m_violations.check(error <= m_tolerance, "nothing is refused, but the solution is wrong "
                             "for ", name, ": its relative residual is ", error);
      const Sparse_matrix good = matrix(static_cast<int>(a.rows()), 3, 1);
      const std::string after = "a positive definite matrix after " + name;
      if(factorize(solver, good, after))
        check_solution(solver, good, random_rows(good), after);
    };
    check(matrix(1, 0, 0), "a matrix with the one entry 0");
    check(matrix(5, 0, 0), "a matrix of zeros");
    check(matrix(6, -2, 1), "a negative definite matrix");
    check(matrix(6, 1, 2), "an indefinite matrix");
    check(matrix(2, 0, 1), "an indefinite matrix with zeros on the diagonal");
  }

  const Linear_solver& m_prototype;
  double m_tolerance;
  std::mt19937 m_random;
  Violations m_violations;
};

} // namespace internal

/// \ingroup PkgARAPDeformationChecks
/// \brief returns a message for each requirement of `ARAPSparseSolver` that a model violates; none
/// if it conforms.
///
/// Factorizes small positive definite matrices, some with explicit zeros and some with the same
/// pattern, and computes the residuals of all three columns. Copies must be independent, and
/// matrices that are not positive definite must be refused or solved correctly. Borders are set,
/// refused and removed if the model supports them. Takes milliseconds.
///
/// \param solver the model; its copies are used
/// \param tolerance the largest residual relative to the right-hand side, both in the maximum norm
///        of a column. The matrices have condition numbers up to \f$10^6\f$.
template <typename SparseSolver>
std::vector<std::string> check_sparse_solver(const SparseSolver& solver, double tolerance = 1e-9)
{
  static_assert(internal::Sparse_solver_requirements<SparseSolver>::are_met);
  const internal::Linear_solver_of<SparseSolver> prototype(solver);
  return internal::Sparse_solver_check(prototype, tolerance)();
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_SPARSE_SOLVER_H
