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
#include <CGAL/ARAP_deformation/internal/Index_lists.h>
#include <CGAL/ARAP_deformation/internal/cholesky/elimination_tree.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// Nodes, which are vertices that are spread evenly over a graph, and for each vertex the nodes that
// are nearest to it, with weights that add up to one and fade with the distance. A distance is a
// number of edges: what the energy makes of a wave depends on its length in edges.
class Coarse_space
{
public:
  static constexpr int most_nodes = 3; // of a vertex; a fourth makes a surface no faster

  // from the lower triangle of a matrix; the points decide in which order vertices become nodes
  Coarse_space(const Sparse_matrix& matrix, const Array<Coordinates>& points)
  {
    const Index_lists graph = neighbors_of_rows(matrix);
    // balls overlap: about a hundred vertices for each node
    choose_nodes(graph, vertices_along_an_axis(graph, points), 300);
    weigh(nearest_nodes(graph));
  }

  // From the neighbors of each vertex, with balls of so many vertices; first from some vertices,
  // with smaller balls.
  Coarse_space(const Index_lists& graph, const Array<Coordinates>& points,
               const Array<char>& comes_first, std::size_t vertices_of_a_ball)
  {
    Array<int> vertices = vertices_along_an_axis(graph, points);
    const auto end_of_first = std::stable_partition(vertices.begin(), vertices.end(),
                                                    [&](int v) { return comes_first[v] != 0; });
    choose_nodes(graph, Array<int>(vertices.begin(), end_of_first), vertices_of_a_ball / 2);
    choose_nodes(graph, Array<int>(end_of_first, vertices.end()), vertices_of_a_ball);
    weigh(nearest_nodes(graph));
  }

  int number_of_nodes() const { return static_cast<int>(m_vertices.size()); }
  int number_of_vertices() const { return static_cast<int>(m_nodes.size()) / most_nodes; }
  int vertex_of(int node) const { return m_vertices[node]; }

  // The nodes of a vertex, the nearest one first, and their weights: 0 where it has fewer.
  const int* nodes(int v) const { return m_nodes.data() + most_nodes * std::ptrdiff_t(v); }
  const float* weights(int v) const { return m_weights.data() + most_nodes * std::ptrdiff_t(v); }
  bool has_nodes(int v) const { return weights(v)[0] > 0; }

private:
  struct Label { int node = -1, distance = 0; };
  static constexpr int most_labels = most_nodes + 1;

  // Those with neighbors, in an order that does not depend on their numbers, unless two are at the
  // same point.
  static Array<int> vertices_along_an_axis(const Index_lists& graph,
                                           const Array<Coordinates>& points)
  {
    Array<int> vertices;
    for(int v = 0; v < graph.size(); ++v)
      if(graph.begin[v] != graph.begin[v + 1])
        vertices.push_back(v);
    std::sort(vertices.begin(), vertices.end(), [&](int a, int b) {
      return points[a] != points[b] ? points[a] < points[b] : a < b;
    });
    return vertices;
  }

  // A vertex is a node if it is not in the ball around any node before it. A ball grows by rings,
  // which do not depend on the order of neighbors: by those of the node, and then by all vertices
  // with two neighbors in it, which makes it round. The neighbors of a hub, which has far more than
  // a ball, are not walked for each ball there; as it then is no neighbor, one other is enough.
  void choose_nodes(const Index_lists& graph, const Array<int>& vertices,
                    std::size_t vertices_of_a_ball)
  {
    struct Link { int node = -1, vertex = -1; };
    Array<char> is_in_ball(graph.size(), false);
    Array<int> last_node(graph.size(), -1), ball;
    Array<Link> links(graph.size()); // from the ball of a node to vertices that are not in it
    const auto is_hub = [&](int v) {
      return std::size_t(graph.begin[v + 1] - graph.begin[v]) > 10 * vertices_of_a_ball;
    };
    const auto cover = [&](int node) {
      ball.assign(1, m_vertices[node]);
      last_node[m_vertices[node]] = node;
      bool has_hub = false;
      for(std::size_t k = 0, end = 1; k < ball.size() && ball.size() < vertices_of_a_ball;
          end = ball.size())
      {
        has_hub = has_hub || std::any_of(ball.begin() + std::ptrdiff_t(k), ball.end(), is_hub);
        for(; k < end; ++k)
        {
          if(k > 0 && is_hub(ball[k]))
            continue;
          for(int e = graph.begin[ball[k]]; e < graph.begin[ball[k] + 1]; ++e)
          {
            const int i = graph.items[e];
            if(last_node[i] == node)
              continue;
            if(k > 0 && !has_hub && (links[i].node != node || links[i].vertex == ball[k]))
            {
              links[i] = {node, ball[k]};
              continue;
            }
            last_node[i] = node;
            ball.push_back(i);
          }
        }
      }
      for(int i : ball)
        is_in_ball[i] = true;
    };
    for(int node = 0; node < number_of_nodes(); ++node)
      cover(node);
    for(int v : vertices)
      if(!is_in_ball[v])
      {
        m_vertices.push_back(v);
        cover(number_of_nodes() - 1);
      }
  }

  // For each vertex the nearest nodes, in ascending order of distances; of nodes at the same
  // distance the first ones.
  Array<Label> nearest_nodes(const Index_lists& graph) const
  {
    Array<Label> labels(graph.size() * most_labels);
    const auto labels_of = [&](int v) { return labels.data() + most_labels * std::ptrdiff_t(v); };
    // Unless it has it or nearer ones; a later node at the same distance may lose its place.
    const auto add_label = [&](int v, const Label& added) {
      Label* place = labels_of(v);
      Label* const end = place + most_labels;
      const auto comes_first = [&](const Label& label) {
        return label.node >= 0 &&
               (label.distance < added.distance || label.node <= added.node);
      };
      if(comes_first(end[-1])) // most often, all others do
        return false;
      for(; comes_first(*place); ++place)
        if(place->node == added.node)
          return false;
      std::move_backward(place, end - 1, end);
      *place = added;
      return true;
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
        if(const Label* const begin = labels_of(v);
           std::any_of(begin, begin + most_labels,
                       [node = node](const Label& label) { return label.node == node; }))
          for(int e = graph.begin[v]; e < graph.begin[v + 1]; ++e)
            if(add_label(graph.items[e], {node, distance}))
              next.emplace_back(graph.items[e], node);
      front.swap(next);
    }
    return labels;
  }

  // The weights are (1 - d / D)^2, where D is half an edge more than the distance of the next node,
  // a fourth one, or one edge more than that of the last if there are no four.
  void weigh(const Array<Label>& labels)
  {
    const int n = static_cast<int>(labels.size()) / most_labels;
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
