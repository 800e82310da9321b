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

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/internal/has_parameter.h>
#include <CGAL/ARAP_deformation/internal/session/deform_in_one_call.h>
#include <CGAL/ARAP_deformation/internal/session/from_parameters.h>
#include <CGAL/ARAP_deformation/parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <type_traits>

namespace CGAL {

/// \ingroup PkgARAPDeformationRef
/// \brief deforms a shape as rigidly as possible, in one call.
///
/// Moves some vertices to their targets, and all others with them:
/// `arap_deform(mesh, std::map{std::pair{v, p}, {w, q}})`. To move the targets repeatedly use the
/// class `ARAP_deformation`.
///
/// \tparam Shape a mesh as the template parameter `Mesh` of `ARAP_deformation`, or a model of
///         `ARAPDomain`
/// \tparam TargetRange a range of pairs of a vertex and a point, such as a `std::map`
/// \tparam NamedParameters a sequence of named parameters
///
/// \param shape the shape; as passed, it is the rest shape
/// \param targets the targets
/// \param np an optional sequence of the named parameters below. Those of this package, which are
///        not known to \cgal, begin it, and have the next one as their second argument:
///        `parameters::region_of_interest(r, parameters::target_weight(w)).visitor(v)`
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_is_constrained_map}
///     \cgalParamDescription{tells which other vertices stay where they are: a property map, a
///                          function object, a map, or a vector by the indices of the vertices,
///                          which throws `std::out_of_range` if it is too short}
///     \cgalParamType{a map from vertices to `bool`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{deformation_options}
///     \cgalParamDescription{the options}
///     \cgalParamType{`ARAP::Options`}
///     \cgalParamDefault{`ARAP::Options()`}
///   \cgalParamNEnd
///   \cgalParamNBegin{region_of_interest}
///     \cgalParamDescription{the region of interest. Constrained vertices are in it anyway}
///     \cgalParamType{a range of vertices}
///     \cgalParamDefault{all vertices; none in the constructors of `ARAP_deformation`}
///   \cgalParamNEnd
///   \cgalParamNBegin{target_weight}
///     \cgalParamDescription{the weight of each target, see
///                           `ARAP_deformation::set_target_weight()`. A number counts for control
///                           points, too; with a map they are hard. Vertices that only
///                           `vertex_is_constrained_map` constrains are hard}
///     \cgalParamType{a number, or a map from vertices to numbers as `vertex_is_constrained_map`}
///     \cgalParamDefault{infinite, also for vertices that a map has no value for}
///   \cgalParamNEnd
///   \cgalParamNBegin{target_sets}
///     \cgalParamDescription{targets that are sets, such as a `std::map<Vertex,
///                           std::function<Point(const Point&)>>`, see
///                           `ARAP_deformation::set_target_set()`. Such a vertex needs no other
///                           target, but a finite `target_weight`}
///     \cgalParamType{a range of pairs of a vertex and a projection}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{control_points}
///     \cgalParamDescription{control points, such as a `std::vector<std::tuple<Simplex,
///                           std::array<double, 3>, Point>>`, see
///                           `ARAP_deformation::insert_control_point()`}
///     \cgalParamType{a range of tuples of a simplex, barycentric coordinates and a target}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{target_rotations}
///     \cgalParamDescription{the rotations that control vertices prescribe, see
///                           `ARAP_deformation::set_target_rotation()`. The vertices have targets,
///                           too}
///     \cgalParamType{a range of pairs of a vertex and a rotation, such as a `std::map`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{cell_stiffness}
///     \cgalParamDescription{the stiffness of cells, see `ARAP_deformation::set_stiffness()`, also
///                           for generic lambdas}
///     \cgalParamType{a map from vertices or simplices to numbers}
///     \cgalParamDefault{1}
///   \cgalParamNEnd
///   \cgalParamNBegin{cell_groups}
///     \cgalParamDescription{the groups of cells that share a rotation, see
///                           `ARAP_deformation::set_groups()`, also for generic lambdas}
///     \cgalParamType{a map from vertices or simplices to integers}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{the points of the vertices of a `FaceGraph`, read and written. Other
///                          shapes, whose domain defines the points, do not take it}
///     \cgalParamType{a model of `ReadWritePropertyMap`}
///     \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_index_map}
///     \cgalParamDescription{a unique index for each vertex of a `FaceGraph`, starting from 0.
///                          Other shapes do not take it}
///     \cgalParamType{a model of `ReadablePropertyMap` with an integral value type}
///     \cgalParamDefault{the initialized index map of the mesh}
///   \cgalParamNEnd
///   \cgalParamNBegin{output_point_map}
///     \cgalParamDescription{where the new points of a `FaceGraph` are written. Only vertices in
///                           the region of interest are written: copy the other points first. The
///                           mesh may be `const`}
///     \cgalParamType{a model of `WritablePropertyMap`}
///     \cgalParamDefault{the vertex point map}
///   \cgalParamNEnd
///   \cgalParamNBegin{number_of_iterations}
///     \cgalParamDescription{the maximum number of iterations}
///     \cgalParamType{unsigned int}
///     \cgalParamDefault{that of the options}
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
///   \cgalParamNBegin{deformation_traits}
///     \cgalParamDescription{the traits; then `weight_calculator` and `sparse_linear_solver` are
///                           ignored}
///     \cgalParamType{a model of `ARAPDeformationTraits`}
///     \cgalParamDefault{`ARAP_deformation_traits` of these two}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \returns a report. If the call fails, the shape is unchanged; `ARAP::Status` lists the failures.
template <typename Shape, typename TargetRange, typename CGAL_NP_TEMPLATE_PARAMETERS>
[[nodiscard]] ARAP::Report arap_deform(Shape&& shape, const TargetRange& targets,
                                       const CGAL_NP_CLASS& np = parameters::default_values())
{
  using namespace ARAP::internal;
  return deform_in_one_call(shape, options_from_parameters(np), np, insert_targets(targets));
}

