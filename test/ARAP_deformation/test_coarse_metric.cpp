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
// derivative of the energy; the coarse surface that a run starts with. test_large_runs has runs
// with both.

#include "include/check.h"
#include "include/domains.h"
#include "include/length.h"
#include "include/problem.h"
#include "include/shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_matrix.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_metric.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_region.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_transfer.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Harmonic_rotations.h>
#include <CGAL/ARAP_deformation/internal/minimizer/torn_parts.h>
#include <CGAL/ARAP_deformation/internal/region/dot_product.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <set>
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
// so, also far from the origin, and P^T is the transpose of P.
void test_transfer(const Region& region, double distance)
{
  test_case() = "transfer";
  Problem problem(region, Energy_model(), 0.01);
  problem.minimization();
  const Coarse_space space(problem.system.laplacian().matrix, problem.region.rest);
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
  enum Fixed { none, some, far_away }; // some: a node among them
  for(const Fixed fixed : {none, some, far_away})
  {
    Array<Coordinates> x = problem.x;
    for(Coordinates& p : x)
      p[1] += distance;
    Array<char> is_fixed(n, false);
    for(int v = 0; fixed == some && v < n; v += 1 + v % 7)
      is_fixed[v] = true;
    if(fixed == far_away)
    {
      is_fixed[0] = true;
      x[0] = {1e39, -2e39, 3e39};
    }
    transfer.place(is_fixed, x);
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
    if(fixed == some)
      continue;
    const Coordinates translation = random(), rotation = random();
    for(int node = 0; node < m; ++node)
    {
      if(transfer.is_fixed(node))
        continue;
      const Coordinates& y = problem.x[static_cast<std::size_t>(space.vertex_of(node))];
      u[2 * static_cast<std::size_t>(node)] = cross(rotation, y);
      add(u[2 * static_cast<std::size_t>(node)], 1, translation);
      u[2 * static_cast<std::size_t>(node) + 1] = rotation;
    }
    std::fill(step.begin(), step.end(), Coordinates{0, 0, 0});
    transfer.add_prolonged(u, step);
    for(std::size_t v = 0; v < step.size(); ++v)
    {
      const int* const nodes = space.nodes(static_cast<int>(v));
      if(std::any_of(nodes, nodes + Coarse_space::most_nodes,
                     [&](int node) { return transfer.is_fixed(node); }))
        continue;
      Coordinates expected_step = cross(rotation, problem.x[v]);
      add(expected_step, 1, translation);
      const Coordinates error = difference(step[v], expected_step);
      CHECK_AT_MOST(std::sqrt(dot(error, error)), 1e-5);
    }
  }
}

Eigen::Map<const Eigen::VectorXd> as_vector(const Array<Coordinates>& u)
{
  return {u.data()->data(), static_cast<Eigen::Index>(3 * u.size())};
}

double quadratic_form(const CGAL::ARAP::Sparse_matrix& c, const Array<Coordinates>& u)
{
  return as_vector(u).dot(c.selfadjointView<Eigen::Lower>() * as_vector(u));
}

// how well u solves C u = b
double residual(const CGAL::ARAP::Sparse_matrix& c, const Array<Coordinates>& u,
                const Array<Coordinates>& b)
{
  return (c.selfadjointView<Eigen::Lower>() * as_vector(u) - as_vector(b)).norm() /
         as_vector(b).norm();
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
        const Index_range corners = region.corners_of(5);
        problem.constraints.rows.append({corners[0], corners[1]}, {0.4, 0.6}, 2);
        problem.targets.soft.assign(4, Coordinates{0, 0, 0});
      }
      Minimization run = problem.minimization();
      const CGAL::ARAP::Sparse_matrix matrix =
        problem.system.with_rows(problem.constraints.rows);
      Coarse_transfer transfer{Coarse_space(problem.system.laplacian().matrix,
                                            problem.region.rest)};
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
      const Array<Coordinates> b =
        random_vectors(2 * static_cast<std::size_t>(transfer.space().number_of_nodes()), random);
      Array<Coordinates> u = b;
      CHECK(coarse.solve(u));
      CHECK_AT_MOST(residual(coarse.matrix(), u, b), 1e-9);
    }
}

