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

// The conformance test of domains tells what is wrong with domains that are, each in one way. That
// all domains that ship conform is in the test of each.

#include "include/domains.h"

#include <array>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

using Triangles = std::vector<std::array<std::size_t, 3>>;
using Soup = CGAL::ARAP::Polygon_soup_domain<std::vector<Point>, Triangles>;

struct Same_index : Soup
{
  using Soup::Soup;
  std::size_t index(std::size_t v) const { return v == 3 ? 2 : v; }
};

struct Never_isolated : Soup
{
  using Soup::Soup;
  bool is_isolated(std::size_t) const { return false; }
};

struct Not_in_place : Soup
{
  using Soup::Soup;
  bool is_in_place() const { return false; }
};

struct Own_points : Soup // each copy has its own
{
  Own_points(std::vector<Point>& p, const Triangles& t) : Soup(p, t), m_own(p) {}
  Point point(std::size_t v) const { return m_own[v]; }
  void set_point(std::size_t v, const Point& p) const { m_own[v] = p; }
  mutable std::vector<Point> m_own;
};

struct Forgets_a_simplex : Soup // at one of its corners
{
  using Soup::Soup;
  template <typename Function>
  void for_each_incident_simplex(std::size_t v, const Function& f) const
  {
    Soup::for_each_incident_simplex(v, [&](std::size_t s, const auto& corners) {
      if(s != 5 || v != *corners.begin())
        f(s, corners);
    });
  }
};

struct Other_corners : Soup
{
  using Soup::Soup;
  auto simplex_vertices(std::size_t s) const { return Soup::simplex_vertices(s == 4 ? 3 : s); }
};

struct Fewer_vertices : Soup
{
  using Soup::Soup;
  auto vertices() const { return boost::counting_range(std::size_t(0), std::size_t(5)); }
};

struct Mirrored_points : Soup
{
  using Soup::Soup;
  static Point make_point(const CGAL::ARAP::Coordinates& c) { return Point(-c[0], c[1], c[2]); }
};

struct Keeps_points : Soup
{
  using Soup::Soup;
  void set_point(std::size_t, const Point&) const {}
};

struct Throwing : Soup
{
  using Soup::Soup;
  bool is_isolated(std::size_t) const { throw std::runtime_error("no such table"); }
};

template <typename Domain>
void check_caught(const std::string& sentence)
{
  test_case() = sentence;
  Shape shape = octahedron();
  shape.points.emplace_back(9, 9, 9); // isolated
  std::vector<Point> points = points_of(shape.points);
  const std::vector<std::string> found =
    CGAL::ARAP::check_domain(Domain(points, shape.triangles));
  bool is_caught = false;
  for(const std::string& violation : found)
    is_caught |= violation.find(sentence) != std::string::npos;
  if(!CHECK(is_caught))
    for(const std::string& violation : found)
      std::cerr << "    " << violation << std::endl;
}

int main()
{
  Shape shape = octahedron();
  std::vector<Point> points = points_of(shape.points);
  const std::vector<Point> before = points;
  check_conforms(Soup(points, shape.triangles));
  CHECK(points == before);

  check_caught<Same_index>("index() is the same for two vertices of vertices(), for vertex 2");
  check_caught<Never_isolated>(
    "is_isolated() and for_each_incident_simplex() disagree, for vertex 6");
  check_caught<Not_in_place>("point() is not what set_point() and is_in_place() make it");
  check_caught<Own_points>("a copy of the domain does not stand for the same mesh");
  check_caught<Forgets_a_simplex>("a simplex is not given exactly once at each of its corners");
  check_caught<Other_corners>("simplex_vertices() and for_each_incident_simplex() give different");
  check_caught<Fewer_vertices>("a corner of a simplex is not in vertices()");
  check_caught<Mirrored_points>("coordinates() and make_point() are not inverse to each other");
  check_caught<Keeps_points>("point() is not what set_point() and is_in_place() make it");
  check_caught<Throwing>("the domain threw an exception: no such table");
  return checks_result();
}
