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

#include "include/dense_reference.h"

#include "include/dense_algebra.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

Dense_reference::Dense_reference(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<Simplex>& simplices, int dimension,
                                 const std::vector<int>& selection, Cells cells, Weights weights,
                                 const Terms& terms)
  : m_rest(points), m_simplices(simplices), m_dimension(dimension), m_selection(selection),
    m_weights(weights), m_terms(terms)
{
  for(std::size_t v = 0; v < m_rest.size(); ++v)
    if(selection[v] == 1)
    {
      m_row.push_back(int(m_free.size()));
      m_free.push_back(v);
    }
    else
      m_row.push_back(-1);
  m_is_element = cells == ELEMENTS;
  make_cells(cells);
}

void Dense_reference::add_soft_position(std::size_t v, double weight,
                                        const Eigen::Vector3d& target)
{
  add_row({{v, 1}}, weight, [target](const Eigen::Vector3d&) { return target; });
}

void Dense_reference::add_row(const Combination& terms, double weight, const Target& target)
{
  (std::isinf(weight) ? m_hard_rows : m_soft_rows).push_back({terms, weight, target});
}

double Dense_reference::energy(const std::vector<Eigen::Vector3d>& x)
{
  fit(x);
  double sum = 0;
  for(const Row& row : m_soft_rows)
    sum += row.weight * (row.value(x) - row.target(row.value(x))).squaredNorm();
  for(std::size_t c = 0; c < m_cells.size(); ++c)
    for(const Form& form : m_cells[c].forms)
      sum += form.weight * (form.value(x) - m_rotations[c] * form.value(m_rest)).squaredNorm();
  for(const auto& [pair, weight] : m_couplings)
    sum += weight * (m_rotations[pair.first] - m_rotations[pair.second]).squaredNorm();
  return sum;
}

void Dense_reference::iterate(std::vector<Eigen::Vector3d>& x)
{
  if(m_terms.smoothing_length == 0)
    fit(x);
  solve(x, [this](std::size_t c, const Form& form) {
    return Eigen::Vector3d(m_rotations[c] * form.value(m_rest));
  });
}

void Dense_reference::start(std::vector<Eigen::Vector3d>& x) const
{
  solve(x, [](std::size_t, const Form&) { return Eigen::Vector3d(0, 0, 0); }, true);
}

void Dense_reference::rotation_guess(std::vector<Eigen::Vector3d> vectors,
                                     std::vector<Eigen::Vector3d>& x)
{
  solve(vectors, [](std::size_t, const Form&) { return Eigen::Vector3d(0, 0, 0); });
  solve(x, [&](std::size_t c, const Form& form) {
    const Eigen::Vector3d v = vectors[m_cells[c].names[0]];
    return Eigen::Vector3d(Eigen::AngleAxisd(v.norm(), v.stableNormalized()) *
                           form.value(m_rest));
  });
}

