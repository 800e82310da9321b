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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ROTATION_GROUPS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ROTATION_GROUPS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/rotation/Svd_rotation.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Which cells share a rotation, and which rotations are given and not fitted.
class Rotation_groups
{
public:
  // all cells have rotations of their own
  Rotation_groups() = default;

  // of the cells of each group; one alone shares its rotation with none
  Rotation_groups(Index_lists cells, int number_of_cells)
    : m_cells(std::move(cells)), m_group_of(number_of_cells, none)
  {
    for(int g = 0; g < m_cells.size(); ++g)
      if(const Index_range group = m_cells.list(g); group.size() > 1)
        for(int c : group)
          m_group_of[c] = g;
  }

  // The rotations of some cells; a group has the mean of those of its cells.
  void give(std::vector<std::pair<int, Matrix_3x3>> given)
  {
    m_given = std::move(given);
    if(is_none())
      return;
    Array<Matrix_3x3> sums(m_cells.size(), Matrix_3x3{});
    for(const auto& [c, rotation] : m_given)
      if(const int g = group_of(c); g != none)
        add(sums[g], 1, rotation);
    for(auto& [c, rotation] : m_given)
      if(const int g = group_of(c); g != none)
        rotation = Svd_rotation::closest(sums[g]);
  }

  const std::vector<std::pair<int, Matrix_3x3>>& given() const { return m_given; }

  // whether there are none
  bool is_none() const { return m_cells.size() == 0; }

  // whether a cell has a rotation of its own
  bool is_alone(int c) const { return group_of(c) == none; }

  // the first of the cells that share a rotation with c
  int leader(int c) const { return is_alone(c) ? c : m_cells.list(group_of(c))[0]; }

  // calls f(begin, end) for the cells of each group, in any order
  template <typename Function>
  void for_each_group(const Function& f) const
  {
    constexpr std::size_t block_size = 64;
    const auto n = static_cast<std::size_t>(m_cells.size());
    for_each_block(n, [&](std::size_t first, std::size_t last) {
      for(std::size_t g = first; g < last; ++g)
        if(const Index_range group = m_cells.list(static_cast<int>(g)); group.size() > 1)
          f(group.begin(), group.end());
    }, block_size);
  }

  // calls f for c and all cells that share its rotation
  template <typename Function>
  void for_each_of_group(int c, const Function& f) const
  {
    if(is_alone(c))
      f(c);
    else
      for(int other : m_cells.list(group_of(c)))
        f(other);
  }

  // gives c and all cells that share its rotation this one
  void set(int c, const Matrix_3x3& rotation, Array<Matrix_3x3>& rotations) const
  {
    const Matrix_3x3 copy = rotation; // it may be one of them
    for_each_of_group(c, [&](int cell) { rotations[cell] = copy; });
  }

  // Of the cells that are chosen, those whose rotations are fitted: of each group the leader.
  Array<char> fitted_cells(const Array<char>& is_chosen) const
  {
    Array<char> is_fitted = is_chosen;
    for_each_group([&](const int* begin, const int* end) {
      std::for_each(begin + 1, end, [&](int c) { is_fitted[c] = false; });
    });
    for(const auto& cell : m_given)
      is_fitted[leader(cell.first)] = false;
    return is_fitted;
  }

private:
  static constexpr int none = -1;

  int group_of(int c) const { return m_group_of.empty() ? none : m_group_of[c]; }

  Index_lists m_cells;
  Array<int> m_group_of; // of each cell; empty if there are no groups
  std::vector<std::pair<int, Matrix_3x3>> m_given;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ROTATION_GROUPS_H
