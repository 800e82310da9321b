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
#include <CGAL/ARAP_deformation/Options.h>
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

// adds to the message of a run what a user would not expect
void add_remarks(Outcome& result, const Report& report, const Options& options,
                 bool is_region_empty, bool has_no_control,
                 const std::vector<std::size_t>& isolated_controls);

// The outcome for a status; `what` names the vertex or the simplex concerned.
Outcome outcome(Status status, const std::string& what = std::string());

// the same for a vertex, given by its index; `what` goes before its name, as "the target of "
Outcome outcome_of_vertex(Status status, std::size_t index, const char* what = "");

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/session/sentences_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_SENTENCES_H
