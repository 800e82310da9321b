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

#ifndef ARAP_DEFORMATION_TEST_SINGLE_PRECISION_SOLVER_H
#define ARAP_DEFORMATION_TEST_SINGLE_PRECISION_SOLVER_H

#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>

// The default solver with its factor in single precision, as a type.
struct Single_precision_solver : CGAL::ARAP::Multifrontal_cholesky_solver
{
  Single_precision_solver()
    : CGAL::ARAP::Multifrontal_cholesky_solver(CGAL::ARAP::Factor_precision::single_precision)
  {}
};

#endif // ARAP_DEFORMATION_TEST_SINGLE_PRECISION_SOLVER_H
