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

#include "include/domains.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

double sum_of_phases(const CGAL::ARAP::Phase_seconds& s)
{
  return s.preprocess + s.transfer + s.initial_guess + s.local_steps + s.global_steps + s.visitor;
}

unsigned int iterations_to(double energy, const CGAL::ARAP::Report& report)
{
  unsigned int k = 0;
  while(k < report.iterations && report.energy[k] > energy)
    ++k;
  return k;
}

std::vector<std::size_t> numbers(std::size_t n)
{
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t(0));
  return all;
}

void compare(const Result& a, const Result& b, double diameter, double energy_tolerance,
             double position_tolerance)
{
  CHECK(a.energy.size() == b.energy.size() && a.points.size() == b.points.size());
  for(std::size_t k = 0; k < a.energy.size() && k < b.energy.size(); ++k)
    CHECK_AT_MOST(std::abs(a.energy[k] - b.energy[k]),
                  energy_tolerance * a.energy[0] + std::pow(position_tolerance * diameter, 2));
  for(std::size_t v = 0; v < a.points.size() && v < b.points.size(); ++v)
    CHECK_AT_MOST((a.points[v] - b.points[v]).norm(), position_tolerance * diameter);
}

void compare(const Result& a, const Result& b, double diameter, double tolerance)
{
  compare(a, b, diameter, tolerance, tolerance);
}

Shape sheet_of_polygons(int n, int m, Polygons& polygons)
{
  Shape shape{"polygons", {}, {}};
  for(int i = 0; i <= n; ++i)
    for(int j = 0; j <= m; ++j)
      shape.points.emplace_back(0.3 * i + 0.05 * (j % 2), 0.25 * j,
                                0.1 * std::sin(i) * std::cos(0.7 * j));
  const auto vertex = [=](int i, int j) { return std::size_t(i * (m + 1) + j); };
  for(int i = 0; i < n; ++i)
    for(int j = 0; j < m; ++j)
      if(j % 3 == 2)
        polygons.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                            vertex(i, j + 1)});
      else if(j % 3 == 0 && j + 2 <= m)
        polygons.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                            vertex(i + 1, j + 2), vertex(i, j + 2), vertex(i, j + 1)});
  return shape;
}

Shape tube(Polygons& polygons)
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

Block block(int nx, int ny, int nz)
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
        // odd cubes are mirrored, so that the diagonals of neighbors meet
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

Block unit_cubes(int nx, int ny, int nz)
{
  Block block;
  const std::array<std::size_t, 3> stride = {std::size_t((ny + 1) * (nz + 1)),
                                             std::size_t(nz + 1), 1};
  for(int x = 0; x <= nx; ++x)
    for(int y = 0; y <= ny; ++y)
      for(int z = 0; z <= nz; ++z)
      {
        const std::size_t a = block.points.size();
        block.points.emplace_back(x, y, z);
        if(x == nx || y == ny || z == nz)
          continue;
        std::array<int, 3> order = {0, 1, 2};
        do
        {
          const std::size_t b = a + stride[order[0]], c = b + stride[order[1]];
          block.tetrahedra.push_back({a, b, c, c + stride[order[2]]});
        }
        while(std::next_permutation(order.begin(), order.end()));
      }
  return block;
}

Scenario scenario(const Block& block, double angle)
{
  return scenario(Shape{"", block.points, {}}, angle);
}
