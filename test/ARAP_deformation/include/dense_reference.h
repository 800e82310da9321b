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
#include <functional>
#include <set>
#include <string>
#include <utility>
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
    add_row({{v, 1}}, weight, [target](const Eigen::Vector3d&) { return target; });
  }

  // A linear combination of positions, and its target, which may depend on its value: it is pulled
  // there, or put there if the weight is infinite.
  using Terms = std::vector<std::pair<std::size_t, double>>;
  using Target = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

  void add_row(const Terms& terms, double weight, const Target& target)
  {
    (std::isinf(weight) ? m_hard_rows : m_soft_rows).push_back({terms, weight, target});
  }

  // the energy with the best rotations
  double energy(const std::vector<Eigen::Vector3d>& x) const
  {
    double sum = 0;
    for(const Row& row : m_soft_rows)
      sum += row.weight * (row.value(x) - row.target(row.value(x))).squaredNorm();
    for(const auto& cell : m_cells)
    {
      const Eigen::Matrix3d r = rotation(cell, x);
      for(const Edge& e : cell)
        sum += e.weight * ((x[e.i] - x[e.j]) - r * (m_rest[e.i] - m_rest[e.j])).squaredNorm();
    }
    return sum;
  }

  // one step of local/global: the minimizer of the energy for the rotations at x
  void iterate(std::vector<Eigen::Vector3d>& x) const { solve(x, false); }

  // moves x to where hard rows are met, the shortest way in the metric of the matrix
  void start(std::vector<Eigen::Vector3d>& x) const { solve(x, true); }

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
  void solve(std::vector<Eigen::Vector3d>& x, bool is_start) const
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
    for(const Row& row : m_soft_rows)
    {
      Eigen::Vector3d rest = row.target(row.value(x));
      for(const auto& [v, c] : row.terms)
        if(m_row[v] < 0)
          rest -= c * x[v];
      for(const auto& [v, c] : row.terms)
        for(const auto& [w, d] : row.terms)
          if(m_row[v] >= 0 && m_row[w] >= 0)
            a(m_row[v], m_row[w]) += row.weight * c * d;
      for(const auto& [v, c] : row.terms)
        if(m_row[v] >= 0)
          b.row(m_row[v]) += row.weight * c * rest.transpose();
    }
    if(is_start) // only the way to where hard rows are met, from x
      for(Eigen::Index k = 0; k < n; ++k)
        b.row(k).setZero();
    // the saddle point system
    const auto m = Eigen::Index(m_hard_rows.size());
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n + m, n + m), right(n + m, 3);
    whole.topLeftCorner(n, n) = a;
    right.topRows(n) = b;
    for(Eigen::Index r = 0; r < m; ++r)
    {
      const Row& row = m_hard_rows[std::size_t(r)];
      right.row(n + r) = row.target({0, 0, 0}).transpose();
      for(const auto& [v, c] : row.terms)
      {
        if(m_row[v] >= 0)
          whole(m_row[v], n + r) = whole(n + r, m_row[v]) = c;
        if(is_start || m_row[v] < 0)
          right.row(n + r) -= c * x[v].transpose();
      }
    }
    const Eigen::MatrixXd solution = whole.fullPivLu().solve(right);
    for(Eigen::Index k = 0; k < n; ++k)
      x[m_free[k]] = (is_start ? x[m_free[k]] : Eigen::Vector3d(0, 0, 0)) +
                     solution.row(k).transpose();
  }

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

  struct Row
  {
    Terms terms;
    double weight;
    Target target;

    Eigen::Vector3d value(const std::vector<Eigen::Vector3d>& x) const
    {
      Eigen::Vector3d sum(0, 0, 0);
      for(const auto& [v, c] : terms)
        sum += c * x[v];
      return sum;
    }
  };

  std::vector<Eigen::Vector3d> m_rest;
  std::vector<Simplex> m_simplices;
  int m_dimension;
  std::vector<int> m_selection;
  Weights m_weights;
  std::vector<std::size_t> m_free;
  std::vector<int> m_row; // of the free vertices among the unknowns, or -1
  std::vector<std::vector<Edge>> m_cells;
  std::vector<Row> m_soft_rows, m_hard_rows;
};

#endif // CGAL_ARAP_DEFORMATION_TEST_DENSE_REFERENCE_H
