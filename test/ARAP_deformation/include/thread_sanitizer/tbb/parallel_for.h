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

// Under the thread sanitizer this stands in for TBB's header: TBB's library is not instrumented,
// and what it does to hand work from thread to thread looks like races. It starts new threads for
// each loop that is not inside another one.

#ifndef CGAL_ARAP_DEFORMATION_TEST_TBB_PARALLEL_FOR_H
#define CGAL_ARAP_DEFORMATION_TEST_TBB_PARALLEL_FOR_H

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tbb {

template <typename Function>
void parallel_for(std::size_t begin, std::size_t end, const Function& f)
{
  static std::atomic<int> depth{0}; // of loops in loops
  constexpr int deepest = 3;
  std::atomic<std::size_t> next{begin};
  std::exception_ptr exception;
  std::mutex mutex;
  const auto work = [&] {
    for(std::size_t k = next++; k < end; k = next++)
      try { f(k); }
      catch(...)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        exception = std::current_exception();
      }
  };
  std::vector<std::thread> threads;
  if(depth++ < deepest)
    for(int k = 0; k < 2; ++k)
      threads.emplace_back(work);
  work();
  for(std::thread& thread : threads)
    thread.join();
  --depth;
  if(exception)
    std::rethrow_exception(exception);
}

// What CGAL calls in loops of its own, which are not what is tested: the whole range at once. The
// pack, always empty, lets TBB's function be the better match where CGAL has included it otherwise.
template <typename Range, typename Function, typename... Nothing>
void parallel_for(const Range& range, const Function& f, const Nothing&...)
{
  f(range);
}

} // namespace tbb

#endif // CGAL_ARAP_DEFORMATION_TEST_TBB_PARALLEL_FOR_H
