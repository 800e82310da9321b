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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SEQUENTIAL_FIT_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SEQUENTIAL_FIT_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>

#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// The local step of CGAL's SRE_ARAP: cells are fitted one after the other, and the covariance of a
// cell gains a multiple of the sum of the rotations of its neighbors, those of this step where
// they come first. The energy has no term for it.
class Sequential_fit
{
public:
  Sequential_fit() = default; // none

  // the cells in the order in which they are fitted; for each cell its neighbors and the factor
  Sequential_fit(Array<int> order, Index_lists neighbors, Array<double> factors)
    : m_order(std::move(order)), m_neighbors(std::move(neighbors)), m_factors(std::move(factors))
  {}

  bool is_none() const { return m_order.empty(); }
  const Array<int>& order() const { return m_order; }

  void add_covariance(int c, const Array<Matrix_3x3>& rotations,
                      Matrix_3x3& covariance) const
  {
    for(int k = m_neighbors.begin[c]; k < m_neighbors.begin[c + 1]; ++k)
      add(covariance, m_factors[c], rotations[m_neighbors.items[k]]);
  }

private:
  Array<int> m_order;
  Index_lists m_neighbors;
  Array<double> m_factors;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_SEQUENTIAL_FIT_H
