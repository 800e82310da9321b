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

// Ranges of points and simplices: their domain, what the conformance test of domains catches, and
// shapes that are not clean or random.
// usage: test_soups [NUMBER_OF_RANDOM_SHAPES [FIRST_SEED]]

#include "include/domains.h"
#include "include/nasty_runs.h"
#include "include/nasty_shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/ARAP_deformation/internal/domain/triangles_of_polygon.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/ARAP_deformation/self_intersections.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

// The domain of ranges: triangles against a mesh, edges with three faces, faces of either
// orientation, output to another range, and simplices that are none.
namespace soup {

using CGAL::ARAP::Polygon_soup_domain;
using CGAL::ARAP::Status;
using CGAL::ARAP::Tetrahedron_soup_domain;

// a temporary range of simplices, or of points that are only read, to which the domain would refer,
// does not compile
using Cells = std::vector<std::array<std::size_t, 4>>;
template <typename Range>
using Polygons_of = decltype(CGAL::ARAP::make_polygon_soup_domain(
  std::declval<std::vector<Point>&>(), std::declval<Range>()));
template <typename Range>
using Tetrahedra_of = decltype(CGAL::ARAP::make_tetrahedron_soup_domain(
  std::declval<const std::vector<Point>&>(), std::declval<Range>(),
  std::declval<std::vector<Point>&>()));
using CGAL::ARAP::internal::is_valid;
static_assert(is_valid<Polygons_of, const Cells&> && !is_valid<Polygons_of, Cells>);
static_assert(is_valid<Tetrahedra_of, Cells&> && !is_valid<Tetrahedra_of, const Cells>);
template <typename Points>
using Output_of = decltype(CGAL::ARAP::make_polygon_soup_domain(
  std::declval<Points>(), std::declval<const Cells&>(), std::declval<std::vector<Point>&>()));
static_assert(is_valid<Output_of, std::vector<Point>&> && !is_valid<Output_of, std::vector<Point>>);
using Points = std::vector<Point>;
using Soup = Polygon_soup_domain<Points, Cells>;
static_assert(std::is_constructible_v<Soup, Points&, const Cells&>);
static_assert(!std::is_constructible_v<Soup, Points&, Cells>);
static_assert(!std::is_constructible_v<Soup, const Points&, Cells, Points&>);
static_assert(!std::is_constructible_v<Soup, Points, const Cells&, Points&>);

void test_surfaces()
{
  for(const Shape& shape : shapes())
    for(Cell_scheme cells : all_cell_schemes)
    {
      test_case() = shape.name;
      const Scenario s = scenario(shape);
      const Result soup = reference<2>(shape.points, shape.triangles, s, cells);
      Mesh mesh = make_mesh<Mesh>(shape);
      compare(soup, deform(CGAL::ARAP::Face_graph_domain<Mesh>(mesh), all_vertices(mesh), s, cells),
              shape.diameter());

      // the orientation of a face means nothing
      auto turned = shape.triangles;
      for(std::size_t t = 0; t < turned.size(); t += 3)
        std::swap(turned[t][0], turned[t][1]);
      compare(soup, reference<2>(shape.points, turned, s, cells), shape.diameter());
    }
}

// three sheets that meet in one edge line
void test_non_manifold()
{
  test_case() = "edges with three faces";
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  const int n = 12;
  for(int k = 0; k <= n; ++k)
    for(const auto& [x, y] : {std::pair<double, double>(0, 0), {1, 0}, {-0.5, 0.9}, {-0.5, -0.9}})
      points.emplace_back(x, y, 0.5 * k);
  for(int k = 0; k < n; ++k)
    for(int sheet = 1; sheet <= 3; ++sheet)
    {
      triangles.push_back({4 * k, 4 * k + sheet, 4 * k + 4});
      triangles.push_back({4 * k + 4, 4 * k + sheet, 4 * k + 4 + sheet});
    }
  Scenario s{std::vector<int>(points.size(), 1), points};
  const Affine_map turn = rigid_motion(1.5, {0, 0, 1}, {0.5, 0, 0});
  for(int k = 0; k < 4; ++k)
  {
    s.selection[k] = 0;
    s.selection[points.size() - 1 - k] = 2;
    s.targets[points.size() - 1 - k] = turn * points[points.size() - 1 - k];
  }
  for(Cell_scheme cells : all_cell_schemes)
  {
    const Result result = reference<2>(points, triangles, s, cells);
    CHECK(result.energy.back() < 0.9 * result.energy.front());
    CHECK(result.energy.back() > 0);

    // a rigid motion of all fixed vertices is the motion of all
    Scenario rigid = s;
    for(std::size_t v = 0; v < points.size(); ++v)
    {
      rigid.selection[v] = rigid.selection[v] == 1 ? 1 : 2;
      rigid.targets[v] = turn * points[v];
    }
    std::vector<Point> moved = points_of(points);
    const Polygon_soup_domain<std::vector<Point>, decltype(triangles)> domain(moved, triangles);
    check_conforms(domain);
    CGAL::ARAP_deformation<std::decay_t<decltype(domain)>> deformation(domain);
    CHECK(deformation.set_options(options_for(cells, CGAL::ARAP::Minimizer::automatic,
                                              CGAL::ARAP::Initial_guess::laplacian)));
    prepare(deformation, rigid, numbers(points.size()));
    CHECK(deformation.deform(2000, 1e-12));
    if(cells != Cell_scheme::elements()) // a membrane may fold
      for(std::size_t v = 0; v < points.size(); ++v)
        CHECK_AT_MOST((vector(moved[v]) - turn * points[v]).norm(), 0.02); // turned by 1.5
  }
}

void test_output_range()
{
  test_case() = "another range for the output";
  const Block shape = block(4, 2, 2);
  const Scenario s = scenario(shape);
  const std::vector<Point> points = points_of(shape.points);
  std::vector<Point> output(points.size(), Point(7, 7, 7));
  std::vector<Point> input = points;
  const Tetrahedron_soup_domain<std::vector<Point>, decltype(shape.tetrahedra)> domain(
    input, shape.tetrahedra, output);
  check_conforms(domain);
  output.assign(points.size(), Point(7, 7, 7));
  const auto read = [&output](std::size_t v) { return output[v]; };
  Result result = deform(domain, numbers(points.size()), s, Cell_scheme::spokes_and_rims(), read);
  CHECK(input == points);
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    CHECK((output[v] == Point(7, 7, 7)) == (s.selection[v] == 0)); // outside the region of interest
    if(s.selection[v] == 0)
      result.points[v] = shape.points[v];
  }
  compare(reference<3>(shape.points, shape.tetrahedra, s, Cell_scheme::spokes_and_rims()), result,
          shape.diameter());

  // a second run goes on from the first, and after reset() all is as at first
  CGAL::ARAP_deformation<std::decay_t<decltype(domain)>> d(domain);
  std::vector<Point> in_place = points;
  const Tetrahedron_soup_domain<std::vector<Point>, decltype(shape.tetrahedra)> plain(
    in_place, shape.tetrahedra);
  CGAL::ARAP_deformation<std::decay_t<decltype(plain)>> e(plain);
  const auto free = std::size_t(std::find(s.selection.begin(), s.selection.end(), 1) -
                                s.selection.begin());
  const auto run = [&](auto& deformation) {
    prepare(deformation, s, numbers(points.size()));
    CHECK(deformation.deform(3, 0));
    deformation.insert_control_vertex(free); // fixed where it is: preprocesses again
    CHECK(deformation.deform(3, 0));
    deformation.overwrite_initial_geometry();
    deformation.translate(free, Kernel::Vector_3(0.1, 0, 0));
    CHECK(deformation.deform(3, 0));
  };
  run(d);
  run(e);
  for(std::size_t v = 0; v < points.size(); ++v)
    if(s.selection[v] != 0)
      CHECK(output[v] == in_place[v]);
  CHECK(input == points);
}