// whether there is a coarse metric for a surface with this noise
bool has_coarse_metric(const std::vector<Eigen::Vector3d>& points,
                       const std::vector<std::array<std::size_t, 3>>& triangles, double noise)
{
  Problem problem(problem::region_of(points, triangles), Energy_model(), noise);
  Minimization run = problem.minimization();
  run.evaluate();
  const CGAL::ARAP::Sparse_matrix& laplacian = problem.system.laplacian().matrix;
  Coarse_metric metric(problem.energy, laplacian, problem.region.rest);
  return metric.is_of_use() && metric.build(problem.energy, laplacian,
                                            problem.constraints.is_fixed, problem.x,
                                            problem.rotations);
}

// Where a vertex has so many neighbors that it couples hundreds of nodes there is no matrix: it
// would be dense.
void test_fan()
{
  for(const std::size_t n : {2000, 40000})
  {
    test_case() = "fan of " + std::to_string(n);
    std::vector<Eigen::Vector3d> points(1, {0, 0, 1});
    std::vector<std::array<std::size_t, 3>> triangles;
    for(std::size_t k = 0; k < n; ++k)
    {
      const double angle = 2 * std::acos(-1.0) * double(k) / double(n);
      points.emplace_back(std::cos(angle), std::sin(angle), 0);
      triangles.push_back({0, k + 1, (k + 1) % n + 1});
    }
    CHECK(has_coarse_metric(points, triangles, 0) == (n == 2000));
  }
}

// A vertex with many neighbors does not make balls around these take longer: that took hundreds of
// times as long as in a sheet.
void test_hub()
{
  test_case() = "a hub";
  const int side = 400, n = side * side;
  const auto seconds = [](int size, const auto& for_each_edge) {
    const Index_lists graph = CGAL::ARAP::internal::lists_of_pairs(size, [&](const auto& f) {
      for_each_edge([&](int v, int w) {
        f(v, w);
        f(w, v);
      });
    });
    Array<Coordinates> points;
    for(int v = 0; v < size; ++v)
      points.push_back({double(v == 0 ? size : v), 0, 0}); // the hub comes last
    const auto begin = std::chrono::steady_clock::now();
    const Coarse_space space(graph, points, Array<char>(points.size(), false), 12);
    const std::chrono::duration<double> result = std::chrono::steady_clock::now() - begin;
    CHECK(space.number_of_nodes() > size / 20 && space.number_of_nodes() < size / 2);
    return result.count();
  };
  const double of_sheet = seconds(n, [&](const auto& f) {
    for(int v = 0; v < n; ++v)
    {
      if((v + 1) % side != 0)
        f(v, v + 1);
      if(v + side < n)
        f(v, v + side);
    }
  });
  const double of_fan = seconds(n, [&](const auto& f) {
    for(int v = 1; v < n; ++v)
    {
      f(0, v);
      f(v, v % (n - 1) + 1);
    }
  });
  CHECK_AT_MOST(of_fan / of_sheet, 20);
}

// Where there would be about as many nodes as vertices, as in small parts, there is no matrix.
void test_small_parts()
{
  for(const int side : {4, 12})
  {
    test_case() = "parts with sides of " + std::to_string(side);
    const Shape part = grid("part", side, side, [](double u, double v) {
      return Eigen::Vector3d(u, v, 0.1 * u * v);
    });
    Shape parts = part;
    for(int k = 1; k < 30; ++k)
    {
      for(const auto& [a, b, c] : part.triangles)
        parts.triangles.push_back({a + parts.points.size(), b + parts.points.size(),
                                   c + parts.points.size()});
      for(const Eigen::Vector3d& p : part.points)
        parts.points.emplace_back(p + Eigen::Vector3d(2 * k, 0, 0));
    }
    CHECK(has_coarse_metric(parts.points, parts.triangles, 0.01) == (side == 12));
  }
}

