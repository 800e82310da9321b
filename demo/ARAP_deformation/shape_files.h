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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_SHAPE_FILES_H
#define CGAL_ARAP_DEFORMATION_DEMO_SHAPE_FILES_H

// The files of the command arap_deform: meshes, selections, transforms. Errors are thrown as
// std::runtime_error with a message that names the file and, if there is one, the line.

#include "Output_file.h"
#include "Unwritable.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <istream>
#include <iterator>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

// the points of a mesh whose vertices are numbered without gaps
inline std::vector<Kernel::Point_3> points_of(const Mesh& mesh)
{
  return {mesh.points().begin(), mesh.points().end()};
}

// the 4 x 4 matrix of an affine map, row by row
using Transform = std::array<double, 16>;

// the status of a vertex; handle k has the status k, from HANDLE on
enum Selection_status { FIXED = 0, FREE = 1, HANDLE = 2 };

inline Kernel::Point_3 transformed(const Transform& m, const Kernel::Point_3& p)
{
  return {m[0] * p.x() + m[1] * p.y() + m[2] * p.z() + m[3],
          m[4] * p.x() + m[5] * p.y() + m[6] * p.z() + m[7],
          m[8] * p.x() + m[9] * p.y() + m[10] * p.z() + m[11]};
}

inline Kernel::Plane_3 transformed(const Transform& m, const Kernel::Plane_3& plane)
{
  return plane.transform(Kernel::Aff_transformation_3(m[0], m[1], m[2], m[3], m[4], m[5], m[6],
                                                      m[7], m[8], m[9], m[10], m[11]));
}

// Skips the byte order mark that some programs write at the start of a text.
inline void skip_byte_order_mark(std::istream& in, const std::string& file)
{
  const int first = in.peek();
  if(first != 0xEF && first != 0xFE && first != 0xFF) // no text starts with these bytes
    return;
  std::string mark(3, ' ');
  in.read(mark.data(), 3);
  if(mark == "\xEF\xBB\xBF")
    return;
  if(const std::string two = mark.substr(0, 2); two == "\xFF\xFE" || two == "\xFE\xFF")
    throw std::runtime_error(file + ": is a text in UTF-16; save it in UTF-8");
  in.clear();
  in.seekg(0);
}

inline std::ifstream open_for_reading(const std::string& file)
{
  std::error_code ignored;
  if(!std::filesystem::exists(file, ignored))
    throw std::runtime_error(file + ": there is no such file");
  if(std::filesystem::is_directory(file, ignored))
    throw std::runtime_error(file + ": is a folder, not a file");
  std::ifstream in(file, std::ios::binary);
  if(!in)
    throw std::runtime_error(file + ": cannot be opened for reading");
  skip_byte_order_mark(in, file);
  if(in.peek() == std::ifstream::traits_type::eof())
    throw std::runtime_error(file + ": is empty");
  return in;
}