template <typename Function>
bool is_refused(const Function& f)
{
  try { f(); }
  catch(const std::logic_error&) { return true; } // a failed precondition is one, too
  return false;
}

// Nothing is read or written outside of the ranges.
void test_wrong_numbers()
{
  test_case() = "a vertex or a simplex that does not exist";
  const Shape shape = octahedron();
  std::vector<Point> points = points_of(shape.points);
  points.reserve(100); // reading behind the end would go unnoticed
  const std::vector<Point> before = points;
  const auto domain = CGAL::ARAP::make_polygon_soup_domain(points, shape.triangles);
  CGAL::ARAP_deformation<std::decay_t<decltype(domain)>> deformation(domain);
  for(std::size_t v : {points.size(), std::size_t(1000000000), std::size_t(-1)})
  {
    CHECK(is_refused([&] { deformation.insert_roi_vertex(v); }));
    CHECK(is_refused([&] { deformation.insert_control_vertex(v); }));
    CHECK(is_refused([&] { deformation.is_roi_vertex(v); }));
    CHECK(is_refused([&] { deformation.domain().point(v); }));
    CHECK(is_refused([&] { deformation.domain().set_point(v, Point(1, 2, 3)); }));
    CHECK(is_refused([&] { deformation.domain().is_isolated(v); }));
    CHECK(is_refused([&] {
      deformation.domain().for_each_incident_simplex(v, [](auto&&...) {});
    }));
  }
  for(std::size_t s : {shape.triangles.size(), std::size_t(-1)})
    CHECK(is_refused([&] { deformation.domain().simplex_vertices(s); }));
  CHECK(deformation.roi_vertices().empty());
  deformation.reset();
  CHECK(points == before);

  std::vector<Point> too_few;
  try
  {
    CGAL::ARAP::make_polygon_soup_domain(points, shape.triangles, too_few);
    CHECK(!"refused");
  }
  catch(const std::invalid_argument& e)
  {
    CHECK(std::string(e.what()) ==
          "Simplex_soup_domain: there are 6 points, but 0 output points");
  }
}

template <int Dimension, typename Simplices>
void check_refused(const Simplices& simplices)
{
  std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const std::vector<Point> before = points;
  const CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices> domain(points,
                                                                                        simplices);
  CGAL::ARAP_deformation<std::decay_t<decltype(domain)>> deformation(domain);
  for(std::size_t v : {0, 1, 2, 3, 4})
    deformation.insert_roi_vertex(v);
  deformation.insert_control_vertex(4);
  deformation.translate(4, Kernel::Vector_3(1, 0, 0));
  const CGAL::ARAP::Report report = deformation.deform();
  CHECK(report.status == Status::not_a_simplex);
  CHECK(report.message.find("vertex ") == 0);
  CHECK(points == before);
  CHECK(!CGAL::ARAP::check_domain(domain).empty());
}

// Corners that are valid until the next call only: all simplices have one place for them.
template <typename Domain>
struct With_one_buffer : Domain
{
  using Corners = std::vector<std::size_t>;
  std::shared_ptr<Corners> buffer = std::make_shared<Corners>();

  explicit With_one_buffer(const Domain& domain) : Domain(domain) {}
  const Corners& simplex_vertices(std::size_t s) const
  {
    const auto& corners = Domain::simplex_vertices(s);
    buffer->assign(std::begin(corners), std::end(corners));
    return *buffer;
  }
  template <typename Function>
  void for_each_incident_simplex(std::size_t v, const Function& f) const
  {
    Domain::for_each_incident_simplex(v, [&](std::size_t s, const auto&) {
      f(s, simplex_vertices(s));
    });
  }
};

// points that cannot be set
template <typename Domain>
struct Unchanging : Domain
{
  explicit Unchanging(const Domain& domain) : Domain(domain) {}
  void set_point(std::size_t, const typename Domain::Point&) const {}
};

// Conformance is seen wherever the shape is.
void test_conformance_far_away()
{
  test_case() = "conformance far from the origin";
  const Shape shape = shapes()[0];
  for(double far : {0., 1e6, 1e8, 1e15})
  {
    std::vector<Point> points = points_of(shape.points);
    for(Point& p : points)
      p = p + Kernel::Vector_3(far, -far, far);
    const auto domain = CGAL::ARAP::make_polygon_soup_domain(points, shape.triangles);
    CHECK(CGAL::ARAP::check_domain(domain).empty());
    CHECK(!CGAL::ARAP::check_domain(Unchanging(domain)).empty());
  }
}

// points with weights keep them
void test_weighted_points()
{
  test_case() = "points with weights";
  using Weighted = Kernel::Weighted_point_3;
  const Shape shape = shapes()[8];
  std::vector<Weighted> points;
  for(const auto& p : shape.points)
    points.emplace_back(point(p), 0.5 + double(points.size()));
  const std::vector<Weighted> rest = points;
  using Domain = Polygon_soup_domain<std::vector<Weighted>, decltype(shape.triangles)>;
  CGAL::ARAP_deformation<Domain> deformation(Domain(points, shape.triangles));
  for(std::size_t v = 0; v < points.size(); ++v)
    deformation.insert_roi_vertex(v);
  deformation.insert_control_vertex(0);
  deformation.insert_control_vertex(points.size() - 1);
  CHECK(deformation.translate(0, Kernel::Vector_3(0.1, 0.2, 0.3)));
  CHECK(deformation.deform());
  for(std::size_t v = 0; v < points.size(); ++v)
    CHECK(points[v].weight() == rest[v].weight());
  CHECK(points[0].point() == rest[0].point() + Kernel::Vector_3(0.1, 0.2, 0.3));
}

// A point of the plane as the concept asks for it: only the domain tells how many coordinates it
// has.
struct Plain_point
{
  double x = 0, y = 0;
};

// a vector with two coordinates
struct Plain_vector
{
  double operator[](std::size_t k) const { return CHECK(k < 2) ? k + 1.0 : 1e9; }
};

struct Plain_domain : Polygon_soup_domain<std::vector<std::array<double, 2>>,
                                          std::vector<std::array<std::size_t, 3>>>
{
  using Base = Polygon_soup_domain<std::vector<std::array<double, 2>>,
                                   std::vector<std::array<std::size_t, 3>>>;
  using Point = Plain_point;
  using Base::Base;
  Point point(std::size_t v) const { return {Base::point(v)[0], Base::point(v)[1]}; }
  void set_point(std::size_t v, const Point& p) const { Base::set_point(v, {p.x, p.y}); }
  static CGAL::ARAP::Coordinates coordinates(const Point& p) { return {p.x, p.y, 0}; }
  static Point make_point(const CGAL::ARAP::Coordinates& c) { return {c[0], c[1]}; }
};

void test_plain_points()
{
  test_case() = "points and vectors with two coordinates that do not tell so";
  std::vector<std::array<double, 2>> points = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const std::vector<std::array<std::size_t, 3>> triangles = {{0, 1, 2}, {1, 3, 2}};
  CGAL::ARAP_deformation<Plain_domain> deformation(Plain_domain(points, triangles));
  for(std::size_t v = 0; v < points.size(); ++v)
    deformation.insert_roi_vertex(v);
  deformation.insert_control_vertex(0);
  CHECK(deformation.set_velocity(3, Plain_vector()));
  CHECK((deformation.velocity(3) == CGAL::ARAP::Coordinates{1, 2, 0}));
  CGAL::ARAP::Dynamics dynamics;
  dynamics.time_step = 0.01;
  CHECK(deformation.advance(dynamics, [](std::size_t) { return Plain_vector(); }));
  CHECK(deformation.velocity(3)[0] > 0 && deformation.velocity(3)[2] == 0);
}

