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


// Each rotation fitting that ships conforms to the concept, and broken ones are caught.

#include "include/check.h"
#include "include/conformance.h"

#include <CGAL/ARAP_deformation/Closest_rotation_traits_adaptor.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/conformance/check_closest_rotation.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <CGAL/Deformation_Eigen_closest_rotation_traits_3.h>
#include <CGAL/Deformation_Eigen_polar_closest_rotation_traits_3.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

using namespace CGAL::ARAP;

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
    CGAL::ARAP::internal::add(result.coordinates, w1,
                              CGAL::ARAP::internal::product(a.entries, v.coordinates));
    CGAL::ARAP::internal::add(result.coordinates, w2,
                              CGAL::ARAP::internal::product(b.entries, v.coordinates));
  }

  Matrix identity_matrix()
  {
    Matrix m;
    m.entries = CGAL::ARAP::internal::identity_matrix();
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

  // here the covariances are the sums of w p q^T, with p the rest shape
  void compute_close_rotation(const Matrix& m, Matrix& r)
  {
    Matrix_3x3 transposed;
    for(int row = 0; row < 3; ++row)
      for(int column = 0; column < 3; ++column)
        transposed[3 * row + column] = m.entries[3 * column + row];
    SVD_closest_rotation()(1, &transposed, &r.entries);
  }
};

// What the broken models are made of: a function that is called for each rotation.
template <typename Function>
class Broken
{
public:
  explicit Broken(const Function& f) : m_function(&f) {}
  void operator()(std::size_t n, const Matrix_3x3* covariances, Matrix_3x3* rotations) const
  {
    for(std::size_t k = 0; k < n; ++k)
    {
      const Matrix_3x3 previous = rotations[k];
      SVD_closest_rotation()(1, covariances + k, rotations + k);
      (*m_function)(n, k, covariances[k], previous, rotations[k]);
    }
  }

private:
  const Function* m_function;
};

template <typename Function>
std::vector<std::string> check_broken(const Function& f)
{
  return check_closest_rotation(Broken<Function>(f));
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

int main()
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
    if(n > 1 && k + 1 == n) r = CGAL::ARAP::internal::identity_matrix();
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
    if(determinant(c) < 1e-300) r = CGAL::ARAP::internal::identity_matrix();
  }), "a tiny matrix");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M& c, const M&, M& r) {
    if(!(std::abs(c[0]) + std::abs(c[4]) > 0)) r.fill(std::numeric_limits<double>::quiet_NaN());
  }), "the zero matrix");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M& c, const M&, M& r) {
    if(std::abs(determinant(c)) < 1e-12) turn(r, 0.5);
  }), "rank two");
  int calls = 0;
  CHECK_CAUGHT(check_broken([&calls](size_t, size_t, const M&, const M&, M& r) {
    turn(r, 1e-14 * (++calls % 5));
  }), "asked for again");
  CHECK_CAUGHT(check_broken([](size_t, size_t, const M& c, const M&, M&) {
    if(c[0] > 1e100) throw std::overflow_error("too large");
  }), "too large");
  return checks_result();
}
