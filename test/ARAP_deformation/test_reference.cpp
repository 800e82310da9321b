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

// Energies, iterates and initial guesses against dense computations that share nothing with the
// package, on triangles, polygons and tetrahedra.

#include "include/check.h"
#include "include/dense_reference.h"
#include "include/domains.h"
#include "include/length.h"
#include "include/shapes.h"
#include "include/Single_precision_solver.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/internal/energy/Simplex_energy.h>
#include <CGAL/ARAP_deformation_traits.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

// Iterates and energies against the dense reference: triangles, polygons and tetrahedra, whole
// shapes and regions of interest, each cell scheme with each weight, hard and soft targets.
namespace iterates {

using Simplices = std::vector<Dense_reference::Simplex>;

template <int Dimension, typename Weight>
void compare(const std::vector<Eigen::Vector3d>& rest, const Simplices& simplices,
             double diameter, const Scenario& s, Cell_scheme cells,
             Dense_reference::Cells dense_cells, Dense_reference::Weights dense_weights,
             bool is_soft)
{
  static Every_nth is_run(5);
  if(!is_run())
    return;
  using Domain = CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices>;
  using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, Weight>;
  std::vector<Point> points = points_of(rest);
  CGAL::ARAP_deformation<Domain, Traits> deformation(Domain(points, simplices));
  CHECK(deformation.set_options(options_for(cells)));
  prepare(deformation, s, numbers(points.size()));

  // of the handles every other one; what is not in the region remains fixed
  std::vector<std::size_t> soft;
  std::vector<int> selection = s.selection;
  std::vector<Eigen::Vector3d> x = s.targets;
  const auto weight = [](std::size_t v) { return 0.1 + double(v % 4); };
  int number_of_handles = 0;
  for(std::size_t v = 0; v < rest.size(); ++v)
    if(is_soft && selection[v] == 2 && number_of_handles++ % 2 == 0)
    {
      soft.push_back(v);
      selection[v] = 1;
      x[v] = rest[v];
      CHECK(deformation.set_target_weight(v, weight(v)));
    }
  CHECK(is_soft == !soft.empty());
  Dense_reference reference(rest, simplices, Dimension, selection, dense_cells, dense_weights);
  for(std::size_t v : soft)
    reference.add_soft_position(v, weight(v), s.targets[v]);
  compare_iterates(deformation, points, reference, x, 8, diameter);
}

template <int Dimension>
void compare_all(const std::string& name, const std::vector<Eigen::Vector3d>& points,
                 const Simplices& simplices, double diameter)
{
  const std::pair<Cell_scheme, Dense_reference::Cells> schemes[] = {
    {Cell_scheme::spokes(), Dense_reference::SPOKES},
    {Cell_scheme::spokes_and_rims(), Dense_reference::SPOKES_AND_RIMS},
    {Cell_scheme::elements(), Dense_reference::ELEMENTS}};
  const Scenario part = scenario(Shape{"", points, {}}, 0.6);
  const std::pair<Scenario, bool> cases[] = {
    {part, false}, {part, true}, {in_whole(part), false}, {in_whole(part), true}};
  for(const auto& [s, is_soft] : cases)
    for(const auto& [cells, dense_cells] : schemes)
    {
      test_case() = name + ", cells " + std::to_string(dense_cells);
      compare<Dimension, CGAL::ARAP::Safe_cotangent_weight>(
        points, simplices, diameter, s, cells, dense_cells, Dense_reference::SAFE, is_soft);
      compare<Dimension, CGAL::ARAP::Cotangent_weight>(
        points, simplices, diameter, s, cells, dense_cells, Dense_reference::COTANGENT, is_soft);
      compare<Dimension, CGAL::ARAP::Uniform_weight>(
        points, simplices, diameter, s, cells, dense_cells, Dense_reference::UNIFORM, is_soft);
      if(dense_cells == Dense_reference::SPOKES) // in a simplex a weight of zero may cut it off
        compare<Dimension, CGAL::ARAP::Clamped_cotangent_weight>(
          points, simplices, diameter, s, cells, dense_cells, Dense_reference::CLAMPED, is_soft);
    }
}

// A fan around one free vertex: with cotangents cells may have negative energies, so that the rest
// shape is not the lowest one. No run ends there as at a minimum, nor goes back to it.
void test_negative_energies(const std::vector<Eigen::Vector3d>& rest, const Point& below)
{
  test_case() = "negative energies";
  const Simplices simplices = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}};
  using Domain = CGAL::ARAP::Simplex_soup_domain<2, std::vector<Point>, Simplices>;
  std::vector<Point> points = points_of(rest);
  using Weight = CGAL::ARAP::Cotangent_weight;
  CGAL::ARAP_deformation<Domain, CGAL::ARAP_deformation_traits<CGAL::Default, Weight>> d(
    Domain(points, simplices));
  CHECK(d.set_options(options_for(Cell_scheme::spokes())));
  d.insert_roi_vertices(numbers(points.size()));
  for(std::size_t v = 1; v < points.size(); ++v)
    d.insert_control_vertex(v);
  const CGAL::ARAP::Report from_rest = d.deform();
  CHECK(from_rest.end == CGAL::ARAP::End::minimum && from_rest.final_energy() < -0.1);
  points[0] = below;
  const double before = d.deform(0, 0).final_energy();
  CHECK(before < -0.1 && points[0] == below);
  CHECK_AT_MOST(d.deform().final_energy(), before);
}

