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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDERED_SUBSTITUTION_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDERED_SUBSTITUTION_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_structure.h>
#include <CGAL/ARAP_deformation/internal/cholesky/Supernodal_substitution.h>
#include <CGAL/ARAP_deformation/internal/cholesky/border_kernels.h>
#include <CGAL/ARAP_deformation/internal/cholesky/substitution_kernels.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/run_kernel.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Substitution with the factor of A, and with that of A with a border, [A B; B^T D]. Of W = L^-1 P
// B only those rows are stored that the elimination tree reaches from the entries of B. What is
// left for the unknowns of the border is the dense system of D - W^T W.
class Bordered_substitution
{
public:
  // What Eigen has allocated goes too: matrices that are not empty must not be resized, since they
  // free what they had once more where that runs out of memory.
  void remove_border()
  {
    m_groups.clear();
    m_border_size = 0;
    m_scale.resize(0);
    m_remainder.reset();
  }

  std::size_t border_size() const { return m_border_size; }

  // Returns `false`, and has no border, if the dense system is not safely solvable.
  bool set_border(const Supernodal_structure& structure, const double* values,
                  const Sparse_matrix& b, const Eigen::MatrixXd& d)
  {
    remove_border();
    if(b.cols() == 0)
      return true;
    bool is_solvable = false;
    try
    {
      group_columns(b, inverse_permutation(structure.order()));
      for_each_task(m_groups.size(), [&](std::size_t g) {
        substitute_columns(structure, values, b, m_groups[g]);
      });
      is_solvable = factorize_remainder(d);
    }
    catch(...)
    {
      remove_border();
      throw;
    }
    if(!is_solvable)
      remove_border();
    return is_solvable;
  }

  // Replaces the n rows of x, the last of which are those of the border, by the solution.
  void solve(const Supernodal_structure& structure, const double* values, std::size_t n,
             Coordinates* x)
  {
    m_substitution.forward(structure, values, x);
    if(!m_groups.empty())
      solve_border(structure, x + (n - border_size()));
    m_substitution.backward(structure, values, x);
  }

private:
  using Supernode = Supernodal_structure::Supernode;
  using Block = Supernodal_structure::Block;

  // the rows of a supernode, and where they begin in the values of a group
  struct Part
  {
    int supernode, size;
    std::pair<int, int> rank; // in the order upwards
    std::size_t begin;
  };

  // up to four columns of the border, with lanes of zeros if there are fewer
  struct Group
  {
    std::vector<int> columns;
    std::vector<int> positions; // of the columns' entries in the order of the factor
    std::vector<Part> parts;
    std::vector<double> values; // of W, four for each row
  };

  // Columns that begin near each other in the tree are put together.
  void group_columns(const Sparse_matrix& b, const std::vector<int>& position)
  {
    const int n = static_cast<int>(b.cols());
    m_border_size = static_cast<std::size_t>(n);
    std::vector<std::vector<int>> positions(n);
    std::vector<std::pair<int, int>> begin(n);
    for(int j = 0; j < n; ++j)
    {
      for(Sparse_matrix::InnerIterator entry(b, j); entry; ++entry)
        positions[j].push_back(position[entry.row()]);
      begin[j] = {positions[j].empty() ? 0 : *std::min_element(positions[j].begin(),
                                                               positions[j].end()), j};
    }
    std::sort(begin.begin(), begin.end());
    for(int k = 0; k < n; ++k)
    {
      const int column = begin[k].second;
      if(k % 4 == 0)
        m_groups.emplace_back();
      Group& group = m_groups.back();
      group.columns.push_back(column);
      group.positions.insert(group.positions.end(), positions[column].begin(),
                             positions[column].end());
    }
  }

  // L^-1 P B for the columns of a group, from the entries of B upwards
  static void substitute_columns(const Supernodal_structure& structure, const double* values,
                                 const Sparse_matrix& b, Group& group)
  {
    const std::vector<Supernode>& supernodes = structure.supernodes();
    const std::vector<Block>& blocks = structure.blocks();
    std::vector<int> path;
    std::vector<char> is_on_path(supernodes.size(), 0);
    for(int position : group.positions)
      for(int s = structure.supernode_at(position); s >= 0 && !is_on_path[s];
          s = supernodes[s].parent)
      {
        is_on_path[s] = 1;
        path.push_back(s);
      }
    // the blocks upwards, and so the supernodes of each
    const auto rank = [&](int s) { return std::make_pair(-structure.block_of(s), s); };
    std::sort(path.begin(), path.end(), [&](int s, int t) { return rank(s) < rank(t); });

    std::vector<std::size_t> begin(blocks.size(), 0); // of the local vectors of blocks on the path
    std::size_t size = 0;
    for(std::size_t k = 0; k < path.size(); ++k)
      if(const int block = structure.block_of(path[k]);
         k == 0 || block != structure.block_of(path[k - 1]))
      {
        begin[block] = size;
        size += 4 * static_cast<std::size_t>(blocks[block].own + blocks[block].boundary);
      }
    std::vector<double> vectors(size, 0);
    std::size_t next = 0;
    for(std::size_t l = 0; l < group.columns.size(); ++l)
      for(Sparse_matrix::InnerIterator entry(b, group.columns[l]); entry; ++entry)
      {
        const int position = group.positions[next++];
        const int block = structure.block_of(structure.supernode_at(position));
        const std::size_t row = static_cast<std::size_t>(position) - blocks[block].columns;
        vectors[begin[block] + 4 * row + l] += entry.value();
      }

    for(std::size_t k = 0; k < path.size();)
    {
      const int index = structure.block_of(path[k]);
      const Block& block = blocks[index];
      double* const vector = vectors.data() + begin[index];
      for(; k < path.size() && structure.block_of(path[k]) == index; ++k)
        run_forward(structure, path[k], path[k] + 1, values, vector);
      for(int j = 0; j < block.boundary; ++j)
        for(std::size_t l = 0; l < 4; ++l)
          vectors[begin[block.parent] + 4 * structure.to_parent(block)[j] + l] +=
            vector[4 * (block.own + j) + l];
    }
    for(int s : path)
    {
      group.parts.push_back({s, supernodes[s].width, rank(s), group.values.size()});
      const auto row = vectors.begin() + static_cast<std::ptrdiff_t>(begin[structure.block_of(s)])
                     + 4 * supernodes[s].first;
      group.values.insert(group.values.end(), row, row + 4 * supernodes[s].width);
    }
    group.values.shrink_to_fit();
  }