// A square with a hole, to which a bridge leads from its corner 0: that is in its face twice.
struct Bridged_face
{
  using simplex_descriptor = std::size_t;
  static constexpr int dimension = 2;
  std::vector<std::size_t> corners = {0, 1, 2, 3, 0, 4, 5, 6, 4};

  std::vector<std::size_t> vertices() const { return {0, 1, 2, 3, 4, 5, 6}; }
  std::size_t index(std::size_t v) const { return v; }
  const std::vector<std::size_t>& simplex_vertices(std::size_t) const { return corners; }

  template <typename Function>
  void for_each_incident_simplex(std::size_t v, const Function& f) const
  {
    for(std::size_t w : corners)
      if(w == v)
        f(std::size_t(0), corners);
  }
};

void test_bridged_face()
{
  test_case() = "a face with a bridge to a hole";
  const CGAL::ARAP::internal::Simplex_list<Bridged_face> list{Bridged_face()};
  CHECK(list.simplices() == std::vector<std::vector<std::size_t>>{Bridged_face().corners});
}

void test_buffered_corners()
{
  test_case() = "corners in a buffer";
  const Block shape = block(2, 2, 2);
  std::vector<Point> points = points_of(shape.points);
  check_conforms(
    With_one_buffer(CGAL::ARAP::make_tetrahedron_soup_domain(points, shape.tetrahedra)));
}

void test_all()
{
  test_surfaces();
  test_non_manifold();
  test_output_range();
  test_wrong_numbers();
  test_buffered_corners();
  test_conformance_far_away();
  test_weighted_points();
  test_plain_points();
  test_bridged_face();
  using Triangles = std::vector<std::array<int, 3>>;
  using Signed_polygons = std::vector<std::vector<int>>;
  using Tetrahedra = std::vector<std::array<int, 4>>;
  test_case() = "a corner that does not exist";
  check_refused<2>(Triangles{{0, 1, 2}, {0, 1, 5}});
  check_refused<2>(Triangles{{0, 1, 2}, {0, -1, 4}});
  check_refused<2>(Signed_polygons{{0, 1, 2}, {0, 1, 2, 9}});
  check_refused<3>(Tetrahedra{{0, 1, 2, 3}, {0, 1, 2, 1000000}});
  test_case() = "a corner twice";
  check_refused<2>(Triangles{{0, 1, 2}, {0, 1, 1}});
  check_refused<2>(Signed_polygons{{0, 1, 2}, {0, 1, 2, 3, 1, 4}});
  check_refused<3>(Tetrahedra{{0, 1, 2, 3}, {0, 1, 2, 0}});
  test_case() = "too few corners";
  check_refused<2>(Signed_polygons{{0, 1, 2}, {0, 1}});
  check_refused<3>(Signed_polygons{{0, 1, 2, 3}, {0, 1, 4}});
}

} // namespace soup

