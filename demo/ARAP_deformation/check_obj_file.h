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

#include "Source_text.h"
#include "shape_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <istream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
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

// Reads a line, and the next lines while they continue it. Returns how many. Comments and ends of
// lines become blanks, so that each word keeps its place.
inline std::size_t get_obj_line(std::istream& in, std::string& line)
{
  std::size_t lines = 0;
  line.clear();
  bool is_continued = true;
  for(std::string part; is_continued && std::getline(in, part); ++lines)
  {
    const std::size_t size = part.size() + 1;
    part.resize((std::min)(part.find('#'), part.size()));
    const std::size_t last = part.find_last_not_of(" \t\r");
    is_continued = last != std::string::npos && part[last] == '\\';
    if(is_continued)
      part[last] = ' ';
    part.resize(size, ' ');
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

// the normal of a corner, in the same way; 0 if there is none
inline long long obj_normal(std::string_view word)
{
  const std::size_t slash = word.find('/'), last = word.rfind('/');
  return slash == last || last + 1 == word.size()
           ? 0 : std::strtoll(word.data() + last + 1, nullptr, 10);
}

// Reads the coordinates of a normal, and where they are.
inline Source_text::Normal read_obj_normal(const std::string& line, Words words, std::size_t begin)
{
  Source_text::Normal normal{Source_text::next_triple(words), {}, {}};
  std::array<double, 3> value;
  for(int k = 0; k < 3; ++k)
  {
    value[k] = std::strtod(line.c_str() + normal.place[k].begin, nullptr);
    normal.place[k].begin += begin;
    normal.place[k].end += begin;
  }
  normal.value = Kernel::Vector_3(value[0], value[1], value[2]);
  return normal;
}

} // namespace internal

// The vertices and the faces of an .obj file, as CGAL's reader can read them: that knows neither
// all statements, nor continued lines, and takes what it cannot read of a face for its end. Throws
// a std::runtime_error for what is wrong. Inserts what else there is into `dropped`, and into
// `source`, if it is given, the places of coordinates and normals.
inline std::stringstream check_obj_file(std::istream& in, const std::string& file,
                                        std::set<std::string>& dropped,
                                        Source_text* source = nullptr)
{
  std::stringstream out;
  std::string line;
  long long vertices = 0, largest = 0; // the number of vertices, and the largest in a face
  std::size_t line_of_largest = 0;
  const auto missing = [&file](std::size_t number, const std::string& vertex) {
    return bad_line(file, number, "a face has the vertex " + vertex + ", which does not exist");
  };
  std::size_t lines = 0, begin = 0, next = 0; // in the text
  struct Use
  {
    long long normal;
    std::size_t face, vertex;
  };
  std::vector<Use> uses; // of normals
  std::size_t faces = 0;
  for(std::size_t number = 1; (lines = internal::get_obj_line(in, line)) > 0; number += lines)
  {
    begin = next;
    next += line.size();
    Words words(line);
    const std::string keyword(words.next());
    if(Words others = words; keyword == "vn")
      for(int k = 0; k < 3; ++k)
        if(!is_finite_number(others.next()))
          throw bad_line(file, number, "a normal has three finite numbers");
    if(source && keyword == "vn")
      source->normals.push_back(internal::read_obj_normal(line, words, begin));
    if(source && keyword == "v")
    {
      Words places = words;
      source->points.push_back(Source_text::next_triple(places));
      for(Source_text::Span& place : source->points.back())
        place = {place.begin + begin, place.end + begin};
    }
    std::string_view word = words.next();
    std::size_t size = 0; // the number of words after the keyword
    if(keyword == "v")
    {
      out << 'v';
      for(; !word.empty(); word = words.next(), ++size)
      {
        if(size >= 3)
          continue; // a weight, or a color
        if(!is_finite_number(word))
          throw bad_line(file, number, in_quotes(word) + " is not a finite number");
        out << ' ' << word;
      }
      if(size < 3)
        throw bad_line(file, number, "a vertex has three coordinates");
      if(size > 4)
        dropped.insert("colors");
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
        if(source)
          if(const long long normal = internal::obj_normal(word); normal != 0)
            uses.push_back({normal < 0 ? normal + static_cast<long long>(source->normals.size())
                                       : normal - 1, faces, static_cast<std::size_t>(corner - 1)});
      }
      if(size < 3)
        throw bad_line(file, number, "a face has at least three vertices");
      out << '\n';
      ++faces;
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
  for(const auto& [normal, face, vertex] : uses)
    if(normal >= 0 && normal < static_cast<long long>(source->normals.size()))
      source->normals[normal].corners.push_back({face, vertex});
  return out;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_CHECK_OBJ_FILE_H
