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

#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {
namespace internal {

// calls f(h) for each halfedge h whose target is v
template <typename Mesh, typename Function>
void for_each_halfedge_to(typename boost::graph_traits<Mesh>::vertex_descriptor v,
                          const Mesh& mesh, const Function& f)
{
  const auto first = halfedge(v, mesh);
  if(first == boost::graph_traits<Mesh>::null_halfedge()) // an isolated vertex
    return;
  for(const auto h : halfedges_around_target(first, mesh))
    f(h);
}

// reads a point map as points of a kernel with `double`, which is what CGAL's weights compute with
template <typename VertexPointMap>
struct Double_point_map
{
  using category = boost::readable_property_map_tag;
  using key_type = typename boost::property_traits<VertexPointMap>::key_type;
  using value_type = Simple_cartesian<double>::Point_3;
  using reference = value_type;

  VertexPointMap points;

  friend value_type get(const Double_point_map& map, const key_type& v)
  {
    const auto& p = get(map.points, v);
    return value_type(CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]));
  }
};

// A weight for each halfedge of a mesh, as a model of CGAL's SurfaceMeshDeformationWeights computes
// it for the points at the time of construction or of the last recompute_at().
template <typename Mesh, typename HalfedgeIndexMap, typename VertexPointMap,
          typename WeightCalculator>
class Halfedge_weights
{
  using Graph_traits = boost::graph_traits<Mesh>;
  using halfedge_descriptor = typename Graph_traits::halfedge_descriptor;
  using vertex_descriptor = typename Graph_traits::vertex_descriptor;

public:
  Halfedge_weights(Mesh& mesh, HalfedgeIndexMap index_map, VertexPointMap point_map,
                   WeightCalculator calculator)
    : m_mesh(mesh), m_index_map(std::move(index_map)), m_point_map{std::move(point_map)},
      m_calculator(std::move(calculator))
  {
    m_weights.reserve(num_halfedges(mesh));
    for(const halfedge_descriptor h : halfedges(mesh))
      compute(h, m_weights);
  }

  // an upper bound of all indices
  std::size_t size() const { return m_weights.size(); }

  std::size_t index(halfedge_descriptor h) const
  {
    return static_cast<std::size_t>(get(m_index_map, h));
  }

  double operator[](halfedge_descriptor h) const { return m_weights[index(h)]; }

  // Computes those of all halfedges that a vertex of the range is an end of. None of them changes
  // if the user's calculator throws.
  template <typename VertexRange, typename IsInRange>
  void recompute_at(const VertexRange& vertices, const IsInRange& is_in_range)
  {
    std::vector<double> weights = m_weights;
    for(const vertex_descriptor v : vertices)
      for_each_halfedge_to(v, m_mesh, [&](halfedge_descriptor h) {
        compute(h, weights);
        if(!is_in_range(source(h, m_mesh)))
          compute(opposite(h, m_mesh), weights);
      });
    m_weights.swap(weights);
  }

private:
  void compute(halfedge_descriptor h, std::vector<double>& weights)
  {
    const double weight = m_calculator(h, m_mesh, m_point_map);
    const std::size_t i = index(h);
    if(i >= weights.size()) // where halfedges were removed, indices exceed the number
      weights.resize(i + 1, 0);
    weights[i] = weight;
  }

  Mesh& m_mesh;
  HalfedgeIndexMap m_index_map;
  Double_point_map<VertexPointMap> m_point_map;
  WeightCalculator m_calculator;
  std::vector<double> m_weights;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DROP_IN_HALFEDGE_WEIGHTS_H
