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

#include "Tetrahedra_text.h"
#include "shape_files.h"

#include <array>
#include <cctype>
#include <cstddef>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <string_view>

namespace CGAL::ARAP::demo {

class Medit_file : public Tetrahedra_text
{
public:
  explicit Medit_file(const std::string& file) : Tetrahedra_text(file)
  {
    const std::map<std::string_view, std::size_t> sections = find_sections();
    const auto find = [&](const char* keyword) {
      const auto section = sections.find(keyword);
      if(section == sections.end())
        refuse("has no " + std::string(keyword));
      return Words(text(), section->second);
    };
    Words words = find("Dimension");
    if(words.next() != "3")
      refuse(words, "the Dimension of a mesh of tetrahedra is 3, but this is");
    words = find("Vertices");
    read_vertices(words);
    if(sections.count("Tetrahedra") > 0)
      read_tetrahedra(words = find("Tetrahedra"));
  }

private:
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
      refuse("is binary; of Medit's formats only the text format .mesh can be read, not .meshb");
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

  // Calls read_row(row) for each row of a section.
  template <typename Read_row>
  void read_rows(Words& words, Row row, const Read_row& read_row) const
  {
    for(row.number = 1; row.number <= row.total; ++row.number)
      read_row(row);
    if(const std::string_view word = words.next(); !word.empty() && !is_keyword(word))
      refuse(words, "expected the next section after " + std::to_string(row.total) + ' ' +
                      row.section + ", but found");
  }

  void read_vertices(Words& words)
  {
    const long long n = read_number(words, "Vertices");
    read_rows(words, {"Vertices", 0, n}, [&](const Row& row) {
      read_point(words, [&row] { return row.name(); });
      read_reference(words, row);
    });
  }

  void read_tetrahedra(Words& words)
  {
    const auto largest = static_cast<long long>(m_mesh.points.size());
    const long long n = read_number(words, "Tetrahedra");
    read_rows(words, {"Tetrahedra", 0, n}, [&](const Row& row) {
      std::array<int, 4> corners;
      for(int& corner : corners)
        corner = static_cast<int>(read_integer(words, 1, largest, [&] {
          return "a vertex from 1 to " + std::to_string(largest) + ", a corner in " + row.name();
        }) - 1);
      add_tetrahedron(words, corners, [&row] { return row.name(); });
      read_reference(words, row);
    });
  }
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