void Dense_reference::solve(std::vector<Eigen::Vector3d>& x, const Expected& expected,
                            bool is_start) const
{
  const auto n = Eigen::Index(m_free.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), b = Eigen::MatrixXd::Zero(n, 3);
  for(std::size_t c = 0; c < m_cells.size(); ++c)
    for(const Form& form : m_cells[c].forms) // weight || sum of coefficients x - target ||^2
    {
      Eigen::Vector3d target = expected(c, form);
      for(const auto& [v, coefficient] : form.coefficients)
        if(m_row[v] < 0)
          target -= coefficient * x[v];
      for(const auto& [v, coefficient] : form.coefficients)
        if(m_row[v] >= 0)
        {
          b.row(m_row[v]) += form.weight * coefficient * target.transpose();
          for(const auto& [w, other] : form.coefficients)
            if(m_row[w] >= 0)
              a(m_row[v], m_row[w]) += form.weight * coefficient * other;
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
  const Eigen::MatrixXd solution = dense_solution(whole, right);
  for(Eigen::Index k = 0; k < n; ++k)
    x[m_free[k]] = (is_start ? x[m_free[k]] : Eigen::Vector3d(0, 0, 0)) +
                   solution.row(k).transpose();
}

void Dense_reference::laplacian_guess(std::vector<Eigen::Vector3d>& x) const
{
  const auto rows = Eigen::Index(m_rest.size()), n = Eigen::Index(m_free.size());
  Eigen::MatrixXd l = Eigen::MatrixXd::Zero(rows, rows);
  for(std::size_t i = 0; i < m_rest.size(); ++i)
    for(std::size_t j : neighbors(i))
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
  const Matrix_of_long_doubles solution =
    least_squares(columns.cast<long double>(), (l * (p - fixed)).cast<long double>());
  for(Eigen::Index k = 0; k < n; ++k)
    x[m_free[k]] = solution.row(k).transpose().cast<double>();
}

double Dense_reference::cotangent(const Eigen::Vector3d& apex, const Eigen::Vector3d& p,
                                  const Eigen::Vector3d& q)
{
  const Eigen::Vector3d a = (p - apex).normalized(), b = (q - apex).normalized();
  return a.dot(b) / a.cross(b).norm();
}

bool Dense_reference::contains(const Simplex& s, std::size_t v)
{
  return std::find(s.begin(), s.end(), v) != s.end();
}

auto Dense_reference::triangulations(const Simplex& polygon) -> std::vector<std::vector<Simplex>>
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

double Dense_reference::cotangent_weight(const Simplex& s, std::size_t i, std::size_t j) const
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

double Dense_reference::edge_weight(bool is_star, double sum) const
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

double Dense_reference::star_weight(std::size_t i, std::size_t j) const
{
  double sum = 0;
  for(const Simplex& s : m_simplices)
    if(contains(s, i) && contains(s, j))
      sum += cotangent_weight(s, i, j);
  return edge_weight(true, sum);
}

std::set<std::size_t> Dense_reference::neighbors(std::size_t i) const
{
  std::set<std::size_t> found;
  for(const Simplex& s : m_simplices)
    if(contains(s, i))
      found.insert(s.begin(), s.end());
  found.erase(i);
  return found;
}

auto Dense_reference::simplex_edges(const Simplex& s) const -> std::vector<Edge>
{
  std::vector<Edge> edges;
  for(std::size_t a = 0; a < s.size(); ++a)
    for(std::size_t b = 0; b < a; ++b)
      edges.push_back({s[a], s[b], edge_weight(false, cotangent_weight(s, s[a], s[b]))});
  return edges;
}

bool Dense_reference::make_bending_form(std::size_t i, double factor, Form& form) const
{
  double mass = 0;
  std::map<std::set<std::size_t>, int> facets; // at i, with the number of their simplices
  for(const Simplex& s : m_simplices)
  {
    if(!contains(s, i))
      continue;
    double content = 0;
    if(m_dimension == 3)
    {
      content = std::abs((m_rest[s[1]] - m_rest[s[0]]).cross(m_rest[s[2]] - m_rest[s[0]])
                           .dot(m_rest[s[3]] - m_rest[s[0]])) / 6;
      for(std::size_t k : s)
        if(k != i)
        {
          std::set<std::size_t> facet(s.begin(), s.end());
          facet.erase(k);
          ++facets[facet];
        }
    }
    else
    {
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      for(std::size_t k = 0; k < s.size(); ++k)
      {
        const std::size_t next = s[(k + 1) % s.size()];
        normal += (m_rest[s[k]] - m_rest[i]).cross(m_rest[next] - m_rest[i]) / 2;
        if(s[k] == i || next == i)
          ++facets[{s[k], next}];
      }
      content = normal.norm();
    }
    mass += content / double(s.size());
    for(std::size_t j : s)
      if(j != i)
      {
        form.coefficients[i] += cotangent_weight(s, i, j);
        form.coefficients[j] -= cotangent_weight(s, i, j);
      }
  }
  for(const auto& facet : facets)
    if(facet.second == 1)
      return false;
  for(auto& entry : form.coefficients)
    entry.second /= mass;
  form.weight = factor * mass;
  return true;
}

double Dense_reference::stiffness(std::size_t name) const
{
  return m_terms.stiffness.empty() ? 1 : m_terms.stiffness[name];
}

void Dense_reference::make_cells(Cells scheme)
{
  std::map<int, Cell> groups;
  const auto add = [&](std::size_t name, const std::vector<Edge>& edges) {
    Cell cell;
    cell.names = {name};
    bool is_at_region = false;
    for(const Edge& e : edges)
    {
      cell.forms.push_back({stiffness(name) * e.weight, {{e.i, 1.0}, {e.j, -1.0}}});
      cell.is_moving |= m_selection[e.i] == 1 || m_selection[e.j] == 1;
      is_at_region |= m_selection[e.i] != 0 || m_selection[e.j] != 0;
    }
    if(!is_at_region)
      return;
    cell.is_moving |= m_terms.smoothing_length > 0;
    Form form;
    if(m_terms.bending_length > 0 &&
       make_bending_form(name, std::pow(m_terms.bending_length, 2) * stiffness(name), form))
      cell.forms.push_back(form);
    if(m_terms.group.empty() || m_terms.group[name] < 0)
    {
      if(cell.is_moving)
        m_cells.push_back(cell);
      return;
    }
    Cell& group = groups[m_terms.group[name]];
    group.names.push_back(name);
    group.is_moving |= cell.is_moving;
    group.forms.insert(group.forms.end(), cell.forms.begin(), cell.forms.end());
  };
  if(scheme == ELEMENTS)
    for(std::size_t s = 0; s < m_simplices.size(); ++s)
      add(s, simplex_edges(m_simplices[s]));
  else
    for(std::size_t i = 0; i < m_rest.size(); ++i)
    {
      std::vector<Edge> cell;
      if(scheme == SPOKES)
      {
        std::set<std::size_t> stars = {i};
        for(unsigned int ring = 0; ring < m_terms.rings; ++ring)
          for(std::size_t star : std::set<std::size_t>(stars))
            for(std::size_t j : neighbors(star))
              stars.insert(j);
        for(std::size_t star : stars)
          for(std::size_t j : neighbors(star))
            cell.push_back({star, j, star_weight(star, j)});
      }
      else
        for(const Simplex& s : m_simplices)
          if(contains(s, i))
            for(const Edge& e : simplex_edges(s))
              cell.push_back(e);
      add(i, cell);
    }
  for(const auto& group : groups)
    if(group.second.is_moving)
      m_cells.push_back(group.second);
  m_rotations.assign(m_cells.size(), Eigen::Matrix3d::Identity());
  if(m_terms.smoothing_length > 0)
    couple(scheme);
}

double Dense_reference::coupling(Cells scheme, std::size_t i, std::size_t j) const
{
  double weight = 0;
  if(scheme != ELEMENTS)
  {
    for(const Simplex& s : m_simplices)
      if(contains(s, i) && contains(s, j))
        weight += cotangent_weight(s, i, j);
    return (std::max)(weight, 0.0);
  }
  const Simplex &s = m_simplices[i], &t = m_simplices[j];
  Eigen::Vector3d apart = Eigen::Vector3d::Zero();
  for(std::size_t v : s)
    apart += m_rest[v] / double(s.size());
  for(std::size_t v : t)
    apart -= m_rest[v] / double(t.size());
  std::vector<Eigen::Vector3d> common;
  for(std::size_t v : s)
    if(contains(t, v))
      common.push_back(m_rest[v]);
  if(m_dimension == 3 && common.size() == 3)
    weight = (common[1] - common[0]).cross(common[2] - common[0]).norm() / 2;
  for(std::size_t k = 0; m_dimension == 2 && k < s.size(); ++k)
    for(std::size_t l = 0; l < t.size(); ++l)
    {
      const std::size_t a = s[k], b = s[(k + 1) % s.size()];
      if(std::minmax(a, b) == std::minmax(t[l], t[(l + 1) % t.size()]))
        weight += (m_rest[a] - m_rest[b]).norm();
    }
  return apart.norm() > 1e-10 ? weight / apart.norm() : 0; // not where they lie on each other
}

void Dense_reference::couple(Cells scheme)
{
  for(std::size_t c = 0; c < m_cells.size(); ++c)
    for(std::size_t d = 0; d < c; ++d)
    {
      double weight = 0;
      for(std::size_t i : m_cells[c].names)
        for(std::size_t j : m_cells[d].names)
          weight += coupling(scheme, i, j);
      if(weight > 0)
        m_couplings[{c, d}] = std::pow(m_terms.smoothing_length, 2) * weight;
    }
}

void Dense_reference::fit(const std::vector<Eigen::Vector3d>& x)
{
  std::vector<Eigen::Matrix3d> covariances; // Equation (5) of the paper
  for(const Cell& cell : m_cells)
  {
    covariances.push_back(Eigen::Matrix3d::Zero());
    for(const Form& form : cell.forms)
      covariances.back() += form.weight * form.value(m_rest) * form.value(x).transpose();
  }
  for(const auto& [pair, weight] : m_couplings)
  {
    const Eigen::Matrix3d both = m_rotations[pair.first] + m_rotations[pair.second];
    covariances[pair.first] += weight * both.transpose();
    covariances[pair.second] += weight * both.transpose();
  }
  for(std::size_t c = 0; c < m_cells.size(); ++c)
  {
    m_rotations[c] = closest_rotation(covariances[c]);
    Eigen::Matrix3d given = Eigen::Matrix3d::Zero();
    for(const auto& [v, rotation] : m_terms.frames)
      for(std::size_t name : m_cells[c].names)
        if(m_is_element ? contains(m_simplices[name], v) : name == v)
          given += rotation; // the closest one to the mean
    if(!given.isZero())
      m_rotations[c] = closest_rotation(given.transpose());
  }
}

Eigen::Matrix3d Dense_reference::closest_rotation(const Eigen::Matrix3d& s)
{
#if EIGEN_VERSION_AT_LEAST(3, 4, 90)
  const Eigen::JacobiSVD<Eigen::Matrix3d, Eigen::ComputeFullU | Eigen::ComputeFullV> svd(s);
#else
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(s, Eigen::ComputeFullU | Eigen::ComputeFullV);
#endif
  Eigen::Matrix3d u = svd.matrixU();
  if((svd.matrixV() * u.transpose()).determinant() < 0)
    u.col(2) *= -1;
  return svd.matrixV() * u.transpose();
}

Eigen::Vector3d Dense_reference::Form::value(const std::vector<Eigen::Vector3d>& x) const
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for(const auto& [v, coefficient] : coefficients)
    sum += coefficient * x[v];
  return sum;
}

Eigen::Vector3d Dense_reference::Row::value(const std::vector<Eigen::Vector3d>& x) const
{
  Eigen::Vector3d sum(0, 0, 0);
  for(const auto& [v, c] : terms)
    sum += c * x[v];
  return sum;
}
