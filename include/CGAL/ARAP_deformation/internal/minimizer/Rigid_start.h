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
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Rigid_fit.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>
#include <CGAL/ARAP_deformation/internal/region/Disjoint_sets.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/Svd_rotation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Starts a run at its minimum where that is known to be zero: where all that constrains a part of
// the free vertices is a rigid copy of the rest shape, the whole part can be one. Any minimizer
// would need many iterations. Vertices that share cells or rows are in one part.
class Rigid_start
{
public:
  // For each movable vertex `components` has its component, a vertex which all that are tied
  // together share; -1 if it is fixed, and -2 if nothing ties it to free vertices.
  Rigid_start(const Region& region, const Constraints& constraints, const Array<int>& components)
    : m_part(components)
  {
    const int n = region.number_of_movable_vertices;
    const auto is_free = [&](int v) { return v < n && components[v] >= 0; };
    const auto is_constraint = [&](int v) { return v >= n || components[v] == -1; };
    Disjoint_sets sets(n); // of components
    // unites the components of a range, and returns one of them, or -1
    const auto unite = [&](const auto& vertices) {
      const auto first = std::find_if(vertices.begin(), vertices.end(), is_free);
      for(auto v = first; v != vertices.end(); ++v)
        if(is_free(*v) && components[*v] != components[*first])
          sets.unite(components[*v], components[*first]);
      return first == vertices.end() ? -1 : components[*first];
    };
    // All that is in simplices at a vertex, free or not, may share a cell.
    Array<int> around(region.number_of_vertices(), -1); // a component in a simplex there
    for(int s = 0; s < region.number_of_simplices(); ++s)
    {
      const Index_range corners = region.corners_of(s);
      if(const int component = unite(corners); component >= 0)
        for(int v : corners)
        {
          if(around[v] >= 0 && around[v] != component)
            sets.unite(around[v], component);
          around[v] = component;
        }
    }
    constraints.for_each_row([&](const Row& row) { unite(row); });

    int count = 0;
    Array<int> number(n, -1);
    for(int v = 0; v < n; ++v)
      if(components[v] >= 0)
      {
        int& part = number[sets.find(components[v])];
        part = part < 0 ? count++ : part;
        m_part[v] = part;
      }
    Pairs free, fixed, rows; // each with its part
    const auto add_fixed = [&](int part, const auto& vertices) {
      for(int v : vertices)
        if(is_constraint(v))
          fixed.emplace_back(part, v);
    };
    for(int s = 0; s < region.number_of_simplices(); ++s)
    {
      const Index_range corners = region.corners_of(s);
      if(std::any_of(corners.begin(), corners.end(), is_constraint))
        for(int v : corners)
          if(around[v] >= 0) // those at other corners may be of other parts
            add_fixed(m_part[around[v]], corners);
    }
    m_can_be_rigid = Array<char>(count, true);
    int r = 0;
    constraints.for_each_row([&](const Row& row) {
      const auto first = std::find_if(row.begin(), row.end(), is_free);
      if(first != row.end())
      {
        const int part = m_part[*first];
        add_fixed(part, row);
        rows.emplace_back(part, r);
        double excess = -1;
        row.for_each_coefficient([&](int, double b) { excess += b; });
        if(!(std::abs(excess) <= 1e-12 * (std::max)(1.0, row.length)))
          m_can_be_rigid[part] = false; // it is not invariant under translations
      }
      ++r;
    });
    for(int v = 0; v < n; ++v)
      if(m_part[v] >= 0)
        free.emplace_back(m_part[v], v);
    m_free = lists(count, std::move(free));
    m_fixed = lists(count, std::move(fixed));
    m_rows = lists(count, std::move(rows));
    for(int part = 0; part < count; ++part)
    {
      Bounding_box box;
      for(const Index_lists* vertices : {&m_free, &m_fixed})
        for(int v : vertices->list(part))
          box.include(region.rest[v]);
      m_squared_sizes.push_back(box.squared_length());
    }
  }

  int number_of_parts() const { return m_free.size(); }

  // the part of a movable vertex; negative if it is fixed, or if nothing ties it to free ones
  int part_of(int v) const { return m_part[v]; }

  // of the diagonal of the box of a part, and of the fixed vertices that share its cells, at rest
  double squared_size(int part) const { return m_squared_sizes[part]; }

