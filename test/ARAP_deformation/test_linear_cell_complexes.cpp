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

// Linear cell complexes: surfaces over combinatorial maps as FaceGraph and over generalized maps,
// complexes of tetrahedra over both, all terms of the energy, and shapes that are not clean.

#include "include/mesh_type.h"
#include "include/nasty_runs.h"
#include "include/term_runs.h"

#include <CGAL/ARAP_deformation/Linear_cell_complex_domain.h>
#include <CGAL/Linear_cell_complex_for_bgl_combinatorial_map_helper.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/Linear_cell_complex_for_generalized_map.h>
#include <CGAL/boost/graph/graph_traits_Linear_cell_complex_for_combinatorial_map.h>

#include <map>

using CGAL::ARAP::Linear_cell_complex_domain;

using Traits = CGAL::Linear_cell_complex_traits<3, Kernel>;
using Graph = CGAL::Linear_cell_complex_for_bgl_combinatorial_map_helper<2, 3, Traits>::type;
using Generalized_surface = CGAL::Linear_cell_complex_for_generalized_map<2, 3, Traits>;
using Plain_surface = CGAL::Linear_cell_complex_for_combinatorial_map<2, 3, Traits>; // no FaceGraph
using Volumes = CGAL::Linear_cell_complex_for_combinatorial_map<3, 3, Traits>;
using Generalized_volumes = CGAL::Linear_cell_complex_for_generalized_map<3, 3, Traits>;

// Sews simplices that have the same points in common, seen from darts that meet: those whose points
// on their facet come in ascending order.
template <typename Complex>
void sew(Complex& complex)
{
  constexpr int dimension = static_cast<int>(Complex::dimension);
  using Dart = decltype(complex.create_dart());
  std::map<std::vector<Point>, Dart> open;
  std::vector<std::pair<Dart, Dart>> pairs;
  for(auto dart = complex.darts().begin(); dart != complex.darts().end(); ++dart)
  {
    std::vector<Point> key = {complex.point(dart), complex.point(complex.other_extremity(dart))};
    if(dimension == 3)
      key.push_back(complex.point(complex.other_extremity(complex.next(dart))));
    if(std::is_same_v<Complex, Plain_surface>) // its darts meet in opposite directions
      std::sort(key.begin(), key.end());
    if(!std::is_sorted(key.begin(), key.end()))
      continue;
    const auto [found, is_new] = open.insert({key, dart});
    if(!is_new)
      pairs.emplace_back(found->second, dart);
  }
  for(const auto& [a, b] : pairs)
    complex.template sew<dimension>(a, b);
}

inline void sew(Volumes& complex) { complex.sew3_same_facets(); }

// a face with these corners
template <typename Complex>
void make_polygon(Complex& complex, const std::vector<Point>& corners)
{
  const auto face = complex.make_combinatorial_polygon(static_cast<unsigned int>(corners.size()));
  auto dart = face;
  for(const Point& p : corners)
  {
    complex.set_vertex_attribute(dart, complex.create_vertex_attribute(p));
    dart = complex.next(dart);
  }
}

// the vertices of a domain in the order of the points of a shape
template <typename Domain>
auto vertices_at(const Domain& domain, const std::vector<Eigen::Vector3d>& points)
{
  std::map<CGAL::ARAP::Coordinates, typename Domain::vertex_descriptor> places;
  for(auto v : domain.vertices())
    CHECK(places.emplace(Domain::coordinates(domain.point(v)), v).second);
  CHECK(places.size() == points.size());
  std::vector<typename Domain::vertex_descriptor> vertices;
  for(const auto& p : points)
    vertices.push_back(places.at({p.x(), p.y(), p.z()}));
  return vertices;
}

template <int Dimension, typename Complex, typename Simplices>
Complex make_complex(const std::vector<Eigen::Vector3d>& points, const Simplices& simplices)
{
  Complex complex;
  for(const auto& simplex : simplices)
  {
    std::vector<Point> corners;
    for(std::size_t v : simplex)
      corners.push_back(point(points[v]));
    if constexpr(Dimension == 2)
      make_polygon(complex, corners);
    else
      complex.make_tetrahedron(corners[0], corners[1], corners[2], corners[3]);
  }
  sew(complex);
  CHECK(complex.is_valid());
  return complex;
}

template <int Dimension, typename Complex, typename Simplices>
void compare_with_reference(const std::vector<Eigen::Vector3d>& points, const Simplices& simplices,
                            const Scenario& s, double diameter)
{
  for(Cell_scheme cells : all_cell_schemes)
  {
    Complex complex = make_complex<Dimension, Complex>(points, simplices);
    static_assert(std::is_same_v<typename CGAL::ARAP_deformation<Complex>::Deformation_domain,
                                 Linear_cell_complex_domain<Complex>>);
    const Linear_cell_complex_domain domain(complex);
    if(cells == all_cell_schemes[0])
      check_conforms(domain);
    compare(reference<Dimension>(points, simplices, s, cells),
            deform(domain, vertices_at(domain, points), s, cells), diameter);
  }
}

