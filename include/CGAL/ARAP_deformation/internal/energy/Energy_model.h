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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ENERGY_MODEL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ENERGY_MODEL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/internal/Array.h>

#include <cstdint>

namespace CGAL {
namespace ARAP {
namespace internal {

// What a user chooses of the energy, but for the weights of edges. The arrays are empty where
// nothing is said; they have a number for each cell of the scheme, at a vertex or a simplex.
struct Energy_model
{
  Cell_scheme cells = Cell_scheme::spokes_and_rims();
  Array<double> stiffness;     // else 1
  Array<std::int64_t> group;   // the cells of a group share a rotation; -1 for those in none
  double bending_length = 0;
  double smoothing_length = 0;
  // If not empty, cells at vertices are fitted in this order, see Sequential_fit; the factor of one
  // with n neighbors is this weight / n.
  Array<int> fit_order;
  double neighbor_weight = 0;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_ENERGY_MODEL_H
