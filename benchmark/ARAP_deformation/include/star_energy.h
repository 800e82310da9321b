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

#ifndef CGAL_ARAP_DEFORMATION_BENCHMARK_STAR_ENERGY_H
#define CGAL_ARAP_DEFORMATION_BENCHMARK_STAR_ENERGY_H

// The energy that CGAL's ORIGINAL_ARAP minimizes, its gradient and its matrix. Computed with
// Eigen's singular value decomposition and no code of this package: an independent measure for all
// results.

#include "scenario.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace benchmark {

class Star_energy
{
public:
  explicit Star_energy(const Scenario& scenario)
    : m_edges(num_vertices(scenario.mesh)), m_is_free(num_vertices(scenario.mesh), true)
  {
    for(const auto& [v, target] : scenario.targets)
      m_is_free[v.idx()] = false;
    const Mesh& mesh = scenario.mesh;
    for(auto h : halfedges(mesh))
    {
      const std::size_t i = mesh.source(h).idx(), j = mesh.target(h).idx();
      const double weight = (half_cotangent(mesh, h) + half_cotangent(mesh, mesh.opposite(h)));
      m_edges[i].push_back({j, weight, point(mesh, i) - point(mesh, j)});
    }
  }

  struct Value
  {
    double energy = 0;
    double gradient = 0; // the norm of its part for the free vertices
  };

  Value operator()(const Mesh& deformed) const
  {
    Value value;
    std::vector<Eigen::Vector3d> gradient(m_edges.size(), Eigen::Vector3d::Zero());
    for(std::size_t i = 0; i < m_edges.size(); ++i)
    {
      Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
      for(const Edge& e : m_edges[i])
        covariance += e.weight * difference(deformed, i, e.j) * e.rest.transpose();
      const Eigen::Matrix3d rotation = closest_rotation(covariance);
      for(const Edge& e : m_edges[i])
      {
        const Eigen::Vector3d d = difference(deformed, i, e.j) - rotation * e.rest;
        value.energy += e.weight * d.squaredNorm();
        gradient[i] += 2 * e.weight * d;
        gradient[e.j] -= 2 * e.weight * d;
      }
    }
    double squares = 0;
    for(std::size_t i = 0; i < m_edges.size(); ++i)
      if(m_is_free[i])
        squares += gradient[i].squaredNorm();
    value.gradient = std::sqrt(squares);
    return value;
  }

  // half the Hessian of the free vertices with the rotations fixed; the lower triangle
  Eigen::SparseMatrix<double> matrix() const
  {
    std::vector<int> place(m_edges.size(), -1);
    int n = 0;
    for(std::size_t i = 0; i < m_edges.size(); ++i)
      if(m_is_free[i])
        place[i] = n++;
    std::vector<Eigen::Triplet<double>> entries;
    for(std::size_t i = 0; i < m_edges.size(); ++i)
      for(const Edge& e : m_edges[i])
      {
        const int a = place[i], b = place[e.j];
        if(a >= 0)
          entries.emplace_back(a, a, 2 * e.weight);
        if(a > b && b >= 0)
          entries.emplace_back(a, b, -2 * e.weight);
      }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  static Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& covariance)
  {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU();
    if((u * svd.matrixV().transpose()).determinant() < 0)
      u.col(2) *= -1;
    return u * svd.matrixV().transpose();
  }

private:
  struct Edge
  {
    std::size_t j;
    double weight;
    Eigen::Vector3d rest; // from j to the center
  };

  static Eigen::Vector3d point(const Mesh& mesh, std::size_t i)
  {
    return to_vector(mesh.point(vertex_descriptor(static_cast<Mesh::size_type>(i))));
  }

  static Eigen::Vector3d difference(const Mesh& mesh, std::size_t i, std::size_t j)
  {
    return point(mesh, i) - point(mesh, j);
  }

  // half the cotangent of the angle opposite to h, or 0 if that is negative
  static double half_cotangent(const Mesh& mesh, Mesh::Halfedge_index h)
  {
    if(mesh.is_border(h))
      return 0;
    const std::size_t k = mesh.target(mesh.next(h)).idx();
    const Eigen::Vector3d a = difference(mesh, mesh.source(h).idx(), k);
    const Eigen::Vector3d b = difference(mesh, mesh.target(h).idx(), k);
    return (std::max)(a.dot(b) / a.cross(b).norm(), 0.0) / 2;
  }

  std::vector<std::vector<Edge>> m_edges; // of each star
  std::vector<bool> m_is_free;
};

} // namespace benchmark

#endif // CGAL_ARAP_DEFORMATION_BENCHMARK_STAR_ENERGY_H
