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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_QUASI_NEWTON_MEMORY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_QUASI_NEWTON_MEMORY_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Coarse_pairs.h>
#include <CGAL/ARAP_deformation/internal/parallel/largest_entry.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>
#include <CGAL/ARAP_deformation/internal/simd/vector_kernels.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The last steps of the quasi-Newton method L-BFGS, and the next step that follows from them. With
// f minus half the gradient, L the Laplacian and d = L^-1 f the step of local/global, a step s
// changes f by some -y and d by some -z, and z = L^-1 y: L-BFGS with a multiple of L^-1 for its
// initial inverse Hessian needs no solution of a system but the d of each iterate. All dot products
// are of an s or a z with an f; one with a y is the difference of two. A coarse metric completes
// L^-1, and d and z, by parts that are kept apart.
//
// The pairs (s, z) are kept in single precision, in a unit that no mesh can make too small or too
// large for it. This disturbs the step a little, which need not be exact, and saves half the memory
// and half the time to read it.
class Quasi_newton_memory
{
public:
  // the number of pairs: more save few iterations, and cost time and memory
  static constexpr std::size_t capacity = 6;

  explicit Quasi_newton_memory(std::size_t number_of_vertices)
    : m_length(3 * number_of_vertices), m_coarse(capacity)
  {}

  bool is_empty() const { return m_number_of_pairs == 0; }
  bool has_coarse_metric() const { return m_coarse.is_active(); }

  // The next force, to be told before remember() and move(). False if the coarse metric fails.
  bool set_next_force(const Array<Coordinates>& force)
  {
    return m_coarse.set_next_force(force);
  }

  // Takes another coarse metric, or none, for the next force. Forgets all pairs: their z are those
  // of the metric before, and to keep them saves no iterations.
  bool set_coarse_metric(Coarse_metric* metric, const Array<Coordinates>& force)
  {
    if(!metric && !has_coarse_metric())
      return true;
    m_number_of_pairs = 0;
    m_trust = 1;
    m_coarse.set_metric(metric);
    return set_next_force(force);
  }

  // s y / y M^-1 y of the last move, with the metric M: far below 1 where the coarse metric was
  // made at other rotations, and takes for soft what was soft only there. 1 before the first move.
  double trust() const { return m_trust; }

  // Adds to x the step p to the minimum of the model of the energy, after `before` has become a
  // copy of x; both as far as d reaches. Returns the dot product f p: the model decreases by that
  // much, and the energy at first at twice that rate.
  double move(const Array<Coordinates>& force, const Array<Coordinates>& d,
              Array<Coordinates>& x, Array<Coordinates>& before)
  {
    if(m_unit == 0)
      m_unit = unit(d);
    m_coarse.take_next_force();
    const Coefficients c = coefficients();
    const Array<Coordinates> coarse_step =
      m_coarse.step(m_length / 3, c.of_d, slots_in_use(), c.of_z);
    m_next = m_number_of_pairs < capacity ? unused_slot() : m_order[0];
    std::vector<float>& s = m_slots[m_next].s;
    s.resize(m_length);
    const Move_sums sums = sum_over_blocks(m_length, [&](std::size_t begin, std::size_t end) {
      const std::size_t n = end - begin;
      const double *f_begin = entries(force) + begin, *d_begin = entries(d) + begin;
      double *x_begin = entries(x) + begin, *before_begin = entries(before) + begin;
      std::array<double, block_size> p;
      for(std::size_t k = 0; k < n; ++k)
        p[k] = c.of_d * d_begin[k] + (coarse_step.empty() ? 0 : entries(coarse_step)[begin + k]);
      for(std::size_t i = 0; i < m_number_of_pairs; ++i)
      {
        const Slot& slot = m_slots[m_order[i]];
        run_kernel<Add_multiple>(c.of_s[i], slot.s.data() + begin, n, p.data());
        run_kernel<Add_multiple>(c.of_z[i], slot.z.data() + begin, n, p.data());
      }
      Move_sums block;
      for(std::size_t k = 0; k < n; ++k)
      {
        block.fp += f_begin[k] * p[k];
        block.fd += f_begin[k] * d_begin[k];
        before_begin[k] = x_begin[k];
        x_begin[k] += p[k];
        s[begin + k] = static_cast<float>(p[k] / m_unit);
        block.longest = (std::max)(block.longest, std::abs(s[begin + k]));
      }
      return block;
    }, block_size);
    if(m_number_of_pairs == capacity) // the oldest has been overwritten
    {
      std::copy(m_order.begin() + 1, m_order.end(), m_order.begin());
      --m_number_of_pairs;
    }
    m_slope = sums.fp;
    m_d_slope = sums.fd;
    m_longest_shift = m_unit * sums.longest;
    return sums.fp;
  }