// Right angles, whose cotangents are zero up to a rounding error of either sign: a shape that moves
// rigidly is at its minimum at once.
void test_right_angles()
{
  test_case() = "right angles";
  const Shape sheet = grid("sheet", 9, 7, [](double u, double v) {
    return Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()) *
           Eigen::Vector3d(9 * u, 7 * v, 0);
  });
  const Simplices triangles = as_polygons(sheet.triangles);
  using Domain = CGAL::ARAP::Simplex_soup_domain<2, std::vector<Point>, Simplices>;
  using Weight = CGAL::ARAP::Cotangent_weight;
  std::vector<Point> points = points_of(sheet.points);
  CGAL::ARAP_deformation<Domain, CGAL::ARAP_deformation_traits<CGAL::Default, Weight>> d(
    Domain(points, triangles));
  CHECK(d.set_options(options_for(Cell_scheme::spokes())));
  d.insert_roi_vertices(numbers(points.size()));
  for(std::size_t v : {0, 5, 44})
    d.insert_control_vertex(v);
  for(double shift : {0.0, 3.0})
  {
    for(std::size_t v : d.control_vertices())
      d.translate(v, Eigen::Vector3d(0, shift, 0));
    const CGAL::ARAP::Report report = d.deform();
    CHECK(report.end == CGAL::ARAP::End::minimum && report.iterations == 0);
  }
}

void test_all()
{
  for(const Shape& shape : shapes())
  {
    if(shape.points.size() > 180 || shape.name == "two of strip") // one moves rigidly: it is placed
      continue;
    compare_all<2>(shape.name, shape.points, as_polygons(shape.triangles), shape.diameter());
  }
  Simplices polygons;
  const Shape sheet = sheet_of_polygons(9, 8, polygons);
  compare_all<2>("polygons", sheet.points, polygons, sheet.diameter());
  test_negative_energies({{0, 0, 0}, {1.49, 0.76, 0}, {0.35, 0.47, 0}, {-0.67, -0.39, 0},
                          {-0.86, -0.92, 0}, {0.92, -1.57, 0}}, Point(-0.2, -0.2, 0));
  test_negative_energies({{0, 0, 0}, {1.37, 0.65, 0}, {0.41, 1.8, 0}, {-0.44, 0.25, 0},
                          {-0.02, -1.19, 0}, {1.43, -0.98, 0}}, Point(-0.05, 0.2, 0));
  test_right_angles();
  const Block solid = block(4, 2, 2);
  compare_all<3>("tetrahedra", solid.points, as_polygons(solid.tetrahedra), solid.diameter());
}

} // namespace iterates