// An isolated vertex takes no part, wherever it is.
void test_far_isolated_vertex(const Shape& sheet)
{
  test_case() = "an isolated vertex far away";
  std::vector<Eigen::Vector3d> points = sheet.points;
  points.emplace_back(1e39, -1e39, 2e39);
  Problem problem(problem::region_of(points, sheet.triangles), Energy_model(), 0);
  problem.constraints.is_fixed.front() = false; // at the node that it would disturb
  problem.constraints.is_fixed.back() = true;
  problem.minimization();
  const Coarse_space space(problem.system.laplacian().matrix, problem.region.rest);
  Coarse_transfer transfer(space);
  transfer.place(problem.constraints.is_fixed, problem.x);
  Random random;
  Array<Coordinates> force = random_vectors(points.size(), random);
  force.back() = {0, 0, 0};
  for(const Coordinates& f : transfer.restricted(force))
    CHECK(CGAL::ARAP::internal::is_finite(f));
}

Array<char> fixed_vertices(const Region& region)
{
  Array<char> result;
  for(const Coordinates& p : region.rest)
    result.push_back(p[0] > 0.8);
  return result;
}

Coarse_region coarse_region(const Region& fine, const Array<char>& is_fixed)
{
  return Coarse_region(fine, is_fixed, find_free_neighborhood(fine, is_fixed).is_near);
}

// A coarse surface has the topology of the fine one and its orientation, and the positions of some
// of its vertices. Where some are fixed, it has all polygons at vertices beside free ones, and no
// other.
void test_region(const std::string& name, const Region& fine, int euler_characteristic)
{
  test_case() = "region, " + name;
  const int n = fine.number_of_vertices();
  for(const bool has_fixed : {false, true})
  {
    const Array<char> is_fixed = has_fixed ? fixed_vertices(fine) : Array<char>(n, false);
    Coarse_region coarse = coarse_region(fine, is_fixed);
    const Region region = coarse.release_region();
    const int m = region.number_of_vertices();
    CHECK(m > 10 && m == coarse.space().number_of_nodes());
    std::set<std::array<int, 2>> edges; // of polygons, from one corner to the next
    for(int s = 0; s < region.number_of_simplices(); ++s)
    {
      const Index_range corners = region.corners_of(s);
      const int k = corners.size();
      CHECK(k >= 3);
      for(int i = 0; i < k; ++i)
        CHECK(edges.insert({corners[i], corners[(i + 1) % k]}).second);
    }
    int number_of_borders = 0, number_of_fixed = 0;
    for(const auto& [a, b] : edges)
      number_of_borders += edges.count({b, a}) == 0;
    for(int node = 0; node < m; ++node)
    {
      CHECK(region.rest[node] == fine.rest[coarse.space().vertex_of(node)]);
      CHECK(coarse.is_fixed(node) == (is_fixed[coarse.space().vertex_of(node)] != 0));
      number_of_fixed += coarse.is_fixed(node);
    }
    if(!has_fixed)
    {
      CHECK(m < n / 3);
      CHECK(number_of_borders == 0 && number_of_fixed == 0);
      const int number_of_edges = static_cast<int>(edges.size()) / 2;
      CHECK(m - number_of_edges + region.number_of_simplices() == euler_characteristic);
      continue;
    }
    CHECK(number_of_fixed > 8 && number_of_fixed < m / 2);
    Array<char> is_near(n, false); // free, or beside those, or beside those in turn
    for(int v = 0; v < n; ++v)
      is_near[v] = !is_fixed[v];
    for(int rings = 0; rings < 2; ++rings)
    {
      const Array<char> is_nearer = is_near;
      for(int s = 0; s < fine.number_of_simplices(); ++s)
      {
        const auto [begin, end] = fine.corners_of(s);
        if(std::any_of(begin, end, [&](int v) { return is_nearer[v] != 0; }))
          for(const int* v = begin; v != end; ++v)
            is_near[*v] = true;
      }
    }
    for(int v = 0; v < n; ++v)
      CHECK(coarse.space().has_nodes(v) == (is_near[v] != 0));
  }
}

