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

// Edge weights: identities, degenerate simplices and polygons, weights of a user, and conformance.

#include "include/check.h"
#include "include/conformance.h"
#include "include/dense_algebra.h"
#include "include/domains.h"

#include <CGAL/ARAP_deformation/Chosen_edge_weight.h>
#include <CGAL/ARAP_deformation/Edge_map_weight.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/conformance/check_deformation_traits.h>
#include <CGAL/ARAP_deformation/conformance/check_edge_weight.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/internal/energy/weighted_edge_sets.h>
#include <CGAL/ARAP_deformation_traits.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// Numbers of corners and weights that an int does not hold are refused before they are allocated.
namespace large_regions {

using namespace CGAL::ARAP::internal;

template <typename Function>
void check_refused(const Function& f)
{
  std::string message;
  try { f(); }
  catch(const std::length_error& error) { message = error.what(); }
  CHECK(message.rfind("CGAL::ARAP: ", 0) == 0);
}

void test_all()
{
  test_case() = "regions that are too large";
  CHECK(to_index(2147483647) == 2147483647);
  check_refused([] { to_index(2147483648u); });
  Array<int> sizes(3, 0);
  sizes[1] = 3;
  sizes[2] = 2147483644;
  add_up(sizes);
  CHECK(sizes[1] == 3 && sizes[2] == 2147483647);
  sizes[1] = 1;
  check_refused([&] { add_up(sizes); });
  Region region; // of polygons with a thousand million weights each
  region.first_corner = Array<int>();
  for(int corner : {0, 45000, 90000, 135000})
    region.first_corner.push_back(corner);
  region.corners = Array<int>(135000);
  check_refused([&] {
    weighted_simplices(Edge_weight_model_of<CGAL::ARAP::Clamped_cotangent_weight>(
                         CGAL::ARAP::Clamped_cotangent_weight()), region);
  });
}

} // namespace large_regions

// Edge weights: the identity with the area, the models against each other and against angles.
namespace simplices {

using namespace CGAL::ARAP;

using Triangle = std::array<Coordinates, 3>;

Eigen::Vector3d vector(const Coordinates& c) { return {c[0], c[1], c[2]}; }

// For a linear map D of the plane of a triangle, sum w ||D e||^2 = area ||D||_F^2.
void check_area_identity(const Triangle& t, const Eigen::Matrix3d& map)
{
  const Eigen::Vector3d p[3] = {vector(t[0]), vector(t[1]), vector(t[2])};
  const auto w = Cotangent_weight().simplex_weights(t);
  const double sum = w[0] * (map * (p[0] - p[1])).squaredNorm() +
                     w[1] * (map * (p[0] - p[2])).squaredNorm() +
                     w[2] * (map * (p[1] - p[2])).squaredNorm();

  const Eigen::Vector3d u = (p[1] - p[0]).normalized();
  const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
  const Eigen::Vector3d v = normal.normalized().cross(u);
  const double area = normal.norm() / 2;
  const double norm = (map * u).squaredNorm() + (map * v).squaredNorm();
  CHECK_AT_MOST(std::abs(sum - area * norm), 1e-11 * area * map.squaredNorm());
}

template <std::size_t N>
bool are_finite(const std::array<double, N>& weights)
{
  return std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w); });
}

// Simplices that are squeezed until nothing is left, of any size: the weights are finite, at most
// 10^6 units and those of a regular simplex, and of no negative energy.
template <int N>
void test_degenerate_simplices()
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> entry(-1, 1);
  int number_of_bounded = 0;
  for(int k = 0; k < 4000; ++k)
  {
    const double size = std::pow(10.0, k % 50 == 7 ? -160 : (k % 5 - 2) * 6);
    std::array<Coordinates, N> simplex;
    for(Coordinates& p : simplex)
      p = {entry(random), entry(random), entry(random)};
    const int squeezed = k / 5 % N; // coordinates, and of what is left one corner goes to another
    const double factor = k % 3 == 0 ? 0 : std::pow(10.0, -(k % 17));
    if(k % 2 == 0)
      simplex[1] = simplex[0];
    for(Coordinates& p : simplex)
      for(int c = 0; c < 3; ++c)
        p[c] *= size * (c < squeezed ? factor : 1);

    const auto weights = Cotangent_weight().simplex_weights(simplex);
    Eigen::Matrix<double, N, N> laplacian = Eigen::Matrix<double, N, N>::Zero();
    double longest = 0, largest = 0;
    std::size_t edge = 0;
    for(int a = 0; a < N; ++a)
      for(int b = a + 1; b < N; ++b)
      {
        const double w = weights[edge++];
        CHECK(std::isfinite(w));
        laplacian(a, a) += w;
        laplacian(b, b) += w;
        laplacian(a, b) = laplacian(b, a) = -w;
        longest = larger(longest, (vector(simplex[a]) - vector(simplex[b])).norm());
        largest = larger(largest, std::abs(w));
      }
    const double unit = N == 3 ? 1 : longest;
    CHECK_AT_MOST(largest, (1e6 + 0.3) * unit);
    CHECK(largest > 0 || (N == 4 && longest == 0));
    // no eigenvalue is below -1e-9 of the largest weight
    laplacian.diagonal().array() += largest > 0 ? 1e-9 * largest : 1;
    CHECK(is_positive_definite(laplacian));
    number_of_bounded += largest > 0.999e6 * unit;
  }
  CHECK(number_of_bounded > 500 && number_of_bounded < 3500);
}

