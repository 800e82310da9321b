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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_SPACE_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_SPACE_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/Array.h>
#include <CGAL/ARAP_deformation/internal/region/Index_lists.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Nodes, which are vertices that are spread evenly over the graph of a matrix, and for each vertex
// the nodes next to it, with weights that add up to one and fade with the distance. A distance is a
// number of edges: what the energy makes of a wave depends on its length in edges.
class Coarse_space
{
public:
  static constexpr int most_nodes = 3; // of a vertex; a fourth makes a surface no faster

  // from the lower triangle of a matrix
  explicit Coarse_space(const Sparse_matrix& matrix)
  {
    const Index_lists graph = graph_of(matrix);
    choose_nodes(graph, {}, 300); // balls overlap: about a hundred vertices for each node
    weigh_nodes(graph);
  }

  // From the neighbours of each vertex, with balls of so many vertices; with smaller ones around
  // those that come first, which are on a boundary and few.
  Coarse_space(const Index_lists& graph, const Array<char>& comes_first,
               std::size_t vertices_of_a_ball)
  {
    constexpr std::size_t vertices_of_a_star = 7;
    choose_nodes(graph, comes_first, vertices_of_a_star);
    choose_nodes(graph, {}, vertices_of_a_ball);
    weigh_nodes(graph);
  }

  int number_of_nodes() const { return static_cast<int>(m_vertices.size()); }
  int number_of_vertices() const { return static_cast<int>(m_nodes.size()) / most_nodes; }
  int vertex_of(int node) const { return m_vertices[node]; }

  // The nodes of a vertex, the next one first, and their weights: 0 if it has fewer nodes, or none.
  const int* nodes(int v) const { return m_nodes.data() + most_nodes * std::ptrdiff_t(v); }
  const float* weights(int v) const { return m_weights.data() + most_nodes * std::ptrdiff_t(v); }
  bool has_nodes(int v) const { return weights(v)[0] > 0; }

private:
  static Index_lists graph_of(const Sparse_matrix& matrix)
  {
    const int n = static_cast<int>(matrix.cols());
    return lists_of_pairs(n, [&](const auto& f) {
      for(int j = 0; j < n; ++j)
        for(Sparse_matrix::InnerIterator entry(matrix, j); entry; ++entry)
          if(const int i = static_cast<int>(entry.row()); i != j && entry.value() != 0)
          {
            f(i, j);
            f(j, i);
          }
    });
  }

  // A vertex is a node if it is not in the ball around any node before it; of some only, if any are
  // chosen.
  void choose_nodes(const Index_lists& graph, const Array<char>& is_chosen,
                    std::size_t vertices_of_a_ball)
  {
    Array<char> is_in_ball(graph.size(), false);
    Array<int> last_node(graph.size(), -1), ball;
    const auto cover = [&](int node) {
      ball.assign(1, m_vertices[node]);
      last_node[m_vertices[node]] = node;
      for(std::size_t k = 0; k < ball.size() && ball.size() < vertices_of_a_ball; ++k)
        for(int e = graph.begin[ball[k]]; e < graph.begin[ball[k] + 1]; ++e)
          if(const int i = graph.items[e]; last_node[i] != node)
          {
            last_node[i] = node;
            ball.push_back(i);
          }
      for(int i : ball)
        is_in_ball[i] = true;
    };
    for(int node = 0; node < number_of_nodes(); ++node)
      cover(node);
    for(int v = 0; v < graph.size(); ++v)
      if(!is_in_ball[v] && graph.begin[v] != graph.begin[v + 1] &&
         (is_chosen.empty() || is_chosen[v]))
      {
        m_vertices.push_back(v);
        cover(number_of_nodes() - 1);
      }
  }

  // The weights are (1 - d / D)^2, D a little more than the distance of one node more.
  void weigh_nodes(const Index_lists& graph)
  {
    struct Label { int node = -1, distance = 0; };
    constexpr int most_labels = most_nodes + 1;
    const int n = graph.size();
    Array<Label> labels(n * most_labels);
    const auto add_label = [&](int v, const Label& added) { // unless it has it, or enough others
      Label* label = labels.data() + most_labels * std::ptrdiff_t(v);
      for(Label* const end = label + most_labels; label != end; ++label)
        if(label->node < 0)
        {
          *label = added;
          return true;
        }
        else if(label->node == added.node)
          break;
      return false;
    };
    Array<std::pair<int, int>> front, next; // vertices, with the node that they are reached from
    for(int node = 0; node < number_of_nodes(); ++node)
    {
      add_label(m_vertices[node], {node, 0});
      front.emplace_back(m_vertices[node], node);
    }
    for(int distance = 1; !front.empty(); ++distance)
    {
      next.clear();
      for(const auto& [v, node] : front)
        for(int e = graph.begin[v]; e < graph.begin[v + 1]; ++e)
          if(add_label(graph.items[e], {node, distance}))
            next.emplace_back(graph.items[e], node);
      front.swap(next);
    }

    m_nodes = Array<int>(n * most_nodes);
    m_weights = Array<float>(n * most_nodes, 0);
    for(int v = 0; v < n; ++v)
    {
      const Label* const label = labels.data() + most_labels * std::ptrdiff_t(v);
      int count = 0;
      while(count < most_labels && label[count].node >= 0)
        ++count;
      const double reach = count == 0 ? 1 : label[count - 1].distance +
                                            (count < most_labels ? 1 : 0.5); // never all zero
      double weights[most_nodes] = {}, sum = 0;
      for(int k = 0; k < count && k < most_nodes; ++k)
      {
        const double w = 1 - label[k].distance / reach;
        weights[k] = w * w;
        sum += weights[k];
      }
      for(int k = 0; k < most_nodes && count > 0; ++k)
      {
        m_nodes[most_nodes * v + k] = label[k < count ? k : 0].node;
        m_weights[most_nodes * v + k] = static_cast<float>(weights[k] / sum);
      }
    }
  }

  Array<int> m_vertices; // of the nodes
  Array<int> m_nodes;    // of the vertices
  Array<float> m_weights;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_COARSE_COARSE_SPACE_H
