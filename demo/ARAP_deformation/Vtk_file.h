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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_VTK_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_VTK_FILE_H

#include "Tetrahedra_text.h"

#include <boost/algorithm/string/predicate.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL::ARAP::demo {

// whether VTK's cells of a type are points, lines or polygons: they move with their vertices
inline bool is_flat_vtk_cell(long long type) { return type >= 1 && type <= 9; }

const int vtk_tetrahedron = 10;

// Tetrahedra in .vtk files: unstructured grids in the legacy format of VTK, as text. Data of points
// and cells are kept as they are.
class Vtk_file : public Tetrahedra_text
{
public:
  explicit Vtk_file(const std::string& file) : Tetrahedra_text(file)
  {
    const std::size_t title = text().find('\n');
    if(text().rfind("# vtk DataFile", 0) != 0 || title == std::string::npos)
      refuse("does not start with '# vtk DataFile'");
    Words words(text(), text().find('\n', title + 1));
    if(!is_keyword(words.next(), "ASCII"))
      refuse(words, "only ASCII files can be read, but this is");
    words.next(); // DATASET
    if(!is_keyword(words.next(), "UNSTRUCTURED_GRID"))
      refuse(words, "only an UNSTRUCTURED_GRID can be read, but this is");

    words = section("POINTS", words.end());
    const long long points = read(words);
    if(const std::string_view type = words.next();
       !is_keyword(type, "float") && !is_keyword(type, "double"))
      refuse(words, "expected POINTS of the type float or double, but found");
    else
      m_source.are_points_single = is_keyword(type, "float");
    for(long long i = 0; i < points; ++i)
      read_point(words, [i] { return "point " + std::to_string(i); });
    find_ranges(words);
    read_cells(words.end());
  }

private:
  // METADATA of the points, which end at an empty line, may have their range.
  void find_ranges(Words words)
  {
    if(!is_keyword(words.next(), "METADATA"))
      return;
    const std::size_t end = (std::min)(text().find("\n\n", words.end()),
                                       text().find("\n\r\n", words.end()));
    Words metadata(std::string_view(text()).substr(0, end), words.end());
    std::string name;
    for(auto word = metadata.next(); !word.empty(); word = metadata.next())
      if(is_keyword(word, "NAME"))
        name = metadata.next();
      else if(is_keyword(word, "DATA") && is_range(name) && metadata.next() == "2")
        for(const bool is_largest : {false, true})
          if(!metadata.next().empty())
            m_ends_of_ranges.push_back({{metadata.begin(), metadata.end()}, is_largest});
  }

  static bool is_keyword(std::string_view word, const std::string& keyword)
  {
    return word.size() == keyword.size() && boost::algorithm::iequals(word, keyword);
  }

  // The words after a keyword, in upper or lower case, the first one after a place.
  Words section(const std::string& keyword, std::size_t place) const
  {
    Words words(text(), place);
    for(auto word = words.next(); !is_keyword(word, keyword); word = words.next())
      if(word.empty())
        refuse("has no " + keyword);
    return words;
  }

  long long read(Words& words, long long smallest = 0,
                 long long largest = (std::numeric_limits<int>::max)()) const
  {
    return read_integer(words, smallest, largest, [=] {
      return "an integer from " + std::to_string(smallest) + " to " + std::to_string(largest);
    });
  }

  void read_cells(std::size_t place)
  {
    Words cells = section("CELLS", place), types = section("CELL_TYPES", place);
    long long number = read(cells);
    read(cells); // how many integers follow
    Words connectivity = cells, look = cells;
    const bool has_offsets = is_keyword(look.next(), "OFFSETS"); // since version 5
    long long begin = 0;
    if(has_offsets)
    {
      cells = look;
      cells.next(); // the type of numbers
      begin = read(cells, 0, 0); // the cells follow each other, from the start
      --number;
      connectivity = section("CONNECTIVITY", place);
      connectivity.next();
    }
    if(const long long n = read(types); n != number)
      refuse(types, "expected " + std::to_string(number) + " CELL_TYPES, but found");
    for(long long i = 0; i < number; ++i)
    {
      long long size = read(cells, begin);
      if(has_offsets)
      {
        const long long end = size;
        size = end - begin;
        begin = end;
      }
      else
        connectivity = cells;
      read_cell(connectivity, size, read(types));
      if(!has_offsets)
        cells = connectivity;
    }
  }

  void read_cell(Words& words, long long size, long long type)
  {
    std::array<int, 4> vertices = {};
    if(type == vtk_tetrahedron ? size != 4 : !is_flat_vtk_cell(type))
      refuse(words, "only tetrahedra with four vertices can be deformed, but there is a cell of "
                    "the type " + std::to_string(type) + " with " + std::to_string(size) +
                    " vertices, after");
    for(long long k = 0; k < size; ++k)
    {
      const auto v = static_cast<int>(
        read(words, 0, static_cast<long long>(m_mesh.points.size()) - 1));
      if(type == vtk_tetrahedron)
        vertices[k] = v;
    }
    if(type != vtk_tetrahedron)
      return;
    add_tetrahedron(words, vertices, [] { return std::string("a tetrahedron"); });
  }
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_VTK_FILE_H