void test_all()
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> entry(-1, 1);
  for(int k = 0; k < 1000; ++k)
  {
    Triangle t;
    for(auto& p : t)
      p = {entry(random), entry(random), entry(random)};
    const Eigen::Matrix3d map = Eigen::Matrix3d::NullaryExpr([&] { return entry(random); });
    check_area_identity(t, map);
    for(const Edge_set set : {Edge_set::star, Edge_set::simplex})
    {
      const double sum = entry(random);
      CHECK(Cotangent_weight().edge_weight(set, 0, 1, sum) == sum);
      CHECK(Clamped_cotangent_weight().edge_weight(set, 0, 1, sum) == (std::max)(sum, 0.0));
      CHECK(Uniform_weight().edge_weight(set, 0, 1, sum) == 1);
      CHECK(Safe_cotangent_weight().edge_weight(set, 0, 1, sum) ==
            (set == Edge_set::star ? (std::max)(sum, 0.0) : sum));
    }
  }

  // the edges come as (0,1), (0,2), (1,2): half the cotangents at the vertices 2, 1, 0
  const Triangle right_angle = {{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}};
  const auto w = Cotangent_weight().simplex_weights(right_angle);
  CHECK_AT_MOST(std::abs(w[0] - 0.25), 1e-15);
  CHECK_AT_MOST(std::abs(w[1] - 1), 1e-15);
  CHECK_AT_MOST(std::abs(w[2]), 1e-15);

  // nothing that is not a number is hidden by the clamping
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(Clamped_cotangent_weight().edge_weight(Edge_set::star, 0, 1, nan)));
  CHECK(std::isnan(Safe_cotangent_weight().edge_weight(Edge_set::star, 0, 1, nan)));
  for(double bad : {nan, std::numeric_limits<double>::infinity(), 1e200})
  {
    const Triangle triangle = {{{0, 0, 0}, {1, 0, bad}, {2, 1, 0}}};
    const std::array<Coordinates, 4> tetrahedron = {
      {{0, 0, 0}, {1, 0, bad}, {2, 1, 0}, {0, 0, 1}}};
    CHECK(!are_finite(Cotangent_weight().simplex_weights(triangle)));
    CHECK(!are_finite(Cotangent_weight().simplex_weights(tetrahedron)));
  }
  test_degenerate_simplices<3>();
  test_degenerate_simplices<4>();
}

} // namespace simplices

