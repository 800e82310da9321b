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

// The coarse metric of quasi-Newton runs: its deformations, and its matrix against the second
// derivative of the energy. test_large_runs has runs with it.

#include "include/check.h"
#include "include/domains.h"
#include "include/problem.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_matrix.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_transfer.h>
#include <CGAL/ARAP_deformation/internal/minimizer/dot_product.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace coarse {

using namespace problem;

Array<Coordinates> random_vectors(std::size_t n, Random& random)
{
  Array<Coordinates> result(n);
  for(Coordinates& p : result)
    p = random();
  return result;
}

// Weights are positive and add up to one. Nodes that move together as one body move all vertices
// so, and P^T is the transpose of P.
void test_transfer(const Region& region)
{
  test_case() = "transfer";
  Problem problem(region, Energy_model(), 0.01);
  problem.minimization();
  const Coarse_space space(problem.system.laplacian().matrix);
  const int n = space.number_of_vertices(), m = space.number_of_nodes();
  CHECK(m > 3);
  for(int v = 0; v < n; ++v)
  {
    double sum = 0;
    for(int k = 0; k < Coarse_space::most_nodes; ++k)
    {
      CHECK(space.weights(v)[k] >= 0 && space.nodes(v)[k] >= 0 && space.nodes(v)[k] < m);
      sum += space.weights(v)[k];
    }
    CHECK_AT_MOST(std::abs(sum - 1), 1e-6);
  }
  for(int node = 0; node < m; ++node)
    CHECK(space.nodes(space.vertex_of(node))[0] == node);

  Coarse_transfer transfer(space);
  Random random;
  Array<Coordinates> u = random_vectors(2 * static_cast<std::size_t>(m), random);
  Array<Coordinates> step(static_cast<std::size_t>(n), Coordinates{0, 0, 0}),
                           force = random_vectors(step.size(), random);
  for(const bool has_fixed : {false, true})
  {
    Array<char> is_fixed(n, false);
    if(has_fixed) // a node among them
      for(int v = 0; v < n; v += 1 + v % 7)
        is_fixed[v] = true;
    transfer.place(is_fixed, problem.x);
    for(int node = 0; node < m; ++node)
      if(transfer.is_fixed(node))
        u[2 * static_cast<std::size_t>(node)] = u[2 * static_cast<std::size_t>(node) + 1] = {};
    std::fill(step.begin(), step.end(), Coordinates{0, 0, 0});
    transfer.add_prolonged(u, step);
    for(int v = 0; v < n; ++v)
      if(is_fixed[v])
      {
        CHECK((step[static_cast<std::size_t>(v)] == Coordinates{0, 0, 0}));
        force[static_cast<std::size_t>(v)] = {0, 0, 0};
      }
    const double expected = dot_product(force, step);
    CHECK_AT_MOST(std::abs(dot_product(transfer.restricted(force), u) - expected),
                  1e-11 * dot_product(u, u));
    if(has_fixed)
      continue;
    const Coordinates translation = random(), rotation = random();
    for(int node = 0; node < m; ++node)
    {
      const Coordinates& y = problem.x[static_cast<std::size_t>(space.vertex_of(node))];
      u[2 * static_cast<std::size_t>(node)] = cross(rotation, y);
      add(u[2 * static_cast<std::size_t>(node)], 1, translation);
      u[2 * static_cast<std::size_t>(node) + 1] = rotation;
    }
    std::fill(step.begin(), step.end(), Coordinates{0, 0, 0});
    transfer.add_prolonged(u, step);
    for(std::size_t v = 0; v < step.size(); ++v)
    {
      Coordinates expected_step = cross(rotation, problem.x[v]);
      add(expected_step, 1, translation);
      const Coordinates error = difference(step[v], expected_step);
      CHECK_AT_MOST(std::sqrt(dot(error, error)), 1e-5);
    }
  }
}

double quadratic_form(const CGAL::ARAP::Sparse_matrix& c, const Array<Coordinates>& u)
{
  const auto size = static_cast<Eigen::Index>(3 * u.size());
  const Eigen::Map<const Eigen::VectorXd> vector(u.data()->data(), size);
  return vector.dot(c.selfadjointView<Eigen::Lower>() * vector);
}

