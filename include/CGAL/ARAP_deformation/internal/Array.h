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

#include <CGAL/ARAP_deformation/flat_types.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Allocates one element more than is asked for, so that what begins at the last one can be loaded
// into a SIMD vector. It does not inherit: vectors would call allocate_at_least() of a base.
template <typename T>
struct Spare_allocator
{
  using value_type = T;

  Spare_allocator() = default;
  template <typename Other>
  Spare_allocator(const Spare_allocator<Other>&) {}

  T* allocate(std::size_t n) { return std::allocator<T>().allocate(n + 1); }
  void deallocate(T* p, std::size_t n) { std::allocator<T>().deallocate(p, n + 1); }

  friend bool operator==(const Spare_allocator&, const Spare_allocator&) { return true; }
  friend bool operator!=(const Spare_allocator&, const Spare_allocator&) { return false; }
};

template <typename T>
struct Vector_of { using type = std::vector<T>; };

template <>
struct Vector_of<Coordinates>
{
  using type = std::vector<Coordinates, Spare_allocator<Coordinates>>;
};

// A std::vector whose size and indices may also be int, as in sparse matrices and index lists.
template <typename T>
class Array : public Vector_of<T>::type
{
  using Base = typename Vector_of<T>::type;

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
