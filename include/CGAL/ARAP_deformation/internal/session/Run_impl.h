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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_RUN_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_RUN_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Run.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <cstddef>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
Run::Run(Built_core& core, const Region_rows& rows, Report& report)
  : positions(core.positions), m_core(core), m_rows(rows), m_rotations(core.core->rotations())
{
  report.free_vertices = core.core->constraints().number_of_free_vertices();
  report.simplices = static_cast<std::size_t>(core.core->region().number_of_simplices());
  report.unconstrained_components = core.core->unconstrained_components();
}

CGAL_ARAP_INLINE_FUNCTION
Run::~Run() = default;

CGAL_ARAP_INLINE_FUNCTION
Outcome Run::run(const Options& options, const Observer& observe, Report& report)
{
  m_core.core->complete(m_rotations, m_core.positions, options.threads);
  const Diagnosis diagnosis =
    m_core.core->run(options, observe, targets, positions, m_rotations, report);
  for(const Targets::Set& set : targets.sets)
    if(!is_finite(targets.soft[set.row]))
      return outcome(Status::non_finite_point, "the target of " +
                     name_of_soft_row(m_rows, m_core.core->region(), set.row));
  return m_core.explain(diagnosis);
}

CGAL_ARAP_INLINE_FUNCTION
void Run::finish(Report& report)
{
  m_core.core->set_rotations(std::move(m_rotations), m_core.core->are_rotations_state());
  report.inverted_simplices = m_core.core->number_of_inverted_simplices(m_core.positions);
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_RUN_IMPL_H
