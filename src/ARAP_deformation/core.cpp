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

// What is no template, compiled once: for the target ARAP_deformation_core.
#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#define CGAL_ARAP_DEFORMATION_COMPILED
#endif

#include <CGAL/ARAP_deformation/internal/Options_impl.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Bordered_substitution.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Multifrontal_cholesky_solver_impl.h>
#include <CGAL/ARAP_deformation/internal/constraints/Constraints_impl.h>
#include <CGAL/ARAP_deformation/internal/domain/make_simplex_search_impl.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core_impl.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Rigid_fit_impl.h>
#include <CGAL/ARAP_deformation/internal/region/Numbered_region_impl.h>
#include <CGAL/ARAP_deformation/internal/rotation/Newton_closest_rotation_impl.h>
#include <CGAL/ARAP_deformation/internal/rotation/SVD_closest_rotation_impl.h>
#include <CGAL/ARAP_deformation/internal/session/Built_core_impl.h>
#include <CGAL/ARAP_deformation/internal/session/Region_constraints_impl.h>
#include <CGAL/ARAP_deformation/internal/session/Run_impl.h>
#include <CGAL/ARAP_deformation/internal/session/Time_step_impl.h>
#include <CGAL/ARAP_deformation/internal/session/core_models.h>
#include <CGAL/ARAP_deformation/internal/session/sentences_impl.h>
#include <CGAL/ARAP_deformation/internal/solver/Constrained_system_impl.h>

#include <memory>

template class CGAL::ARAP::internal::Bordered_substitution<double>;
template std::shared_ptr<const CGAL::ARAP::internal::Edge_weight_model>
CGAL::ARAP::internal::make_edge_weight_model(CGAL::ARAP::Safe_cotangent_weight);
template std::shared_ptr<const CGAL::ARAP::internal::Linear_solver>
CGAL::ARAP::internal::make_linear_solver(CGAL::ARAP::Multifrontal_cholesky_solver);