  // Whether the last move() went further than any has to, given the diameter of all positions: the
  // model does not see where a part goes that has hardly any weight.
  bool went_too_far(double diameter) const { return !(m_longest_shift <= diameter); }

  // Instead of the last move(), makes the one by p = d, and forgets all pairs.
  double move_by(const Array<Coordinates>& d, const Array<Coordinates>& before,
                 Array<Coordinates>& x)
  {
    std::vector<float>& s = m_slots[m_next].s;
    for_each_block(m_length, [&](std::size_t begin, std::size_t end) {
      for(std::size_t k = begin; k < end; ++k)
      {
        entries(x)[k] = entries(before)[k] + entries(d)[k];
        s[k] = static_cast<float>(entries(d)[k] / m_unit);
      }
    }, block_size);
    m_number_of_pairs = 0;
    m_trust = 1;
    m_longest_shift = largest_entry(d.data(), d.size());
    m_slope = m_d_slope;
    return m_slope;
  }

  // the dot product f p for another f and the p of the last move
  double slope(const Array<Coordinates>& force) const
  {
    return m_unit * sum_over_blocks(m_length, [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      run_kernel<Add_dot_product>(entries(force) + begin, m_slots[m_next].s.data() + begin,
                                  end - begin, &sum);
      return sum;
    }, block_size);
  }

  // Remembers the last move, which was shortened to t p, led to the given force, and changed d to
  // `new_d`; not if the energy is not convex along it, or rounding has made the change of force:
  // `force_error` is the rounding error of the force at a vertex.
  void remember(double t, const Array<Coordinates>& force, const Array<Coordinates>& d,
                const Array<Coordinates>& new_d, double diameter, double force_error)
  {
    Slot& next = m_slots[m_next];
    next.z.resize(m_length);
    m_order[m_number_of_pairs] = m_next;
    const Sums sums = sum_over_blocks(m_length, [&](std::size_t begin, std::size_t end) {
      const std::size_t n = end - begin;
      const double *f_begin = entries(force) + begin, *d_begin = entries(d) + begin,
                   *new_d_begin = entries(new_d) + begin;
      Sums block;
      for(std::size_t k = 0; k < n; ++k)
      {
        next.s[begin + k] = static_cast<float>(t * next.s[begin + k]);
        next.z[begin + k] = static_cast<float>((d_begin[k] - new_d_begin[k]) / m_unit);
        block.fd += f_begin[k] * d_begin[k];
        block.ss += double(next.s[begin + k]) * next.s[begin + k];
      }
      for(std::size_t i = 0; i <= m_number_of_pairs; ++i)
      {
        const Slot& slot = m_slots[m_order[i]];
        run_kernel<Add_dot_product>(f_begin, slot.s.data() + begin, n, &block.fs[i]);
        run_kernel<Add_dot_product>(f_begin, slot.z.data() + begin, n, &block.fz[i]);
      }
      return block;
    }, block_size);

    next.fs = t * m_slope / m_unit;
    next.fz = (m_d_slope - sums.fd) / m_unit; // new_d times the old f is d times the new f
    for(std::size_t i = 0; i <= m_number_of_pairs; ++i)
    {
      Slot& slot = m_slots[m_order[i]];
      slot.sy[m_next] = (slot.fs - sums.fs[i]) / m_unit;
      slot.zy[m_next] = next.zy[m_order[i]] = (slot.fz - sums.fz[i]) / m_unit;
      slot.fs = sums.fs[i];
      slot.fz = sums.fz[i];
    }
    m_coarse.remember(m_next, m_unit);
    const double own_zy = next.zy[m_next] + m_coarse.zy(m_next, m_next);
    m_trust = next.sy[m_next] / own_zy;
    // Where the energy is convex and its rotations are free, L bounds its curvature, and s y is at
    // least z y, or not much less with a coarse metric. Far less than that is rounding, or not
    // convex. A long step may change the force by rounding errors only: a part that almost nothing
    // ties would then move far away, to where these errors happen to vanish.
    const double least = t * m_longest_shift > 1e-8 * diameter
                       ? force_error / m_unit * std::sqrt(sums.ss) : 0;
    if(own_zy > 0 && next.sy[m_next] > (std::max)(0.1 * own_zy, least))
      ++m_number_of_pairs;
  }

private:
  static constexpr std::size_t block_size = 2048;

