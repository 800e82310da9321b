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

// A program of translation units that are compiled for other instruction sets: what has the same
// name is the same in all of them, and so are the results, up to rounding.

#include "include/check.h"
#include "include/instruction_set.h"

#include <CGAL/ARAP_deformation/internal/Array.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <type_traits>

// Vectors of C++23 would call allocate_at_least() of the base, without the spare element.
static_assert(!std::is_base_of_v<
              std::allocator<CGAL::ARAP::Coordinates>,
              CGAL::ARAP::internal::Spare_allocator<CGAL::ARAP::Coordinates>>);

void compare(const Findings& a, const Findings& b)
{
  CHECK(a.points.size() == b.points.size());
  for(std::size_t v = 0; v < a.points.size() && v < b.points.size(); ++v)
    for(std::size_t k = 0; k < 3; ++k)
      CHECK_AT_MOST(std::abs(a.points[v][k] - b.points[v][k]), 1e-10);
}

int main()
{
  const Findings baseline = with_baseline();
  CHECK(!baseline.points.empty());

  test_case() = "without vector extensions";
  const Findings without = without_vector_extensions();
  compare(baseline, without);
  CHECK(baseline.vector_type != without.vector_type);

#ifdef CGAL_ARAP_TEST_AVX2
  if(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    test_case() = "with AVX2";
    const Findings avx2 = with_avx2();
    compare(baseline, avx2);
    CHECK(baseline.vector_type == avx2.vector_type);
    CHECK(baseline.plain_columns == avx2.plain_columns);
  }
#endif
  return checks_result();
}
