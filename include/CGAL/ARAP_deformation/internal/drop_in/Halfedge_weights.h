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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_HALFEDGE_WEIGHTS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_HALFEDGE_WEIGHTS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// reads a point map as points of a kernel with `double`, which is what CGAL's weights compute with
template <typename VertexPointMap>
struct Double_point_map
{
  using category = boost::readable_property_map_tag;
  using key_type = typename boost::property_traits<VertexPointMap>::key_type;
  using value_type = Simple_cartesian<double>::Point_3;
  using reference = value_type;

  VertexPointMap points;

  // what functions of users may do with a map
  operator const VertexPointMap&() const { return points; }
  decltype(auto) operator[](const key_type& v) const { return points[v]; }

  friend value_type get(const Double_point_map& map, const key_type& v)
  {
    const auto& p = get(map.points, v);
    return value_type(CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]));
  }
};

// A model of ARAPEdgeWeight: a weight for each halfedge of a mesh, as a model of CGAL's
// SurfaceMeshDeformationWeights computes it for the points at the time of construction or of the
// last take_over(). Copies share the weights. The mesh is not copied.
template <typename Mesh, typename VertexIndexMap, typename HalfedgeIndexMap,
          typename VertexPointMap, typename WeightCalculator>
class Halfedge_weights
{
  using Graph_traits = boost::graph_traits<Mesh>;
  using halfedge_descriptor = typename Graph_traits::halfedge_descriptor;
  using vertex_descriptor = typename Graph_traits::vertex_descriptor;

public:
  Halfedge_weights(Mesh& mesh, const VertexIndexMap& vertex_index_map, HalfedgeIndexMap index_map,
                   VertexPointMap point_map, WeightCalculator calculator)
    : m_state(std::make_shared<State>(
        State{mesh, std::move(index_map), {std::move(point_map)}, std::move(calculator), {}, {}}))
  {
    for(const vertex_descriptor v : vertices(mesh))
    {
      const std::size_t index = get(vertex_index_map, v);
      if(index >= m_state->vertices.size())
        m_state->vertices.resize(index + 1, Graph_traits::null_vertex());
      m_state->vertices[index] = v;
    }
    m_state->weights.reserve(num_halfedges(mesh));
    for(const halfedge_descriptor h : halfedges(mesh))
    {
      const auto [index, weight] = computed(h);
      if(index >= m_state->weights.size()) // where some were removed, indices exceed the number
        m_state->weights.resize(index + 1, 0);
      m_state->weights[index] = weight;
    }
  }

  // The weights of the edges (0, 1), (0, 2) and (1, 2) of the triangle with these vertices in the
  // order of its face: those of its halfedges. For stars, whose faces may have more corners, they
  // only have to be finite.
  std::array<double, 3> weights_of_halfedges(const std::array<std::size_t, 3>& indices) const
  {
    const auto& [a, b, c] = indices;
    for(const halfedge_descriptor h : halfedges_to(b))
      if(source(h, m_state->mesh) == m_state->vertices[a] && !is_border(h, m_state->mesh) &&
         target(next(h, m_state->mesh), m_state->mesh) == m_state->vertices[c])
        return {weight(h), weight(prev(h, m_state->mesh)), weight(next(h, m_state->mesh))};
    return {0, 0, 0};
  }

  // of a simplex `sum`; of a star the weight of the halfedge from j to its center i
  double edge_weight(Edge_set edge_set, std::size_t i, std::size_t j, double sum) const
  {
    if(edge_set == Edge_set::simplex)
      return sum;
    double result = 0; // there may be more than one such halfedge
    for(const halfedge_descriptor h : halfedges_to(i))
      if(source(h, m_state->mesh) == m_state->vertices[j])
        result += weight(h);
    return result;
  }

  // the weight of a halfedge, with its index
  using Indexed_weight = std::pair<std::size_t, double>;

  // Returns the weights of the halfedges that a vertex of the range is an end of, computed again.
  // This may throw, what takes them over does not.
  template <typename VertexRange, typename IsInRange>
  std::vector<Indexed_weight> recomputed_at(const VertexRange& range,
                                            const IsInRange& is_in_range) const
  {
    std::vector<Indexed_weight> weights;
    for(const vertex_descriptor v : range)
      for(const halfedge_descriptor h : CGAL::halfedges_around_target(v, m_state->mesh))
      {
        weights.push_back(computed(h));
        if(!is_in_range(source(h, m_state->mesh)))
          weights.push_back(computed(opposite(h, m_state->mesh)));
      }
    return weights;
  }

  void take_over(const std::vector<Indexed_weight>& weights) noexcept
  {
    for(const auto& [index, weight] : weights)
      m_state->weights[index] = weight;
  }

private:
  struct State
  {
    Mesh& mesh;
    HalfedgeIndexMap index_map;
    Double_point_map<VertexPointMap> point_map;
    WeightCalculator calculator;
    std::vector<vertex_descriptor> vertices; // by their indices
    std::vector<double> weights;             // by the indices of the halfedges
  };

  auto halfedges_to(std::size_t index) const
  {
    return CGAL::halfedges_around_target(m_state->vertices[index], m_state->mesh);
  }

  double weight(halfedge_descriptor h) const
  {
    return m_state->weights[static_cast<std::size_t>(get(m_state->index_map, h))];
  }

  Indexed_weight computed(halfedge_descriptor h) const
  {
    return {static_cast<std::size_t>(get(m_state->index_map, h)),
            m_state->calculator(h, m_state->mesh, m_state->point_map)};
  }

  std::shared_ptr<State> m_state;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_HALFEDGE_WEIGHTS_H
