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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_CHECK_OFF_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_CHECK_OFF_FILE_H

#include "Source_text.h"
#include "shape_files.h"

#include <CGAL/IO/OFF/File_header_OFF.h>
#include <CGAL/IO/io.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <istream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL::ARAP::demo {

namespace internal {

// Checks the rows of an .off file, as CGAL's reader parses them: it trusts the number of corners in
// a row, and that rows are long enough for the colors that the header announces.
class Off_rows
{
public:
  Off_rows(std::istream& in, const std::string& file, const File_header_OFF& header,
           std::set<std::string>& dropped, Source_text* source)
    : m_in(in), m_file(file), m_header(header), m_dropped(dropped), m_source(source)
  {}

  // Returns whether they have colors.
  bool check_vertices()
  {
    // coordinates, and a weight if they are homogeneous
    const std::size_t h = m_header.is_homogeneous() ? 1 : 0;
    const std::size_t plain = 3 + h + (m_header.has_normals() ? 3 + h : 0);
    const std::size_t texture = m_header.has_textures() ? 2 + h : 0;
    const bool is_plain = h == 0 && !m_header.has_colors(); // CGAL reads only coordinates
    bool has_colors = false;
    for(std::size_t v = 0; v < m_header.size_of_vertices(); ++v)
    {
      find_row("vertex", v);
      if(m_source && !m_header.is_homogeneous() && !m_header.has_normals())
      {
        Words words(m_source->text, m_begin);
        m_source->points.push_back(Source_text::next_triple(words));
      }
      if(is_plain)
        check_coordinates(v);
      if(is_plain && v > 0) // the first row tells whether there are colors
        continue;
      read_numbers();
      if(is_plain)
      {
        if(m_row.size() > plain + texture)
          m_dropped.insert("colors");
        continue;
      }
      if(m_row.size() < plain + texture)
        refuse("vertex", v, "has too few numbers");
      if(h == 1 && m_row[3] == 0)
        refuse("vertex", v, "is at infinity");
      if(m_header.has_colors())
        check_color("vertex", v, plain, m_row.size() - texture, has_colors);
    }
    return has_colors;
  }

  // Returns whether they have colors that the header announces.
  bool check_faces()
  {
    bool has_colors = false;
    for(std::size_t f = 0; f < m_header.size_of_facets(); ++f)
    {
      find_row("face", f);
      read_numbers();
      const double corners = m_row.empty() ? 0 : m_row[0];
      if(!(corners >= 0 && corners < static_cast<double>(m_row.size())))
        refuse("face", f, "has fewer vertices than it announces");
      const auto end = 1 + static_cast<std::size_t>(corners);
      for(std::size_t i = 1; i < end; ++i)
        if(!(m_row[i] >= 0 && m_row[i] < static_cast<double>(m_header.size_of_vertices())))
          refuse("face", f, "has a vertex that does not exist");
      if(m_header.has_colors())
        check_color("face", f, end, m_row.size(), has_colors);
      else if(m_row.size() > end)
        m_dropped.insert("colors");
    }
    return has_colors;
  }

private:
  [[noreturn]] void refuse(const char* what, std::size_t number, const std::string& why) const
  {
    throw std::runtime_error(m_file + ": " + what + ' ' + std::to_string(number) + ' ' + why);
  }

  // Rows and their numbers are parsed like in CGAL's File_scanner_OFF, so that both see the same.
  void find_row(const char* what, std::size_t number)
  {
    m_in >> skip_comment_OFF;
    if(m_source)
      m_begin = static_cast<std::size_t>(m_in.tellg());
    if(!std::getline(m_in, m_line))
      refuse(what, number, "is missing");
  }

  void check_coordinates(std::size_t v) const
  {
    Words words(m_line);
    for(int k = 0; k < 3; ++k)
      if(!is_finite_number(words.next()))
        refuse("vertex", v, "does not have three finite coordinates");
  }

  void read_numbers()
  {
    m_numbers.clear();
    m_numbers.str(m_line.substr(0, m_line.find('#')));
    m_row.clear();
    for(double entry; m_numbers >> IO::iformat(entry);)
      m_row.push_back(entry);
  }

