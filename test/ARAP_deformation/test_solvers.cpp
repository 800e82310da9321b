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

// The solvers: conformance, and one deformation with each of them and with each rotation fitting.

#include "include/compiled_solvers.h"
#include "include/dense_algebra.h"
#include "include/domains.h"
#include "include/length.h"
#include "include/Single_precision_solver.h"
#include "include/term_runs.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Cholmod_solver.h>
#include <CGAL/ARAP_deformation/Closest_rotation_traits_adaptor.h>
#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/Sparse_linear_algebra_adaptor.h>
#include <CGAL/ARAP_deformation/conformance/check_sparse_solver.h>
#include <CGAL/ARAP_deformation_traits.h>

#include <CGAL/Default.h>
#include <CGAL/Deformation_Eigen_closest_rotation_traits_3.h>
#include <CGAL/Deformation_Eigen_polar_closest_rotation_traits_3.h>
#include <CGAL/Eigen_solver_traits.h>

#include <Eigen/Dense>
#include <Eigen/SparseLU>
#ifdef CGAL_ARAP_TEST_ALL // dear to compile
#include <Eigen/SparseQR>
#endif

#include <cstddef>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

// Each solver that ships conforms to the concept, and broken ones are caught.
namespace conformance {

using namespace CGAL::ARAP;

using General_matrix = CGAL::Eigen_sparse_matrix<double>::EigenType;
using LU = CGAL::Eigen_solver_traits<Eigen::SparseLU<General_matrix, Eigen::COLAMDOrdering<int>>>;
using CGAL_cholesky = CGAL::Eigen_solver_traits<Eigen::SimplicialCholesky<General_matrix>>;

// A model of nothing but SparseLinearAlgebraWithFactorTraits_d: neither copied nor moved, with
// solutions that are multiples of 1 / D, and a matrix that it only refers to.
class Bare_linear_algebra
{
public:
  using NT = double;

  class Vector
  {
  public:
    explicit Vector(int n) : m_entries(n) {}
    int dimension() const { return static_cast<int>(m_entries.size()); }
    double& operator[](int k) { return m_entries[k]; }
    double operator[](int k) const { return m_entries[k]; }

  private:
    std::vector<double> m_entries;
  };

  class Matrix
  {
  public:
    explicit Matrix(int n) : dense(Eigen::MatrixXd::Zero(n, n)) {}
    void set_coef(int i, int j, double value, bool = false) { dense(i, j) = value; }

    Eigen::MatrixXd dense;
  };

  Bare_linear_algebra() = default;
  Bare_linear_algebra(const Bare_linear_algebra&) = delete;
  Bare_linear_algebra& operator=(const Bare_linear_algebra&) = delete;

  bool factor(const Matrix& a, double& d)
  {
    m_matrix = &a;
    d = 2;
    return is_invertible(a.dense);
  }

