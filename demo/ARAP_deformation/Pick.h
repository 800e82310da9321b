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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_PICK_H
#define CGAL_ARAP_DEFORMATION_DEMO_PICK_H

// Vertices that are picked by where they are, or by their numbers.

#include "arguments.h"
#include "shape_files.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL::ARAP::demo {

// WHAT an option picks: see print_help().
class Pick
{
public:
  // Throws a Usage_error if `what` is not understood.
  Pick(const std::string& option, const std::string& what)
    : m_name("--" + option + ' ' + what), m_kind(what.substr(0, what.find(':')))
  {
    const std::string value = what.substr((std::min)(what.size(), m_kind.size() + 1));
    if(option == "onto" && m_kind != "plane")
      throw Usage_error(m_name + ": expected plane:X,Y,Z,NX,NY,NZ");
    else if(m_kind == "box")
      m_measures = measures(m_name, value, "x0,y0,z0,x1,y1,z1");
    else if(m_kind == "sphere")
      m_measures = measures(m_name, value, "x,y,z,r");
    else if(m_kind == "near" || (m_kind == "point" && (option == "fix" || option == "handle")))
      m_measures = measures(m_name, value, "x,y,z");
    else if(m_kind == "point")
      throw Usage_error(m_name + ": a point inside a simplex is for --fix and --handle only");
    else if(m_kind == "plane")
    {
      m_measures = measures(m_name, value, "x,y,z,nx,ny,nz");
      for(std::size_t k = 3; k < 6; ++k)
        if(m_measures[k].is_percentage)
          throw Usage_error(m_name + ": a percentage makes no sense in a normal");
      if(normal() == CGAL::NULL_VECTOR)
        throw Usage_error(m_name + ": the normal 0,0,0 has no direction");
    }
    else if(m_kind == "x" || m_kind == "y" || m_kind == "z")
      read_range(value);
    else if(m_kind == "list" && value.rfind('@', 0) == 0)
    {
      m_file = value.substr(1);
      if(m_file.empty())
        throw Usage_error(m_name + ": expected the name of a file after @");
    }
    else if(m_kind == "list")
      for(const std::string& number_of_vertex : split(value))
        m_vertices.push_back(number<int>(option + " list:", number_of_vertex));
    else
      throw Usage_error(m_name + ": expected box:, sphere:, plane:, near:, point:, list:, or a "
                                 "range such as z:90%..");
  }

  const std::string& name() const { return m_name; }

  // that of a list, or empty
  const std::string& file() const { return m_file; }

  // whether it picks no vertices, but a point inside a simplex
  bool is_point() const { return m_kind == "point"; }

  // That point, of which the nearest place of the shape is meant.
  Kernel::Point_3 point(const std::vector<Kernel::Point_3>& points) const
  {
    return point(CGAL::bbox_3(points.begin(), points.end()), 0);
  }

  // the plane of --onto
  Kernel::Plane_3 plane(const Bbox_3& box) const { return {point(box, 0), normal()}; }

  // The vertices that are picked. Throws if there is none.
  std::vector<std::size_t> vertices(const std::vector<Kernel::Point_3>& points) const
  {
    const Bbox_3 box = CGAL::bbox_3(points.begin(), points.end());
    std::vector<std::size_t> result;
    if(m_kind == "near")
      result = nearest(points, point(box, 0));
    else if(m_kind == "list")
      result = listed(points.size());
    else
      for(std::size_t v = 0; v < points.size(); ++v)
        if(contains(box, points[v]))
          result.push_back(v);
    if(result.empty())
    {
      std::ostringstream message; // what it tells can be given as it is
      message.precision(std::numeric_limits<double>::max_digits10);
      message << m_name << ": picks no vertex; the bounding box of the mesh is box:" << box.xmin()
              << ',' << box.ymin() << ',' << box.zmin() << ',' << box.xmax() << ',' << box.ymax()
              << ',' << box.zmax();
      throw std::runtime_error(message.str());
    }
    return result;
  }

private:
  // LOW..HIGH, either of which may be missing
  void read_range(const std::string& text)
  {
    const std::size_t dots = text.find("..");
    if(dots == std::string::npos || text == "..")
      throw Usage_error(m_name + ": expected a range such as z:90%.., z:..0.5 or z:0..0.5");
    const double infinity = (std::numeric_limits<double>::infinity)();
    const auto end = [this](const std::string& part, double missing) {
      return part.empty() ? Measure{missing} : measures(m_name, part, "end")[0];
    };
    m_measures = {end(text.substr(0, dots), -infinity), end(text.substr(dots + 2), infinity)};
  }

  // the point of three measures
  Kernel::Point_3 point(const Bbox_3& box, std::size_t first) const
  {
    return {m_measures[first].coordinate(box, 0), m_measures[first + 1].coordinate(box, 1),
            m_measures[first + 2].coordinate(box, 2)};
  }

  Kernel::Vector_3 normal() const
  {
    return {m_measures[3].value, m_measures[4].value, m_measures[5].value};
  }

  bool contains(const Bbox_3& box, const Kernel::Point_3& p) const
  {
    if(m_kind == "sphere")
    {
      const double r = m_measures[3].length(box);
      return r >= 0 && CGAL::squared_distance(p, point(box, 0)) <= r * r;
    }
    if(m_kind == "plane")
      return (p - point(box, 0)) * normal() >= 0;
    if(m_kind == "box")
    {
      const Kernel::Point_3 low = point(box, 0), high = point(box, 3);
      return low.x() <= p.x() && p.x() <= high.x() && low.y() <= p.y() && p.y() <= high.y() &&
             low.z() <= p.z() && p.z() <= high.z();
    }
    const int axis = m_kind[0] - 'x';
    return m_measures[0].coordinate(box, axis) <= p[axis] &&
           p[axis] <= m_measures[1].coordinate(box, axis);
  }

  // none where all are so far away that distances overflow
  static std::vector<std::size_t> nearest(const std::vector<Kernel::Point_3>& points,
                                          const Kernel::Point_3& q)
  {
    const auto is_nearer = [&q](const Kernel::Point_3& a, const Kernel::Point_3& b) {
      return CGAL::squared_distance(a, q) < CGAL::squared_distance(b, q);
    };
    const auto found = std::min_element(points.begin(), points.end(), is_nearer);
    if(found == points.end() || !std::isfinite(CGAL::squared_distance(*found, q)))
      return {};
    return {static_cast<std::size_t>(found - points.begin())};
  }

  std::vector<std::size_t> listed(std::size_t number_of_vertices) const
  {
    std::vector<std::size_t> result = m_vertices;
    if(!m_file.empty())
      for_each_line(m_file, [&](const std::string& line, int line_number) {
        std::istringstream in(line);
        for(std::string word; in >> word;)
        {
          int v = -1;
          if(!boost::conversion::try_lexical_convert(word, v) || v < 0)
            throw bad_line(m_file, line_number, in_quotes(word) + " is not the number of a vertex");
          result.push_back(v);
        }
      });
    for(std::size_t v : result)
      if(v >= number_of_vertices)
        throw std::runtime_error(m_name + ": there is no vertex " + std::to_string(v) +
                                 "; they are numbered from 0 to " +
                                 std::to_string(number_of_vertices - 1));
    return result;
  }

  std::string m_name, m_kind, m_file;
  Measures m_measures;
  std::vector<std::size_t> m_vertices;
};

inline void write_selection(std::ostream& out, const std::vector<int>& selection)
{
  for(int status : selection)
    out << status << '\n';
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_PICK_H
