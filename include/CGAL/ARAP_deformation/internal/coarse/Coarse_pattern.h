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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_PATTERN_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_PATTERN_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_space.h>
#include <CGAL/ARAP_deformation/internal/coarse/Coarse_transfer.h>
#include <CGAL/ARAP_deformation/internal/energy/Covariance_coefficients.h>
#include <CGAL/ARAP_deformation/internal/energy/Deformation_energy.h>
#include <CGAL/ARAP_deformation/internal/parallel/parallel.h>
#include <CGAL/ARAP_deformation/internal/simd/Vector4.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// Where the pair of two numbers is, the larger one first.
CGAL_ARAP_ALWAYS_INLINE std::ptrdiff_t place_of_pair(int a, int b)
{
  return std::ptrdiff_t(a) * (a + 1) / 2 + b;
}

// Which nodes of a coarse space are coupled: those that move vertices of one cell, or of one column
// of the Laplacian. Cells and columns belong to groups, those next to each node.
struct Coarse_pattern
{
  Index_lists cells; // of each group
  Index_lists nodes; // those that the cells and columns of each group couple
  Index_lists rows;  // for each node itself and the later ones that it is coupled with, in order
  bool is_sparse = true; // else there are no lists: the matrix would take too much memory

  Coarse_pattern(const Coarse_transfer& transfer, const Deformation_energy& energy,
                 const Sparse_matrix& laplacian)
  {
    const Coarse_space& space = transfer.space();
    const auto m = static_cast<std::size_t>(space.number_of_nodes());
    const Index_lists cells_near = find_cells(space, energy);
    std::vector<Group> groups(m);
    for_each_block(m, [&](std::size_t begin, std::size_t end) {
      Group_nodes found(space);
      Covariance_coefficients coefficients;
      for(std::size_t k = begin; k < end; ++k)
      {
        const int group = static_cast<int>(k);
        for(int v : transfer.vertices_of(group))
        {
          for(Sparse_matrix::InnerIterator entry(laplacian, v); entry; ++entry)
            found.add_vertex(static_cast<int>(entry.row()));
          groups[k].is_sparse &= found.size() <= most_nodes_of_column;
          found.couple(groups[k], most_nodes_of_column);
        }
        for(int i = cells_near.begin[group]; i < cells_near.begin[group + 1]; ++i)
        {
          energy.coefficients(cells_near.items[i], coefficients);
          for(int v : coefficients.vertices)
            found.add_vertex(v);
          if(found.couple(groups[k], most_nodes_of_cell))
            groups[k].cells.push_back(cells_near.items[i]);
        }
        found.clear(groups[k]);
      }
    }, m / 16 + 1); // each block has an array of all nodes
    is_sparse = std::all_of(groups.begin(), groups.end(),
                            [](const Group& group) { return group.is_sparse; });
    if(is_sparse)
      append_lists(groups);
  }

private:
  // A cell with more nodes is left out, which only makes the matrix stiffer: where many cells are
  // one rigid part, it would become dense.
  static constexpr std::size_t most_nodes_of_cell = 24;

  // Without a column the matrix would be too soft. A vertex with so many neighbors that it couples
  // more nodes, as the apex of a large fan, leaves no matrix.
  static constexpr std::size_t most_nodes_of_column = 256;

  struct Group
  {
    Array<int> cells, nodes;
    Array<char> is_coupled; // for each pair of places in `nodes`
    bool is_sparse = true;
  };

  // the nodes of one cell or column after the other, in groups
  class Group_nodes
  {
  public:
    explicit Group_nodes(const Coarse_space& space)
      : m_space(space), m_place(space.number_of_nodes(), unknown),
        m_is_found(space.number_of_nodes(), false)
    {}

    void add_vertex(int v)
    {
      if(v < m_space.number_of_vertices() && m_space.has_nodes(v))
        for(int k = 0; k < Coarse_space::most_nodes; ++k)
          if(const int node = m_space.nodes(v)[k]; !m_is_found[node])
          {
            m_is_found[node] = true;
            m_found.push_back(node);
          }
    }

    // the number of nodes of the vertices that were added since the last call
    std::size_t size() const { return m_found.size(); }

    // Couples them, unless there are none, or more than this.
    bool couple(Group& group, std::size_t most)
    {
      const bool are_few = !m_found.empty() && m_found.size() <= most;
      for(int& node : m_found)
      {
        m_is_found[node] = false;
        if(are_few)
          node = place(node, group);
      }
      if(are_few)
        for(int a : m_found)
          for(int b : m_found)
            if(a >= b)
              group.is_coupled[place_of_pair(a, b)] = true;
      m_found.clear();
      return are_few;
    }

    void clear(const Group& group) // before the next one
    {
      for(int node : group.nodes)
        m_place[node] = unknown;
    }

  private:
    static constexpr int unknown = -1;

    int place(int node, Group& group)
    {
      if(m_place[node] == unknown)
      {
        m_place[node] = static_cast<int>(group.nodes.size());
        group.nodes.push_back(node);
        group.is_coupled.resize(group.is_coupled.size() + group.nodes.size(), false);
      }
      return m_place[node];
    }

    const Coarse_space& m_space;
    Array<int> m_place;     // of each node in those of the group
    Array<char> m_is_found; // for each node
    Array<int> m_found;
  };

  // each cell is in the group of the node next to one of its vertices
  static Index_lists find_cells(const Coarse_space& space, const Deformation_energy& energy)
  {
    Index_lists node_of;
    Covariance_coefficients coefficients;
    for(int c = 0; c < energy.number_of_cells(); ++c)
    {
      energy.coefficients(c, coefficients);
      const auto found =
        std::find_if(coefficients.vertices.begin(), coefficients.vertices.end(), [&](int v) {
          return v < space.number_of_vertices() && space.has_nodes(v);
        });
      if(found != coefficients.vertices.end())
        node_of.items.push_back(space.nodes(*found)[0]);
      node_of.end_list();
    }
    return lists_with(node_of, space.number_of_nodes());
  }

  void append_lists(const std::vector<Group>& groups)
  {
    std::vector<Array<int>> rows_of(groups.size());
    for(const Group& group : groups)
    {
      append(group.cells, cells);
      append(group.nodes, nodes);
      for(int a = 0; a < static_cast<int>(group.nodes.size()); ++a)
        for(int b = 0; b <= a; ++b)
          if(group.is_coupled[place_of_pair(a, b)])
          {
            const auto [column, row] = std::minmax({group.nodes[a], group.nodes[b]});
            rows_of[static_cast<std::size_t>(column)].push_back(row);
          }
    }
    for(Array<int>& list : rows_of)
    {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      append(list, rows);
    }
  }

  static void append(const Array<int>& list, Index_lists& lists)
  {
    lists.items.insert(lists.items.end(), list.begin(), list.end());
    lists.end_list();
  }
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_PATTERN_H
