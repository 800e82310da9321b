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

#ifndef CGAL_ARAP_DEFORMATION_FACE_GRAPH_DOMAIN_H
#define CGAL_ARAP_DEFORMATION_FACE_GRAPH_DOMAIN_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/internal/domain/Point_conversion.h>
#include <CGAL/ARAP_deformation/internal/domain/index_map_of.h>
#include <CGAL/ARAP_deformation/internal/domain/weighted_points.h>
#include <CGAL/ARAP_deformation/internal/has_parameter.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>
#include <CGAL/ARAP_deformation/parameters.h>

#include <CGAL/Default.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {

namespace internal {

template <typename Graph>
using Call_is_removed = decltype(
  std::declval<const Graph&>().has_valid_index(
    std::declval<typename boost::graph_traits<Graph>::vertex_descriptor>()) &&
  std::declval<const Graph&>().is_removed(
    std::declval<typename boost::graph_traits<Graph>::vertex_descriptor>()));

template <typename Graph>
using Call_is_in_cc = decltype(std::declval<const Graph&>().is_in_cc(
  std::declval<typename boost::graph_traits<Graph>::vertex_descriptor>()));

// outside the class, which has a member `vertices`
template <typename Graph>
auto vertices_of_graph(const Graph& graph)
{
  return vertices(graph);
}

// without const: map types are often the decltype of a const variable, but domains are assignable
template <typename PolygonMesh, typename VertexPointMap>
using Vertex_point_map_or_default = typename Default::Get<
  std::remove_const_t<VertexPointMap>,
  std::conditional_t<
    std::is_const_v<PolygonMesh>,
    typename boost::property_map<std::remove_const_t<PolygonMesh>, vertex_point_t>::const_type,
    typename boost::property_map<std::remove_const_t<PolygonMesh>, vertex_point_t>::type>>::type;

} // namespace internal

/// \ingroup PkgARAPDeformationDomains
/// \brief a surface of triangles or polygons, given by any model of `FaceGraph` and
/// `VertexListGraph`.
///
/// The faces are the simplices. A polygon with up to 64 corners has the average weights of all its
/// triangulations, in \f$O(k^3)\f$ time for \f$k\f$ corners. One with more has the average of
/// the \f$k\f$ triangulations that are fans, in \f$O(k^2)\f$ time. All its corners are
/// neighbors, which takes \f$O(k^2)\f$ memory and time per iteration: preprocessing refuses
/// polygons with more than 2048 corners with `Status::too_many_corners`.
/// The mesh must outlive the domain, and its connectivity must not change in the meantime. Where
/// several fans of faces meet in one vertex, separate them first
/// (`CGAL::Polygon_mesh_processing::duplicate_non_manifold_vertices()`), or deform ranges.
///
/// Without an index map, a linear pass over the mesh checks whether its internal one has the
/// indices 0, 1, ... Where it has not, as ids of a `Polyhedron_3` with gaps, they are numbered
/// anew, also by functions that only read the mesh, such as `quality()` and `locate()`. An index
/// map that is passed avoids both; it may have gaps.
///
/// \tparam PolygonMesh a model of `FaceGraph` and `VertexListGraph`; may be `const` if the points
///         are written to an output map
/// \tparam VertexPointMap a model of `ReadablePropertyMap` from the vertices to their points, and
///         of `ReadWritePropertyMap` if there is no output map; default the internal map of the
///         mesh. The points have `operator[]` and a constructor from three coordinates, or from two
///         for a mesh in the plane.
/// \tparam VertexIndexMap a model of `ReadablePropertyMap` from the vertices to 0, 1, ..., default
///         the internal map of the mesh or, if there is none, one initialized at construction
/// \tparam OutputPointMap a model of `WritablePropertyMap` from the vertices to points of the same
///         type, which must be others than those that are read; default `VertexPointMap`, whose
///         points are changed in place
///
/// \cgalModels{ARAPDomain}
template <typename PolygonMesh, typename VertexPointMap = Default,
          typename VertexIndexMap = Default, typename OutputPointMap = Default>
