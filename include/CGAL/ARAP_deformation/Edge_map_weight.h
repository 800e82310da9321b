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

#ifndef CGAL_ARAP_DEFORMATION_EDGE_MAP_WEIGHT_H
#define CGAL_ARAP_DEFORMATION_EDGE_MAP_WEIGHT_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/domain/index_map_of.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/functional/hash.hpp>
#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <unordered_map>
#include <utility>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationWeights
/// \brief user-defined weights, one for each edge, independent of the geometry.
///
/// An edge has the same weight in every edge set that it belongs to: in the stars of both its
/// vertices, or in each incident simplex. Edges without a weight have weight 0, and so have
/// diagonals of polygons, unless one is set for their ends. If no weight is negative, no cell has a
/// negative energy. Copies share the weights: those that are set later count from the next
/// `deform()` on.
///
/// \cgalModels{ARAPEdgeWeight}
///
/// \sa `make_edge_map_weight()`
class Edge_map_weight
{
public:
  /// has no weights.
  Edge_map_weight() = default;

  /// shares the weights of another one, which keeps them when it is moved from, too.
  Edge_map_weight(const Edge_map_weight&) = default;

  /// shares the weights of another one, which keeps them when it is moved from, too.
  Edge_map_weight& operator=(const Edge_map_weight&) = default;

  /// sets the weight, in both directions, of the edge between the vertices with the indices `i` and
  /// `j` in the domain.
  void set_weight(std::size_t i, std::size_t j, double weight)
  {
    m_weights->of_edge[std::minmax(i, j)] = weight;
    ++m_weights->version;
  }

  /// returns a number that changes with each call of `set_weight()`, for this object or a copy.
  std::size_t version() const { return m_weights->version; }

  /// returns zeros.
  std::array<double, 3> simplex_weights(const std::array<Coordinates, 3>&) const { return {}; }

  /// returns zeros.
  std::array<double, 6> simplex_weights(const std::array<Coordinates, 4>&) const { return {}; }

  /// returns the weight that was set for the edge, or 0.
  double edge_weight(Edge_set, std::size_t i, std::size_t j, double) const
  {
    const auto found = m_weights->of_edge.find(std::minmax(i, j));
    return found == m_weights->of_edge.end() ? 0 : found->second;
  }

private:
  using Edge = std::pair<std::size_t, std::size_t>; // the smaller index first

  struct Weights
  {
    std::unordered_map<Edge, double, boost::hash<Edge>> of_edge;
    std::size_t version = 0;
  };

  std::shared_ptr<Weights> m_weights = std::make_shared<Weights>();
};

/// \ingroup PkgARAPDeformationWeights
/// \brief returns the weights given by a property map on the edges of a mesh. Linear time.
///
/// \param mesh a model of `EdgeListGraph` and `VertexListGraph`
/// \param edge_weight_map a model of `ReadablePropertyMap` from edges to numbers
/// \param np an optional sequence of named parameters among those below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_index_map}
///     \cgalParamDescription{a unique index for each vertex: the same as that of the domain}
///     \cgalParamType{a model of `ReadablePropertyMap` with an integral value type}
///     \cgalParamDefault{the initialized index map of the mesh}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <typename Graph, typename EdgeWeightMap,
          typename NamedParameters = parameters::Default_named_parameters>
Edge_map_weight make_edge_map_weight(const Graph& mesh, EdgeWeightMap edge_weight_map,
                                     const NamedParameters& np = parameters::default_values())
{
  Edge_map_weight weight;
  const auto index_map = internal::index_map_of(mesh, np);
  const auto index_of = [&](auto v) { return static_cast<std::size_t>(get(index_map, v)); };
  for(auto edge : edges(mesh))
    weight.set_weight(index_of(source(edge, mesh)), index_of(target(edge, mesh)),
                      get(edge_weight_map, edge));
  return weight;
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_EDGE_MAP_WEIGHT_H
