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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_SHAPE_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_SHAPE_FILE_H

// The two kinds of shapes that the command deforms, with a common interface: each is read at
// construction, deformed through its domain, and written.

#include "Corner_rotation.h"
#include "Gltf_file.h"
#include "Gmsh_file.h"
#include "Medit_file.h"
#include "Vtk_file.h"
#include "Vtu_file.h"
#include "mesh_panel.h"
#include "read_mesh.h"
#include "shape_files.h"

#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/boost/graph/helpers.h>

#include <array>
#include <cstddef>
#include <memory>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL::ARAP::demo {

// A surface of triangles and polygons in an .off, .obj, .ply or .stl file.
class Surface_file
{
public:
  using Domain = Face_graph_domain<Mesh>;

  static constexpr const char* simplices = "faces";

  // For an output of the same format the text of the file is kept.
  Surface_file(const std::string& file, const std::string& output_format)
    : m_format(lower_case_extension(file)), m_mesh(read_mesh(file, m_dropped)),
      m_rest_points(points_of(m_mesh))
  {
    if(output_format == m_format)
      m_source = read_source(file);
    m_is_kept = m_source.points.size() == m_rest_points.size();
  }

  const Mesh& mesh() const { return m_mesh; }
  std::size_t number_of_vertices() const { return m_mesh.number_of_vertices(); }
  std::size_t number_of_simplices() const { return m_mesh.number_of_faces(); }
  Domain domain() { return Domain(m_mesh); }
  bool writes_skin(const std::string& format) const { return is_gltf_format(format); }

  // Throws if a file of this format cannot hold the surface.
  void check_output(const std::string& file, const std::string& format,
                    const std::vector<std::string>&) const
  {
    if(!m_is_kept)
      check_format(file, format, m_mesh);
  }

  // what an output of this format does not keep
  std::set<std::string> dropped(const std::string& format) const
  {
    if(m_is_kept && m_source.has_integer_normals)
      return {"the directions of normals, which are integers and do not turn"};
    if(m_is_kept)
      return {};
    std::set<std::string> result = m_dropped;
    if(format == ".off" && m_format == ".off") // CGAL writes them
      result.erase("texture coordinates");
    if(format != ".off" && format != ".ply" && has_colors(m_mesh))
      result.insert("colors");
    if(is_gltf_format(format) && !CGAL::is_triangle_mesh(m_mesh))
      result.insert("polygons (they are cut into triangles)");
    if(m_format == ".stl")
      result.insert("names and attributes");
    else if(format == ".stl" || is_gltf_format(format))
      result.insert("double precision");
    if(format == ".stl" && has_isolated_vertices(m_mesh))
      result.insert("vertices without a face");
    return result;
  }

  // `skin` is that at rest, so that all frames in glTF have the same triangles.
  void write(Output_file& output, const std::string& format, const Skin& skin)
  {
    if(!m_is_kept)
    {
      if(format == ".ply" && !m_property.empty())
        set_vertex_property(m_mesh, m_property, m_values);
      if(is_gltf_format(format))
      {
        const Panel all =
          panel(skin, points_of(m_mesh), std::vector<int>(m_rest_points.size()), "");
        return output.write([&](std::ostream& out) {
          make_gltf(all.points, all.triangles).write(out, format == ".glb");
        });
      }
      return write_mesh(output, m_mesh, format);
    }
    output.write([&](std::ostream& out) {
      for(Mesh::Vertex_index v : m_mesh.vertices())
        m_source.replace(m_source.points[v], m_rest_points[v] - CGAL::ORIGIN,
                         m_mesh.point(v) - CGAL::ORIGIN);
      turn_normals();
      if(format == ".ply" && !m_property.empty())
        write_property();
      m_source.write(out);
    });
  }

