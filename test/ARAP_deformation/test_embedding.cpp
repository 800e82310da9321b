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

// Points embedded in a tetrahedral complex: against a search over all tetrahedra, under affine and
// other maps, inside, outside and where tetrahedra meet, in several domains; data that is refused.

#include "include/domains.h"

#include <CGAL/ARAP_deformation/Embedding.h>
#include <CGAL/ARAP_deformation/Triangulation_domain.h>
#include <CGAL/ARAP_deformation/locate.h>
#include <CGAL/ARAP_deformation/quality.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedron_3.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using CGAL::ARAP::Coordinates;
using CGAL::ARAP::Embedding;
using CGAL::ARAP::Status;
using CGAL::ARAP::Tetrahedron_soup_domain;
using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Eigen::Vector3d;

Vector3d vector(const Coordinates& c) { return {c[0], c[1], c[2]}; }

// The distance of a point from a triangle: of its foot in the plane, on an edge, or at a corner.
double distance(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  double smallest = std::numeric_limits<double>::infinity();
  const std::array<Vector3d, 4> corners = {a, b, c, a};
  const Vector3d normal = (b - a).cross(c - a).normalized();
  bool is_above = true;
  for(int k = 0; k < 3; ++k)
  {
    const Vector3d edge = corners[k + 1] - corners[k], q = p - corners[k];
    const double t = (std::min)((std::max)(q.dot(edge) / edge.squaredNorm(), 0.0), 1.0);
    smallest = (std::min)(smallest, (q - t * edge).norm());
    is_above = is_above && normal.cross(edge).dot(q) >= 0;
  }
  return is_above ? (std::min)(smallest, std::abs(normal.dot(p - a))) : smallest;
}

struct Tetrahedron
{
  std::array<Vector3d, 4> p;

  double volume() const { return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6; }

  double smallest_coordinate(const Vector3d& q) const
  {
    double smallest = std::numeric_limits<double>::infinity();
    for(int k = 0; k < 4; ++k)
    {
      Tetrahedron other = *this;
      other.p[k] = q;
      smallest = (std::min)(smallest, other.volume() / volume());
    }
    return smallest;
  }

  double distance(const Vector3d& q) const
  {
    if(smallest_coordinate(q) >= 0)
      return 0;
    double smallest = std::numeric_limits<double>::infinity();
    for(int k = 0; k < 4; ++k)
      smallest = (std::min)(smallest,
                            ::distance(q, p[(k + 1) % 4], p[(k + 2) % 4], p[(k + 3) % 4]));
    return smallest;
  }
};

// what is tested of a complex is found by walking over the whole of it
template <typename Domain>
struct Complex
{
  using Vertex = typename Domain::vertex_descriptor;

  Domain domain;
  std::vector<Vertex> vertices; // those with tetrahedra
  std::vector<Vector3d> rest;   // their points
  std::vector<Tetrahedron> tetrahedra;
  std::vector<std::array<Vector3d, 3>> faces; // those between two tetrahedra twice
  double diameter;

  explicit Complex(const Domain& d) : domain(d)
  {
    for(Vertex v : domain.vertices())
    {
      if(domain.is_isolated(v))
        continue;
      vertices.push_back(v);
      rest.push_back(point(v));
    }
    diameter = diameter_of(rest);
    for(Vertex v : vertices)
      domain.for_each_incident_simplex(v, [&](const auto&, const auto& corners) {
        Tetrahedron t;
        bool is_first = true;
        int k = 0;
        for(Vertex w : corners)
        {
          t.p[k++] = point(w);
          is_first = is_first && domain.index(v) <= domain.index(w);
        }
        if(!is_first)
          return;
        tetrahedra.push_back(t);
        for(k = 0; k < 4; ++k)
          faces.push_back({t.p[k], t.p[(k + 1) % 4], t.p[(k + 2) % 4]});
      });
  }

  Vector3d point(Vertex v) const { return vector(Domain::coordinates(domain.point(v))); }