// each term of the energy
template <int Dimension, typename Complex, typename Simplices>
void test_terms_of(const std::vector<Eigen::Vector3d>& points, const Simplices& simplices,
                   const Scenario& s)
{
  test_terms<Dimension>(points, simplices, s, [&](const auto& compare_with) {
    Complex complex = make_complex<Dimension, Complex>(points, simplices);
    const Linear_cell_complex_domain domain(complex);
    compare_with(domain, vertices_at(domain, points));
  });
}

// What is not a tetrahedron, or not closed, is refused.
template <typename Complex, typename Make>
void check_refused(const std::string& name, const Make& make)
{
  test_case() = name;
  Complex complex;
  make(complex);
  CGAL::ARAP_deformation<Complex> deformation(complex);
  for(auto v : deformation.domain().vertices())
    deformation.insert_roi_vertex(v);
  deformation.insert_control_vertex(*deformation.domain().vertices().begin());
  CHECK(deformation.insert_control_point(99999, {1, 0, 0, 0}).status ==
        CGAL::ARAP::Status::not_a_simplex);
  const CGAL::ARAP::Report report = deformation.deform();
  CHECK(report.status == CGAL::ARAP::Status::not_a_simplex);
  CHECK(report.message.find("vertex ") == 0);
}

// The vertices of a good complex are moved to where they should not be.
void test_shelf_of_volumes()
{
  const std::vector<Nasty_volume> shelf = nasty_points_of_a_volume();
  const Nasty_volume& good = shelf.front();
  Volumes complex;
  for(const auto& t : good.simplices)
    complex.make_tetrahedron(point(good.points[t[0]]), point(good.points[t[1]]),
                             point(good.points[t[2]]), point(good.points[t[3]]));
  sew(complex);
  const auto domain = CGAL::ARAP::make_linear_cell_complex_domain(complex);
  const auto vertices = vertices_at(domain, good.points);
  for(const Nasty_volume& shape : shelf)
    test_in_place_of("linear cell complex of volumes", domain, vertices, shape);
}

int main()
{
  const Point a(0, 0, 0), b(1, 0, 0), c(1, 1, 0.5), d(0, 1, 0);
  check_refused<Volumes>("a cube", [](Volumes& complex) {
    complex.make_hexahedron(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0),
                            Point(0, 1, 1), Point(0, 0, 1), Point(1, 0, 1), Point(1, 1, 1));
  });
  check_refused<Volumes>("a face in a complex of volumes", [&](Volumes& complex) {
    complex.make_quadrangle(a, b, c, d);
  });
  check_refused<Generalized_volumes>("the same", [&](Generalized_volumes& complex) {
    complex.make_quadrangle(a, b, c, d);
  });
  check_refused<Plain_surface>("an open path", [&](Plain_surface& complex) {
    complex.make_segment(a, b, true);
  });
  check_refused<Generalized_surface>("the same", [&](Generalized_surface& complex) {
    complex.make_segment(a, b);
  });

  test_mesh_type<Graph>("a surface as FaceGraph");
  {
    test_case() = "polygons";
    Polygons polygons;
    const Shape shape = tube(polygons);
    compare_with_reference<2, Generalized_surface>(shape.points, polygons, scenario(shape),
                                                   shape.diameter());
    compare_with_reference<2, Plain_surface>(shape.points, polygons, scenario(shape),
                                             shape.diameter());
    test_terms_of<2, Plain_surface>(shape.points, polygons, scenario(shape));
  }
  for(const Shape& shape : shapes())
  {
    test_case() = "a generalized map of dimension 2: " + shape.name;
    compare_with_reference<2, Generalized_surface>(shape.points, shape.triangles, scenario(shape),
                                                   shape.diameter());
  }
  const Block shape = block(5, 2, 2);
  test_case() = "a combinatorial map of dimension 3";
  compare_with_reference<3, Volumes>(shape.points, shape.tetrahedra, scenario(shape),
                                     shape.diameter());
  test_terms_of<3, Volumes>(shape.points, shape.tetrahedra, scenario(shape));
  test_case() = "a generalized map of dimension 3";
  compare_with_reference<3, Generalized_volumes>(shape.points, shape.tetrahedra, scenario(shape),
                                                 shape.diameter());
  test_shelf_as_graph<Graph>("linear cell complex");
  test_shelf_of_volumes();
  print_ends();
  return checks_result();
}
