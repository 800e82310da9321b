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

#ifndef CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_DEFORMATION_TRAITS_H
#define CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_DEFORMATION_TRAITS_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/conformance/check_closest_rotation.h>
#include <CGAL/ARAP_deformation/conformance/check_edge_weight.h>
#include <CGAL/ARAP_deformation/conformance/check_sparse_solver.h>
#include <CGAL/ARAP_deformation/internal/session/traits_requirements.h>

#include <string>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationChecks
/// \brief returns a message for each requirement that the objects of a model of
/// `ARAPDeformationTraits` violate; none if they conform.
///
/// Applies `check_sparse_solver()`, `check_edge_weight()` and `check_closest_rotation()`, with
/// their default tolerances, to the objects of a copy of `traits`.
template <typename DeformationTraits>
std::vector<std::string> check_deformation_traits(const DeformationTraits& traits)
{
  static_assert(internal::Deformation_traits_requirements<DeformationTraits>::are_met);
  const DeformationTraits copy(traits);
  std::vector<std::string> sentences;
  const auto append = [&sentences](const char* object, const std::vector<std::string>& violations) {
    for(const std::string& violation : violations)
      sentences.push_back(std::string(object) + ": " + violation);
  };
  append("sparse_solver_object()", check_sparse_solver(copy.sparse_solver_object()));
  append("edge_weight_object()", check_edge_weight(copy.edge_weight_object()));
  append("closest_rotation_object()", check_closest_rotation(copy.closest_rotation_object()));
  return sentences;
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CONFORMANCE_CHECK_DEFORMATION_TRAITS_H
