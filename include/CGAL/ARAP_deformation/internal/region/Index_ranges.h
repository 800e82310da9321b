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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_INDEX_RANGES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_INDEX_RANGES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// A choice of the indices [0, n) as ranges, to work on in parallel. No range crosses a multiple of
// the block size, and the ranges of one block are one task: results do not depend on threads.
class Index_ranges
{
public:
  // chooses the indices for which the predicate holds
  template <typename Predicate>
  void choose(int n, const Predicate& is_chosen, int block_size)
  {
    m_ranges.clear();
    m_first_range = {0};
    for(int block = 0; block < n; block += block_size)
    {
      const int block_end = (std::min)(n, block + block_size);
      for(int begin = block; begin < block_end;)
      {
        int end = begin;
        while(end < block_end && is_chosen(end))
          ++end;
        if(begin < end)
          m_ranges.push_back({begin, end});
        begin = end + 1;
      }
      if(m_ranges.size() > m_first_range.back())
        m_first_range.push_back(m_ranges.size());
    }
  }

  // calls f(begin, end) for each range, in any order
  template <typename Function>
  void for_each(const Function& f) const
  {
    for_each_task(m_first_range.size() - 1, [&](std::size_t task) {
      for(std::size_t r = m_first_range[task]; r < m_first_range[task + 1]; ++r)
        f(m_ranges[r].begin, m_ranges[r].end);
    });
  }

  // the sum of f(begin, end) over all ranges, added up in their order; f returns numbers, or what
  // can be added like numbers. Calls start(begin) before the first range of each block.
  template <typename Function, typename Start>
  auto sum(const Function& f, const Start& start) const
  {
    using Value = decltype(f(0, 0));
    std::vector<Value> sums(m_first_range.size() - 1);
    for_each_task(sums.size(), [&](std::size_t task) {
      start(m_ranges[m_first_range[task]].begin);
      for(std::size_t r = m_first_range[task]; r < m_first_range[task + 1]; ++r)
        sums[task] = sums[task] + f(m_ranges[r].begin, m_ranges[r].end);
    });
    return std::accumulate(sums.begin(), sums.end(), Value());
  }

  template <typename Function>
  auto sum(const Function& f) const { return sum(f, [](int) {}); }

private:
  struct Range
  {
    int begin, end;
  };

  std::vector<Range> m_ranges;
  std::vector<std::size_t> m_first_range = {0}; // of each task
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_INDEX_RANGES_H