  // Moves the parts of x that can be rigid there, and returns for each movable vertex whether it is
  // in one of them. They are moved by as little as possible from the positions x, or if
  // `is_from_rest` from the rest shape. `size` is the squared diagonal of the box of what is near
  // free vertices, at rest. Parts that are twisted by a full turn are at a minimum of their own,
  // and are left as they are.
  Array<char> operator()(const Region& region, double size, const Constraints& constraints,
                         const Targets& targets, bool is_from_rest,
                         Array<Coordinates>& x) const
  {
    Array<const Matrix_3x3*> frame_of(targets.frames.empty() ? 0 : region.number_of_vertices(),
                                      nullptr);
    for(const Frame& frame : targets.frames)
      frame_of[frame.vertex] = &frame.rotation;
    Array<char> is_set(targets.sets.empty() ? 0 : constraints.rows.size(), false);
    for(const Targets::Set& set : targets.sets)
      is_set[set.row] = true;
    Array<char> is_placed(m_part.size(), false);
    std::vector<Motion> motions;
    Array<int> deformed(m_free.size(), -1); // for each part its motion, if it is not rigid before
    bool is_any_deformed = false;
    for(int part = 0; part < m_free.size(); ++part)
      if(m_can_be_rigid[part])
        find_motion(part, region, size, constraints, targets, is_set, frame_of, is_from_rest, x,
                    motions);
    for(std::size_t k = 0; k < motions.size(); ++k)
      if(motions[k].before.squared_error() > tolerance * size)
      {
        deformed[motions[k].part] = static_cast<int>(k);
        is_any_deformed = true;
      }
    if(is_any_deformed)
      find_twisted_parts(region, constraints, x, deformed, motions);
    for(const Motion& motion : motions)
      if(!motion.is_twisted)
        for(int v : m_free.list(motion.part))
        {
          if(!motion.is_at_rest)
            x[v] = motion.after(motion.before(region.rest[v]));
          else if(is_from_rest)
            x[v] = region.rest[v];
          is_placed[v] = true;
        }
    return is_placed;
  }

private:
  using Pairs = std::vector<std::pair<int, int>>;
  using Row = Weighted_rows::Row;

  // of squares: targets may be rounded to float, again and again
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

  // for each part the second numbers of its pairs
  static Index_lists lists(int count, Pairs pairs)
  {
    if(!std::is_sorted(pairs.begin(), pairs.end()))
      std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return lists_of_pairs(count, [&](const auto& f) {
      for(const auto& pair : pairs)
        f(pair.first, pair.second);
    });
  }

