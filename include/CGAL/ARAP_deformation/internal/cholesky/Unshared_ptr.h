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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_UNSHARED_PTR_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_UNSHARED_PTR_H

#include <CGAL/license/ARAP_deformation.h>

#include <memory>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// A pointer to what a class owns but does not hand on to its copies, such as a factor: a copy is
// null. Moves are those of `std::unique_ptr`.
template <typename T>
class Unshared_ptr : public std::unique_ptr<T>
{
public:
  using std::unique_ptr<T>::unique_ptr;

  Unshared_ptr() = default;
  Unshared_ptr(Unshared_ptr&&) = default;
  Unshared_ptr& operator=(Unshared_ptr&&) = default;
  Unshared_ptr(const Unshared_ptr&) : std::unique_ptr<T>() {}
  ~Unshared_ptr() = default;

  Unshared_ptr& operator=(const Unshared_ptr&)
  {
    this->reset();
    return *this;
  }

  Unshared_ptr& operator=(std::unique_ptr<T>&& other)
  {
    std::unique_ptr<T>::operator=(std::move(other));
    return *this;
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_UNSHARED_PTR_H