  // random points around the complex, its vertices, and points on its faces and edges
  std::vector<Vector3d> probes(std::size_t n) const
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    const Eigen::AlignedBox3d box = bounding_box(rest);
    std::vector<Vector3d> all(rest.begin(), rest.begin() + (std::min)(n, rest.size()));
    for(std::size_t k = 0; k < n; ++k)
      all.push_back(box.center() +
                    0.75 * box.sizes().cwiseProduct(Vector3d(2 * uniform(random) - 1,
                                                             2 * uniform(random) - 1,
                                                             2 * uniform(random) - 1)));
    for(std::size_t k = 0; k < n; ++k)
    {
      const auto& [a, b, c] = faces[random() % faces.size()];
      const double s = uniform(random), t = k % 2 == 0 ? 0 : uniform(random) * (1 - s);
      all.push_back(a + s * (b - a) + t * (c - a));
      all.push_back(all.back() + 0.1 * (b - a).cross(c - a).normalized() * diameter);
    }
    return all;
  }

  template <typename Map>
  void move(const Map& map) const
  {
    for(std::size_t k = 0; k < vertices.size(); ++k)
    {
      const Vector3d p = map(rest[k]);
      domain.set_point(vertices[k], Domain::make_point({p.x(), p.y(), p.z()}));
    }
  }
};

// twists, bends, and is not affine anywhere
Vector3d bent(const Vector3d& p)
{
  return {p.x() + 0.3 * std::sin(2 * p.y()), p.y() * std::cos(p.x()), p.z() + 0.2 * p.x() * p.y()};
}

// The rest shape of the complex must be one whose tetrahedra do not overlap.
template <typename Domain>
void test_embedding(const std::string& name, const Domain& domain, std::size_t n = 150)
{
  test_case() = name;
  const Complex<Domain> complex(domain);
  const double small = 1e-12 * complex.diameter;
  const std::vector<Vector3d> probes = complex.probes(n);
  const Embedding<Domain> embedding(domain, probes);
  if(!CHECK(embedding.outcome()) || !CHECK(embedding.size() == probes.size()))
  {
    std::cerr << "    " << embedding.outcome().message << std::endl;
    return;
  }

  std::size_t inside = 0;
  for(std::size_t k = 0; k < probes.size(); ++k)
  {
    const auto& lambda = embedding.barycentric_coordinates(k);
    double extrapolation = 0;
    for(double l : lambda)
      extrapolation += std::abs(l);
    CHECK_AT_MOST(std::abs(lambda[0] + lambda[1] + lambda[2] + lambda[3] - 1),
                  1e-15 * extrapolation);
    CHECK_AT_MOST((vector(embedding.position(k)) - probes[k]).norm(), small * extrapolation);

    // the nearest tetrahedron, and among those at the same distance the one that extrapolates least
    double nearest = std::numeric_limits<double>::infinity(), least = -nearest;
    for(const Tetrahedron& t : complex.tetrahedra)
      nearest = (std::min)(nearest, t.distance(probes[k]));
    for(const Tetrahedron& t : complex.tetrahedra)
      if(t.distance(probes[k]) <= nearest)
        least = (std::max)(least, t.smallest_coordinate(probes[k]));
    Tetrahedron chosen;
    for(int c = 0; c < 4; ++c)
      chosen.p[c] = complex.point(embedding.vertices(k)[c]);
    CHECK_AT_MOST(std::abs(embedding.distance(k) - nearest), small);
    CHECK_AT_MOST(chosen.distance(probes[k]), nearest + small);
    CHECK(chosen.smallest_coordinate(probes[k]) >= least - 1e-9 * extrapolation);
    inside += embedding.distance(k) == 0;
  }
  CHECK(inside > n / 4 && inside < probes.size() - n / 4); // both were tested

  // an affine map, inside and outside
  Eigen::Matrix3d m;
  m << 0.3, -1.2, 0.4, 0.9, 0.1, -0.7, 0.2, 0.5, 1.1;
  const Vector3d shift = complex.diameter * Vector3d(1, -2, 0.5);
  const auto affine = [&](const Vector3d& p) { return Vector3d(m * p + shift); };
  complex.move(affine);
  for(std::size_t k = 0; k < probes.size(); ++k)
  {
    double extrapolation = 0;
    for(double l : embedding.barycentric_coordinates(k))
      extrapolation += std::abs(l);
    CHECK_AT_MOST((vector(embedding.position(k)) - affine(probes[k])).norm(),
                  small * extrapolation);
  }

  // any map: vertices follow their vertices, and all ways to write the points agree
  complex.move(bent);
  for(std::size_t k = 0; k < complex.rest.size() && k < n; ++k)
    CHECK_AT_MOST((vector(embedding.position(k)) - bent(probes[k])).norm(), small);
  std::vector<Point> points(probes.size());
  embedding.put_points(points);
  for(std::size_t k = 0; k < probes.size(); ++k)
    CHECK(vector(points[k]) == vector(embedding.position(k)));
  complex.move([](const Vector3d& p) { return p; });

  // points on a face move with it, to whichever side they are bound
  std::vector<Vector3d> on_faces, targets;
  for(const auto& [a, b, c] : complex.faces)
    if(on_faces.size() < n)
    {
      on_faces.push_back(0.2 * a + 0.3 * b + 0.5 * c);
      targets.push_back(0.2 * bent(a) + 0.3 * bent(b) + 0.5 * bent(c));
    }
  const Embedding<Domain> faces(domain, on_faces);
  CHECK(faces.outcome());
  complex.move(bent);
  for(std::size_t k = 0; k < faces.size(); ++k)
  {
    CHECK_AT_MOST(faces.distance(k), small);
    // a rounding error of the point is magnified by the map of a thin tetrahedron
    CHECK_AT_MOST((vector(faces.position(k)) - targets[k]).norm(), 1e-9 * complex.diameter);
  }
  complex.move([](const Vector3d& p) { return p; });
}