  // Adds the motion of a part if its constraints are those of a rigid copy.
  void find_motion(int part, const Region& region, double size, const Constraints& constraints,
                   const Targets& targets, const Array<char>& is_set,
                   const Array<const Matrix_3x3*>& frame_of, bool is_from_rest,
                   const Array<Coordinates>& x, std::vector<Motion>& motions) const
  {
    Array<Coordinates> rest, place; // of what constrains it
    const auto add_frame = [&](int v) { // as three more points, at the last one
      if(v < 0 || frame_of.empty() || !frame_of[v])
        return;
      const Coordinates p = rest.back(), q = place.back();
      for(std::size_t axis = 0; axis < 3; ++axis)
      {
        Coordinates side = {0, 0, 0};
        side[axis] = std::sqrt(size);
        rest.push_back(p);
        place.push_back(q);
        add(rest.back(), 1, side);
        add(place.back(), 1, product(*frame_of[v], side));
      }
    };
    for(int v : m_fixed.list(part))
    {
      rest.push_back(region.rest[v]);
      place.push_back(x[v]);
      add_frame(v);
    }
    const int number_of_soft = constraints.rows.size();
    for(int r : m_rows.list(part))
    {
      if(r >= number_of_soft)
      {
        rest.push_back(constraints.hard_rows.value(r - number_of_soft, region.rest.data()));
        place.push_back(targets.hard[r - number_of_soft]);
        continue;
      }
      if(!is_set.empty() && is_set[r])
        return;
      rest.push_back(constraints.rows.value(r, region.rest.data()));
      place.push_back(targets.soft[r]);
      add_frame(constraints.rows.position(r));
    }
    if(rest.empty() || !(Rigid_fit(rest, place).squared_error() <= tolerance * size))
      return;

    Array<Coordinates> free_rest, free_place;
    for(int v : m_free.list(part))
    {
      free_rest.push_back(region.rest[v]);
      free_place.push_back(is_from_rest ? region.rest[v] : x[v]);
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
    if(is_at_rest || after.squared_error() <= (std::min)(tolerance * size, 1e-4 * motion))
      motions.push_back({part, before, after, is_at_rest});
  }

  // Finds the parts that are twisted. The cells there, all simplices at a vertex that have free
  // vertices only, are turned by any angle against the motion before, so that those that are turned
  // by 120 degrees or more keep constraints apart. Where a part is only crumpled, others tie them
  // to each other, or they keep single points apart, which hold no twist.
  void find_twisted_parts(const Region& region, const Constraints& constraints,
                          const Array<Coordinates>& x, const Array<int>& deformed,
                          std::vector<Motion>& motions) const
  {
    const int n = static_cast<int>(m_part.size());
    const auto is_free = [&](int v) { return v < n && m_part[v] >= 0; };
    const auto is_deformed = [&](int v) { return is_free(v) && deformed[m_part[v]] >= 0; };
    Array<Matrix_3x3> covariances(n, Matrix_3x3{});
    for(int s = 0; s < region.number_of_simplices(); ++s)
    {
      const Index_range corners = region.corners_of(s);
      if(!std::all_of(corners.begin(), corners.end(), is_deformed)) // what is fixed has moved
        continue;
      Matrix_3x3 covariance{};
      int last = *std::prev(corners.end());
      for(int v : corners)
      {
        add_product(covariance, difference(x[v], x[last]),
                    difference(region.rest[v], region.rest[last]));
        last = v;
      }
      for(int v : corners)
        add(covariances[v], 1, covariance);
    }
    Array<char> is_turned(region.number_of_vertices(), false);
    for_each_block(covariances.size(), [&](std::size_t begin, std::size_t end) {
      for(std::size_t v = begin; v < end; ++v)
        if(covariances[v] != Matrix_3x3{})
        {
          const auto motion = static_cast<std::size_t>(deformed[m_part[v]]);
          const Matrix_3x3& whole = motions[motion].before.rotation();
          const Matrix_3x3 cell = Svd_rotation::closest(covariances[v]);
          is_turned[v] = std::inner_product(cell.begin(), cell.end(), whole.begin(), 0.0) <= 0;
        }
    });
    const auto for_each_constraint = [&](const auto& f) { // f(begin, end of its vertices, part)
      for(const Motion& motion : motions)
        if(deformed[motion.part] >= 0)
          for(const int& v : m_fixed.list(motion.part))
            f(&v, &v + 1, motion.part);
      constraints.for_each_row([&](const Row& row) {
        const auto v = std::find_if(row.begin(), row.end(), is_deformed);
        if(v != row.end())
          f(row.begin(), row.end(), m_part[*v]);
      });
    };
    for_each_constraint([&](auto begin, auto end, int) {
      for(auto v = begin; v != end; ++v)
        is_turned[*v] = false;
    });
    Disjoint_sets sets(region.number_of_vertices());
    for(int s = 0; s < region.number_of_simplices(); ++s)
    {
      const auto [begin, end] = region.corners_of(s);
      if(std::any_of(begin, end, [&](int v) { return is_free(v) && !is_deformed(v); }))
        continue;
      const int* const first = std::find_if(begin, end, [&](int v) { return !is_turned[v]; });
      for(const int* v = first; v != end; ++v)
        if(!is_turned[*v])
          sets.unite(*first, *v);
    }
    constraints.for_each_row([&](const Row& row) {
      for(int v : row)
        sets.unite(*row.begin(), v);
    });
    Array<int> count(is_turned.size(), 0);  // for each set, of its constraints
    Array<int> holder(m_free.size(), -1);   // for each part a set with several constraints
    for_each_constraint([&](auto begin, auto, int part) {
      const auto set = sets.find(*begin);
      if(++count[set] < 2)
        return;
      motions[static_cast<std::size_t>(deformed[part])].is_twisted |=
        holder[part] >= 0 && holder[part] != set;
      holder[part] = set;
    });
  }

  Array<int> m_part;                   // for each movable vertex; negative if it is fixed
  Index_lists m_free, m_fixed, m_rows; // of each part, with the fixed vertices that share its cells
  Array<char> m_can_be_rigid;          // for each part
  Array<double> m_squared_sizes;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_RIGID_START_H
