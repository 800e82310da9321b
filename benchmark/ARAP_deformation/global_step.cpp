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

// The global step compared with its lower bound, the time to read the factor twice from memory, and
// with the solves of other libraries for the same matrices.

#include "include/deformations.h"
#include "include/run_benchmark.h"
#include "include/star_energy.h"
#include "include/streaming.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

namespace {

using namespace benchmark;

using Matrix = ARAP::Sparse_matrix;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

const std::size_t bytes_in_memory = std::size_t(256) << 20; // larger than the caches

// the cost of one solver for a right-hand side of three columns
struct Solve
{
  std::string name;
  double factor_bytes = 0, seconds = 0;
};

// fails unless A x = b
void verify_solution(const Matrix& a, const Columns& x, const Columns& b, const std::string& name)
{
  const Columns residual = a.selfadjointView<Eigen::Lower>() * x - b;
  verify_at_most(residual.norm() / b.norm(), 1e-8, "the relative residual of " + name);
}

double least_seconds(const Settings& settings) { return settings.quick ? 0.2 : 1; }

using Row_by_row = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

std::vector<ARAP::Coordinates> rows_of(const Columns& columns)
{
  std::vector<ARAP::Coordinates> rows(static_cast<std::size_t>(columns.rows()));
  Eigen::Map<Row_by_row>(rows.data()->data(), columns.rows(), 3) = columns;
  return rows;
}

Columns columns_of(const std::vector<ARAP::Coordinates>& rows)
{
  return Eigen::Map<const Row_by_row>(rows.data()->data(), static_cast<Eigen::Index>(rows.size()),
                                      3);
}

// refines the solution, as the minimizers do with the residual of single precision
template <typename Solver>
void refine(Solver& solver, const Matrix& a, const Columns& b, Columns& x)
{
  for(int k = 0; k < 4; ++k)
  {
    std::vector<ARAP::Coordinates> step = rows_of(b - a.selfadjointView<Eigen::Lower>() * x);
    solver.solve(step.size(), step.data());
    x += columns_of(step);
  }
}

template <typename Solver>
Solve measure_ours(const std::string& name, Solver solver, const Matrix& a, const Columns& b,
                   const Settings& settings)
{
  if(!solver.analyze(a) || !solver.factorize(a))
    throw Failure(name + " did not factorize the matrix");
  const std::vector<ARAP::Coordinates> right_hand_side = rows_of(b);
  std::vector<ARAP::Coordinates> x;
  const double seconds = median_seconds(least_seconds(settings), 5,
                                        [&] { x = right_hand_side; },
                                        [&] { solver.solve(x.size(), x.data()); });
  Columns solution = columns_of(x);
  if constexpr(std::is_same_v<Solver, Single_precision_solver>)
    refine(solver, a, b, solution);
  verify_solution(a, solution, b, name);
  return {name, static_cast<double>(solver.factor_bytes()), seconds};
}

Solve measure_eigen(const Matrix& a, const Columns& b, const Settings& settings)
{
  const Eigen::SimplicialLDLT<Matrix> cholesky(a);
  Columns x;
  const double seconds = median_seconds(least_seconds(settings), 3, [] {},
                                        [&] { x = cholesky.solve(b); });
  verify_solution(a, x, b, "Eigen");
  const double non_zeros = static_cast<double>(cholesky.matrixL().nestedExpression().nonZeros());
  return {"Eigen LDLT", non_zeros * (sizeof(double) + sizeof(int)), seconds};
}

#ifdef CGAL_LINKED_WITH_CHOLMOD
Solve measure_cholmod(int supernodal, const std::string& name, const Matrix& a, const Columns& b,
                      const Settings& settings)
{
  cholmod_common common;
  cholmod_start(&common);
  common.supernodal = supernodal;
  cholmod_sparse matrix = {};
  matrix.nrow = matrix.ncol = static_cast<std::size_t>(a.rows());
  matrix.nzmax = static_cast<std::size_t>(a.nonZeros());
  matrix.p = const_cast<int*>(a.outerIndexPtr());
  matrix.i = const_cast<int*>(a.innerIndexPtr());
  matrix.x = const_cast<double*>(a.valuePtr());
  matrix.stype = -1; // the lower triangle
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_REAL;
  matrix.sorted = matrix.packed = 1;
  const auto check = [&](bool is_done) {
    if(!is_done || common.status != CHOLMOD_OK)
      throw Failure(name + " did not solve the system");
  };
  cholmod_factor* factor = cholmod_analyze(&matrix, &common);
  check(factor != nullptr);
  check(cholmod_factorize(&matrix, factor, &common));
  const double bytes = factor->is_super
    ? double(sizeof(double)) * double(factor->xsize) + double(sizeof(int)) * double(factor->ssize)
    : common.lnz * (sizeof(double) + sizeof(int));

  Columns x = b;
  cholmod_dense right_hand_side = {};
  right_hand_side.nrow = right_hand_side.d = matrix.nrow;
  right_hand_side.ncol = 3;
  right_hand_side.nzmax = 3 * matrix.nrow;
  right_hand_side.xtype = CHOLMOD_REAL;
  right_hand_side.x = const_cast<double*>(b.data());
  cholmod_dense *solution = nullptr, *first = nullptr, *second = nullptr;
  const double seconds = median_seconds(least_seconds(settings), 3, [] {}, [&] {
    check(cholmod_solve2(CHOLMOD_A, factor, &right_hand_side, nullptr, &solution, nullptr, &first,
                         &second, &common));
  });
  std::copy_n(static_cast<const double*>(solution->x), x.size(), x.data());
  cholmod_free_dense(&solution, &common);
  cholmod_free_dense(&first, &common);
  cholmod_free_dense(&second, &common);
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  verify_solution(a, x, b, name);
  return {name, bytes, seconds};
}
#endif

Json run(const Settings& settings)
{
  Json section = make_section(
    "The global step and the memory",
    "Milliseconds of one solve with three columns, in single precision without refinement, and of "
    "reading the factor twice from memory.",
    {{"free_vertices", "free vertices"}, {"solver", "solver"}, {"threads", "threads"},
     {"factor_mb", "factor [MB]"}, {"solve_ms", "solve"}, {"streaming_ms", "reading it twice"},
     {"ratio", "solve / reading"}, {"gb_per_second", "GB/s"}});

  std::vector<double> bandwidth; // from memory, with one thread and with all
  for(unsigned int threads : thread_counts())
  {
    Json curve = Json::array();
    for(std::size_t bytes = std::size_t(1) << 20; bytes <= bytes_in_memory; bytes *= 2)
      curve.push_back({static_cast<double>(bytes) / 1e6,
                       streaming_bandwidth(bytes, threads) / 1e9});
    bandwidth.push_back(curve.back()[1].get<double>() * 1e9);
    section["streaming_of_" + std::to_string(threads)] = curve;
  }

  const Mesh mesh = read_mesh(settings.file_or("armadillo.off"));
  for(unsigned int parts : settings.quick ? std::vector<unsigned int>{1, 2}
                                          : std::vector<unsigned int>{1, 2, 3, 4, 6})
  {
    const Matrix a = Star_energy(make_scenario(subdivided(mesh, parts))).matrix();
    const Columns b = Columns::Random(a.rows(), 3);
    const auto add = [&](const Solve& solve, std::size_t which, unsigned int threads) {
      const double streaming = 2 * solve.factor_bytes / bandwidth[which];
      section["rows"].push_back({{"free_vertices", a.rows()},
                                 {"solver", solve.name},
                                 {"threads", threads},
                                 {"factor_mb", solve.factor_bytes / 1e6},
                                 {"solve_ms", 1e3 * solve.seconds},
                                 {"streaming_ms", 1e3 * streaming},
                                 {"ratio", solve.seconds / streaming},
                                 {"gb_per_second", 2e-9 * solve.factor_bytes / solve.seconds}});
    };
    const std::vector<unsigned int> counts = thread_counts();
    for(std::size_t which = 0; which < counts.size(); ++which)
    {
      const Thread_limit limit(counts[which]);
      for_each_solver<Clamped_angle_weight>([&](const auto& traits, const std::string& name) {
        const auto solver = traits.sparse_solver_object();
        if constexpr(!std::is_same_v<std::decay_t<decltype(solver)>, ARAP::Eigen_LDLT_solver>)
          add(measure_ours("ours, " + name, solver, a, b, settings), which, counts[which]);
      });
    }
    add(measure_eigen(a, b, settings), 0, 1);
#ifdef CGAL_LINKED_WITH_CHOLMOD
    add(measure_cholmod(CHOLMOD_SIMPLICIAL, "CHOLMOD simplicial", a, b, settings), 0, 1);
    add(measure_cholmod(CHOLMOD_SUPERNODAL, "CHOLMOD supernodal", a, b, settings), 0, 1);
#endif
  }
  return section;
}

} // namespace

int main(int argc, char** argv)
{
  return run_benchmark(argc, argv, "global_step",
                       "usage: global_step [options]\n\n"
                       "Compares the time of a solve with that of reading the factor twice.", run,
                       {"mesh"});
}
