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

// An energy with all that a minimizer has, without a session: for tests of what is internal.

#ifndef ARAP_DEFORMATION_TEST_PROBLEM_H
#define ARAP_DEFORMATION_TEST_PROBLEM_H

#include "check.h"

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_metric.h>
#include <CGAL/ARAP_deformation/internal/energy/laplacian_of.h>
#include <CGAL/ARAP_deformation/internal/energy/make_deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/minimizer/Minimization.h>
#include <CGAL/ARAP_deformation/internal/session/core_models.h>

#include <Eigen/Dense>

#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

namespace problem {

using namespace CGAL::ARAP::internal;
using CGAL::ARAP::Coordinates;
using CGAL::ARAP::Matrix_3x3;
using CGAL::ARAP::Options;
using CGAL::ARAP::Report;

struct Random
{
  std::mt19937 engine{11};
  std::uniform_real_distribution<double> number{-1, 1};

  Coordinates operator()() { return {number(engine), number(engine), number(engine)}; }
};

// what all of a mesh is, as the numeric core knows it
template <typename Simplices>
Region region_of(const std::vector<Eigen::Vector3d>& points, const Simplices& simplices)
{
  Region region;
  region.dimension = static_cast<int>(simplices[0].size()) - 1;
  for(const auto& p : points)
  {
    region.indices.push_back(region.rest.size());
    region.rest.push_back({p.x(), p.y(), p.z()});
  }
  for(const auto& simplex : simplices)
  {
    for(std::size_t v : simplex)
      region.corners.push_back(static_cast<int>(v));
    region.first_corner.push_back(static_cast<int>(region.corners.size()));
  }
  region.number_of_movable_vertices = region.number_of_centers = region.number_of_vertex_cells =
    static_cast<int>(points.size());
  region.number_of_movable_simplices = static_cast<int>(simplices.size());
  return region;
}

// An energy with its constraints at deformed positions, and all that a minimizer has.
struct Problem
{
  Core_models models = core_models(CGAL::ARAP_deformation_traits<>());
  Region region;
  Deformation_energy energy;
  Constrained_system system{models.solver->copy()};
  Constraints constraints;
  Targets targets;
  Options options;
  Observer observe = [](unsigned int, double) { return CGAL::ARAP::Visitor_action::proceed; };
  Array<Coordinates> x;
  Array<Matrix_3x3> rotations;
  std::unique_ptr<Coarse_metric> coarse_metric;
  Report report;

  Problem(const Region& region_, const Energy_model& model, double noise)
    : region(region_),
      energy(make_deformation_energy(*models.weight, weighted_simplices(*models.weight, region),
                                     model, region)),
      x(region.rest), rotations(static_cast<std::size_t>(energy.number_of_cells()),
                                identity_matrix())
  {
    Random random;
    Bounding_box box;
    for(const Coordinates& p : x)
      box.include(p);
    for(Coordinates& p : x)
    {
      p = {p[0] + 0.3 * std::sin(p[1]), p[1] - 0.2 * p[0], 1.1 * p[2] + 0.2 * p[0] * p[1]};
      add(p, noise * std::sqrt(box.squared_length()), random());
    }
    constraints.is_fixed = Array<char>(x.size(), false);
    constraints.is_fixed[0] = constraints.is_fixed[x.size() / 2] = true;
  }

  // to be called when the constraints are complete
  Minimization minimization()
  {
    energy.set_fixed(constraints.is_fixed, false);
    system.set_laplacian(laplacian_of(energy));
    CGAL::ARAP::Stages stages;
    CHECK(system.prepare(constraints, stages).status == CGAL::ARAP::Status::success);
    CHECK(system.meet(targets.hard, x));
    return Minimization(energy, models.closest_rotations, system, constraints, options, observe,
                        region, targets, x, rotations, coarse_metric, report);
  }
};

} // namespace problem

#endif // ARAP_DEFORMATION_TEST_PROBLEM_H