// Naive Laplacian editing as the initial guess: the dense least-squares solution, not a step of
// the iteration, and a start from which the energy falls as well.
namespace initial_guess {

template <typename Solver>
void test()
{
  using Deformation =
    CGAL::ARAP_deformation<Mesh, CGAL::ARAP_deformation_traits<Solver>>;
  static Every_nth is_run(7);
  for(const Shape& shape : shapes())
    for(Cell_scheme cells : all_cell_schemes)
    {
      if(!is_run() || (shape.points.size() > 180 && !is_long_run()) ||
         shape.name == "two of strip") // one moves rigidly: it is placed
        continue;
      test_case() = shape.name;
      const Scenario s = scenario(shape, 0.5);
      const bool is_spokes = cells == Cell_scheme::spokes();
      // whatever the cells, L has the weights of stars
      Dense_reference reference(shape.points, as_polygons(shape.triangles), 2, s.selection,
                                Dense_reference::SPOKES, Dense_reference::CLAMPED);
      std::vector<Eigen::Vector3d> x = s.targets, step = s.targets;
      reference.laplacian_guess(x);
      reference.iterate(step);

      Mesh mesh = make_mesh<Mesh>(shape);
      Deformation deformation(mesh);
      CHECK(deformation.set_options(options_for(cells, CGAL::ARAP::Minimizer::automatic,
                                                CGAL::ARAP::Initial_guess::laplacian)));
      prepare(deformation, s, all_vertices(mesh));
      const auto report = deformation.deform(0, 0);
      CHECK(report.status == CGAL::ARAP::Status::iteration_limit);
      CHECK(report.energy.size() == 1);
      if(is_spokes)
        CHECK_AT_MOST(std::abs(report.energy[0] - reference.energy(x)),
                      1e-8 * report.energy[0] + 1e-14 * report.energy_scale);
      CHECK_AT_MOST(largest_distance(points_of(mesh), x), 1e-8 * shape.diameter());
      if(shape.points.size() > 10) // with few free vertices they may agree
        CHECK(largest_distance(points_of(mesh), step) > 1e-4 * shape.diameter());

      // from there on as from any other start, again and again
      const auto run = deformation.deform(20, 0);
      CHECK(run.energy.size() == 21);
      CHECK(CGAL::ARAP::first_rise_of_energy(run) == 0);
      CHECK_AT_MOST(std::abs(run.energy[0] - report.energy[0]),
                    1e-8 * report.energy[0] + 1e-14 * report.energy_scale);
    }
}

void test_all()
{
  test<CGAL::ARAP::Multifrontal_cholesky_solver>();
  test<Single_precision_solver>();
}

} // namespace initial_guess

// Tetrahedra: the identity that their weights are made for, an independent dense computation of
// energies and iterates, energies that are never negative, and the count of what is inside out.
namespace tetrahedra {

using CGAL::ARAP::Tetrahedron_soup_domain;
using Tetrahedra = std::vector<std::array<std::size_t, 4>>;
using Soup = Tetrahedron_soup_domain<std::vector<Point>, Tetrahedra>;
using Edge_weights = std::map<std::pair<std::size_t, std::size_t>, double>;

double volume(const std::array<Eigen::Vector3d, 4>& p)
{
  return std::abs((p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0])) / 6;
}