// Polygons: their weights are the same from whichever corner, and have the identity with the area.
namespace polygons {

using CGAL::ARAP::Cotangent_weight;
using CGAL::ARAP::internal::Region;

// one polygon, with the weights of all pairs of its corners
template <typename Weight = Cotangent_weight>
CGAL::ARAP::internal::Simplices weighted_polygon(const std::vector<Eigen::Vector3d>& points)
{
  Region region;
  for(const auto& p : points)
  {
    region.corners.push_back(region.number_of_vertices());
    region.indices.push_back(region.rest.size());
    region.rest.push_back({p.x(), p.y(), p.z()});
  }
  region.first_corner.push_back(region.number_of_vertices());
  const CGAL::ARAP::internal::Edge_weight_model_of<Weight> model{Weight()};
  return CGAL::ARAP::internal::weighted_simplices(model, region);
}

std::vector<double> weights_of(const std::vector<Eigen::Vector3d>& points)
{
  return weighted_polygon(points).weights;
}

std::size_t pair_number(std::size_t n, std::size_t a, std::size_t b)
{
  return a > b ? pair_number(n, b, a) : a * (2 * n - a - 1) / 2 + b - a - 1;
}

// The weights from another corner on, every `step`-th one, and the other way round, are the same.
void check_turned(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& weights,
                  std::size_t step, double tolerance)
{
  const std::size_t n = points.size();
  for(std::size_t shift = 1; shift < n; shift += step)
    for(bool is_reversed : {false, true})
    {
      std::vector<Eigen::Vector3d> other = points;
      std::rotate(other.begin(), other.begin() + std::ptrdiff_t(shift), other.end());
      if(is_reversed)
        std::reverse(other.begin(), other.end());
      const std::vector<double> turned = weights_of(other);
      const auto place = [&](std::size_t a) {
        return is_reversed ? (2 * n - 1 - a + shift) % n : (a + n - shift) % n;
      };
      for(std::size_t a = 0; a < n; ++a)
        for(std::size_t b = a + 1; b < n; ++b)
          CHECK_AT_MOST(std::abs(weights[pair_number(n, a, b)] -
                                 turned[pair_number(n, place(a), place(b))]), tolerance);
    }
}

// The size makes no difference, also beside a triangle without an area.
void test_size_of_polygon()
{
  test_case() = "polygons of any size";
  std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  const std::vector<double> weights = weights_of(points);
  for(const int exponent : {-330, 660})
  {
    for(Eigen::Vector3d& p : points)
      p *= std::ldexp(1., exponent);
    const std::vector<double> same = weights_of(points);
    for(std::size_t k = 0; k < weights.size(); ++k)
      CHECK_AT_MOST(std::abs(same[k] - weights[k]), 1e-12);
  }
}

void test_one_polygon()
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for(std::size_t n : {3, 4, 5, 6, 9, 40, 100})
  {
    test_case() = "a polygon of " + std::to_string(n) + " corners";
    // in space
    std::vector<Eigen::Vector3d> points;
    for(std::size_t k = 0; k < n; ++k)
      points.emplace_back(std::cos(6.28 * k / n), std::sin(6.28 * k / n), unit(random));
    const std::vector<double> weights = weights_of(points);
    check_turned(points, weights, 1 + n / 7, 1e-11);

    // flat and convex: sum w ||D e||^2 = area ||D||_F^2, as for each of its triangulations
    for(auto& p : points)
      p = {2 * p.x(), p.y() + 0.3 * p.x(), 0};
    auto polygon = weighted_polygon(points);
    const std::vector<double> flat = polygon.weights;
    const Eigen::Matrix2d map = Eigen::Matrix2d::NullaryExpr([&] { return unit(random); });
    double sum = 0, area = 0;
    for(std::size_t a = 0; a < n; ++a)
    {
      const Eigen::Vector3d& p = points[a];
      const Eigen::Vector3d& q = points[(a + 1) % n];
      area += (p.x() * q.y() - p.y() * q.x()) / 2;
      for(std::size_t b = a + 1; b < n; ++b)
        sum += flat[pair_number(n, a, b)] *
               (map * (points[a] - points[b]).head<2>()).squaredNorm();
    }
    CHECK_AT_MOST(std::abs(sum - area * map.squaredNorm()), 1e-11 * sum);

    // a sum of squares, up to rounding, until something is taken from a diagonal
    CHECK(polygon.are_sums_of_squares());
    polygon.weights[pair_number(n, 0, 2)] -= 1000;
    CHECK(!polygon.are_sums_of_squares());
  }

  // the energy of a triangle is not negative as long as the sum of products of its weights is not
  auto triangle = weighted_polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  triangle.weights[0] = triangle.weights[1] = 1;
  triangle.weights[2] = -0.5;
  CHECK(triangle.are_sums_of_squares());
  triangle.weights[2] -= 1e-6;
  CHECK(!triangle.are_sums_of_squares());

  // a rectangle has no weight on its diagonals
  const std::vector<double> rectangle = weights_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
  CHECK_AT_MOST(std::abs(rectangle[pair_number(4, 0, 2)]), 1e-15);
  CHECK_AT_MOST(std::abs(rectangle[pair_number(4, 1, 3)]), 1e-15);
}

