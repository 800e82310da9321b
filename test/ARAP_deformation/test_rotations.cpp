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

// Closest rotations: by singular value decomposition, by Newton's method, and conformance.

#include "include/check.h"
#include "include/conformance.h"
#include "include/length.h"

#include <CGAL/ARAP_deformation/Closest_rotation_traits_adaptor.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/conformance/check_closest_rotation.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/ARAP_deformation/internal/rotation/Newton_rotation_kernel.h>
#include <CGAL/ARAP_deformation/internal/rotation/rotation_vectors.h>

#include <CGAL/Deformation_Eigen_closest_rotation_traits_3.h>
#include <CGAL/Deformation_Eigen_polar_closest_rotation_traits_3.h>
#include <CGAL/number_type_basic.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

// Closest rotations: against Eigen's singular value decomposition where they are unique, by their
// defining properties where they are not.
namespace svd {

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

void test_all()
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto matrix = [&] {
    return Eigen::Matrix3d(Eigen::Matrix3d::NullaryExpr([&] { return normal(random); }));
  };
  const auto rotation = [&] { return decompose(matrix()).closest; };
  for(int k = 0; k < short_or_long(4000, 20000); ++k)
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
    const Eigen::Vector3d to = u.col(0);
    const double distance = std::pow(10.0, -(k % 8)); // from the opposite direction
    const Eigen::Vector3d nearly_opposite = (distance * u.col(1) - to).normalized();
    for(const Eigen::Vector3d& from : {Eigen::Vector3d(v.col(0)), nearly_opposite})
    {
      const Eigen::Matrix3d r = fit(3 * to * from.transpose());
      CHECK_AT_MOST((r * from - to).norm(), 1e-14 / (from + to).norm());
      // the smallest rotation that does it: its angle is that between the two
      CHECK_AT_MOST(std::abs((r.trace() - 1) / 2 - from.dot(to)), 1e-13);
    }
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
}

} // namespace svd

// Closest rotations by Newton's method, many at a time: against the singular value decomposition
// for all kinds of matrices and starts, and to the last bit independent of the neighbors.
namespace newton {

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
  const Samples samples(is_long_run() ? 80003 : 8003);
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

// What is no matrix of numbers, wherever its entries are: the identity, as for the zero matrix.
void check_no_numbers()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  Matrices covariances, starts;
  for(double bad : {nan, infinity, -infinity})
    for(const Matrix& regular : {Matrix(Matrix::Zero()), random_rotation()})
      for(std::size_t k = 0; k < 10; ++k)
        for(double second : {nan, infinity, -infinity, 0.})
        {
          Matrix_3x3 c = flat(regular);
          c[k % 9] = bad;
          c[(k + 4) % 9] = second;
          if(k == 9)
            c.fill(bad);
          covariances.push_back(c);
          starts.push_back(flat(random_rotation()));
        }
  test_case() = "no numbers, by singular value decomposition";
  for(const Matrix_3x3& r : fit(SVD_closest_rotation(), covariances, starts))
    CHECK(dense(r) == Matrix::Identity());
  test_case() = "no numbers, by Newton's method";
  for(const Matrix_3x3& r : fit(Newton_closest_rotation(), covariances, starts))
    CHECK(dense(r) == Matrix::Identity());
  for(const Matrix_3x3& r : fit(Plain_newton(), covariances, starts))
    CHECK(dense(r) == Matrix::Identity());
}

// Rotations that are handed from call to call stay rotations, and the closest ones.
void check_drift()
{
  test_case() = "many calls";
  const Samples samples(16);
  const Eigen::AngleAxisd turn(0.003, random_vector().normalized());
  Matrices still = samples.starts(0.1), moving = still, covariances = samples.covariances;
  for(int call = 0; call < short_or_long(1000, 10000); ++call)
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

void test_all()
{
  check_all_starts();
  check_independence();
  check_no_numbers();
  check_drift();
}

} // namespace newton

// Each rotation fitting that ships conforms to the concept, and broken ones are caught.
namespace conformance {

using namespace CGAL::ARAP;

const Matrix_3x3 identity = {1, 0, 0, 0, 1, 0, 0, 0, 1};

// A model of nothing but what the documentation of DeformationClosestRotationTraits_3 asks for: no
// function is const, vectors are not assigned, and all there is to see are the operations.
class Bare_rotation_traits
{
public:
  class Matrix
  {
    friend Bare_rotation_traits;
    Matrix_3x3 entries;
  };

