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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_NEWTON_ROTATION_KERNEL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_NEWTON_ROTATION_KERNEL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/rotation/Svd_rotation.h>
#include <CGAL/ARAP_deformation/internal/rotation/matrix_lanes.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The rotations closest to matrices C, four or eight at a time, starting from rotations R near
// them.
//
// The closest rotation is Q R, with Q that closest to M = C R^T: the Q for which Q^T M is symmetric
// with the largest trace. With the Gibbs vector x of Q (the axis, times the tangent of half the
// angle), a the axial vector of M - M^T, and H = 2 tr(M) I - (M + M^T), symmetry is
//
//     (H + m I) x = a   with   m = x . a.
//
// Apart from m, which is of second order in x, that is Newton's equation for the trace. As m is one
// number, it can be computed to full precision beforehand: with x = adj(H + m I) a / det(H + m I)
// it is a root of the polynomial p(m) = m det(H + m I) - a . adj(H + m I) a of degree four. Its
// roots are real; the trace is largest at the largest one, where H + m I has no negative
// eigenvalue. If H is positive definite, the largest root is the only one that is not negative. So
// a positive definite H proves that the result is the closest rotation and not just a stationary
// point of the trace, for negative determinants too.
//
// One such step is exact up to rounding, and the rounding errors are proportional to x. A second
// step is needed only if x is not small.
//
// Lanes are independent: the result of one does not depend on what the others hold.
template <typename Number>
class Newton_rotation_kernel
{
public:
  CGAL_ARAP_ALWAYS_INLINE static void run(std::size_t n, const Matrix_3x3* covariances,
                                          Matrix_3x3* rotations)
  {
    for(std::size_t k = 0; k < n; k += width)
    {
      const std::size_t size = (std::min)(n - k, width);
      const Matrix_3x3* c = covariances + k;
      Matrix_3x3* r = rotations + k;
      // a copy, filled up to the width, saves a second version of the code
      Matrix_3x3 last_covariances[width], last_rotations[width];
      if(size < width)
      {
        for(std::size_t j = 0; j < width; ++j)
        {
          last_covariances[j] = c[(std::min)(j, size - 1)];
          last_rotations[j] = r[(std::min)(j, size - 1)];
        }
        c = last_covariances;
        r = last_rotations;
      }
      fit(c, r);
      if(size < width)
        std::copy(last_rotations, last_rotations + size, rotations + k);
    }
  }

private:
  using Truths = decltype(Number() < Number());

  static constexpr std::size_t width = Number::size;

  // The first step comes near the result unless it is half a turn away, and the second one reaches
  // it.
  static constexpr int step_limit = 4;

  // Smaller determinants of H, which is scaled to about one, count as zero.
  static constexpr double smallest_determinant = 1e-10;

  using Matrices = Matrix_lanes<Number>;
  using Vectors = Vector_lanes<Number>;
  using Symmetric_matrices = Symmetric_matrix_lanes<Number>;

  CGAL_ARAP_ALWAYS_INLINE static void fit(const Matrix_3x3* covariances, Matrix_3x3* rotations)
  {
    const Matrices c = load_lanes<Number>(covariances);
    Matrices r = load_lanes<Number>(rotations);
    make_orthonormal(r);
    Truths is_done;
    for(int k = 0; k < step_limit && (k == 0 || !are_all(is_done)); ++k) // one copy of step()
    {
      Matrices next = r;
      const Truths is_done_now = step(c, next);
      if(k == 0)
      {
        r = next;
        is_done = is_done_now;
        continue;
      }
      for(int j = 0; j < 9; ++j)
        r.entries[j] = select(is_done, r.entries[j], next.entries[j]);
      is_done = is_done | is_done_now;
    }
    store_lanes(r, rotations);
    if(!are_all(is_done))
      for(int k = 0; k < static_cast<int>(width); ++k)
        if(!is_done[k])
          rotations[k] = Svd_rotation::closest(covariances[k]);
  }

