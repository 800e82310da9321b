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

#ifndef CGAL_ARAP_DEFORMATION_TEST_SANITIZER_H
#define CGAL_ARAP_DEFORMATION_TEST_SANITIZER_H

// Defines CGAL_ARAP_TEST_HAS_OWN_MALLOC under a sanitizer that replaces the allocation functions,
// keeps what is freed and reserves terabytes, and CGAL_ARAP_TEST_THREAD_SANITIZER under the one for
// which each loop has threads of its own. clang and g++ tell of them in different ways.

#ifdef __has_feature
#if __has_feature(thread_sanitizer)
#define CGAL_ARAP_TEST_THREAD_SANITIZER
#endif
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
#define CGAL_ARAP_TEST_HAS_OWN_MALLOC
#endif
#endif
#ifdef __SANITIZE_THREAD__
#define CGAL_ARAP_TEST_THREAD_SANITIZER
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(CGAL_ARAP_TEST_THREAD_SANITIZER)
#define CGAL_ARAP_TEST_HAS_OWN_MALLOC
#endif

#endif // CGAL_ARAP_DEFORMATION_TEST_SANITIZER_H