class Face_graph_domain
  : public internal::Point_conversion<typename boost::property_traits<
      internal::Vertex_point_map_or_default<PolygonMesh, VertexPointMap>>::value_type>
{
  using Graph = std::remove_const_t<PolygonMesh>;
  using Graph_traits = boost::graph_traits<Graph>;
  using halfedge_descriptor = typename Graph_traits::halfedge_descriptor;

public:
  /// the type of the mesh.
  using Mesh = PolygonMesh;

  /// the type of the map from which points are read.
  using Vertex_point_map = internal::Vertex_point_map_or_default<PolygonMesh, VertexPointMap>;

  /// the type of the map to which points are written.
  using Output_point_map =
    typename Default::Get<std::remove_const_t<OutputPointMap>, Vertex_point_map>::type;

  /// the type of the map to the indices.
  using Vertex_index_map = typename Default::Get<
    std::remove_const_t<VertexIndexMap>,
    typename GetInitializedVertexIndexMap<Graph>::const_type>::type;

  /// the type of a point.
  using Point = typename boost::property_traits<Vertex_point_map>::value_type;

  /// a vertex.
  using vertex_descriptor = typename Graph_traits::vertex_descriptor;

  /// a face.
  using simplex_descriptor = typename Graph_traits::face_descriptor;

  /// 2: the simplices are triangles and polygons.
  static constexpr int dimension = 2;

  /// constructs the domain with the default maps.
  explicit Face_graph_domain(Mesh& mesh)
    : Face_graph_domain(mesh, get(vertex_point, mesh))
  {
    static_assert(!std::is_const_v<Mesh>,
                  "Face_graph_domain: the points of a const mesh cannot be written; construct the "
                  "domain with an output point map");
  }

  /// constructs the domain with a point map and the default index map.
  Face_graph_domain(Mesh& mesh, Vertex_point_map vertex_point_map)
    : Face_graph_domain(mesh, vertex_point_map,
                        get_initialized_vertex_index_map(std::as_const(mesh)))
  {}

  /// constructs the domain with both maps. Points are changed in place.
  Face_graph_domain(Mesh& mesh, Vertex_point_map vertex_point_map,
                    Vertex_index_map vertex_index_map)
    : m_mesh(&mesh), m_point_map(vertex_point_map), m_output_point_map(vertex_point_map),
      m_index_map(vertex_index_map), m_is_in_place(true)
  {}

  /// constructs the domain with separate maps for reading and writing points. The points of all
  /// vertices of the region of interest are written.
  Face_graph_domain(Mesh& mesh, Vertex_point_map vertex_point_map,
                    Vertex_index_map vertex_index_map, Output_point_map output_point_map)
    : m_mesh(&mesh), m_point_map(vertex_point_map), m_output_point_map(output_point_map),
      m_index_map(vertex_index_map), m_is_in_place(false)
  {}

  /// returns the index of `v`, which messages also name it by.
  std::size_t index(vertex_descriptor v) const
  {
    return static_cast<std::size_t>(get(m_index_map, v));
  }

  /// returns the point of `v` in the input map.
  Point point(vertex_descriptor v) const { return get(m_point_map, v); }

  /// sets the point of `v` in the output map. A weighted point keeps its weight.
  void set_point(vertex_descriptor v, const Point& point) const
  {
    put(m_output_point_map, v,
        internal::with_weight_of_old(point, [&] { return this->point(v); }));
  }

  /// returns whether points are changed in place.
  bool is_in_place() const { return m_is_in_place; }

  /// returns the range of all vertices.
  auto vertices() const { return internal::vertices_of_graph(*m_mesh); }

  /// returns whether `v` is a vertex of the mesh, and was not removed. Only a `CGAL::Surface_mesh`
  /// and a `CGAL::Face_filtered_graph` can tell; for other meshes `true`, unless it is null.
  bool is_vertex(vertex_descriptor v) const { return is_element(v, Graph_traits::null_vertex()); }

  /// returns whether `s` is a face of the mesh, and was not removed. Only a `CGAL::Surface_mesh`
  /// and a `CGAL::Face_filtered_graph` can tell; for other meshes `true`, unless it is null.
  bool is_simplex(simplex_descriptor s) const { return is_element(s, Graph_traits::null_face()); }

  /// returns whether no face is incident to `v`.
  bool is_isolated(vertex_descriptor v) const
  {
    for(halfedge_descriptor h : halfedges_to(v))
      if(!is_border(h, *m_mesh))
        return false;
    return true;
  }

  /// returns the range of the vertices of the face `s`, in their order around it.
  auto simplex_vertices(simplex_descriptor s) const
  {
    return vertices_around_face(halfedge(s, *m_mesh), *m_mesh);
  }

  /// calls `f(s, corners)` for each face `s` at `v`, with its vertices in their order around it.
  template <typename Function>
  void for_each_incident_simplex(vertex_descriptor v, const Function& f) const
  {
    for(halfedge_descriptor h : halfedges_to(v))
      if(!is_border(h, *m_mesh))
        f(face(h, *m_mesh), vertices_around_face(h, *m_mesh));
  }

private:
  template <typename Element>
  bool is_element(Element e, Element null) const
  {
    if constexpr(internal::is_valid<internal::Call_is_removed, Graph>)
      return m_mesh->has_valid_index(e) && !m_mesh->is_removed(e);
    else if constexpr(internal::is_valid<internal::Call_is_in_cc, Graph>)
      return e != null && m_mesh->is_in_cc(e);
    else
      return e != null;
  }

  Iterator_range<Halfedge_around_target_iterator<Graph>> halfedges_to(vertex_descriptor v) const
  {
    const halfedge_descriptor h = halfedge(v, *m_mesh);
    if(h == Graph_traits::null_halfedge())
      return {Halfedge_around_target_iterator<Graph>(), Halfedge_around_target_iterator<Graph>()};
    return halfedges_around_target(h, std::as_const(*m_mesh));
  }

  Mesh* m_mesh;
  Vertex_point_map m_point_map;
  Output_point_map m_output_point_map;
  Vertex_index_map m_index_map;
  bool m_is_in_place;
};

