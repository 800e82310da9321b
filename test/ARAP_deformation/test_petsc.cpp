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

// PETSc's solvers: conformance, deformations as with the default solver, several at a time; and the
// command. With one process, and with several under mpirun.
// usage: test_petsc [PATH_OF_ARAP_DEFORM [MPIEXEC ARGUMENT...]]
//   with arguments only the command is tested, alone and after MPIEXEC ARGUMENT...

#include "include/command.h"
#include "include/domains.h"
#include "include/term_runs.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Petsc_solver.h>
#include <CGAL/ARAP_deformation/conformance/check_sparse_solver.h>
#include <CGAL/ARAP_deformation_traits.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using namespace CGAL::ARAP;

Sparse_matrix two_by_two(double diagonal, double off_diagonal)
{
  Sparse_matrix a(2, 2);
  a.insert(0, 0) = diagonal;
  a.insert(1, 0) = off_diagonal;
  a.insert(1, 1) = diagonal;
  a.makeCompressed();
  return a;
}

// whether there is a solution, and it is right
bool solves(Petsc_solver& solver, const Sparse_matrix& a)
{
  Coordinates x[2] = {{1, 2, 3}, {4, 5, 6}};
  return solver.solve(2, x) &&
         std::abs(a.coeff(0, 0) * x[0][2] + a.coeff(1, 0) * x[1][2] - 3) < 1e-9 &&
         std::abs(a.coeff(1, 0) * x[0][1] + a.coeff(1, 1) * x[1][1] - 5) < 1e-9;
}

void test_solvers(const Petsc_environment& petsc)
{
  for(Petsc_method method : {Petsc_method::cholesky, Petsc_method::conjugate_gradients})
  {
    test_case() = method == Petsc_method::cholesky ? "Cholesky" : "conjugate gradients";
    const Petsc_solver prototype(petsc, method, 1e-13);
    CHECK_CONFORMS(check_sparse_solver(prototype));
    Petsc_solver solver(prototype);
    CHECK(solver.analyze(two_by_two(1, 0.5)));
    for(const auto& [diagonal, off_diagonal] :
        {std::pair(1.0, 2.0), std::pair(-1.0, 0.5), std::pair(0.0, 1.0),
         std::pair(1.0, std::numeric_limits<double>::quiet_NaN()),
         std::pair(std::numeric_limits<double>::infinity(), 0.5)})
    {
      const Sparse_matrix wrong = two_by_two(diagonal, off_diagonal), good = two_by_two(1, 0.5);
      Coordinates x[2] = {{1, 2, 3}, {4, 5, 6}};
      const bool is_solved = solver.factorize(wrong) && solver.solve(2, x);
      // in two steps conjugate gradients may solve what is not positive definite
      CHECK(!is_solved || (method != Petsc_method::cholesky && solves(solver, wrong)));
      CHECK(solver.factorize(good) && solves(solver, good)); // a failure is not the end
    }
    // several, in any order of their lives
    std::vector<Sparse_matrix> matrices;
    std::vector<Petsc_solver> several(5, prototype);
    for(std::size_t k = 0; k < several.size(); ++k)
    {
      matrices.push_back(two_by_two(1 + double(k), 0.25 * double(k)));
      CHECK(several[k].analyze(matrices[k]) && several[k].factorize(matrices[k]));
    }
    for(std::size_t k : {1, 1, 0})
    {
      several.erase(several.begin() + std::ptrdiff_t(k));
      matrices.erase(matrices.begin() + std::ptrdiff_t(k));
      for(std::size_t l = 0; l < several.size(); ++l)
        CHECK(solves(several[l], matrices[l]));
    }
  }
}