double largest_of(const std::vector<double>& weights)
{
  return Eigen::Map<const Eigen::VectorXd>(weights.data(), Eigen::Index(weights.size()))
    .lpNorm<Eigen::Infinity>();
}

// Five of eight corners, or all, are next to being on a line. What little area their triangles have
// must not decide at once, by a rounding error, whether they are as stiff as such needles are.
void test_corners_next_to_a_line()
{
  for(double height : {0.0, 1.0}) // of the other three corners
  {
    std::vector<double> last;
    int number_of_shapes = 0;
    for(double h = 1e-8; h < 1e-5; h *= 1.002)
    {
      test_case() = "corners off a line by 1e-8 * 1.002^" + std::to_string(number_of_shapes);
      const std::vector<Eigen::Vector3d> points = {
        {0, 0, 0}, {1, -h, 0}, {2, -h, 0}, {3, h, 0}, {4, 0, 0},
        {5, 2 * height, height}, {2, 3 * height, 0}, {-1, 2 * height, 0}};
      const std::vector<double> weights = weights_of(points);
      const double largest = largest_of(weights);
      for(std::size_t k = 0; k < last.size(); ++k)
        CHECK_AT_MOST(std::abs(weights[k] - last[k]), 0.02 * largest);
      if(number_of_shapes++ % 50 == 0)
        check_turned(points, weights, 1, 1e-8 * largest);
      last = weights;
    }
  }

  test_case() = "corners on a line";
  std::vector<Eigen::Vector3d> points;
  for(double t : {0.0, 0.3, 1.1, 2.0, 1.7, 0.9, 0.1})
    points.push_back(t * Eigen::Vector3d(0.3, -1, 0.7) + Eigen::Vector3d(1, 2, 3));
  const std::vector<double> weights = weights_of(points);
  check_turned(points, weights, 1, 1e-6 * largest_of(weights));
  for(std::size_t a = 0; a < points.size(); ++a) // no corner is loose
  {
    double sum = 0;
    for(std::size_t b = 0; b < points.size(); ++b)
      if(b != a)
        sum += std::abs(weights[pair_number(points.size(), a, b)]);
    CHECK(sum > 0.01);
  }
}

// infinite in triangles without area
struct Textbook_weight : Cotangent_weight
{
  std::array<double, 3>
  simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>& triangle) const
  {
    const auto corner = [&](std::size_t k) { return Eigen::Vector3d(triangle[k].data()); };
    const Eigen::Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0), c = b - a;
    const double quadruple_area = 2 * a.cross(b).norm();
    return {b.dot(c) / quadruple_area, -a.dot(c) / quadruple_area, a.dot(b) / quadruple_area};
  }
};

// A corner on a side, as of a larger face beside two smaller ones, makes a triangle without area.
void test_corner_on_a_side()
{
  test_case() = "a corner on a side";
  const std::vector<Eigen::Vector3d> points = {
    {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  const std::vector<double> weights = weighted_polygon<Textbook_weight>(points).weights;
  const std::vector<double> expected = weights_of(points);
  for(std::size_t k = 0; k < weights.size(); ++k)
    CHECK_AT_MOST(std::abs(weights[k] - expected[k]), 1e-14);
}

// Weights that a class inherits from the cotangents are known to be those of shapes.
void test_inheritance()
{
  struct Other : Cotangent_weight
  {
    std::array<double, 3> simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>&) const
    {
      return {1, -1, 1};
    }
  };
  using CGAL::ARAP::internal::Edge_weight_model_of;
  CHECK(Edge_weight_model_of<Cotangent_weight>({}).are_of_shapes());
  CHECK(Edge_weight_model_of<CGAL::ARAP::Safe_cotangent_weight>({}).are_of_shapes());
  CHECK(Edge_weight_model_of<CGAL::ARAP::Clamped_cotangent_weight>({}).are_of_shapes());
  CHECK(!Edge_weight_model_of<CGAL::ARAP::Uniform_weight>({}).are_of_shapes());
  CHECK(!Edge_weight_model_of<Other>({}).are_of_shapes());
}

// one function for triangles and tetrahedra, whose body compiles for points only
struct Generic_weight
{
  template <typename Corners>
  auto simplex_weights(const Corners& corners) const
  {
    static_assert(std::is_same_v<typename Corners::value_type, CGAL::ARAP::Coordinates>);
    return Cotangent_weight().simplex_weights(corners);
  }
  double edge_weight(CGAL::ARAP::Edge_set, std::size_t, std::size_t, double sum) const
  {
    return sum;
  }
};

void test_generic_weight()
{
  test_case() = "one function for all simplices";
  const CGAL::ARAP::internal::Edge_weight_model_of<Generic_weight> generic({});
  const CGAL::ARAP::internal::Edge_weight_model_of<Cotangent_weight> expected({});
  const std::array<CGAL::ARAP::Coordinates, 3> triangle = {{{0, 0, 0}, {5, 1, 2}, {2, 1, 0}}};
  const std::array<CGAL::ARAP::Coordinates, 4> tetrahedron = {
    {{0, 0, 0}, {1, 0, 2}, {2, 1, 0}, {0, 0, 1}}};
  CHECK(generic.triangle(triangle, {0, 1, 2}) == expected.triangle(triangle, {0, 1, 2}));
  CHECK(generic.tetrahedron(tetrahedron) == expected.tetrahedron(tetrahedron));
}

void test_all()
{
  test_size_of_polygon();
  test_one_polygon();
  test_inheritance();
  test_generic_weight();
  test_corners_next_to_a_line();
  test_corner_on_a_side();
}

} // namespace polygons

