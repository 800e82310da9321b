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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_FROM_PARAMETERS_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_FROM_PARAMETERS_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/domain/Default_domain.h>
#include <CGAL/ARAP_deformation/internal/has_parameter.h>
#include <CGAL/ARAP_deformation/internal/session/vertex_maps.h>
#include <CGAL/ARAP_deformation/parameters.h>
#include <CGAL/ARAP_deformation_traits.h>

#include <CGAL/Named_function_parameters.h>

#include <type_traits>

namespace CGAL {
namespace ARAP {
namespace internal {

// The domain of a shape that is a domain or a mesh.
template <typename Shape, typename NamedParameters>
auto domain_from_parameters(Shape& shape, const NamedParameters& np)
{
  using Mesh = std::remove_const_t<Shape>;
  using Domain = typename Default_domain<Mesh>::type;
  if constexpr(std::is_same_v<Domain, Face_graph_domain<Mesh>>)
  {
    constexpr bool is_writable = has_parameter<NamedParameters, internal_np::output_point_map_t> ||
                                 has_parameter<NamedParameters, internal_np::vertex_point_t> ||
                                 !std::is_const_v<Shape>;
    static_assert(is_writable, "a const mesh cannot be deformed; give its new points a place by "
                               "the named parameter output_point_map");
    if constexpr(is_writable)
      return make_face_graph_domain(shape, np);
  }
  else
  {
    static_assert(!has_parameter<NamedParameters, internal_np::output_point_map_t> &&
                  !has_parameter<NamedParameters, internal_np::vertex_point_t> &&
                  !has_parameter<NamedParameters, internal_np::vertex_index_t>,
                  "the named parameters output_point_map, vertex_point_map and vertex_index_map "
                  "are for a FaceGraph; a domain or a triangulation has its own points");
    if constexpr(is_domain<Mesh>)
      return Mesh(shape);
    else
      return make_domain<Domain>(shape);
  }
}

template <typename NamedParameters>
auto traits_from_parameters(const NamedParameters& np)
{
  if constexpr(has_parameter<NamedParameters, internal_np::deformation_traits_t>)
    return parameters::get_parameter(np, internal_np::deformation_traits);
  else
  {
    auto weight = parameters::choose_parameter(
      parameters::get_parameter(np, internal_np::weight_calculator), Safe_cotangent_weight());
    auto solver = parameters::choose_parameter(
      parameters::get_parameter(np, internal_np::sparse_linear_solver),
      Multifrontal_cholesky_solver());
    return ARAP_deformation_traits<decltype(solver), decltype(weight)>(solver, weight);
  }
}

// options, but for the number of iterations that is a parameter of its own
template <typename NamedParameters>
Options with_number_of_iterations(Options options, const NamedParameters& np)
{
  options.iterations = static_cast<unsigned int>(parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::number_of_iterations), options.iterations));
  return options;
}

template <typename NamedParameters>
Options options_from_parameters(const NamedParameters& np)
{
  return with_number_of_iterations(
    parameters::choose_parameter(parameters::get_parameter(np, internal_np::deformation_options),
                                 Options()), np);
}

template <typename NamedParameters>
Options options_from_parameters(const NamedParameters& np, const Options& options)
{
  static_assert(!has_parameter<NamedParameters, internal_np::deformation_options_t>,
                "arap_deform: there are two options, an argument and the named parameter "
                "deformation_options");
  return with_number_of_iterations(options, np);
}

// what a map of constrained vertices tells of one of them
template <typename Value, typename Vertex>
bool is_constrained(const Value& value, const Vertex&)
{
  constexpr bool is_told = !std::is_same_v<Value, Vertex> || std::is_arithmetic_v<Vertex>;
  static_assert(is_told, "a vector of vertices tells no vertex whether it is constrained; use a "
                         "set, as [&](auto v) { return set.count(v) > 0; }");
  if constexpr(is_told)
  {
    const bool result = value; // what converts only explicitly is no answer
    return result;
  }
  else
    return false;
}

// inserts the vertices that stay where they are
template <typename Deformation, typename NamedParameters>
void insert_constrained_vertices(Deformation& deformation, const NamedParameters& np)
{
  if constexpr(has_parameter<NamedParameters, internal_np::vertex_is_constrained_t>)
  {
    const auto& map = parameters::get_parameter(np, internal_np::vertex_is_constrained); // a copy
    for(auto v : deformation.domain().vertices())
      with_value(map, v, deformation.domain().index(v), [&](const auto& value) {
        if(is_constrained(value, v)) deformation.insert_control_vertex(v);
      });
  }
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_FROM_PARAMETERS_H
