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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_WIDE_ROTATION_KERNEL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_WIDE_ROTATION_KERNEL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Svd_rotation.h>
#include <CGAL/ARAP_deformation/internal/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/wide_vector.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The rotations closest to matrices C, four at a time, from rotations R that are about right.
//
// The closest rotation is Q R, with Q that closest to M = C R^T: the Q for which Q^T M is symmetric
// with the largest trace. With the Gibbs vector x of Q (the axis, times the tangent of half the
// angle), a the axial vector of M - M^T, and H = 2 tr(M) I - (M + M^T), symmetry is
//
//     (H + m I) x = a   with   m = x . a.
//
// That is Newton's equation for the trace but for m, which is of second order in x. As m is one
// number it can be had to full precision beforehand: with x = adj(H + m I) a / det(H + m I) it is
// a root of the polynomial p(m) = m det(H + m I) - a . adj(H + m I) a of degree four. Its roots are
// real, and at the largest one, where H + m I has no negative eigenvalue, the trace is the
// largest. If H is positive definite, then the largest root is the only one that is not negative.
// So a positive definite H proves that the result is the closest rotation, and not only one with a
// stationary trace; this covers negative determinants too.
//
// One step with all that is exact but for rounding, and the rounding errors are proportional to
// x. A second step is needed only where x is not small.
//
// The lanes do not know of each other: what is computed in one is the same whatever the others hold.
class Wide_rotation_kernel
{
public:
  CGAL_ARAP_ALWAYS_INLINE static void run(std::size_t n, const Matrix_3x3* covariances,
                                          Matrix_3x3* rotations)
  {
    for(std::size_t k = 0; k < n; k += 4)
    {
      const std::size_t size = (std::min)(n - k, std::size_t(4));
      const Matrix_3x3* c = covariances + k;
      Matrix_3x3* r = rotations + k;
      // the last ones are filled up to four in a copy, so that there is only one piece of code
      Matrix_3x3 last_covariances[4], last_rotations[4];
      if(size < 4)
      {
        for(std::size_t j = 0; j < 4; ++j)
        {
          last_covariances[j] = c[(std::min)(j, size - 1)];
          last_rotations[j] = r[(std::min)(j, size - 1)];
        }
        c = last_covariances;
        r = last_rotations;
      }
      fit_four(c, r);
      if(size < 4)
        std::copy(last_rotations, last_rotations + size, rotations + k);
    }
  }

private:
  // One more than it takes from where the rotation is anything at all.
  static constexpr int step_limit = 4;

  // Relative to the cube of about the largest eigenvalue: determinants below are taken for zero.
  static constexpr double smallest_determinant = 1e-10;

  struct Matrices
  {
    Double4 entries[9];

    CGAL_ARAP_ALWAYS_INLINE const Double4& operator()(int row, int column) const
    { return entries[3 * row + column]; }
    CGAL_ARAP_ALWAYS_INLINE Double4& operator()(int row, int column)
    { return entries[3 * row + column]; }
  };

  struct Vectors
  {
    Double4 x, y, z;