  bool linear_solver(const Vector& b, Vector& x)
  {
    Eigen::VectorXd column(b.dimension());
    for(int k = 0; k < b.dimension(); ++k)
      column[k] = 2 * b[k];
    column = dense_solution(m_matrix->dense, column);
    for(int k = 0; k < b.dimension(); ++k)
      x[k] = column[k];
    return true;
  }

private:
  const Matrix* m_matrix = nullptr;
};

// What the broken solvers are made of.
class Whole_solver
{
public:
  bool analyze(const Sparse_matrix& a) { return m_solver.analyze(a); }
  bool factorize(const Sparse_matrix& a) { return m_solver.factorize(a); }
  bool solve(std::size_t n, Coordinates* x) { return m_solver.solve(n, x); }

protected:
  Multifrontal_cholesky_solver m_solver;
};

struct Wrong_sign : Whole_solver
{
  bool solve(std::size_t n, Coordinates* x)
  {
    const bool is_solved = Whole_solver::solve(n, x);
    for(std::size_t k = 0; k < n; ++k)
      for(double& c : x[k])
        c = -c;
    return is_solved;
  }
};

struct Forgets_third_column : Whole_solver
{
  bool solve(std::size_t n, Coordinates* x)
  {
    std::vector<double> third;
    for(std::size_t k = 0; k < n; ++k)
      third.push_back(x[k][2]);
    const bool is_solved = Whole_solver::solve(n, x);
    for(std::size_t k = 0; k < n; ++k)
      x[k][2] = third[k];
    return is_solved;
  }
};

struct Mixes_columns : Whole_solver
{
  bool solve(std::size_t n, Coordinates* x)
  {
    const bool is_solved = Whole_solver::solve(n, x);
    for(std::size_t k = 0; k < n; ++k)
      x[k][1] += 1e-6 * x[k][0];
    return is_solved;
  }
};

struct Writes_too_far : Whole_solver
{
  bool solve(std::size_t n, Coordinates* x)
  {
    const bool is_solved = Whole_solver::solve(n, x);
    x[n] = {0, 0, 0};
    return is_solved;
  }
};

struct Solves_once : Whole_solver
{
  bool factorize(const Sparse_matrix& a)
  {
    m_is_fresh = true;
    return Whole_solver::factorize(a);
  }
  bool solve(std::size_t n, Coordinates* x)
  {
    return std::exchange(m_is_fresh, false) && Whole_solver::solve(n, x);
  }
  bool m_is_fresh = false;
};

struct Keeps_first_matrix : Whole_solver
{
  bool analyze(const Sparse_matrix& a)
  {
    m_is_factorized = false;
    return Whole_solver::analyze(a);
  }
  bool factorize(const Sparse_matrix& a)
  {
    return m_is_factorized || (m_is_factorized = Whole_solver::factorize(a));
  }
  bool m_is_factorized = false;
};

// copies refer to one and the same factor
struct Not_a_copy
{
  bool analyze(const Sparse_matrix& a) { return m_solver->analyze(a); }
  bool factorize(const Sparse_matrix& a) { return m_solver->factorize(a); }
  bool solve(std::size_t n, Coordinates* x) { return m_solver->solve(n, x); }
  std::shared_ptr<Whole_solver> m_solver = std::make_shared<Whole_solver>();
};

struct Overflows : Whole_solver
{
  bool solve(std::size_t n, Coordinates* x)
  {
    x[0].fill(std::numeric_limits<double>::infinity());
    return n > 1 || Whole_solver::solve(n, x);
  }
};

// takes the triangle that is stored for the whole matrix
struct Forgets_upper_triangle
{
  bool analyze(const Sparse_matrix&) { return true; }
  bool factorize(const Sparse_matrix& a)
  {
    m_lower = a;
    return true;
  }
  bool solve(std::size_t n, Coordinates* x)
  {
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> rows(
      x->data(), static_cast<Eigen::Index>(n), 3);
    Eigen::MatrixXd b = rows;
    m_lower.triangularView<Eigen::Lower>().solveInPlace(b);
    rows = b;
    return b.allFinite();
  }
  Sparse_matrix m_lower;
};

// says that all went well
struct Hides_failures : Whole_solver
{
  bool factorize(const Sparse_matrix& a)
  {
    m_is_factorized = Whole_solver::factorize(a);
    return true;
  }
  bool solve(std::size_t n, Coordinates* x)
  {
    if(m_is_factorized)
      Whole_solver::solve(n, x);
    return true;
  }
  bool m_is_factorized = false;
};

// takes some entries for zero
struct Loses_entries
{
  bool analyze(const Sparse_matrix& a) { return m_solver.analyze(pruned(a)); }
  bool factorize(const Sparse_matrix& a) { return m_solver.factorize(pruned(a)); }
  bool solve(std::size_t n, Coordinates* x) { return m_solver.solve(n, x); }
  static Sparse_matrix pruned(Sparse_matrix a)
  {
    for(int column = 0; column < a.cols(); ++column)
      for(Sparse_matrix::InnerIterator entry(a, column); entry; ++entry)
        if(entry.row() > column && entry.row() % 3 == 0)
          entry.valueRef() = 0;
    return a;
  }
  Multifrontal_cholesky_solver m_solver;
};

struct Border_of_wrong_sign : Multifrontal_cholesky_solver
{
  bool set_border(const Sparse_matrix& b, const Eigen::MatrixXd& d)
  {
    return Multifrontal_cholesky_solver::set_border(-b, d);
  }
};

struct Keeps_border : Multifrontal_cholesky_solver
{
  bool set_border(const Sparse_matrix& b, const Eigen::MatrixXd& d)
  {
    return b.cols() == 0 || Multifrontal_cholesky_solver::set_border(b, d);
  }
};

struct Sets_any_border : Multifrontal_cholesky_solver
{
  bool set_border(const Sparse_matrix& b, const Eigen::MatrixXd& d)
  {
    Multifrontal_cholesky_solver::set_border(b, d);
    return true;
  }
};

struct Suffers_from_refused_border : Multifrontal_cholesky_solver
{
  bool set_border(const Sparse_matrix& b, const Eigen::MatrixXd& d)
  {
    return m_is_border_set = Multifrontal_cholesky_solver::set_border(b, d);
  }
  bool solve(std::size_t n, Coordinates* x)
  {
    const bool is_solved = Multifrontal_cholesky_solver::solve(n, x);
    for(std::size_t k = 0; k < n && !m_is_border_set; ++k)
      x[k][0] *= 2;
    return is_solved;
  }
  bool m_is_border_set = true;
};

struct Throws : Whole_solver
{
  bool factorize(const Sparse_matrix&) { throw std::runtime_error("no license"); }
};

void test_all()
{
  CHECK_CONFORMS(check_sparse_solver(Multifrontal_cholesky_solver()));
  CHECK_CONFORMS(check_sparse_solver(Whole_solver()));
  using LLT = Eigen::SimplicialLLT<Sparse_matrix, Eigen::Lower>;
  CHECK_CONFORMS(check_sparse_solver(Eigen_sparse_solver<LLT>()));
  CHECK_CONFORMS(check_sparse_solver(Eigen_LDLT_solver()));
  CHECK_CONFORMS(check_sparse_solver(Eigen_conjugate_gradient_solver()));
  // what reads the upper triangle or both
  CHECK_CONFORMS(check_sparse_solver(
    Eigen_sparse_solver<Eigen::SparseLU<Sparse_matrix, Eigen::COLAMDOrdering<int>>>()));
  const Eigen_conjugate_gradient_solver loose([](auto& solver) { solver.setTolerance(1e-4); });
  CHECK_CONFORMS(check_sparse_solver(loose, 1e-2));
  CHECK_CAUGHT(check_sparse_solver(loose), "relative residual");
  const Eigen_conjugate_gradient_solver few([](auto& solver) { solver.setMaxIterations(2); });
  CHECK_CAUGHT(check_sparse_solver(few), "solve() returns false");
#ifdef CGAL_LINKED_WITH_CHOLMOD
  CHECK_CONFORMS(check_sparse_solver(Cholmod_solver()));
#endif
  CHECK_CONFORMS(check_sparse_solver(Sparse_linear_algebra_adaptor<LU>()));
  CHECK_CONFORMS(check_sparse_solver(Sparse_linear_algebra_adaptor<Bare_linear_algebra>()));
  using Gradients = CGAL::Eigen_solver_traits<Eigen::ConjugateGradient<General_matrix>>;
  const Sparse_linear_algebra_adaptor<Gradients> gradients(
    [](Gradients& traits) { traits.solver().setTolerance(1e-13); });
  CHECK_CONFORMS(check_sparse_solver(gradients));
#ifdef CGAL_ARAP_TEST_ALL // dear to compile
  CHECK_CONFORMS(check_sparse_solver(
    Eigen_sparse_solver<Eigen::SimplicialLDLT<Sparse_matrix, Eigen::Upper>>()));
  CHECK_CONFORMS(check_sparse_solver(
    Eigen_sparse_solver<Eigen::ConjugateGradient<Sparse_matrix, Eigen::Lower | Eigen::Upper>>()));
  // a preconditioner that reads both triangles, and is exact: one iteration
  using With_general_preconditioner =
    Eigen::ConjugateGradient<Sparse_matrix, Eigen::Lower, Eigen::IncompleteLUT<double>>;
  Eigen_sparse_solver<With_general_preconditioner> exact([](With_general_preconditioner& solver) {
    solver.preconditioner().setDroptol(1e-15);
    solver.preconditioner().setFillfactor(1000);
    solver.setMaxIterations(3);
  });
  Sparse_matrix path(40, 40);
  for(int k = 0; k < 40; ++k)
  {
    path.insert(k, k) = 2.01;
    if(k < 39)
      path.insert(k + 1, k) = -1;
  }
  path.makeCompressed();
  std::vector<CGAL::ARAP::Coordinates> forty(40, {1, 2, 3});
  CHECK(exact.analyze(path) && exact.factorize(path) && exact.solve(forty.size(), forty.data()));
  CHECK_CONFORMS(check_sparse_solver(
    Eigen_sparse_solver<Eigen::SparseQR<Sparse_matrix, Eigen::COLAMDOrdering<int>>>()));
  CHECK_CONFORMS(check_sparse_solver(Sparse_linear_algebra_adaptor<CGAL_cholesky>()));
#endif

  CHECK_CAUGHT(check_sparse_solver(Wrong_sign()), "relative residual");
  CHECK_CAUGHT(check_sparse_solver(Forgets_third_column()), "in column 2");
  CHECK_CAUGHT(check_sparse_solver(Mixes_columns()), "in column 1");
  CHECK_CAUGHT(check_sparse_solver(Writes_too_far()), "outside the n rows");
  CHECK_CAUGHT(check_sparse_solver(Solves_once()), "called again");
  CHECK_CAUGHT(check_sparse_solver(Keeps_first_matrix()), "another matrix of the same pattern");
  CHECK_CAUGHT(check_sparse_solver(Not_a_copy()), "copy");
  CHECK_CAUGHT(check_sparse_solver(Overflows()), "relative residual");
  CHECK_CAUGHT(check_sparse_solver(Forgets_upper_triangle()), "relative residual");
  CHECK_CAUGHT(check_sparse_solver(Hides_failures()), "nothing is refused");
  CHECK_CAUGHT(check_sparse_solver(Loses_entries()), "relative residual");
  CHECK_CAUGHT(check_sparse_solver(Throws()), "no license");
  CHECK_CAUGHT(check_sparse_solver(Border_of_wrong_sign()), "for a matrix with a border");
  CHECK_CAUGHT(check_sparse_solver(Keeps_border()), "without the border");
  CHECK_CAUGHT(check_sparse_solver(Sets_any_border()), "not positive definite");
  CHECK_CAUGHT(check_sparse_solver(Suffers_from_refused_border()), "after a border was refused");

  // what is not positive definite, or no number, is noticed by factorize() or solve() at the latest
  const auto refuses = [](auto solver, double off_diagonal) {
    Sparse_matrix a(2, 2);
    a.insert(0, 0) = 1;
    a.insert(1, 0) = off_diagonal;
    a.insert(1, 1) = 1;
    a.makeCompressed();
    Coordinates x[2] = {{1, 2, 3}, {4, 5, 6}};
    return solver.analyze(a) && !(solver.factorize(a) && solver.solve(2, x));
  };
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for(double off_diagonal : {2.0, not_a_number})
  {
    CHECK(refuses(Multifrontal_cholesky_solver(), off_diagonal));
    CHECK(refuses(Eigen_LDLT_solver(), off_diagonal));
#ifdef CGAL_LINKED_WITH_CHOLMOD
    CHECK(refuses(Cholmod_solver(), off_diagonal));
#endif
  }
  CHECK(refuses(Eigen_conjugate_gradient_solver(), not_a_number));
  CHECK(refuses(Sparse_linear_algebra_adaptor<LU>(), not_a_number));

  // a solution that is not finite is a failure
  const auto overflows = [](auto solver) {
    Sparse_matrix a(1, 1);
    a.insert(0, 0) = 1e-200;
    Coordinates x[1] = {{0, 1e200, 0}};
    return solver.analyze(a) && solver.factorize(a) && !solver.solve(1, x);
  };
  CHECK(overflows(Eigen_LDLT_solver()));
  CHECK(overflows(Sparse_linear_algebra_adaptor<LU>()));
}

} // namespace conformance

