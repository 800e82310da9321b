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

#ifndef CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_CLOSEST_ROTATION_H
#define CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_CLOSEST_ROTATION_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/conformance/internal/Violations.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/closest_rotation_requirements.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace CGAL {
namespace ARAP {

namespace internal {

class Closest_rotation_check
{
  using Matrix = Eigen::Matrix3d;

  // a covariance, and its closest rotation by singular value decomposition
  struct Sample
  {
    std::string name;
    Matrix covariance;
    Matrix closest;
    double largest_trace; // of R^T C
    double scale;         // the largest singular value
    double gap;           // relative to scale; the closest rotation is unique if this is positive

    bool is_unique() const { return gap > 1e-4; }
  };

public:
  // any model, so that the check is no template, which would be compiled for each of them
  using Fit = std::function<void(std::size_t, const Matrix_3x3*, Matrix_3x3*)>;

  Closest_rotation_check(const Fit& fit, double tolerance) : m_fit(fit), m_tolerance(tolerance)
  {
    make_samples();
  }

  std::vector<std::string> operator()()
  {
    m_violations.run("the rotation fitting", [this] {
      const std::vector<Matrix> fitted = fit_all(m_fit, m_samples.size(), identities());
      check_optimality(fitted);
      check_warm_starts(fitted);
      check_equivariance(fitted);
      check_batches(fitted);
      check_what_is_not_finite();
    });
    return m_violations.sentences();
  }

private:
  double random() { return std::normal_distribution<double>()(m_random); }

  Matrix random_matrix() { return Matrix::NullaryExpr([this] { return random(); }); }

  Matrix random_rotation()
  {
    return Eigen::Quaterniond(random(), random(), random(), random()).normalized()
      .toRotationMatrix();
  }

  // computed independently, by Eigen's singular value decomposition
  void add(const std::string& name, const Matrix& covariance)
  {
#if EIGEN_VERSION_AT_LEAST(3, 4, 90)
    const Eigen::JacobiSVD<Matrix, Eigen::ComputeFullU | Eigen::ComputeFullV> svd(covariance);
#else
    const Eigen::JacobiSVD<Matrix> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
#endif
    const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1 : 1;
    const Eigen::Vector3d& s = svd.singularValues();
    m_samples.push_back({name, covariance,
                         svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() *
                           svd.matrixV().transpose(),
                         s[0] + s[1] + sign * s[2], s[0],
                         s[0] > 0 ? (s[1] + sign * s[2]) / s[0] : 0});
  }

  void make_samples()
  {
    for(int k = 0; k < 200; ++k)
    {
      add("a random matrix", random_matrix());
      const Matrix u = random_rotation(), v = random_rotation();
      const auto with_values = [&](double a, double b, double c) {
        return Matrix(u * Eigen::Vector3d(a, b, c).asDiagonal() * v.transpose());
      };
      add("a rotation", u);
      add("an ill-conditioned matrix", with_values(1, 0.02, 0.01));
      add("a matrix with a small singular value", with_values(1, 0.5, 1e-9));
      add("a matrix of rank two", with_values(1, 0.3, 0));
      add("a matrix of rank one", with_values(1, 0, 0));
      add("a matrix with a negative determinant", with_values(1, 0.6, -0.2));
      add("a matrix with two equal singular values and a negative determinant",
          with_values(1, 0.4, -0.4));
      add("a reflection", with_values(1, 1, -1));
      add("a symmetric matrix with negative eigenvalues", -(u * Eigen::Vector3d(1, 0.5, 0.2)
                                                            .asDiagonal() * u.transpose()));
      add("a tiny matrix", with_values(1e-150, 7e-151, 3e-151));
      add("a huge matrix", with_values(1e150, 7e149, -3e149));
    }
    add("the zero matrix", Matrix::Zero());
    add("the identity", Matrix::Identity());
    add("half a turn", Eigen::Vector3d(1, -1, -1).asDiagonal().toDenseMatrix());
    add("a flat half turn", Eigen::Vector3d(-1, -1, 0).asDiagonal().toDenseMatrix());
  }

  std::vector<Matrix> identities() const
  {
    return std::vector<Matrix>(m_samples.size(), Matrix::Identity());
  }

  static Matrix_3x3 flat(const Matrix& m)
  {
    return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
  }