  // Removes rounding errors, which would add up from call to call. A matrix that is no rotation
  // becomes the identity. The third row is not read but computed from the others.
  CGAL_ARAP_ALWAYS_INLINE static void make_orthonormal(Matrices& r)
  {
    const Number zero = Number::zero(), half = Number::all(0.5), one = Number::all(1);
    Vectors a = {r(0, 0), r(0, 1), r(0, 2)}, b = {r(1, 0), r(1, 1), r(1, 2)};
    const Number error_a = half - half * dot(a, a), error_b = half - half * dot(b, b);
    const Number error_ab = Number::all(-0.5) * dot(a, b);
    const Vectors a_old = a;
    a = multiply_add(error_a, a, multiply_add(error_ab, b, a));
    b = multiply_add(error_b, b, multiply_add(error_ab, a_old, b));

    // the errors that remain are of the order of the squares
    const Truths is_rotation =
      multiply_add(error_a, error_a, multiply_add(error_b, error_b, error_ab * error_ab)) <
      Number::all(1e-16);
    if(!are_all(is_rotation))
    {
      a = {select(is_rotation, a.x, one), select(is_rotation, a.y, zero),
           select(is_rotation, a.z, zero)};
      b = {select(is_rotation, b.x, zero), select(is_rotation, b.y, one),
           select(is_rotation, b.z, zero)};
    }
    r = {{a.x, a.y, a.z, b.x, b.y, b.z,
          multiply_subtract(a.y, b.z, a.z * b.y), multiply_subtract(a.z, b.x, a.x * b.z),
          multiply_subtract(a.x, b.y, a.y * b.x)}};
  }

