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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_METRIC_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_METRIC_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_matrix.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_transfer.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>

#include <optional>

namespace CGAL {
namespace ARAP {
namespace internal {

// Improves the Laplacian L as a metric. L^-1 knows nothing of the rotations that follow a
// step: long bends, which cost next to nothing, are as stiff for it as stretching, and a run needs
// hundreds of iterations for them. L^-1 + P C^-1 P^T has their true stiffness C on a coarse space
// of deformations P, where each node moves rigidly, and vertices as the weighted mean of what their
// nodes would do with them. C follows the shape: it is built anew as the run goes.
class Coarse_metric
{
public:
  // what depends on neither positions nor constraints
  Coarse_metric(const Deformation_energy& energy, const Sparse_matrix& laplacian,
                const Array<Coordinates>& rest)
    : m_transfer(Coarse_space(laplacian, rest))
  {
    // with more nodes, as in thousands of small parts, a solution costs more than it saves
    const int nodes = m_transfer.space().number_of_nodes();
    if(nodes > 0 && nodes <= m_transfer.space().number_of_vertices() / 32)
      m_matrix.emplace(m_transfer, energy, laplacian);
  }

  bool is_of_use() const { return m_matrix.has_value(); }

  // Computes P and the factor of C at the positions x; false if there is none. `matrix` is L with
  // the rows of the constraints.
  bool build(const Deformation_energy& energy, const Sparse_matrix& matrix,
             const Array<char>& is_fixed, const Array<Coordinates>& x,
             const Array<Matrix_3x3>& rotations)
  {
    m_transfer.place(is_fixed, x);
    return m_matrix->build(m_transfer, energy, matrix, rotations);
  }

  // step += P C^-1 P^T f
  bool add_solution(const Array<Coordinates>& force, Array<Coordinates>& step)
  {
    Array<Coordinates> u = restricted(force);
    if(!solve(u))
      return false;
    add_prolonged(u, step);
    return true;
  }

  // P^T f: two vectors for each node
  Array<Coordinates> restricted(const Array<Coordinates>& force) const
  {
    return m_transfer.restricted(force);
  }

  // u := C^-1 u
  bool solve(Array<Coordinates>& u) { return m_matrix->solve(u); }

  // step += P u
  void add_prolonged(const Array<Coordinates>& u, Array<Coordinates>& step) const
  {
    m_transfer.add_prolonged(u, step);
  }

private:
  Coarse_transfer m_transfer;
  std::optional<Coarse_matrix> m_matrix; // if it pays
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_METRIC_H