// For a linear map D of a tetrahedron, sum w ||D e||^2 = volume ||D||_F^2.
void test_weights()
{
  test_case() = "weights of one tetrahedron";
  std::mt19937 random(3);
  std::uniform_real_distribution<double> entry(-1, 1);
  for(int k = 0; k < 1000; ++k)
  {
    std::array<CGAL::ARAP::Coordinates, 4> t;
    std::array<Eigen::Vector3d, 4> p;
    for(int i = 0; i < 4; ++i)
    {
      t[i] = {entry(random), entry(random), entry(random)};
      p[i] = {t[i][0], t[i][1], t[i][2]};
    }
    const auto w = CGAL::ARAP::Cotangent_weight().simplex_weights(t);
    const Eigen::Matrix3d map = Eigen::Matrix3d::NullaryExpr([&] { return entry(random); });
    double sum = 0, sum_of_magnitudes = 0;
    int edge = 0;
    for(int i = 0; i < 4; ++i)
      for(int j = i + 1; j < 4; ++j, ++edge)
      {
        sum += w[edge] * (map * (p[i] - p[j])).squaredNorm();
        sum_of_magnitudes += std::abs(w[edge]) * (map * (p[i] - p[j])).squaredNorm();

        // |kl| cot(dihedral angle at kl) / 6, with kl the opposite edge
        const int a = i == 0 ? (j == 1 ? 2 : 1) : 0, b = 6 - i - j - a;
        const Eigen::Vector3d axis = (p[b] - p[a]).normalized();
        const auto across = [&](int v) {
          const Eigen::Vector3d d = p[v] - p[a];
          return Eigen::Vector3d(d - d.dot(axis) * axis);
        };
        const double angle = std::atan2(across(i).cross(across(j)).norm(),
                                        across(i).dot(across(j)));
        const double expected = (p[b] - p[a]).norm() / std::tan(angle) / 6;
        CHECK_AT_MOST(std::abs(w[edge] - expected), 1e-8 * (1 + std::abs(expected)));
      }
    CHECK_AT_MOST(std::abs(sum - volume(p) * map.squaredNorm()), 1e-12 * sum_of_magnitudes);
  }
}

// whether a vertex of the block lies on its surface
std::vector<bool> on_surface(const Block& shape)
{
  std::map<std::set<std::size_t>, int> faces;
  for(const auto& t : shape.tetrahedra)
    for(int k = 0; k < 4; ++k)
    {
      std::set<std::size_t> face(t.begin(), t.end());
      face.erase(t[k]);
      ++faces[face];
    }
  std::vector<bool> result(shape.points.size(), false);
  for(const auto& [face, count] : faces)
    if(count == 1)
      for(std::size_t v : face)
        result[v] = true;
  return result;
}

// With its surface at the places that a linear map D gives it, a block follows linearly: each
// element has the energy V ||D - R||^2 and, with rims, counts at each of its four corners.
void test_linear_maps()
{
  const Block shape = block(4, 4, 4);
  const std::vector<bool> is_fixed = on_surface(shape);
  CHECK(std::count(is_fixed.begin(), is_fixed.end(), false) == 27);
  std::vector<bool> has_cell(shape.points.size(), false); // free, or next to a free vertex
  for(const auto& t : shape.tetrahedra)
    for(std::size_t v : t)
      if(!is_fixed[v])
        for(std::size_t w : t)
          has_cell[w] = true;
  double volume_of_elements = 0, volume_of_cells = 0;
  for(const auto& t : shape.tetrahedra)
  {
    const double v = volume({shape.points[t[0]], shape.points[t[1]], shape.points[t[2]],
                             shape.points[t[3]]});
    if(std::any_of(t.begin(), t.end(), [&](std::size_t c) { return !is_fixed[c]; }))
      volume_of_elements += v;
    volume_of_cells += v * double(std::count_if(t.begin(), t.end(),
                                                [&](std::size_t c) { return has_cell[c]; }));
  }
  CHECK(volume_of_cells > 3.9 * volume_of_elements); // most of the block is inside

  std::mt19937 random(8);
  std::uniform_real_distribution<double> entry(-1, 1);
  for(int k = 0; k < 10; ++k)
  {
    const Eigen::Matrix3d map =
      rigid_motion(3 * entry(random), {1, entry(random), entry(random)}, {0, 0, 0}).linear *
      (Eigen::Matrix3d::Identity() +
       0.3 * Eigen::Matrix3d::NullaryExpr([&] { return entry(random); }));
    const Eigen::Matrix3d rotation = Dense_reference::closest_rotation(map.transpose());
    const double distance = (map - rotation).squaredNorm();
    Scenario s{{}, {}};
    for(std::size_t v = 0; v < shape.points.size(); ++v)
    {
      s.selection.push_back(is_fixed[v] ? 2 : 1);
      s.targets.push_back(map * shape.points[v]);
    }
    for(Cell_scheme cells : {Cell_scheme::elements(), Cell_scheme::spokes_and_rims()})
    {
      test_case() = "a linear map";
      std::vector<Point> points = points_of(shape.points);
      CGAL::ARAP_deformation<Soup> d(Soup(points, shape.tetrahedra));
      CHECK(d.set_options(options_for(cells, CGAL::ARAP::Minimizer::automatic,
                                      CGAL::ARAP::Initial_guess::laplacian)));
      prepare(d, s, numbers(points.size()));
      const CGAL::ARAP::Report report = d.deform(300, 0);
      CHECK(report);
      CHECK(report.inverted_simplices == 0);
      CHECK_AT_MOST(largest_distance(points, s.targets), 1e-9);
      const double expected =
        distance * (cells == Cell_scheme::elements() ? volume_of_elements : volume_of_cells);
      CHECK_AT_MOST(std::abs(report.energy.back() - expected), 1e-12 * report.energy_scale);
    }
  }
}

