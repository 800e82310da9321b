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

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <istream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
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

// Reads a line without its comment, and the next lines while they continue it.
inline bool get_obj_line(std::istream& in, std::string& line, std::size_t& lines)
{
  line.clear();
  bool is_continued = true;
  for(std::string part; is_continued && std::getline(in, part); ++lines)
  {
    part = part.substr(0, part.find('#'));
    part.resize(part.find_last_not_of(" \t\r") + 1);
    is_continued = !part.empty() && part.back() == '\\';
    if(is_continued)
      part.back() = ' ';
    line += part;
  }
  return !line.empty() || !is_continued;
}

// the vertex of a corner, such as 3, 3/1, 3//2 or 3/1/2, or -1 for the last one; 0 if it is wrong
inline long long obj_corner(const std::string& word)
{
  char* end = nullptr;
  const long long value = std::strtoll(word.c_str(), &end, 10); // saturates
  return *end == '\0' || *end == '/' ? value : 0;
}

} // namespace internal

// The vertices and the faces of an .obj file, as CGAL's reader can read them: that knows neither
// all statements, nor continued lines, and takes what it cannot read of a face for its end. Throws
// a std::runtime_error for what is wrong. Inserts what else there is into `dropped`.
inline std::stringstream check_obj_file(std::istream& in, const std::string& file,
                                        std::set<std::string>& dropped)
{
  std::stringstream out;
  std::string line, keyword;
  long long vertices = 0, largest = 0; // the number of vertices, and the largest in a face
  std::size_t line_of_largest = 0;
  const auto missing = [&file](std::size_t in_line, const std::string& vertex) {
    return bad_line(file, in_line, "a face has the vertex " + vertex + ", which does not exist");
  };
  for(std::size_t lines = 0, number = 1; internal::get_obj_line(in, line, lines);
      number = lines + 1)
  {
    std::istringstream text(line);
    if(!(text >> keyword))
      continue;
    std::vector<std::string> words;
    for(std::string word; text >> word;)
      words.push_back(word);
    if(keyword == "v")
    {
      if(words.size() < 3)
        throw bad_line(file, number, "a vertex has three coordinates");
      out << 'v';
      for(int k = 0; k < 3; ++k)
      {
        char* end = nullptr;
        if(!std::isfinite(std::strtod(words[k].c_str(), &end)) || *end != '\0')
          throw bad_line(file, number, in_quotes(words[k]) + " is not a finite number");
        out << ' ' << words[k];
      }
      out << '\n';
      ++vertices;
      if(words.size() > 4) // coordinates and a weight, or coordinates and a colour
        dropped.insert("colours");
    }
    else if(keyword == "f")
    {
      if(words.size() < 3)
        throw bad_line(file, number, "a face has at least three vertices");
      out << 'f';
      for(const std::string& word : words)
      {
        long long corner = internal::obj_corner(word);
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
      out << '\n';
    }
    else if(const std::string kind = internal::told_by_obj_statement(keyword); !kind.empty())
      dropped.insert(kind);
    else
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
