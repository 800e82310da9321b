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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ARRAY_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ARRAY_H

#include <CGAL/license/ARAP_deformation.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// A std::vector whose size and indices may also be int, as in sparse matrices and index lists.
template <typename T>
class Array : public std::vector<T>
{
  using Base = std::vector<T>;

public:
  using Base::Base;
  explicit Array(int n, const T& value = T()) : Base(static_cast<std::size_t>(n), value) {}

  template <typename Index>
  T& operator[](Index k) { return Base::operator[](static_cast<std::size_t>(k)); }
  template <typename Index>
  const T& operator[](Index k) const { return Base::operator[](static_cast<std::size_t>(k)); }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ARRAY_H