    friend CGAL_ARAP_ALWAYS_INLINE Double4 dot(const Vectors& a, const Vectors& b)
    { return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z)); }
    friend CGAL_ARAP_ALWAYS_INLINE Vectors scaled(const Double4& a, const Vectors& b)
    { return {a * b.x, a * b.y, a * b.z}; }
    // a b + c
    friend CGAL_ARAP_ALWAYS_INLINE Vectors multiply_add(const Double4& a, const Vectors& b,
                                                        const Vectors& c)
    {
      return {multiply_add(a, b.x, c.x), multiply_add(a, b.y, c.y), multiply_add(a, b.z, c.z)};
    }
  };

  struct Symmetric_matrices
  {
    Double4 xx, yy, zz, yz, xz, xy;

    friend CGAL_ARAP_ALWAYS_INLINE Vectors operator*(const Symmetric_matrices& m, const Vectors& a)
    {
      return {multiply_add(m.xx, a.x, multiply_add(m.xy, a.y, m.xz * a.z)),
              multiply_add(m.xy, a.x, multiply_add(m.yy, a.y, m.yz * a.z)),
              multiply_add(m.xz, a.x, multiply_add(m.yz, a.y, m.zz * a.z))};
    }
    friend CGAL_ARAP_ALWAYS_INLINE Symmetric_matrices adjugate(const Symmetric_matrices& m)
    {
      return {m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy,
              m.xy * m.xz - m.xx * m.yz, m.xy * m.yz - m.yy * m.xz, m.xz * m.yz - m.zz * m.xy};
    }
  };

  // Loops over the matrices would keep the compilers from holding all in registers.
  CGAL_ARAP_ALWAYS_INLINE static Matrices load(const Matrix_3x3* m)
  {
    const double *a = m[0].data(), *b = m[1].data(), *c = m[2].data(), *d = m[3].data();
    Matrices result = {{Double4::load(a), Double4::load(b), Double4::load(c), Double4::load(d),
                        Double4::load(a + 4), Double4::load(b + 4), Double4::load(c + 4),
                        Double4::load(d + 4), Double4::of(a[8], b[8], c[8], d[8])}};
    Double4* e = result.entries;
    transpose(e[0], e[1], e[2], e[3]);
    transpose(e[4], e[5], e[6], e[7]);
    return result;
  }

  CGAL_ARAP_ALWAYS_INLINE static void store(const Matrices& from, Matrix_3x3* m)
  {
    double *a = m[0].data(), *b = m[1].data(), *c = m[2].data(), *d = m[3].data();
    Double4 a0 = from.entries[0], b0 = from.entries[1], c0 = from.entries[2], d0 = from.entries[3];
    Double4 a4 = from.entries[4], b4 = from.entries[5], c4 = from.entries[6], d4 = from.entries[7];
    transpose(a0, b0, c0, d0);
    transpose(a4, b4, c4, d4);
    a0.store(a);
    b0.store(b);
    c0.store(c);
    d0.store(d);
    a4.store(a + 4);
    b4.store(b + 4);
    c4.store(c + 4);
    d4.store(d + 4);
    a[8] = from.entries[8][0];
    b[8] = from.entries[8][1];
    c[8] = from.entries[8][2];
    d[8] = from.entries[8][3];
  }

  CGAL_ARAP_ALWAYS_INLINE static void fit_four(const Matrix_3x3* covariances,
                                               Matrix_3x3* rotations)
  {
    const Matrices c = load(covariances);
    Matrices r = load(rotations);
    make_orthonormal(r);
    Bool4 is_done = step(c, r);
    for(int k = 1; k < step_limit && !are_all(is_done); ++k)
    {
      Matrices next = r;
      const Bool4 is_done_now = step(c, next);
      for(int j = 0; j < 9; ++j)
        r.entries[j] = select(is_done, r.entries[j], next.entries[j]);
      is_done = is_done | is_done_now;
    }
    store(r, rotations);
    if(!are_all(is_done))
      for(int k = 0; k < 4; ++k)
        if(!is_done[k])
          rotations[k] = Svd_rotation::closest(covariances[k]);
  }

  // Rounding errors would add up from call to call. What is no rotation but for them becomes the
  // identity.
  CGAL_ARAP_ALWAYS_INLINE static void make_orthonormal(Matrices& r)
  {
    const Double4 half = Double4::all(0.5), one = Double4::all(1);
    Vectors a = {r(0, 0), r(0, 1), r(0, 2)}, b = {r(1, 0), r(1, 1), r(1, 2)};
    const Double4 error_a = (one - dot(a, a)) * half;
    const Double4 error_b = (one - dot(b, b)) * half;
    const Double4 error_ab = Double4::zero() - half * dot(a, b);
    const Vectors a_old = a;
    a = multiply_add(error_a, a, multiply_add(error_ab, b, a));
    b = multiply_add(error_b, b, multiply_add(error_ab, a_old, b));

    const Double4 bound = Double4::all(1e-8); // its square is far below the rounding errors
    const Bool4 is_rotation = abs(error_a) + abs(error_b) + abs(error_ab) < bound;
    if(!are_all(is_rotation))
    {
      const Double4 zero = Double4::zero();
      a = {select(is_rotation, a.x, one), select(is_rotation, a.y, zero),
           select(is_rotation, a.z, zero)};
      b = {select(is_rotation, b.x, zero), select(is_rotation, b.y, one),
           select(is_rotation, b.z, zero)};
    }
    r = {{a.x, a.y, a.z, b.x, b.y, b.z, a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
          a.x * b.y - a.y * b.x}};
  }

  // replaces r by the rotation closest to c; returns where it is so to full precision
  CGAL_ARAP_ALWAYS_INLINE static Bool4 step(const Matrices& c, Matrices& r)
  {
    Matrices m; // C R^T
    for(int row = 0; row < 3; ++row)
      for(int column = 0; column < 3; ++column)
        m(row, column) = multiply_add(c(row, 0), r(column, 0),
                                      multiply_add(c(row, 1), r(column, 1),
                                                   c(row, 2) * r(column, 2)));
    Vectors a = {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
    const Double4 zero = Double4::zero(), two = Double4::all(2);
    Symmetric_matrices h = {two * (m(1, 1) + m(2, 2)), two * (m(0, 0) + m(2, 2)),
                            two * (m(0, 0) + m(1, 1)), zero - (m(1, 2) + m(2, 1)),
                            zero - (m(0, 2) + m(2, 0)), zero - (m(0, 1) + m(1, 0))};

    // products of four entries must not overflow or underflow
    const Double4 scale = scale_to_one(abs(h.xx) + abs(h.yy) + abs(h.zz) +
                                       (abs(a.x) + abs(a.y) + abs(a.z)));
    a = scaled(scale, a);
    h = {scale * h.xx, scale * h.yy, scale * h.zz, scale * h.yz, scale * h.xz, scale * h.xy};

    // det(H + m I) = m^3 + trace m^2 + minors m + determinant,
    // adj(H + m I) a = m^2 a + m b + g
    const Symmetric_matrices adjugate_h = adjugate(h);
    const Double4 trace = h.xx + h.yy + h.zz;
    const Double4 minors = adjugate_h.xx + adjugate_h.yy + adjugate_h.zz;
    const Double4 determinant = multiply_add(h.xx, adjugate_h.xx,
                                             multiply_add(h.xy, adjugate_h.xy,
                                                          h.xz * adjugate_h.xz));
    const Vectors g = adjugate_h * a, ha = h * a;
    const Vectors b = {trace * a.x - ha.x, trace * a.y - ha.y, trace * a.z - ha.z};
    const Double4 p0 = zero - dot(a, g), p1 = determinant - dot(a, b), p2 = minors - dot(a, a);

    // For small a the series for the root next to zero, from p0 + p1 m + p2 m^2 + p3 m^3 = 0, where
    // p3 is the trace: the relative error is five times the cube of the second factor, `order`.
    const Double4 inverse = Double4::all(1) / p1;
    const Double4 first = (zero - p0) * inverse, u = p2 * inverse;
    const Double4 order = first * minors; // over the determinant
    Double4 root = first - first * first * (u - first * (two * u * u - trace * inverse));

    const Bool4 is_positive_definite = (zero < trace) & (zero < minors) &
                                       (Double4::all(smallest_determinant) < determinant);
    const Bool4 is_close = is_positive_definite & (determinant < two * p1) &
                           (order < Double4::all(0.1) * determinant);
    if(!are_all(is_close))
      root = select(is_close, root, largest_root(p0, p1, p2, trace));

    const Vectors v = multiply_add(root, multiply_add(root, a, b), g);
    const Double4 d = multiply_add(root, multiply_add(root, root + trace, minors), determinant);
    const Double4 v_squared = dot(v, v), d_squared = d * d;
    turn(d, v, two / (d_squared + v_squared), r);
    return is_close & (order < Double4::all(1e-4) * determinant) &
           (v_squared < d_squared * d_squared);
  }

  // Of m^4 + p3 m^3 + p2 m^2 + p1 m + p0, whose roots are real, by Newton's method from above, which
  // does not overshoot. A few digits are enough to go on from.
  CGAL_ARAP_ALWAYS_INLINE static Double4 largest_root(const Double4& p0, const Double4& p1,
                                                      const Double4& p2, const Double4& p3)
  {
    // the mean of the roots, and sqrt(3) times their standard deviation
    const Double4 quarter = Double4::all(0.25), half = Double4::all(0.5);
    const Double4 variance = Double4::all(9. / 16) * p3 * p3 - Double4::all(1.5) * p2;
    Double4 deviation = half * (variance + Double4::all(1)); // above the square root
    for(int k = 0; k < 3; ++k)
      deviation = half * (deviation + variance / deviation);

    Double4 m = deviation - quarter * p3;
    for(int k = 0; k < 8; ++k)
    {
      const Double4 q2 = m + p3, q1 = multiply_add(q2, m, p2), q0 = multiply_add(q1, m, p1);
      const Double4 value = multiply_add(q0, m, p0);
      const Double4 slope = multiply_add(multiply_add(q2 + m, m, q1), m, q0);
      m = m - value / slope;
    }
    return m;
  }

  // replaces R by Q R, where Q = I + f (d [v] + [v]^2) and f = 2 / (d^2 + v^2)
  CGAL_ARAP_ALWAYS_INLINE static void turn(const Double4& d, const Vectors& v, const Double4& f,
                                           Matrices& r)
  {
    const Vectors w = scaled(f, v), s = scaled(d, w);
    const Double4 xx = w.x * v.x, yy = w.y * v.y, zz = w.z * v.z;
    const Double4 xy = w.x * v.y, xz = w.x * v.z, yz = w.y * v.z;
    const Double4 zero = Double4::zero();
    const Matrices q = {{zero - (yy + zz), xy - s.z, xz + s.y,
                         xy + s.z, zero - (xx + zz), yz - s.x,
                         xz - s.y, yz + s.x, zero - (xx + yy)}}; // Q - I
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

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_WIDE_ROTATION_KERNEL_H
