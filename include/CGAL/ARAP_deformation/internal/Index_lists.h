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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_INDEX_LISTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_INDEX_LISTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// A number of items as an index, which is an int to save memory.
inline int to_index(std::size_t number)
{
  if(number > static_cast<std::size_t>((std::numeric_limits<int>::max)()))
    throw std::length_error("CGAL::ARAP: the region, or the mesh of ranges, has more than "
                            "2147483647 corners, neighbors or weights");
  return static_cast<int>(number);
}

inline int checked_sum(int a, int b)
{
  return to_index(static_cast<std::size_t>(a) + static_cast<std::size_t>(b));
}

// Adds to each number all that come before it: sizes of lists, after a 0, become their begins.
inline void add_up(Array<int>& numbers)
{
  std::partial_sum(numbers.begin(), numbers.end(), numbers.begin(), checked_sum);
}

// Indices that follow each other in memory. (Index_ranges.h has numbers that follow each other.)
struct Index_range
{
  const int *first, *last;

  const int* begin() const { return first; }
  const int* end() const { return last; }
  int size() const { return static_cast<int>(last - first); }
  int operator[](std::size_t k) const { return first[k]; }
};

// Lists of indices: those of list k are items[begin[k]] to items[begin[k + 1] - 1].
struct Index_lists
{
  Array<int> begin = {0};
  Array<int> items;

  int size() const { return static_cast<int>(begin.size()) - 1; }

  Index_range list(int k) const
  {
    return {items.data() + begin[k], items.data() + begin[k + 1]};
  }

  // what has been appended to `items` since the end of the last list is a list
  void end_list() { begin.push_back(to_index(items.size())); }
};

// For each first number that pairs have, in ascending order, the list of their second numbers, in
// ascending order too.
template <typename Number>
Index_lists lists_by_first(std::vector<std::pair<Number, int>> pairs)
{
  std::sort(pairs.begin(), pairs.end());
  Index_lists result;
  for(std::size_t k = 0; k < pairs.size(); ++k)
  {
    result.items.push_back(pairs[k].second);
    if(k + 1 == pairs.size() || pairs[k + 1].first != pairs[k].first)
      result.end_list();
  }
  return result;
}

// For each number below n the list of the second numbers of the pairs that have it first, in the
// order in which for_each_pair(f) calls f(first, second). It is called twice.
template <typename For_each_pair>
Index_lists lists_of_pairs(int n, const For_each_pair& for_each_pair)
{
  Index_lists result;
  result.begin = Array<int>(n + 1, 0);
  for_each_pair([&](int first, int) { ++result.begin[first + 1]; });
  add_up(result.begin);
  result.items = Array<int>(result.begin.back());
  Array<int> next(result.begin.begin(), result.begin.end() - 1);
  for_each_pair([&](int first, int second) { result.items[next[first]++] = second; });
  return result;
}

// for each item its list, from where the lists begin
inline Array<int> list_of_each(const Array<int>& begin)
{
  Array<int> list_of(begin.back());
  for(int k = 0; k + 1 < static_cast<int>(begin.size()); ++k)
    std::fill(list_of.begin() + begin[k], list_of.begin() + begin[k + 1], k);
  return list_of;
}

// for each number below n the lists that have it
inline Index_lists lists_with(const Index_lists& lists, int n)
{
  return lists_of_pairs(n, [&](const auto& f) {
    for(int k = 0; k < lists.size(); ++k)
      for(int item : lists.list(k))
        if(item < n)
          f(item, k);
  });
}

// for each number below n the places of it among the items
inline Index_lists places_of(const Array<int>& items, int n)
{
  return lists_of_pairs(n, [&](const auto& f) {
    for(std::size_t k = 0; k < items.size(); ++k)
      if(items[k] < n)
        f(items[k], static_cast<int>(k));
  });
}

// Sorts pairs of a number and a value, in place, adds the values of those that have the same number
// up, and returns how many are left. The sums do not depend on the order. Values may be no numbers.
template <typename Iterator>
int sort_and_add_up(Iterator begin, Iterator end)
{
  const auto value = [](const auto& pair) {
    return is_nan(pair.second) ? std::numeric_limits<double>::infinity() : pair.second;
  };
  std::sort(begin, end, [](const auto& a, const auto& b) { return a.first < b.first; });
  Iterator last = begin;
  for(Iterator it = begin; it != end;)
  {
    const Iterator first = it;
    auto sum = *it;
    while(++it != end && it->first == sum.first) {}
    if(it - first > 2)
      std::sort(first, it, [&](const auto& a, const auto& b) { return value(a) < value(b); });
    sum.second = first->second;
    for(Iterator k = first + 1; k != it; ++k)
      sum.second += k->second;
    *last++ = sum;
  }
  return static_cast<int>(last - begin);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_INDEX_LISTS_H