// The nodes and their weights do not depend on the order of vertices, triangles and corners.
void test_order(const Shape& shape)
{
  test_case() = "order, " + shape.name;
  std::vector<std::size_t> place;
  const Shape other_shape = shuffled(shape, place);
  const Region region = region_of(shape.points, shape.triangles),
               other_region = region_of(other_shape.points, other_shape.triangles);
  const auto compare = [&](const Coarse_space& space, const Coarse_space& other) {
    CHECK(space.number_of_nodes() == other.number_of_nodes());
    for(int v = 0; v < space.number_of_vertices(); ++v)
      for(int k = 0, w = static_cast<int>(place[static_cast<std::size_t>(v)]);
          k < Coarse_space::most_nodes; ++k)
      {
        CHECK(space.weights(v)[k] == other.weights(w)[k]);
        CHECK(space.nodes(v)[k] == other.nodes(w)[k]);
      }
    for(int node = 0; node < space.number_of_nodes(); ++node)
      CHECK(static_cast<std::size_t>(other.vertex_of(node)) ==
            place[static_cast<std::size_t>(space.vertex_of(node))]);
  };
  compare(coarse_region(region, fixed_vertices(region)).space(),
          coarse_region(other_region, fixed_vertices(other_region)).space());
  Problem problem(region, Energy_model(), 0.01), other(other_region, Energy_model(), 0.01);
  problem.minimization();
  other.minimization();
  compare(Coarse_space(problem.system.laplacian().matrix, region.rest),
          Coarse_space(other.system.laplacian().matrix, other_region.rest));
}

} // namespace coarse

int main()
{
  const double pi = std::acos(-1.0);
  const auto torus = [pi](double u, double v) {
    const double r = 1 + 0.4 * std::cos(2 * pi * v);
    return Eigen::Vector3d(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u),
                           0.4 * std::sin(2 * pi * v));
  };
  const Shape fine_torus = grid("torus", 72, 30, torus, true, true);
  coarse::test_region("torus", problem::region_of(fine_torus.points, fine_torus.triangles), 0);
  std::vector<std::array<std::size_t, 4>> quads;
  for(std::size_t k = 0; k < fine_torus.triangles.size(); k += 2) // two triangles each
  {
    const auto &t = fine_torus.triangles[k], &u = fine_torus.triangles[k + 1];
    if(t[2] == u[1]) // (a, b, c) and (a, c, d)
      quads.push_back({t[0], t[1], t[2], u[2]});
    else // (a, b, d) and (b, c, d)
      quads.push_back({t[0], t[1], u[1], t[2]});
  }
  problem::Region of_quads = problem::region_of(fine_torus.points, quads);
  of_quads.dimension = 2;
  coarse::test_region("torus of quads", of_quads, 0);
  Shape sphere = octahedron();
  for(int k = 0; k < 5; ++k)
    sphere = subdivided("sphere", sphere, [](const Eigen::Vector3d& p) {
      return Eigen::Vector3d(p.normalized());
    });
  coarse::test_order(fine_torus);
  coarse::test_order(sphere);
  coarse::test_region("sphere", problem::region_of(sphere.points, sphere.triangles), 2);
  const Shape sheet = grid("sheet", 32, 26, [](double u, double v) {
    return Eigen::Vector3d(2 * u, v, 0.4 * u * v + 0.2 * u * u);
  });
  const Block bar = block(short_or_long(8, 13), 6, 6);
  for(double distance : {0., 1e6})
    coarse::test_transfer(problem::region_of(sheet.points, sheet.triangles), distance);
  coarse::test_far_isolated_vertex(sheet);
  coarse::test_matrix("sheet", sheet.points, sheet.triangles);
  coarse::test_matrix("bar", bar.points, bar.tetrahedra);
  coarse::test_fan();
  coarse::test_hub();
  coarse::test_small_parts();
  return checks_result();
}