// Weights that the user gives for each edge: those of cotangents give what cotangents give, on
// meshes with and without indices and on tetrahedra, and an edge without a weight does not hold.
namespace edge_map {

using CGAL::ARAP::Edge_map_weight;
using CGAL::ARAP::Status;
using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, Edge_map_weight>;

// for each edge the sum of its weights in all simplices, as a star has it
template <std::size_t N>
Edge_map_weight star_weights(const std::vector<Eigen::Vector3d>& points,
                             const std::vector<std::array<std::size_t, N>>& simplices)
{
  std::map<std::pair<std::size_t, std::size_t>, double> sums;
  for(const auto& simplex : simplices)
  {
    std::array<CGAL::ARAP::Coordinates, N> corners;
    for(std::size_t k = 0; k < N; ++k)
      corners[k] = {points[simplex[k]].x(), points[simplex[k]].y(), points[simplex[k]].z()};
    const auto weights = CGAL::ARAP::Cotangent_weight().simplex_weights(corners);
    auto w = weights.begin();
    for(std::size_t a = 0; a < N; ++a)
      for(std::size_t b = a + 1; b < N; ++b)
        sums[std::minmax(simplex[a], simplex[b])] += *w++;
  }
  Edge_map_weight weight;
  for(const auto& [edge, sum] : sums)
    weight.set_weight(edge.second, edge.first, sum < 0 ? 0 : sum); // in either direction
  return weight;
}

template <typename Domain, typename Vertices>
std::vector<double> energies(const Domain& domain, const Vertices& vertices, const Scenario& s,
                             const Edge_map_weight& weight)
{
  CGAL::ARAP_deformation<Domain, Traits> deformation(domain, Traits({}, weight));
  CHECK(deformation.set_options(options_for(Cell_scheme::spokes())));
  prepare(deformation, s, vertices);
  const CGAL::ARAP::Report report = deformation.deform(10, 0);
  CHECK(report);
  return report.energy;
}

// The energy is not known where other weights have been taken, nor in a state from before.
void test_energy()
{
  test_case() = "energy after a change of weights";
  const Shape shape = shapes()[2];
  Edge_map_weight weight = star_weights(shape.points, shape.triangles);
  Mesh mesh = make_mesh<Mesh>(shape);
  CGAL::ARAP_deformation<Mesh, Traits> d(mesh, Traits({}, weight));
  prepare(d, scenario(shape), all_vertices(mesh));
  CHECK(d.deform() && d.energy() > 0);
  const auto state = d.state();
  CHECK(d.restore(state) && d.energy() > 0);
  for(const auto& [a, b, c] : shape.triangles)
    weight.set_weight(a, b, 10);
  CHECK(d.preprocess() && std::isnan(d.energy()));
  CHECK(d.deform() && d.energy() > 0);
  CHECK(d.restore(state) && std::isnan(d.energy()));

  // a move leaves the weights with the old object, too
  const auto [a, b, c] = shape.triangles[0];
  const Edge_map_weight moved = std::move(weight);
  weight.set_weight(a, b, 3);
  CHECK(moved.edge_weight(CGAL::ARAP::Edge_set::star, a, b, 0) == 3);
}

void compare(const std::vector<double>& a, const std::vector<double>& b)
{
  CHECK(a.size() == b.size());
  for(std::size_t k = 0; k < a.size() && k < b.size(); ++k)
    CHECK_AT_MOST(std::abs(a[k] - b[k]), 1e-10 * b[0] + 1e-20); // it may be zero
}

// the same from a property map of the mesh's edges
template <typename Mesh_>
void test_mesh(const Shape& shape)
{
  const Scenario s = scenario(shape);
  const std::vector<double> expected =
    reference<2>(shape.points, shape.triangles, s, Cell_scheme::spokes()).energy;
  Mesh_ mesh = make_mesh<Mesh_>(shape);
  const auto all = all_vertices(mesh);
  std::map<typename boost::graph_traits<Mesh_>::vertex_descriptor, std::size_t> numbers;
  for(std::size_t k = 0; k < all.size(); ++k)
    numbers[all[k]] = k;
  const Edge_map_weight by_index = star_weights(shape.points, shape.triangles);
  std::map<typename boost::graph_traits<Mesh_>::edge_descriptor, double> weights;
  for(auto e : edges(mesh))
    weights[e] = by_index.edge_weight(CGAL::ARAP::Edge_set::star, numbers[source(e, mesh)],
                                      numbers[target(e, mesh)], 0);
  compare(energies(CGAL::ARAP::Face_graph_domain<Mesh_>(mesh), all, s,
                   CGAL::ARAP::make_edge_map_weight(mesh,
                                                    boost::make_assoc_property_map(weights))),
          expected);
}

void test_all()
{
  for(const Shape& shape : shapes())
  {
    test_case() = shape.name;
    test_mesh<Mesh>(shape);
#ifdef CGAL_ARAP_TEST_ALL // dear to compile
    test_mesh<CGAL::Polyhedron_3<Kernel>>(shape);
#endif
  }

  test_case() = "tetrahedra";
  const Block solid = block(4, 2, 2);
  const Scenario s = scenario(solid);
  std::vector<Point> points = points_of(solid.points);
  using Soup = CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>, decltype(solid.tetrahedra)>;
  compare(energies(Soup(points, solid.tetrahedra), numbers(points.size()), s,
                   star_weights(solid.points, solid.tetrahedra)),
          reference<3>(solid.points, solid.tetrahedra, s, Cell_scheme::spokes()).energy);

  test_case() = "edges without a weight";
  points = points_of(solid.points);
  CGAL::ARAP_deformation<Soup, Traits> loose(Soup(points, solid.tetrahedra));
  prepare(loose, s, numbers(points.size()));
  const CGAL::ARAP::Report report = loose.deform();
  CHECK(report); // each free vertex is a part that nothing holds
  CHECK(report.unconstrained_components.size() ==
        std::size_t(std::count(s.selection.begin(), s.selection.end(), 1)));
}

// Parts that no edge connects, only control points in tetrahedra between them.
void test_parts()
{
  const Block solid = block(4, 2, 2);
  std::vector<Point> points;
  using Soup = CGAL::ARAP::Tetrahedron_soup_domain<std::vector<Point>, decltype(solid.tetrahedra)>;
  double least = solid.points[0].x(), most = least;
  for(const Eigen::Vector3d& p : solid.points)
  {
    least = (std::min)(least, p.x());
    most = (std::max)(most, p.x());
  }
  const auto layer = [&](std::size_t v) { // 0 to 4
    return static_cast<int>(std::lround(4 * (solid.points[v].x() - least) / (most - least)));
  };
  using Deformation = CGAL::ARAP_deformation<Soup, Traits>;
  // a deformation of all vertices, cut between layers, and the tetrahedra at the last cut
  const auto cut = [&](const std::vector<int>& cuts, std::vector<std::size_t>& between) {
    Edge_map_weight weights;
    for(std::size_t t = 0; t < solid.tetrahedra.size(); ++t)
    {
      const auto part = [&](std::size_t v) {
        return std::count_if(cuts.begin(), cuts.end(), [&](int c) { return layer(v) > c; });
      };
      const auto& corners = solid.tetrahedra[t];
      for(std::size_t v : corners)
        for(std::size_t w : corners)
        {
          if(v < w)
            weights.set_weight(v, w, part(v) == part(w));
          if(layer(v) == cuts.back() && layer(w) > cuts.back() &&
             (between.empty() || between.back() != t))
            between.push_back(t);
        }
    }
    points = points_of(solid.points);
    Deformation result(Soup(points, solid.tetrahedra), Traits({}, weights));
    CHECK(result.set_options(options_for(Cell_scheme::spokes())));
    for(std::size_t v = 0; v < points.size(); ++v)
      result.insert_roi_vertex(v);
    return result;
  };
  for(double weight : {2.0, std::numeric_limits<double>::infinity()})
  {
    const auto insert = [&](Deformation& d, std::size_t t, const std::vector<double>& coordinates) {
      const auto inserted = d.insert_control_point(t, coordinates);
      CHECK(inserted);
      CHECK(d.translate(inserted.point, Eigen::Vector3d(1, 2, 3)));
      CHECK(d.set_target_weight(inserted.point, weight));
    };
    test_case() = "control points of two components, weight " + std::to_string(weight);
    std::vector<std::size_t> between;
    Deformation halves = cut({2}, between);
    insert(halves, between.front(), {0.1, 0.2, 0.3, 0.4});
    CHECK(halves.deform().status == CGAL::ARAP::Status::no_fixed_vertex); // one for two
    CHECK(points == points_of(solid.points));
    insert(halves, between.front(), {0.4, 0.3, 0.2, 0.1});
    insert(halves, between.back(), {0.1, 0.2, 0.3, 0.4});
    const CGAL::ARAP::Report together = halves.deform(1000, 1e-12);
    CHECK(together && together.unconstrained_components.empty());
    for(std::size_t v = 0; v < points.size(); ++v)
      CHECK_AT_MOST((vector(points[v]) - solid.points[v] - Eigen::Vector3d(1, 2, 3)).norm(), 1e-6);

    test_case() = "two loose components beside a fixed one, weight " + std::to_string(weight);
    between.clear();
    Deformation thirds = cut({0, 2}, between);
    for(std::size_t v = 0; v < points.size(); ++v)
      if(layer(v) == 0)
      {
        thirds.insert_control_vertex(v);
        break;
      }
    insert(thirds, between.front(), {0.1, 0.2, 0.3, 0.4});
    const CGAL::ARAP::Report loose_ones = thirds.deform();
    if(weight < 3)
      CHECK(loose_ones && loose_ones.unconstrained_components.size() == 2);
    else // its target cannot be met where they stay
      CHECK(loose_ones.status == CGAL::ARAP::Status::no_fixed_vertex);
    CHECK(points == points_of(solid.points));
  }
}

} // namespace edge_map

