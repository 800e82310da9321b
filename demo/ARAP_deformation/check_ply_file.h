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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_CHECK_PLY_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_CHECK_PLY_FILE_H

#include "Source_text.h"
#include "shape_files.h"

#include <CGAL/IO/io.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL::ARAP::demo {

namespace internal {

// Checks a .ply file: CGAL's reader trusts the numbers of elements and of list entries, and assumes
// that certain properties have the types that it expects.
class Ply_layout
{
public:
  Ply_layout(std::istream& in, const std::string& file, std::size_t bytes)
    : m_in(in), m_file(file), m_bytes(bytes)
  {}

  // Returns whether it is a .ply file.
  bool read_header()
  {
    std::string line, word;
    if(!std::getline(m_in, line) || !(std::istringstream(line) >> word) || word != "ply" ||
       !std::getline(m_in, line))
      return false;
    std::istringstream format(line);
    format >> word;
    if(word == "comment" || word == "obj_info")
      refuse("can be read only if the second line is the one that starts with 'format'");
    if(!(format >> m_format) || (m_format != "ascii" && m_format != "binary_little_endian" &&
                                 m_format != "binary_big_endian"))
      return false;
    while(std::getline(m_in, line))
    {
      std::istringstream words(line);
      if(!(words >> word))
        return false;
      if(word == "element")
        read_element(words);
      else if(word == "property")
      {
        read_property(words);
        if(is_vertex(m_elements.back()))
          m_properties_end = static_cast<std::size_t>(m_in.tellg());
      }
      else if(word == "end_header")
        return true;
    }
    refuse("has no end of its header");
  }

  bool is_binary() const { return m_format != "ascii"; }

  void check_types() const
  {
    for(const Element& element : m_elements)
    {
      for(const char* name : {"x", "y", "z"})
        if(is_vertex(element) && !has(element, name))
          refuse("the vertices have no property " + std::string(name));
      const bool has_bytes = std::any_of(element.properties.begin(), element.properties.end(),
                                         [](const Property& p) {
        return is_color(p.name) && p.is("uchar");
      });
      for(const Property& p : element.properties)
      {
        if(is_vertex(element) && is_position(p))
          require(is_fractional(p), p, "float or double");
        if((is_vertex(element) || is_face(element)) && is_color(p.name) && has_bytes)
          require(p.is("uchar"), p, "uchar, unlike other colors");
        if(element.name == "halfedge" && (p.name == "source" || p.name == "target"))
          require(p.is("uint"), p, "uint");
        if(is_face(element) && is_corners(p))
          require(p.is_list && (type_name(p.type) == "int" || type_name(p.type) == "uint"), p,
                  "a list of int or uint");
      }
    }
  }

  // what a mesh of points and polygons does not have of the file
  std::set<std::string> unread() const
  {
    std::set<std::string> result;
    for(const Element& element : m_elements)
    {
      if(!is_vertex(element) && !is_face(element) && element.number > 0)
        result.insert("the element " + in_quotes(element.name));
      if(is_vertex(element) || is_face(element))
        for(const Property& p : element.properties)
          if(!is_position(p) && !is_corners(p))
            result.insert(is_color(p.name) || p.name == "alpha" ? "colors"
                          : is_normal(p) ? "normals" : "the property " + in_quotes(p.name));
    }
    return result;
  }

  // Only counts of four bytes can be large enough to matter.
  bool has_lists_of_any_size() const
  {
    for(const Element& element : m_elements)
      for(const Property& p : element.properties)
        if(p.is_list && (type_name(p.size_type) == "int" || type_name(p.size_type) == "uint"))
          return true;
    return false;
  }

  void check_lists()
  {
    for(const Element& element : m_elements)
      for(std::size_t i = 0; i < element.number; ++i)
        for(const Property& p : element.properties)
          read(p);
  }

