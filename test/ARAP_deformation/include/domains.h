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

#ifndef CGAL_ARAP_DEFORMATION_TEST_DOMAINS_H
#define CGAL_ARAP_DEFORMATION_TEST_DOMAINS_H

// What each domain is tested with: it conforms to its concept, and gives for the same shape the
// same energies and positions as the domain of ranges.

#include "check.h"
#include "conformance.h"
#include "shapes.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/check_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

using CGAL::ARAP::Cell_scheme;

inline const std::array<Cell_scheme, 4> all_cell_schemes = {
  Cell_scheme::spokes(), Cell_scheme::spokes_and_rims(), Cell_scheme::elements(),
  Cell_scheme::k_ring(1)};

inline CGAL::ARAP::Options options_for(
  const Cell_scheme& cells,
  CGAL::ARAP::Minimizer minimizer = CGAL::ARAP::Minimizer::automatic,
  CGAL::ARAP::Initial_guess guess = CGAL::ARAP::Initial_guess::previous)
{
  CGAL::ARAP::Options options;
  options.cells = cells;
  options.minimizer = minimizer;
  options.initial_guess = guess;
  return options;
}

// Calls f(options) with all cells, minimizers and initial guesses.
template <typename Function>
void for_all_options(const Function& f)
{
  using CGAL::ARAP::Initial_guess;
  using CGAL::ARAP::Minimizer;
  for(const Cell_scheme& cells : all_cell_schemes)
    for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
      for(Initial_guess guess : {Initial_guess::previous, Initial_guess::laplacian})
        f(options_for(cells, minimizer, guess));
}

inline double sum_of_phases(const CGAL::ARAP::Phase_seconds& s)
{
  return s.preprocess + s.transfer + s.initial_guess + s.local_steps + s.global_steps + s.visitor;
}

// what a domain asks of a point, and nothing else
class Bare_point
{
public:
  Bare_point(double x, double y, double z) : m_coordinates{x, y, z} {}
  double operator[](int k) const { return m_coordinates[k]; }

private:
  std::array<double, 3> m_coordinates;
};

struct Result
{
  std::vector<double> energy;
  std::vector<Eigen::Vector3d> points; // of all vertices
};

template <typename Domain>
void check_conforms(const Domain& domain)
{
  CHECK_CONFORMS(CGAL::ARAP::check_domain(domain));
}

// Ten iterations; vertex k of the shape is vertices[k] of the domain. `read` gives the result,
// which need not be where the domain reads from.
template <typename Domain, typename Vertices, typename Read>
Result deform(const Domain& domain, const Vertices& vertices, const Scenario& s, Cell_scheme cells,
              const Read& read)
{
  CGAL::ARAP_deformation<Domain> deformation(domain);
  CHECK(deformation.set_options(options_for(cells)));
  prepare(deformation, s, vertices);
  const CGAL::ARAP::Report report = deformation.deform(10, 0);
  if(!CHECK(report))
    std::cerr << "    " << report.message << std::endl;
  CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
  Result result{report.energy, {}};
  for(const auto& v : vertices)
  {
    const CGAL::ARAP::Coordinates c = Domain::coordinates(read(v));
    result.points.emplace_back(c[0], c[1], c[2]);
  }
  return result;
}

template <typename Domain, typename Vertices>
Result deform(const Domain& domain, const Vertices& vertices, const Scenario& s, Cell_scheme cells)
{
  return deform(domain, vertices, s, cells, [&domain](const auto& v) { return domain.point(v); });
}

inline bool is_finite_point(const Point& p)
{
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

inline std::vector<std::size_t> numbers(std::size_t n)
{
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t(0));
  return all;
}

// what the domain of ranges gives; Dimension 3 if the simplices are tetrahedra
template <int Dimension, typename Simplices>
Result reference(const std::vector<Eigen::Vector3d>& vectors, const Simplices& simplices,
                 const Scenario& s, Cell_scheme cells)
{
  std::vector<Point> points = points_of(vectors);
  const CGAL::ARAP::Simplex_soup_domain<Dimension, std::vector<Point>, Simplices> domain(points,
                                                                                        simplices);
  return deform(domain, numbers(points.size()), s, cells);
}

