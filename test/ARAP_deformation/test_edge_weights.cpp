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
  const Triangle degenerate = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}};
  for(double weight : Cotangent_weight().simplex_weights(degenerate))
    CHECK(!std::isfinite(weight));
  return checks_result();
}