  // Finds the coordinates of vertices, and the normals of vertices and faces; the text of `source`
  // is that of the stream.
  void find_places(Source_text& source)
  {
    source.numbers = !is_binary() ? Source_text::Numbers::text
                     : m_format == "binary_big_endian" ? Source_text::Numbers::big_endian
                                                       : Source_text::Numbers::little_endian;
    source.properties_end = m_properties_end;
    std::size_t number_of_faces = 0;
    for(const Element& element : m_elements)
    {
      const bool are_turned = has_normals(element, is_fractional);
      if(!are_turned && has_normals(element, [](const Property&) { return true; }))
        source.has_integer_normals = true;
      if(is_vertex(element))
        for(const Property& p : element.properties)
          source.properties.insert(p.name);
      for(std::size_t i = 0; i < element.number; ++i)
      {
        std::size_t end = 0;
        Source_text::Triple point = {}, normal = {};
        std::array<double, 3> direction = {};
        for(const Property& p : element.properties)
        {
          if(!is_binary())
            m_in >> std::ws;
          const auto begin = static_cast<std::size_t>(m_in.tellg());
          const double value = read(p);
          end = m_in.eof() ? source.text.size() : static_cast<std::size_t>(m_in.tellg());
          if(is_position(p))
          {
            point[p.name[0] - 'x'] = {begin, end};
            source.are_points_single |= is_vertex(element) && p.is("float");
          }
          if(is_vertex(element) && p.name == source.wanted_property && is_fractional(p))
            source.wanted_values.push_back({begin, end});
          if(are_turned && is_normal(p))
          {
            normal[p.name[1] - 'x'] = {begin, end};
            direction[p.name[1] - 'x'] = value;
          }
        }
        Source_text::Corner corners;
        if(is_face(element))
          corners.face = number_of_faces++;
        if(is_vertex(element))
        {
          corners.vertex = source.points.size();
          source.points.push_back(point);
          source.row_ends.push_back(end);
        }
        if(direction != std::array<double, 3>())
          source.normals.push_back(
            {normal, {direction[0], direction[1], direction[2]}, {corners}});
      }
    }
  }

private:
  using Type = std::size_t; // an index into the names below

  struct Property
  {
    std::string name;
    Type type;
    bool is_list;
    Type size_type;

    bool is(const char* t) const { return !is_list && type_name(type) == t; }
  };

  struct Element
  {
    std::string name;
    std::size_t number;
    std::vector<Property> properties;
  };

  static const std::string& type_name(Type type) { return type_names()[type][0]; }

  static const std::array<std::array<std::string, 2>, 8>& type_names()
  {
    static const std::array<std::array<std::string, 2>, 8> names = {{
      {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"}, {"ushort", "uint16"},
      {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}}};
    return names;
  }

  static bool is_vertex(const Element& element)
  {
    return element.name == "vertex" || element.name == "vertices";
  }

  static bool is_face(const Element& element)
  {
    return element.name == "face" || element.name == "faces";
  }

  static bool has(const Element& element, const std::string& property)
  {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [&](const Property& p) { return p.name == property; });
  }

  static bool is_position(const Property& p)
  {
    return p.name == "x" || p.name == "y" || p.name == "z";
  }

  static bool is_fractional(const Property& p) { return p.is("float") || p.is("double"); }

  static bool is_normal(const Property& p)
  {
    return p.name == "nx" || p.name == "ny" || p.name == "nz";
  }

  // Whether an element has the three properties of a normal, all of which satisfy a condition.
  template <typename Condition>
  static bool has_normals(const Element& element, const Condition& condition)
  {
    return (is_vertex(element) || is_face(element)) &&
           3 == std::count_if(element.properties.begin(), element.properties.end(),
                              [&](const Property& p) { return is_normal(p) && condition(p); });
  }

  static bool is_corners(const Property& p)
  {
    return p.name == "vertex_indices" || p.name == "vertex_index";
  }

  static bool is_color(const std::string& name)
  {
    return name == "red" || name == "green" || name == "blue" || name == "r" || name == "g" ||
           name == "b";
  }

  [[noreturn]] void refuse(const std::string& why) const
  {
    throw std::runtime_error(m_file + ": " + why);
  }

  void require(bool condition, const Property& property, const std::string& types) const
  {
    if(!condition)
      refuse("the property " + property.name + " is not " + types);
  }

  // A file has at least one byte for each of its items. Throws if it announces more: it is damaged,
  // and a reader that trusts it allocates without bound.
  void check_count(double count, const std::string& things) const
  {
    if(!(count >= 0 && count <= static_cast<double>(m_bytes)))
      refuse("announces more " + things + " than fit into its " + std::to_string(m_bytes) +
             " bytes");
  }

