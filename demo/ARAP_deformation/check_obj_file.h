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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_CHECK_OBJ_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_CHECK_OBJ_FILE_H

#include "shape_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <istream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL::ARAP::demo {

namespace internal {

// what a statement of an .obj file other than v and f tells; empty if there is no such statement
inline std::string told_by_obj_statement(const std::string& keyword)
{
  static const std::map<std::string, std::string> kinds = [] {
    std::map<std::string, std::string> result;
    for(const auto& [kind, keywords] : std::map<std::string, std::vector<std::string>>{
          {"normals", {"vn"}}, {"texture coordinates", {"vt"}}, {"lines", {"l"}}, {"points", {"p"}},
          {"groups", {"g", "o", "s", "mg"}}, {"materials", {"usemtl", "mtllib"}},
          {"display attributes", {"bevel", "c_interp", "d_interp", "lod", "maplib", "usemap",
                                  "shadow_obj", "trace_obj", "ctech", "stech"}},
          {"curves and free-form surfaces",
           {"vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole",
            "scrv", "sp", "end", "con", "bsp", "bzp", "cdc", "cdp", "res"}}})
      for(const std::string& word : keywords)
        result[word] = kind;
    return result;
  }();
  const auto found = kinds.find(keyword);
  return found == kinds.end() ? std::string() : found->second;
}

// Reads a line without its comment, and the next lines while they continue it. Returns how many.
inline std::size_t get_obj_line(std::istream& in, std::string& line)
{
  std::size_t lines = 0;
  line.clear();
  bool is_continued = true;
  for(std::string part; is_continued && std::getline(in, part); ++lines)
  {
    part.resize((std::min)(part.find('#'), part.size()));
    part.resize(part.find_last_not_of(" \t\r") + 1);
    is_continued = !part.empty() && part.back() == '\\';
    if(is_continued)
      part.back() = ' ';
    line += part;
  }
  return lines;
}

// the vertex of a corner, such as 3, 3/1, 3//2 or 3/1/2, or -1 for the last one; 0 if it is wrong
inline long long obj_corner(const char* word)
{
  char* end = nullptr;
  const long long value = std::strtoll(word, &end, 10); // saturates
  const bool is_end = *end == '\0' || *end == '/' || std::isspace(static_cast<unsigned char>(*end));
  return is_end ? value : 0;
}

} // namespace internal

// The vertices and the faces of an .obj file, as CGAL's reader can read them: that knows neither
// all statements, nor continued lines, and takes what it cannot read of a face for its end. Throws
// a std::runtime_error for what is wrong. Inserts what else there is into `dropped`.
inline std::stringstream check_obj_file(std::istream& in, const std::string& file,
                                        std::set<std::string>& dropped)
{
  std::stringstream out;
  std::string line;
  long long vertices = 0, largest = 0; // the number of vertices, and the largest in a face
  std::size_t line_of_largest = 0;
  const auto missing = [&file](std::size_t number, const std::string& vertex) {
    return bad_line(file, number, "a face has the vertex " + vertex + ", which does not exist");
  };
  std::size_t lines = 0;
  for(std::size_t number = 1; (lines = internal::get_obj_line(in, line)) > 0; number += lines)
  {
    Words words(line);
    const std::string keyword(words.next());
    std::string_view word = words.next();
    std::size_t size = 0; // the number of words after the keyword
    if(keyword == "v")
    {
      out << 'v';
      for(; !word.empty(); word = words.next(), ++size)
      {
        if(size >= 3)
          continue; // a weight, or a colour
        char* end = nullptr;
        if(!std::isfinite(std::strtod(word.data(), &end)) || end != word.data() + word.size())
          throw bad_line(file, number, in_quotes(word) + " is not a finite number");
        out << ' ' << word;
      }
      if(size < 3)
        throw bad_line(file, number, "a vertex has three coordinates");
      if(size > 4)
        dropped.insert("colours");
      out << '\n';
      ++vertices;
    }
    else if(keyword == "f")
    {
      out << 'f';
      for(; !word.empty(); word = words.next(), ++size)
      {
        long long corner = internal::obj_corner(word.data());
        if(corner == 0)
          throw bad_line(file, number, in_quotes(word) + " is not a corner of a face: the number "
                                       "of a vertex, from 1 or backwards from -1, and maybe "
                                       "others after slashes");
        if(corner < -vertices)
          throw missing(number, in_quotes(word));
        corner += corner < 0 ? vertices + 1 : 0;
        if(corner > largest)
        {
          largest = corner;
          line_of_largest = number;
        }
        out << ' ' << corner;
      }
      if(size < 3)
        throw bad_line(file, number, "a face has at least three vertices");
      out << '\n';
    }
    else if(const std::string kind = internal::told_by_obj_statement(keyword); !kind.empty())
      dropped.insert(kind);
    else if(!keyword.empty())
      throw bad_line(file, number, in_quotes(keyword) + " is not a statement of .obj files that "
                                   "can be read");
  }
  if(largest > vertices)
    throw missing(line_of_largest, std::to_string(largest));
  if(largest == 0)
    throw std::runtime_error(file + ": has no faces");
  return out;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_CHECK_OBJ_FILE_H
