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

#ifndef CGAL_ARAP_DEFORMATION_FILL_REDUCING_ORDERING_H
#define CGAL_ARAP_DEFORMATION_FILL_REDUCING_ORDERING_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationSolvers
/// \brief How a Cholesky factorization orders the rows of a matrix, which determines the size of
/// the factor.
enum class Fill_reducing_ordering
{
  /// Approximate minimum degree. The default: the fastest preprocessing.
  minimum_degree,
  /// Nested dissection by METIS, or minimum degree if a solver has no METIS. In large volumes it
  /// pays: with 30,000 vertices the global step takes two thirds of the time, and preprocessing no
  /// longer. For surfaces the ordering takes about four times as long; the factor of a large one is
  /// an eighth to a quarter smaller, and so is the time of each global step: it pays for thousands
  /// of iterations with one set of control vertices.
  ///
  /// While METIS 5.1 works, it handles the signals `SIGTERM` and `SIGABRT` of the process. No other
  /// thread should use METIS then, and a signal that arrives leads to minimum degree.
  nested_dissection
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_FILL_REDUCING_ORDERING_H
