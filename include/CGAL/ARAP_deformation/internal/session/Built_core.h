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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_BUILT_CORE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_BUILT_CORE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/energy/Energy_model.h>
#include <CGAL/ARAP_deformation/internal/linkage.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Deformation_core.h>
#include <CGAL/ARAP_deformation/internal/region/Region.h>

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <memory>

namespace CGAL {
namespace ARAP {
namespace internal {

// Keeps a program from linking with a core of another version of Eigen, or one whose memory Eigen
// aligns differently, for example if only one is compiled with -mavx: one would free memory that
// the other has allocated differently.
template <int alignment = EIGEN_MAX_ALIGN_BYTES,
          int version = 10 * EIGEN_WORLD_VERSION + EIGEN_MAJOR_VERSION>
struct Eigen_build
{};

// a sentence on the stiffness of the cells of a region
Outcome check_stiffness(const Energy_model& energy_model, const Region& region);

// A core with the positions of the vertices of its region, which are known by their numbers.
struct Built_core
{
  using Models = std::function<Core_models()>; // makes those of one region

  std::size_t numbering; // of the vertices: no other region has the same
  bool is_whole;         // whether all of the region of interest is movable
  Array<Coordinates> positions;
  std::unique_ptr<Deformation_core> core;

  Built_core(std::size_t number, bool is_whole_);
  ~Built_core();

  bool is_movable(int v) const;

  // adds the points of the next vertex of the region
  void add_points(const Coordinates& present, const Coordinates& rest, Region& region);

  // computes what depends on the region alone
  Outcome make_core(const Models& models, Region& region, Energy_model& energy_model,
                    Minimization_order order, const Options& options, Eigen_build<> = {});

  // a sentence on what the core found
  Outcome explain(const Diagnosis& diagnosis) const;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#ifndef CGAL_ARAP_DEFORMATION_COMPILED
#include <CGAL/ARAP_deformation/internal/session/Built_core_impl.h>
#endif

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_BUILT_CORE_H
