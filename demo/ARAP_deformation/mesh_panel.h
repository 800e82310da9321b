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

#include "Medit_file.h"
#include "Scene.h"
#include "shape_files.h"

#include <CGAL/enum.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/domain/triangles_of_polygon.h>
#include <CGAL/Kernel/global_functions_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// The triangles of a shape that are drawn; their corners are indices into the list of vertices.
struct Skin
{
  std::vector<std::size_t> vertices;
  std::vector<std::array<int, 3>> triangles;
};

// All of a surface, whose vertices are numbered without gaps.
inline Skin skin(const Mesh& mesh)
{
  Skin result;
  result.vertices.assign(mesh.vertices_begin(), mesh.vertices_end());
  std::vector<int> corners;
  ARAP::internal::Array<Coordinates> points;
  for(Mesh::Face_index f : mesh.faces())
  {
    corners.clear();
    points.clear();
    for(Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
    {
      corners.push_back(static_cast<int>(v));
      points.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
    }
    if(corners.size() == 3)
      result.triangles.push_back({corners[0], corners[1], corners[2]});
    else
      for(const auto& [a, b, c] : ARAP::internal::triangles_of_polygon(points))
        result.triangles.push_back({corners[a], corners[b], corners[c]});
  }
  return result;
}

// The boundary of tetrahedra, oriented outwards: the faces of only one tetrahedron.
inline Skin skin(const Tetrahedral_mesh& mesh)
{
  using Triangle = std::array<int, 3>;
  std::vector<std::pair<Triangle, Triangle>> faces; // with sorted corners, and oriented outwards
  faces.reserve(4 * mesh.tetrahedra.size());
  for(std::array<int, 4> t : mesh.tetrahedra)
  {
    const auto& p = mesh.points;
    if(CGAL::orientation(p[t[0]], p[t[1]], p[t[2]], p[t[3]]) == CGAL::NEGATIVE)
      std::swap(t[2], t[3]);
    for(const Triangle& face : {Triangle{t[1], t[2], t[3]}, Triangle{t[0], t[3], t[2]},
                                Triangle{t[0], t[1], t[3]}, Triangle{t[0], t[2], t[1]}})
    {
      faces.emplace_back(face, face);
      std::sort(faces.back().first.begin(), faces.back().first.end());
    }
  }
  std::sort(faces.begin(), faces.end());

  Skin result;
  std::vector<int> places(mesh.points.size(), -1); // in the list of vertices
  for(auto face = faces.begin(); face != faces.end();)
  {
    const auto end = std::find_if(face, faces.end(),
                                  [&](const auto& other) { return other.first != face->first; });
    if(end - face == 1)
    {
      for(int& v : face->second)
      {
        if(places[v] < 0)
        {
          places[v] = static_cast<int>(result.vertices.size());
          result.vertices.push_back(v);
        }
        v = places[v];
      }
      result.triangles.push_back(face->second);
    }
    face = end;
  }
  return result;
}

// The panel of a shape whose vertex v is at points[v].
inline Panel panel(const Skin& skin, const std::vector<Kernel::Point_3>& points,
                   const std::vector<int>& selection, const std::string& caption)
{
  Panel result;
  for(std::size_t v : skin.vertices)
  {
    result.points.push_back({points[v].x(), points[v].y(), points[v].z()});
    result.selection.push_back((std::min)(selection[v], int(HANDLE))); // all handles look the same
  }
  result.triangles = skin.triangles;
  result.caption = caption;
  return result;
}

template <typename Shape>
Panel panel(const Shape& shape, const std::vector<int>& selection, const std::string& caption)
{
  return panel(skin(shape), points_of(shape), selection, caption);
}

// The measures as colors: from 0 to 1 for the largest, which the caption tells.
inline void color(Panel& panel, const std::string& name, const Skin& boundary,
                  const std::vector<double>& values)
{
  for(std::size_t v : boundary.vertices)
    panel.values.push_back(std::abs(values[v]));
  const double largest = *std::max_element(panel.values.begin(), panel.values.end());
  for(double& value : panel.values)
    value = largest > 0 ? value / largest : 0;
  std::ostringstream caption;
  caption.precision(3);
  caption << name << " up to " << largest;
  panel.caption = caption.str();
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_MESH_PANEL_H