  class Vector
  {
  public:
    Vector(const Vector&) = default;
    Vector& operator=(const Vector&) = delete;

  private:
    friend Bare_rotation_traits;
    explicit Vector(const Coordinates& c) : coordinates(c) {}
    Coordinates coordinates;
  };

  void add_scalar_t_vector_t_vector_transpose(Matrix& result, double w, const Vector& a,
                                              const Vector& b)
  {
    for(int row = 0; row < 3; ++row)
      for(int column = 0; column < 3; ++column)
        result.entries[3 * row + column] += w * a.coordinates[row] * b.coordinates[column];
  }

  void add__scalar_t_matrix_p_scalar_t_matrix__t_vector(Vector& result, double w1, const Matrix& a,
                                                        double w2, const Matrix& b, const Vector& v)
  {
    for(int row = 0; row < 3; ++row)
      for(int column = 0; column < 3; ++column)
        result.coordinates[row] += (w1 * a.entries[3 * row + column] +
                                    w2 * b.entries[3 * row + column]) * v.coordinates[column];
  }

  Matrix identity_matrix()
  {
    Matrix m;
    m.entries = identity;
    return m;
  }

  Matrix zero_matrix()
  {
    Matrix m;
    m.entries.fill(0);
    return m;
  }

  Vector vector(double x, double y, double z) { return Vector({x, y, z}); }
  double vector_coordinate(const Vector& v, int k) { return v.coordinates[k]; }

  // Here the covariances are the sums of w p q^T, with p the rest shape. They are finite: of others
  // Eigen computes nothing, and a model would go on with memory that was not initialized.
  void compute_close_rotation(const Matrix& m, Matrix& r)
  {
    CHECK(std::all_of(m.entries.begin(), m.entries.end(), [](double x) {
      return std::isfinite(x);
    }));
    Matrix_3x3 transposed;
    for(int row = 0; row < 3; ++row)
      for(int column = 0; column < 3; ++column)
        transposed[3 * row + column] = m.entries[3 * column + row];
    SVD_closest_rotation()(1, &transposed, &r.entries);
  }
};

// What the broken models are made of: a function that is called for each rotation.
class Broken
{
public:
  using Function = std::function<void(std::size_t n, std::size_t k, const Matrix_3x3& covariance,
                                      const Matrix_3x3& previous, Matrix_3x3& rotation)>;

  explicit Broken(const Function& f) : m_function(f) {}
  void operator()(std::size_t n, const Matrix_3x3* covariances, Matrix_3x3* rotations) const
  {
    for(std::size_t k = 0; k < n; ++k)
    {
      const Matrix_3x3 previous = rotations[k];
      SVD_closest_rotation()(1, covariances + k, rotations + k);
      m_function(n, k, covariances[k], previous, rotations[k]);
    }
  }

private:
  Function m_function;
};

std::vector<std::string> check_broken(const Broken::Function& f)
{
  return check_closest_rotation(Broken(f));
}

// turns a rotation by a small angle
void turn(Matrix_3x3& r, double angle)
{
  const double c = std::cos(angle), s = std::sin(angle);
  for(int column = 0; column < 3; ++column)
  {
    const double x = r[column], y = r[3 + column];
    r[column] = c * x - s * y;
    r[3 + column] = s * x + c * y;
  }
}

double determinant(const Matrix_3x3& m)
{
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6])
       + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

