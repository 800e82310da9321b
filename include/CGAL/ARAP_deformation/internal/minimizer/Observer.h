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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_OBSERVER_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_OBSERVER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Default_visitor.h>

#include <functional>

namespace CGAL {
namespace ARAP {
namespace internal {

// observe(k, E_k) is called after iteration k, and after the initial evaluation with k = 0
using Observer = std::function<Visitor_action(unsigned int, double)>;

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_MINIMIZER_OBSERVER_H
