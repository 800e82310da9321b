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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_SOURCE_TEXT_H
#define CGAL_ARAP_DEFORMATION_DEMO_SOURCE_TEXT_H

#include "Unwritable.h"
#include "shape_files.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// The contents of a mesh file, and where the coordinates are in it: it is written with new ones,
// and otherwise unchanged to the byte.
class Source_text
{
public:
  enum class Numbers { text, little_endian, big_endian };

  // the place of a number; four bytes of a binary file are a float, eight a double
  struct Span
  {
    std::size_t begin, end;
  };
  using Triple = std::array<Span, 3>;

  // that of a face at a vertex, or all corners of one of them
  struct Corner
  {
    std::optional<std::size_t> face, vertex;
  };

  // a normal, and the corners that use it
  struct Normal
  {
    Triple place;
    Kernel::Vector_3 value;
    std::vector<Corner> corners;
  };

  std::string text;
  Numbers numbers = Numbers::text;
  bool are_points_single = false; // also where they are text, which programs read as floats
  std::vector<Triple> points;  // of the vertices, in their order
  std::vector<Normal> normals;

  // of a .ply file: the properties of vertices, and where more go, in the header and in each row;
  // and where the values of the one that is wanted are, if they are fractions
  std::set<std::string> properties;
  std::size_t properties_end = 0;
  std::vector<std::size_t> row_ends;
  std::string wanted_property;
  std::vector<Span> wanted_values;
  bool has_integer_normals = false; // which are not among the normals

  // The places of the next three words.
  static Triple next_triple(Words& words)
  {
    Triple result;
    for(Span& span : result)
    {
      words.next();
      span = {words.begin(), words.end()};
    }
    return result;
  }

  // Replaces `before` by `after` in what is written. Numbers that stay keep their text.
  void replace(const Triple& place, const Kernel::Vector_3& before, const Kernel::Vector_3& after)
  {
    for(int k = 0; k < 3; ++k)
      if(after[k] != before[k])
      {
        if(are_points_single)
          to_float(after[k]); // which may throw
        m_changes.push_back({place[k], number(after[k], place[k].end - place[k].begin)});
      }
  }

  // Replaces what is there by a text.
  void replace(const Span& place, const std::string& after) { m_changes.push_back({place, after}); }

  // Inserts a text.
  void insert(std::size_t place, const std::string& inserted)
  {
    replace(Span{place, place}, inserted);
  }

  // the text of a number, or its bytes
  std::string number(double value, std::size_t bytes) const
  {
    if(numbers == Numbers::text)
    {
      std::ostringstream out;
      out.precision(std::numeric_limits<double>::max_digits10);
      out << value;
      return out.str();
    }
    return bytes == 4 ? bytes_of(to_float(value), numbers) : bytes_of(value, numbers);
  }

  // the number that has these bytes
  template <typename Number>
  static Number number_of(std::string_view bytes, Numbers order)
  {
    std::array<char, sizeof(Number)> copy;
    std::copy_n(bytes.begin(), sizeof(Number), copy.begin());
    if(order == Numbers::big_endian)
      std::reverse(copy.begin(), copy.end());
    Number value;
    std::memcpy(&value, copy.data(), sizeof(Number));
    return value;
  }

  // the bytes of a number
  template <typename Number>
  static std::string bytes_of(Number value, Numbers order)
  {
    std::string result(reinterpret_cast<const char*>(&value), sizeof(Number));
    if(order == Numbers::big_endian)
      std::reverse(result.begin(), result.end());
    return result;
  }

  // Writes the text with the changes, and forgets them. What is inserted comes before what is
  // replaced at the same place.
  void write(std::ostream& out)
  {
    std::stable_sort(m_changes.begin(), m_changes.end(), [](const Change& a, const Change& b) {
      return std::pair(a.place.begin, a.place.end) < std::pair(b.place.begin, b.place.end);
    });
    std::size_t written = 0;
    for(const Change& change : m_changes)
    {
      out << std::string_view(text).substr(written, change.place.begin - written) << change.text;
      written = change.place.end;
    }
    out << std::string_view(text).substr(written);
    m_changes.clear();
  }

private:
  struct Change
  {
    Span place;
    std::string text;
  };

  std::vector<Change> m_changes;
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_SOURCE_TEXT_H
