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

#include <CGAL/Default.h>

#include <Eigen/Core>

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

// a deformation of a mesh with these options and the scenario
template <typename Traits = CGAL::Default>
auto prepared(Mesh& mesh, const Scenario& s, const CGAL::ARAP::Options& options = {})
{
  CGAL::ARAP_deformation<Mesh, Traits> d(mesh);
  CHECK(d.set_options(options));
  prepare(d, s, all_vertices(mesh));
  return d;
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

double sum_of_phases(const CGAL::ARAP::Phase_seconds& s);

// the iterations after which the energy had fallen to this
unsigned int iterations_to(double energy, const CGAL::ARAP::Report& report);

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

std::vector<std::size_t> numbers(std::size_t n);

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
void compare(const Result& a, const Result& b, double diameter, double energy_tolerance,
             double position_tolerance);

void compare(const Result& a, const Result& b, double diameter, double tolerance = 1e-10);

using Polygons = std::vector<std::vector<std::size_t>>;

template <typename Simplices>
Polygons as_polygons(const Simplices& simplices)
{
  Polygons polygons;
  for(const auto& corners : simplices)
    polygons.emplace_back(corners.begin(), corners.end());
  return polygons;
}

// a tube of quads, closed by two polygons with many corners
Shape tube(Polygons& polygons);

// a sheet of quads and hexagons, not flat
Shape sheet_of_polygons(int n, int m, Polygons& polygons);

// A block of n x m x k cubes with a rounded side, each cut in five tetrahedra.
struct Block
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::size_t, 4>> tetrahedra;

  double diameter() const { return diameter_of(points); }
};

Block block(int nx, int ny, int nz);

// Unit cubes, each cut in six tetrahedra of both orientations around the same diagonal.
Block unit_cubes(int nx, int ny, int nz);

Scenario scenario(const Block& block, double angle = 0.9);

#endif // CGAL_ARAP_DEFORMATION_TEST_DOMAINS_H
