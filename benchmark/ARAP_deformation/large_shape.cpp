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

// One deformation of a large sheet, with a solver of one's choice: seconds and memory of each
// phase. With PETSc also under mpirun, where each rank tells its memory. Memory: on Linux only.
// usage: large_shape SOLVER VERTICES [ITERATIONS [TOLERANCE]]
//   SOLVER      default, single_precision, eigen_cg (with an incomplete Cholesky factorization),
//               petsc or petsc_cg
//   TOLERANCE   of conjugate gradients

#include "include/measure.h"
#include "include/memory.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Eigen_sparse_solver.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/Petsc_solver.h>
#include <CGAL/ARAP_deformation_traits.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace CGAL::ARAP;
using benchmark::megabytes;
using benchmark::reset_peak;
using Eigen_solver = Eigen_sparse_solver<
  Eigen::ConjugateGradient<Sparse_matrix, Eigen::Lower, Eigen::IncompleteCholesky<double>>>;

// Prints a line for each phase: its seconds, those of all its processors, the peak of memory, and
// what is left of it at its end.
class Phases
{
public:
  Phases() { begin(); }

  void begin()
  {
    m_stopwatch = {};
    m_clock = std::clock();
    reset_peak();
  }

  void end(const std::string& name)
  {
    const double seconds = m_stopwatch.seconds();
    m_peak = (std::max)(m_peak, megabytes("VmHWM"));
    std::printf("%-28s %8.2f s, %8.2f s of processors, %7.0f MB at its peak, %7.0f MB after it\n",
                name.c_str(), seconds, double(std::clock() - m_clock) / CLOCKS_PER_SEC,
                megabytes("VmHWM"), megabytes("VmRSS"));
    std::fflush(stdout);
    begin();
  }

  double peak() const { return m_peak; }

private:
  benchmark::Stopwatch m_stopwatch;
  std::clock_t m_clock = 0;
  double m_peak = 0;
};

// a solver that tells when it is called
template <typename Solver>
class Watched_solver
{
public:
  Watched_solver(Solver solver, Phases& phases) : m_solver(std::move(solver)), m_phases(&phases) {}

  bool analyze(const Sparse_matrix& a)
  {
    m_phases->end("region, weights, matrix");
    std::printf("%d rows, %.0f MB of matrix\n", int(a.rows()), 12e-6 * double(a.nonZeros()));
    const bool is_done = m_solver.analyze(a);
    m_phases->end("solver: analysis");
    return is_done;
  }

  bool factorize(const Sparse_matrix& a)
  {
    const bool is_done = m_solver.factorize(a);
    m_phases->end("solver: factor or levels");
    return is_done;
  }

  bool solve(std::size_t n, Coordinates* x)
  {
    if(m_number_of_solutions++ == 0)
      m_phases->end("the first local step");
    return m_solver.solve(n, x);
  }

private:
  Solver m_solver;
  int m_number_of_solutions = 0;
  Phases* m_phases;
};

using Triangle = std::array<int, 3>;

// a bumpy sheet in which each third column is narrower
void make_sheet(int side, std::vector<Coordinates>& points, std::vector<Triangle>& triangles)
{
  points.reserve(std::size_t(side) * std::size_t(side));
  triangles.reserve(2 * std::size_t(side - 1) * std::size_t(side - 1));
  const double h = 1.0 / (side - 1);
  for(int i = 0; i < side; ++i)
    for(int j = 0; j < side; ++j)
      points.push_back({i * h + 0.2 * h * (i % 3 == 1), j * h,
                        0.02 * std::sin(23 * i * h) * std::sin(17 * j * h)});
  for(int i = 0; i + 1 < side; ++i)
    for(int j = 0; j + 1 < side; ++j)
    {
      const int v = i * side + j;
      triangles.push_back({v, v + side, v + 1});
      triangles.push_back({v + 1, v + side, v + side + 1});
    }
}