// On tetrahedra with obtuse angles stars of raw cotangents reward being distorted: they have to be
// asked for. All else, and every default, is never negative.
void test_sign_of_energy()
{
  Block shape = block(7, 2, 2);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> jitter(-0.1, 0.1);
  for(auto& p : shape.points)
    p = Eigen::Vector3d(2.5 * (p.x() + jitter(random)), p.y() + jitter(random),
                        p.z() + jitter(random));
  const Scenario s = scenario(shape);
  const auto run = [&](auto weight, Cell_scheme cells) {
    using Traits = CGAL::ARAP_deformation_traits<CGAL::Default, decltype(weight)>;
    std::vector<Point> points = points_of(shape.points);
    CGAL::ARAP_deformation<Soup, Traits> d(Soup(points, shape.tetrahedra));
    CHECK(d.set_options(options_for(cells)));
    prepare(d, s, numbers(points.size()));
    const CGAL::ARAP::Report report = d.deform(100, 0);
    CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
    return report;
  };
  for(Cell_scheme cells : all_cell_schemes)
  {
    test_case() = "the default weights";
    const CGAL::ARAP::Report report = run(CGAL::ARAP::Safe_cotangent_weight(), cells);
    CHECK(report);
    CHECK(*std::min_element(report.energy.begin(), report.energy.end()) > 0);
  }
  test_case() = "raw cotangents";
  CHECK(run(CGAL::ARAP::Cotangent_weight(), Cell_scheme::spokes_and_rims()).energy.back() > 0);
  CHECK(run(CGAL::ARAP::Cotangent_weight(), Cell_scheme::elements()).energy.back() > 0);
  const CGAL::ARAP::Report raw = run(CGAL::ARAP::Cotangent_weight(), Cell_scheme::spokes());
  CHECK(raw);
  CHECK(raw.energy.back() < 0);
}

void test_inverted()
{
  const Block shape = block(2, 2, 2);
  for(double scale : {1.0, 1e-60})
  {
    test_case() = scale == 1 ? "inverted tetrahedra" : "tiny inverted tetrahedra";
    std::vector<Point> points;
    for(const Eigen::Vector3d& p : shape.points)
      points.push_back(point(scale * p));
    CGAL::ARAP_deformation<Soup> d(Soup(points, shape.tetrahedra));
    for(std::size_t v = 0; v < points.size(); ++v)
    {
      d.insert_roi_vertex(v);
      if(v != 13) // the one in the middle
        d.insert_control_vertex(v);
    }
    CHECK(d.deform().inverted_simplices == 0);
    d.translate(0, Kernel::Vector_3(2 * scale, 2 * scale, 2 * scale)); // through the block
    const CGAL::ARAP::Report report = d.deform();
    std::size_t expected = 0;
    for(const auto& t : shape.tetrahedra)
      expected += CGAL::orientation(points[t[0]], points[t[1]], points[t[2]], points[t[3]]) !=
                  CGAL::POSITIVE; // as all are at first
    CHECK(expected > 0);
    CHECK(report.inverted_simplices == expected);
  }
}

void test_all()
{
  test_weights();
  test_linear_maps();
  test_sign_of_energy();
  test_inverted();
}

} // namespace tetrahedra

