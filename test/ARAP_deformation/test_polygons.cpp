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

// Polygons: their weights are the same from whichever corner, have the identity with the area, and
// meshes of quads and of mixed faces give what their ranges give.

#include "include/domains.h"

#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_sets.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

using CGAL::ARAP::Cotangent_weight;
using CGAL::ARAP::internal::Region;

// the weights of all pairs of corners of one polygon
std::vector<double> weights_of(const std::vector<Eigen::Vector3d>& points)
{
  Region region;
  for(const auto& p : points)
  {
    region.corners.push_back(region.number_of_vertices());
    region.rest.push_back({p.x(), p.y(), p.z()});
  }
  region.first_corner.push_back(region.number_of_vertices());
  return CGAL::ARAP::internal::weighted_simplices(Cotangent_weight(), region).weights;
}

std::size_t pair_number(std::size_t n, std::size_t a, std::size_t b)
{
  return a > b ? pair_number(n, b, a) : a * (2 * n - a - 1) / 2 + b - a - 1;
}

// The weights from another corner on, every `step`-th one, and the other way round, are the same.
void check_turned(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& weights,
                  std::size_t step, double tolerance)
{
  const std::size_t n = points.size();
  for(std::size_t shift = 1; shift < n; shift += step)
    for(bool is_reversed : {false, true})
    {
      std::vector<Eigen::Vector3d> other = points;
      std::rotate(other.begin(), other.begin() + std::ptrdiff_t(shift), other.end());
      if(is_reversed)
        std::reverse(other.begin(), other.end());
      const std::vector<double> turned = weights_of(other);
      const auto place = [&](std::size_t a) {
        return is_reversed ? (2 * n - 1 - a + shift) % n : (a + n - shift) % n;
      };
      for(std::size_t a = 0; a < n; ++a)
        for(std::size_t b = a + 1; b < n; ++b)
          CHECK_AT_MOST(std::abs(weights[pair_number(n, a, b)] -
                                 turned[pair_number(n, place(a), place(b))]), tolerance);
    }
}

void test_one_polygon()
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for(std::size_t n : {3, 4, 5, 6, 9, 40})
  {
    test_case() = "a polygon of " + std::to_string(n) + " corners";
    // in space
    std::vector<Eigen::Vector3d> points;
    for(std::size_t k = 0; k < n; ++k)
      points.emplace_back(std::cos(6.28 * k / n), std::sin(6.28 * k / n), unit(random));
    const std::vector<double> weights = weights_of(points);
    check_turned(points, weights, 1 + n / 7, 1e-11);

    // flat and convex: sum w ||D e||^2 = area ||D||_F^2, as for each of its triangulations
    for(auto& p : points)
      p = {2 * p.x(), p.y() + 0.3 * p.x(), 0};
    const std::vector<double> flat = weights_of(points);
    const Eigen::Matrix2d map = Eigen::Matrix2d::NullaryExpr([&] { return unit(random); });
    double sum = 0, area = 0;
    for(std::size_t a = 0; a < n; ++a)
    {
      const Eigen::Vector3d& p = points[a];
      const Eigen::Vector3d& q = points[(a + 1) % n];
      area += (p.x() * q.y() - p.y() * q.x()) / 2;
      for(std::size_t b = a + 1; b < n; ++b)
        sum += flat[pair_number(n, a, b)] *
               (map * (points[a] - points[b]).head<2>()).squaredNorm();
    }
    CHECK_AT_MOST(std::abs(sum - area * map.squaredNorm()), 1e-11 * sum);
  }

  // a rectangle has no weight on its diagonals
  const std::vector<double> rectangle = weights_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
  CHECK_AT_MOST(std::abs(rectangle[pair_number(4, 0, 2)]), 1e-15);
  CHECK_AT_MOST(std::abs(rectangle[pair_number(4, 1, 3)]), 1e-15);
}

double largest_of(const std::vector<double>& weights)
{
  return Eigen::Map<const Eigen::VectorXd>(weights.data(), Eigen::Index(weights.size()))
    .lpNorm<Eigen::Infinity>();
}

// Five of eight corners, or all, are next to being on a line. What little area their triangles have
// must not decide at once, by a rounding error, whether they are as stiff as such needles are.
void test_corners_next_to_a_line()
{
  for(double height : {0.0, 1.0}) // of the other three corners
  {
    std::vector<double> last;
    int number_of_shapes = 0;
    for(double h = 1e-8; h < 1e-5; h *= 1.002)
    {
      test_case() = "corners off a line by 1e-8 * 1.002^" + std::to_string(number_of_shapes);
      const std::vector<Eigen::Vector3d> points = {
        {0, 0, 0}, {1, -h, 0}, {2, -h, 0}, {3, h, 0}, {4, 0, 0},
        {5, 2 * height, height}, {2, 3 * height, 0}, {-1, 2 * height, 0}};
      const std::vector<double> weights = weights_of(points);
      const double largest = largest_of(weights);
      for(std::size_t k = 0; k < last.size(); ++k)
        CHECK_AT_MOST(std::abs(weights[k] - last[k]), 0.02 * largest);
      if(number_of_shapes++ % 50 == 0)
        check_turned(points, weights, 1, 1e-8 * largest);
      last = weights;
    }
  }

  test_case() = "corners on a line";
  std::vector<Eigen::Vector3d> points;
  for(double t : {0.0, 0.3, 1.1, 2.0, 1.7, 0.9, 0.1})
    points.push_back(t * Eigen::Vector3d(0.3, -1, 0.7) + Eigen::Vector3d(1, 2, 3));
  const std::vector<double> weights = weights_of(points);
  check_turned(points, weights, 1, 1e-6 * largest_of(weights));
  for(std::size_t a = 0; a < points.size(); ++a) // no corner is loose
  {
    double sum = 0;
    for(std::size_t b = 0; b < points.size(); ++b)
      if(b != a)
        sum += std::abs(weights[pair_number(points.size(), a, b)]);
    CHECK(sum > 0.01);
  }
}

template <typename Mesh_>
void compare_with_reference(const Shape& shape, const Polygons& polygons)
{
  const Scenario s = scenario(shape);
  for(Cell_scheme cells : all_cell_schemes)
  {
    Mesh_ mesh;
    CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points_of(shape.points), polygons,
                                                                mesh);
    const CGAL::ARAP::Face_graph_domain<Mesh_> domain(mesh);
    check_conforms(domain);
    compare(reference<2>(shape.points, polygons, s, cells),
            deform(domain, all_vertices(mesh), s, cells), shape.diameter());
  }
}

int main()
{
  test_one_polygon();
  test_corners_next_to_a_line();
  Polygons polygons;
  const Shape shape = tube(polygons);
  test_case() = "Surface_mesh";
  compare_with_reference<Mesh>(shape, polygons);
  test_case() = "Polyhedron_3";
  compare_with_reference<CGAL::Polyhedron_3<Kernel>>(shape, polygons);
  return checks_result();
}