  // The numbers from begin to end are a color: an index, or red, green and blue, integers or
  // fractions. Once there is one, all others of its kind must have one.
  void check_color(const char* what, std::size_t number, std::size_t begin, std::size_t end,
                   bool& has_colors) const
  {
    const std::size_t n = end - begin;
    if(n == 0 && !has_colors)
      return;
    if(number > 0 && !has_colors)
      refuse(what, number, "has a color, though those before it have none");
    has_colors = true;
    if(n == 1)
      m_dropped.insert("indices of colors");
    if(n != 1 && n < 3)
      refuse(what, number, "has a color that is neither one number nor three, or no color though "
                           "others have one");
    bool is_integer = true;
    double largest = 0;
    for(std::size_t i = begin; i < begin + (std::min)(n, std::size_t(3)); ++i)
    {
      if(!(m_row[i] >= 0 && m_row[i] <= 255))
        refuse(what, number, "has a color that is not from 0 to 255");
      is_integer = is_integer && std::floor(m_row[i]) == m_row[i];
      largest = (std::max)(largest, m_row[i]);
    }
    const double alpha = n > 3 ? m_row[begin + 3] : 255;
    if(alpha != 255 && !(alpha == 1 && largest <= 1)) // of integers, and of fractions
      m_dropped.insert("transparency of colors");
    if(n != 1 && !is_integer && largest > 1)
      refuse(what, number, "has a color that is neither of integers nor of numbers from 0 to 1");
  }

  std::istream& m_in;
  const std::string& m_file;
  const File_header_OFF& m_header;
  std::set<std::string>& m_dropped;
  Source_text* m_source;
  std::size_t m_begin = 0; // of the row
  std::string m_line;
  std::istringstream m_numbers;
  std::vector<double> m_row;
};

// Throws if a header from `begin` to the place of the stream has taken the first number of the
// first vertex for that of edges, which is not there.
inline void check_number_of_edges(std::istream& in, std::istream::pos_type begin,
                                  const std::string& file)
{
  const auto end = in.tellg();
  if(end == std::istream::pos_type(-1))
    return;
  std::string head(static_cast<std::size_t>(end - begin), ' '), rest;
  in.seekg(begin).read(head.data(), end - begin);
  std::getline(in, rest);
  const std::size_t last = head.find_last_of(" \t\r\n");
  rest = rest.substr(0, rest.find('#'));
  if(last != std::string::npos && head[last] == '\n' && !Words(rest).next().empty())
    throw std::runtime_error(file + ": the header has no number of edges; it may be 0");
  in.clear();
  in.seekg(end);
}

} // namespace internal

// which elements of an .off file have colors
struct Off_colors
{
  bool are_at_vertices = false, are_in_faces = false;
};

// Throws a std::runtime_error for errors that CGAL's reader of .off files does not detect: missing
// rows, rows that are too short, and rows that the header does not announce. Inserts what it does
// not read, or is not kept, into `dropped`, and into `source`, whose text is that of the stream,
// the places of the coordinates.
inline Off_colors check_off_file(std::istream& in, const std::string& file,
                                 std::set<std::string>& dropped, Source_text* source = nullptr)
{
  const auto begin = in.tellg();
  File_header_OFF header(false);
  if(!(in >> header))
    throw std::runtime_error(file + ": does not start with a header that can be read, such as OFF, "
                                    "COFF, NOFF, CNOFF or 4OFF, and the numbers of vertices, "
                                    "faces and edges");
  if(header.binary())
    throw std::runtime_error(file + ": is binary; only .off files in text can be read");
  if(header.has_textures() && !header.has_colors())
    throw std::runtime_error(file + ": has texture coordinates, which are not supported");
  if(header.has_normals())
    dropped.insert("normals");
  if(header.has_textures())
    dropped.insert("texture coordinates");
  internal::check_number_of_edges(in, begin, file);
  internal::Off_rows rows(in, file, header, dropped, source);
  Off_colors colors;
  colors.are_at_vertices = rows.check_vertices();
  colors.are_in_faces = rows.check_faces();
  check_end(in, file, "the " + std::to_string(header.size_of_vertices()) + " vertices and " +
                        std::to_string(header.size_of_facets()) + " faces that the header "
                        "announces");
  return colors;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_CHECK_OFF_FILE_H
