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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_READ_MESH_H
#define CGAL_ARAP_DEFORMATION_DEMO_READ_MESH_H

// Reads surfaces with CGAL. Its readers trust a file: input that would make them crash, or allocate
// without bound, is refused here first.

#include "Source_text.h"
#include "check_obj_file.h"
#include "check_off_file.h"
#include "check_ply_file.h"
#include "check_stl_file.h"
#include "shape_files.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Surface_mesh/IO/OFF.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <ios>
#include <istream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

namespace internal {

using Polygons = std::vector<std::vector<std::size_t>>;

using Corners = std::vector<Mesh::Vertex_index>;

inline bool has_corner_twice(std::vector<std::size_t> polygon)
{
  std::sort(polygon.begin(), polygon.end());
  return std::adjacent_find(polygon.begin(), polygon.end()) != polygon.end();
}

// Why a face with these corners cannot be added to the mesh; number(f) is that of face f.
template <typename Number>
std::string reason_against(const std::vector<std::size_t>& polygon, const Corners& corners,
                           const Mesh& mesh, const Number& number)
{
  if(polygon.size() < 3)
    return "has fewer than three vertices";
  if(has_corner_twice(polygon))
    return "has a vertex twice";
  for(std::size_t i = 0; i < corners.size(); ++i)
    if(const auto h = mesh.halfedge(corners[i], corners[(i + 1) % corners.size()]);
       h != Mesh::null_halfedge() && !mesh.is_border(h))
      return "has an edge, from vertex " + std::to_string(std::size_t(mesh.source(h))) + " to " +
             std::to_string(std::size_t(mesh.target(h))) + ", which face " +
             number(std::size_t(mesh.face(h))) + " has in the same direction: the surface "
             "is not an oriented manifold";
  return "does not form a manifold with the previous faces at one of its vertices";
}

// Builds a mesh of polygons, as CGAL's readers do; but these assume that all corners exist. The
// numbers of the polygons in the file are given where it has others, too.
inline void build_mesh(const std::string& file, const std::vector<Kernel::Point_3>& points,
                       const Polygons& polygons, Mesh& mesh,
                       const std::vector<std::size_t>& numbers = {})
{
  const auto number = [&](std::size_t f) {
    return std::to_string(numbers.empty() ? f : numbers[f]);
  };
  for(const auto& p : points)
    mesh.add_vertex(p);
  for(std::size_t f = 0; f < polygons.size(); ++f)
  {
    Corners corners;
    for(std::size_t v : polygons[f])
    {
      if(v >= points.size())
        throw std::runtime_error(file + ": face " + number(f) +
                                 " has a vertex that does not exist");
      corners.emplace_back(static_cast<Mesh::size_type>(v));
    }
    if(CGAL::Euler::add_face(corners, mesh) == Mesh::null_face())
      throw std::runtime_error(file + ": face " + number(f) + ' ' +
                               reason_against(polygons[f], corners, mesh, number));
  }
}

template <typename Index, typename Value>
void remove_property(Mesh& mesh, const std::string& name)
{
  auto map = mesh.add_property_map<Index, Value>(name).first; // or the one that there is
  mesh.remove_property_map(map);
}

// Returns whether CGAL could read the file. Inserts what is not read of it into `dropped`.
inline bool read_unchecked_mesh(const std::string& file, Mesh& mesh, std::set<std::string>& dropped)
{
  const std::string extension = lower_case_extension(file);
  std::error_code ignored;
  if(std::filesystem::is_other(file, ignored)) // checked first: opening may wait for a writer
    throw std::runtime_error(file + ": is not a regular file; surfaces must be, since they are "
                                    "read more than once");
  std::ifstream in = open_for_reading(file);
  const auto begin = in.tellg();
  in.seekg(0, std::ios::end);
  const auto bytes = static_cast<std::size_t>(in.tellg());
  const auto rewind = [&in, begin] {
    in.clear();
    in.seekg(begin);
  };
  rewind();
  if(extension == ".off")
  {
    const Off_colors colors = check_off_file(in, file, dropped);
    rewind();
    if(CGAL::IO::read_OFF(in, mesh)) // with its colors, black ones where there are none
    {
      if(!colors.are_at_vertices)
        remove_property<Mesh::Vertex_index, CGAL::IO::Color>(mesh, "v:color");
      if(!colors.are_in_faces)
        remove_property<Mesh::Face_index, CGAL::IO::Color>(mesh, "f:color");
      remove_property<Mesh::Vertex_index, Kernel::Vector_3>(mesh, "v:normal"); // wrong after it
      return true;
    }
    mesh.clear(); // read it again, to find the wrong face
    rewind();
  }
  bool is_binary = false;
  if(extension == ".ply")
  {
    is_binary = check_ply_file(in, file, bytes, dropped);
    rewind();
  }
  std::stringstream checked;
  if(extension == ".obj")
    checked = check_obj_file(in, file, dropped);
  if(extension == ".stl")
    checked = check_stl_file(in, file);
  std::vector<Kernel::Point_3> points;
  Polygons polygons;
  const auto quiet = CGAL::parameters::verbose(false);
  const bool is_read = extension == ".off"   ? CGAL::IO::read_OFF(in, points, polygons, quiet)
                       : extension == ".obj" ? CGAL::IO::read_OBJ(checked, points, polygons, quiet)
                       : extension == ".ply" ? CGAL::IO::read_PLY(in, points, polygons, quiet)
                       : extension == ".stl" ? CGAL::IO::read_STL(checked, points, polygons, quiet)
                                             : false;
  if(!is_read && extension == ".ply")
  {
    rewind();
    check_ply_file(in, file, bytes, dropped, true);
  }
  if(is_read && extension == ".ply")
    check_end(in, file, "the elements that the header announces", is_binary);
  std::vector<std::size_t> numbers; // of those that stay
  if(extension == ".stl") // programs round corners, also to the same
  {
    Polygons all;
    all.swap(polygons);
    for(std::size_t f = 0; f < all.size(); ++f)
      if(has_corner_twice(all[f]))
        dropped.insert("triangles with two equal corners");
      else
      {
        polygons.push_back(std::move(all[f]));
        numbers.push_back(f);
      }
  }
  if(is_read)
    build_mesh(file, points, polygons, mesh, numbers);
  return is_read && mesh.is_valid(false);
}

} // namespace internal

