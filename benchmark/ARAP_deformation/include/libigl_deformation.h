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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_LIBIGL_DEFORMATION_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_LIBIGL_DEFORMATION_H

// libigl's deformation, in a separate file: its headers take long to compile.

#include "shapes.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <vector>

namespace benchmark {

enum class Libigl_energy { spokes, elements };

// the rest shape, whose simplices have three or four corners, and the targets of fixed vertices
struct Libigl_scenario
{
  Eigen::MatrixXd points;
  Eigen::MatrixXi simplices;
  Eigen::VectorXi fixed;
  Eigen::MatrixXd targets;
};

// Targets are pairs of a vertex and a point.
template <std::size_t N, typename Targets>
Libigl_scenario libigl_scenario(const Shape<N>& shape, const Targets& targets)
{
  Libigl_scenario result;
  result.points.resize(static_cast<Eigen::Index>(shape.points.size()), 3);
  for(Eigen::Index v = 0; v < result.points.rows(); ++v)
    result.points.row(v) = to_vector(shape.points[static_cast<std::size_t>(v)]);
  result.simplices.resize(static_cast<Eigen::Index>(shape.simplices.size()), N);
  for(Eigen::Index s = 0; s < result.simplices.rows(); ++s)
    result.simplices.row(s) = Eigen::Map<const Eigen::Matrix<int, 1, N>>(
      shape.simplices[static_cast<std::size_t>(s)].data());
  result.fixed.resize(static_cast<Eigen::Index>(targets.size()));
  result.targets.resize(result.fixed.size(), 3);
  for(Eigen::Index k = 0; k < result.fixed.size(); ++k)
  {
    const auto& [v, target] = targets[static_cast<std::size_t>(k)];
    result.fixed[k] = static_cast<int>(v);
    result.targets.row(k) = to_vector(target);
  }
  return result;
}

inline Libigl_scenario libigl_scenario(const Scenario& scenario)
{
  return libigl_scenario(surface("", scenario.mesh), scenario.targets);
}

class Libigl_deformation
{
public:
  Libigl_deformation(const Libigl_scenario& scenario, Libigl_energy energy);
  ~Libigl_deformation();

  double preprocess_seconds() const { return m_preprocess_seconds; }
  std::vector<Point> points() const
  {
    std::vector<Point> result;
    for(Eigen::Index v = 0; v < m_points.rows(); ++v)
      result.push_back(to_point(m_points.row(v)));
    return result;
  }

  // Local/global iterations from the rest shape; returns their seconds.
  double run(unsigned int iterations);

private:
  struct Data;

  const Libigl_scenario& m_scenario;
  Eigen::MatrixXd m_points;
  std::unique_ptr<Data> m_data;
  double m_preprocess_seconds = 0;
};

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_LIBIGL_DEFORMATION_H
