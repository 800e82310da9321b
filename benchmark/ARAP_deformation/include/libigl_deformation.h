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

#include "scenario.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>

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

inline Libigl_scenario libigl_scenario(const Scenario& scenario)
{
  const Mesh& mesh = scenario.mesh;
  Libigl_scenario result;
  result.points.resize(static_cast<Eigen::Index>(num_vertices(mesh)), 3);
  for(vertex_descriptor v : vertices(mesh))
    result.points.row(v.idx()) = to_vector(mesh.point(v));
  result.simplices.resize(static_cast<Eigen::Index>(num_faces(mesh)), 3);
  for(auto f : faces(mesh))
  {
    int corner = 0;
    for(vertex_descriptor v : vertices_around_face(mesh.halfedge(f), mesh))
      result.simplices(f.idx(), corner++) = static_cast<int>(v.idx());
  }
  const Eigen::Index n = static_cast<Eigen::Index>(scenario.targets.size());
  result.fixed.resize(n);
  result.targets.resize(n, 3);
  for(Eigen::Index k = 0; k < n; ++k)
  {
    const auto& [v, target] = scenario.targets[static_cast<std::size_t>(k)];
    result.fixed[k] = static_cast<int>(v.idx());
    result.targets.row(k) = to_vector(target);
  }
  return result;
}

class Libigl_deformation
{
public:
  Libigl_deformation(const Libigl_scenario& scenario, Libigl_energy energy);
  ~Libigl_deformation();

  double preprocess_seconds() const { return m_preprocess_seconds; }
  const Eigen::MatrixXd& points() const { return m_points; }

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
