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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_FILL_REDUCING_ORDER_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_FILL_REDUCING_ORDER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Fill_reducing_ordering.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/cholesky/elimination_tree.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#ifdef CGAL_METIS_ENABLED
#include <metis.h>
#endif

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace CGAL {
namespace ARAP {
namespace internal {

// These return the row of the matrix for each row of the factor.

// Throws std::length_error if the workspace is too large for its indices.
inline Array<int> minimum_degree_order(const Sparse_matrix& a)
{
  const double n = static_cast<double>(a.cols());
  const double entries = 2 * static_cast<double>(a.nonZeros()) - n; // all of the diagonal is stored
  if(1.2 * entries + 2 * n >= (std::numeric_limits<int>::max)()) // Eigen does not check it
    throw std::length_error("CGAL::ARAP: the matrix is too large for a minimum degree ordering");
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(a.selfadjointView<Eigen::Lower>(), order);
  return Array<int>(order.indices().data(), order.indices().data() + order.size());
}

#ifdef CGAL_METIS_ENABLED
// empty if METIS fails
inline Array<int> metis_order(const Sparse_matrix& a)
{
  if(2 * static_cast<std::size_t>(a.nonZeros()) >
     static_cast<std::size_t>((std::min<long long>)((std::numeric_limits<idx_t>::max)(),
                                                    (std::numeric_limits<int>::max)())))
    return {};
  const Index_lists graph = neighbors_of_rows(a);
  if(graph.items.empty()) // METIS does not take a graph without edges
    return {};
  idx_t n = graph.size();
  Array<idx_t> begin(graph.begin.begin(), graph.begin.end()),
               neighbors(graph.items.begin(), graph.items.end()), order(graph.size()),
               position(graph.size());
  if(METIS_NodeND(&n, begin.data(), neighbors.data(), nullptr, nullptr, order.data(),
                  position.data()) != METIS_OK)
    return {};
  return Array<int>(order.begin(), order.end());
}
#endif

// An ordering for which the factor of the symmetric matrix has few entries that are not zero.
inline Array<int> fill_reducing_order(const Sparse_matrix& a, Fill_reducing_ordering ordering)
{
#ifdef CGAL_METIS_ENABLED
  if(ordering == Fill_reducing_ordering::nested_dissection)
    if(Array<int> order = metis_order(a); !order.empty())
      return order;
#endif
  static_cast<void>(ordering);
  return minimum_degree_order(a);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_FILL_REDUCING_ORDER_H