  // replaces r by the rotation closest to c; returns in which lanes it has full precision
  CGAL_ARAP_ALWAYS_INLINE static Truths step(const Matrices& c, Matrices& r)
  {
    Matrices m; // C R^T
    for(int row = 0; row < 3; ++row)
      for(int column = 0; column < 3; ++column)
        m(row, column) = multiply_add(c(row, 0), r(column, 0),
                                      multiply_add(c(row, 1), r(column, 1),
                                                   c(row, 2) * r(column, 2)));
    Vectors a = {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
    Symmetric_matrices h = {m(1, 1) + m(2, 2), m(0, 0) + m(2, 2), m(0, 0) + m(1, 1),
                            m(1, 2) + m(2, 1), m(0, 2) + m(2, 0), m(0, 1) + m(1, 0)};

    // unscaled, products of four entries could overflow or underflow
    const Number two = Number::all(2);
    const Number scale = scale_to_one(multiply_add(two, abs(h.xx) + abs(h.yy) + abs(h.zz),
                                                    abs(a.x) + abs(a.y) + abs(a.z)));
    const Number twice = scale + scale, minus = Number::zero() - scale;
    a = scaled(scale, a);
    h = {twice * h.xx, twice * h.yy, twice * h.zz, minus * h.yz, minus * h.xz, minus * h.xy};

    // det(H + m I) = m^3 + trace m^2 + minors m + determinant,
    // adj(H + m I) a = m^2 a + m b + g
    const Symmetric_matrices adjugate_h = adjugate(h);
    const Number trace = h.xx + h.yy + h.zz;
    const Number minors = adjugate_h.xx + adjugate_h.yy + adjugate_h.zz;
    const Number determinant = multiply_add(h.xx, adjugate_h.xx,
                                             multiply_add(h.xy, adjugate_h.xy,
                                                          h.xz * adjugate_h.xz));
    const Vectors g = adjugate_h * a, ha = h * a;
    const Vectors b = {multiply_subtract(trace, a.x, ha.x), multiply_subtract(trace, a.y, ha.y),
                       multiply_subtract(trace, a.z, ha.z)};

    // The polynomial is m^4 + trace m^3 + p2 m^2 + p1 m - q. For small a the root next to zero is a
    // series in `first`, here to the fourth power; each next term is smaller by `order`.
    const Number q = dot(a, g), p1 = determinant - dot(a, b), p2 = minors - dot(a, a);
    const Number inverse = Number::all(1) / p1;
    const Number first = q * inverse, u2 = p2 * inverse, u3 = trace * inverse;
    const Number u22 = u2 * u2;
    const Number fourth = multiply_add(Number::all(5) * u2, u22 - u3, inverse);
    const Number third = u22 + u22 - u3 - first * fourth;
    const Number second = u2 - first * third;
    Number root = first - first * first * second;
    const Number order = first * minors; // over the determinant

    const Number zero = Number::zero();
    const Truths is_close = (zero < trace) & (zero < minors) &
                           (Number::all(smallest_determinant) < determinant) &
                           (determinant < two * p1) & (order < Number::all(0.1) * determinant);
    if(!are_all(is_close))
      root = select(is_close, root, largest_root(q, p1, p2, trace));

    const Vectors v = multiply_add(root, multiply_add(root, a, b), g);
    const Number d = multiply_add(root, multiply_add(root, root + trace, minors), determinant);
    const Number v_squared = dot(v, v), d_squared = d * d;
    turn(d, v, v_squared, two / (d_squared + v_squared), r);
    return is_close & (order < Number::all(1e-3) * determinant) &
           (v_squared < d_squared * d_squared);
  }

  // Of m^4 + p3 m^3 + p2 m^2 + p1 m - q, whose roots are real, by Newton's method from above, which
  // does not overshoot. A few digits suffice.
  CGAL_ARAP_ALWAYS_INLINE static Number largest_root(const Number& q, const Number& p1,
                                                      const Number& p2, const Number& p3)
  {
    // the mean of the roots, and sqrt(3) times their standard deviation
    const Number half = Number::all(0.5);
    const Number variance = multiply_subtract(Number::all(9. / 16) * p3, p3,
                                               Number::all(1.5) * p2);
    Number deviation = half * (variance + Number::all(1)); // above the square root
    for(int k = 0; k < 3; ++k)
      deviation = half * (deviation + variance / deviation);

    Number m = deviation - Number::all(0.25) * p3;
    for(int k = 0; k < 8; ++k)
    {
      const Number c2 = m + p3, c1 = multiply_add(c2, m, p2), c0 = multiply_add(c1, m, p1);
      const Number value = multiply_subtract(c0, m, q);
      const Number slope = multiply_add(multiply_add(c2 + m, m, c1), m, c0);
      m = m - value / slope;
    }
    return m;
  }

  // replaces R by Q R, where Q = I + f (d [v] + [v]^2) and f = 2 / (d^2 + v^2)
  CGAL_ARAP_ALWAYS_INLINE static void turn(const Number& d, const Vectors& v,
                                           const Number& v_squared, const Number& f,
                                           Matrices& r)
  {
    const Vectors w = scaled(f, v), s = scaled(d, w);
    const Number t = f * v_squared;
    const Matrices q = // Q - I
      {{multiply_subtract(w.x, v.x, t), multiply_subtract(w.x, v.y, s.z),
        multiply_add(w.x, v.z, s.y),
        multiply_add(w.x, v.y, s.z), multiply_subtract(w.y, v.y, t),
        multiply_subtract(w.y, v.z, s.x),
        multiply_subtract(w.x, v.z, s.y), multiply_add(w.y, v.z, s.x),
        multiply_subtract(w.z, v.z, t)}};
    const Matrices old = r;
    for(int row = 0; row < 3; ++row)
      for(int column = 0; column < 3; ++column)
        r(row, column) = multiply_add(
          q(row, 0), old(0, column),
          multiply_add(q(row, 1), old(1, column),
                       multiply_add(q(row, 2), old(2, column), old(row, column))));
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ROTATION_NEWTON_ROTATION_KERNEL_H
