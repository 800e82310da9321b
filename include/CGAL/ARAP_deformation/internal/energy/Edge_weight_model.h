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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_WEIGHT_MODEL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_WEIGHT_MODEL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/edge_weights.h>
#include <CGAL/ARAP_deformation/flat_types.h>
#include <CGAL/ARAP_deformation/internal/energy/edge_weight_requirements.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

// A model of ARAPEdgeWeight as the numeric core calls it, which is not a template. Vertices are
// told by their points and by their indices in the mesh.
class Edge_weight_model
{
public:
  using Triangle = std::array<Coordinates, 3>;
  using Tetrahedron = std::array<Coordinates, 4>;

  virtual ~Edge_weight_model() = default;
  virtual std::array<double, 3> triangle(const Triangle& points,
                                         const std::array<std::size_t, 3>& indices) const = 0;
  virtual std::array<double, 6> tetrahedron(const Tetrahedron& points) const = 0;
  virtual double edge(Edge_set edge_set, std::size_t i, std::size_t j, double sum) const = 0;

  // whether those of triangles and tetrahedra come from their shapes, with no negative energy
  virtual bool are_of_shapes() const = 0;

  // changes when the weights do
  virtual std::size_t version() const = 0;
};

template <typename Weight>
using Call_version = decltype(std::declval<const Weight&>().version());

// what `Weight` inherits from Cotangent_weight, and does not define itself
template <typename Weight, std::size_t N>
using Inherited_weights_of = std::integral_constant<
  std::array<double, N * (N - 1) / 2> (Cotangent_weight::*)(const std::array<Coordinates, N>&)
    const,
  &Weight::simplex_weights>;

template <typename Weight>
using Inherited_weights =
  std::pair<Inherited_weights_of<Weight, 3>, Inherited_weights_of<Weight, 4>>;

template <typename Weight>
using Call_weights_of_halfedges =
  decltype(std::declval<const Weight&>().weights_of_halfedges(std::array<std::size_t, 3>()));

template <typename Weight>
class Edge_weight_model_of : public Edge_weight_model
{
public:
  explicit Edge_weight_model_of(Weight weight) : m_weight(std::move(weight)) {}

  std::array<double, 3> triangle(const Triangle& points,
                                 const std::array<std::size_t, 3>& indices) const override
  {
    if constexpr(is_valid<Call_weights_of_halfedges, Weight>)
      return m_weight.weights_of_halfedges(indices);
    else
      return m_weight.simplex_weights(points);
  }

  // a session of tetrahedra does not compile with a model that lacks these weights
  std::array<double, 6> tetrahedron(const Tetrahedron& points) const override
  {
    if constexpr(is_valid<Call_tetrahedron_weights, Weight>)
      return m_weight.simplex_weights(points);
    else
      return {};
  }

  double edge(Edge_set edge_set, std::size_t i, std::size_t j, double sum) const override
  {
    return m_weight.edge_weight(edge_set, i, j, sum);
  }

  bool are_of_shapes() const override { return is_valid<Inherited_weights, Weight>; }

  std::size_t version() const override
  {
    if constexpr(is_valid<Call_version, Weight>)
      return m_weight.version();
    else
      return 0;
  }

private:
  Weight m_weight;
};

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_ENERGY_EDGE_WEIGHT_MODEL_H
