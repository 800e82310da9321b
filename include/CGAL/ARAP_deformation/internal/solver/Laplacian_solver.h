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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_LAPLACIAN_SOLVER_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_LAPLACIAN_SOLVER_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/concepts/concept_checks.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/region/Paged_index_map.h>
#include <CGAL/ARAP_deformation/internal/solver/factorize_laplacian.h>
#include <CGAL/ARAP_deformation/internal/solver/laplacian.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Solves for the free vertices, by a factor that may be that of other free vertices. Vertices that
// are now fixed and were free when the factor was computed are kept where they are by multipliers,
// and vertices that are now free and were fixed then are further unknowns. Both are a border of the
// matrix A of the factor,
//   [ A    B ] [ x ]   [ f ]
//   [ B^T  D ] [ z ] = [ g ],
// with a column of B that is a unit vector for each vertex that is now fixed, and one with the
// entries of the Laplacian for each that is now free. A vertex with another weight of its target is
// both: its row of the factor is fixed, and it is a further unknown with a row of its own.
template <typename Solver>
class Laplacian_solver
{
public:
  Laplacian_solver() = default;

  // Makes it solve for the free vertices of an energy, whose indices in the mesh are given. The
  // factor there is serves if few vertices have changed and the weights of edges have not, and the
  // analysis if nothing has but weights of targets; otherwise a copy of the prototype does both.
  Diagnosis prepare(const Deformation_energy& energy, const std::vector<std::size_t>& indices,
                    const Solver& prototype)
  {
    const Sparse_matrix laplacian = free_laplacian(energy);
    Diagnosis diagnosis = find_fault(energy, laplacian);
    if(diagnosis.status != Status::success)
      return diagnosis;
    std::vector<Row> rows;
    bool is_analyzed = false;
    if constexpr(can_have_border<Solver>)
    {
      rows = describe_rows(energy, indices);
      if(border_factor(laplacian, indices, rows))
        return diagnosis;
      is_analyzed = has_same_pattern(indices, rows);
    }
    // moved from here, so that there are never two factors, and none where something fails
    std::optional<Solver> solver = std::exchange(m_solver, std::nullopt);
    remember(indices, std::move(rows));
    if(laplacian.rows() == 0)
      return diagnosis;
    if(!is_analyzed)
    {
      solver.reset();
      solver.emplace(prototype);
    }
    if((is_analyzed || solver->analyze(laplacian)) && solver->factorize(laplacian))
      m_solver = std::move(solver);
    else
      diagnosis.status = Status::singular_matrix;
    return diagnosis;
  }

  // replaces the right-hand side x, one row for each free vertex, by the solution
  bool solve(std::size_t n, Coordinates* x)
  {
    if(m_rows.empty())
      return m_solver->solve(n, x);
    m_bordered.assign(m_number_of_rows, Coordinates{0, 0, 0});
    for(std::size_t v = 0; v < n; ++v)
      m_bordered[m_rows[v]] = x[v];
    if(!m_solver->solve(m_bordered.size(), m_bordered.data()))
      return false;
    for(std::size_t v = 0; v < n; ++v)
      x[v] = m_bordered[m_rows[v]];
    return true;
  }

private:
  // beyond this a factorization costs less than a border
  static constexpr std::size_t largest_border = 256;

  // What tells whether the row of a vertex is the same, whatever is free around it. Of the weights
  // of its edges that is their sum, and their sum with a factor for each neighbour.
  struct Row
  {
    double plain = 0, weighted = 0, absolute = 0;
    double soft_weight = 0;

    bool has_about_the_edges_of(const Row& other) const
    {
      const double tolerance = 1e-11 * absolute; // summed up in another order
      return std::abs(plain - other.plain) <= tolerance &&
             std::abs(weighted - other.weighted) <= tolerance;
    }
  };

