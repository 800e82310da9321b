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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_TRANSFER_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_TRANSFER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The vertices as the kernels read them: a vertex moves by the sum of w (t + a x (p - y)), with the
// translation t and the rotation vector a of a node at y, and its weight w. Fixed ones do not.
struct Coarse_view
{
  const int* nodes;
  const float* weights;
  const std::array<float, 3>* points;
  const char* is_fixed;
  int number_of_vertices;

  CGAL_ARAP_ALWAYS_INLINE bool is_moving(int v) const
  {
    return v < number_of_vertices && !is_fixed[v];
  }

  CGAL_ARAP_ALWAYS_INLINE Double4 point(int v, double last) const
  {
    return Double4::of(points[v][0], points[v][1], points[v][2], last);
  }
};

// a x b of the first three lanes
CGAL_ARAP_ALWAYS_INLINE Double4 cross_product(const Double4& a, const Double4& b)
{
  const Double4 c = multiply_subtract(a, shuffle<1, 2, 0, 3>(b, b), shuffle<1, 2, 0, 3>(a, a) * b);
  return shuffle<1, 2, 0, 3>(c, c);
}

// adds the forces on vertices, and their torques, to those of their nodes
struct Restriction_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Coarse_view& view, int begin, int end,
                                          const Coordinates* forces, Double4* sums)
  {
    for(int v = begin; v < end; ++v)
    {
      const Double4 force = Double4::of(forces[v][0], forces[v][1], forces[v][2]);
      const Double4 torque = cross_product(view.point(v, 0), force);
      const std::ptrdiff_t first = Coarse_space::most_nodes * std::ptrdiff_t(v);
      for(int k = 0; k < Coarse_space::most_nodes; ++k)
      {
        Double4* const sum = sums + 2 * view.nodes[first + k];
        const Double4 w = Double4::all(view.weights[first + k]);
        sum[0] = multiply_add(w, force, sum[0]);
        sum[1] = multiply_add(w, torque, sum[1]);
      }
    }
  }
};

// adds what the motions of nodes make of vertices, about the origin
struct Prolongation_kernel
{
  CGAL_ARAP_ALWAYS_INLINE static void run(const Coarse_view& view, int begin, int end,
                                          const Double4* motions, Coordinates* step)
  {
    for(int v = begin; v < end; ++v)
    {
      if(!view.is_moving(v))
        continue;
      Double4 translation = Double4::zero(), rotation = translation;
      const std::ptrdiff_t first = Coarse_space::most_nodes * std::ptrdiff_t(v);
      for(int k = 0; k < Coarse_space::most_nodes; ++k)
      {
        const Double4* const motion = motions + 2 * view.nodes[first + k];
        const Double4 w = Double4::all(view.weights[first + k]);
        translation = multiply_add(w, motion[0], translation);
        rotation = multiply_add(w, motion[1], rotation);
      }
      const Double4 sum = translation + cross_product(rotation, view.point(v, 0));
      step[v] = {step[v][0] + sum[0], step[v][1] + sum[1], step[v][2] + sum[2]};
    }
  }
};

// The deformations P of the coarse space at some positions, and their transpose.
class Coarse_transfer
{
public:
  explicit Coarse_transfer(Coarse_space space)
    : m_space(std::move(space)),
      m_vertices_of(lists_of_pairs(m_space.number_of_nodes(), [this](const auto& f) {
        for(int v = 0; v < m_space.number_of_vertices(); ++v)
          if(m_space.has_nodes(v))
            f(m_space.nodes(v)[0], v);
      }))
  {}

  const Coarse_space& space() const { return m_space; }

  // the vertices of a group: those that the node of this number is next to
  Index_range vertices_of(int group) const { return m_vertices_of.list(group); }

  // Takes the positions. Fixed vertices do not move, and neither do nodes at them. These, and what
  // has no nodes, may be too far away for single precision.
  void place(const Array<char>& is_fixed, const Array<Coordinates>& x)
  {
    m_is_fixed = is_fixed;
    m_points.assign(is_fixed.size(), {0, 0, 0});
    const Coordinates* origin = nullptr;
    for(int v = 0; v < m_space.number_of_vertices(); ++v)
      if(!is_fixed[v] && m_space.has_nodes(v))
      {
        origin = origin ? origin : &x[v];
        for(std::size_t k = 0; k < 3; ++k)
          m_points[v][k] = static_cast<float>(x[v][k] - (*origin)[k]);
      }
  }

  bool is_fixed(int node) const { return m_is_fixed[m_space.vertex_of(node)] != 0; }
  Double4 origin(int node) const { return view().point(m_space.vertex_of(node), 0); }

  // P^T f, for forces at the movable vertices, which are zero at fixed ones: the force and the
  // torque of each node
  Array<Coordinates> restricted(const Array<Coordinates>& force) const
  {
    // so many sums of each node, in parallel, that they cost little beside the vertices
    constexpr std::size_t most_parts = 16;
    const std::size_t n = m_points.size(), m = static_cast<std::size_t>(m_space.number_of_nodes());
    const std::size_t part_size = (std::max)(default_block_size, n / most_parts + 1);
    std::vector<Double4> sums(2 * m * (n / part_size + 1), Double4::zero());
    for_each_block(n, [&](std::size_t begin, std::size_t end) {
      run_kernel<Restriction_kernel>(view(), static_cast<int>(begin), static_cast<int>(end),
                                     force.data(), sums.data() + 2 * m * (begin / part_size));
    }, part_size);
    Array<Coordinates> result(2 * m, Coordinates{0, 0, 0});
    for(std::size_t node = 0; node < m; ++node)
    {
      if(is_fixed(static_cast<int>(node)))
        continue;
      Double4 f = Double4::zero(), torque = f;
      for(std::size_t k = 2 * node; k < sums.size(); k += 2 * m)
      {
        f = f + sums[k];
        torque = torque + sums[k + 1];
      }
      torque = torque - cross_product(origin(static_cast<int>(node)), f);
      result[2 * node] = {f[0], f[1], f[2]};
      result[2 * node + 1] = {torque[0], torque[1], torque[2]};
    }
    return result;
  }

  // adds P u, with the translation and the rotation vector of each node, zero for a fixed one
  void add_prolonged(const Array<Coordinates>& u, Array<Coordinates>& step) const
  {
    std::vector<Double4> motions(u.size());
    for(std::size_t k = 0; k < u.size(); k += 2)
    {
      const Coordinates &t = u[k], &a = u[k + 1];
      motions[k + 1] = Double4::of(a[0], a[1], a[2]);
      motions[k] = Double4::of(t[0], t[1], t[2]) -
                   cross_product(motions[k + 1], origin(static_cast<int>(k / 2)));
    }
    for_each_block(m_points.size(), [&](std::size_t begin, std::size_t end) {
      run_kernel<Prolongation_kernel>(view(), static_cast<int>(begin), static_cast<int>(end),
                                      motions.data(), step.data());
    });
  }

  Coarse_view view() const
  {
    return {m_space.nodes(0), m_space.weights(0), m_points.data(), m_is_fixed.data(),
            m_space.number_of_vertices()};
  }

private:
  Coarse_space m_space;
  Index_lists m_vertices_of; // each group
  Array<char> m_is_fixed;    // for each vertex
  // Relative to one that moves. Single precision saves memory: P is what it makes of them.
  Array<std::array<float, 3>> m_points;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_TRANSFER_H
