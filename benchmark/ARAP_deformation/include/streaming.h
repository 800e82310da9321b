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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_STREAMING_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_STREAMING_H

// The memory bandwidth of this machine.

#include "measure.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace benchmark {

// integers, whose sum the compiler may vectorize
inline std::uint64_t sum(const std::uint64_t* begin, const std::uint64_t* end)
{
  std::uint64_t sums[8] = {};
  for(; begin + 8 <= end; begin += 8)
    for(int k = 0; k < 8; ++k)
      sums[k] += begin[k];
  std::uint64_t total = 0;
  for(; begin != end; ++begin)
    total += *begin;
  for(std::uint64_t s : sums)
    total += s;
  return total;
}

// The bytes per second that the given number of threads read from a buffer of the given size, each
// its own part repeatedly. The best of several runs, since other processes only slow it down.
inline double streaming_bandwidth(std::size_t bytes, unsigned int threads)
{
  const std::size_t n = bytes / sizeof(std::uint64_t) / threads;
  const std::size_t passes = (std::max)(std::size_t(1), std::size_t(200000000) / bytes);
  const std::vector<std::uint64_t> buffer(n * threads, 1);
  double best = 0;
  for(int repetition = 0; repetition < 5; ++repetition)
  {
    std::vector<double> bandwidth(threads);
    std::vector<std::thread> workers;
    for(unsigned int t = 0; t < threads; ++t)
      workers.emplace_back([&, t] {
        const std::uint64_t* begin = buffer.data() + t * n;
        std::uint64_t total = 0;
        const Stopwatch stopwatch;
        for(std::size_t pass = 0; pass < passes; ++pass)
          total += sum(begin, begin + n);
        const double seconds = stopwatch.seconds();
        if(total == passes * n) // forces the sum to be computed
          bandwidth[t] = static_cast<double>(passes * n * sizeof(std::uint64_t)) / seconds;
      });
    for(std::thread& worker : workers)
      worker.join();
    double all = 0;
    for(double b : bandwidth)
      all += b;
    best = (std::max)(best, all);
  }
  return best;
}

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_STREAMING_H
