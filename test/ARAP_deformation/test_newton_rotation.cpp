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

// Closest rotations by Newton's method, many at a time: against the singular value decomposition
// for all kinds of matrices and starts, and to the last bit independent of the neighbours.

#include "include/check.h"

#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/Newton_rotation_kernel.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

using CGAL::ARAP::Matrix_3x3;
using CGAL::ARAP::Newton_closest_rotation;
using CGAL::ARAP::SVD_closest_rotation;
using Matrix = Eigen::Matrix3d;
using Matrices = std::vector<Matrix_3x3>;

std::mt19937 generator(5);

double normal() { return std::normal_distribution<double>()(generator); }
double uniform() { return std::uniform_real_distribution<double>()(generator); }

Eigen::Vector3d random_vector() { return Eigen::Vector3d(normal(), normal(), normal()); }

Matrix random_rotation()
{
  return Eigen::Quaterniond(normal(), normal(), normal(), normal()).normalized()
    .toRotationMatrix();
}

Matrix turned(const Matrix& r, double angle)
{
  return Eigen::AngleAxisd(angle, random_vector().normalized()) * r;
}

Matrix_3x3 flat(const Matrix& m)
{
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

Matrix dense(const Matrix_3x3& m)
{
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.data());
}

bool are_same_bits(const Matrix_3x3& a, const Matrix_3x3& b)
{
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

// the same without what the processor has beyond the baseline
struct Plain_newton
{
  void operator()(std::size_t n, const Matrix_3x3* covariances, Matrix_3x3* rotations) const
  {
    using CGAL::ARAP::internal::Double4;
    CGAL::ARAP::internal::Newton_rotation_kernel<Double4>::run(n, covariances, rotations);
  }
};

template <typename Rotation>
Matrices fit(const Rotation& rotation, const Matrices& covariances, Matrices rotations)
{
  rotation(covariances.size(), covariances.data(), rotations.data());
  return rotations;
}

// the singular values of a covariance of length one, the last with the sign of the determinant
enum Kind { generic, reflected, almost_rotation, planar, ill_conditioned, almost_not_unique,
            almost_reflection, linear, number_of_kinds };

Eigen::Vector3d singular_values(int kind)
{
  const double s = uniform(), tiny = std::pow(10, -12 * uniform());
  switch(kind)
  {
  case generic: return {1, s, s * uniform()};
  case reflected: return {1, s, -s * uniform()};
  case almost_rotation: return {1, 1 - 1e-3 * s, 1 - 1e-3};
  case planar: return {1, s, 0};
  case ill_conditioned: return {1, tiny, tiny * (2 * s - 1)};
  case almost_not_unique: return {1, s, -s * (1 - tiny)};
  case almost_reflection: return {1, 1 - tiny * s, -1 + 2 * tiny};
  default: return {1, 0, 0};
  }
}

// some of each kind, of very different scales, and the rotations that they are made of
struct Samples
{
  Matrices covariances;
  std::vector<Matrix> closest;
  std::vector<double> gaps; // zero where the closest rotation is not unique
  std::vector<int> kinds;

  explicit Samples(std::size_t n)
  {
    for(std::size_t k = 0; k < n; ++k)
    {
      const int kind = static_cast<int>(k % number_of_kinds);
      const Eigen::Vector3d s = singular_values(kind);
      const Matrix u = random_rotation(), v = random_rotation();
      const double scale = std::pow(10, 300 * (uniform() - 0.5));
      covariances.push_back(flat(scale * (u * s.asDiagonal() * v.transpose())));
      closest.push_back(u * v.transpose());
      gaps.push_back(s[1] + s[2]);
      kinds.push_back(kind);
    }
  }

  Matrices starts(double angle) const
  {
    Matrices result;
    for(const Matrix& r : closest)
      result.push_back(flat(turned(r, angle)));
    return result;
  }
};

double orthonormality_error(const Matrix& r)
{
  return (r.transpose() * r - Matrix::Identity()).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

template <typename Rotation>
void check_closest(const Rotation& rotation, const Samples& samples, const Matrices& starts)
{
  const std::size_t n = samples.covariances.size();
  const Matrices fitted = fit(rotation, samples.covariances, starts);
  const Matrices expected = fit(SVD_closest_rotation(), samples.covariances, starts);
  double largest_error = 0, largest_loss = 0, largest_distance = 0;
  std::size_t number_of_rotations = 0;
  for(std::size_t k = 0; k < n; ++k)
  {
    const Matrix r = dense(fitted[k]), c = dense(samples.covariances[k]);
    const double trace = (r.transpose() * c).trace();
    largest_error = larger(largest_error, orthonormality_error(r));
    largest_loss = larger(largest_loss, ((dense(expected[k]).transpose() * c).trace() - trace)
                                              / c.cwiseAbs().maxCoeff());
    largest_distance = larger(largest_distance,
                                  (r - samples.closest[k]).norm() * samples.gaps[k]);
    number_of_rotations += r.determinant() > 0;
  }
  CHECK(number_of_rotations == n);
  CHECK_AT_MOST(largest_error, 6e-15);
  CHECK_AT_MOST(largest_loss, 6e-15);
  CHECK_AT_MOST(largest_distance, 1e-14);
}

// how many results are not those of the singular value decomposition, bit by bit
std::size_t number_of_newton_results(const Samples& samples, const Matrices& starts, int kind)
{
  const Matrices fitted = fit(Newton_closest_rotation(), samples.covariances, starts);
  const Matrices expected = fit(SVD_closest_rotation(), samples.covariances, starts);
  std::size_t n = 0;
  for(std::size_t k = 0; k < fitted.size(); ++k)
    n += samples.kinds[k] == kind && !are_same_bits(fitted[k], expected[k]);
  return n;
}

void check_all_starts()
{
  const Samples samples(80003);
  for(double angle : {0., 1e-12, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 1., 2., 3., 3.14159265})
  {
    test_case() = "started " + std::to_string(angle) + " away";
    const Matrices turned_away = samples.starts(angle);
    check_closest(Newton_closest_rotation(), samples, turned_away);
    check_closest(Plain_newton(), samples, turned_away);
    if(angle < 0.5) // it is Newton's method that is tested here, and not what it falls back on
      for(int kind : {generic, reflected, almost_rotation, planar})
        CHECK(number_of_newton_results(samples, turned_away, kind) >
              samples.closest.size() / number_of_kinds * 9 / 10);
  }
  test_case() = "started at all distances";
  Matrices starts;
  for(const Matrix& r : samples.closest)
    starts.push_back(flat(turned(r, 3 * std::pow(10, -4 * uniform()))));
  check_closest(Newton_closest_rotation(), samples, starts);

  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for(const Matrix_3x3& start :
      {flat(Matrix::Identity()), flat(random_rotation()), flat(Matrix::Zero()),
       flat(Matrix::Constant(nan)), flat(Matrix::Constant(infinity)), flat(-Matrix::Identity()),
       flat(2 * random_rotation()), flat(1e-200 * random_rotation()), flat(Matrix::Random()),
       flat((1 + 1e-7) * random_rotation()), flat((1 + 1e-9) * random_rotation())})
  {
    test_case() = "started from anything, as " + std::to_string(start[0]);
    check_closest(Newton_closest_rotation(), samples,
                  Matrices(samples.covariances.size(), start));
  }
}

// Covariances and starts of all kinds in one array, and what is no number too.
void check_independence()
{
  Samples samples(1000);
  Matrices starts;
  for(const Matrix& r : samples.closest)
    starts.push_back(flat(turned(r, std::pow(10, -10 * uniform()) * 3)));
  for(std::size_t k = 0; k < 1000; k += 37)
    samples.covariances[k].fill(k % 2 == 0 ? std::numeric_limits<double>::infinity()
                                           : std::numeric_limits<double>::quiet_NaN());
  for(std::size_t k = 11; k < 1000; k += 37)
    samples.covariances[k].fill(0);
  for(std::size_t k = 23; k < 1000; k += 37)
    starts[k].fill(std::numeric_limits<double>::quiet_NaN());
  const Newton_closest_rotation rotation;
  const Matrices all = fit(rotation, samples.covariances, starts);

  test_case() = "blocks";
  for(std::size_t size : {1, 2, 3, 4, 5, 7, 8, 9, 64, 333})
    for(std::size_t k = 0; k < all.size(); k += size)
    {
      const std::size_t end = (std::min)(k + size, all.size());
      Matrices block(starts.begin() + k, starts.begin() + end);
      rotation(block.size(), samples.covariances.data() + k, block.data());
      for(std::size_t j = k; j < end; ++j)
        CHECK(are_same_bits(block[j - k], all[j]));
    }

  test_case() = "another order";
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  for(int run = 0; run < 10; ++run)
  {
    std::shuffle(order.begin(), order.end(), generator);
    Matrices covariances, rotations;
    for(std::size_t k : order)
    {
      covariances.push_back(samples.covariances[k]);
      rotations.push_back(starts[k]);
    }
    rotations = fit(rotation, covariances, rotations);
    for(std::size_t k = 0; k < order.size(); ++k)
      CHECK(are_same_bits(rotations[k], all[order[k]]));
  }

  test_case() = "scaled by powers of two";
  const Samples others(1000);
  Matrices scaled = others.covariances;
  for(Matrix_3x3& c : scaled)
    for(double& entry : c)
      entry = std::ldexp(entry, 100);
  const Matrices fitted = fit(rotation, others.covariances, starts);
  const Matrices fitted_scaled = fit(rotation, scaled, starts);
  for(std::size_t k = 0; k < fitted.size(); ++k)
    CHECK(are_same_bits(fitted[k], fitted_scaled[k]));
}

// Rotations that are handed from call to call stay rotations, and the closest ones.
void check_drift()
{
  test_case() = "ten thousand calls";
  const Samples samples(16);
  const Eigen::AngleAxisd turn(0.003, random_vector().normalized());
  Matrices still = samples.starts(0.1), moving = still, covariances = samples.covariances;
  for(int call = 0; call < 10000; ++call)
  {
    still = fit(Newton_closest_rotation(), samples.covariances, still);
    for(Matrix_3x3& c : covariances)
      c = flat(turn * dense(c));
    moving = fit(Newton_closest_rotation(), covariances, moving);
  }
  const Matrices still_expected = fit(SVD_closest_rotation(), samples.covariances, still);
  const Matrices moving_expected = fit(SVD_closest_rotation(), covariances, moving);
  for(std::size_t k = 0; k < still.size(); ++k)
  {
    CHECK_AT_MOST(orthonormality_error(dense(still[k])), 6e-15);
    CHECK_AT_MOST(orthonormality_error(dense(moving[k])), 6e-15);
    if(!(samples.gaps[k] > 0))
      continue;
    CHECK_AT_MOST((dense(still[k]) - dense(still_expected[k])).norm() * samples.gaps[k], 1e-14);
    CHECK_AT_MOST((dense(moving[k]) - dense(moving_expected[k])).norm() * samples.gaps[k], 1e-14);
  }
}

int main()
{
  check_all_starts();
  check_independence();
  check_drift();
  return checks_result();
}
