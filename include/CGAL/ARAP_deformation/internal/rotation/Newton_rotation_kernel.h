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
#include <CGAL/ARAP_deformation/internal/simd/Double8.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace ARAP {
namespace internal {

// The rotations closest to matrices C, four or eight at a time, from rotations R that are about
// right.
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
// The lanes do not know of each other: what is computed in one is the same whatever the others
// hold.
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
      // the last ones are filled up in a copy, so that there is only one piece of code
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

  // The first step goes near the result from anywhere but half a turn away, the second one to it.
  static constexpr int step_limit = 4;

  // Determinants of H, scaled to about one, that are smaller are taken for zero.
  static constexpr double smallest_determinant = 1e-10;

  // row by row
  template <typename Entry>
  struct Matrices_of
  {
    Entry entries[9];

    CGAL_ARAP_ALWAYS_INLINE const Entry& operator()(int row, int column) const
    { return entries[3 * row + column]; }
    CGAL_ARAP_ALWAYS_INLINE Entry& operator()(int row, int column)
    { return entries[3 * row + column]; }
  };

  using Matrices = Matrices_of<Number>;

  struct Vectors
  {
    Number x, y, z;

    friend CGAL_ARAP_ALWAYS_INLINE Number dot(const Vectors& a, const Vectors& b)
    { return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z)); }
    friend CGAL_ARAP_ALWAYS_INLINE Vectors scaled(const Number& a, const Vectors& b)
    { return {a * b.x, a * b.y, a * b.z}; }
    // a b + c
    friend CGAL_ARAP_ALWAYS_INLINE Vectors multiply_add(const Number& a, const Vectors& b,
                                                        const Vectors& c)
    { return {multiply_add(a, b.x, c.x), multiply_add(a, b.y, c.y), multiply_add(a, b.z, c.z)}; }
  };

  struct Symmetric_matrices
  {
    Number xx, yy, zz, yz, xz, xy;

    friend CGAL_ARAP_ALWAYS_INLINE Vectors operator*(const Symmetric_matrices& m, const Vectors& a)
    {
      return {multiply_add(m.xx, a.x, multiply_add(m.xy, a.y, m.xz * a.z)),
              multiply_add(m.xy, a.x, multiply_add(m.yy, a.y, m.yz * a.z)),
              multiply_add(m.xz, a.x, multiply_add(m.yz, a.y, m.zz * a.z))};
    }
    friend CGAL_ARAP_ALWAYS_INLINE Symmetric_matrices adjugate(const Symmetric_matrices& m)
    {
      return {multiply_subtract(m.yy, m.zz, m.yz * m.yz),
              multiply_subtract(m.xx, m.zz, m.xz * m.xz),
              multiply_subtract(m.xx, m.yy, m.xy * m.xy),
              multiply_subtract(m.xy, m.xz, m.xx * m.yz),
              multiply_subtract(m.xy, m.yz, m.yy * m.xz),
              multiply_subtract(m.xz, m.yz, m.zz * m.xy)};
    }
  };

  // No loop over the matrices: the compilers would not hold them in registers.
  CGAL_ARAP_ALWAYS_INLINE static Matrices_of<Double4> load_four(const Matrix_3x3* m)
  {
    const double *a = m[0].data(), *b = m[1].data(), *c = m[2].data(), *d = m[3].data();
    Matrices_of<Double4> result =
      {{Double4::load(a), Double4::load(b), Double4::load(c), Double4::load(d),
        Double4::load(a + 4), Double4::load(b + 4), Double4::load(c + 4), Double4::load(d + 4),
        Double4::of(a[8], b[8], c[8], d[8])}};
    Double4* e = result.entries;
    transpose(e[0], e[1], e[2], e[3]);
    transpose(e[4], e[5], e[6], e[7]);
    return result;
  }

  CGAL_ARAP_ALWAYS_INLINE static void store_four(const Matrices_of<Double4>& from, Matrix_3x3* m)
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

  CGAL_ARAP_ALWAYS_INLINE static Matrices load(const Matrix_3x3* m)
  {
    const Matrices_of<Double4> low = load_four(m);
    if constexpr(width == 4)
      return low;
    else
    {
      const Matrices_of<Double4> high = load_four(m + 4);
      Matrices result;
      for(int k = 0; k < 9; ++k)
        result.entries[k] = {low.entries[k], high.entries[k]};
      return result;
    }
  }

  CGAL_ARAP_ALWAYS_INLINE static void store(const Matrices& from, Matrix_3x3* m)
  {
    if constexpr(width == 4)
      store_four(from, m);
    else
    {
      Matrices_of<Double4> low, high;
      for(int k = 0; k < 9; ++k)
      {
        low.entries[k] = from.entries[k].low;
        high.entries[k] = from.entries[k].high;
      }
      store_four(low, m);
      store_four(high, m + 4);
    }
  }

  CGAL_ARAP_ALWAYS_INLINE static void fit(const Matrix_3x3* covariances, Matrix_3x3* rotations)
  {
    const Matrices c = load(covariances);
    Matrices r = load(rotations);
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
    store(r, rotations);
    if(!are_all(is_done))
      for(int k = 0; k < static_cast<int>(width); ++k)
        if(!is_done[k])
          rotations[k] = Svd_rotation::closest(covariances[k]);
  }

  // Rounding errors would add up from call to call. What is no rotation but for them becomes the
  // identity. The third row is not looked at, but computed from the others.
  CGAL_ARAP_ALWAYS_INLINE static void make_orthonormal(Matrices& r)
  {
    const Number zero = Number::zero(), half = Number::all(0.5), one = Number::all(1);
    Vectors a = {r(0, 0), r(0, 1), r(0, 2)}, b = {r(1, 0), r(1, 1), r(1, 2)};
    const Number error_a = half - half * dot(a, a), error_b = half - half * dot(b, b);
    const Number error_ab = Number::all(-0.5) * dot(a, b);
    const Vectors a_old = a;
    a = multiply_add(error_a, a, multiply_add(error_ab, b, a));
    b = multiply_add(error_b, b, multiply_add(error_ab, a_old, b));

    // what is left is of the order of the squares
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

  // replaces r by the rotation closest to c; returns where it is so to full precision
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

    // scaled, or products of four entries could overflow or underflow
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
  // does not overshoot. A few digits are enough to go on from.
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
