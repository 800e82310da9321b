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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_CORE_MODELS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_CORE_MODELS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/internal/energy/Edge_weight_model.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core.h>
#include <CGAL/ARAP_deformation/internal/solver/Linear_solver.h>

#include <CGAL/tags.h>

#include <memory>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Traits, typename = void>
struct Get_concurrency_tag { using type = Parallel_if_available_tag; };

template <typename Traits>
struct Get_concurrency_tag<Traits, std::void_t<typename Traits::Concurrency_tag>>
{
  using type = typename Traits::Concurrency_tag;
};

template <typename Weight>
std::shared_ptr<const Edge_weight_model> make_edge_weight_model(Weight weight)
{
  return std::make_shared<Edge_weight_model_of<Weight>>(std::move(weight));
}

template <typename Solver>
std::shared_ptr<const Linear_solver> make_linear_solver(Solver solver)
{
  return std::make_shared<Linear_solver_of<Solver>>(std::move(solver));
}

#ifdef CGAL_ARAP_DEFORMATION_COMPILED // those of the default traits
extern template std::shared_ptr<const Edge_weight_model>
make_edge_weight_model(Safe_cotangent_weight);
extern template std::shared_ptr<const Linear_solver>
make_linear_solver(Multifrontal_cholesky_solver);
#endif

// what the traits hand out, as the core calls it
template <typename Traits>
Core_models core_models(const Traits& traits)
{
  using Concurrency_tag = typename Get_concurrency_tag<Traits>::type;
  return {make_edge_weight_model<typename Traits::Edge_weight>(traits.edge_weight_object()),
          traits.closest_rotation_object(),
          make_linear_solver<typename Traits::Sparse_solver>(traits.sparse_solver_object()),
          std::is_convertible_v<Concurrency_tag, Parallel_tag>};
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_CORE_MODELS_H
