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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_CELL_PICKS_H
#define CGAL_ARAP_DEFORMATION_DEMO_CELL_PICKS_H

#include "Command_line.h"
#include "Pick.h"
#include "shape_files.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace CGAL::ARAP::demo {

// Which of some picks has a cell: the last one with its vertex, or with all corners of its simplex.
template <typename Domain>
class Cell_picks
{
public:
  // Throws if a pick has no cell.
  Cell_picks(const std::vector<Pick>& picks, bool is_at_vertices, const Domain& domain,
             const std::vector<Kernel::Point_3>& points)
    : m_domain(domain)
  {
    for(const Pick& pick : picks)
    {
      m_is_picked.emplace_back(points.size());
      for(std::size_t v : pick.vertices(points))
        m_is_picked.back()[v] = true;
      bool has_cell = is_at_vertices;
      for(auto v = domain.vertices().begin(); v != domain.vertices().end() && !has_cell; ++v)
        domain.for_each_incident_simplex(*v, [&](const auto&, const auto& corners) {
          has_cell = has_cell || has_all(m_is_picked.back(), corners);
        });
      if(!has_cell)
        throw std::runtime_error(pick.name() + ": has no cell: none has all its corners there");
    }
  }

  // -1 for none
  int of_vertex(typename Domain::vertex_descriptor v) const
  {
    return last([&](const auto& is_picked) { return is_picked[m_domain.index(v)]; });
  }

  int of_simplex(typename Domain::simplex_descriptor s) const
  {
    return last([&](const auto& is_picked) {
      return has_all(is_picked, m_domain.simplex_vertices(s));
    });
  }

private:
  template <typename Corners>
  bool has_all(const std::vector<bool>& is_picked, const Corners& corners) const
  {
    return std::all_of(corners.begin(), corners.end(),
                       [&](auto v) { return is_picked[m_domain.index(v)]; });
  }

  template <typename Predicate>
  int last(const Predicate& has_cell) const
  {
    int k = static_cast<int>(m_is_picked.size()) - 1;
    while(k >= 0 && !has_cell(m_is_picked[k]))
      --k;
    return k;
  }

  Domain m_domain;
  std::vector<std::vector<bool>> m_is_picked;
};

// Sets the stiffness and the rigid parts.
template <typename Deformation>
void set_cell_values(Deformation& deformation, const Command_line& line,
                     const std::vector<Kernel::Point_3>& points)
{
  using Vertex = typename Deformation::vertex_descriptor;
  using Simplex = typename Deformation::simplex_descriptor;
  const auto& domain = deformation.domain();
  const bool is_at_vertices = line.options.cells.has_vertex_cells();
  const Cell_picks stiff(line.stiff, is_at_vertices, domain, points),
    rigid(line.rigid, is_at_vertices, domain, points);
  const auto value = [stiffness = line.stiffness](int k) { return k < 0 ? 1.0 : stiffness[k]; };
  if(!line.stiff.empty() && is_at_vertices)
    deformation.set_stiffness([=](Vertex v) { return value(stiff.of_vertex(v)); });
  else if(!line.stiff.empty())
    deformation.set_stiffness([=](Simplex s) { return value(stiff.of_simplex(s)); });
  if(!line.rigid.empty() && is_at_vertices)
    deformation.set_groups([rigid](Vertex v) { return rigid.of_vertex(v); });
  else if(!line.rigid.empty())
    deformation.set_groups([rigid](Simplex s) { return rigid.of_simplex(s); });
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_CELL_PICKS_H
