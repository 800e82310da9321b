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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_MAY_BE_POSITIVE_DEFINITE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_MAY_BE_POSITIVE_DEFINITE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>

#include <Eigen/SparseCore>

namespace CGAL {
namespace ARAP {
namespace internal {

// Whether all entries are finite and those on the diagonal positive, for solvers of others, which
// may not look.
inline bool may_be_positive_definite(const Sparse_matrix& a)
{
  for(int column = 0; column < a.outerSize(); ++column)
  {
    const Sparse_matrix::InnerIterator diagonal(a, column);
    if(!diagonal || diagonal.row() != column || !(diagonal.value() > 0))
      return false;
    for(Sparse_matrix::InnerIterator entry(a, column); entry; ++entry)
      if(!is_finite(entry.value()))
        return false;
  }
  return true;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_MAY_BE_POSITIVE_DEFINITE_H
