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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_PARALLEL_PARALLEL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_PARALLEL_PARALLEL_H

#include <CGAL/license/ARAP_deformation.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

// The only header that uses threads. With TBB (the target CGAL::TBB_support, which defines
// CGAL_LINKED_WITH_TBB) tasks run in parallel, without it one after the other. The division into
// tasks never depends on the number of threads, and so neither do the results.

namespace CGAL {
namespace ARAP {
namespace internal {

#ifdef CGAL_LINKED_WITH_TBB
// A task by its number, with references to the function objects of loops: TBB's templates are
// instantiated for this type only and not for each loop, which would take seconds to compile.
using Task = std::function<void(std::size_t)>;

inline void run_with_tbb_threads(unsigned int number_of_threads, const Task& f)
{
  const std::size_t available =
    tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  tbb::task_arena arena(static_cast<int>((std::min<std::size_t>)(number_of_threads, available)));
  arena.execute([&] { f(0); });
}

// A thread that waits in here does not take tasks of the caller's own parallel loops.
inline void run_in_isolation(const Task& f)
{
  tbb::this_task_arena::isolate([&] { f(0); });
}

inline void for_each_tbb_task(std::size_t n, const Task& f)
{
  tbb::parallel_for(std::size_t(0), n, f);
}
#endif

// how many tasks run at a time
inline std::size_t number_of_threads()
{
#ifdef CGAL_LINKED_WITH_TBB
  return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
#else
  return 1;
#endif
}

// Calls f() with at most `number_of_threads` threads for its parallel loops; 0 for TBB's default.
template <typename Function>
void run_with_threads(unsigned int number_of_threads, const Function& f)
{
#ifdef CGAL_LINKED_WITH_TBB
  const auto task = [&](std::size_t) { f(); };
  if(number_of_threads > 0)
    run_with_tbb_threads(number_of_threads, std::cref(task));
  else
    run_in_isolation(std::cref(task));
#else
  static_cast<void>(number_of_threads);
  f();
#endif
}

// Calls f(k) for k in [0, n), in any order.
template <typename Function>
void for_each_task(std::size_t n, const Function& f)
{
#ifdef CGAL_LINKED_WITH_TBB
  if(n > 1)
    return for_each_tbb_task(n, std::cref(f));
#endif
  for(std::size_t k = 0; k < n; ++k)
    f(k);
}

// large enough to make the cost of a task negligible where each element costs ten nanoseconds
constexpr std::size_t default_block_size = 1024;

// Calls f(begin, end) for consecutive blocks of [0, n), in any order.
template <typename Function>
void for_each_block(std::size_t n, const Function& f, std::size_t block_size = default_block_size)
{
  for_each_task((n + block_size - 1) / block_size, [&](std::size_t k) {
    f(k * block_size, (std::min)(n, (k + 1) * block_size));
  });
}

// The sum of f(begin, end) over consecutive blocks of [0, n), added up in their order; f returns
// numbers, or what can be added like numbers.
template <typename Function>
auto sum_over_blocks(std::size_t n, const Function& f, std::size_t block_size = default_block_size)
{
  using Value = decltype(f(n, n));
  std::vector<Value> sums((n + block_size - 1) / block_size);
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    sums[begin / block_size] = f(begin, end);
  }, block_size);
  return std::accumulate(sums.begin(), sums.end(), Value());
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_PARALLEL_PARALLEL_H