// the iterates of the default solver, with all terms of the energy
void test_deformations(const Petsc_environment& petsc)
{
  using Traits = CGAL::ARAP_deformation_traits<Petsc_solver>;
  const Shape shape = shapes()[5];
  const Scenario s = scenario(shape);
  const auto deformed = [&](const auto& traits, const Term_run& run) {
    Mesh mesh = make_mesh<Mesh>(shape);
    CGAL::ARAP_deformation<Mesh, std::decay_t<decltype(traits)>> deformation(mesh, traits);
    return deform_with(deformation, all_vertices(mesh), s, run);
  };
  const Petsc_solver cholesky(petsc), loose(petsc, Petsc_method::conjugate_gradients);
  const std::vector<Term_run> runs = term_runs(shape.diameter());
  // with several processes that wait for each other only some
  const std::size_t step = petsc.number_of_ranks() == 1 ? 1 : 7;
  for(std::size_t k = 0; k < runs.size(); k += step)
  {
    Term_run run = runs[k];
    test_case() = run.name;
    compare(deformed(CGAL::ARAP_deformation_traits<>(), run), deformed(Traits(cholesky), run),
            shape.diameter(), 1e-9);
    // another way to the same minimum, on which the energy never rises either
    run.options.minimizer = Minimizer::quasi_newton;
    const double energy = deformed(CGAL::ARAP_deformation_traits<>(), run).energy.back();
    const double its_energy = deformed(Traits(loose), run).energy.back();
    CHECK_AT_MOST(std::abs(its_energy - energy), 0.05 * energy);
  }
}

// The energies and points of the command with each solver and number of processes.
void test_the_command(const std::string& mpiexec)
{
  std::ostringstream mesh;
  const int side = 40;
  mesh << "OFF\n" << side * side << ' ' << 2 * (side - 1) * (side - 1) << " 0\n";
  for(int i = 0; i < side; ++i)
    for(int j = 0; j < side; ++j)
      mesh << i << ' ' << j << ' ' << i * j % 3 << '\n';
  for(int i = 0; i + 1 < side; ++i)
    for(int j = 0; j + 1 < side; ++j)
      mesh << "3 " << side * i + j << ' ' << side * (i + 1) + j << ' ' << side * i + j + 1 << '\n'
           << "3 " << side * i + j + 1 << ' ' << side * (i + 1) + j << ' '
           << side * (i + 1) + j + 1 << '\n';
  write("sheet.off", mesh.str());
  const auto deformed = [&](const std::string& processes, const std::string& options) {
    test_case() = processes + options;
    const Run done = run_line(processes + " \"" + command + "\" sheet.off -o out.off --fix x:..3 "
                              "--handle x:36.. --rotate x 50 --move -4,0,6 --quiet " + options);
    if(!CHECK(done.exit_code == 0))
      std::cerr << done.err;
    std::istringstream in(content(folder / "out.off"));
    std::string word;
    in >> word >> word >> word >> word;
    std::vector<Eigen::Vector3d> points(side * side);
    for(auto& p : points)
      CHECK(in >> p[0] >> p[1] >> p[2]);
    fs::remove(folder / "out.off");
    return points;
  };
  const auto compare_with = [&](const std::vector<Eigen::Vector3d>& expected,
                                const std::string& options, double bound) {
    for(const std::string& processes : {std::string(), mpiexec})
    {
      const auto points = deformed(processes, options);
      double largest = 0;
      for(std::size_t v = 0; v < points.size(); ++v)
        largest = larger(largest, (points[v] - expected[v]).norm());
      CHECK_AT_MOST(largest, bound * side);
    }
  };
  const std::string few = "--iterations 10 --tolerance 0",
                    all = "--iterations 500 --tolerance 1e-9";
  compare_with(deformed("", few), few + " --solver petsc", 1e-8);
  compare_with(deformed("", all), all + " --solver petsc_cg", 1e-3);
  test_case() = "an error of rank 0 ends all";
  const Run failed = run_line(mpiexec + " \"" + command + "\" missing.off -o out.off --fix x:..3 "
                              "--handle x:36.. --move 1,0,0 --solver petsc");
  CHECK(failed.exit_code != 0);
  CHECK(failed.err.find("arap_deform: missing.off") != std::string::npos);
}

} // namespace

int main(int argc, char** argv)
{
  if(argc > 1)
  {
    std::string mpiexec;
    for(int k = 2; k < argc; ++k)
      mpiexec += std::string(" \"") + argv[k] + '"';
    return test_command(argc, argv, {[&] { test_the_command(mpiexec); }});
  }
  std::optional<Petsc_environment> petsc(std::in_place);
  if(petsc->serve())
    return EXIT_SUCCESS;
  std::cout << petsc->number_of_ranks() << " processes\n";
  test_solvers(*petsc);
  test_deformations(*petsc);
  // the last solver ends what the environment has started
  Petsc_solver solver(*petsc);
  petsc.reset();
  const Sparse_matrix a = two_by_two(2, 1);
  CHECK(solver.analyze(a) && solver.factorize(a) && solves(solver, a));
  return checks_result();
}
