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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

std::string vertex_name(std::size_t index);
std::string control_point_name(Control_point point);
std::string simplex_name(const Region& region, int simplex);

// the end of a message if there are unconstrained components, given by their smallest vertices
std::string about_unconstrained_components(const std::vector<std::size_t>& parts);

// what of a message tells what a run left behind, and of an end that may be no minimum
std::string about_end(const Report& report);

std::string about_nothing_free(bool is_region_empty);

// the end of a message if there are control vertices without incident simplices
std::string about_isolated_controls(const std::vector<std::size_t>& vertices);

// The outcome for a status; `what` names the vertex or the simplex concerned, or is empty.
Outcome outcome(Status status, const std::string& what = std::string());

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/session/sentences_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_H
