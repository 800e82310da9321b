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
#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_FILL_REDUCING_ORDER_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_FILL_REDUCING_ORDER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>

#include <Eigen/OrderingMethods>

#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// An ordering of the rows for which the factor of the symmetric matrix has few non-zeros: the row of
// the matrix for each row of the factor.
inline std::vector<int> fill_reducing_order(const Sparse_matrix& a)
{
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(a.selfadjointView<Eigen::Lower>(), order);
  return std::vector<int>(order.indices().data(), order.indices().data() + order.size());
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_FILL_REDUCING_ORDER_H
