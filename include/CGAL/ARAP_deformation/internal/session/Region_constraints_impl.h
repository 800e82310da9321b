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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_REGION_CONSTRAINTS_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_REGION_CONSTRAINTS_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/region/contents.h>
#include <CGAL/ARAP_deformation/internal/session/Region_constraints.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
std::string name_of_soft_row(const Region_rows& rows, const Region& region, int row)
{
  const auto r = static_cast<std::size_t>(row), n = rows.soft_vertices.size();
  return r < n ? vertex_name(region.indices[rows.soft_vertices[r]])
               : control_point_name(rows.soft_points[r - n]);
}

CGAL_ARAP_INLINE_FUNCTION
Region_constraints::Region_constraints(Built_core& core) : m_core(core)
{
  m_constraints.is_fixed = Array<char>(core.core->region().number_of_movable_vertices, false);
}

CGAL_ARAP_INLINE_FUNCTION
Region_constraints::~Region_constraints() = default;

CGAL_ARAP_INLINE_FUNCTION
void Region_constraints::pull(int v, double weight)
{
  m_constraints.rows.append(v, weight);
  m_rows.soft_vertices.push_back(v);
}

CGAL_ARAP_INLINE_FUNCTION
void Region_constraints::fix(Control_point point, const std::vector<int>& corners,
                             const std::vector<double>& coefficients)
{
  append(corners, coefficients, std::numeric_limits<double>::infinity(), m_constraints.hard_rows);
  m_rows.hard_points.push_back(point);
}

CGAL_ARAP_INLINE_FUNCTION
void Region_constraints::pull(Control_point point, const std::vector<int>& corners,
                              const std::vector<double>& coefficients, double weight)
{
  const auto is_free = [this](int v) {
    return m_core.is_movable(v) && !m_constraints.is_fixed[v];
  };
  if(std::none_of(corners.begin(), corners.end(), is_free)) // its pull is constant, and not counted
    return;
  append(corners, coefficients, weight, m_constraints.rows);
  m_rows.soft_points.push_back(point);
}

CGAL_ARAP_INLINE_FUNCTION
void Region_constraints::append(const std::vector<int>& corners,
                                const std::vector<double>& coefficients, double weight,
                                Weighted_rows& rows) const
{
  Array<int> movable_corners;
  Array<double> their_coefficients;
  double squares_elsewhere = 0;
  for(std::size_t k = 0; k < corners.size(); ++k)
    if(m_core.is_movable(corners[k]))
    {
      movable_corners.push_back(corners[k]);
      their_coefficients.push_back(coefficients[k]);
    }
    else
      squares_elsewhere += coefficients[k] * coefficients[k];
  rows.append(movable_corners, their_coefficients, weight, squares_elsewhere);
}

CGAL_ARAP_INLINE_FUNCTION
void Region_constraints::add_inertia(double weight)
{
  Array<double>& contents = m_rows.contents;
  contents = inertia_at_centers(m_core.core->region());
  contents.resize(m_constraints.is_fixed.size());
  for(int v = 0; v < static_cast<int>(contents.size()); ++v)
    if(m_constraints.is_fixed[v] || !(weight * contents[v] > 0))
      contents[v] = 0;
    else
    {
      m_constraints.rows.append(v, weight * contents[v]);
      m_constraints.inertia += weight * contents[v];
    }
}

CGAL_ARAP_INLINE_FUNCTION
Outcome Region_constraints::prepare(Unconstrained_components unconstrained,
                                    unsigned int number_of_threads, Stages& stages)
{
  const Diagnosis diagnosis = m_core.core->set_constraints(
    std::move(m_constraints), unconstrained, number_of_threads, stages);
  if(diagnosis.hard_row >= 0)
    return outcome(diagnosis.status, control_point_name(m_rows.hard_points[
                     static_cast<std::size_t>(diagnosis.hard_row)]));
  return m_core.explain(diagnosis);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_REGION_CONSTRAINTS_IMPL_H