// Each edge weight that ships conforms to the concept, and broken ones are caught.
namespace conformance {

using namespace CGAL::ARAP;

using Triangle = std::array<Coordinates, 3>;

// weights for triangles only, looked up
struct Looked_up_weight
{
  std::array<double, 3> simplex_weights(const Triangle&) const { return {1, 1, 1}; }
  double edge_weight(Edge_set, std::size_t i, std::size_t j, double) const
  {
    return weights.at(std::minmax(i, j));
  }
  std::map<std::pair<std::size_t, std::size_t>, double> weights;
};

struct Depends_on_order : Cotangent_weight
{
  using Cotangent_weight::simplex_weights;
  std::array<double, 3> simplex_weights(const Triangle& t) const
  {
    std::array<double, 3> w = Cotangent_weight::simplex_weights(t);
    w[0] *= 1.001;
    return w;
  }
};

// the edges (0, 3) and (1, 2) are exchanged
struct Wrong_edges_of_tetrahedra : Cotangent_weight
{
  using Cotangent_weight::simplex_weights;
  std::array<double, 6> simplex_weights(const std::array<Coordinates, 4>& t) const
  {
    std::array<double, 6> w = Cotangent_weight::simplex_weights(t);
    std::swap(w[2], w[3]);
    return w;
  }
};

struct Never_finite : Cotangent_weight
{
  std::array<double, 3> simplex_weights(const Triangle&) const
  {
    return {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  }
};

struct Counts_calls : Cotangent_weight
{
  std::array<double, 3> simplex_weights(const Triangle&) const
  {
    const double n = ++calls;
    return {n, n, n};
  }
  mutable int calls = 0;
};

struct Copies_are_doubled : Cotangent_weight
{
  Copies_are_doubled() = default;
  Copies_are_doubled(const Copies_are_doubled& other) : factor(2 * other.factor) {}
  Copies_are_doubled& operator=(const Copies_are_doubled&) = default;
  double edge_weight(Edge_set, std::size_t, std::size_t, double sum) const { return factor * sum; }
  double factor = 1;
};

struct Divides : Cotangent_weight
{
  double edge_weight(Edge_set, std::size_t, std::size_t, double sum) const { return 1 / sum; }
};

struct Depends_on_direction : Cotangent_weight
{
  double edge_weight(Edge_set, std::size_t i, std::size_t j, double sum) const
  {
    return i < j ? sum : 2 * sum;
  }
};

struct Sparse_solver_that_refuses : Multifrontal_cholesky_solver
{
  bool factorize(const Sparse_matrix&) { return false; }
};

// A shipped weight conforms, and so does the one that has its name, whose values are the same.
template <typename Weight>
void check_shipped(const Weight& weight, const char* name)
{
  test_case() = name;
  const Chosen_edge_weight chosen(name);
  CHECK_CONFORMS(check_edge_weight(weight));
  CHECK_CONFORMS(check_edge_weight(chosen));
  const std::array<Coordinates, 4> tetrahedron = {{{0, 0, 0}, {1, 0, 2}, {2, 1, 0}, {0, 0, 1}}};
  const Triangle triangle = {{{0, 0, 0}, {5, 1, 2}, {2, 1, 0}}}; // with an obtuse angle
  CHECK(chosen.simplex_weights(tetrahedron) == weight.simplex_weights(tetrahedron));
  CHECK(chosen.simplex_weights(triangle) == weight.simplex_weights(triangle));
  for(Edge_set set : {Edge_set::star, Edge_set::simplex})
    for(double sum : {-2.0, 3.0})
      CHECK(chosen.edge_weight(set, 0, 1, sum) == weight.edge_weight(set, 0, 1, sum));
}

void test_all()
{
  check_shipped(Safe_cotangent_weight(), "safe_cotangent");
  check_shipped(Cotangent_weight(), "cotangent");
  check_shipped(Clamped_cotangent_weight(), "clamped_cotangent");
  check_shipped(Uniform_weight(), "uniform");
  test_case() = "weights that are not known";
  try
  {
    Chosen_edge_weight("Uniform");
    CHECK(!"a name that is not known was taken");
  }
  catch(const std::invalid_argument& error)
  {
    CHECK(std::string(error.what()).find("weights 'Uniform' is not known; use one of") == 0);
  }
  test_case() = "conformance";
  Edge_map_weight edge_map;
  edge_map.set_weight(0, 1, 1.5);
  CHECK_CONFORMS(check_edge_weight(edge_map));
  CHECK_CONFORMS(check_edge_weight(Looked_up_weight{{{{2, 7}, 1.5}}}, {{2, 7}, {7, 2}}));

  CHECK_CAUGHT(check_edge_weight(Looked_up_weight()), "threw an exception");
  CHECK_CAUGHT(check_edge_weight(Depends_on_order()), "order of the vertices of a triangle");
  CHECK_CAUGHT(check_edge_weight(Wrong_edges_of_tetrahedra()),
               "order of the vertices of a tetrahedron");
  CHECK_CAUGHT(check_edge_weight(Never_finite()), "not finite in a well-shaped triangle");
  CHECK_CAUGHT(check_edge_weight(Counts_calls()), "asked for again");
  CHECK_CAUGHT(check_edge_weight(Copies_are_doubled()), "of a copy");
  CHECK_CAUGHT(check_edge_weight(Divides()), "not finite for a finite sum");
  CHECK_CAUGHT(check_edge_weight(Depends_on_direction()), "depends on which vertex is first");

  // what a traits object hands out
  CHECK_CONFORMS(check_deformation_traits(CGAL::ARAP_deformation_traits<>()));
  using Wrong_traits = CGAL::ARAP_deformation_traits<Sparse_solver_that_refuses, Divides>;
  CHECK_CAUGHT(check_deformation_traits(Wrong_traits()), "sparse_solver_object(): factorize()");
  CHECK_CAUGHT(check_deformation_traits(Wrong_traits()), "edge_weight_object(): edge_weight()");
}

} // namespace conformance

int main()
{
  large_regions::test_all();
  simplices::test_all();
  polygons::test_all();
  edge_map::test_all();
  edge_map::test_parts();
  edge_map::test_energy();
  conformance::test_all();
  return checks_result();
}
