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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_TETRAHEDRA_TEXT_H
#define CGAL_ARAP_DEFORMATION_DEMO_TETRAHEDRA_TEXT_H

#include "Source_text.h"
#include "shape_files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
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

// The tetrahedra of a text, which is written with new coordinates, and otherwise unchanged to the
// byte. Derived classes read a format; what they throw names the file, the line and what is wrong.
class Tetrahedra_text
{
public:
  virtual ~Tetrahedra_text() = default;
  Tetrahedra_text(const Tetrahedra_text&) = delete;
  Tetrahedra_text& operator=(const Tetrahedra_text&) = delete;

  const Tetrahedral_mesh& mesh() const { return m_mesh; }

  // Writes the file with these points. Unchanged coordinates keep their text.
  virtual void write(std::ostream& out, const std::vector<Kernel::Point_3>& points)
  {
    replace_ranges(points);
    for(std::size_t v = 0; v < points.size(); ++v)
      m_source.replace(m_source.points[v], m_mesh.points[v] - CGAL::ORIGIN,
                       points[v] - CGAL::ORIGIN);
    m_source.write(out);
  }

protected:
  explicit Tetrahedra_text(const std::string& file) : m_name(file)
  {
    m_source.text = content_of(file);
  }

  // An end of the range of the points, that of their distances from the origin, which VTK writes
  // into files and believes.
  struct End_of_range
  {
    Source_text::Span place;
    bool is_largest;
  };

  static bool is_range(std::string_view key)
  {
    return key == "L2_NORM_RANGE" || key == "L2_NORM_FINITE_RANGE";
  }

  void replace_ranges(const std::vector<Kernel::Point_3>& points)
  {
    if(points == m_mesh.points)
      return;
    double smallest = (std::numeric_limits<double>::max)(), largest = 0;
    for(const Kernel::Point_3& p : points)
    {
      const double distance = std::hypot(p.x(), p.y(), p.z());
      smallest = (std::min)(smallest, distance);
      largest = (std::max)(largest, distance);
    }
    for(const End_of_range& end : m_ends_of_ranges)
      m_source.replace(end.place,
                       m_source.number(end.is_largest ? largest : smallest, sizeof(double)));
  }

  const std::string& text() const { return m_source.text; }

  [[noreturn]] void refuse(const std::string& sentence) const
  {
    throw std::runtime_error(m_name + ": " + sentence);
  }

  bool is_binary() const { return m_source.numbers != Source_text::Numbers::text; }

  // Throws a message: `expected`, continued by what is there instead.
  [[noreturn]] void refuse(const Words& words, const std::string& expected) const
  {
    const bool is_end = words.begin() == text().size();
    if(is_binary())
      refuse("byte " + std::to_string(words.begin()) + ": " + expected + ' ' +
             (is_end ? "the end of the file" : m_found));
    const auto line = 1 + std::count(text().begin(), text().begin() + words.begin(), '\n');
    const auto word = std::string_view(text()).substr(words.begin(), words.end() - words.begin());
    throw bad_line(m_name, static_cast<std::size_t>(line),
                   expected + (is_end ? " the end of the file"
                               : word.empty() ? " nothing" : ' ' + in_quotes(word)));
  }

  // Reads an integer from `smallest` to `largest`; description() tells what is expected.
  template <typename Description>
  long long read_integer(Words& words, long long smallest, long long largest,
                         const Description& description) const
  {
    char* end = nullptr;
    const bool is_end = words.next().empty();
    errno = 0;
    const long long value = std::strtoll(text().c_str() + words.begin(), &end, 10);
    if(is_end || errno == ERANGE || end != text().c_str() + words.end() || value < smallest ||
       value > largest)
      refuse(words, "expected " + description() + ", but found");
    return value;
  }

  // Reads the bytes of a number.
  template <typename Number>
  Number read_bytes(Words& words)
  {
    const std::string_view bytes = words.skip(sizeof(Number));
    if(bytes.size() < sizeof(Number))
      refuse(Words(text(), text().size()), "expected more numbers, but found");
    const auto value = Source_text::number_of<Number>(bytes, m_source.numbers);
    m_found = std::to_string(value);
    return value;
  }

  // Appends a point of three doubles and the place of its coordinates.
  template <typename Description>
  void read_binary_point(Words& words, const Description& description)
  {
    std::array<double, 3> p;
    m_source.points.emplace_back();
    for(int k = 0; k < 3; ++k)
    {
      p[k] = read_bytes<double>(words);
      m_source.points.back()[k] = {words.begin(), words.end()};
      if(!std::isfinite(p[k]))
        refuse(words, "expected a finite number, a coordinate in " + description() +
                        ", but found");
    }
    m_mesh.points.emplace_back(p[0], p[1], p[2]);
  }

  // Appends a point and the place of its coordinates.
  template <typename Description>
  void read_point(Words& words, const Description& description)
  {
    Words place = words;
    m_source.points.push_back(Source_text::next_triple(place));
    std::array<double, 3> p;
    for(double& coordinate : p)
    {
      char* end = nullptr;
      const bool is_end = words.next().empty();
      coordinate = std::strtod(text().c_str() + words.begin(), &end);
      if(is_end || end != text().c_str() + words.end() || !std::isfinite(coordinate))
        refuse(words, "expected a finite number, a coordinate in " + description() +
                        ", but found");
    }
    m_mesh.points.emplace_back(p[0], p[1], p[2]);
  }

  static bool has_vertex_twice(std::array<int, 4> corners)
  {
    std::sort(corners.begin(), corners.end());
    return std::adjacent_find(corners.begin(), corners.end()) != corners.end();
  }

  // Appends a tetrahedron; throws if it has a vertex twice.
  template <typename Description>
  void add_tetrahedron(const Words& words, const std::array<int, 4>& corners,
                       const Description& description)
  {
    if(has_vertex_twice(corners))
      refuse(words, description() + " has a vertex twice; the last word is");
    m_mesh.tetrahedra.push_back(corners);
  }

  std::string m_name;
  Source_text m_source;
  Tetrahedral_mesh m_mesh;
  std::vector<End_of_range> m_ends_of_ranges;
  std::string m_found; // in a binary file: the last number, for messages
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_TETRAHEDRA_TEXT_H
