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

#ifndef CGAL_ARAP_DEFORMATION_TEST_DENSE_REFERENCE_H
#define CGAL_ARAP_DEFORMATION_TEST_DENSE_REFERENCE_H

// The energy and the iteration of local/global, written down a second time: dense matrices, each
// cell spelled out from the definition, nothing shared with the package. Slow, for small shapes.

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

class Dense_reference
{
public:
  enum Cells { SPOKES, SPOKES_AND_RIMS, ELEMENTS };
  enum Weights { SAFE, COTANGENT, CLAMPED, UNIFORM };

  struct Edge
  {
    std::size_t i, j;
    double weight;
  };

  using Simplex = std::vector<std::size_t>; // a polygon, or a tetrahedron if the dimension is 3

  Dense_reference(const std::vector<Eigen::Vector3d>& points,
                  const std::vector<Simplex>& simplices, int dimension,
                  const std::vector<int>& selection, Cells cells, Weights weights)
    : m_rest(points), m_simplices(simplices), m_dimension(dimension), m_selection(selection),
      m_weights(weights)
  {
    for(std::size_t v = 0; v < m_rest.size(); ++v)
      if(selection[v] == 1)
      {
        m_row.push_back(int(m_free.size()));
        m_free.push_back(v);
      }
      else
        m_row.push_back(-1);
    make_cells(cells);
  }

  // pulls a free vertex to a target: one more term of the energy
  void add_soft_position(std::size_t v, double weight, const Eigen::Vector3d& target)
  {
    m_soft_positions.push_back({v, weight, target});
  }

  // the energy with the best rotations
  double energy(const std::vector<Eigen::Vector3d>& x) const
  {
    double sum = 0;
    for(const Soft_position& soft : m_soft_positions)
      sum += soft.weight * (x[soft.vertex] - soft.target).squaredNorm();
    for(const auto& cell : m_cells)
    {
      const Eigen::Matrix3d r = rotation(cell, x);
      for(const Edge& e : cell)
        sum += e.weight * ((x[e.i] - x[e.j]) - r * (m_rest[e.i] - m_rest[e.j])).squaredNorm();
    }
    return sum;
  }

  // one step of local/global: the minimizer of the energy for the rotations at x
  void iterate(std::vector<Eigen::Vector3d>& x) const
  {
    const auto n = Eigen::Index(m_free.size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), b = Eigen::MatrixXd::Zero(n, 3);
    const auto add = [&](std::size_t i, std::size_t j, double w, const Eigen::Vector3d& d) {
      // the derivative of w || x_i - x_j - d ||^2 by x_i
      const int row = m_row[i];
      if(row < 0)
        return;
      a(row, row) += w;
      b.row(row) += w * d.transpose();
      if(m_row[j] >= 0)
        a(row, m_row[j]) -= w;
      else
        b.row(row) += w * x[j].transpose();
    };
    for(const auto& cell : m_cells)
    {
      const Eigen::Matrix3d r = rotation(cell, x);
      for(const Edge& e : cell)
      {
        const Eigen::Vector3d d = r * (m_rest[e.i] - m_rest[e.j]);
        add(e.i, e.j, e.weight, d);
        add(e.j, e.i, e.weight, -d);
      }
    }
    for(const Soft_position& soft : m_soft_positions)
    {
      a(m_row[soft.vertex], m_row[soft.vertex]) += soft.weight;
      b.row(m_row[soft.vertex]) += soft.weight * soft.target.transpose();
    }
    const Eigen::MatrixXd solution = a.fullPivLu().solve(b);
    for(Eigen::Index k = 0; k < n; ++k)
      x[m_free[k]] = solution.row(k).transpose();
  }

  // naive Laplacian editing: the least-squares solution of L x = L p, L with a row for each vertex
  void laplacian_guess(std::vector<Eigen::Vector3d>& x) const
  {
    const auto rows = Eigen::Index(m_rest.size()), n = Eigen::Index(m_free.size());
    Eigen::MatrixXd l = Eigen::MatrixXd::Zero(rows, rows);
    for(std::size_t i = 0; i < m_rest.size(); ++i)
      for(std::size_t j : neighbours(i))
      {
        l(i, i) += star_weight(i, j);
        l(i, j) -= star_weight(i, j);
      }
    Eigen::MatrixXd p(rows, 3), fixed = Eigen::MatrixXd::Zero(rows, 3), columns(rows, n);
    for(std::size_t v = 0; v < m_rest.size(); ++v)
    {
      p.row(v) = m_rest[v].transpose();
      if(m_row[v] < 0)
        fixed.row(v) = x[v].transpose();
      else
        columns.col(m_row[v]) = l.col(v);
    }
    const Eigen::MatrixXd solution = columns.colPivHouseholderQr().solve(l * (p - fixed));
    for(Eigen::Index k = 0; k < n; ++k)
      x[m_free[k]] = solution.row(k).transpose();
  }

private:
  static double cotangent(const Eigen::Vector3d& apex, const Eigen::Vector3d& p,
                          const Eigen::Vector3d& q)
  {
    const Eigen::Vector3d a = (p - apex).normalized(), b = (q - apex).normalized();
    return a.dot(b) / a.cross(b).norm();
  }

  static bool contains(const Simplex& s, std::size_t v)
  {
    return std::find(s.begin(), s.end(), v) != s.end();
  }

