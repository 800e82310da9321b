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

#ifndef CGAL_ARAP_DEFORMATION_TEST_INSTRUCTION_SET_H
#define CGAL_ARAP_DEFORMATION_TEST_INSTRUCTION_SET_H

#include <array>
#include <string>
#include <vector>

// What one translation unit finds: the same code, compiled with other flags.
struct Findings
{
  std::vector<std::array<double, 3>> points; // of a sheet that it deforms
  std::string vector_type;
  int plain_columns;
};

Findings with_baseline();
Findings with_avx2();
Findings without_vector_extensions();

#endif // CGAL_ARAP_DEFORMATION_TEST_INSTRUCTION_SET_H
