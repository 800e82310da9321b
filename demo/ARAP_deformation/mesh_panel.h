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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_MESH_PANEL_H
#define CGAL_ARAP_DEFORMATION_DEMO_MESH_PANEL_H

#include "Scene.h"
#include "shape_files.h"

#include <string>
#include <vector>

namespace CGAL::ARAP::demo {

// The panel of a picture that shows a triangle mesh. Its vertices are numbered without gaps.
inline Panel panel(const Mesh& mesh, const std::vector<int>& selection, const std::string& caption)
{
  Panel result;
  for(Mesh::Vertex_index v : mesh.vertices())
    result.points.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
  for(Mesh::Face_index f : mesh.faces())
  {
    const auto h = mesh.halfedge(f);
    const Mesh::Vertex_index a = mesh.source(h), b = mesh.target(h), c = mesh.target(mesh.next(h));
    result.triangles.push_back({static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
  }
  result.selection = selection;
  result.caption = caption;
  return result;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_MESH_PANEL_H