// The conformance test of domains tells what is wrong with domains that are, each in one way. That
// all domains that ship conform is in the test of each.
namespace conformance {

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

struct Gives_a_simplex_twice : Soup // at one of its corners
{
  using Soup::Soup;
  template <typename Function>
  void for_each_incident_simplex(std::size_t v, const Function& f) const
  {
    Soup::for_each_incident_simplex(v, [&](std::size_t s, const auto& corners) {
      f(s, corners);
      if(s == 5 && v == *corners.begin())
        f(s, corners);
    });
  }
};

template <std::size_t... Corners>
struct Gives_corners : Soup // of one simplex, at the first of them
{
  using Soup::Soup;
  template <typename Function>
  void for_each_incident_simplex(std::size_t v, const Function& f) const
  {
    const std::vector<std::size_t> corners = {Corners...};
    if(v == corners.front())
      f(std::size_t(0), corners);
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

struct Denies_a_vertex : Soup
{
  using Soup::Soup;
  bool is_vertex(std::size_t v) const { return v != 4; }
};

struct Denies_a_simplex : Soup
{
  using Soup::Soup;
  bool is_simplex(std::size_t s) const { return s != 4; }
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

// A number that can do what the concept asks of a descriptor, and no more.
template <typename Tag>
class Descriptor
{
public:
  explicit Descriptor(std::size_t number) : m_number(number) {}
  Descriptor() = delete;
  std::size_t number() const { return m_number; }
  friend bool operator==(const Descriptor& a, const Descriptor& b)
  {
    return a.m_number == b.m_number;
  }
  friend bool operator!=(const Descriptor&, const Descriptor&) = delete;

private:
  std::size_t m_number;
};

// a soup with such descriptors, and with corners that are valid until the next call
class Minimal_domain
{
public:
  using vertex_descriptor = Descriptor<struct Vertex_tag>;
  using simplex_descriptor = Descriptor<struct Simplex_tag>;
  using Point = Soup::Point;
  static constexpr int dimension = Soup::dimension;

  Minimal_domain(std::vector<Point>& points, const decltype(Shape::triangles)& triangles)
    : m_soup(points, triangles), m_number_of_points(points.size()),
      m_corners(std::make_shared<std::vector<vertex_descriptor>>())
  {}

  std::vector<vertex_descriptor> vertices() const
  {
    std::vector<vertex_descriptor> all;
    for(std::size_t v = 0; v < m_number_of_points; ++v)
      all.emplace_back(v);
    return all;
  }
  std::size_t index(vertex_descriptor v) const { return v.number(); }
  Point point(vertex_descriptor v) const { return m_soup.point(v.number()); }
  void set_point(vertex_descriptor v, const Point& p) const { m_soup.set_point(v.number(), p); }
  bool is_in_place() const { return true; }
  bool is_isolated(vertex_descriptor v) const { return m_soup.is_isolated(v.number()); }
  static CGAL::ARAP::Coordinates coordinates(const Point& p) { return Soup::coordinates(p); }
  static Point make_point(const CGAL::ARAP::Coordinates& c) { return Soup::make_point(c); }
  const std::vector<vertex_descriptor>& simplex_vertices(simplex_descriptor s) const
  {
    m_corners->clear();
    for(std::size_t v : m_soup.simplex_vertices(s.number()))
      m_corners->emplace_back(v);
    return *m_corners;
  }
  template <typename Function>
  void for_each_incident_simplex(vertex_descriptor v, const Function& f) const
  {
    m_soup.for_each_incident_simplex(v.number(), [&](std::size_t s, const auto&) {
      f(simplex_descriptor(s), simplex_vertices(simplex_descriptor(s)));
    });
  }

private:
  Soup m_soup;
  std::size_t m_number_of_points;
  std::shared_ptr<std::vector<vertex_descriptor>> m_corners;
};

void test_minimal_domain()
{
  test_case() = "minimal domain";
  const Shape shape = shapes()[2];
  const Scenario s = scenario(shape);
  const std::vector<Point> rest = points_of(shape.points);
  std::vector<Point> points = rest, others = rest;
  const Minimal_domain domain(points, shape.triangles);
  check_conforms(domain);
  CGAL::ARAP_deformation<Minimal_domain> deformation(domain);
  CGAL::ARAP_deformation<Soup> expected(Soup(others, shape.triangles));
  for(std::size_t v = 0; v < points.size(); ++v)
    if(s.selection[v] != 1)
    {
      deformation.insert_control_vertex(domain.vertices()[v], point(s.targets[v]));
      expected.insert_control_vertex(v, point(s.targets[v]));
    }
    else
    {
      deformation.insert_roi_vertex(domain.vertices()[v]);
      expected.insert_roi_vertex(v);
    }
  const auto before = deformation.state();
  CHECK(deformation.deform() && expected.deform());
  CHECK(points == others);
  const auto found = CGAL::ARAP::locate(domain, points[0]);
  if(CHECK(found))
    CHECK(deformation.insert_control_point(*found));
  CHECK(deformation.restore(before));
  CHECK(points == rest);
}

template <typename Domain>
void check_model(const std::string& sentence)
{
  test_case() = sentence;
  Shape shape = octahedron();
  shape.points.emplace_back(9, 9, 9); // isolated
  std::vector<Point> points = points_of(shape.points);
  CHECK_CAUGHT(CGAL::ARAP::check_domain(Domain(points, shape.triangles)), sentence);
}

void test_all()
{
  Shape shape = octahedron();
  std::vector<Point> points = points_of(shape.points);
  const std::vector<Point> before = points;
  check_conforms(Soup(points, shape.triangles));
  CHECK(points == before);

  check_model<Same_index>("index() is the same for two vertices of vertices(), for vertex 2");
  check_model<Never_isolated>(
    "is_isolated() and for_each_incident_simplex() disagree, for vertex 6");
  check_model<Not_in_place>("point() is not what set_point() and is_in_place() make it");
  check_model<Own_points>("a copy of the domain does not stand for the same mesh");
  check_model<Forgets_a_simplex>("a simplex is not given exactly once at each of its corners");
  check_model<Gives_a_simplex_twice>("a simplex is not given exactly once at each of its corners");
  check_model<Gives_corners<0, 1, 1>>("gives a simplex with a corner twice, for vertex 0");
  check_model<Gives_corners<0, 1>>("the number of corners of a simplex is not that of the dim");
  check_model<Other_corners>("simplex_vertices() and for_each_incident_simplex() give different");
  check_model<Fewer_vertices>("a corner of a simplex is not in vertices()");
  check_model<Denies_a_vertex>("is_vertex() denies a vertex of vertices()");
  check_model<Denies_a_simplex>("is_simplex() denies what for_each_incident_simplex() gives");
  check_model<Mirrored_points>("coordinates() and make_point() are not inverse to each other");
  check_model<Keeps_points>("point() is not what set_point() and is_in_place() make it");
  check_model<Throwing>("the domain threw an exception: no such table");
  test_minimal_domain();
}

} // namespace conformance

// Shapes that are not clean, of a shelf and random ones, as ranges.
namespace nasty {

template <int Dimension, std::size_t N>
void test_as_ranges(const Nasty_shape<N>& shape)
{
  using Simplices = std::vector<std::array<std::size_t, N>>;
  using Domain = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;
  const std::string structure = Dimension == 3 ? "tetrahedra" : N == 3 ? "triangles" : "polygons";
  for_each_case(shape, structure, [&](const Handles& handles, const Options& options) {
    std::vector<Point> points = points_of(shape.points);
    CGAL::ARAP_deformation<Domain> deformation(Domain(points, shape.simplices));
    run(deformation, numbers(points.size()), [&](std::size_t v) { return points[v]; }, handles,
        options);
  });
}

void test_all(int number_of_shapes, int first_seed)
{
  for(const Nasty_surface& shape : nasty_surfaces())
    test_as_ranges<2>(shape);
  for(const Nasty_polygons& shape : nasty_polygons())
    test_as_ranges<2>(shape);
  for(const Nasty_volume& shape : nasty_volumes())
    test_as_ranges<3>(shape);

  for(int seed = first_seed; seed < first_seed + number_of_shapes; ++seed)
  {
    std::mt19937 random(static_cast<unsigned int>(seed));
    Nasty_surface surface = random_shape(sheet_of(5, 4), random);
    surface.name = "random, seed " + std::to_string(seed);
    test_as_ranges<2>(surface);
    Nasty_volume volume = random_shape(block_of(2, 2, 1), random);
    volume.name = "random, seed " + std::to_string(seed);
    test_as_ranges<3>(volume);
  }
  print_ends();
}

} // namespace nasty

// Random shapes of triangles and tetrahedra, with random regions, handles, weights of targets and
// options: what holds for all of them. The seed of each is printed with what fails.
namespace random_shapes {

using CGAL::ARAP::Initial_guess;
using CGAL::ARAP::Minimizer;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;
using CGAL::ARAP::Status;
using CGAL::ARAP::Visitor_action;

class Random
{
public:
  explicit Random(unsigned int seed) : m_engine(seed) {}

  double number(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(m_engine);
  }

  std::size_t index(std::size_t n)
  {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(m_engine);
  }

  Eigen::Vector3d vector()
  {
    const double x = number(-1, 1), y = number(-1, 1); // in the order of these lines everywhere
    return {x, y, number(-1, 1)};
  }

  Affine_map rigid_motion()
  {
    const double angle = number(-3, 3);
    const Eigen::Vector3d axis = vector() + Eigen::Vector3d(2, 0, 0);
    return ::rigid_motion(angle, axis, 3 * vector());
  }

  template <typename Range>
  void shuffle(Range& range) { std::shuffle(range.begin(), range.end(), m_engine); }

private:
  std::mt19937 m_engine;
};

// a vertex is in no region, free, or a control vertex with a target
struct Role
{
  bool is_roi = true, is_control = false;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  double weight = std::numeric_limits<double>::infinity();
};

template <std::size_t N>
struct Problem
{
  Nasty_shape<N> shape;
  std::vector<Role> roles; // of the vertices
  Options options;
  double diameter;
};

// Triangles of a sheet or tetrahedra of a block, with some of them missing, and jittered by up to a
// fifth of their size. Those who look for worse shapes find them in test_nasty_shapes.
template <std::size_t N>
Problem<N> random_problem(Random& random)
{
  Problem<N> problem;
  if constexpr(N == 3)
    problem.shape = sheet_of(4 + int(random.index(6)), 3 + int(random.index(5)));
  else
    problem.shape = block_of(2 + int(random.index(3)), 1 + int(random.index(3)), 2);
  auto& points = problem.shape.points;
  auto& simplices = problem.shape.simplices;
  const double size = (points[simplices[0][1]] - points[simplices[0][0]]).norm();
  for(auto& p : points)
    p += 0.2 * size * random.vector();
  random.shuffle(simplices);
  simplices.resize(simplices.size() - random.index(simplices.size() / 4));

  problem.diameter = diameter_of(points);
  for(const auto& p : points)
  {
    Role role;
    switch(random.index(6))
    {
    case 0: role.is_roi = false; break;
    case 1:
      role.is_control = true;
      if(random.index(2) == 0)
        role.weight = std::pow(10, random.number(-2, 3));
    }
    role.target = p + 0.1 * problem.diameter * random.vector();
    problem.roles.push_back(role);
  }
  for(std::size_t corner : {0, 1}) // there is something to hold on to
    problem.roles[simplices[0][corner]] = {true, true, points[simplices[0][corner]]};
  problem.options.cells = all_cell_schemes[random.index(all_cell_schemes.size())];
  problem.options.minimizer = random.index(2) ? Minimizer::local_global : Minimizer::quasi_newton;
  problem.options.initial_guess = random.index(2) ? Initial_guess::previous
                                                  : Initial_guess::laplacian;
  problem.options.iterations = 10;
  problem.options.tolerance = 0;
  return problem;
}

template <std::size_t N>
class Random_test
{
  using Simplices = std::vector<std::array<std::size_t, N>>;
  using Domain = CGAL::ARAP::Simplex_soup_domain<int(N) - 1, std::vector<Point>, Simplices>;
  using Deformation = CGAL::ARAP_deformation<Domain>;

  // a problem with its points, and what deforms them
  struct Session
  {
    const Problem<N> problem;
    std::vector<Point> points;
    Deformation deformation;

    explicit Session(const Problem<N>& p)
      : problem(p), points(points_of(p.shape.points)),
        deformation(Domain(points, problem.shape.simplices))
    {
      CHECK(deformation.set_options(problem.options));
      for(std::size_t v = 0; v < points.size(); ++v)
      {
        const Role& role = problem.roles[v];
        if(role.is_roi)
          deformation.insert_roi_vertex(v);
        if(!role.is_control)
          continue;
        deformation.insert_control_vertex(v);
        CHECK(deformation.set_target_position(v, point(role.target)));
        CHECK(deformation.set_target_weight(v, role.weight));
      }
    }

    Session(const Session&) = delete;
  };

public:
  explicit Random_test(unsigned int seed) : m_random(seed), m_problem(random_problem<N>(m_random))
  {}

  void operator()()
  {
    Session session(m_problem);
    check_cancelled(session);
    const Report report = session.deformation.deform();
    if(!CHECK(report))
    {
      std::cerr << "    " << report.message << std::endl;
      return;
    }
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    CHECK(report.energy.back() >= -1e-14 * report.energy_scale);
    CHECK(report.energy.back() == session.deformation.energy());
    check_fixed(session);
    check_rotations(session);
    check_again(session, report);
    check_moved(session, report);
    check_reordered(session, report);
    check_rigid_targets();
  }

private:
  // What a visitor cancels has not been.
  void check_cancelled(Session& session)
  {
    const std::vector<Point> before = session.points;
    const std::size_t last = m_random.index(5);
    const Report report = session.deformation.deform([&](const auto& iterate) {
      return iterate.iteration() == last ? Visitor_action::cancel : Visitor_action::proceed;
    });
    CHECK(report.status == Status::cancelled);
    CHECK(session.points == before);
  }

  // Control vertices are at hard targets, and what is in no region or no simplex is where it was.
  void check_fixed(const Session& session)
  {
    std::vector<char> is_used(session.points.size(), false);
    for(const auto& simplex : m_problem.shape.simplices)
      for(std::size_t corner : simplex)
        is_used[corner] = true;
    for(std::size_t v = 0; v < session.points.size(); ++v)
    {
      const Role& role = m_problem.roles[v];
      if(role.is_control && !std::isfinite(role.weight))
        CHECK(session.points[v] == point(role.target));
      else if(!role.is_roi || (!is_used[v] && !role.is_control))
        CHECK(session.points[v] == point(m_problem.shape.points[v]));
    }
  }

  void check_rotations(const Session& session)
  {
    const bool has_vertex_cells = m_problem.options.cells.has_vertex_cells();
    const std::size_t n = has_vertex_cells ? session.points.size()
                                           : m_problem.shape.simplices.size();
    for(std::size_t k = 0; k < n; ++k)
      CHECK(CGAL::ARAP::is_rotation(has_vertex_cells ? session.deformation.rotation(k)
                                                     : session.deformation.simplex_rotation(k)));
  }

  // The same has the same bits.
  void check_again(const Session& session, const Report& report)
  {
    Session again(m_problem);
    CHECK(again.deformation.deform().energy == report.energy);
    CHECK(again.points == session.points);
  }

  // A rigid motion of the rest shape and the targets moves the result.
  void check_moved(const Session& session, const Report& report)
  {
    const Affine_map motion = m_random.rigid_motion();
    Problem<N> problem = m_problem;
    for(auto& p : problem.shape.points)
      p = motion * p;
    for(Role& role : problem.roles)
      role.target = motion * role.target;
    Session moved(problem);
    check_energies(moved.deformation.deform(), report);
    for(std::size_t v = 0; v < session.points.size(); ++v)
      CHECK_AT_MOST((vector(moved.points[v]) - motion * vector(session.points[v])).norm(),
                    accuracy() * m_problem.diameter);
  }

  // Vertices, simplices and corners in another order give the same.
  void check_reordered(const Session& session, const Report& report)
  {
    std::vector<std::size_t> places = numbers(session.points.size());
    m_random.shuffle(places);
    Problem<N> problem = m_problem;
    for(std::size_t v = 0; v < places.size(); ++v)
    {
      problem.shape.points[places[v]] = m_problem.shape.points[v];
      problem.roles[places[v]] = m_problem.roles[v];
    }
    for(auto& simplex : problem.shape.simplices)
    {
      for(std::size_t& corner : simplex)
        corner = places[corner];
      m_random.shuffle(simplex);
    }
    m_random.shuffle(problem.shape.simplices);
    Session reordered(problem);
    check_energies(reordered.deformation.deform(), report);
    for(std::size_t v = 0; v < places.size(); ++v)
      CHECK_AT_MOST((vector(reordered.points[places[v]]) - vector(session.points[v])).norm(),
                    accuracy() * m_problem.diameter);
  }

  // A guess that is a rigid motion of the rest shape, and targets that agree with it: there it
  // stays, at energy zero.
  void check_rigid_targets()
  {
    const Affine_map motion = m_random.rigid_motion();
    Problem<N> problem = m_problem;
    problem.options.initial_guess = Initial_guess::previous;
    for(std::size_t v = 0; v < problem.roles.size(); ++v)
      problem.roles[v] = {true, true, motion * problem.shape.points[v]};
    Session session(problem);
    CHECK(session.deformation.deform());
    for(std::size_t v = 0; v < problem.roles.size(); ++v)
      if(!m_problem.roles[v].is_control)
        session.deformation.erase_control_vertex(v);
      else
        CHECK(session.deformation.set_target_weight(v, m_problem.roles[v].weight));
    const Report report = session.deformation.deform();
    CHECK(report);
    for(double energy : report.energy)
      CHECK_AT_MOST(energy, 1e-14 * report.energy_scale);
    for(std::size_t v = 0; v < session.points.size(); ++v)
      CHECK_AT_MOST((vector(session.points[v]) - motion * problem.shape.points[v]).norm(),
                    1e-9 * m_problem.diameter);
  }

  // The memory of the quasi-Newton method is in single precision.
  double accuracy() const
  {
    return m_problem.options.minimizer == Minimizer::local_global ? 1e-8 : 1e-3;
  }

  void check_energies(const Report& report, const Report& expected)
  {
    if(!CHECK(report.energy.size() == expected.energy.size()))
      return;
    for(std::size_t k = 0; k < report.energy.size(); ++k)
      CHECK_AT_MOST(std::abs(report.energy[k] - expected.energy[k]),
                    accuracy() * expected.energy[0] + 1e-14 * expected.energy_scale);
  }

  Random m_random;
  const Problem<N> m_problem;
};

void test_all(int number_of_shapes, int first_seed)
{
  for(int seed = first_seed; seed < first_seed + number_of_shapes; ++seed)
  {
    test_case() = "surface, seed " + std::to_string(seed);
    Random_test<3>(static_cast<unsigned int>(seed))();
    test_case() = "volume, seed " + std::to_string(seed);
    Random_test<4>(static_cast<unsigned int>(seed))();
  }
  std::cout << "surfaces and volumes with seeds " << first_seed << " to "
            << first_seed + number_of_shapes - 1 << std::endl;
}

} // namespace random_shapes

// Measures of a result: what rigid motions and similarities do, an independent slow computation,
// and what is known of small shapes.
namespace quality_of_results {

using CGAL::ARAP::Quality;
using CGAL::ARAP::quality;
using CGAL::ARAP::quality_at_vertices;
using CGAL::ARAP::Vertex_measure;
using Points = std::vector<Eigen::Vector3d>;

const Vertex_measure all_measures[] = {Vertex_measure::edge_length_error,
                                       Vertex_measure::size_change, Vertex_measure::angle_change,
                                       Vertex_measure::spike};

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const double c = a.normalized().dot(b.normalized());
  return std::acos((std::max)(-1., (std::min)(1., c))) * 180 / std::acos(-1.);
}

double volume(const std::array<std::size_t, 4>& t, const Points& p)
{
  Eigen::Matrix3d m;
  m << p[t[1]] - p[t[0]], p[t[2]] - p[t[0]], p[t[3]] - p[t[0]];
  return m.determinant() / 6;
}

double area(const std::array<std::size_t, 3>& t, const Points& p) // by Heron
{
  const double a = (p[t[0]] - p[t[1]]).norm(), b = (p[t[1]] - p[t[2]]).norm(),
               c = (p[t[2]] - p[t[0]]).norm(), s = (a + b + c) / 2;
  return std::sqrt((std::max)(0., s * (s - a) * (s - b) * (s - c)));
}

double size(const std::array<std::size_t, 3>& t, const Points& p) { return area(t, p); }
double size(const std::array<std::size_t, 4>& t, const Points& p) { return volume(t, p); }

// what a vertex has, simplex by simplex
template <std::size_t N>
double slow_measure(Vertex_measure measure, std::size_t v,
                    const std::vector<std::array<std::size_t, N>>& simplices, const Points& rest,
                    const Points& now)
{
  double errors = 0, lengths = 0, change = 0, sizes = 0, largest = 0, rest_way = 0, way = 0;
  Eigen::Vector3d rest_sum(0, 0, 0), sum(0, 0, 0);
  for(const auto& s : simplices)
  {
    if(std::count(s.begin(), s.end(), v) == 0)
      continue;
    const double sign = size(s, rest) < 0 ? -1 : 1;
    change += sign * (size(s, now) - size(s, rest));
    sizes += std::abs(size(s, rest));
    for(std::size_t w : s)
    {
      const Eigen::Vector3d e = rest[w] - rest[v], f = now[w] - now[v];
      errors += (f.norm() - e.norm()) * (f.norm() - e.norm());
      lengths += e.squaredNorm();
      rest_sum += e;
      sum += f;
      rest_way += e.norm();
      way += f.norm();
      for(std::size_t u : s)
        if(u != v && w != v && u != w)
          largest = (std::max)(largest, std::abs(angle(now[u] - now[v], f) -
                                                 angle(rest[u] - rest[v], e)));
    }
  }
  return measure == Vertex_measure::edge_length_error ? std::sqrt(errors / lengths)
         : measure == Vertex_measure::size_change     ? change / sizes
         : measure == Vertex_measure::angle_change    ? largest
                                      : sum.norm() / way - rest_sum.norm() / rest_way;
}

template <std::size_t N>
Quality slow_quality(const std::vector<std::array<std::size_t, N>>& simplices, const Points& rest,
                     const Points& now)
{
  Quality result;
  double errors = 0, lengths = 0, area_now = 0, area_rest = 0, volume_now = 0, volume_rest = 0;
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for(const auto& s : simplices)
    for(std::size_t v : s)
      for(std::size_t w : s)
        edges.emplace(v, w); // also (v, v), which adds nothing, and each in both directions
  for(const auto& [v, w] : edges)
  {
    const double l = (rest[v] - rest[w]).norm();
    errors += std::pow((now[v] - now[w]).norm() - l, 2);
    lengths += l * l;
  }
  result.edge_length_error = std::sqrt(errors / lengths);
  bool is_closed = true;
  for(const auto& s : simplices)
  {
    const auto has_neighbor = [&](std::size_t left_out) { // with these corners but one
      return std::count_if(simplices.begin(), simplices.end(), [&](const auto& other) {
        return std::all_of(s.begin(), s.end(), [&](std::size_t v) {
          return v == left_out || std::count(other.begin(), other.end(), v) > 0;
        });
      }) > 1;
    };
    for(std::size_t left_out : s)
    {
      if(has_neighbor(left_out))
        continue;
      is_closed = false;
      if constexpr(N == 4)
      {
        std::array<std::size_t, 3> face;
        std::copy_if(s.begin(), s.end(), face.begin(),
                     [&](std::size_t v) { return v != left_out; });
        area_now += area(face, now);
        area_rest += area(face, rest);
      }
    }
    if constexpr(N == 4)
    {
      const double sign = volume(s, rest) < 0 ? -1 : 1;
      volume_now += sign * volume(s, now);
      volume_rest += sign * volume(s, rest);
      result.inverted_simplices += volume(s, now) * volume(s, rest) < 0;
    }
    else
    {
      area_now += area(s, now);
      area_rest += area(s, rest);
      volume_now += now[s[0]].dot(now[s[1]].cross(now[s[2]])) / 6;
      volume_rest += rest[s[0]].dot(rest[s[1]].cross(rest[s[2]])) / 6;
    }
  }
  result.area_change = area_now / area_rest - 1;
  if(N == 4 || is_closed)
    result.volume_change = volume_now / volume_rest - 1;
  for(std::size_t v = 0; v < rest.size(); ++v)
  {
    const auto at_v = [&](Vertex_measure m) { return slow_measure(m, v, simplices, rest, now); };
    result.largest_angle_change = (std::max)(result.largest_angle_change,
                                             at_v(Vertex_measure::angle_change));
    result.largest_spike = (std::max)(result.largest_spike, at_v(Vertex_measure::spike));
  }
  return result;
}

void compare(const Quality& a, const Quality& b)
{
  CHECK_AT_MOST(std::abs(a.edge_length_error - b.edge_length_error), 1e-12);
  CHECK_AT_MOST(std::abs(a.area_change - b.area_change), 1e-10);
  CHECK(std::isnan(a.volume_change) == std::isnan(b.volume_change));
  if(!std::isnan(a.volume_change))
    CHECK_AT_MOST(std::abs(a.volume_change - b.volume_change), 1e-9);
  CHECK_AT_MOST(std::abs(a.largest_angle_change - b.largest_angle_change), 1e-4);
  CHECK_AT_MOST(std::abs(a.largest_spike - b.largest_spike), 1e-12);
  CHECK(a.inverted_simplices == b.inverted_simplices);
}

template <int Dimension, std::size_t N>
void test_shape(const Points& rest, const std::vector<std::array<std::size_t, N>>& simplices)
{
  using Simplices = std::vector<std::array<std::size_t, N>>;
  using Domain = CGAL::ARAP::Simplex_soup_domain<Dimension, Points, Simplices>;
  Points now = rest;
  const Domain domain(now, simplices);

  // a similarity: a motion, and a scale
  const Affine_map motion = rigid_motion(2, {1, -2, 0.5}, {3, 0, 5});
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const bool has_volume = !std::isnan(quality(domain, rest).volume_change);
  for(const double scale : {1., 1.5})
  {
    for(std::size_t v = 0; v < rest.size(); ++v)
      now[v] = motion * (scale * rest[v]);
    compare(quality(domain, rest),
            {scale - 1, scale * scale - 1, has_volume ? std::pow(scale, 3) - 1 : unknown, 0, 0, 0});
    for(const Vertex_measure measure : all_measures)
      for(const double value : quality_at_vertices(domain, measure, rest))
        CHECK_AT_MOST(std::abs(value - (measure == Vertex_measure::edge_length_error ? scale - 1
                                        : measure == Vertex_measure::size_change
                                          ? std::pow(scale, Dimension) - 1 : 0)),
                      measure == Vertex_measure::angle_change ? 1e-5 : 1e-10);
  }

  std::mt19937 engine(7);
  for(Eigen::Vector3d& p : now)
    p = motion.inverse() * p + 0.3 * Eigen::Vector3d(engine() % 1000, engine() % 1000,
                                                     engine() % 1000) / 1000;
  compare(quality(domain, rest), slow_quality(simplices, rest, now));
  for(const Vertex_measure measure : all_measures)
  {
    const std::vector<double> values = quality_at_vertices(domain, measure, rest);
    CHECK(values.size() == rest.size());
    for(std::size_t v = 0; v < rest.size(); ++v)
      CHECK_AT_MOST(std::abs(values[v] - slow_measure(measure, v, simplices, rest, now)),
                    measure == Vertex_measure::angle_change ? 1e-4 : 1e-10);
  }

  for(const double scale : {1e-100, 1e100})
  {
    Points scaled_rest, scaled;
    for(std::size_t v = 0; v < rest.size(); ++v)
    {
      scaled_rest.push_back(scale * rest[v]);
      scaled.push_back(scale * now[v]);
    }
    compare(quality(Domain(scaled, simplices), scaled_rest), quality(domain, rest));
  }
  Points inverted = now;
  inverted[rest.size() / 2] += Eigen::Vector3d(4, 5, 6); // through what is opposite
  const Quality of_inverted = quality(Domain(inverted, simplices), rest);
  CHECK((of_inverted.inverted_simplices > 0) == (N == 4));
  compare(of_inverted, slow_quality(simplices, rest, inverted));

  Points broken = now;
  broken[0].y() = std::nan("");
  const Quality of_broken = quality(domain, rest, broken);
  CHECK(std::isnan(of_broken.edge_length_error) && std::isnan(of_broken.largest_angle_change) &&
        std::isnan(of_broken.largest_spike));
  for(const Vertex_measure measure : all_measures)
    CHECK(std::isnan(quality_at_vertices(domain, measure, rest, broken)[0]));

  const Points too_few(rest.begin(), rest.end() - 1);
  bool is_refused = false;
  try { quality(domain, too_few); }
  catch(const std::out_of_range&) { is_refused = true; }
  CHECK(is_refused);

  // maps of each kind; in the other direction
  std::map<std::size_t, Eigen::Vector3d> some; // the others are where they are now
  some[0] = rest[0];
  Points one = now;
  one[0] = rest[0];
  compare(quality(domain, some), quality(domain, one, [&](std::size_t v) { return now[v]; }));
  compare(quality(domain, now, rest), slow_quality(simplices, now, rest));
}

// A vertex without simplices has no measures, and changes none.
void test_lone_vertex(Block block)
{
  test_case() = "quality at a vertex without simplices";
  Points rest = block.points;
  block.points[3] += Eigen::Vector3d(0.1, 0.2, 0.3);
  const auto domain_of = [&block](Points& points) {
    return CGAL::ARAP::make_tetrahedron_soup_domain(points, block.tetrahedra);
  };
  const Quality before = quality(domain_of(block.points), rest);
  CHECK(before.edge_length_error > 0);
  rest.emplace_back(1, 1, 9);
  block.points.emplace_back(1, 5, 9);
  const auto domain = domain_of(block.points);
  compare(quality(domain, rest), before);
  for(const Vertex_measure measure : all_measures)
    CHECK(quality_at_vertices(domain, measure, rest).back() == 0);
  rest.back() = Eigen::Vector3d(1e170, 0, 0); // its square overflows
  compare(quality(domain, rest), before);
}

// A cube of squares has the measures of the one of triangles whose sides are not its diagonals.
void test_polygons()
{
  test_case() = "quality of polygons";
  Points rest, now;
  for(int k = 0; k < 8; ++k)
    rest.emplace_back(k & 1, k >> 1 & 1, k >> 2);
  const std::vector<std::vector<int>> faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for(const Eigen::Vector3d& p : rest)
    now.emplace_back(p.x() + p.z(), p.y(), 3 * p.z()); // sheared and stretched
  const CGAL::ARAP::Polygon_soup_domain<Points, std::decay_t<decltype(faces)>> domain(now, faces);
  const Quality measured = quality(domain, rest);
  const double side = std::sqrt(10.);
  CHECK_AT_MOST(std::abs(measured.edge_length_error - (side - 1) / std::sqrt(3.)), 1e-12);
  CHECK_AT_MOST(std::abs(measured.area_change - ((2 + 2 * 3 + 2 * side) / 6 - 1)), 1e-12);
  CHECK_AT_MOST(std::abs(measured.volume_change - 2), 1e-12);
  CHECK_AT_MOST(std::abs(measured.largest_angle_change - std::atan(1. / 3) * 180 / std::acos(-1.)),
                1e-10);
  const std::vector<std::vector<int>> open(faces.begin() + 1, faces.end());
  CHECK(std::isnan(quality(CGAL::ARAP::make_polygon_soup_domain(now, open), rest).volume_change));
}

// What encloses nothing at rest has no change of its volume, wherever it lies; an area that is not
// known has no change that is.
void test_flat()
{
  test_case() = "quality of a pillow";
  const Eigen::AngleAxisd turn(1, Eigen::Vector3d(1, 2, 3).normalized());
  Points flat, inflated;
  for(int k = 0; k < 6; ++k)
    flat.emplace_back(turn * Eigen::Vector3d(std::cos(k), std::sin(k), 1.3));
  flat.emplace_back((flat[0] + flat[2] + flat[4]) / 3);
  flat.emplace_back((flat[1] + flat[3] + flat[5]) / 3);
  std::vector<std::array<std::size_t, 3>> faces;
  for(std::size_t k = 0; k < 6; ++k)
  {
    faces.push_back({k, (k + 1) % 6, 6});
    faces.push_back({(k + 1) % 6, k, 7});
  }
  inflated = flat;
  inflated[6] += turn * Eigen::Vector3d(0, 0, 1);
  const auto domain = CGAL::ARAP::make_polygon_soup_domain(inflated, faces);
  CHECK(std::isnan(quality(domain, flat).volume_change));
  CHECK_AT_MOST(std::abs(quality(domain, inflated).volume_change), 1e-14);
  const std::vector<std::array<std::size_t, 4>> one = {{0, 1, 2, 3}};
  for(double way : {0.0, 1.0, 1e3, 1e6})
    for(int k = 0; k < 20; ++k)
    {
      test_case() = "quality of a flat tetrahedron that has moved by " + std::to_string(way);
      const Points before = {{0, 0, 0}, {.1, .2, .3}, {.3, .1, .2}, {.4, .3, .5}};
      Points plane;
      for(const auto& p : before)
        plane.push_back(Eigen::AngleAxisd(k, Eigen::Vector3d(1, 2, 2) / 3) * p +
                        way * Eigen::Vector3d(1, 2, 3));
      const auto tetrahedron = CGAL::ARAP::make_tetrahedron_soup_domain(plane, one);
      for(const Points& rest : {before, plane})
      {
        CHECK(quality(tetrahedron, rest).inverted_simplices == 0);
        CHECK(std::isnan(quality(tetrahedron, rest).volume_change));
        for(double change : quality_at_vertices(tetrahedron, Vertex_measure::size_change, rest))
          CHECK(change == 0);
      }
    }
  flat[3].x() = std::nan("");
  CHECK(std::isnan(quality(domain, flat).area_change));
}

// A mesh has the measures of its domain, also a const one, which is only read.
void test_meshes()
{
  test_case() = "quality of a mesh";
  const Shape shape = shapes()[2];
  Mesh mesh = make_mesh<Mesh>(shape);
  const Mesh rest = mesh;
  for(const auto v : mesh.vertices())
  {
    const Point p = mesh.point(v);
    mesh.point(v) = Point(2 * p.x(), p.y() + p.x() * p.z(), p.z());
  }
  const Mesh& now = mesh;
  const CGAL::ARAP::Face_graph_domain<Mesh> domain(mesh);
  compare(quality(now, rest.points()), quality(domain, rest.points()));
  compare(quality(rest, rest.points(), now.points()), quality(domain, rest.points()));
  CHECK(quality(now, rest.points()).edge_length_error > 0.1);
  for(const Vertex_measure measure : all_measures)
  {
    const std::vector<double> values = quality_at_vertices(domain, measure, rest.points());
    CHECK(quality_at_vertices(now, measure, rest.points()) == values);
    CHECK(quality_at_vertices(rest, measure, rest.points(), now.points()) == values);
  }
  CHECK(CGAL::ARAP::number_of_self_intersections(now) == 0);
  const Point apart = mesh.point(Mesh::Vertex_index(0)); // through the shape, to its other side
  mesh.point(Mesh::Vertex_index(0)) = CGAL::ORIGIN - 3 * (apart - CGAL::ORIGIN);
  CHECK(CGAL::ARAP::number_of_self_intersections(now) > 0);
  CHECK(CGAL::ARAP::number_of_self_intersections(now) ==
        CGAL::ARAP::number_of_self_intersections(domain));
}

// A square with a hole, to which a bridge leads: all triangles have the orientation of the polygon,
// wherever it starts.
void test_triangles_of_ring()
{
  test_case() = "triangles of a polygon that meets itself";
  CGAL::ARAP::internal::Array<CGAL::ARAP::Coordinates> ring = {
    {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
    {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  for(std::size_t k = 0; k < ring.size(); ++k)
  {
    double sum = 0;
    for(const auto& [a, b, c] : CGAL::ARAP::internal::triangles_of_polygon(ring))
    {
      const double area = 0.5 * ((ring[b][0] - ring[a][0]) * (ring[c][1] - ring[a][1]) -
                                 (ring[b][1] - ring[a][1]) * (ring[c][0] - ring[a][0]));
      CHECK(area >= 0);
      sum += area;
    }
    CHECK(sum == 12);
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  }
}

void test_self_intersections()
{
  test_case() = "self-intersections";
  Points points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 0}};
  const std::vector<std::array<int, 3>> two = {{0, 1, 2}, {3, 4, 5}};
  const auto surface = CGAL::ARAP::make_polygon_soup_domain(points, two);
  CHECK(CGAL::ARAP::number_of_self_intersections(surface) == 1);
  points[3] = {2.5, 2.5, -1};
  points[4] = {2.5, 2.5, 1};
  CHECK(CGAL::ARAP::number_of_self_intersections(surface) == 0);
  // the tip of a tetrahedron is in another one, which shares a face with a third
  Points corners = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, -4}, {0, 0, 4},
                    {0.5, 0.5, 1}, {0.6, 0.5, 9}, {0.5, 0.6, 9}, {0.5, 0.5, 9}};
  const std::vector<std::array<int, 4>> three = {{0, 1, 2, 3}, {0, 1, 2, 4}, {5, 6, 7, 8}};
  const auto volume = CGAL::ARAP::make_tetrahedron_soup_domain(corners, three);
  CHECK(CGAL::ARAP::number_of_self_intersections(volume) > 0);
  corners[5] = {0.5, 0.5, 8};
  CHECK(CGAL::ARAP::number_of_self_intersections(volume) == 0);

  // three corners on a line, wherever the polygon starts
  Points flat = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0.5, -1, 0}, {1.5, -1, 0}};
  Polygons polygons = {{0, 1, 2, 3, 4}, {1, 0, 5}, {2, 1, 6}};
  for(int k = 0; k < 5; ++k)
  {
    CHECK(CGAL::ARAP::number_of_self_intersections(
            CGAL::ARAP::make_polygon_soup_domain(flat, polygons)) == 0);
    std::rotate(polygons[0].begin(), polygons[0].begin() + 1, polygons[0].end());
  }

