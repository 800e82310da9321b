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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_FACTORIZE_LAPLACIAN_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_FACTORIZE_LAPLACIAN_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/solver/laplacian.h>

#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// a status with the vertex or simplex of the region that it is about, where there is one
struct Diagnosis
{
  Status status = Status::success;
  int vertex = -1;
  int simplex = -1;
  std::vector<int> components = {}; // of no_fixed_vertex: find_unconstrained_components()
};

// Why the Laplacian of the free vertices cannot be factorized, where that can be told before.
inline Diagnosis find_fault(const Deformation_energy& energy, const Sparse_matrix& laplacian)
{
  std::vector<int> components = find_unconstrained_components(energy);
  for(int v : components)
    if(v >= 0)
      return {Status::no_fixed_vertex, v, -1, std::move(components)};
  for(int v = 0; v < laplacian.cols(); ++v)
    if(const double d = diagonal_entry(laplacian, v); !(d > 0) || !std::isfinite(d))
      return {Status::singular_matrix, v};
  return {};
}

// Has the solver factorize the Laplacian of the free vertices.
template <typename Solver>
Diagnosis factorize_laplacian(const Deformation_energy& energy, Solver& solver)
{
  const Sparse_matrix laplacian = free_laplacian(energy);
  if(Diagnosis fault = find_fault(energy, laplacian); fault.status != Status::success)
    return fault;
  if(laplacian.rows() > 0 && !(solver.analyze(laplacian) && solver.factorize(laplacian)))
    return {Status::singular_matrix};
  return {};
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_FACTORIZE_LAPLACIAN_H
