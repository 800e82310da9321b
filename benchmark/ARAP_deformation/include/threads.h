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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_THREADS_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_THREADS_H

// The number of threads. Without TBB it is always one.

#include <vector>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

namespace benchmark {

inline unsigned int number_of_threads()
{
#ifdef CGAL_LINKED_WITH_TBB
  return static_cast<unsigned int>(tbb::this_task_arena::max_concurrency());
#else
  return 1;
#endif
}

// one thread, and all threads
inline std::vector<unsigned int> thread_counts()
{
  std::vector<unsigned int> counts = {1};
  if(number_of_threads() > 1)
    counts.push_back(number_of_threads());
  return counts;
}

// limits the number of threads during its lifetime
class Thread_limit
{
public:
#ifdef CGAL_LINKED_WITH_TBB
  explicit Thread_limit(unsigned int threads)
    : m_control(tbb::global_control::max_allowed_parallelism, threads)
  {}

private:
  tbb::global_control m_control;
#else
  explicit Thread_limit(unsigned int) {}
#endif
};

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_THREADS_H