  // not convex, wherever they start: a dart, and an L
  const Points plane = {{0, 0, 0}, {2, 1, 0}, {4, 0, 0}, {2, 3, 0},
                        {5, 0, 0}, {7, 0, 0}, {7, 1, 0}, {6, 1, 0}, {6, 2, 0}, {5, 2, 0}};
  for(Polygons one : {Polygons{{0, 1, 2, 3}}, Polygons{{4, 5, 6, 7, 8, 9}}})
    for(std::size_t k = 0; k < one[0].size(); ++k)
    {
      Points copy = plane;
      CHECK(CGAL::ARAP::number_of_self_intersections(
              CGAL::ARAP::make_polygon_soup_domain(copy, one)) == 0);
      std::rotate(one[0].begin(), one[0].begin() + 1, one[0].end());
    }

  // what is not finite intersects nothing, and hides nothing
  Points holey = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 0},
                  {0, 0, 0}};
  const std::vector<std::array<int, 3>> around = {{0, 1, 2}, {3, 4, 5}, {6, 0, 1}, {4, 3, 6}};
  for(const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
  {
    holey[6] = {bad, 0, 0};
    CHECK(CGAL::ARAP::number_of_self_intersections(
            CGAL::ARAP::make_polygon_soup_domain(holey, around)) == 1);
  }
}

