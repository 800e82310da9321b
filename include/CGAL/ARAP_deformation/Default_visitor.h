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

#ifndef CGAL_ARAP_DEFORMATION_DEFAULT_VISITOR_H
#define CGAL_ARAP_DEFORMATION_DEFAULT_VISITOR_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationRun
/// what a visitor asks the run to do next.
enum class Visitor_action
{
  proceed, ///< continue
  stop,    ///< end the run and keep this iterate
  cancel   ///< end the run and leave the mesh and the object as they were before it
};

/// \ingroup PkgARAPDeformationRun
/// \brief a visitor that lets every run proceed.
///
/// \cgalModels{ARAPDeformationVisitor}
struct Default_visitor
{
  /// returns `Visitor_action::proceed`.
  template <typename Iterate>
  Visitor_action operator()(const Iterate&) const { return Visitor_action::proceed; }
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_DEFAULT_VISITOR_H
