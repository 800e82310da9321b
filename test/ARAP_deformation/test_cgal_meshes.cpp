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

// Every surface in CGAL's data folder, as ranges, and as a mesh where it is one: it deforms with an
// energy that never rises, or is refused with a sentence if it has no faces. Twice the run with the
// default options gives twice the same. Prints the table of the manual, in which a file is in the
// first row that fits.

#include "include/domains.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/ARAP_deformation/conformance/checks.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;
namespace PMP = CGAL::Polygon_mesh_processing;
using CGAL::ARAP::Minimizer;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;
using Points = std::vector<Point>;
using Ranges = CGAL::ARAP::Polygon_soup_domain<Points, Polygons>;

// The lowest sixth along the longest axis is fixed, the highest sixth turned and moved.
template <typename Deformation, typename Vertices>
Report deform(Deformation& deformation, const Vertices& vertices, const Scenario& s,
              const Options& options)
{
  CHECK(deformation.set_options(options));
  prepare(deformation, s, vertices);
  return deformation.deform(10, 0);
}

Report deform_ranges(Points& points, const Polygons& polygons, const Scenario& s,
                     const Options& options)
{
  CGAL::ARAP_deformation<Ranges> deformation(Ranges(points, polygons));
  return deform(deformation, numbers(points.size()), s, options);
}

// runs with all cell schemes and minimizers; returns the report of that with the default options
Report check_runs(const Points& rest, const Polygons& polygons)
{
  Shape shape;
  for(const Point& p : rest)
    shape.points.emplace_back(p.x(), p.y(), p.z());
  const Scenario s = scenario(shape);
  for(Cell_scheme cells : all_cell_schemes)
    for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
    {
      const Options options = options_for(cells, minimizer);
      Points points = rest;
      const Report report = deform_ranges(points, polygons, s, options);
      if(!report)
      {
        CHECK(report.status == CGAL::ARAP::Status::no_simplex && polygons.empty());
        CHECK(report.message.size() > 20);
        CHECK(points == rest);
        continue;
      }
      CHECK(CGAL::ARAP::first_rise_of_energy(report) == 0);
      // only if there is something to do: free vertices, and targets that are not where all were
      CHECK(report.energy.back() >= 0);
      CHECK(report.energy.back() < report.energy.front() || report.free_vertices == 0 ||
            report.energy.front() <= CGAL::ARAP::internal::energy_resolution(0, report));
      CHECK(std::all_of(points.begin(), points.end(), is_finite_point));
      for(std::size_t v = 0; v < points.size(); ++v)
        if(s.selection[v] != 1)
          CHECK(points[v] == point(s.targets[v]));

      if(!PMP::is_polygon_soup_a_polygon_mesh(polygons))
        continue;
      Mesh mesh;
      PMP::polygon_soup_to_polygon_mesh(rest, polygons, mesh);
      CGAL::ARAP_deformation<Mesh> deformation(mesh);
      const Report of_mesh = deform(deformation, all_vertices(mesh), s, options);
      CHECK(of_mesh && CGAL::ARAP::first_rise_of_energy(of_mesh) == 0);
      CHECK(of_mesh.unconstrained_components == report.unconstrained_components);
      CHECK_AT_MOST(std::abs(of_mesh.energy.back() - report.energy.back()),
                    1e-8 * report.energy.front() +
                      CGAL::ARAP::internal::energy_resolution(0, report));
    }
  Points points = rest, again = rest;
  const Report first = deform_ranges(points, polygons, s, Options());
  CHECK(deform_ranges(again, polygons, s, Options()).energy == first.energy && points == again);
  return first;
}

bool has_triangle_without_area(const Points& points, const Polygons& polygons)
{
  return std::any_of(polygons.begin(), polygons.end(), [&points](const auto& p) {
    return p.size() == 3 && CGAL::collinear(points[p[0]], points[p[1]], points[p[2]]);
  });
}

// a row of the table
std::string kind(const Points& points, const Polygons& polygons, const Report& report)
{
  if(!report)
    return std::string("refused, `") + CGAL::ARAP::to_string(report.status) + "`: has no faces";
  const bool has_polygons = std::any_of(polygons.begin(), polygons.end(),
                                        [](const auto& p) { return p.size() > 3; });
  return !PMP::is_polygon_soup_a_polygon_mesh(polygons)
             ? "deformed as ranges: not manifold, or not consistently oriented"
         : !report.unconstrained_components.empty()
             ? "deformed; parts without a handle stay and are named"
         : has_triangle_without_area(points, polygons)
             ? "deformed; has triangles without area"
         : report.free_vertices == 0 ? "has no free vertex: all are handles or fixed"
         : has_polygons ? "deformed; has polygons" : "deformed; triangles only";
}

int main()
{
  const fs::path folder = CGAL::data_file_path("meshes");
  std::set<fs::path> files;
  if(fs::is_directory(folder))
    for(const auto& entry : fs::directory_iterator(folder))
      files.insert(entry.path());
  std::map<std::string, std::vector<std::string>> table;
  for(const fs::path& file : files)
  {
    test_case() = file.filename().string();
    Points points;
    Polygons polygons;
    CGAL::IO::read_polygon_soup(file.string(), points, polygons); // false if there are no faces
    CHECK(!points.empty());
    table[kind(points, polygons, check_runs(points, polygons))].push_back(test_case());
  }
  if(table.empty())
  {
    std::cerr << folder << " has no meshes; nothing was tested. script/setup gets them, "
                 "CGAL_DATA_DIR tells where they are." << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "| What became of them | Files | |\n|:--|--:|:--|\n";
  for(const auto& [row, names] : table)
    std::cout << "| " << row << " | " << names.size() << " | "
              << (names.size() > 8 ? "" : boost::algorithm::join(names, ", ")) << " |\n";
  return checks_result();
}
