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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_PARTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_PARTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/region/Bounding_box.h>
#include <CGAL/ARAP_deformation/internal/region/Disjoint_sets.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// The parts into which free vertices fall, each with what constrains it: vertices that share cells
// or rows are in one part.
class Parts
{
public:
  // For each movable vertex `components` has its component, a vertex which all that are tied
  // together share; -1 if it is fixed, and -2 if nothing ties it to free vertices.
  Parts(const Region& region, const Constraints& constraints, const Array<int>& components)
    : m_part(components)
  {
    // All that is in simplices at a vertex, free or not, may share a cell.
    Array<int> around(region.number_of_vertices(), -1); // a free vertex in a simplex there
    number_parts(region, constraints, around);
    collect_vertices(region, constraints, around);
    for(int part = 0; part < size(); ++part)
    {
      Bounding_box box;
      for(const Index_lists* vertices : {&m_free, &m_fixed})
        for(int v : vertices->list(part))
          box.include(region.rest[v]);
      m_squared_sizes.push_back(box.squared_length());
    }
  }

  int size() const { return m_free.size(); }

  // whether a vertex of the region is movable, not fixed, and tied to others that are
  bool is_free(int v) const { return v < static_cast<int>(m_part.size()) && m_part[v] >= 0; }

  // the part of a movable vertex; negative if it is not free
  int part_of(int v) const { return m_part[v]; }

  Index_range free_vertices(int part) const { return m_free.list(part); }
  Index_range fixed_vertices(int part) const { return m_fixed.list(part); } // that share its cells
  Index_range rows(int part) const { return m_rows.list(part); } // soft ones, then hard ones

  // Calls f(v, r, rest, place) for all that constrains a part until it returns false: fixed
  // vertices, which are at x, and rows, which have targets. v is the vertex, or the one whose
  // position a soft row r is; both may be -1. Returns whether f never did.
  template <typename Function>
  bool for_each_constraint(int part, const Region& region, const Constraints& constraints,
                           const Targets& targets, const Array<Coordinates>& x,
                           const Function& f) const
  {
    for(int v : fixed_vertices(part))
      if(!f(v, -1, region.rest[v], x[v]))
        return false;
    const Weighted_rows &soft = constraints.rows, &hard = constraints.hard_rows;
    const Coordinates* const rest = region.rest.data();
    for(int r : rows(part))
    {
      const int h = r - soft.size();
      if(!(h < 0 ? f(soft.position(r), r, soft.value(r, rest), targets.soft[r])
                 : f(-1, -1, hard.value(h, rest), targets.hard[h])))
        return false;
    }
    return true;
  }

  // whether its rows are invariant under translations, as its energy is
  bool can_be_rigid(int part) const { return m_can_be_rigid[part]; }

  // of the diagonal of the box of a part, and of the fixed vertices that share its cells, at rest
  double squared_size(int part) const { return m_squared_sizes[part]; }

private:
  using Pairs = std::vector<std::pair<int, int>>;
  using Row = Weighted_rows::Row;

  bool is_constraint(int v) const
  {
    return v >= static_cast<int>(m_part.size()) || m_part[v] == -1;
  }

  // Replaces the component of each vertex by the number of its part.
  void number_parts(const Region& region, const Constraints& constraints, Array<int>& around)
  {
    Disjoint_sets sets(region.number_of_movable_vertices); // of components
    // unites the components of a range, and returns a vertex of them, or -1
    const auto unite = [&](const auto& vertices) {
      int first = -1;
      for(int v : vertices)
        if(is_free(v) && first < 0)
          first = v;
        else if(is_free(v) && m_part[v] != m_part[first])
          sets.unite(m_part[v], m_part[first]);
      return first;
    };
    for(int s = 0; s < region.number_of_simplices(); ++s)
    {
      const Index_range corners = region.corners_of(s);
      if(const int first = unite(corners); first >= 0)
        for(int v : corners)
        {
          if(around[v] >= 0 && m_part[around[v]] != m_part[first])
            sets.unite(m_part[around[v]], m_part[first]);
          around[v] = first;
        }
    }
    constraints.for_each_row([&](const Row& row) { unite(row); });

    int count = 0;
    Array<int> number(m_part.size(), -1);
    for(int& part : m_part)
      if(part >= 0)
      {
        int& of_set = number[sets.find(part)];
        of_set = of_set < 0 ? count++ : of_set;
        part = of_set;
      }
    m_can_be_rigid = Array<char>(count, true);
  }

  void collect_vertices(const Region& region, const Constraints& constraints,
                        const Array<int>& around)
  {
    Pairs free, fixed, rows; // each with its part
    const auto add_fixed = [&](int part, const auto& vertices) {
      for(int v : vertices)
        if(is_constraint(v))
          fixed.emplace_back(part, v);
    };
    for(int s = 0; s < region.number_of_simplices(); ++s)
    {
      const Index_range corners = region.corners_of(s);
      if(std::any_of(corners.begin(), corners.end(), [&](int v) { return is_constraint(v); }))
      {
        int last = -1; // those at other corners may be of other parts
        for(int v : corners)
          if(around[v] >= 0 && m_part[around[v]] != last)
          {
            last = m_part[around[v]];
            add_fixed(last, corners);
          }
      }
    }
    int r = 0;
    constraints.for_each_row([&](const Row& row) {
      const auto first = std::find_if(row.begin(), row.end(), [&](int v) { return is_free(v); });
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
    for(int v = 0; v < region.number_of_movable_vertices; ++v)
      if(m_part[v] >= 0)
        free.emplace_back(m_part[v], v);
    m_free = lists(std::move(free));
    m_fixed = lists(std::move(fixed));
    m_rows = lists(std::move(rows));
  }

  // for each part the second numbers of its pairs
  Index_lists lists(Pairs pairs) const
  {
    if(!std::is_sorted(pairs.begin(), pairs.end()))
      std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return lists_of_pairs(static_cast<int>(m_can_be_rigid.size()), [&](const auto& f) {
      for(const auto& pair : pairs)
        f(pair.first, pair.second);
    });
  }

  Array<int> m_part;                   // for each movable vertex; negative if it is fixed
  Index_lists m_free, m_fixed, m_rows; // of each part
  Array<char> m_can_be_rigid;          // for each part
  Array<double> m_squared_sizes;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_PARTS_H
