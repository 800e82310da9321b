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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_BUILT_CORE_IMPL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_BUILT_CORE_IMPL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/region/vector_algebra.h>
#include <CGAL/ARAP_deformation/internal/session/Built_core.h>
#include <CGAL/ARAP_deformation/internal/session/sentences.h>

#include <cstddef>
#include <memory>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

CGAL_ARAP_INLINE_FUNCTION
Outcome check_stiffness(const Energy_model& energy_model, const Region& region)
{
  const Array<double>& stiffness = energy_model.stiffness;
  for(std::size_t c = 0; c < stiffness.size(); ++c)
    if(!(stiffness[c] >= 0) || !is_finite(stiffness[c]))
      return outcome(Status::invalid_stiffness,
                     energy_model.cells.has_vertex_cells()
                       ? vertex_name(region.indices[c])
                       : simplex_name(region, static_cast<int>(c)));
  return outcome(Status::success);
}

CGAL_ARAP_INLINE_FUNCTION
Built_core::Built_core(std::size_t number, bool is_whole_) : numbering(number), is_whole(is_whole_)
{}

CGAL_ARAP_INLINE_FUNCTION
Built_core::~Built_core() = default;

CGAL_ARAP_INLINE_FUNCTION
bool Built_core::is_movable(int v) const
{
  return v >= 0 && v < core->region().number_of_movable_vertices;
}

CGAL_ARAP_INLINE_FUNCTION
void Built_core::add_points(const Coordinates& present, const Coordinates& rest, Region& region)
{
  if(positions.empty())
  {
    positions.reserve(region.indices.size());
    region.rest.reserve(region.indices.size());
  }
  positions.push_back(present);
  region.rest.push_back(rest);
}

CGAL_ARAP_INLINE_FUNCTION
Outcome Built_core::make_core(const Models& models, Region& region, Energy_model& energy_model,
                              Minimization_order order, const Options& options,
                              Eigen_build<>)
{
  core = std::make_unique<Deformation_core>(models(), std::move(region), std::move(energy_model),
                                            order, options.threads);
  return explain(core->diagnosis());
}

CGAL_ARAP_INLINE_FUNCTION
Outcome Built_core::explain(const Diagnosis& diagnosis) const
{
  if(diagnosis.vertex >= 0)
    return outcome_of_vertex(diagnosis.status, core->region().indices[diagnosis.vertex]);
  if(diagnosis.simplex < 0)
    return outcome(diagnosis.status);
  return outcome(diagnosis.status, simplex_name(core->region(), diagnosis.simplex));
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_BUILT_CORE_IMPL_H
