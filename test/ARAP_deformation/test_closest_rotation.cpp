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

// Closest rotations: against Eigen's singular value decomposition where they are unique, by their
// defining properties where they are not.

#include "include/check.h"

#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <Eigen/Dense>

#include <cmath>
#include <random>
#include <string>
#include <vector>

using CGAL::ARAP::Matrix_3x3;
using Row_major = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Matrix3d fit(const Eigen::Matrix3d& c)
{
  Matrix_3x3 covariance, rotation;
  Eigen::Map<Row_major>(covariance.data()) = c;
  CGAL::ARAP::SVD_closest_rotation()(1, &covariance, &rotation);
  CHECK(CGAL::ARAP::is_rotation(rotation, 1e-14));
  return Eigen::Map<Row_major>(rotation.data());
}

struct Decomposition
{
  Eigen::Matrix3d closest;
  Eigen::Vector3d singular; // the smallest with the sign of the determinant
};

Decomposition decompose(const Eigen::Matrix3d& c)
{
#if EIGEN_VERSION_AT_LEAST(3, 4, 90)
  const Eigen::JacobiSVD<Eigen::Matrix3d, Eigen::ComputeFullU | Eigen::ComputeFullV> svd(c);
#else
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(c, Eigen::ComputeFullU | Eigen::ComputeFullV);
#endif
  Decomposition d{svd.matrixU() * svd.matrixV().transpose(), svd.singularValues()};
  if(d.closest.determinant() < 0)
  {
    Eigen::Matrix3d u = svd.matrixU();
    u.col(2) *= -1;
    d.closest = u * svd.matrixV().transpose();
    d.singular[2] *= -1;
  }
  return d;
}

// The trace of R^T C is at most the sum of the signed singular values, and the closest reaches it.
void check_optimal(const Eigen::Matrix3d& c)
{
  const Decomposition d = decompose(c);
  const Eigen::Matrix3d r = fit(c);
  CHECK_AT_MOST(std::abs((r.transpose() * c).trace() - d.singular.sum()),
                1e-14 * d.singular.cwiseAbs().sum());
  // unique if the two smallest signed values do not cancel: the error grows with their distance
  const double gap = (d.singular[1] + d.singular[2]) / (d.singular[0] > 0 ? d.singular[0] : 1);
  if(gap > 1e-10)
    CHECK_AT_MOST((r - d.closest).norm(), 1e-14 / gap);
}

int main()
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto matrix = [&] {
    return Eigen::Matrix3d(Eigen::Matrix3d::NullaryExpr([&] { return normal(random); }));
  };
  const auto rotation = [&] { return decompose(matrix()).closest; };
  for(int k = 0; k < 20000; ++k)
  {
    test_case() = "random";
    check_optimal(matrix());

    test_case() = "prescribed singular values";
    const Eigen::Matrix3d u = rotation(), v = rotation();
    const auto with_values = [&](double a, double b, double c) {
      return Eigen::Matrix3d(u * Eigen::Vector3d(a, b, c).asDiagonal() * v.transpose());
    };
    const double power = std::pow(10.0, -(k % 17));
    check_optimal(with_values(1, power, power / 3));
    check_optimal(with_values(1, 1, 1));         // a rotation: itself
    check_optimal(with_values(1, 0.5, -0.2));    // a reflection in it
    check_optimal(with_values(1, 0.5, 0));       // rank 2, as on a flat region
    check_optimal(with_values(1e-150, 5e-151, 2e-151));
    check_optimal(with_values(1e150, 5e149, -2e149));
    CHECK_AT_MOST((fit(with_values(1, 1, 1)) - u * v.transpose()).norm(), 1e-14);

    test_case() = "rank 1";
    const Eigen::Vector3d from = v.col(0), to = u.col(0);
    const Eigen::Matrix3d r = fit(3 * to * from.transpose());
    CHECK_AT_MOST(1 - to.dot(r * from), 1e-14);
    // the smallest rotation that does it: its angle is that between the two
    CHECK_AT_MOST(std::abs((r.trace() - 1) / 2 - from.dot(to)), 1e-13);
  }
  test_case() = "degenerate";
  CHECK(fit(Eigen::Matrix3d::Zero()) == Eigen::Matrix3d::Identity());
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  for(const Eigen::Vector3d& to : {x, Eigen::Vector3d(-x)})
    CHECK_AT_MOST((fit(to * x.transpose()) * x - to).norm(), 1e-14);

  test_case() = "a batch";
  std::vector<Matrix_3x3> covariances(100), rotations(100);
  for(auto& c : covariances)
    for(double& entry : c)
      entry = normal(random);
  CGAL::ARAP::SVD_closest_rotation()(100, covariances.data(), rotations.data());
  for(std::size_t k = 0; k < covariances.size(); ++k)
    CHECK(fit(Eigen::Map<Row_major>(covariances[k].data())) ==
          Eigen::Map<Row_major>(rotations[k].data()));
  return checks_result();
}
