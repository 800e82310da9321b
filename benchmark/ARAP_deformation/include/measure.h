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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_MEASURE_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_MEASURE_H

// Clocks, statistics and failures.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace benchmark {

// an error that makes a comparison impossible or wrong; what() is for the user
struct Failure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// Fails unless `value`, described by `what`, is at most `largest`. Not a number fails.
inline void verify_at_most(double value, double largest, const std::string& what)
{
  if(value <= largest)
    return;
  std::ostringstream message;
  message << what << " is " << value << "; at most " << largest << " is expected";
  throw Failure(message.str());
}

// The larger of two errors. What is not a number is the largest of all: std::max() would lose it.
inline double larger(double a, double b) { return a >= b || std::isnan(a) ? a : b; }

class Stopwatch
{
  using Clock = std::chrono::steady_clock;

public:
  double seconds() const
  {
    return std::chrono::duration<double>(Clock::now() - m_start).count();
  }

private:
  Clock::time_point m_start = Clock::now();
};

// the quantile: the value that the given share of all values does not exceed
inline double quantile(std::vector<double> values, double share)
{
  std::sort(values.begin(), values.end());
  const double place = std::ceil(share * static_cast<double>(values.size())) - 1;
  return values[static_cast<std::size_t>((std::max)(place, 0.0))];
}

inline double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

// The median time of f() in seconds. Calls it until `least_seconds` have passed, and at least
// `least_calls` times; calls prepare() before each call, untimed.
template <typename Prepare, typename Function>
double median_seconds(double least_seconds, unsigned int least_calls, const Prepare& prepare,
                      const Function& f)
{
  const Stopwatch all;
  std::vector<double> seconds;
  while(seconds.size() < least_calls || all.seconds() < least_seconds)
  {
    prepare();
    const Stopwatch stopwatch;
    f();
    seconds.push_back(stopwatch.seconds());
  }
  return median(seconds);
}

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_MEASURE_H
