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

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_DEFORM_IN_ONE_CALL_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_DEFORM_IN_ONE_CALL_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Default_visitor.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/internal/domain/is_in_domain.h>
#include <CGAL/ARAP_deformation/internal/has_parameter.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>
#include <CGAL/ARAP_deformation/internal/session/from_parameters.h>
#include <CGAL/ARAP_deformation/internal/session/vertex_maps.h>
#include <CGAL/ARAP_deformation/parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <cstddef>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {
namespace internal {

template <typename Range>
using Pair_of = decltype(std::begin(std::declval<const Range&>())->second);

// Calls a function for each element of a range. The outcome is that of the first one that is
// refused, and names it.
template <typename Range, typename Function>
Outcome for_each_element(const Range& range, const std::string& name, const Function& function)
{
  std::size_t k = 0;
  for(const auto& element : range)
  {
    if(Outcome outcome = function(element); !outcome)
    {
      outcome.message = "element " + std::to_string(k) + " of " + name + ": " + outcome.message;
      return outcome;
    }
    ++k;
  }
  return Outcome(Status::success, "");
}

// `insert(deformation, insert_target)` makes the control vertices, by `insert_target(v)` those with
// a target
template <typename Shape, typename NamedParameters, typename Function>
Report deform_in_one_call(Shape& shape, const Options& options, const NamedParameters& np,
                          const Function& insert)
{
  using parameters::get_parameter;
  using Visitor =
    typename internal_np::Lookup_named_param_def<internal_np::visitor_t, NamedParameters,
                                                 Default_visitor>::reference;
  const auto domain = domain_from_parameters(shape, np);
  const auto traits = traits_from_parameters(np);
  ARAP_deformation<std::remove_const_t<decltype(domain)>, std::remove_const_t<decltype(traits)>>
    deformation(domain, traits);
  Report report;
  static_cast<Outcome&>(report) = deformation.set_options(options);
  if(!report)
    return report;
  if constexpr(has_parameter<NamedParameters, internal_np::region_of_interest_t>)
    deformation.insert_roi_vertices(get_parameter(np, internal_np::region_of_interest));
  else
    deformation.insert_roi_vertices(domain.vertices());
  insert_constrained_vertices(deformation, np);
  // a number or a map, which is copied, or none
  [[maybe_unused]] const auto& weight = get_parameter(np, internal_np::target_weight);
  const Outcome no_vertex(Status::not_a_control_vertex, "the mesh has no such vertex");
  const auto insert_target = [&](auto v) {
    if(!is_vertex_of(domain, v))
      return no_vertex;
    Outcome outcome(Status::success, "");
    deformation.insert_control_vertex(v);
    if constexpr(has_number<NamedParameters, internal_np::target_weight_t>)
      outcome = deformation.set_target_weight(v, weight);
    else if constexpr(has_parameter<NamedParameters, internal_np::target_weight_t>)
      with_value(weight, v, domain.index(v),
                 [&](double w) { outcome = deformation.set_target_weight(v, w); });
    return outcome;
  };
  Outcome& outcome = report;
  outcome = insert(deformation, insert_target);
  if constexpr(has_parameter<NamedParameters, internal_np::target_sets_t>)
    if(outcome)
      outcome = for_each_element(
        get_parameter(np, internal_np::target_sets), "target_sets", [&](const auto& element) {
          const auto& [v, projection] = element;
          const Outcome inserted = insert_target(v);
          return inserted ? deformation.set_target_set(v, projection) : inserted;
        });
  if constexpr(has_parameter<NamedParameters, internal_np::target_rotations_t>)
    if(outcome)
      outcome = for_each_element(
        get_parameter(np, internal_np::target_rotations), "target_rotations",
        [&](const auto& element) {
          const auto& [v, rotation] = element;
          return is_vertex_of(domain, v) ? deformation.set_target_rotation(v, rotation) : no_vertex;
        });
  if constexpr(has_parameter<NamedParameters, internal_np::control_points_t>)
    if(outcome)
      outcome = for_each_element(
        get_parameter(np, internal_np::control_points), "control_points",
        [&](const auto& element) -> Outcome {
          const auto& [simplex, coordinates, target] = element;
          const Control_point_insertion inserted =
            deformation.insert_control_point(simplex, coordinates);
          if(!inserted)
            return inserted;
          deformation.set_target_position(inserted.point, target);
          if constexpr(has_number<NamedParameters, internal_np::target_weight_t>)
            return deformation.set_target_weight(inserted.point, weight);
          else
            return inserted;
        });
  if(!outcome)
    return report;
  if constexpr(has_parameter<NamedParameters, internal_np::cell_stiffness_t>)
    deformation.set_stiffness(get_parameter(np, internal_np::cell_stiffness));
  if constexpr(has_parameter<NamedParameters, internal_np::cell_groups_t>)
    deformation.set_groups(get_parameter(np, internal_np::cell_groups));
  Default_visitor default_visitor;
  Visitor visitor = parameters::choose_parameter(
    parameters::get_parameter_reference(np, internal_np::visitor), default_visitor);
  return deformation.deform(visitor);
}

// makes control vertices of a range of pairs of a vertex and its target
template <typename TargetRange>
auto insert_targets(const TargetRange& targets)
{
  static_assert(is_valid<Pair_of, TargetRange>,
                "arap_deform: the targets must be a range of pairs of a vertex and a point, such "
                "as a std::map");
  return [&targets](auto& deformation, const auto& insert_target) {
    return for_each_element(targets, "the targets", [&](const auto& element) {
      const auto& [v, target] = element;
      Outcome inserted = insert_target(v);
      if(inserted)
        deformation.set_target_position(v, target);
      return inserted;
    });
  };
}

// makes control vertices of those that a map tells are constrained
template <typename VertexConstrainedMap, typename VertexTargetMap>
auto insert_constrained(const VertexConstrainedMap& constrained, const VertexTargetMap& targets)
{
  return [&constrained, &targets](auto& deformation, const auto& insert_target) {
    const auto& domain = deformation.domain();
    Outcome outcome(Status::success, "");
    for(auto v : domain.vertices())
      with_value(constrained, v, domain.index(v), [&](const auto& value) {
        if(!outcome || !is_constrained(value, v))
          return;
        deformation.insert_control_vertex(v);
        with_value(targets, v, domain.index(v), [&](const auto& target) {
          constexpr bool is_point =
            std::is_convertible_v<decltype(target), decltype(domain.point(v))>;
          static_assert(is_point, "arap_deform: the targets must be points of the shape's type");
          outcome = insert_target(v);
          if constexpr(is_point)
            if(outcome)
              deformation.set_target_position(v, target);
        });
      });
    return outcome;
  };
}

} // namespace internal
} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_SESSION_DEFORM_IN_ONE_CALL_H
