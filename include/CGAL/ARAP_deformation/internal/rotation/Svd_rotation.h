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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_SVD_ROTATION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_SVD_ROTATION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// The rotation closest to one matrix, by its singular value decomposition: right for any matrix.
// The identity for the zero matrix, and for one with infinite or NaN entries.
class Svd_rotation
{
public:
  static Matrix_3x3 closest(const Matrix_3x3& c)
  {
    // the entries are squared below: scaled to about one, they neither overflow nor underflow
    double largest = 0;
    bool are_finite = true;
    for(double entry : c)
    {
      largest = (std::max)(largest, std::abs(entry));
      are_finite &= is_finite(entry);
    }
    if(largest == 0 || !are_finite)
      return identity_matrix();

    Columns b; // becomes U Sigma, while v becomes V: always b = c v
    for(std::size_t k = 0; k < 3; ++k)
      b[k] = {c[k] / largest, c[3 + k] / largest, c[6 + k] / largest};
    Columns v = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

    const int sweep_limit = 30; // five are common, convergence is quadratic
    bool is_orthogonal = false;
    for(int sweep = 0; sweep < sweep_limit && !is_orthogonal; ++sweep)
    {
      is_orthogonal = orthogonalize(0, 1, b, v);
      is_orthogonal &= orthogonalize(0, 2, b, v);
      is_orthogonal &= orthogonalize(1, 2, b, v);
    }
    return compose(b, v);
  }

  // The rotation by the smallest angle that takes the unit vector `from` to the unit vector `to`.
  // Half a turn in the plane z = 0 stays in it.
  static Matrix_3x3 smallest_rotation(const Coordinates& from, const Coordinates& to)
  {
    // two reflections: in the plane orthogonal to `from + to`, and in that orthogonal to `to`
    Coordinates mid = {from[0] + to[0], from[1] + to[1], from[2] + to[2]};
    double length = std::sqrt(dot(mid, mid));
    if(length < 1e-8) // opposite: half a turn about an axis orthogonal to both
    {
      const std::size_t smallest = std::abs(to[0]) < std::abs(to[1])
                         ? (std::abs(to[0]) < std::abs(to[2]) ? 0 : 2)
                         : (std::abs(to[1]) < std::abs(to[2]) ? 1 : 2);
      Coordinates axis = {0, 0, 0};
      axis[smallest] = 1;
      mid = cross(to, axis);
      length = std::sqrt(dot(mid, mid));
    }
    mid = scaled(mid, 1 / length);
    Matrix_3x3 r;
    const double product = 2 * dot(mid, to);
    for(std::size_t row = 0; row < 3; ++row)
      for(std::size_t column = 0; column < 3; ++column)
        r[3 * row + column] = (row == column ? 1 : 0) - 2 * mid[row] * mid[column]
                            - 2 * to[row] * to[column] + 2 * product * to[row] * mid[column];
    return r;
  }

private:
  using Columns = std::array<Coordinates, 3>;

  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  // turns the columns p and q in their plane so that those of b become orthogonal;
  // returns whether they were so before
  static bool orthogonalize(std::size_t p, std::size_t q, Columns& b, Columns& v)
  {
    const double pp = dot(b[p], b[p]), qq = dot(b[q], b[q]);
    const double pq = dot(b[p], b[q]);
    if(pq * pq <= 4 * epsilon * epsilon * pp * qq)
      return true;
    const double zeta = (qq - pp) / (2 * pq);
    const double tangent = std::copysign(1 / (std::abs(zeta) + std::sqrt(1 + zeta * zeta)), zeta);
    const double cosine = 1 / std::sqrt(1 + tangent * tangent), sine = cosine * tangent;
    for(Columns* columns : {&b, &v})
      for(std::size_t k = 0; k < 3; ++k)
      {
        double& x = (*columns)[p][k];
        double& y = (*columns)[q][k];
        const double x_old = x;
        x = cosine * x_old - sine * y;
        y = sine * x_old + cosine * y;
      }
    return false;
  }

  // U V^T from the two largest singular values: the third columns are their cross products, which
  // is what gives the smallest one the sign of the determinant
  static Matrix_3x3 compose(const Columns& b, const Columns& v)
  {
    const std::array<double, 3> squares = {dot(b[0], b[0]), dot(b[1], b[1]),
                                           dot(b[2], b[2])};
    std::array<std::size_t, 3> order = {0, 1, 2};
    if(squares[order[0]] < squares[order[1]]) std::swap(order[0], order[1]);
    if(squares[order[1]] < squares[order[2]]) std::swap(order[1], order[2]);
    if(squares[order[0]] < squares[order[1]]) std::swap(order[0], order[1]);

    const double first = std::sqrt(squares[order[0]]), second = std::sqrt(squares[order[1]]);
    const Coordinates u0 = scaled(b[order[0]], 1 / first);
    const Coordinates& v0 = v[order[0]];
    if(second <= 4 * epsilon * first)
      return smallest_rotation(v0, u0);

    const Coordinates u1 = scaled(b[order[1]], 1 / second);
    const Coordinates& v1 = v[order[1]];
    const Coordinates u2 = cross(u0, u1), v2 = cross(v0, v1);
    Matrix_3x3 r;
    for(std::size_t row = 0; row < 3; ++row)
      for(std::size_t column = 0; column < 3; ++column)
        r[3 * row + column] = u0[row] * v0[column] + u1[row] * v1[column] + u2[row] * v2[column];
    return r;
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_SVD_ROTATION_H
