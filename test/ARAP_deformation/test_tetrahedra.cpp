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

// Tetrahedra: the identity that their weights are made for, an independent dense computation of
// energies and iterates, energies that are never negative, and the count of what is inside out.

#include "include/domains.h"

#include <CGAL/ARAP_deformation/edge_weights.h>

#include <Eigen/Dense>

#include <algorithm>
#include <map>
#include <random>
#include <set>

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

Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& m)
{
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(m, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::Matrix3d u = svd.matrixU();
  const Eigen::Matrix3d v = svd.matrixV();
  if((u * v.transpose()).determinant() < 0)
    u.col(2) *= -1;
  return u * v.transpose();
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
      rigid_motion(3 * entry(random), {1, entry(random), entry(random)}, {0, 0, 0}).linear() *
      (Eigen::Matrix3d::Identity() +
       0.3 * Eigen::Matrix3d::NullaryExpr([&] { return entry(random); }));
    const double distance = (map - closest_rotation(map)).squaredNorm();
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
      CGAL::ARAP::Options options;
      options.cells = cells;
      options.initial_guess = CGAL::ARAP::Initial_guess::laplacian;
      d.set_options(options);
      prepare(d, s, numbers(points.size()));
      const CGAL::ARAP::Report report = d.deform(300, 0);
      CHECK(report);
      CHECK(report.inverted_simplices == 0);
      for(std::size_t v = 0; v < points.size(); ++v)
        CHECK_AT_MOST((vector(points[v]) - s.targets[v]).norm(), 1e-9);
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
    using Traits = CGAL::ARAP_deformation_traits_3<CGAL::Default, decltype(weight)>;
    std::vector<Point> points = points_of(shape.points);
    CGAL::ARAP_deformation<Soup, Traits> d(Soup(points, shape.tetrahedra));
    CGAL::ARAP::Options options;
    options.cells = cells;
    d.set_options(options);
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
  test_case() = "inverted tetrahedra";
  const Block shape = block(2, 2, 2);
  std::vector<Point> points = points_of(shape.points);
  CGAL::ARAP_deformation<Soup> d(Soup(points, shape.tetrahedra));
  for(std::size_t v = 0; v < points.size(); ++v)
  {
    d.insert_roi_vertex(v);
    if(v != 13) // the one in the middle
      d.insert_control_vertex(v);
  }
  CHECK(d.deform().inverted_simplices == 0);
  d.translate(0, Kernel::Vector_3(2, 2, 2)); // a corner through the block
  const CGAL::ARAP::Report report = d.deform();
  std::size_t expected = 0;
  for(const auto& t : shape.tetrahedra)
    expected += CGAL::orientation(points[t[0]], points[t[1]], points[t[2]], points[t[3]]) !=
                CGAL::POSITIVE; // as all are at first
  CHECK(expected > 0);
  CHECK(report.inverted_simplices == expected);
}

int main()
{
  test_weights();
  test_linear_maps();
  test_sign_of_energy();
  test_inverted();
  return checks_result();
}
