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

#ifndef CGAL_ARAP_DEFORMATION_TEST_LENGTH_H
#define CGAL_ARAP_DEFORMATION_TEST_LENGTH_H

// How much a test runs. script/test ends within minutes: of loops over very many cases it runs
// some. script/test --all sets the environment variable ARAP_DEFORMATION_TEST_ALL: all are run.

#include <cstddef>
#include <cstdlib>

inline bool is_long_run()
{
  static const bool is_set = std::getenv("ARAP_DEFORMATION_TEST_ALL") != nullptr;
  return is_set;
}

inline int short_or_long(int in_short_run, int in_long_run)
{
  return is_long_run() ? in_long_run : in_short_run;
}

// Which cases are run: every n-th, or all in a long run. Where the cases come from nested loops, n
// is a prime that divides none of their lengths, so that each choice meets each other one.
class Every_nth
{
public:
  explicit Every_nth(std::size_t n) : m_n(n) {}
  bool operator()() { return m_count++ % m_n == 0 || is_long_run(); }

private:
  std::size_t m_n, m_count = 0;
};

#endif // CGAL_ARAP_DEFORMATION_TEST_LENGTH_H
