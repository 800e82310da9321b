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

// Whether kernels are chosen at run time: on x86, also if the compiler may use AVX2 anyway, so that
// translation units with different flags define the same functions. (On Windows, g++ does not align
// the stack for it.)
#if defined(CGAL_ARAP_HAS_VECTOR_EXTENSIONS) && defined(__x86_64__) && !defined(_WIN32)
#define CGAL_ARAP_HAS_DISPATCH
#endif

namespace CGAL {
namespace ARAP {
namespace internal {
inline namespace CGAL_ARAP_SIMD {

#ifdef CGAL_ARAP_HAS_DISPATCH
// Reads what the run-time library found when the program started: a static variable would cost
// more, in each kernel.
inline bool has_avx2()
{
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

template <typename Kernel, typename... Arguments>
__attribute__((target("avx2,fma"))) void run_with_avx2(const Arguments&... arguments)
{
  Kernel::run(arguments...);
}

// For processors without AVX2, which are rare: optimized for size, which compiles sooner.
template <typename Kernel, typename... Arguments>
__attribute__((cold, noinline)) void run_without_avx2(const Arguments&... arguments)
{
  Kernel::run(arguments...);
}
#endif

// How many columns of a matrix the plain versions of kernels hold in registers. If the kernel is
// chosen at run time, the plain one is for processors without AVX2 only, which are rare: so few
// columns that it is compiled soon.
#ifdef CGAL_ARAP_HAS_DISPATCH
constexpr int plain_columns = 2;
#else
constexpr int plain_columns = 4;
#endif

// Calls Kernel::run(arguments...), compiled for AVX2, if this processor has it, and otherwise
// Plain_kernel::run(arguments...). Both are static and void and, like all that they call,
// CGAL_ARAP_ALWAYS_INLINE; lambda expressions would not be.
template <typename Kernel, typename Plain_kernel = Kernel, typename... Arguments>
void run_kernel(const Arguments&... arguments)
{
#ifdef CGAL_ARAP_HAS_DISPATCH
  if(has_avx2())
    run_with_avx2<Kernel>(arguments...);
  else
    run_without_avx2<Plain_kernel>(arguments...);
#else
  Plain_kernel::run(arguments...);
#endif
}

} // namespace CGAL_ARAP_SIMD
} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SIMD_RUN_KERNEL_H