void test_ranges()
{
  const Block shape = block(5, 3, 2);
  std::vector<Point> points = points_of(shape.points);
  const Tetrahedron_soup_domain<std::vector<Point>, decltype(shape.tetrahedra)> domain(
    points, shape.tetrahedra);
  test_embedding("a block", domain);

  // the order of simplices and corners has no influence, to the last bit
  test_case() = "order";
  auto tetrahedra = shape.tetrahedra;
  std::mt19937 random(5);
  std::shuffle(tetrahedra.begin(), tetrahedra.end(), random);
  for(auto& t : tetrahedra)
    std::shuffle(t.begin(), t.end(), random);
  const Tetrahedron_soup_domain<std::vector<Point>, decltype(tetrahedra)> shuffled(points,
                                                                                 tetrahedra);
  std::vector<Vector3d> probes = Complex<std::decay_t<decltype(domain)>>(domain).probes(200);
  const Embedding a(domain, probes);
  const Embedding b(shuffled, probes);
  CHECK(a.outcome() && b.outcome() && a.size() == probes.size() && b.size() == probes.size());
  for(std::size_t k = 0; k < a.size() && k < b.size(); ++k)
    CHECK(a.vertices(k) == b.vertices(k) && a.distance(k) == b.distance(k) &&
          a.barycentric_coordinates(k) == b.barycentric_coordinates(k));

  // a lattice, where ties are exact: outside of its edges and corners, and at the middles of cells
  std::vector<Point> lattice;
  for(int x = 0; x <= 5; ++x)
    for(int y = 0; y <= 3; ++y)
      for(int z = 0; z <= 2; ++z)
        lattice.emplace_back(x, y, z);
  const Tetrahedron_soup_domain<std::vector<Point>, decltype(shape.tetrahedra)> cubes(
    lattice, shape.tetrahedra);
  test_embedding("a lattice", cubes);
  test_case() = "ties in a lattice";
  const std::vector<Point> outside = {{-1, -1, -1}, {6, 4, 3}, {-0.5, -0.5, 1}, {2.5, 1.5, 1},
                                      {2, 1, 1}, {2, 1.5, 4}, {1.5, 0.5, 0.5}};
  const Embedding ties(cubes, outside);
  CHECK(ties.outcome());
  const std::vector<double> distances = {std::sqrt(3.0), std::sqrt(3.0), std::sqrt(0.5), 0, 0, 2,
                                         0};
  for(std::size_t k = 0; k < ties.size(); ++k)
    CHECK_AT_MOST(std::abs(ties.distance(k) - distances[k]), 1e-14);

  test_case() = "far from the origin";
  const Vector3d far(5e6, 5e6, 5e6), middle(1.0 / 3, 1.0 / 3, 0);
  std::vector<Point> thin_points;
  for(const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0),
                           Vector3d(middle + Vector3d(0, 0, 1e-5))})
    thin_points.push_back(point(far + p));
  const std::vector<std::array<std::size_t, 4>> one = {{0, 1, 2, 3}};
  const Vector3d below = far + middle - Vector3d(0, 0, 0.5);
  const auto thin = CGAL::ARAP::make_tetrahedron_soup_domain(thin_points, one);
  const CGAL::ARAP::Embedding<std::decay_t<decltype(thin)>> far_away(
    thin, std::vector<Point>{point(below)});
  CHECK_AT_MOST((vector(far_away.position(0)) - below).norm(), 1e-8);

  test_case() = "scales";
  for(double scale : {1e-200, 1e-20, 1e20, 1e200})
  {
    std::vector<Point> scaled;
    std::vector<Vector3d> scaled_probes;
    for(const Vector3d& p : shape.points)
      scaled.push_back(point(scale * p));
    for(const Vector3d& p : probes)
      scaled_probes.push_back(scale * p);
    const Tetrahedron_soup_domain<std::vector<Point>, decltype(shape.tetrahedra)> same(
      scaled, shape.tetrahedra);
    const Embedding c(same, scaled_probes);
    CHECK(c.outcome() && c.size() == probes.size());
    for(std::size_t k = 0; k < c.size(); ++k)
    {
      CHECK_AT_MOST(std::abs(c.distance(k) / scale - a.distance(k)), 1e-12);
      CHECK_AT_MOST((vector(c.position(k)) / scale - probes[k]).norm(), 1e-12);
    }
  }
}