// Energies relative to the first one, positions relative to the diameter.
inline void compare(const Result& a, const Result& b, double diameter, double energy_tolerance,
                    double position_tolerance)
{
  CHECK(a.energy.size() == b.energy.size() && a.points.size() == b.points.size());
  for(std::size_t k = 0; k < a.energy.size() && k < b.energy.size(); ++k)
    CHECK_AT_MOST(std::abs(a.energy[k] - b.energy[k]),
                  energy_tolerance * a.energy[0] + std::pow(position_tolerance * diameter, 2));
  for(std::size_t v = 0; v < a.points.size() && v < b.points.size(); ++v)
    CHECK_AT_MOST((a.points[v] - b.points[v]).norm(), position_tolerance * diameter);
}

inline void compare(const Result& a, const Result& b, double diameter, double tolerance = 1e-10)
{
  compare(a, b, diameter, tolerance, tolerance);
}

using Polygons = std::vector<std::vector<std::size_t>>;

// a tube of quads, closed by two polygons with many corners
inline Shape tube(Polygons& polygons)
{
  const std::size_t around = 14, along = 12;
  Shape shape{"tube", {}, {}};
  for(std::size_t j = 0; j <= along; ++j)
    for(std::size_t i = 0; i < around; ++i)
      shape.points.emplace_back(std::cos(2 * 3.14159265 * i / around),
                                std::sin(2 * 3.14159265 * i / around), 0.45 * j);
  for(std::size_t j = 0; j < along; ++j)
    for(std::size_t i = 0; i < around; ++i)
      polygons.push_back({j * around + i, j * around + (i + 1) % around,
                          (j + 1) * around + (i + 1) % around, (j + 1) * around + i});
  std::vector<std::size_t> bottom, top;
  for(std::size_t i = 0; i < around; ++i)
  {
    bottom.push_back(around - 1 - i);
    top.push_back(along * around + i);
  }
  polygons.push_back(bottom);
  polygons.push_back(top);
  return shape;
}

// A block of n x m x k cubes with a rounded side, each cut in five tetrahedra.
struct Block
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::size_t, 4>> tetrahedra;

  double diameter() const { return diameter_of(points); }
};

inline Block block(int nx, int ny, int nz)
{
  Block block;
  for(int x = 0; x <= nx; ++x)
    for(int y = 0; y <= ny; ++y)
      for(int z = 0; z <= nz; ++z)
        block.points.emplace_back(0.5 * x, 0.4 * y + 0.05 * std::sin(1.3 * x),
                                  0.3 * z + 0.04 * x * y / (nx + 1.0));
  const auto vertex = [=](int x, int y, int z) {
    return std::size_t((x * (ny + 1) + y) * (nz + 1) + z);
  };
  for(int x = 0; x < nx; ++x)
    for(int y = 0; y < ny; ++y)
      for(int z = 0; z < nz; ++z)
      {
        // odd cubes are mirrored, so that the diagonals of neighbours meet
        const int a = (x + y + z) % 2, b = 1 - a;
        const auto corner = [&](int i, int j, int k) {
          return vertex(x + (i ? b : a), y + j, z + k);
        };
        std::vector<std::array<std::size_t, 4>> five = {
          {corner(0, 0, 0), corner(1, 0, 0), corner(0, 1, 0), corner(0, 0, 1)},
          {corner(1, 1, 0), corner(0, 1, 0), corner(1, 0, 0), corner(1, 1, 1)},
          {corner(1, 0, 1), corner(1, 0, 0), corner(0, 0, 1), corner(1, 1, 1)},
          {corner(0, 1, 1), corner(0, 1, 0), corner(1, 1, 1), corner(0, 0, 1)},
          {corner(1, 0, 0), corner(0, 1, 0), corner(0, 0, 1), corner(1, 1, 1)}};
        for(auto& t : five)
        {
          Eigen::Matrix3d edges;
          for(int k = 0; k < 3; ++k)
            edges.col(k) = block.points[t[k + 1]] - block.points[t[0]];
          if(edges.determinant() < 0)
            std::swap(t[0], t[1]);
          block.tetrahedra.push_back(t);
        }
      }
  return block;
}

inline Scenario scenario(const Block& block, double angle = 0.9)
{
  return scenario(Shape{"", block.points, {}}, angle);
}

#endif // CGAL_ARAP_DEFORMATION_TEST_DOMAINS_H
