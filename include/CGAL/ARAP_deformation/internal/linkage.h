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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_LINKAGE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_LINKAGE_H

#include <CGAL/license/ARAP_deformation.h>

// The package is header-only by default: X.h includes X_impl.h, whose functions are inline.
// Programs that define CGAL_ARAP_DEFORMATION_COMPILED (the CMake target ARAP_deformation_core does
// so) do without the second, and link with what src/ARAP_deformation/core.cpp compiles once.
#ifdef CGAL_ARAP_DEFORMATION_COMPILED
#define CGAL_ARAP_INLINE_FUNCTION
#else
#define CGAL_ARAP_INLINE_FUNCTION inline
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_LINKAGE_H