// Throws if the mesh has no faces, or coordinates that are not finite, or fans of faces that meet
// in a vertex only, which CGAL may accept where one of them is closed.
inline void check_mesh(const std::string& file, const Mesh& mesh)
{
  if(mesh.number_of_vertices() == 0 || mesh.number_of_faces() == 0)
    throw std::runtime_error(file + ": has no faces");
  for(Mesh::Vertex_index v : mesh.vertices())
    for(int k = 0; k < 3; ++k)
      if(!std::isfinite(mesh.point(v)[k]))
        throw std::runtime_error(file + ": vertex " + std::to_string(std::size_t(v)) +
                                 " has a coordinate that is infinite or not a number");
  std::vector<std::size_t> edges(mesh.number_of_vertices(), 0); // at each vertex
  for(Mesh::Halfedge_index h : mesh.halfedges())
    ++edges[mesh.target(h)];
  for(Mesh::Vertex_index v : mesh.vertices())
    if(edges[v] > 0 && CGAL::halfedges_around_target(mesh.halfedge(v), mesh).size() < edges[v])
      throw std::runtime_error(file + ": the surface is not a manifold at vertex " +
                               std::to_string(std::size_t(v)));
}

// Reads a surface of triangles and polygons; all its coordinates are finite. Inserts what the mesh
// does not have of the file into `dropped`.
inline Mesh read_mesh(const std::string& file, std::set<std::string>& dropped)
{
  Mesh mesh;
  bool is_read = false;
  try
  {
    is_read = internal::read_unchecked_mesh(file, mesh, dropped);
  }
  catch(const std::logic_error&)
  {
    // from CGAL, or from a container that cannot have the size given in the file
  }
  if(!is_read)
    throw std::runtime_error(file + ": cannot be read: it is not in the format of " +
                             lower_case_extension(file) + " files, or has a coordinate that "
                             "is not a finite number");
  check_mesh(file, mesh);
  return mesh;
}

// The text of a file that has been read as a mesh, to write it with other points. If it has no
// places of points, the format does not allow it.
inline Source_text read_source(const std::string& file)
{
  const std::string extension = lower_case_extension(file);
  Source_text source;
  if(extension == ".stl") // each point of a mesh is there several times
    return source;
  source.text = content_of(file);
  std::istringstream in(source.text);
  std::set<std::string> ignored;
  if(extension == ".off")
    check_off_file(in, file, ignored, &source);
  else if(extension == ".obj")
    check_obj_file(in, file, ignored, &source);
  else
    find_places_in_ply_file(in, file, source);
  return source;
}

// The places of the values of a property of vertices in a .ply file; none if it has no fractions.
inline std::vector<Source_text::Span> places_of_property(const Source_text& source,
                                                         const std::string& name)
{
  Source_text result;
  result.text = source.text;
  result.wanted_property = name;
  std::istringstream in(source.text);
  find_places_in_ply_file(in, "", result);
  return result.wanted_values;
}

inline Mesh read_mesh(const std::string& file)
{
  std::set<std::string> dropped;
  return read_mesh(file, dropped);
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_READ_MESH_H
