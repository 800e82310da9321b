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

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/flat_types.h>

#include <CGAL/Default.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <array>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationDomains
/// \brief a triangulated surface, given as any model of `FaceGraph`.
///
/// Only the free functions of the BGL and the property maps are used. Triangles are the simplices.
/// The mesh must outlive the domain; its connectivity must not change meanwhile.
///
/// \tparam TriangleMesh a model of `FaceGraph`, and of `VertexListGraph` if the default index map
///         has to be filled
/// \tparam VertexPointMap a model of `ReadWritePropertyMap` from the vertices to their points,
///         default the internal map of the mesh. A point type has `operator[]` and a constructor
///         from three coordinates.
/// \tparam VertexIndexMap a model of `ReadablePropertyMap` from the vertices to 0, 1, ..., default
///         the internal map of the mesh or, if there is none, one that is filled at construction
///
/// \cgalModels{ARAPDomain_3}
template <typename TriangleMesh, typename VertexPointMap = Default,
          typename VertexIndexMap = Default>
class Face_graph_domain
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using halfedge_descriptor = typename Graph_traits::halfedge_descriptor;

public:
  /// the type of the mesh.
  using Mesh = TriangleMesh;

  /// the type of the map to the points.
  using Vertex_point_map = typename Default::Get<
    VertexPointMap, typename boost::property_map<Mesh, vertex_point_t>::type>::type;

  /// the type of the map to the indices.
  using Vertex_index_map = typename Default::Get<
    VertexIndexMap, typename GetInitializedVertexIndexMap<Mesh>::type>::type;

  /// the type of a point.
  using Point = typename boost::property_traits<Vertex_point_map>::value_type;

  /// a vertex.
  using vertex_descriptor = typename Graph_traits::vertex_descriptor;

  /// a face.
  using simplex_descriptor = typename Graph_traits::face_descriptor;

  /// 3: the simplices are triangles.
  static constexpr std::size_t vertices_per_simplex = 3;

  /// constructs the domain with the default maps.
  explicit Face_graph_domain(Mesh& mesh)
    : Face_graph_domain(mesh, get(vertex_point, mesh))
  {}

  /// constructs the domain with a map to the points and the default map to the indices.
  Face_graph_domain(Mesh& mesh, Vertex_point_map vertex_point_map)
    : Face_graph_domain(mesh, vertex_point_map, get_initialized_vertex_index_map(mesh))
  {}

  /// constructs the domain with both maps.
  Face_graph_domain(Mesh& mesh, Vertex_point_map vertex_point_map,
                    Vertex_index_map vertex_index_map)
    : m_mesh(&mesh), m_point_map(vertex_point_map), m_index_map(vertex_index_map)
  {}

  /// returns the index of `v`, by which tables are indexed and sentences name the vertex.
  std::size_t index(vertex_descriptor v) const
  {
    return static_cast<std::size_t>(get(m_index_map, v));
  }

  /// returns the point of `v`.
  Point point(vertex_descriptor v) const { return get(m_point_map, v); }

  /// sets the point of `v`.
  void set_point(vertex_descriptor v, const Point& point) const { put(m_point_map, v, point); }

  /// returns the coordinates of `point`, rounded to `double`.
  static Coordinates coordinates(const Point& point)
  {
    return {CGAL::to_double(point[0]), CGAL::to_double(point[1]), CGAL::to_double(point[2])};
  }

  /// returns the point with the given coordinates.
  static Point make_point(const Coordinates& c) { return Point(c[0], c[1], c[2]); }

  /// returns whether no face is incident to `v`.
  bool is_isolated(vertex_descriptor v) const
  {
    for(halfedge_descriptor h : halfedges_to(v))
      if(!is_border(h, *m_mesh))
        return false;
    return true;
  }

  /// returns the vertices of the triangle `s`.
  std::array<vertex_descriptor, 3> simplex_vertices(simplex_descriptor s) const
  {
    const halfedge_descriptor h = halfedge(s, *m_mesh);
    return {source(h, *m_mesh), target(h, *m_mesh), target(next(h, *m_mesh), *m_mesh)};
  }

  /// calls `f(s, vertices)` for each face `s` at `v` with the `std::array` of its three vertices.
  /// Returns `false` at the first face that is not a triangle.
  template <typename Function>
  bool for_each_incident_simplex(vertex_descriptor v, const Function& f) const
  {
    for(halfedge_descriptor h : halfedges_to(v))
    {
      if(is_border(h, *m_mesh))
        continue;
      const halfedge_descriptor h1 = next(h, *m_mesh), h2 = next(h1, *m_mesh);
      if(next(h2, *m_mesh) != h)
        return false;
      f(face(h, *m_mesh), std::array<vertex_descriptor, 3>{
          v, target(h1, *m_mesh), target(h2, *m_mesh)});
    }
    return true;
  }

private:
  Iterator_range<Halfedge_around_target_iterator<Mesh>> halfedges_to(vertex_descriptor v) const
  {
    const halfedge_descriptor h = halfedge(v, *m_mesh);
    if(h == Graph_traits::null_halfedge())
      return {Halfedge_around_target_iterator<Mesh>(), Halfedge_around_target_iterator<Mesh>()};
    return halfedges_around_target(h, *m_mesh);
  }

  Mesh* m_mesh;
  Vertex_point_map m_point_map;
  Vertex_index_map m_index_map;
};

/// \ingroup PkgARAPDeformationDomains
/// \brief returns the domain of a triangulated surface with the property maps of named parameters.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{the points of the vertices, read and written}
///     \cgalParamType{a model of `ReadWritePropertyMap`}
///     \cgalParamDefault{`boost::get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_index_map}
///     \cgalParamDescription{a unique index for each vertex, from 0 on}
///     \cgalParamType{a model of `ReadablePropertyMap` with an integral value type}
///     \cgalParamDefault{the initialized index map of the mesh}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <typename TriangleMesh, typename NamedParameters = parameters::Default_named_parameters>
auto make_face_graph_domain(TriangleMesh& mesh,
                            const NamedParameters& np = parameters::default_values())
{
  using Vertex_point_map = typename GetVertexPointMap<TriangleMesh, NamedParameters>::type;
  using Vertex_index_map =
    typename GetInitializedVertexIndexMap<TriangleMesh, NamedParameters>::type;
  return Face_graph_domain<TriangleMesh, Vertex_point_map, Vertex_index_map>(
    mesh,
    parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                 get_property_map(vertex_point, mesh)),
    get_initialized_vertex_index_map(mesh, np));
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_FACE_GRAPH_DOMAIN_H