// In the rest shape, turned or not, the matrix is the second derivative of the energy on the coarse
// deformations, with every cell scheme and term. Anywhere else it is definite.
template <typename Simplices>
void test_matrix(const std::string& name, const std::vector<Eigen::Vector3d>& points,
                 const Simplices& simplices)
{
  const Region region = region_of(points, simplices);
  const int terms = 6;
  for(const Cell_scheme& cells : {Cell_scheme::spokes(), Cell_scheme::k_ring(1),
                                  Cell_scheme::spokes_and_rims(), Cell_scheme::elements()})
    for(int chosen = 0; chosen <= terms; ++chosen)
    {
      test_case() = "matrix, " + name + ", " + std::to_string(chosen);
      const auto has = [chosen](int term) { return chosen == term || chosen == terms; };
      Energy_model model;
      model.cells = cells;
      const std::size_t number_of_cells =
        cells.has_vertex_cells() ? points.size() : simplices.size();
      if(has(1) && cells.has_vertex_cells())
        model.bending_length = 0.3;
      for(std::size_t c = 0; c < number_of_cells && has(2); ++c)
        model.stiffness.push_back(0.2 + static_cast<double>(c % 3));
      for(std::size_t c = 0; c < number_of_cells && has(3); ++c)
        model.group.push_back(c % 4 == 0 && c < 40 ? 0 : -1);
      Problem problem(region, model, 0.01);
      const Array<Coordinates> deformed = problem.x;
      const Matrix_3x3 rotation =
        chosen % 2 == 0 ? identity_matrix() : rotation_of_vector({0.3, -1, 0.5});
      for(std::size_t v = 0; v < points.size(); ++v)
        problem.x[v] = product(rotation, region.rest[v]);
      if(has(4))
        problem.energy.set_given_rotations({{3, rotation}, {4, rotation}});
      if(has(5))
      {
        for(int k = 1; k < 4; ++k)
          problem.constraints.rows.append(k, 0.7);
        const int* const corners = region.corners_of(5);
        problem.constraints.rows.append({corners[0], corners[1]}, {0.4, 0.6}, 2);
        problem.targets.soft.assign(4, Coordinates{0, 0, 0});
      }
      Minimization run = problem.minimization();
      const CGAL::ARAP::Sparse_matrix matrix =
        problem.system.with_rows(problem.constraints.rows);
      Coarse_transfer transfer{Coarse_space(problem.system.laplacian().matrix)};
      Coarse_matrix coarse(transfer, problem.energy, problem.system.laplacian().matrix);
      run.evaluate();
      transfer.place(problem.constraints.is_fixed, problem.x);
      CHECK(coarse.build(transfer, problem.energy, matrix, problem.rotations));
      run.prepare_second_derivative();
      Random random;
      for(int k = 0; k < 3; ++k)
      {
        const auto m = static_cast<std::size_t>(transfer.space().number_of_nodes());
        Array<Coordinates> u = random_vectors(2 * m, random);
        for(std::size_t node = 0; node < m; ++node)
          if(transfer.is_fixed(static_cast<int>(node)))
            u[2 * node] = u[2 * node + 1] = {0, 0, 0};
        Array<Coordinates> step(points.size(), Coordinates{0, 0, 0}), change;
        transfer.add_prolonged(u, step);
        run.change_of_force(step, change);
        const double expected = -dot_product(step, change);
        CHECK(expected > 0);
        CHECK_AT_MOST(std::abs(quadratic_form(coarse.matrix(), u) / expected - 1), 1e-4);
      }
      run.clear_second_derivative();

      run.x = deformed;
      run.evaluate();
      for(Matrix_3x3& r : problem.rotations)
        r = product(rotation_of_vector(random()), r);
      transfer.place(problem.constraints.is_fixed, deformed);
      CHECK(coarse.build(transfer, problem.energy, matrix, problem.rotations));
      Array<Coordinates> u =
        random_vectors(2 * static_cast<std::size_t>(transfer.space().number_of_nodes()), random);
      CHECK(coarse.solve(u) && std::all_of(u.begin(), u.end(), [](const Coordinates& p) {
        return is_finite(p);
      }));
    }
}

} // namespace coarse

int main()
{
  const Shape sheet = grid("sheet", 32, 26, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0.4 * u * v + 0.2 * u * u);
  });
  const Block bar = block(13, 6, 6);
  coarse::test_transfer(problem::region_of(sheet.points, sheet.triangles));
  coarse::test_matrix("sheet", sheet.points, sheet.triangles);
  coarse::test_matrix("bar", bar.points, bar.tetrahedra);
  return checks_result();
}