// A flat tetrahedron is ignored, however far away its corners are; one that is too large for the
// numbers has no place.
void test_far_flat_tetrahedra()
{
  test_case() = "flat tetrahedra that reach far";
  std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1e13, 0, 0},
                               {1e308, 0, 0}, {1e308, 1e306, 0}, {1e308, 0, 1e306},
                               {0.9e308, 0, 0}, {-1e308, 0, 0}, {-1e308, 1e306, 0},
                               {-1e308, 0, 1e306}, {-0.9e308, 0, 0}};
  using Tetrahedra = std::vector<std::array<std::size_t, 4>>;
  const Tetrahedra tetrahedra = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  const Tetrahedra huge = {{5, 6, 7, 8}, {9, 10, 11, 12}};
  const std::vector<Point> queries = {{0.3, 0.3, 5}};
  const auto domain = CGAL::ARAP::make_tetrahedron_soup_domain(points, tetrahedra);
  const CGAL::ARAP::Embedding<std::decay_t<decltype(domain)>> embedding(domain, queries);
  CHECK(embedding.outcome());
  CHECK_AT_MOST(std::abs(embedding.distance(0) - std::sqrt(16 + 2 * 0.01)), 0.1);
  const auto too_large = CGAL::ARAP::make_tetrahedron_soup_domain(points, huge);
  CHECK(!CGAL::ARAP::locate(too_large, queries[0]));
}

// Tetrahedra in planes, inside, on the boundary and away from all others, hold no points.
void test_flat_tetrahedra()
{
  test_case() = "flat tetrahedra";
  const Block shape = block(3, 2, 2);
  std::vector<Point> points = points_of(shape.points);
  const Tetrahedron_soup_domain<std::vector<Point>, decltype(shape.tetrahedra)> domain(
    points, shape.tetrahedra);
  std::vector<Vector3d> probes = Complex<std::decay_t<decltype(domain)>>(domain).probes(200);

  std::vector<Point> more_points = points;
  auto tetrahedra = shape.tetrahedra;
  for(int t = 0; t < 30; ++t) // in a face, and within rounding of it
  {
    const auto [a, b, c, d] = shape.tetrahedra[t];
    const Vector3d p = (shape.points[a] + shape.points[b] + shape.points[c]) / 3;
    tetrahedra.push_back({a, b, c, more_points.size()});
    more_points.push_back(point(p + 1e-15 * (shape.points[d] - p)));
    probes.push_back(p);
  }
  for(double x : {7, 8, 9, 10})
    more_points.emplace_back(x, 2 * x, x * x);
  probes.emplace_back(7, 14, 49);
  more_points.emplace_back(10, 10, 10);
  const std::size_t n = more_points.size();
  tetrahedra.push_back({n - 2, n - 3, n - 4, n - 2 - 3}); // three points in a line, and another
  more_points[n - 4] = more_points[n - 2] + 0.5 * (more_points[n - 3] - more_points[n - 2]);
  const Tetrahedron_soup_domain<std::vector<Point>, decltype(tetrahedra)> with_flat(more_points,
                                                                                  tetrahedra);
  const Embedding plain(domain, probes);
  const Embedding flat(with_flat, probes);
  CHECK(plain.outcome() && flat.outcome() && flat.size() == probes.size());
  for(std::size_t k = 0; k < plain.size() && k < flat.size(); ++k)
  {
    CHECK(plain.vertices(k) == flat.vertices(k));
    CHECK_AT_MOST(std::abs(plain.distance(k) - flat.distance(k)), 1e-12);
  }
}

