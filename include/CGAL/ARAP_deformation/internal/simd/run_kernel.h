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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_RUN_KERNEL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_RUN_KERNEL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

// Whether there is something to choose at run time: x86 that is not compiled for AVX2 anyway.
// (On Windows, g++ does not align the stack for it.)
#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS) && defined(__x86_64__) && !defined(_WIN32) && \
    !(defined(__AVX2__) && defined(__FMA__))
#define CGAL_ARAP_HAS_DISPATCH
#endif

namespace CGAL {
namespace ARAP {
namespace internal {

#ifdef CGAL_ARAP_HAS_DISPATCH
inline bool has_avx2()
{
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}

template <typename Kernel, typename... Arguments>
__attribute__((target("avx2,fma"))) void run_with_avx2(const Arguments&... arguments)
{
  Kernel::run(arguments...);
}
#endif

// Calls Kernel::run(arguments...) in a version for the widest registers of this processor that are
// of use; Plain_kernel without them. Kernel::run() is static and void, and like all that it calls
// CGAL_ARAP_ALWAYS_INLINE; lambda expressions would not be.
template <typename Kernel, typename Plain_kernel = Kernel, typename... Arguments>
void run_kernel(const Arguments&... arguments)
{
#ifdef CGAL_ARAP_HAS_DISPATCH
  if(has_avx2())
    return run_with_avx2<Kernel>(arguments...);
#endif
#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS) && defined(__AVX2__)
  Kernel::run(arguments...);
#else
  Plain_kernel::run(arguments...);
#endif
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_RUN_KERNEL_H