  static std::vector<Row> describe_rows(const Deformation_energy& energy,
                                        const std::vector<std::size_t>& indices)
  {
    // a number of [0, 1) for each vertex: multiples of the golden ratio, without the integer part
    std::vector<double> factors(indices.size());
    std::transform(indices.begin(), indices.end(), factors.begin(), [](std::size_t index) {
      return std::ldexp(static_cast<double>(std::uint64_t(index) * 0x9e3779b97f4a7c15u >> 11), -53);
    });
    const int n = energy.number_of_free_vertices();
    std::vector<Row> rows(n);
    const auto add = [&](int i, int neighbour, double weight) {
      if(i >= n)
        return;
      rows[i].plain += weight;
      rows[i].absolute += std::abs(weight);
      rows[i].weighted += weight * factors[neighbour];
    };
    energy.for_each_edge([&](int i, int j, double weight) {
      add(i, j, weight);
      add(j, i, weight);
    });
    for(const Soft_position& soft : energy.soft_positions())
      rows[soft.vertex].soft_weight = soft.weight;
    return rows;
  }

  // what tells later whether the factor serves, which is computed next
  void remember(const std::vector<std::size_t>& indices, std::vector<Row> rows)
  {
    m_rows.clear();
    m_base_numbers = Paged_index_map();
    m_base_rows = std::move(rows);
    for(int v = 0; v < base_size(); ++v)
      m_base_numbers.set(indices[v], v);
  }

  // whether the matrix has its entries where the factorized one has them
  bool has_same_pattern(const std::vector<std::size_t>& indices, const std::vector<Row>& rows) const
  {
    bool is_same = m_solver && rows.size() == m_base_rows.size();
    for(std::size_t v = 0; v < rows.size() && is_same; ++v)
      is_same = m_base_numbers[indices[v]] == static_cast<int>(v) &&
                rows[v].has_about_the_edges_of(m_base_rows[v]);
    return is_same;
  }

  bool border_factor(const Sparse_matrix& laplacian, const std::vector<std::size_t>& indices,
                     const std::vector<Row>& new_rows)
  {
    if(!m_solver)
      return false;
    const int n = static_cast<int>(laplacian.rows());
    std::vector<int> rows(n);
    std::vector<char> is_free(base_size(), false);
    int number_of_rows = base_size();
    for(int v = 0; v < n; ++v)
    {
      const int row = m_base_numbers[indices[v]];
      if(row == Paged_index_map::none || new_rows[v].soft_weight != m_base_rows[row].soft_weight)
      {
        rows[v] = number_of_rows++;
        continue;
      }
      if(!new_rows[v].has_about_the_edges_of(m_base_rows[row]))
        return false;
      rows[v] = row;
      is_free[row] = true;
    }
    const int number_of_freed = number_of_rows - base_size();
    const int number_of_kept = n - number_of_freed;
    const std::size_t border_size =
      static_cast<std::size_t>(number_of_freed) + (base_size() - number_of_kept);
    if(border_size > largest_border)
      return false;

    std::vector<Eigen::Triplet<double, int>> entries;
    Eigen::MatrixXd corner = Eigen::MatrixXd::Zero(border_size, border_size);
    for(int v = 0; v < n; ++v)
      for(Sparse_matrix::InnerIterator entry(laplacian, v); entry; ++entry)
      {
        const int i = (std::max)(rows[v], rows[entry.row()]) - base_size();
        const int j = (std::min)(rows[v], rows[entry.row()]);
        if(i >= 0 && j < base_size())
          entries.emplace_back(j, i, entry.value());
        else if(i >= 0)
          corner(i, j - base_size()) = corner(j - base_size(), i) = entry.value();
      }
    for(int row = 0; row < base_size(); ++row)
      if(!is_free[row])
        entries.emplace_back(row, number_of_rows++ - base_size(), 1);
    Sparse_matrix border(base_size(), border_size);
    border.setFromTriplets(entries.begin(), entries.end());
    if(!m_solver->set_border(border, corner))
      return false;
    const bool are_same = border_size == 0 && std::is_sorted(rows.begin(), rows.end());
    m_rows = are_same ? std::vector<int>() : std::move(rows);
    m_number_of_rows = static_cast<std::size_t>(number_of_rows);
    return true;
  }

  // the number of rows of the factor
  int base_size() const { return static_cast<int>(m_base_rows.size()); }

  std::optional<Solver> m_solver;      // if something is factorized
  Paged_index_map m_base_numbers;      // from the indices in the mesh to the rows of the factor
  std::vector<Row> m_base_rows;        // of the matrix that is factorized
  std::vector<int> m_rows;             // for each free vertex its row; empty if they are the same
  std::size_t m_number_of_rows = 0;    // with the border
  std::vector<Coordinates> m_bordered; // scratch
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SOLVER_LAPLACIAN_SOLVER_H
