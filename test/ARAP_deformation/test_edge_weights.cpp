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

// Edge weights: the identity with the area, the models against each other and against angles.

#include "include/check.h"

#include <CGAL/ARAP_deformation/edge_weights.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

using namespace CGAL::ARAP;

using Triangle = std::array<Coordinates, 3>;

Eigen::Vector3d vector(const Coordinates& c) { return {c[0], c[1], c[2]}; }

// For a linear map D of the plane of a triangle, sum w ||D e||^2 = area ||D||_F^2.
void check_area_identity(const Triangle& t, const Eigen::Matrix3d& map)
{
  const Eigen::Vector3d p[3] = {vector(t[0]), vector(t[1]), vector(t[2])};
  const auto w = Cotangent_weight().simplex_weights(t);
  const double sum = w[0] * (map * (p[0] - p[1])).squaredNorm() +
                     w[1] * (map * (p[0] - p[2])).squaredNorm() +
                     w[2] * (map * (p[1] - p[2])).squaredNorm();

  const Eigen::Vector3d u = (p[1] - p[0]).normalized();
  const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
  const Eigen::Vector3d v = normal.normalized().cross(u);
  const double area = normal.norm() / 2;
  const double norm = (map * u).squaredNorm() + (map * v).squaredNorm();
  CHECK_AT_MOST(std::abs(sum - area * norm), 1e-11 * area * map.squaredNorm());
}

template <std::size_t N>
bool are_finite(const std::array<double, N>& weights)
{
  return std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w); });
}

// Simplices that are squeezed until nothing is left, of any size: the weights are finite, at most
// 10^6 units and those of a regular simplex, and of no negative energy.
template <int N>
void test_degenerate_simplices()
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> entry(-1, 1);
  int number_of_bounded = 0;
  for(int k = 0; k < 4000; ++k)
  {
    const double size = std::pow(10.0, k % 50 == 7 ? -160 : (k % 5 - 2) * 6);
    std::array<Coordinates, N> simplex;
    for(Coordinates& p : simplex)
      p = {entry(random), entry(random), entry(random)};
    const int squeezed = k / 5 % N; // coordinates, and of what is left one corner goes to another
    const double factor = k % 3 == 0 ? 0 : std::pow(10.0, -(k % 17));
    if(k % 2 == 0)
      simplex[1] = simplex[0];
    for(Coordinates& p : simplex)
      for(int c = 0; c < 3; ++c)
        p[c] *= size * (c < squeezed ? factor : 1);

    const auto weights = Cotangent_weight().simplex_weights(simplex);
    Eigen::Matrix<double, N, N> laplacian = Eigen::Matrix<double, N, N>::Zero();
    double longest = 0, largest = 0;
    std::size_t edge = 0;
    for(int a = 0; a < N; ++a)
      for(int b = a + 1; b < N; ++b)
      {
        const double w = weights[edge++];
        CHECK(std::isfinite(w));
        laplacian(a, a) += w;
        laplacian(b, b) += w;
        laplacian(a, b) = laplacian(b, a) = -w;
        longest = larger(longest, (vector(simplex[a]) - vector(simplex[b])).norm());
        largest = larger(largest, std::abs(w));
      }
    const double unit = N == 3 ? 1 : longest;
    CHECK_AT_MOST(largest, (1e6 + 0.3) * unit);
    CHECK(largest > 0 || (N == 4 && longest == 0));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> spectrum(laplacian);
    CHECK_AT_MOST(-spectrum.eigenvalues()[0], 1e-9 * largest);
    number_of_bounded += largest > 0.999e6 * unit;
  }
  CHECK(number_of_bounded > 500 && number_of_bounded < 3500);
}

int main()
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> entry(-1, 1);
  for(int k = 0; k < 1000; ++k)
  {
    Triangle t;
    for(auto& p : t)
      p = {entry(random), entry(random), entry(random)};
    const Eigen::Matrix3d map = Eigen::Matrix3d::NullaryExpr([&] { return entry(random); });
    check_area_identity(t, map);
    for(const Edge_set set : {Edge_set::star, Edge_set::simplex})
    {
      const double sum = entry(random);
      CHECK(Cotangent_weight().edge_weight(set, 0, 1, sum) == sum);
      CHECK(Clamped_cotangent_weight().edge_weight(set, 0, 1, sum) == (std::max)(sum, 0.0));
      CHECK(Uniform_weight().edge_weight(set, 0, 1, sum) == 1);
      CHECK(Safe_cotangent_weight().edge_weight(set, 0, 1, sum) ==
            (set == Edge_set::star ? (std::max)(sum, 0.0) : sum));
    }
  }

  // the edges come as (0,1), (0,2), (1,2): half the cotangents at the vertices 2, 1, 0
  const Triangle right_angle = {{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}};
  const auto w = Cotangent_weight().simplex_weights(right_angle);
  CHECK_AT_MOST(std::abs(w[0] - 0.25), 1e-15);
  CHECK_AT_MOST(std::abs(w[1] - 1), 1e-15);
  CHECK_AT_MOST(std::abs(w[2]), 1e-15);

  // nothing that is not a number is hidden by the clamping
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(Clamped_cotangent_weight().edge_weight(Edge_set::star, 0, 1, nan)));
  CHECK(std::isnan(Safe_cotangent_weight().edge_weight(Edge_set::star, 0, 1, nan)));
  for(double bad : {nan, std::numeric_limits<double>::infinity(), 1e200})
  {
    const Triangle triangle = {{{0, 0, 0}, {1, 0, bad}, {2, 1, 0}}};
    const std::array<Coordinates, 4> tetrahedron = {
      {{0, 0, 0}, {1, 0, bad}, {2, 1, 0}, {0, 0, 1}}};
    CHECK(!are_finite(Cotangent_weight().simplex_weights(triangle)));
    CHECK(!are_finite(Cotangent_weight().simplex_weights(tetrahedron)));
  }
  test_degenerate_simplices<3>();
  test_degenerate_simplices<4>();
  return checks_result();
}
