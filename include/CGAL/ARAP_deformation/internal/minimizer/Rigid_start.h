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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_START_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_START_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Parts.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Rigid_fit.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Disjoint_sets.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/Svd_rotation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Starts a run at its minimum where that is known to be zero: where all that constrains a part is a
// rigid copy of the rest shape, the whole part can be one. Any minimizer would need many
// iterations.
class Rigid_start
{
public:
  // `size` is the squared diagonal of the box of what is near free vertices, at rest.
  Rigid_start(const Region& region, double size, const Parts& parts, const Constraints& constraints,
              const Targets& targets)
    : m_region(region), m_rounding(1e-14 * size), m_parts(parts), m_constraints(constraints),
      m_targets(targets), m_motion_of(parts.size(), -1),
      m_frame_of(targets.frames.empty() ? 0 : region.number_of_vertices(), nullptr),
      m_is_set(targets.sets.empty() ? 0 : constraints.rows.size(), false)
  {
    for(const Frame& frame : targets.frames)
      m_frame_of[frame.vertex] = &frame.rotation;
    for(const Targets::Set& set : targets.sets)
      m_is_set[set.row] = true;
  }

  // Moves the parts of x that can be rigid there, and returns for each movable vertex whether it is
  // in one of them. They are moved by as little as possible from the positions x, or if
  // `is_from_rest` from the rest shape. Parts that are twisted by a full turn are at a minimum of
  // their own, and are left as they are. To be called once.
  Array<char> operator()(bool is_from_rest, Array<Coordinates>& x)
  {
    Array<char> is_placed(m_region.number_of_movable_vertices, false);
    for(int part = 0; part < m_parts.size(); ++part)
      if(m_parts.can_be_rigid(part))
        find_motion(part, is_from_rest, x);
    bool is_any_deformed = false;
    for(std::size_t k = 0; k < m_motions.size(); ++k)
      if(m_motions[k].before.squared_error() > tolerance * m_parts.squared_size(m_motions[k].part))
      {
        m_motion_of[m_motions[k].part] = static_cast<int>(k);
        is_any_deformed = true;
      }
    if(is_any_deformed)
      find_twisted_parts(x);
    for(const Motion& motion : m_motions)
      if(!motion.is_twisted)
        for(int v : m_parts.free_vertices(motion.part))
        {
          if(!motion.is_at_rest)
            x[v] = motion.after(motion.before(m_region.rest[v]));
          else if(is_from_rest)
            x[v] = m_region.rest[v];
          is_placed[v] = true;
        }
    return is_placed;
  }

private:
  using Row = Weighted_rows::Row;

  // of squares, relative to that of a part: targets may be rounded to float, again and again
  static constexpr double tolerance = 1e-10;

  // What takes the rest shape of a part to where it is, as good as a rigid motion can, and from
  // there to where the constraints are.
  struct Motion
  {
    int part;
    Rigid_fit before, after;
    bool is_at_rest; // nothing is to be moved
    bool is_twisted = false;
  };

  // Adds the motion of a part if its constraints are those of a rigid copy.
  void find_motion(int part, bool is_from_rest, const Array<Coordinates>& x)
  {
    const double size = m_parts.squared_size(part), tolerated = tolerance * size + m_rounding;
    Array<Coordinates> rest, place; // of what constrains it
    const auto add_frame = [&](int v) { // as three more points, at the last one
      if(v < 0 || m_frame_of.empty() || !m_frame_of[v])
        return;
      const Coordinates p = rest.back(), q = place.back();
      for(std::size_t axis = 0; axis < 3; ++axis)
      {
        Coordinates side = {0, 0, 0};
        side[axis] = std::sqrt(size);
        rest.push_back(p);
        place.push_back(q);
        add(rest.back(), 1, side);
        add(place.back(), 1, product(*m_frame_of[v], side));
      }
    };
    const auto add_constraint = [&](int v, int r, const Coordinates& p, const Coordinates& q) {
      if(r >= 0 && !m_is_set.empty() && m_is_set[r])
        return false;
      rest.push_back(p);
      place.push_back(q);
      add_frame(v);
      return true;
    };
    if(!m_parts.for_each_constraint(part, m_region, m_constraints, m_targets, x, add_constraint) ||
       rest.empty() || !(Rigid_fit(rest, place).squared_error() <= tolerated))
      return;

    Array<Coordinates> free_rest, free_place;
    for(int v : m_parts.free_vertices(part))
    {
      free_rest.push_back(m_region.rest[v]);
      free_place.push_back(is_from_rest ? m_region.rest[v] : x[v]);
    }
    const Rigid_fit before(free_rest, free_place);
    // The second fit is relative to the first: a single target, or targets on a line, leave the
    // rotation undetermined.
    double motion = before.squared_error();
    for(std::size_t k = 0; k < rest.size(); ++k)
    {
      rest[k] = before(rest[k]);
      const Coordinates step = difference(place[k], rest[k]);
      motion = (std::max)(motion, dot(step, step));
    }
    const Rigid_fit after(rest, place);
    const bool is_at_rest = motion < 1e-18 * size;
    if(is_at_rest || after.squared_error() <= (std::min)(tolerated, 1e-4 * motion))
      m_motions.push_back({part, before, after, is_at_rest});
  }

