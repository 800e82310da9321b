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

#ifndef CGAL_ARAP_DEFORM_H
#define CGAL_ARAP_DEFORM_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Default_visitor.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/internal/domain/Default_domain.h>
#include <CGAL/ARAP_deformation_traits.h>

#include <CGAL/Named_function_parameters.h>

#include <type_traits>

namespace CGAL {

namespace ARAP {
namespace internal {

// the domain of a shape that is a domain or a mesh; the named parameters apply to a FaceGraph
template <typename Shape, typename NamedParameters>
auto make_domain_with_parameters(Shape& shape, const NamedParameters& np)
{
  using Domain = typename Default_domain<std::remove_const_t<Shape>>::type;
  if constexpr(std::is_same_v<Domain, Face_graph_domain<std::remove_const_t<Shape>>>)
  {
    static_assert(!std::is_const_v<Shape>,
                  "arap_deform: a const mesh cannot be deformed; pass a domain with an output "
                  "point map instead");
    return make_face_graph_domain(shape, np);
  }
  else if constexpr(Is_domain<std::remove_const_t<Shape>>::value)
    return std::remove_const_t<Shape>(shape);
  else
    return make_domain<Domain>(shape);
}

} // namespace internal
} // namespace ARAP

/// \ingroup PkgARAPDeformationRef
/// \brief deforms a shape as rigidly as possible, in one call.
///
/// Moves the constrained vertices to their targets, and all others with them. To deform part of a
/// mesh, to move the targets repeatedly, or to have soft targets, use the class `ARAP_deformation`.
///
/// \tparam Shape a mesh as the template parameter `Mesh` of `ARAP_deformation`, or a model of
///         `ARAPDomain`
/// \tparam VertexConstrainedMap a model of `ReadablePropertyMap` from vertices to `bool`
/// \tparam VertexTargetMap a model of `ReadablePropertyMap` from vertices to points
/// \tparam NamedParameters a sequence of named parameters
///
/// \param shape the shape; as passed, it is the rest shape
/// \param constrained tells which vertices are constrained to their targets
/// \param targets the target of each constrained vertex; for one that stays, its own point
/// \param options the run-time options
/// \param np an optional sequence of named parameters among those below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{the points of the vertices of a `FaceGraph`, read and written; ignored
///                          for other shapes, whose domain defines the points}
///     \cgalParamType{a model of `ReadWritePropertyMap`}
///     \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_index_map}
///     \cgalParamDescription{a unique index for each vertex of a `FaceGraph`, starting from 0;
///                          ignored for other shapes}
///     \cgalParamType{a model of `ReadablePropertyMap` with an integral value type}
///     \cgalParamDefault{the initialized index map of the mesh}
///   \cgalParamNEnd
///   \cgalParamNBegin{number_of_iterations}
///     \cgalParamDescription{the maximum number of iterations}
///     \cgalParamType{unsigned int}
///     \cgalParamDefault{`options.iterations`}
///   \cgalParamNEnd
///   \cgalParamNBegin{visitor}
///     \cgalParamDescription{is called at each iterate and may stop or cancel the run; copied
///                          unless passed as `std::ref(visitor)`}
///     \cgalParamType{a model of `ARAPDeformationVisitor`}
///     \cgalParamDefault{`ARAP::Default_visitor`}
///   \cgalParamNEnd
///   \cgalParamNBegin{weight_calculator}
///     \cgalParamDescription{the weights of the edges}
///     \cgalParamType{a model of `ARAPEdgeWeight`}
///     \cgalParamDefault{`ARAP::Safe_cotangent_weight`}
///   \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver}
///     \cgalParamDescription{the solver}
///     \cgalParamType{a model of `ARAPSparseSolver`}
///     \cgalParamDefault{that of `ARAP_deformation_traits`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \returns a report. If the call fails, the shape is unchanged.
template <typename Shape, typename VertexConstrainedMap, typename VertexTargetMap,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
ARAP::Report arap_deform(Shape&& shape, VertexConstrainedMap constrained,
                         VertexTargetMap targets, const ARAP::Options& options,
                         const CGAL_NP_CLASS& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  using parameters::get_parameter_reference;

  auto weight = choose_parameter(get_parameter(np, internal_np::weight_calculator),
                                 ARAP::Safe_cotangent_weight());
  auto solver = choose_parameter(get_parameter(np, internal_np::sparse_linear_solver),
                                 ARAP::Multifrontal_cholesky_solver());
  using Traits = ARAP_deformation_traits<decltype(solver), decltype(weight)>;
  using Visitor = typename internal_np::Lookup_named_param_def<
    internal_np::visitor_t, CGAL_NP_CLASS, ARAP::Default_visitor>::reference;

  const auto domain = ARAP::internal::make_domain_with_parameters(shape, np);
  using Domain = std::remove_const_t<decltype(domain)>;
  ARAP_deformation<Domain, Traits> deformation(domain, Traits(solver, weight));
  if(ARAP::Outcome checked = deformation.set_options(options); !checked)
  {
    ARAP::Report report;
    static_cast<ARAP::Outcome&>(report) = checked;
    return report;
  }
  for(auto v : domain.vertices())
  {
    deformation.insert_roi_vertex(v);
    if(!get(constrained, v))
      continue;
    deformation.insert_control_vertex(v);
    deformation.set_target_position(v, get(targets, v));
  }
  ARAP::Default_visitor default_visitor;
  Visitor visitor =
    choose_parameter(get_parameter_reference(np, internal_np::visitor), default_visitor);
  return deformation.deform(choose_parameter(get_parameter(np, internal_np::number_of_iterations),
                                             options.iterations),
                            options.tolerance, visitor);
}

/// \ingroup PkgARAPDeformationRef
/// \brief deforms a shape as rigidly as possible, in one call, with the default options.
///
/// The parameters are those of the overload with `options`.
template <typename Shape, typename VertexConstrainedMap, typename VertexTargetMap,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
ARAP::Report arap_deform(Shape&& shape, VertexConstrainedMap constrained, VertexTargetMap targets,
                         const CGAL_NP_CLASS& np = parameters::default_values())
{
  return arap_deform(shape, constrained, targets, ARAP::Options(), np);
}

} // namespace CGAL

#endif // CGAL_ARAP_DEFORM_H