// Energy and forces of several blocks of simplices, with three, four or mixed numbers of corners in
// any order, against the sums that they are; with all cells and with some.
namespace blocks {

using namespace CGAL::ARAP::internal;
using CGAL::ARAP::Coordinates;
using CGAL::ARAP::Matrix_3x3;

void test(int fewest_corners, int most_corners)
{
  test_case() = std::to_string(fewest_corners) + " to " + std::to_string(most_corners) + " corners";
  const int n = 1500, number_of_simplices = 3000, number_of_movable = 1400;
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> number(-1, 1);
  std::uniform_int_distribution<int> corners_of_one(fewest_corners, most_corners), vertex(0, n - 1);
  CGAL::ARAP::internal::Simplices simplices;
  for(int s = 0; s < number_of_simplices; ++s)
  {
    std::set<int> corners;
    for(const int k = corners_of_one(engine); static_cast<int>(corners.size()) < k;)
      corners.insert(vertex(engine));
    Array<int>& items = simplices.corners.items;
    items.insert(items.end(), corners.begin(), corners.end());
    std::shuffle(items.end() - static_cast<int>(corners.size()), items.end(), engine);
    simplices.corners.begin.push_back(static_cast<int>(items.size()));
    simplices.first_weight.push_back(static_cast<int>(simplices.weights.size()));
    for(std::size_t k = 0; k < corners.size() * (corners.size() - 1) / 2; ++k)
      simplices.weights.push_back(number(engine));
  }
  Cells cells = vertex_cells(simplices.corners, n);
  for(double& stiffness : cells.stiffness)
    stiffness = 2 + number(engine);
  std::vector<Matrix_3x3> rotations(n);
  for(Matrix_3x3& rotation : rotations)
    for(double& entry : rotation)
      entry = number(engine);
  Array<Coordinates> rest, x;
  for(int v = 0; v < n; ++v)
    for(Array<Coordinates>* points : {&rest, &x})
      points->push_back({number(engine), number(engine), number(engine)});

  Simplex_energy energy(simplices, cells, number_of_movable);
  std::vector<Coordinates> forces(number_of_movable);
  for(bool do_all_count : {true, false, true})
  {
    Array<char> is_chosen(n, true);
    for(int c = 0; c < n && !do_all_count; c += 3)
      is_chosen[c] = false;
    energy.choose_cells(is_chosen);
    double result = 0;
    for(int k = 0; k < 2; ++k) // nothing is left over from one to the next
      result = energy.evaluate(rest, x, rotations.data(), forces.data());
    CHECK(energy.evaluate(rest, x, rotations.data(), nullptr) == result);

    double sum = 0, size = 0;
    std::vector<Eigen::Vector3d> expected(n, Eigen::Vector3d::Zero());
    simplices.for_each_edge([&](int s, int i, int j, double w) {
      const auto difference = [&](const Array<Coordinates>& points) -> Eigen::Vector3d {
        return Eigen::Vector3d::Map(points[i].data()) - Eigen::Vector3d::Map(points[j].data());
      };
      for(int k = simplices.corners.begin[s]; k < simplices.corners.begin[s + 1]; ++k)
        if(const int c = simplices.corners.items[k]; is_chosen[c])
        {
          const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>
            rotation(rotations[std::size_t(c)].data());
          const Eigen::Vector3d residual = difference(x) - rotation * difference(rest);
          sum += cells.stiffness[c] * w * residual.squaredNorm();
          size += cells.stiffness[c] * std::abs(w) * residual.squaredNorm();
          expected[std::size_t(i)] -= cells.stiffness[c] * w * residual;
          expected[std::size_t(j)] += cells.stiffness[c] * w * residual;
        }
    });
    CHECK_AT_MOST(std::abs(result - sum), 1e-13 * size);
    for(std::size_t v = 0; v < number_of_movable; ++v)
      for(int k = 0; k < 3; ++k)
        CHECK_AT_MOST(std::abs(forces[v][std::size_t(k)] - expected[v][k]), 1e-11);
  }
}

void test_all()
{
  test(3, 3);
  test(4, 4);
  test(3, 5);
}

} // namespace blocks

int main()
{
  blocks::test_all();
  iterates::test_all();
  initial_guess::test_all();
  tetrahedra::test_all();
  return checks_result();
}
