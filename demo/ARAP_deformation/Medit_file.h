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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_MEDIT_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_MEDIT_FILE_H

// Tetrahedra in .mesh files, the ASCII format of Medit.

#include "Source_text.h"
#include "shape_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <map>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL::ARAP::demo {

struct Tetrahedral_mesh
{
  std::vector<Kernel::Point_3> points;
  std::vector<std::array<int, 4>> tetrahedra; // indices into `points`
};

inline const std::vector<Kernel::Point_3>& points_of(const Tetrahedral_mesh& mesh)
{
  return mesh.points;
}

// The tetrahedra of a .mesh file, and its text: it is written with new coordinates, and otherwise
// unchanged to the byte, with all its references, comments and sections.
class Medit_file
{
public:
  // Throws a std::runtime_error whose message names the file, the line and what is wrong.
  explicit Medit_file(const std::string& file) : m_name(file)
  {
    m_source.text = content_of(file);
    const std::map<std::string_view, std::size_t> sections = find_sections();
    const auto find = [&](const char* keyword, const std::string& sentence) {
      const auto section = sections.find(keyword);
      if(section == sections.end())
        throw std::runtime_error(m_name + ": " + sentence);
      return Words(text(), section->second);
    };
    const std::string no_tetrahedra = "has no tetrahedra; surfaces are read from .off, .obj, .ply "
                                      "and .stl files";
    Words words = find("Dimension", "has no Dimension");
    if(words.next() != "3")
      refuse(words, "the Dimension of a mesh of tetrahedra is 3, but this is");
    words = find("Vertices", "has no Vertices");
    read_vertices(words);
    words = find("Tetrahedra", no_tetrahedra);
    read_tetrahedra(words);
    if(m_mesh.tetrahedra.empty())
      throw std::runtime_error(m_name + ": " + no_tetrahedra);
  }

  const Tetrahedral_mesh& mesh() const { return m_mesh; }

  // Writes the file with these points. Unchanged coordinates keep their text.
  void write(std::ostream& out, const std::vector<Kernel::Point_3>& points)
  {
    for(std::size_t v = 0; v < points.size(); ++v)
      m_source.replace(m_source.points[v], m_mesh.points[v] - CGAL::ORIGIN,
                       points[v] - CGAL::ORIGIN);
    m_source.write(out);
  }

private:
  const std::string& text() const { return m_source.text; }

  // Throws a message: `expected`, continued by what is there instead.
  [[noreturn]] void refuse(const Words& words, const std::string& expected) const
  {
    const auto line = 1 + std::count(text().begin(), text().begin() + words.begin(), '\n');
    const bool is_end = words.begin() == text().size();
    const auto word = std::string_view(text()).substr(words.begin(), words.end() - words.begin());
    throw bad_line(m_name, static_cast<std::size_t>(line),
                   expected + (is_end ? " the end of the file" : ' ' + in_quotes(word)));
  }

