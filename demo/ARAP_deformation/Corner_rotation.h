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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_CORNER_ROTATION_H
#define CGAL_ARAP_DEFORMATION_DEMO_CORNER_ROTATION_H

#include "shape_files.h"

#include <CGAL/ARAP_deformation/SVD_closest_rotation.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/boost/graph/iterator.h>

#include <cmath>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// The rotation that fits best to what a deformation does to corners of faces: to the directions of
// their two edges and their normal.
class Corner_rotation
{
public:
  Corner_rotation(const Mesh& mesh, const std::vector<Kernel::Point_3>& rest_points)
    : m_mesh(mesh), m_rest_points(rest_points)
  {}

  // Inserts the corner between a halfedge and the next one.
  void insert(Mesh::Halfedge_index h)
  {
    const auto u = m_mesh.source(h), v = m_mesh.target(h), w = m_mesh.target(m_mesh.next(h));
    const auto a = m_rest_points[u] - m_rest_points[v], b = m_rest_points[w] - m_rest_points[v],
               c = m_mesh.point(u) - m_mesh.point(v), d = m_mesh.point(w) - m_mesh.point(v);
    m_has_moved = m_has_moved || a != c || b != d;
    for(const auto& [from, to] : {std::pair(a, c), std::pair(b, d),
                                  std::pair(CGAL::cross_product(b, a), CGAL::cross_product(d, c))})
      if(const double length = std::sqrt(from.squared_length() * to.squared_length()); length > 0)
        for(int k = 0; k < 9; ++k)
          m_covariance[k] += to[k / 3] * from[k % 3] / length;
  }

  // Inserts the corner of a face at a vertex.
  void insert(Mesh::Face_index f, Mesh::Vertex_index v)
  {
    for(Mesh::Halfedge_index h : CGAL::halfedges_around_face(m_mesh.halfedge(f), m_mesh))
      if(m_mesh.target(h) == v)
        insert(h);
  }

  // Inserts the corners of a face.
  void insert(Mesh::Face_index f)
  {
    for(Mesh::Halfedge_index h : CGAL::halfedges_around_face(m_mesh.halfedge(f), m_mesh))
      insert(h);
  }

  // Inserts the corners of all faces at a vertex.
  void insert(Mesh::Vertex_index v)
  {
    if(!m_mesh.is_isolated(v))
      for(Mesh::Halfedge_index h : CGAL::halfedges_around_target(m_mesh.halfedge(v), m_mesh))
        if(!m_mesh.is_border(h))
          insert(h);
  }

  // whether a corner has another form or direction than before
  bool has_moved() const { return m_has_moved; }

  Kernel::Vector_3 operator()(const Kernel::Vector_3& v) const
  {
    Matrix_3x3 r;
    SVD_closest_rotation()(1, &m_covariance, &r);
    return {r[0] * v.x() + r[1] * v.y() + r[2] * v.z(), r[3] * v.x() + r[4] * v.y() + r[5] * v.z(),
            r[6] * v.x() + r[7] * v.y() + r[8] * v.z()};
  }

private:
  const Mesh& m_mesh;
  const std::vector<Kernel::Point_3>& m_rest_points;
  Matrix_3x3 m_covariance = {};
  bool m_has_moved = false;
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_CORNER_ROTATION_H