  // What is written for each vertex besides its coordinates, if the format is .ply.
  void set_property(const std::string& name, const std::vector<double>& values)
  {
    m_property = name;
    m_values = values;
  }

private:
  // Writes it over one of the same name, if that has fractions, or behind the others.
  void write_property()
  {
    std::string name = m_property;
    for(; m_source.properties.count(name) > 0; name += '_')
      if(const auto places = places_of_property(m_source, name); places.size() == m_values.size())
      {
        for(std::size_t v = 0; v < m_values.size(); ++v)
          m_source.replace(places[v], m_source.number(m_values[v],
                                                      places[v].end - places[v].begin));
        return;
      }
    const std::size_t end = m_source.properties_end;
    const char* end_of_line = m_source.text.compare(end - 2, 2, "\r\n") == 0 ? "\r\n" : "\n";
    m_source.insert(end, "property float " + name + end_of_line);
    const bool is_text = m_source.numbers == Source_text::Numbers::text;
    for(std::size_t v = 0; v < m_values.size(); ++v)
      m_source.insert(m_source.row_ends[v],
                      (is_text ? " " : "") + m_source.number(m_values[v], sizeof(float)));
  }

  // Each normal turns with the corners that use it.
  void turn_normals()
  {
    for(const Source_text::Normal& normal : m_source.normals)
    {
      Corner_rotation turned(m_mesh, m_rest_points);
      for(const Source_text::Corner& corner : normal.corners)
      {
        const Mesh::Face_index f(static_cast<Mesh::size_type>(corner.face.value_or(0)));
        const Mesh::Vertex_index v(static_cast<Mesh::size_type>(corner.vertex.value_or(0)));
        if(!corner.face)
          turned.insert(v);
        else if(!corner.vertex)
          turned.insert(f);
        else
          turned.insert(f, v);
      }
      if(turned.has_moved())
        m_source.replace(normal.place, normal.value, turned(normal.value));
    }
  }

  std::string m_format;
  std::set<std::string> m_dropped;
  Mesh m_mesh; // deformed
  std::vector<Kernel::Point_3> m_rest_points;
  Source_text m_source;
  std::string m_property; // of the vertices, and its values
  std::vector<double> m_values;
  bool m_is_kept = false; // the text is written with other coordinates
};

// Reads a .mesh, .msh, .vtk or .vtu file.
inline std::unique_ptr<Tetrahedra_text> read_tetrahedra(const std::string& file)
{
  const std::string format = lower_case_extension(file);
  std::unique_ptr<Tetrahedra_text> result;
  if(format == ".msh")
    result = std::make_unique<Gmsh_file>(file);
  else if(format == ".vtk")
    result = std::make_unique<Vtk_file>(file);
  else if(format == ".vtu")
    result = std::make_unique<Vtu_file>(file);
  else
    result = std::make_unique<Medit_file>(file);
  if(result->mesh().tetrahedra.empty())
    throw std::runtime_error(file + ": has no tetrahedra; surfaces are read from .off, .obj, .ply, "
                             ".stl and glTF files");
  return result;
}

// Tetrahedra in a .mesh, .msh, .vtk or .vtu file, the rest of which is kept.
class Tetrahedra_file
{
public:
  using Domain = Tetrahedron_soup_domain<std::vector<Kernel::Point_3>,
                                         std::vector<std::array<int, 4>>>;

  static constexpr const char* simplices = "tetrahedra";

  Tetrahedra_file(const std::string& file, const std::string&)
    : m_format(lower_case_extension(file)), m_file(read_tetrahedra(file)), m_mesh(m_file->mesh())
  {}

  const Tetrahedral_mesh& mesh() const { return m_mesh; }
  std::size_t number_of_vertices() const { return m_mesh.points.size(); }
  std::size_t number_of_simplices() const { return m_mesh.tetrahedra.size(); }
  Domain domain() { return Domain(m_mesh.points, m_mesh.tetrahedra); }
  bool writes_skin(const std::string&) const { return false; }

  void check_output(const std::string&, const std::string&, const std::vector<std::string>&) const
  {}
  void set_property(const std::string&, const std::vector<double>&) {}

  std::set<std::string> dropped(const std::string& format) const
  {
    return format == m_format ? std::set<std::string>()
                              : std::set<std::string>{"all but points and tetrahedra"};
  }

  void write(Output_file& output, const std::string& format, const Skin&)
  {
    if(format == m_format)
      output.write([this](std::ostream& out) { m_file->write(out, m_mesh.points); });
    else
      write_mesh(output, m_mesh);
  }

private:
  std::string m_format;
  std::unique_ptr<Tetrahedra_text> m_file;
  Tetrahedral_mesh m_mesh; // deformed
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_SHAPE_FILE_H