void test_all()
{
  Every_nth is_chosen(5);
  for(const Shape& shape : shapes())
    if(is_chosen())
    {
      test_case() = "quality of " + shape.name;
      test_shape<2>(shape.points, shape.triangles);
    }
  test_case() = "quality of a block";
  Block cubes = unit_cubes(2, 2, 2);
  test_shape<3>(cubes.points, cubes.tetrahedra);
  test_lone_vertex(cubes);
  test_polygons();
  test_flat();
  test_meshes();
  test_triangles_of_ring();
  test_self_intersections();
}

} // namespace quality_of_results

// Polygons with a corner in the middle of a side, bricks in a plane that is tilted: rounding errors
// of points that are float hardly change how stiff they are.
void test_bricks()
{
  test_case() = "bricks of float points";
  const std::size_t m = 9; // vertices in a row
  std::vector<CGAL::ARAP::Report> reports;
  for(const bool is_float : {false, true})
  {
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 0, 2).normalized()).toRotationMatrix();
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> bricks;
    for(std::size_t v = 0; v < m * m; ++v)
    {
      Eigen::Vector3d p = turn * Eigen::Vector3d(double(v % m), double(v / m), 0);
      if(is_float)
        p = p.cast<float>().cast<double>();
      points.push_back(point(p));
    }
    for(std::size_t row = 0; row + 1 < m; ++row)
      for(std::size_t v = row * m + row % 2; v + 2 < (row + 1) * m; v += 2)
        bricks.push_back({v, v + 1, v + 2, v + m + 2, v + m + 1, v + m});
    const auto domain = CGAL::ARAP::make_polygon_soup_domain(points, bricks);
    CGAL::ARAP_deformation d(domain);
    d.insert_roi_vertices(domain.vertices());
    for(std::size_t k = 0; k < m; ++k)
    {
      d.insert_control_vertex(k);
      d.insert_control_vertex(m * m - m + k);
      d.translate(m * m - m + k, Kernel::Vector_3(1, 0, 2));
    }
    reports.push_back(d.deform(1000, 1e-6));
    CHECK(reports.back());
  }
  CHECK_AT_MOST(std::abs(reports[1].energy_scale / reports[0].energy_scale - 1), 1e-2);
  CHECK_AT_MOST(std::abs(reports[1].final_energy() / reports[0].final_energy() - 1), 1e-2);
}

int main(int argc, char* argv[])
{
  test_bricks();
  soup::test_all();
  conformance::test_all();
  quality_of_results::test_all();
  const int first_seed = argc > 2 ? std::atoi(argv[2]) : 1;
  nasty::test_all(argc > 1 ? std::atoi(argv[1]) : short_or_long(30, 150), first_seed);
  random_shapes::test_all(argc > 1 ? std::atoi(argv[1]) : short_or_long(40, 200), first_seed);
  return checks_result();
}
