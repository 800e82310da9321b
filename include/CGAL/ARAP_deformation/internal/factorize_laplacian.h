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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_FACTORIZE_LAPLACIAN_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_FACTORIZE_LAPLACIAN_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/Rigidity_energy.h>
#include <CGAL/ARAP_deformation/internal/laplacian.h>

#include <cmath>

namespace CGAL {
namespace ARAP {
namespace internal {

// a status with the vertex or simplex of the region that it is about, where there is one
struct Diagnosis
{
  Status status = Status::success;
  int vertex = -1;
  int simplex = -1;
};

// Has the solver factorize the Laplacian of the free vertices.
template <typename Solver>
Diagnosis factorize_laplacian(const Rigidity_energy& energy, Solver& solver)
{
  if(const int v = find_unattached_vertex(energy); v >= 0)
    return {Status::no_held_vertex, v};
  const int n = energy.number_of_free_vertices();
  const Sparse_matrix laplacian = free_laplacian(energy);
  for(int v = 0; v < n; ++v) // the first entry of each column is the diagonal
    if(const double diagonal = laplacian.valuePtr()[laplacian.outerIndexPtr()[v]];
       !(diagonal > 0) || !std::isfinite(diagonal))
      return {Status::singular_matrix, v};
  if(n > 0 && !(solver.analyze(laplacian) && solver.factorize(laplacian)))
    return {Status::singular_matrix};
  return {};
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_FACTORIZE_LAPLACIAN_H
