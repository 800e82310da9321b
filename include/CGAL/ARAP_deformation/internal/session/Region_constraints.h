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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_REGION_CONSTRAINTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_REGION_CONSTRAINTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>
#include <CGAL/ARAP_deformation/internal/session/Built_core.h>

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Whose targets the rows of the constraints of a region have, and which controls move nothing.
struct Region_rows
{
  std::vector<std::size_t> controls; // all control vertices, by the places of their entries
  std::vector<int> soft_vertices; // their numbers in the region: the first soft rows
  std::vector<Control_point> soft_points, hard_points; // the next ones, and the hard rows
  // If there is inertia, for each movable vertex its share in the area or volume, or what thin
  // simplices have instead; 0 if it is fixed. Those of the others are the last soft rows.
  Array<double> contents;
  std::vector<std::size_t> isolated_controls; // those without an incident simplex, by index
};

// what a soft row is about
std::string name_of_soft_row(const Region_rows& rows, const Region& region, int row);

// The constraints of a region while they are collected: first those of its movable vertices, then
// those of control points, and inertia last.
class Region_constraints
{
public:
  explicit Region_constraints(Built_core& core);
  ~Region_constraints();

  void fix(int v) { m_constraints.is_fixed[v] = true; }
  void pull(int v, double weight);

  // A control point has corners, by their numbers in the region, with coefficients. Those that are
  // not movable are a constant in its position.
  void fix(Control_point point, const std::vector<int>& corners,
           const std::vector<double>& coefficients);
  void pull(Control_point point, const std::vector<int>& corners,
            const std::vector<double>& coefficients, double weight);

  // Ties all movable vertices that are not fixed to where their inertia takes them, with this
  // weight for a unit of their area or volume.
  void add_inertia(double weight);

  // prepares the core for these constraints, which are gone then
  Outcome prepare(Unconstrained_components unconstrained, unsigned int number_of_threads,
                  Stages& stages);

  Region_rows& rows() { return m_rows; }

private:
  void append(const std::vector<int>& corners, const std::vector<double>& coefficients,
              double weight, Weighted_rows& rows) const;

  Built_core& m_core;
  Constraints m_constraints;
  Region_rows m_rows;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/session/Region_constraints_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_REGION_CONSTRAINTS_H