  bool is_deformed(int v) const
  {
    return m_parts.is_free(v) && m_motion_of[m_parts.part_of(v)] >= 0;
  }

  // Whether the cell of each vertex, all simplices there that have free vertices only, is turned by
  // 120 degrees or more, which is any angle, against the motion before of its part.
  Array<char> turned_cells(const Array<Coordinates>& x) const
  {
    Array<Matrix_3x3> covariances(m_region.number_of_movable_vertices, Matrix_3x3{});
    for(int s = 0; s < m_region.number_of_simplices(); ++s)
    {
      const Index_range corners = m_region.corners_of(s);
      if(!std::all_of(corners.begin(), corners.end(), [&](int v) { return is_deformed(v); }))
        continue; // what is fixed has moved
      Matrix_3x3 covariance{};
      int last = *std::prev(corners.end());
      for(int v : corners)
      {
        add_product(covariance, difference(x[v], x[last]),
                    difference(m_region.rest[v], m_region.rest[last]));
        last = v;
      }
      for(int v : corners)
        add(covariances[v], 1, covariance);
    }
    Array<char> is_turned(m_region.number_of_vertices(), false);
    for_each_block(covariances.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v)
        if(covariances[v] != Matrix_3x3{})
        {
          const int motion = m_motion_of[m_parts.part_of(static_cast<int>(v))];
          const Matrix_3x3& whole = m_motions[static_cast<std::size_t>(motion)].before.rotation();
          const Matrix_3x3 cell = Svd_rotation::closest(covariances[v]);
          is_turned[v] = std::inner_product(cell.begin(), cell.end(), whole.begin(), 0.0) <= 0;
        }
    });
    return is_turned;
  }

  // f(begin, end of its vertices, part) for each constraint of a deformed part
  template <typename Function>
  void for_each_constraint(const Function& f) const
  {
    for(const Motion& motion : m_motions)
      if(m_motion_of[motion.part] >= 0)
        for(const int& v : m_parts.fixed_vertices(motion.part))
          f(&v, &v + 1, motion.part);
    m_constraints.for_each_row([&](const Row& row) {
      const auto v = std::find_if(row.begin(), row.end(), [&](int u) { return is_deformed(u); });
      if(v != row.end())
        f(row.begin(), row.end(), m_parts.part_of(*v));
    });
  }

  // Finds the parts that are twisted: cells that are turned keep constraints apart. Where a part is
  // only crumpled, others tie them to each other, or they keep single points apart, which hold no
  // twist.
  void find_twisted_parts(const Array<Coordinates>& x)
  {
    Array<char> is_turned = turned_cells(x);
    for_each_constraint([&](auto begin, auto end, int) {
      for(auto v = begin; v != end; ++v)
        is_turned[*v] = false;
    });
    Disjoint_sets sets(m_region.number_of_vertices());
    for(int s = 0; s < m_region.number_of_simplices(); ++s)
    {
      const auto [begin, end] = m_region.corners_of(s);
      if(std::any_of(begin, end, [&](int v) { return m_parts.is_free(v) && !is_deformed(v); }))
        continue;
      const int* const first = std::find_if(begin, end, [&](int v) { return !is_turned[v]; });
      for(const int* v = first; v != end; ++v)
        if(!is_turned[*v])
          sets.unite(*first, *v);
    }
    m_constraints.for_each_row([&](const Row& row) {
      for(int v : row)
        sets.unite(*row.begin(), v);
    });
    Array<int> count(is_turned.size(), 0);   // for each set, of its constraints
    Array<int> holder(m_parts.size(), -1);   // for each part a set with several constraints
    for_each_constraint([&](auto begin, auto, int part) {
      const auto set = sets.find(*begin);
      if(++count[set] < 2)
        return;
      m_motions[static_cast<std::size_t>(m_motion_of[part])].is_twisted |=
        holder[part] >= 0 && holder[part] != set;
      holder[part] = set;
    });
  }

  const Region& m_region;
  const double m_rounding; // to float, squared, where a part is far from the others
  const Parts& m_parts;
  const Constraints& m_constraints;
  const Targets& m_targets;
  std::vector<Motion> m_motions;
  Array<int> m_motion_of;              // for each part, if it is not rigid before; else -1
  Array<const Matrix_3x3*> m_frame_of; // for each vertex; empty without frames
  Array<char> m_is_set;                // for each soft row; empty without sets
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_START_H
