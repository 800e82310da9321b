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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_LAPLACIAN_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_LAPLACIAN_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Edge_sets.h>
#include <CGAL/ARAP_deformation/internal/Rigidity_energy.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <numeric>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Half the Hessian of the energy with its rotations fixed, for the first n vertices: the matrix of
// Equation (9) of the paper, from which the held vertices' rows and columns are left out, so that
// it is symmetric positive definite. The lower triangle.
inline Sparse_matrix free_laplacian(const Rigidity_energy& energy, int n)
{
  std::vector<Eigen::Triplet<double, int>> entries;
  energy.for_each_edge([&](const Weighted_edge& edge, double stiffness) {
    const double w = stiffness * edge.weight;
    if(edge.i < n) entries.emplace_back(edge.i, edge.i, w);
    if(edge.j < n) entries.emplace_back(edge.j, edge.j, w);
    if(edge.i < n && edge.j < n)
      entries.emplace_back((std::max)(edge.i, edge.j), (std::min)(edge.i, edge.j), -w);
  });
  Sparse_matrix laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}

// A free vertex from which no edge of non-zero weight leads, over other free vertices, to a held
// one: its component could be anywhere, and the matrix is singular. Returns -1 if there is none.
inline int find_unattached_vertex(const Rigidity_energy& energy, int number_of_free_vertices)
{
  // union-find, with one more element for all held vertices together
  const int held = number_of_free_vertices;
  std::vector<int> parent(number_of_free_vertices + 1);
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&parent](int v) {
    while(parent[v] != v)
      v = parent[v] = parent[parent[v]];
    return v;
  };
  energy.for_each_edge([&](const Weighted_edge& edge, double stiffness) {
    if(stiffness * edge.weight != 0)
      parent[find((std::min)(edge.i, held))] = find((std::min)(edge.j, held));
  });
  for(int v = 0; v < number_of_free_vertices; ++v)
    if(find(v) != find(held))
      return v;
  return -1;
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_LAPLACIAN_H
