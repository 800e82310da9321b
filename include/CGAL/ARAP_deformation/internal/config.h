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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CONFIG_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CONFIG_H

// What the package asks of a program. Each public header includes this first: nothing else gives an
// error before it.

#if __cplusplus < 201703L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 201703L)
#error "CGAL/ARAP_deformation needs C++17: compile with -std=c++17 or later (MSVC: /std:c++17)."
#endif

#ifdef ARAP
#error "CGAL/ARAP_deformation: the macro ARAP is defined; undefine it, it is a namespace here."
#endif

#if !defined(CGAL_ARAP_DEFORMATION_COMPILED) && !__has_include(<Eigen/Core>)
#error "CGAL/ARAP_deformation needs Eigen: link with CGAL::Eigen3_support."
#endif

#if __has_include(<CGAL/version.h>)
#include <CGAL/version.h>
#if CGAL_VERSION_NR < 1050500000
#error "CGAL/ARAP_deformation needs CGAL 5.5 or newer."
#endif
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CONFIG_H