// One deformation, solved by all solvers and with all rotation fittings: how far the shapes are
// from that of the default, relative to the bounding box.
namespace swaps {

using namespace CGAL::ARAP;

using Matrix = CGAL::Eigen_sparse_matrix<double>::EigenType;
using CGAL_LU = CGAL::Eigen_solver_traits<Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>>>;
using CGAL_LDLT = CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<Matrix>>;
using CGAL_svd = CGAL::Deformation_Eigen_closest_rotation_traits_3;
using CGAL_polar = CGAL::Deformation_Eigen_polar_closest_rotation_traits_3;

class Swaps
{
public:
  explicit Swaps(unsigned int iterations) : m_iterations(iterations) {}

  template <typename Traits>
  void operator()(const char* name, const Traits& traits, double bound)
  {
    double largest = 0;
    for(const Cell_scheme& cells : all_cell_schemes)
      for(double target_weight : {std::numeric_limits<double>::infinity(), 0.5})
      {
        const std::size_t k = m_run++;
        if(k == m_default.size())
          m_default.push_back(deformed(traits, cells, target_weight));
        const std::vector<Point> points = deformed(traits, cells, target_weight);
        largest = larger(largest, largest_distance(points, m_default[k]) / m_shape.diameter());
      }
    m_run = 0;
    std::printf("%-60s %.1e\n", name, largest);
    test_case() = name;
    CHECK_AT_MOST(largest, bound);
  }

private:
  template <typename Traits>
  std::vector<Point> deformed(const Traits& traits, const Cell_scheme& cells,
                              double target_weight) const
  {
    Mesh mesh = make_mesh<Mesh>(m_shape);
    CGAL::ARAP_deformation<Mesh, Traits> deformation(mesh, traits);
    CHECK(deformation.set_options(options_for(cells)));
    prepare(deformation, scenario(m_shape), all_vertices(mesh));
    for(auto v : deformation.control_vertices())
      CHECK(deformation.set_target_weight(v, target_weight));
    CHECK(deformation.deform(m_iterations, 0));
    return points_of(mesh);
  }