#ifndef DOXYGEN_RUNNING
template <typename PolygonMesh, typename VertexPointMap>
Face_graph_domain(PolygonMesh&, VertexPointMap) -> Face_graph_domain<PolygonMesh, VertexPointMap>;

template <typename PolygonMesh, typename VertexPointMap, typename VertexIndexMap>
Face_graph_domain(PolygonMesh&, VertexPointMap, VertexIndexMap)
  -> Face_graph_domain<PolygonMesh, VertexPointMap, VertexIndexMap>;

template <typename PolygonMesh, typename VertexPointMap, typename VertexIndexMap,
          typename OutputPointMap>
Face_graph_domain(PolygonMesh&, VertexPointMap, VertexIndexMap, OutputPointMap)
  -> Face_graph_domain<PolygonMesh, VertexPointMap, VertexIndexMap, OutputPointMap>;
#endif

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of a surface, which may be `const`, whose deformed points are written
/// to `output_point_map`. Only vertices in the region of interest are written: copy the other
/// points first.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{the points of the vertices}
///     \cgalParamType{a model of `ReadablePropertyMap`}
///     \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_index_map}
///     \cgalParamDescription{a unique index for each vertex, starting from 0}
///     \cgalParamType{a model of `ReadablePropertyMap` with an integral value type}
///     \cgalParamDefault{the initialized index map of the mesh}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <typename PolygonMesh, typename OutputPointMap, typename CGAL_NP_TEMPLATE_PARAMETERS>
auto make_face_graph_domain(PolygonMesh& mesh, OutputPointMap output_point_map,
                            const CGAL_NP_CLASS& np = parameters::default_values())
{
  auto point_map =
    parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                 get_const_property_map(vertex_point, mesh));
  return Face_graph_domain(mesh, point_map,
                           internal::index_map_of(std::as_const(mesh), np),
                           output_point_map);
}

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of a surface with the property maps of named parameters.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{the points of the vertices, read and written}
///     \cgalParamType{a model of `ReadWritePropertyMap`}
///     \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_index_map}
///     \cgalParamDescription{a unique index for each vertex, starting from 0}
///     \cgalParamType{a model of `ReadablePropertyMap` with an integral value type}
///     \cgalParamDefault{the initialized index map of the mesh}
///   \cgalParamNEnd
///   \cgalParamNBegin{output_point_map}
///     \cgalParamDescription{where deformed points are written, of vertices in the region of
///                           interest only: copy the other points first; the mesh may be `const`}
///     \cgalParamType{a model of `WritablePropertyMap`}
///     \cgalParamDefault{the vertex point map}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <typename PolygonMesh, typename CGAL_NP_TEMPLATE_PARAMETERS>
auto make_face_graph_domain(PolygonMesh& mesh,
                            const CGAL_NP_CLASS& np = parameters::default_values())
{
  using internal::has_parameter;
  constexpr bool has_output = has_parameter<CGAL_NP_CLASS, internal_np::output_point_map_t>;
  constexpr bool is_writable = has_output || !std::is_const_v<PolygonMesh> ||
                               has_parameter<CGAL_NP_CLASS, internal_np::vertex_point_t>;
  static_assert(is_writable, "make_face_graph_domain: the points of a const mesh cannot be "
                             "written; pass an output point map");
  if constexpr(has_output)
    return make_face_graph_domain(
      mesh, parameters::get_parameter(np, internal_np::output_point_map), np);
  else if constexpr(is_writable)
  {
    auto point_map =
      parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                   get_property_map(vertex_point, mesh));
    return Face_graph_domain(mesh, point_map,
                             internal::index_map_of(std::as_const(mesh), np));
  }
  else // there is no second error
    return Face_graph_domain(const_cast<std::remove_const_t<PolygonMesh>&>(mesh));
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_FACE_GRAPH_DOMAIN_H