  // fits the rotations of all samples, `batch` at a time, starting from `previous`
  std::vector<Matrix> fit_all(const Fit& f, std::size_t batch,
                              const std::vector<Matrix>& previous)
  {
    std::vector<Matrix> covariances;
    for(const Sample& sample : m_samples)
      covariances.push_back(sample.covariance);
    return fit(f, batch, covariances, previous);
  }

  // Each batch stands between two matrices that must not be touched.
  std::vector<Matrix> fit(const Fit& f, std::size_t batch,
                          const std::vector<Matrix>& covariances,
                          const std::vector<Matrix>& previous)
  {
    const Matrix_3x3 untouched = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    std::vector<Matrix> result;
    for(std::size_t begin = 0; begin < covariances.size(); begin += batch)
    {
      const std::size_t n = (std::min)(batch, covariances.size() - begin);
      std::vector<Matrix_3x3> c(n + 2, untouched), r(n + 2, untouched);
      for(std::size_t k = 0; k < n; ++k)
      {
        c[k + 1] = flat(covariances[begin + k]);
        r[k + 1] = flat(previous[begin + k]);
      }
      f(n, c.data() + 1, r.data() + 1);
      m_violations.check(r.front() == untouched && r.back() == untouched,
                         "rotations outside [0, n) are overwritten");
      for(std::size_t k = 0; k < n; ++k)
        result.emplace_back(
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r[k + 1].data()));
    }
    return result;
  }

  // The trace is flat at its maximum: a rotation has half as many correct digits as its trace.
  double rotation_tolerance(const Sample& sample) const
  {
    return 10 * std::sqrt(m_tolerance) / (std::min)(sample.gap, 1.0);
  }

  void check_same(const Sample& sample, const Matrix& fitted, const Matrix& expected,
                  const std::string& sentence)
  {
    if(!sample.is_unique())
      return;
    const double error = (fitted - expected).norm();
    m_violations.check(error <= rotation_tolerance(sample), sentence, ": for ", sample.name);
  }

  void check_optimality(const std::vector<Matrix>& fitted)
  {
    for(std::size_t k = 0; k < fitted.size(); ++k)
    {
      const Sample& sample = m_samples[k];
      const Matrix& r = fitted[k];
      const double error = (r.transpose() * r - Matrix::Identity()).norm();
      m_violations.check(error <= m_tolerance, "the result is not orthonormal for ", sample.name);
      m_violations.check(!(r.determinant() < 0), "the result is a reflection for ", sample.name);

      // scaled, since the products of huge matrices overflow
      const Matrix c = sample.scale > 0 ? Matrix(sample.covariance / sample.scale)
                                        : sample.covariance;
      const double largest = sample.scale > 0 ? sample.largest_trace / sample.scale : 0;
      const double trace = (r.transpose() * c).trace();
      m_violations.check(trace >= largest - m_tolerance, "the result is not the closest rotation, "
                         "which has the largest trace of R^T C, for ", sample.name);
      check_same(sample, r, sample.closest, "the result differs from the closest rotation");
      for(double angle : {1e-3, 0.1, 1.5, 3.1})
      {
        const Eigen::Vector3d axis = Eigen::Vector3d(random(), random(), random()).normalized();
        const Matrix turned = Eigen::AngleAxisd(angle, axis) * r;
        m_violations.check((turned.transpose() * c).trace() <= trace + m_tolerance,
                           "a perturbed rotation is closer than the result, for ", sample.name);
      }
    }
    const std::vector<Matrix> again = fit(m_fit, fitted.size(), fitted, identities());
    for(std::size_t k = 0; k < fitted.size(); ++k)
      m_violations.check((again[k] - fitted[k]).norm() <= 10 * std::sqrt(m_tolerance),
                         "the closest rotation to a rotation is not the rotation itself");
  }

  void check_warm_starts(const std::vector<Matrix>& fitted)
  {
    std::vector<Matrix> warm = fitted, random_start, half_turn;
    for(const Matrix& r : fitted)
    {
      random_start.push_back(random_rotation());
      half_turn.push_back(r * Eigen::Vector3d(-1, 1, -1).asDiagonal());
    }
    const std::string sentence = "the result depends on the previous rotation ";
    for(const auto& [start, name] : {std::make_pair(&warm, "(the result itself)"),
                                     std::make_pair(&random_start, "(a random one)"),
                                     std::make_pair(&half_turn, "(half a turn away)")})
    {
      const std::vector<Matrix> other = fit_all(m_fit, fitted.size(), *start);
      for(std::size_t k = 0; k < fitted.size(); ++k)
        check_same(m_samples[k], other[k], fitted[k], sentence + name);
    }
  }