template <typename Solver>
int run(const std::string& name, const Solver& solver, int side, unsigned iterations)
{
  Phases phases;
  std::vector<Coordinates> points;
  std::vector<Triangle> triangles;
  make_sheet(side, points, triangles);
  phases.end("points and triangles");

  using Domain = Polygon_soup_domain<std::vector<Coordinates>, std::vector<Triangle>>;
  using Traits = CGAL::ARAP_deformation_traits<Watched_solver<Solver>>;
  const Domain domain(points, triangles);
  phases.end("domain");
  CGAL::ARAP_deformation<Domain, Traits> deformation(
    domain, Traits(Watched_solver<Solver>(solver, phases)));
  Options options;
  options.iterations = iterations;
  options.tolerance = 0;
  options.minimizer = Minimizer::quasi_newton;
  options.initial_guess = Initial_guess::previous;
  if(const Outcome outcome = deformation.set_options(options); !outcome)
    return std::cerr << "large_shape: " << outcome.message << '\n', EXIT_FAILURE;
  const std::size_t n = points.size();
  for(std::size_t v = std::size_t(side); v < n; ++v) // the first column is fixed
    deformation.insert_roi_vertex(v);
  for(std::size_t v = n - std::size_t(side); v < n; ++v)
    deformation.insert_control_vertex(v, {points[v][0] - 0.1, points[v][1], points[v][2] + 0.2});
  phases.end("region of interest, targets");
  const Report report = deformation.deform();
  phases.end("iterations");
  if(!report)
    return std::cerr << "large_shape: " << report.message << '\n', EXIT_FAILURE;
  std::printf("%s: %zu vertices, %s\n", name.c_str(), n, report.message.c_str());
  std::printf("preprocess %.2f s; an iteration: local step %.3f s, global step %.3f s\n",
              report.seconds.preprocess, report.seconds.local_steps / (report.iterations + 1),
              report.seconds.global_steps / report.iterations);
  std::printf("energies");
  for(double energy : report.energy)
    std::printf(" %.12g", energy);
  std::printf("\nrank 0: %.0f MB at its peak, %.0f bytes a vertex\n", phases.peak(),
              1e6 * phases.peak() / double(n));
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char** argv)
{
  const std::string name = argc > 1 ? argv[1] : "";
  const double vertices = argc > 2 ? std::atof(argv[2]) : 0;
  const int iterations = argc > 3 ? std::atoi(argv[3]) : 5;
  const double tolerance = argc > 4 ? std::atof(argv[4]) : 1e-2;
  if(!(vertices >= 9 && vertices <= 2e9) || iterations < 1 || !(tolerance > 0)) // indices are int
    return std::cerr << "usage: large_shape SOLVER VERTICES [ITERATIONS [TOLERANCE]]\n", 2;
  const int side = static_cast<int>(std::lround(std::sqrt(vertices)));
  const auto run_with = [&](const auto& solver) {
    return run(name, solver, side, static_cast<unsigned>(iterations));
  };
  if(name == "default")
    return run_with(Multifrontal_cholesky_solver());
  if(name == "single_precision")
    return run_with(Multifrontal_cholesky_solver(Factor_precision::single_precision));
  if(name == "eigen_cg")
    return run_with(Eigen_solver([tolerance](auto& solver) { solver.setTolerance(tolerance); }));
#ifdef CGAL_LINKED_WITH_PETSC
  if(name == "petsc" || name == "petsc_cg")
  {
    const Petsc_environment petsc;
    if(petsc.serve())
    {
      std::printf("another rank: %.0f MB at its peak\n", megabytes("VmHWM"));
      return EXIT_SUCCESS;
    }
    return run_with(name == "petsc"
      ? Petsc_solver(petsc) : Petsc_solver(petsc, Petsc_method::conjugate_gradients, tolerance));
  }
#endif
  std::cerr << "large_shape: there is no solver " << name << '\n';
  return 2;
}