  void read_element(std::istream& words)
  {
    Element element;
    if(!(words >> element.name >> element.number))
      refuse("has an element without a name or a number in its header");
    m_total += static_cast<double>(element.number);
    check_count(m_total, "elements");
    m_elements.push_back(element);
  }

  Type type_of(const std::string& word) const
  {
    const auto& names = type_names();
    const auto found = std::find_if(names.begin(), names.end(), [&](const auto& both) {
      return both[0] == word || both[1] == word;
    });
    if(found == names.end())
      refuse("has a property of an unknown type in its header");
    return static_cast<Type>(found - names.begin());
  }

  void read_property(std::istream& words)
  {
    if(m_elements.empty())
      refuse("has a property before any element in its header");
    std::string type, size_type, name;
    words >> type;
    const bool is_list = type == "list";
    if(is_list)
      words >> size_type >> type;
    if(!(words >> name))
      refuse("has a property without a type or a name in its header");
    const Property property{name, type_of(type), is_list, is_list ? type_of(size_type) : 0};
    if(is_list && (type_name(property.size_type) == "float" ||
                   type_name(property.size_type) == "double"))
      refuse("has a list with a fractional number of entries in its header");
    m_elements.back().properties.push_back(property);
  }

  // Reads a property, and returns the last number of it.
  double read(const Property& p)
  {
    m_property = p.name;
    double entries = 1, value = 0;
    if(p.is_list)
    {
      entries = read(p.size_type);
      check_count(entries, "entries of " + in_quotes(p.name));
    }
    for(double j = 0; j < entries; ++j)
      value = read(p.type);
    return value;
  }

  // Reads a number. Text is parsed like in CGAL's PLY_read_number, so that both see the same.
  double read(Type type)
  {
    switch(type)
    {
    case 0: return read<std::int8_t, short>();
    case 1: return read<std::uint8_t, unsigned short>();
    case 2: return read<std::int16_t, std::int16_t>();
    case 3: return read<std::uint16_t, std::uint16_t>();
    case 4: return read<std::int32_t, std::int32_t>();
    case 5: return read<std::uint32_t, std::uint32_t>();
    case 6: return read<float, float>();
    default: return read<double, double>();
    }
  }

  template <typename Binary, typename Text>
  double read()
  {
    Binary value{};
    if(!is_binary())
    {
      Text number{};
      if constexpr(std::is_floating_point_v<Text>)
        m_in >> IO::iformat(number);
      else
        m_in >> number;
      value = static_cast<Binary>(number);
    }
    else
    {
      std::array<char, sizeof(Binary)> buffer;
      m_in.read(buffer.data(), buffer.size());
      if(m_format == "binary_big_endian")
        std::reverse(buffer.begin(), buffer.end());
      std::copy(buffer.begin(), buffer.end(), reinterpret_cast<char*>(&value));
    }
    if(!m_in)
      refuse("ends before all its elements, or has something that is not a finite number in the "
             "property " + in_quotes(m_property));
    return static_cast<double>(value);
  }

  std::istream& m_in;
  const std::string& m_file;
  std::size_t m_bytes, m_properties_end = 0; // of the vertices, in the header
  std::string m_format = "ascii";
  std::vector<Element> m_elements;
  double m_total = 0;     // number of elements
  std::string m_property; // that is read
};

} // namespace internal

// Finds the coordinates in the text of a .ply file that has been read.
inline void find_places_in_ply_file(std::istream& in, const std::string& file, Source_text& source)
{
  internal::Ply_layout layout(in, file, source.text.size());
  if(layout.read_header())
    layout.find_places(source);
}

// Throws a std::runtime_error for errors that CGAL's reader of .ply files does not detect: counts
// that are impossible, and properties of unexpected types. Files without a .ply header are left to
// the reader. Inserts what a mesh of points and polygons does not have of the file into `dropped`.
// Returns whether the file is binary. `is_thorough` after the reader has failed, to find out why.
inline bool check_ply_file(std::istream& in, const std::string& file, std::size_t bytes,
                           std::set<std::string>& dropped, bool is_thorough = false)
{
  internal::Ply_layout layout(in, file, bytes);
  if(!layout.read_header())
    return false;
  layout.check_types();
  dropped.merge(layout.unread());
  if(is_thorough || layout.has_lists_of_any_size())
    layout.check_lists();
  return layout.is_binary();
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_CHECK_PLY_FILE_H