  // All that is of s or z is divided by m_unit, and y as well: then the method is the same.
  struct Slot
  {
    std::vector<float> s, z;
    double fs = 0, fz = 0;              // products of the present f with s and z
    std::array<double, capacity> sy{}; // of s with the y of each slot that is not older
    std::array<double, capacity> zy{}; // of z with the y of each slot
  };

  struct Coefficients
  {
    double of_d = 1;
    std::array<double, capacity> of_s, of_z; // from the oldest to the newest
  };

  struct Move_sums
  {
    double fp = 0, fd = 0;
    float longest = 0;

    friend Move_sums operator+(const Move_sums& a, const Move_sums& b)
    {
      return {a.fp + b.fp, a.fd + b.fd, (std::max)(a.longest, b.longest)};
    }
  };

  struct Sums
  {
    double fd = 0, ss = 0;
    std::array<double, capacity> fs{}, fz{};

    friend Sums operator+(Sums a, const Sums& b)
    {
      a.fd += b.fd;
      a.ss += b.ss;
      for(std::size_t i = 0; i < capacity; ++i)
      {
        a.fs[i] += b.fs[i];
        a.fz[i] += b.fz[i];
      }
      return a;
    }
  };

  static double* entries(Array<Coordinates>& points) { return points.data()->data(); }
  static const double* entries(const Array<Coordinates>& points)
  {
    return points.data()->data();
  }

  static double unit(const Array<Coordinates>& d)
  {
    const double largest = largest_entry(d.data(), d.size());
    return largest > 0 && is_finite(largest) ? largest : 1;
  }

  // from the oldest to the newest
  std::vector<std::size_t> slots_in_use() const
  {
    return {m_order.begin(), m_order.begin() + static_cast<std::ptrdiff_t>(m_number_of_pairs)};
  }

  // of the i-th and the j-th pair, with their coarse parts
  double fz(std::size_t i) const { return m_slots[m_order[i]].fz + m_coarse.fz(m_order[i]); }
  double zy(std::size_t i, std::size_t j) const
  {
    return m_slots[m_order[i]].zy[m_order[j]] + m_coarse.zy(m_order[i], m_order[j]);
  }

  std::size_t unused_slot() const
  {
    const auto end = m_order.data() + m_number_of_pairs;
    std::size_t slot = 0;
    while(std::find(m_order.data(), end, slot) != end)
      ++slot;
    return slot;
  }

  // The two-loop recursion of L-BFGS, on what the step is combined of instead of on vectors.
  Coefficients coefficients() const
  {
    Coefficients c;
    const std::size_t m = m_number_of_pairs;
    if(m == 0)
      return c;
    // The ratio is that of the mix of modes in the last step. The modes that converge last are
    // softer, and overshooting in the others costs less than falling short in these: so more than
    // the ratio is taken. After a run of local/global it can exceed a hundred, and would make the
    // stiff modes explode: so it is bounded.
    const double ratio = m_slots[m_order[m - 1]].sy[m_order[m - 1]] / zy(m - 1, m - 1);
    c.of_d = (std::max)(1.0, (std::min)(3.0, 1.5 * ratio));

    std::array<double, capacity> alpha;
    for(std::size_t i = m; i-- > 0;)
    {
      const Slot& slot = m_slots[m_order[i]];
      double sq = slot.fs;
      for(std::size_t j = i + 1; j < m; ++j)
        sq -= alpha[j] * slot.sy[m_order[j]];
      alpha[i] = sq / slot.sy[m_order[i]];
      c.of_z[i] = -c.of_d * alpha[i];
    }
    for(std::size_t i = 0; i < m; ++i)
    {
      const Slot& slot = m_slots[m_order[i]];
      double yp = c.of_d * fz(i);
      for(std::size_t j = 0; j < m; ++j)
        yp += c.of_z[j] * zy(i, j);
      for(std::size_t j = 0; j < i; ++j)
        yp += c.of_s[j] * m_slots[m_order[j]].sy[m_order[i]];
      c.of_s[i] = alpha[i] - yp / slot.sy[m_order[i]];
    }
    return c;
  }

  std::size_t m_length; // of the vectors
  Coarse_pairs m_coarse;
  double m_unit = 0;    // 0: not yet known
  std::array<Slot, capacity> m_slots;
  std::array<std::size_t, capacity> m_order{}; // the slots of the pairs, the oldest one first
  std::size_t m_number_of_pairs = 0;
  std::size_t m_next = 0;            // the slot of the last move
  double m_slope = 0, m_d_slope = 0; // f p and f d at the last move
  double m_longest_shift = 0; // of a coordinate, by the last move
  double m_trust = 1;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_QUASI_NEWTON_MEMORY_H