void test_triangulations()
{
  using Delaunay = CGAL::Delaunay_triangulation_3<Epick>;
  using Mesh_domain = CGAL::Labeled_mesh_domain_3<Epick>;
  using Mesh_triangulation = CGAL::Mesh_triangulation_3<Mesh_domain>::type;

  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Epick::Point_3> points;
  for(int k = 0; k < 60; ++k)
    points.emplace_back(uniform(random), uniform(random), uniform(random));
  Delaunay delaunay(points.begin(), points.end());
  test_embedding("Delaunay_triangulation_3", CGAL::ARAP::make_triangulation_domain(delaunay), 100);

  // a complex with a bay and a separate part
  CGAL::Mesh_complex_3_in_triangulation_3<Mesh_triangulation> complex;
  for(const Epick::Point_3& p : points)
    complex.triangulation().insert(Mesh_triangulation::Weighted_point(p));
  for(auto cell : complex.triangulation().finite_cell_handles())
  {
    const double x = (cell->vertex(0)->point().x() + cell->vertex(1)->point().x()) / 2;
    if(x < -0.3 || x > 0.2)
      complex.add_to_complex(cell, x < 0 ? 1 : 2);
  }
  test_embedding("a complex", CGAL::ARAP::make_complex_domain(complex), 100);
  test_embedding("one subdomain", CGAL::ARAP::make_complex_domain(complex, 2), 100);
}

// A surface is carried along with a volume that is deformed.
void test_deformation()
{
  test_case() = "a surface in a deformed volume";
  const Block shape = block(8, 2, 2);
  std::vector<Point> points = points_of(shape.points);
  const Tetrahedron_soup_domain<std::vector<Point>, decltype(shape.tetrahedra)> domain(
    points, shape.tetrahedra);
  Mesh mesh = make_mesh<Mesh>(grid("", 20, 6, [](double u, double v) {
    return Vector3d(4 * u, 0.8 * v, 0.3);
  }));
  const Mesh rest = mesh;
  const Embedding embedding(domain, mesh.points());
  CHECK(embedding.outcome() && embedding.size() == mesh.number_of_vertices());

  CGAL::ARAP_deformation<std::decay_t<decltype(domain)>> deformation(domain);
  prepare(deformation, scenario(shape, 0.3), numbers(points.size()));
  CHECK(deformation.deform(200, 0));
  embedding.put_points(mesh.points());
  CHECK(largest_distance(points_of(mesh), points_of(rest)) > 0.1);
  CHECK_AT_MOST(CGAL::ARAP::quality(mesh, rest.points()).edge_length_error, 0.4);

  // all of it again: the points of the domain are what counts, not how they came about
  deformation.reset();
  embedding.put_points(mesh.points());
  CHECK_AT_MOST(largest_distance(points_of(mesh), points_of(rest)), 1e-14);

  // points in a list, as a Polyhedron_3 has them
  CGAL::Polyhedron_3<Epick> polyhedron;
  polyhedron.make_tetrahedron({0.1, 0.1, 0.1}, {3, 0.1, 0.1}, {0.1, 0.7, 0.1}, {0.1, 0.1, 0.5});
  auto range = CGAL::make_range(polyhedron.points_begin(), polyhedron.points_end());
  const std::vector<Epick::Point_3> before(range.begin(), range.end());
  const Embedding corners(domain, range);
  for(Point& p : points)
    p = p + Kernel::Vector_3(1, 2, 3);
  corners.put_points(range);
  CHECK(corners.outcome() && corners.size() == 4);
  std::size_t k = 0;
  for(const Epick::Point_3& p : range)
    CHECK_AT_MOST(CGAL::squared_distance(p, before[k++] + Epick::Vector_3(1, 2, 3)), 1e-28);

  std::vector<Epick::Weighted_point_3> spheres;
  for(const Epick::Point_3& p : before)
    spheres.emplace_back(p, 0.25 + p.x());
  corners.put_points(spheres);
  for(std::size_t i = 0; i < spheres.size(); ++i)
  {
    CHECK_AT_MOST(
      CGAL::squared_distance(spheres[i].point(), before[i] + Epick::Vector_3(1, 2, 3)), 1e-28);
    CHECK(spheres[i].weight() == 0.25 + before[i].x());
  }
}

