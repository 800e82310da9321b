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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_REGION_DISJOINT_SETS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_REGION_DISJOINT_SETS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/Array.h>

#include <algorithm>
#include <numeric>

namespace CGAL {
namespace ARAP {
namespace internal {

// Sets of the numbers below n, at first one for each. The smallest number of a set is its name.
// (Those of Boost do not compile after some of its graphs.)
class Disjoint_sets
{
public:
  explicit Disjoint_sets(int n) : m_parent(n)
  {
    std::iota(m_parent.begin(), m_parent.end(), 0);
  }

  int find(int k)
  {
    while(m_parent[k] != k)
      k = m_parent[k] = m_parent[m_parent[k]];
    return k;
  }

  void unite(int k, int l)
  {
    const int a = find(k), b = find(l);
    m_parent[a] = m_parent[b] = (std::min)(a, b);
  }

private:
  Array<int> m_parent;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_REGION_DISJOINT_SETS_H