  Shape m_shape = grid("bumpy sheet", short_or_long(24, 48), short_or_long(18, 36),
                       [](double u, double v) {
    return Eigen::Vector3d(2 * u, 1.5 * v, 0.1 * std::sin(19 * u) * std::cos(13 * v));
  });
  unsigned int m_iterations;
  std::size_t m_run = 0;
  std::vector<std::vector<Point>> m_default; // for each case
};

// A solver of any type. One type for all: a deformation takes longest to compile.
struct Any_solver : Compiled_solver
{
  template <typename Solver>
  explicit Any_solver(const Solver& solver)
    : Compiled_solver(std::make_unique<internal::Linear_solver_of<Solver>>(solver))
  {}
};

template <typename Solver>
CGAL::ARAP_deformation_traits<Any_solver> with_solver(const Solver& solver = Solver())
{
  return CGAL::ARAP_deformation_traits<Any_solver>(Any_solver(solver));
}

template <typename Rotation>
CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::Default, Rotation> with_rotation()
{
  return CGAL::ARAP_deformation_traits<CGAL::Default, CGAL::Default, Rotation>();
}

void test_all()
{
  Swaps swaps(20);
  swaps("Multifrontal_cholesky_solver, Newton_closest_rotation (default)",
        CGAL::ARAP_deformation_traits<>(), 0);

  const double direct = 1e-8;
  swaps("Eigen_sparse_solver<Eigen::SimplicialLLT>",
        with_solver<Eigen_sparse_solver<Eigen::SimplicialLLT<Sparse_matrix>>>(), direct);
  swaps("Eigen_LDLT_solver", with_solver<Eigen_LDLT_solver>(), direct);
  swaps("CGAL::Eigen_solver_traits<Eigen::SparseLU>",
        with_solver<Sparse_linear_algebra_adaptor<CGAL_LU>>(), direct);
  swaps("CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT>",
        with_solver<Sparse_linear_algebra_adaptor<CGAL_LDLT>>(), direct);

  // the errors of these are corrections that come an iteration later
  swaps("Eigen_conjugate_gradient_solver", with_solver<Eigen_conjugate_gradient_solver>(), 1e-8);
  for(double tolerance : {1e-8, 1e-4})
  {
    const Eigen_conjugate_gradient_solver solver(
      [tolerance](auto& gradients) { gradients.setTolerance(tolerance); });
    swaps(tolerance == 1e-8 ? "Eigen_conjugate_gradient_solver, tolerance 1e-8"
                            : "Eigen_conjugate_gradient_solver, tolerance 1e-4",
          with_solver(solver), 10 * tolerance);
  }

  swaps("SVD_closest_rotation", with_rotation<SVD_closest_rotation>(), direct);
#ifdef CGAL_ARAP_TEST_ALL // dear to compile
  swaps("Multifrontal_cholesky_solver, single precision",
        CGAL::ARAP_deformation_traits<Single_precision_solver>(), 1e-6);
#ifdef CGAL_LINKED_WITH_CHOLMOD
  swaps("Cholmod_solver", CGAL::ARAP_deformation_traits<Cholmod_solver>(), direct);
#endif
  swaps("CGAL::Deformation_Eigen_closest_rotation_traits_3",
        with_rotation<Closest_rotation_traits_adaptor<CGAL_svd>>(), direct);
  swaps("CGAL::Deformation_Eigen_polar_closest_rotation_traits_3",
        with_rotation<Closest_rotation_traits_adaptor<CGAL_polar>>(), direct);
#endif
}

// Each term of the energy has with each solver the iterates of the default one.
class Terms
{
public:
  template <typename Traits>
  void compare_with_default(const char* name, const Traits& traits)
  {
    const std::vector<Term_run> runs = term_runs(m_shape.diameter());
    for(std::size_t k = 0; k < runs.size(); ++k)
    {
      test_case() = name + (", " + runs[k].name);
      Mesh mesh = make_mesh<Mesh>(m_shape);
      CGAL::ARAP_deformation<Mesh, Traits> deformation(mesh, traits);
      const Result result = deform_with(deformation, all_vertices(mesh), m_scenario, runs[k]);
      if(k == m_default.size()) // of the first solver, which is the default
        m_default.push_back(result);
      else
        compare(m_default[k], result, m_shape.diameter(), 1e-9);
    }
  }

private:
  Shape m_shape = shapes()[5];
  Scenario m_scenario = scenario(m_shape);
  std::vector<Result> m_default;
};

void test_terms()
{
  Terms terms;
  terms.compare_with_default("default", CGAL::ARAP_deformation_traits<>());
  using LLT = Eigen::SimplicialLLT<Sparse_matrix>;
  terms.compare_with_default("Eigen_sparse_solver<SimplicialLLT>",
                             with_solver<Eigen_sparse_solver<LLT>>());
  terms.compare_with_default("Eigen_LDLT_solver", with_solver<Eigen_LDLT_solver>());
#if defined(CGAL_ARAP_TEST_ALL) && defined(CGAL_LINKED_WITH_CHOLMOD)
  terms.compare_with_default("Cholmod_solver", CGAL::ARAP_deformation_traits<Cholmod_solver>());
#endif
  terms.compare_with_default("CGAL's SparseLU",
                             with_solver<Sparse_linear_algebra_adaptor<CGAL_LU>>());
  terms.compare_with_default("CGAL's SimplicialLDLT",
                             with_solver<Sparse_linear_algebra_adaptor<CGAL_LDLT>>());
  terms.compare_with_default("Eigen_conjugate_gradient_solver",
                             with_solver<Eigen_conjugate_gradient_solver>());
}

} // namespace swaps

int main()
{
  conformance::test_all();
  swaps::test_all();
  swaps::test_terms();
  return checks_result();
}