/// \ingroup PkgARAPDeformationRef
/// \brief deforms a shape as rigidly as possible, in one call, with options.
///
/// The other parameters are those of the overload without `options`. The number of iterations of
/// `np`, if it has one, takes precedence. Passing `deformation_options`, too, is an error of
/// compilation.
template <typename Shape, typename TargetRange, typename CGAL_NP_TEMPLATE_PARAMETERS>
[[nodiscard]] ARAP::Report arap_deform(Shape&& shape, const TargetRange& targets,
                                       const ARAP::Options& options,
                                       const CGAL_NP_CLASS& np = parameters::default_values())
{
  using namespace ARAP::internal;
  return deform_in_one_call(shape, options_from_parameters(np, options), np,
                            insert_targets(targets));
}

/// \ingroup PkgARAPDeformationRef
/// \brief deforms a shape as rigidly as possible, in one call, with two maps: which vertices are
/// constrained, and where each of them goes.
///
/// \param shape the shape; as passed, it is the rest shape
/// \param constrained tells which vertices are constrained to their targets
/// \param targets the target of each constrained vertex; for one that stays, its own point. Where
///        an associative container has none, the vertex stays.
/// \param options the options
/// \param np an optional sequence of named parameters, as above
///
/// Both maps may be property maps, function objects, associative containers or vectors by the
/// indices of the vertices.
template <typename Shape, typename VertexConstrainedMap, typename VertexTargetMap,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
[[nodiscard]] ARAP::Report
arap_deform(Shape&& shape, const VertexConstrainedMap& constrained, const VertexTargetMap& targets,
            const ARAP::Options& options, const CGAL_NP_CLASS& np = parameters::default_values())
{
  using namespace ARAP::internal;
  return deform_in_one_call(shape, options_from_parameters(np, options), np,
                            insert_constrained(constrained, targets));
}

/// \ingroup PkgARAPDeformationRef
/// \brief deforms a shape as rigidly as possible, in one call, with two maps and default options.
///
/// The parameters are those of the overload with `options`.
template <typename Shape, typename VertexConstrainedMap, typename VertexTargetMap,
          typename CGAL_NP_TEMPLATE_PARAMETERS,
          typename = std::enable_if_t<!ARAP::internal::is_named_parameters<VertexTargetMap>>>
[[nodiscard]] ARAP::Report
arap_deform(Shape&& shape, const VertexConstrainedMap& constrained, const VertexTargetMap& targets,
            const CGAL_NP_CLASS& np = parameters::default_values())
{
  using namespace ARAP::internal;
  return deform_in_one_call(shape, options_from_parameters(np), np,
                            insert_constrained(constrained, targets));
}

} // namespace CGAL

#endif // CGAL_ARAP_DEFORM_H
