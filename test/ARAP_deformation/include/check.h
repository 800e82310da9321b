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

#ifndef CGAL_ARAP_DEFORMATION_TEST_CHECK_H
#define CGAL_ARAP_DEFORMATION_TEST_CHECK_H

// Checks that hold in Release too, where assert() does nothing. A test calls them, goes on after a
// failure, and returns checks_result() from main().

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

// atomic: threads check, too
inline std::atomic<int>& number_of_checks() { static std::atomic<int> n{0}; return n; }
inline std::atomic<int>& number_of_failures() { static std::atomic<int> n{0}; return n; }

// what is being tested, printed with a failure
inline std::string& test_case() { static std::string s; return s; }

inline bool check(bool condition, const char* text, const char* file, int line)
{
  ++number_of_checks();
  if(!condition && ++number_of_failures() <= 20)
    std::cerr << file << ':' << line << ": failed: " << text
              << (test_case().empty() ? "" : "  [" + test_case() + "]") << std::endl;
  return condition;
}

inline bool check_at_most(double value, double bound, const char* text, const char* file, int line)
{
  if(check(value <= bound, text, file, line))
    return true;
  if(number_of_failures() <= 20)
    std::cerr << "    " << value << " is not at most " << bound << std::endl;
  return false;
}

// The larger of two errors. What is not a number is the largest of all: std::max() would lose it.
inline double larger(double a, double b) { return a >= b || std::isnan(a) ? a : b; }

#define CHECK(condition) check(static_cast<bool>(condition), #condition, __FILE__, __LINE__)
#define CHECK_AT_MOST(value, bound) \
  check_at_most((value), (bound), #value " <= " #bound, __FILE__, __LINE__)

// A test that checks nothing has failed.
inline int checks_result()
{
  std::cout << number_of_checks() << " checks, " << number_of_failures() << " failed" << std::endl;
  return number_of_checks() > 0 && number_of_failures() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif // CGAL_ARAP_DEFORMATION_TEST_CHECK_H