void test_all()
{
  using CGAL_svd = CGAL::Deformation_Eigen_closest_rotation_traits_3;
  using CGAL_polar = CGAL::Deformation_Eigen_polar_closest_rotation_traits_3;
  CHECK_CONFORMS(check_closest_rotation(SVD_closest_rotation()));
  CHECK_CONFORMS(check_closest_rotation(SVD_closest_rotation(), 1e-13));
  CHECK_CONFORMS(check_closest_rotation(Newton_closest_rotation()));
  CHECK_CONFORMS(check_closest_rotation(Newton_closest_rotation(), 1e-13));
  CHECK_CONFORMS(check_closest_rotation(Closest_rotation_traits_adaptor<CGAL_svd>()));
  CHECK_CONFORMS(check_closest_rotation(Closest_rotation_traits_adaptor<CGAL_polar>()));
  CHECK_CONFORMS(check_closest_rotation(Closest_rotation_traits_adaptor<Bare_rotation_traits>()));

  using std::size_t;
  using M = Matrix_3x3;
  CHECK_CONFORMS(check_broken([](size_t, size_t, const M&, const M&, M&) {}));
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M& c, const M&, M& r) {
    if(determinant(c) < 0)
      for(double& entry : r)
        entry = -entry;
  }), "reflection");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M&, const M&, M& r) {
    r = {r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]};
  }), "not the closest rotation");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M&, const M&, M& r) { turn(r, 1e-4); }),
               "not the closest rotation");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M&, const M&, M& r) { r[4] *= 1 + 1e-6; }),
               "not orthonormal");
  CHECK_CAUGHT(check_broken([](size_t n, size_t k, const M&, const M&, M& r) {
    if(n > 1 && k + 1 == n) r = identity;
  }), "not the closest rotation");
  CHECK_CAUGHT(check_broken([](size_t n, size_t k, const M&, const M&, M& r) {
    if(n == 7 && k == 6) turn(r, 0.1);
  }), "size of the batch");
  CHECK_CAUGHT(check_broken([](size_t n, size_t k, const M&, const M&, M& r) {
    if(k + 1 == n) (&r)[1] = r;
  }), "outside [0, n)");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M&, const M& previous, M& r) {
    turn(r, 1e-3 * (previous[1] != 0));
  }), "previous rotation");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M& c, const M&, M& r) {
    if(determinant(c) < 1e-300) r = identity;
  }), "a tiny matrix");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M& c, const M&, M& r) {
    if(!(std::abs(c[0]) + std::abs(c[4]) > 0)) r.fill(std::numeric_limits<double>::quiet_NaN());
  }), "the zero matrix");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M& c, const M&, M& r) {
    if(std::abs(determinant(c)) < 1e-12) turn(r, 0.5);
  }), "rank two");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M& c, const M&, M& r) {
    if(std::abs(determinant(c)) > 1e6) turn(r, 1e-4);
  }), "R(1000 C) is not R(C)");
  int calls = 0;
  CHECK_CAUGHT(check_broken([&calls](size_t, size_t, const M&, const M&, M& r) {
    turn(r, 1e-14 * (++calls % 5));
  }), "asked for again");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M& c, const M&, M&) {
    if(c[0] > 1e100) throw std::overflow_error("too large");
  }), "too large");
}

} // namespace conformance

// The axis times the angle is the logarithm of a rotation, up to half a turn and next to it too.
void test_rotation_vectors()
{
  test_case() = "rotation vectors";
  using namespace CGAL::ARAP::internal;
  const double pi = CGAL_PI;
  std::vector<Eigen::Vector3d> axes;
  for(int k = 0; k < 3; ++k)
    for(double sign : {-1., 1.})
      axes.push_back(sign * Eigen::Vector3d::Unit(k));
  for(int k = 0; k < 20; ++k)
    axes.push_back(newton::random_vector().normalized());
  for(const Eigen::Vector3d& axis : axes)
    for(double angle : {0., 1e-12, 1e-7, 1e-5, 1e-3, 1., 3., pi - 1e-3, pi - 1e-5, pi - 9e-7,
                        pi - 1e-7, pi - 1e-12, pi})
    {
      const auto rotation = newton::flat(Eigen::AngleAxisd(angle, axis).toRotationMatrix());
      const auto vector = rotation_vector(rotation);
      const Eigen::Vector3d v(vector[0], vector[1], vector[2]);
      CHECK_AT_MOST(std::abs(v.norm() - angle), 1e-12);
      if(angle < pi - 1e-13)
        CHECK_AT_MOST((v - angle * axis).norm(), 1e-9);
      const auto again = rotation_of_vector(vector);
      for(std::size_t k = 0; k < 9; ++k)
        CHECK_AT_MOST(std::abs(again[k] - rotation[k]), 1e-9);
    }
}

int main()
{
  test_rotation_vectors();
  svd::test_all();
  newton::test_all();
  conformance::test_all();
  return checks_result();
}