  static bool is_keyword(std::string_view word)
  {
    return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0]));
  }

  // whether these elements would be torn apart, since only tetrahedra are deformed
  static bool is_unknown_element(std::string_view keyword)
  {
    const std::size_t n = keyword.size();
    const bool is_curved = n > 2 && (keyword[n - 2] == 'P' || keyword[n - 2] == 'Q') &&
                           std::isdigit(static_cast<unsigned char>(keyword[n - 1]));
    const std::string_view name = keyword.substr(0, is_curved ? n - 2 : n);
    const bool is_of_another_shape = name == "Hexahedra" || name == "Prisms" || name == "Pyramids";
    return is_of_another_shape || (is_curved && (name == "Edges" || name == "Triangles" ||
                                                 name == "Quadrilaterals" || name == "Tetrahedra"));
  }

  // The positions of the contents of the sections that are read. Other sections may hold anything;
  // they end at the next keyword.
  std::map<std::string_view, std::size_t> find_sections() const
  {
    Words words(text());
    const std::string_view first = words.next();
    if(text().find('\0') != std::string::npos)
      throw std::runtime_error(m_name + ": is binary; of Medit's formats only the text format "
                                        ".mesh can be read, not .meshb");
    if(first != "MeshVersionFormatted")
      refuse(words, "a .mesh file starts with 'MeshVersionFormatted', but this with");
    std::map<std::string_view, std::size_t> sections;
    for(std::string_view word = words.next(); !word.empty() && word != "End"; word = words.next())
      if(word == "Dimension" || word == "Vertices" || word == "Tetrahedra")
      {
        if(!sections.emplace(word, words.end()).second)
          refuse(words, "the file has a second section");
      }
      else if(is_unknown_element(word))
      {
        Words contents(text(), words.end());
        if(contents.next() != "0")
          refuse(words, "only tetrahedra with four vertices can be deformed, but there are");
      }
    return sections;
  }

  // a row of a section, for messages about it
  struct Row
  {
    const char* section;
    long long number, total;

    std::string name() const
    {
      return "row " + std::to_string(number) + " of the " + std::to_string(total) + ' ' + section;
    }
  };

  // Reads an integer from `smallest` to `largest`; description() tells what is expected.
  template <typename Description>
  long long read_integer(Words& words, long long smallest, long long largest,
                         const Description& description) const
  {
    char* end = nullptr;
    const bool is_end = words.next().empty();
    const long long value = std::strtoll(text().c_str() + words.begin(), &end, 10); // saturates
    if(is_end || end != text().c_str() + words.end() || value < smallest || value > largest)
      refuse(words, "expected " + description() + ", but found");
    return value;
  }

  double read_coordinate(Words& words, const Row& row) const
  {
    char* end = nullptr;
    const bool is_end = words.next().empty();
    const double value = std::strtod(text().c_str() + words.begin(), &end);
    if(is_end || end != text().c_str() + words.end() || !std::isfinite(value))
      refuse(words, "expected a finite number, a coordinate in " + row.name() + ", but found");
    return value;
  }

  void read_reference(Words& words, const Row& row) const
  {
    read_integer(words, (std::numeric_limits<long long>::min)(),
                 (std::numeric_limits<long long>::max)(),
                 [&] { return "an integer, the reference in " + row.name(); });
  }

  // Reads the number of rows of a section.
  long long read_number(Words& words, const char* section) const
  {
    return read_integer(words, 0, (std::numeric_limits<int>::max)(), [section] {
      return std::string("how many ") + section + " there are";
    });
  }

  // Calls read_row(row), which returns an item, for each row of a section. Allocates no more than
  // the file has room for, whatever it announces.
  template <typename Items, typename Read_row>
  void read_rows(Words& words, Row row, Items& items, const Read_row& read_row) const
  {
    const std::size_t shortest = 8; // in characters
    items.reserve((std::min)(static_cast<std::size_t>(row.total),
                             (text().size() - words.end()) / shortest));
    for(row.number = 1; row.number <= row.total; ++row.number)
      items.push_back(read_row(row));
    if(const std::string_view word = words.next(); !word.empty() && !is_keyword(word))
      refuse(words, "expected the next section after " + std::to_string(row.total) + ' ' +
                      row.section + ", but found");
  }

  void read_vertices(Words& words)
  {
    const long long n = read_number(words, "Vertices");
    read_rows(words, {"Vertices", 0, n}, m_mesh.points, [&](const Row& row) {
      Words place = words;
      m_source.points.push_back(Source_text::next_triple(place));
      std::array<double, 3> p;
      for(double& coordinate : p)
        coordinate = read_coordinate(words, row);
      read_reference(words, row);
      return Kernel::Point_3(p[0], p[1], p[2]);
    });
  }

  void read_tetrahedra(Words& words)
  {
    const auto largest = static_cast<long long>(m_mesh.points.size());
    const long long n = read_number(words, "Tetrahedra");
    read_rows(words, {"Tetrahedra", 0, n}, m_mesh.tetrahedra, [&](const Row& row) {
      std::array<int, 4> corners;
      for(auto corner = corners.begin(); corner != corners.end(); ++corner)
      {
        *corner = static_cast<int>(read_integer(words, 1, largest, [&] {
          return "a vertex from 1 to " + std::to_string(largest) + ", a corner in " + row.name();
        }) - 1);
        if(std::find(corners.begin(), corner, *corner) != corner)
          refuse(words, row.name() + " has twice the vertex");
      }
      read_reference(words, row);
      return corners;
    });
  }

  std::string m_name;
  Source_text m_source;
  Tetrahedral_mesh m_mesh;
};

// Writes a new .mesh file with all references 0.
inline void write_mesh(Output_file& file, const Tetrahedral_mesh& mesh)
{
  file.write([&](std::ostream& out) {
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "MeshVersionFormatted 2\nDimension 3\nVertices " << mesh.points.size() << '\n';
    for(const auto& p : mesh.points)
      out << p.x() << ' ' << p.y() << ' ' << p.z() << " 0\n";
    out << "Tetrahedra " << mesh.tetrahedra.size() << '\n';
    for(const auto& [a, b, c, d] : mesh.tetrahedra)
      out << a + 1 << ' ' << b + 1 << ' ' << c + 1 << ' ' << d + 1 << " 0\n";
    out << "End\n";
  });
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_MEDIT_FILE_H
