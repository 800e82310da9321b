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

// A pointer to what a class owns but does not pass on to its copies, such as a factor: a copy is
// null. The type need not be complete where the class is defined.
template <typename T>
class Unshared_ptr : public std::shared_ptr<T> // which keeps the deleter, and is never shared
{
public:
  Unshared_ptr() = default;
  Unshared_ptr(Unshared_ptr&&) = default;
  Unshared_ptr& operator=(Unshared_ptr&&) = default;
  Unshared_ptr(const Unshared_ptr&) : std::shared_ptr<T>() {}
  ~Unshared_ptr() = default;

  Unshared_ptr& operator=(const Unshared_ptr&)
  {
    this->reset();
    return *this;
  }

  // replaces the object by a new one, and destroys the old one first
  template <typename... Arguments>
  void emplace(Arguments&&... arguments)
  {
    this->reset();
    std::shared_ptr<T>::operator=(std::make_shared<T>(std::forward<Arguments>(arguments)...));
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_UNSHARED_PTR_H
