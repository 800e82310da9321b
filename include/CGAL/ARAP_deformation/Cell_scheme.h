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

#ifndef CGAL_ARAP_DEFORMATION_CELL_SCHEME_H
#define CGAL_ARAP_DEFORMATION_CELL_SCHEME_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationOptions
/// the kinds of edge sets over which the energy is summed.
enum class Edge_set
{
  star,   ///< the edges \f$(i, j)\f$ from a vertex \f$i\f$ to its neighbors
  simplex ///< the edges of one simplex: the three of a triangle, the six of a tetrahedron, the
          ///< sides and diagonals of a polygon
};

/// \ingroup PkgARAPDeformationOptions
/// \brief defines which edges share a rotation. Chosen at run time.
///
/// A *cell* is a group of edge sets that share one rotation. The schemes differ in the kind of edge
/// set, and in whether a cell is a single edge set or all edge sets at a vertex. Each cell \f$c\f$
/// adds to the energy \f$\sum_{(i,j) \in c} w_{ij} \|(p'_i - p'_j) - R_c (p_i - p_j)\|^2\f$, with
/// the points \f$p\f$ of the rest shape: see \ref ARAPDeformation_Energy, and
/// \ref ARAPDeformation_Cells for which to choose.
class Cell_scheme
{
public:
  /// the cells of Sorkine and Alexa \cgalCite{Sorkine2007AsRigidAs}, Equation (3): one for each
  /// vertex, with the edges to its neighbors.
  static constexpr Cell_scheme spokes() { return Cell_scheme(Edge_set::star, false); }

  /// one cell for each vertex, with the stars of all vertices within `k` rings around it: the
  /// larger the cells, the smoother the rotations, and the stiffer the shape. At most 100;
  /// `k_ring(0)` is `spokes()`. The cost of a local step is proportional to
  /// the number of stars in a cell.
  static constexpr Cell_scheme k_ring(unsigned int k)
  {
    return Cell_scheme(Edge_set::star, false, k);
  }

  /// one cell for each vertex, with the edges of all incident simplices
  /// \cgalCite{Chao2010SimpleGeomModel}. The energy is never negative with cotangent weights. The
  /// default.
  static constexpr Cell_scheme spokes_and_rims() { return Cell_scheme(Edge_set::simplex, true); }

  /// one cell for each simplex. A surface then has no bending stiffness: it is a membrane that
  /// folds freely.
  static constexpr Cell_scheme elements() { return Cell_scheme(Edge_set::simplex, false); }

  /// returns the kind of the edge sets.
  constexpr Edge_set edge_set() const { return m_edge_set; }

  /// returns `true` if a cell consists of all simplices at a vertex, `false` if each edge set is a
  /// cell.
  constexpr bool grouped_at_vertices() const { return m_grouped_at_vertices; }

  /// returns within how many rings around a vertex the stars are that make its cell.
  constexpr unsigned int rings() const { return m_rings; }

  /// returns `true` if there is one cell for each vertex, `false` if one for each simplex.
  constexpr bool has_vertex_cells() const
  {
    return m_edge_set == Edge_set::star || m_grouped_at_vertices;
  }

  friend constexpr bool operator==(Cell_scheme a, Cell_scheme b)
  {
    return a.m_edge_set == b.m_edge_set && a.m_grouped_at_vertices == b.m_grouped_at_vertices &&
           a.m_rings == b.m_rings;
  }

  friend constexpr bool operator!=(Cell_scheme a, Cell_scheme b) { return !(a == b); }

private:
  constexpr Cell_scheme(Edge_set edge_set, bool grouped_at_vertices, unsigned int rings = 0)
    : m_edge_set(edge_set), m_grouped_at_vertices(grouped_at_vertices), m_rings(rings)
  {}

  Edge_set m_edge_set;
  bool m_grouped_at_vertices;
  unsigned int m_rings;
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_CELL_SCHEME_H
