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

// The files of the command arap_deform: meshes, selections, transforms. What cannot be read or
// written is a std::runtime_error whose sentence names the file and, where there is one, the line.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

// the 4 x 4 matrix of an affine map, row by row
using Transform = std::array<double, 16>;

enum Selection_status { FIXED = 0, FREE = 1, HANDLE = 2 };

inline Kernel::Point_3 transformed(const Transform& m, const Kernel::Point_3& p)
{
  return {m[0] * p.x() + m[1] * p.y() + m[2] * p.z() + m[3],
          m[4] * p.x() + m[5] * p.y() + m[6] * p.z() + m[7],
          m[8] * p.x() + m[9] * p.y() + m[10] * p.z() + m[11]};
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
  if(in.peek() == std::ifstream::traits_type::eof())
    throw std::runtime_error(file + ": is empty");
  return in;
}

inline std::string lower_case_extension(const std::string& file)
{
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

inline void check_mesh_extension(const std::string& file)
{
  const std::string extension = lower_case_extension(file);
  if(extension != ".off" && extension != ".obj" && extension != ".ply" && extension != ".stl")
    throw std::runtime_error(file + ": the name of a mesh file ends in .off, .obj, .ply or .stl");
}

inline Mesh read_mesh(const std::string& file)
{
  check_mesh_extension(file);
  open_for_reading(file);
  Mesh mesh;
  if(!CGAL::IO::read_polygon_mesh(file, mesh))
    throw std::runtime_error(file + ": cannot be read: it is not in the format of " +
                             lower_case_extension(file) + " files, or holds a coordinate that is "
                             "not a finite number, or is not an oriented manifold surface");
  if(mesh.number_of_vertices() == 0 || mesh.number_of_faces() == 0)
    throw std::runtime_error(file + ": has no faces");
  return mesh;
}

// Calls f(line, number of the line) for each line of a file that holds more than a comment.
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

inline std::runtime_error bad_line(const std::string& file, int number, const std::string& what)
{
  return std::runtime_error(file + ", line " + std::to_string(number) + ": " + what);
}

// One status a line and vertex: 0 fixed, 1 free, 2 handle.
inline std::vector<int> read_selection(const std::string& file, std::size_t number_of_vertices)
{
  std::vector<int> selection;
  for_each_line(file, [&](const std::string& line, int number) {
    std::istringstream in(line);
    int status;
    std::string rest;
    if(!(in >> status) || in >> rest)
      throw bad_line(file, number, "expected one integer, the status of a vertex");
    if(status != FIXED && status != FREE && status != HANDLE)
      throw bad_line(file, number, "unknown status " + std::to_string(status) +
                                     "; it is 0 (fixed), 1 (free) or 2 (handle)");
    selection.push_back(status);
  });
  if(selection.size() != number_of_vertices)
    throw std::runtime_error(file + ": has " + std::to_string(selection.size()) +
                             " statuses, but the mesh has " +
                             std::to_string(number_of_vertices) + " vertices");
  return selection;
}

// Four rows of four numbers, the last row 0 0 0 1.
inline Transform read_transform(const std::string& file)
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
        throw bad_line(file, number, "'" + word + "' is not a finite number");
      entries.push_back(entry);
    }
  });
  Transform transform;
  if(entries.size() != transform.size())
    throw std::runtime_error(file + ": has " + std::to_string(entries.size()) +
                             " numbers; a transform is a 4 x 4 matrix");
  std::copy(entries.begin(), entries.end(), transform.begin());
  if(!std::equal(transform.begin() + 12, transform.end(), std::array<double, 4>{0, 0, 0, 1}.begin()))
    throw std::runtime_error(file + ": the last row of the transform is not 0 0 0 1");
  return transform;
}

// A file that is written under a temporary name beside its own, and gets its own only by commit():
// no other program ever sees half of it, and nothing is left if commit() is never reached.
class Output_file
{
public:
  explicit Output_file(const std::string& file) : m_file(file)
  {
    std::filesystem::path path(file);
    const std::string unique = std::to_string(std::random_device()());
    const std::string extension = path.extension().string(); // writers look at it
    m_temporary = path.replace_extension("." + unique + extension).string();
    std::error_code ignored;
    if(std::filesystem::is_directory(file, ignored) || !std::ofstream(m_temporary))
      throw std::runtime_error(file + ": cannot be written");
  }

  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  ~Output_file()
  {
    std::error_code ignored;
    std::filesystem::remove(m_temporary, ignored);
  }

  const std::string& temporary() const { return m_temporary; }

  std::runtime_error failure() const
  {
    return std::runtime_error(m_file + ": could not be written to the end");
  }

  void commit()
  {
    std::error_code error;
    std::filesystem::rename(m_temporary, m_file, error);
    if(error)
      throw failure();
  }

private:
  std::string m_file, m_temporary;
};

inline void write_mesh(const Output_file& file, const Mesh& mesh)
{
  if(!CGAL::IO::write_polygon_mesh(file.temporary(), mesh,
                                   CGAL::parameters::stream_precision(17)))
    throw file.failure();
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_SHAPE_FILES_H