  // all ways to cut a polygon into triangles
  static std::vector<std::vector<Simplex>> triangulations(const Simplex& polygon)
  {
    if(polygon.size() < 3)
      return {{}};
    std::vector<std::vector<Simplex>> all; // by the third corner of the triangle at the first edge
    for(std::size_t k = 2; k < polygon.size(); ++k)
    {
      const Simplex right(polygon.begin() + 1, polygon.begin() + std::ptrdiff_t(k) + 1);
      Simplex left(polygon.begin() + std::ptrdiff_t(k), polygon.end());
      left.push_back(polygon[0]);
      for(const auto& r : triangulations(right))
        for(const auto& l : triangulations(left))
        {
          std::vector<Simplex> cut = {{polygon[0], polygon[1], polygon[k]}};
          cut.insert(cut.end(), r.begin(), r.end());
          cut.insert(cut.end(), l.begin(), l.end());
          all.push_back(cut);
        }
    }
    return all;
  }

  // the weight of the edge (i, j) in a simplex, before it is clamped or replaced
  double cotangent_weight(const Simplex& s, std::size_t i, std::size_t j) const
  {
    Simplex others = s;
    others.erase(std::find(others.begin(), others.end(), i));
    others.erase(std::find(others.begin(), others.end(), j));
    if(m_dimension == 3) // |kl| cot(dihedral angle at kl) / 6
    {
      const Eigen::Vector3d k = m_rest[others[0]], axis = m_rest[others[1]] - k;
      const auto across = [&](const Eigen::Vector3d& p) {
        return Eigen::Vector3d(p - k - (p - k).dot(axis) / axis.squaredNorm() * axis);
      };
      return axis.norm() * cotangent({0, 0, 0}, across(m_rest[i]), across(m_rest[j])) / 6;
    }
    if(s.size() == 3)
      return cotangent(m_rest[others[0]], m_rest[i], m_rest[j]) / 2;
    const auto all = triangulations(s);
    double sum = 0;
    for(const auto& triangulation : all)
      for(const Simplex& triangle : triangulation)
        if(contains(triangle, i) && contains(triangle, j))
          sum += cotangent_weight(triangle, i, j);
    return sum / double(all.size());
  }

  double edge_weight(bool is_star, double sum) const
  {
    switch(m_weights)
    {
    case UNIFORM: return 1;
    case COTANGENT: return sum;
    case CLAMPED: return (std::max)(sum, 0.0);
    case SAFE: break;
    }
    return is_star ? (std::max)(sum, 0.0) : sum;
  }

  double star_weight(std::size_t i, std::size_t j) const
  {
    double sum = 0;
    for(const Simplex& s : m_simplices)
      if(contains(s, i) && contains(s, j))
        sum += cotangent_weight(s, i, j);
    return edge_weight(true, sum);
  }

  std::set<std::size_t> neighbours(std::size_t i) const
  {
    std::set<std::size_t> found;
    for(const Simplex& s : m_simplices)
      if(contains(s, i))
        found.insert(s.begin(), s.end());
    found.erase(i);
    return found;
  }

  std::vector<Edge> simplex_edges(const Simplex& s) const
  {
    std::vector<Edge> edges;
    for(std::size_t a = 0; a < s.size(); ++a)
      for(std::size_t b = 0; b < a; ++b)
        edges.push_back({s[a], s[b], edge_weight(false, cotangent_weight(s, s[a], s[b]))});
    return edges;
  }

  // all cells that have an edge set with a free vertex, whole
  void make_cells(Cells scheme)
  {
    const auto is_free = [this](std::size_t v) { return m_selection[v] == 1; };
    const auto add = [&](const std::vector<Edge>& cell) {
      for(const Edge& e : cell)
        if(is_free(e.i) || is_free(e.j))
        {
          m_cells.push_back(cell);
          return;
        }
    };
    if(scheme == ELEMENTS)
    {
      for(const Simplex& s : m_simplices)
        add(simplex_edges(s));
      return;
    }
    for(std::size_t i = 0; i < m_rest.size(); ++i)
    {
      std::vector<Edge> cell;
      if(scheme == SPOKES)
        for(std::size_t j : neighbours(i))
          cell.push_back({i, j, star_weight(i, j)});
      else
        for(const Simplex& s : m_simplices)
          if(contains(s, i))
            for(const Edge& e : simplex_edges(s))
              cell.push_back(e);
      add(cell);
    }
  }

  Eigen::Matrix3d rotation(const std::vector<Edge>& cell,
                           const std::vector<Eigen::Vector3d>& x) const
  {
    Eigen::Matrix3d s = Eigen::Matrix3d::Zero(); // Equation (5) of the paper
    for(const Edge& e : cell)
      s += e.weight * (m_rest[e.i] - m_rest[e.j]) * (x[e.i] - x[e.j]).transpose();
#if EIGEN_VERSION_AT_LEAST(3, 4, 90)
    const Eigen::JacobiSVD<Eigen::Matrix3d, Eigen::ComputeFullU | Eigen::ComputeFullV> svd(s);
#else
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(s, Eigen::ComputeFullU | Eigen::ComputeFullV);
#endif
    Eigen::Matrix3d u = svd.matrixU();
    if((svd.matrixV() * u.transpose()).determinant() < 0)
      u.col(2) *= -1;
    return svd.matrixV() * u.transpose(); // Equation (6)
  }

  struct Soft_position
  {
    std::size_t vertex;
    double weight;
    Eigen::Vector3d target;
  };

  std::vector<Eigen::Vector3d> m_rest;
  std::vector<Simplex> m_simplices;
  int m_dimension;
  std::vector<int> m_selection;
  Weights m_weights;
  std::vector<std::size_t> m_free;
  std::vector<int> m_row; // of the free vertices among the unknowns, or -1
  std::vector<std::vector<Edge>> m_cells;
  std::vector<Soft_position> m_soft_positions;
};

#endif // CGAL_ARAP_DEFORMATION_TEST_DENSE_REFERENCE_H