template <typename Simplices>
void check_refused(const std::string& name, Status status, const std::string& subject,
                   const std::vector<Point>& vertices, const Simplices& simplices,
                   const std::vector<Point>& probes)
{
  test_case() = name;
  std::vector<Point> points = vertices;
  const Tetrahedron_soup_domain<std::vector<Point>, Simplices> domain(points, simplices);
  const Embedding embedding(domain, probes);
  CHECK(embedding.outcome().status == status);
  CHECK(embedding.outcome().message.find(subject) == 0);
  CHECK(embedding.size() == 0);
}

void test_failures()
{
  using Simplices = std::vector<std::vector<int>>;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  const Simplices good = {{0, 1, 2, 3}};
  const std::vector<Point> probe = {{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}};

  check_refused("no points in the complex", Status::no_tetrahedron, "", {}, Simplices(), probe);
  check_refused("no tetrahedra", Status::no_tetrahedron, "", points, Simplices(), probe);
  check_refused("flat", Status::no_tetrahedron, "", points, Simplices{{0, 1, 2, 4}}, probe);
  check_refused("one point", Status::no_tetrahedron, "", std::vector<Point>(4, Point(1, 2, 3)),
                good, probe);
  check_refused("triangle", Status::not_a_simplex, "vertex 0 ", points,
                Simplices{{0, 1, 2, 3}, {0, 1, 2}}, probe);
  check_refused("corner twice", Status::not_a_simplex, "vertex 1 ", points,
                Simplices{{0, 2, 3, 4}, {1, 2, 2, 3}}, probe);
  check_refused("no such corner", Status::not_a_simplex, "vertex 1 ", points,
                Simplices{{0, 2, 3, 4}, {1, 2, 3, 17}}, probe);
  for(double bad : {nan, infinity, -infinity})
  {
    std::vector<Point> bad_points = points, bad_probe = probe;
    bad_points[4] = Point(0, bad, 0);
    bad_probe[1] = Point(0, 0, bad);
    check_refused("point", Status::non_finite_point, "point 1 ", points, good, bad_probe);
    check_refused("vertex", Status::non_finite_point, "vertex 4 ", bad_points,
                  Simplices{{0, 1, 2, 3}, {1, 2, 3, 4}}, probe);
    const Tetrahedron_soup_domain<std::vector<Point>, Simplices> isolated(bad_points, good);
    CHECK(Embedding(isolated, probe).outcome()); // not a corner of a tetrahedron
  }
  check_refused("far", Status::non_finite_point, "point 0 ", points, good, {{1e200, 0, 0}});

  test_case() = "no points";
  std::vector<Point> vertices = points;
  const Tetrahedron_soup_domain<std::vector<Point>, Simplices> domain(vertices, good);
  const Embedding embedding(domain, std::vector<Point>());
  CHECK(embedding.outcome() && embedding.size() == 0);
  bool is_refused = false;
  try { embedding.position(0); }
  catch(const std::logic_error&) { is_refused = true; }
  CHECK(is_refused);

  // far, but not too far
  const Embedding far(domain, std::vector<Point>{{1e90, 0, 0}, {-1e90, 1e90, 0}});
  CHECK(far.outcome() && far.size() == 2);
  CHECK_AT_MOST(std::abs(far.distance(0) / 1e90 - 1), 1e-12);
  CHECK_AT_MOST((vector(far.position(1)) - Vector3d(-1e90, 1e90, 0)).norm(), 1e75);
}

int main()
{
  test_ranges();
  test_flat_tetrahedra();
  test_far_flat_tetrahedra();
  test_triangulations();
  test_deformation();
  test_failures();
  return checks_result();
}