  // The factorization of D - W^T W. If the bordered matrix comes from a minimum, the block of the
  // multipliers, whose diagonal entries of D are zero, is negative definite, and with them
  // eliminated the rest is positive definite: so they are the first pivots, and no others are
  // needed. LDLT takes pivots by the size of the diagonal, which is scaled to one for multipliers,
  // and to at most a quarter for the others: what W takes from them may be all that D has.
  bool factorize_remainder(const Eigen::MatrixXd& d)
  {
    Eigen::MatrixXd remainder = d;
    for_each_task(m_groups.size(), [&](std::size_t g) {
      std::vector<Border_rows> common;
      for(std::size_t h = 0; h <= g; ++h)
      {
        find_common_rows(m_groups[g], m_groups[h], common);
        double products[16];
        run_kernel<Multiply_border>(common, +products);
        for(std::size_t i = 0; i < m_groups[g].columns.size(); ++i)
          for(std::size_t j = 0; j < m_groups[h].columns.size(); ++j)
          {
            const int row = m_groups[g].columns[i], column = m_groups[h].columns[j];
            const double entry =
              d((std::max)(row, column), (std::min)(row, column)) - products[4 * i + j];
            remainder(row, column) = entry;
            remainder(column, row) = entry;
          }
      }
    });
    const Eigen::Array<bool, Eigen::Dynamic, 1> is_multiplier = d.diagonal().array() == 0;
    m_scale.resize(d.rows());
    for(Eigen::Index k = 0; k < m_scale.size(); ++k)
      m_scale[k] = is_multiplier[k] ? 1 / std::sqrt(std::abs(remainder(k, k)))
                                    : 0.5 / std::sqrt(std::abs(d(k, k)));
    if(!m_scale.allFinite())
      return false;
    remainder = m_scale.asDiagonal() * remainder * m_scale.asDiagonal();
    if(!remainder.allFinite())
      return false;
    m_remainder.emplace(remainder);
    // Another factorization of A is the better answer long before digits run out. The signs of the
    // pivots are those of the eigenvalues: a bordered matrix with more negative ones than
    // multipliers does not come from a minimum.
    const Eigen::ArrayXd pivots = m_remainder->vectorD();
    return m_remainder->info() == Eigen::Success &&
           pivots.abs().minCoeff() > 1e-11 * pivots.abs().maxCoeff() &&
           (pivots < 0).count() == is_multiplier.count();
  }

  // The rows that are stored for both groups; the supernodes of both are in one order.
  void find_common_rows(Group& g, Group& h, std::vector<Border_rows>& common) const
  {
    common.clear();
    auto i = g.parts.begin(), j = h.parts.begin();
    while(i != g.parts.end() && j != h.parts.end())
      if(i->rank < j->rank)
        ++i;
      else if(j->rank < i->rank)
        ++j;
      else
      {
        common.push_back({g.values.data() + i->begin, h.values.data() + j->begin, i->size});
        ++i;
        ++j;
      }
  }

  // z := (D - W^T W)^-1 (g - W^T y), and y := y - W z in the local vectors.
  void solve_border(const Supernodal_structure& structure, Coordinates* x)
  {
    std::array<Eigen::VectorXd, 3> z;
    z.fill(Eigen::VectorXd(border_size()));
    std::vector<std::vector<Border_rows>> rows(m_groups.size());
    for_each_task(m_groups.size(), [&](std::size_t g) {
      Group& group = m_groups[g];
      for(const Part& part : group.parts)
      {
        const Supernode& s = structure.supernodes()[part.supernode];
        const Block& b = structure.blocks()[structure.block_of(part.supernode)];
        rows[g].push_back({group.values.data() + part.begin,
                           m_substitution.local_vector(b) + 4 * s.first, s.width});
      }
      double products[16];
      run_kernel<Multiply_border>(rows[g], +products);
      for(std::size_t l = 0; l < group.columns.size(); ++l)
        for(int c = 0; c < 3; ++c)
          z[c][group.columns[l]] = x[group.columns[l]][c] - products[4 * l + c];
    });
    for(Eigen::VectorXd& column : z)
      column = m_scale.cwiseProduct(m_remainder->solve(m_scale.cwiseProduct(column)));
    for(std::size_t g = 0; g < m_groups.size(); ++g)
    {
      double factors[16] = {};
      for(std::size_t l = 0; l < m_groups[g].columns.size(); ++l)
        for(int c = 0; c < 3; ++c)
          factors[4 * l + c] = x[m_groups[g].columns[l]][c] = z[c][m_groups[g].columns[l]];
      run_kernel<Subtract_border>(rows[g], static_cast<const double*>(factors));
    }
  }

  Supernodal_substitution<double> m_substitution;
  std::vector<Group> m_groups;
  std::size_t m_border_size = 0;
  Eigen::VectorXd m_scale;
  std::optional<Eigen::LDLT<Eigen::MatrixXd>> m_remainder;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_CHOLESKY_BORDERED_SUBSTITUTION_H