inline std::string content_of(const std::string& file)
{
  std::ifstream in = open_for_reading(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::string lower_case_extension(const std::string& file)
{
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// a number in the name of a file
inline std::string four_digits(std::size_t number)
{
  const std::string digits = std::to_string(number);
  return std::string(4 - (std::min)(digits.size(), std::size_t(4)), '0') + digits;
}

// Formats of meshes are lower-case extensions.
inline bool is_gltf_format(const std::string& format)
{
  return format == ".gltf" || format == ".glb";
}

inline bool is_surface_format(const std::string& format)
{
  return format == ".off" || format == ".obj" || format == ".ply" || format == ".stl" ||
         is_gltf_format(format);
}

inline bool is_tetrahedra_format(const std::string& format)
{
  return format == ".mesh" || format == ".msh" || format == ".vtk" ||
         format == ".vtu";
}

inline bool is_mesh_format(const std::string& format)
{
  return is_surface_format(format) || is_tetrahedra_format(format);
}

// The format of an output: a pipe or a device whose name does not tell it gets that of the input.
inline std::string output_format(const std::string& output, const std::string& input)
{
  const std::string format = lower_case_extension(output);
  return is_mesh_format(format) || !is_written_directly(output) ? format
                                                                : lower_case_extension(input);
}

// The words of a text. White space separates them; # starts a comment.
class Words
{
public:
  explicit Words(std::string_view text, std::size_t position = 0)
    : m_text(text), m_begin(position), m_end(position)
  {}

  // the next word; empty at the end of the text
  std::string_view next()
  {
    const auto or_end = [this](std::size_t place) { return (std::min)(place, m_text.size()); };
    m_begin = or_end(m_text.find_first_not_of(" \t\r\n\f\v", m_end));
    while(m_begin < m_text.size() && m_text[m_begin] == '#')
      m_begin = or_end(m_text.find_first_not_of(" \t\r\n\f\v",
                                                or_end(m_text.find('\n', m_begin))));
    m_end = or_end(m_text.find_first_of(" \t\r\n\f\v#", m_begin));
    return m_text.substr(m_begin, m_end - m_begin);
  }

  // the next n characters, whatever they are; fewer at the end of the text
  std::string_view skip(std::size_t n)
  {
    m_begin = m_end;
    m_end += (std::min)(n, m_text.size() - m_begin);
    return m_text.substr(m_begin, m_end - m_begin);
  }

  // the positions of the last word and of its end
  std::size_t begin() const { return m_begin; }
  std::size_t end() const { return m_end; }

private:
  std::string_view m_text;
  std::size_t m_begin, m_end;
};

// whether a word, which the end of the text or another character follows, is a finite number that
// CGAL reads: no hexadecimal one
inline bool is_finite_number(std::string_view word)
{
  char* end = nullptr;
  return !word.empty() && word.find_first_of("xX") == std::string_view::npos &&
         std::isfinite(std::strtod(word.data(), &end)) && end == word.data() + word.size();
}

// Calls f(line, line number) for each line of a file that has more than a comment.
template <typename Function>
void for_each_line(const std::string& file, const Function& f)
{
  std::ifstream in = open_for_reading(file);
  std::string line;
  for(int number = 1; std::getline(in, line); ++number)
  {
    line = line.substr(0, line.find('#'));
    if(line.find_first_not_of(" \t\r") != std::string::npos)
      f(line, number);
  }
}

inline std::runtime_error bad_line(const std::string& file, std::size_t number,
                                   const std::string& what)
{
  return std::runtime_error(file + ", line " + std::to_string(number) + ": " + what);
}

// The text of a file, which may contain anything, for a message.
inline std::string printable(std::string_view part)
{
  std::string text(part);
  for(char& c : text)
    c = std::isprint(static_cast<unsigned char>(c)) ? c : '?';
  return text;
}

inline std::string in_quotes(std::string_view word)
{
  return "'" + printable(word.substr(0, 40)) + "'";
}

// Throws if more than white space and comments is left of a file in which `contents` was read.
inline void check_end(std::istream& in, const std::string& file, const std::string& contents,
                      bool is_binary = false)
{
  in.clear();
  char c = 0;
  while((in >> c) && c == '#')
    in.ignore((std::numeric_limits<std::streamsize>::max)(), '\n');
  if(!in)
    return;
  if(is_binary)
    throw std::runtime_error(file + ": has more than " + contents);
  std::size_t line = 1;
  const std::streamoff end = in.tellg();
  in.seekg(0);
  for(std::streamoff i = 0; i < end; ++i)
    line += in.get() == '\n';
  throw bad_line(file, line, "there is more than " + contents);
}

// One status per line and vertex: 0 fixed, 1 free, 2 and more the number of a handle.
inline std::vector<int> read_selection(const std::string& file, std::size_t number_of_vertices)
{
  std::vector<int> selection;
  for_each_line(file, [&](const std::string& line, int number) {
    std::istringstream in(line);
    std::string word, rest;
    in >> word;
    char* end = nullptr;
    const long long status = std::strtoll(word.c_str(), &end, 10); // saturates
    if(*end != '\0' || in >> rest)
      throw bad_line(file, number, "expected one integer, the status of a vertex");
    const auto largest = static_cast<long long>(number_of_vertices) + 1;
    if(status < FIXED || status > largest)
      throw bad_line(file, number, "unknown status " + printable(word) + "; use 0 (fixed), 1 "
                                   "(free), or the number of a handle, from 2 to " +
                                   std::to_string(largest));
    selection.push_back(static_cast<int>(status));
  });
  if(selection.size() != number_of_vertices)
    throw std::runtime_error(file + ": has " + std::to_string(selection.size()) +
                             " statuses, but the mesh has " +
                             std::to_string(number_of_vertices) + " vertices");
  return selection;
}

// Throws if the matrix is not that of an affine map that can be undone.
inline void check_transform(const Transform& m, const std::string& name)
{
  const std::array<double, 4> last_row = {0, 0, 0, 1};
  if(!std::equal(last_row.begin(), last_row.end(), m.begin() + 12))
    throw std::runtime_error(name + ": the last row of the transform is not 0 0 0 1");
  const auto column = [&m](int k) { // divided by its largest entry, so that no product overflows
    const Kernel::Vector_3 v(m[k], m[4 + k], m[8 + k]);
    return v / (std::max)({std::abs(v.x()), std::abs(v.y()), std::abs(v.z())});
  };
  const Kernel::Vector_3 x = column(0), y = column(1), z = column(2);
  const double volume = std::sqrt(x.squared_length() * y.squared_length() * z.squared_length());
  if(!(std::abs(CGAL::determinant(x, y, z)) > 1e-12 * volume))
    throw std::runtime_error(name + ": the transform is singular: it flattens the handle");
}

// Matrices of four rows of four numbers, the last row 0 0 0 1.
inline std::vector<Transform> read_transforms(const std::string& file)
{
  std::vector<double> entries;
  for_each_line(file, [&](const std::string& line, int number) {
    std::istringstream in(line);
    std::string word;
    while(in >> word)
    {
      std::istringstream in_word(word);
      double entry;
      if(!(in_word >> entry) || !in_word.eof() || !std::isfinite(entry))
        throw bad_line(file, number, in_quotes(word) + " is not a finite number");
      entries.push_back(entry);
    }
  });
  if(entries.empty() || entries.size() % 16 != 0)
    throw std::runtime_error(file + ": has " + std::to_string(entries.size()) +
                             " numbers; a transform is a 4 x 4 matrix of 16");
  std::vector<Transform> transforms(entries.size() / 16);
  for(std::size_t k = 0; k < transforms.size(); ++k)
  {
    std::copy_n(entries.begin() + 16 * k, 16, transforms[k].begin());
    check_transform(transforms[k],
                    file + (k == 0 ? "" : ", matrix " + std::to_string(k + 1)));
  }
  return transforms;
}

inline void write_transform(std::ostream& out, const Transform& transform)
{
  out.precision(std::numeric_limits<double>::max_digits10);
  for(int k = 0; k < 16; ++k)
    out << transform[k] << (k % 4 == 3 ? '\n' : ' ');
}

// Throws if the format of the file cannot store the mesh.
inline void check_format(const std::string& file, const std::string& format, const Mesh& mesh)
{
  if(format != ".stl" && format != ".ply")
    return;
  const std::size_t largest = format == ".stl" ? 3 : 255; // as CGAL writes a .ply file
  for(Mesh::Face_index f : mesh.faces())
    if(mesh.degree(f) > largest)
      throw std::runtime_error(file + (largest == 3 ? ": an .stl file holds triangles only"
                                                    : ": the faces of a .ply file that is made "
                                                      "have at most 255 vertices") +
                               ", but face " + std::to_string(std::size_t(f)) + " has " +
                               std::to_string(mesh.degree(f)) + "; .off and .obj files can hold "
                               "all polygons");
}

inline bool has_colors(const Mesh& mesh)
{
  const auto vertex_properties = mesh.properties<Mesh::Vertex_index>();
  const auto face_properties = mesh.properties<Mesh::Face_index>();
  return std::count(vertex_properties.begin(), vertex_properties.end(), "v:color") > 0 ||
         std::count(face_properties.begin(), face_properties.end(), "f:color") > 0;
}

inline bool has_isolated_vertices(const Mesh& mesh)
{
  return std::any_of(mesh.vertices().begin(), mesh.vertices().end(),
                     [&mesh](Mesh::Vertex_index v) { return mesh.is_isolated(v); });
}

// Sets a property that a .ply file holds.
inline void set_vertex_property(Mesh& mesh, const std::string& name,
                                const std::vector<double>& values)
{
  auto map = mesh.add_property_map<Mesh::Vertex_index, float>("v:" + name).first;
  for(Mesh::Vertex_index v : mesh.vertices())
    map[v] = static_cast<float>(values[v]);
}

inline void write_mesh(Output_file& file, const Mesh& mesh, const std::string& format = ".off")
{
  file.write([&](std::ostream& out) {
    const auto precise = CGAL::parameters::stream_precision(17);
    if(format == ".stl")
      for(const Kernel::Point_3& p : mesh.points())
        std::for_each(p.cartesian_begin(), p.cartesian_end(), to_float); // which may throw
    if(format == ".ply" || format == ".stl")
      CGAL::IO::set_binary_mode(out);
    const bool is_written = format == ".off" ? CGAL::IO::write_OFF(out, mesh, precise)
                          : format == ".obj" ? CGAL::IO::write_OBJ(out, mesh, precise)
                          : format == ".ply" ? CGAL::IO::write_PLY(out, mesh, precise)
                                                : CGAL::IO::write_STL(out, mesh, precise);
    if(!is_written)
      out.setstate(std::ios::failbit);
  });
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_SHAPE_FILES_H