  // under rotations of the edges, and of the rest shape
  void check_equivariance(const std::vector<Matrix>& fitted)
  {
    const Matrix q = random_rotation();
    std::vector<Matrix> left, right, scaled;
    for(const Sample& sample : m_samples)
    {
      left.push_back(q * sample.covariance);
      right.push_back(sample.covariance * q);
      scaled.push_back(sample.covariance * 1000);
    }
    left = fit(m_fit, left.size(), left, identities());
    right = fit(m_fit, right.size(), right, identities());
    scaled = fit(m_fit, scaled.size(), scaled, identities());
    for(std::size_t k = 0; k < fitted.size(); ++k)
    {
      check_same(m_samples[k], left[k], q * fitted[k], "R(Q C) is not Q R(C) for a rotation Q");
      check_same(m_samples[k], right[k], fitted[k] * q, "R(C Q) is not R(C) Q for a rotation Q");
      check_same(m_samples[k], scaled[k], fitted[k], "R(1000 C) is not R(C)");
    }
  }

  void check_batches(const std::vector<Matrix>& fitted)
  {
    m_fit(0, nullptr, nullptr);
    Matrix_3x3 nothing = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    const Matrix_3x3 untouched = nothing, covariance = flat(Matrix::Identity());
    m_fit(0, &covariance, &nothing);
    m_violations.check(nothing == untouched, "rotations are written for n = 0");

    const Fit copy(m_fit); // which copies the model
    for(std::size_t batch : {std::size_t(1), std::size_t(7), std::size_t(64)})
    {
      const std::vector<Matrix> others = fit_all(copy, batch, identities());
      for(std::size_t k = 0; k < fitted.size(); ++k)
        check_same(m_samples[k], others[k], fitted[k], "the result depends on the size of the "
                   "batch, or a copy fits other rotations");
    }
    m_violations.check(fit_all(m_fit, fitted.size(), identities()) == fitted,
                       "the result differs when asked for again with the same arguments");
  }

  // any result is accepted, but the call must return and must not affect other rotations
  void check_what_is_not_finite()
  {
    const double infinity = std::numeric_limits<double>::infinity();
    for(double entry : {infinity, std::numeric_limits<double>::quiet_NaN()})
    {
      std::vector<Matrix> covariances(3, Matrix::Identity());
      covariances[1](1, 1) = entry;
      const std::vector<Matrix> fitted =
        fit(m_fit, 3, covariances, std::vector<Matrix>(3, Matrix::Identity()));
      for(std::size_t k = 0; k < 3; k += 2)
        m_violations.check((fitted[k] - Matrix::Identity()).norm() <= 10 * std::sqrt(m_tolerance),
                           "a covariance that is not finite changes the rotations of others");
    }
  }

  Fit m_fit;
  double m_tolerance;
  std::mt19937 m_random;
  std::vector<Sample> m_samples;
  Violations m_violations;
};

} // namespace internal

/// \ingroup PkgARAPDeformationChecks
/// \brief returns a message for each requirement of `ARAPClosestRotation` that a model violates;
/// none if it conforms.
///
/// Tests that the results are the closest rotations, against Eigen's singular value decomposition
/// and against perturbed rotations, for random and singular matrices, negative determinants, and
/// tiny and huge entries. Unique results must not depend on the batch or the previous rotations,
/// and must rotate with their arguments. Takes milliseconds.
///
/// \param closest_rotation the model; also copied
/// \param tolerance the largest error of \f$R^T R\f$, and of the trace of \f$R^T C\f$ relative to
///        the largest singular value of \f$C\f$. Two rotations may thus differ by about its square
///        root.
template <typename ClosestRotation>
std::vector<std::string> check_closest_rotation(const ClosestRotation& closest_rotation,
                                                double tolerance = 1e-12)
{
  static_assert(internal::Closest_rotation_requirements<ClosestRotation>::are_met);
  return internal::Closest_rotation_check(closest_rotation, tolerance)();
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_CLOSEST_ROTATION_H
