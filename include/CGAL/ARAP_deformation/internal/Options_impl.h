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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_OPTIONS_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_OPTIONS_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/internal/is_finite.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>

#include <string>

namespace CGAL {
namespace ARAP {

CGAL_ARAP_INLINE_FUNCTION
Outcome Options::check() const
{
  const auto is_valid = [](double x) { return x >= 0 && internal::is_finite(x); };
  const char* const wrong = !is_valid(tolerance)          ? "tolerance"
                            : !is_valid(bending_length)   ? "bending_length"
                            : !is_valid(smoothing_length) ? "smoothing_length" : nullptr;
  if(wrong)
    return Outcome(Status::invalid_option,
                   "the option " + std::string(wrong) + " must be finite and not negative");
  if(cells.rings() > 100)
    return Outcome(Status::invalid_option, "the option cells is k_ring:" +
                   std::to_string(cells.rings()) + "; it can be at most k_ring:100");
  if(bending_length > 0 && !cells.has_vertex_cells())
    return Outcome(Status::invalid_option, "the option bending_length needs cells at vertices; "
                   "choose spokes, k_ring or spokes_and_rims for the option cells");
  return Outcome(Status::success, "the options are valid");
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_OPTIONS_IMPL_H
