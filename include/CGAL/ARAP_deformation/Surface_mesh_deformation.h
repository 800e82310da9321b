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

#ifndef CGAL_ARAP_DEFORMATION_SURFACE_MESH_DEFORMATION_H
#define CGAL_ARAP_DEFORMATION_SURFACE_MESH_DEFORMATION_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Cell_scheme.h>
#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/drop_in/Drop_in_session.h>
#include <CGAL/ARAP_deformation/internal/drop_in/Drop_in_traits.h>
#include <CGAL/ARAP_deformation/internal/drop_in/Halfedge_weights.h>
#include <CGAL/ARAP_deformation/internal/region/Paged_index_map.h>

#include <CGAL/Default.h>
#include <CGAL/Iterator_range.h>
#include <CGAL/Surface_mesh_deformation.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationRef
/// \brief a drop-in replacement for `CGAL::Surface_mesh_deformation`, with the numeric core of this
/// package.
///
/// To switch, include this header and use `CGAL::ARAP::Surface_mesh_deformation`. The template
/// parameters, the members and their meaning, and the iterates are those of
/// `CGAL::Surface_mesh_deformation` in the installed version of \cgal; its reference manual
/// applies. New programs should use `CGAL::ARAP_deformation`.
///
/// As in that class, the weights of all halfedges are computed at construction, and
/// `overwrite_initial_geometry()` recomputes those at vertices of the region of interest.
/// The rotations are kept from one `deform()` to the next, and each iteration first solves for the
/// positions. A vertex that leaves the region of interest returns to its rest position.
///
/// Differences:
///
/// - *Failure.* `preprocess()` returns `false`, and `outcome()` tells why and names the vertex.
///   `deform()` returns a `CGAL::ARAP::Report`. If one of them fails, the mesh and the object are
///   as they were. No warning is printed. Functions that set a target return an `Outcome`; those
///   that take a range set all targets that they can.
/// - *Targets.* All functions, not only `set_target_position()`, ignore vertices that are not
///   control vertices; the outcome is `Status::not_a_control_vertex`.
/// - *Solver and rotation.* `ST` and `CR` can be models of the concepts of this package or of
///   \cgal. The defaults are those of `CGAL::ARAP_deformation_traits`. A Cholesky factorization
///   needs a positive definite matrix. The weights of \cgal give one, but with
///   `SPOKES_AND_RIMS` only if all are of one shape: if the region of interest grows after
///   `overwrite_initial_geometry()`, weights of the former shape stand beside those of the new one.
///   Where negative weights make the matrix indefinite, `preprocess()` fails; with another solver,
///   where a diagonal entry is not positive.
/// - *Unconstrained components.* If a component of the region of interest is not connected to any
///   fixed vertex, `preprocess()` always fails, independently of rounding. It also fails if no
///   vertex of the region of interest has a face.
/// - *Points.* A run computes in `double`, and rounds to the type of the points once, at the end.
///   `CGAL::to_double()` must accept the coordinates of the points. Outside the region of interest
///   only points of vertices that leave it are written. Points around it are read when it is
///   prepared; if others move them afterwards, and they enter, they enter where they are then.
/// - *Index maps.* The halfedge index map may number the halfedges in any order.
/// - *Copies.* The class cannot be copied, whatever its template arguments.
/// - *Cost.* `erase_roi_vertex()` takes amortized constant time. `roi_vertices()` takes linear
///   time, and only later calls bring what it returned up to date. Functions that only read are
///   `const`; `target_position()` returns a copy, and does not move back vertices that have left
///   the region of interest.
///   Another `set_sre_arap_alpha()` costs a numeric factorization.
///
/// \tparam TM a model of `FaceGraph`, `VertexListGraph` and `HalfedgeListGraph`, for `SRE_ARAP`
///         also of `FaceListGraph` and `BidirectionalGraph`, all of whose faces are triangles
/// \tparam VIM a model of `ReadablePropertyMap` from the vertices to 0, 1, ...
/// \tparam HIM a model of `ReadablePropertyMap` from the halfedges to 0, 1, ...
/// \tparam TAG `SPOKES_AND_RIMS`, `ORIGINAL_ARAP` or `SRE_ARAP`
/// \tparam WC a model of `SurfaceMeshDeformationWeights`
/// \tparam ST a model of `ARAPSparseSolver` or of `SparseLinearAlgebraWithFactorTraits_d`
/// \tparam CR a model of `ARAPClosestRotation` or of `DeformationClosestRotationTraits_3`
/// \tparam VPM a model of `ReadWritePropertyMap` from the vertices to their points
///
/// The defaults of `VIM`, `HIM`, `WC` and `VPM` are those of `CGAL::Surface_mesh_deformation`.
///
/// \sa `CGAL::ARAP_deformation`
template <typename TM, typename VIM = Default, typename HIM = Default,
          Deformation_algorithm_tag TAG = SPOKES_AND_RIMS, typename WC = Default,
          typename ST = Default, typename CR = Default, typename VPM = Default>
class Surface_mesh_deformation
{
  using Base_types = CGAL::Surface_mesh_deformation<TM, VIM, HIM, TAG, WC,
                                                    internal::No_linear_algebra,
                                                    internal::No_closest_rotation, VPM>;

public:
  /// \name Types
  /// @{
  using Triangle_mesh = TM; ///< the mesh.
  using Vertex_index_map = typename Base_types::Vertex_index_map; ///< the indices of the vertices.
  using Hedge_index_map = typename Base_types::Hedge_index_map; ///< the indices of the halfedges.
  using Weight_calculator = typename Base_types::Weight_calculator; ///< the weights.
  using Vertex_point_map = typename Base_types::Vertex_point_map; ///< the points.
  /// the solver: `ST`, or its default.
  using Sparse_linear_solver = typename Default::Get<ST, Multifrontal_cholesky_solver>::type;
  /// the rotation: `CR`, or its default.
  using Closest_rotation_traits =
    typename Default::Get<CR, Newton_closest_rotation>::type;
  using vertex_descriptor = typename Base_types::vertex_descriptor; ///< a vertex.
  using halfedge_descriptor = typename Base_types::halfedge_descriptor; ///< a halfedge.
  using Point = typename Base_types::Point; ///< a point.
  using Roi_vertex_range = std::vector<vertex_descriptor>; ///< the region of interest.
#ifndef DOXYGEN_RUNNING
  using Halfedge_graph = TM;
#endif
  /// @}

  /// \name Construction
  /// @{

  /// constructs a deformation of `mesh` with default maps and weights.
  Surface_mesh_deformation(Triangle_mesh& mesh)
    : Surface_mesh_deformation(mesh, get_initialized_vertex_index_map(mesh))
  {}

  /// constructs a deformation with a map to the indices of the vertices.
  Surface_mesh_deformation(Triangle_mesh& mesh, Vertex_index_map vertex_index_map)
    : Surface_mesh_deformation(mesh, vertex_index_map, get_initialized_halfedge_index_map(mesh))
  {}

  /// constructs a deformation with both index maps.
  Surface_mesh_deformation(Triangle_mesh& mesh, Vertex_index_map vertex_index_map,
                           Hedge_index_map hedge_index_map)
    : Surface_mesh_deformation(mesh, vertex_index_map, hedge_index_map, get(vertex_point, mesh))
  {}

  /// constructs a deformation with all maps. Computes the weight of each halfedge of the mesh.
  Surface_mesh_deformation(Triangle_mesh& mesh, Vertex_index_map vertex_index_map,
                           Hedge_index_map hedge_index_map, Vertex_point_map vertex_point_map,
                           Weight_calculator weight_calculator = Weight_calculator())
    : m_mesh(mesh),
      m_weights(mesh, vertex_index_map, hedge_index_map, vertex_point_map, weight_calculator),
      m_session(Domain(mesh, vertex_point_map, vertex_index_map),
                Traits{Solver(), m_weights, Rotation()})
  {
    Options options;
    options.cells = TAG == SPOKES_AND_RIMS ? Cell_scheme::spokes_and_rims() : Cell_scheme::spokes();
    m_session.set_options(options);
    if constexpr(TAG == SRE_ARAP)
    {
      const internal::Double_point_map<Vertex_point_map> points = {vertex_point_map};
      for(auto f : faces(mesh))
      {
        const halfedge_descriptor h = halfedge(f, mesh);
        m_area += std::sqrt(CGAL::squared_area(get(points, source(h, mesh)),
                                               get(points, target(h, mesh)),
                                               get(points, target(next(h, mesh), mesh))));
      }
      set_sre_arap_alpha(0.02);
    }
  }

  Surface_mesh_deformation(const Surface_mesh_deformation&) = delete;
  Surface_mesh_deformation& operator=(const Surface_mesh_deformation&) = delete;
  /// @}

  /// \name Preprocessing
  /// @{

  /// erases all vertices from the region of interest and the control vertices.
  void clear_roi_vertices() { m_session.clear_roi(); }

  /// erases all control vertices, which stay in the region of interest.
  void clear_control_vertices() { m_session.clear_control(); }

  /// makes `v` a control vertex, and inserts it in the region of interest if needed. Returns `true`
  /// if it was not a control vertex.
  bool insert_control_vertex(vertex_descriptor v) { return m_session.insert_control(v); }

  /// makes the vertices of a range control vertices.
  template <typename InputIterator>
  void insert_control_vertices(InputIterator begin, InputIterator end)
  {
    for(; begin != end; ++begin) insert_control_vertex(*begin);
  }

  /// erases `v` from the control vertices; it stays in the region of interest. Returns `true` if it
  /// was a control vertex.
  bool erase_control_vertex(vertex_descriptor v) { return m_session.erase_control(v); }

  /// inserts the vertices of a range in the region of interest.
  template <typename InputIterator>
  void insert_roi_vertices(InputIterator begin, InputIterator end)
  {
    for(; begin != end; ++begin) insert_roi_vertex(*begin);
  }

  /// inserts `v` in the region of interest. Returns `true` if it was not in the region.
  bool insert_roi_vertex(vertex_descriptor v) { return m_session.insert_roi(v); }

  /// erases `v` from the region of interest and the control vertices. Returns `true` if it was in
  /// the region. The next call that needs the region moves `v` back to its rest position.
  bool erase_roi_vertex(vertex_descriptor v) { return m_session.erase_roi(v); }

  /// prepares the system, unless nothing has changed since the last time. `deform()` calls it.
  /// Returns `false` if it fails; `outcome()` then tells why.
  bool preprocess() { return static_cast<bool>(m_session.preprocess()); }

  /// returns the outcome of the last preprocessing.
  const Outcome& outcome() const { return m_session.preparation(); }
  /// @}

  /// \name Deformation
  /// @{

  /// sets the target of a control vertex. Ignores any other vertex.
  Outcome set_target_position(vertex_descriptor v, const Point& target_position)
  {
    return m_session.change_target(v, [&] { return target_position; });
  }

  /// translates the target of a control vertex by `t`, whose type has `operator[]`. Ignores any
  /// other vertex.
  template <typename Vect>
  Outcome translate(vertex_descriptor v, const Vect& t)
  {
    return m_session.change_target(v, [&] {
      const Point p = m_session.target(v);
      return Point(p[0] + t[0], p[1] + t[1], p[2] + t[2]);
    });
  }

  /// translates the targets of a range of control vertices. Returns the first outcome that is not a
  /// success.
  template <typename InputIterator, typename Vect>
  Outcome translate(InputIterator begin, InputIterator end, const Vect& t)
  {
    return for_each(begin, end, [&](vertex_descriptor v) { return translate(v, t); });
  }

  /// rotates the target of a control vertex by the quaternion `quat` about the point with the
  /// coordinates of `to_rotation_center`. Ignores any other vertex.
  template <typename Quaternion, typename Vect>
  Outcome rotate(vertex_descriptor v, const Vect& to_rotation_center, const Quaternion& quat)
  {
    return m_session.change_target(v, [&] {
      const Point p = m_session.target(v);
      const Vect& c = to_rotation_center;
      const Vect r = quat * Vect(CGAL::to_double(p[0]) - c[0], CGAL::to_double(p[1]) - c[1],
                                 CGAL::to_double(p[2]) - c[2]);
      return Point(c[0] + r[0], c[1] + r[1], c[2] + r[2]);
    });
  }

  /// rotates the targets of a range of control vertices. Returns the first outcome that is not a
  /// success.
  template <typename InputIterator, typename Vect, typename Quaternion>
  Outcome rotate(InputIterator begin, InputIterator end, const Vect& to_rotation_center,
                 const Quaternion& quat)
  {
    return for_each(begin, end, [&](vertex_descriptor v) {
      return rotate(v, to_rotation_center, quat);
    });
  }

  /// returns the target of a control vertex.
  /// \pre `is_control_vertex(v)`
  Point target_position(vertex_descriptor v) const
  {
    CGAL_precondition(is_control_vertex(v));
    return m_session.target(v);
  }

  /// deforms with `iterations()` and `tolerance()`.
  Report deform() { return deform(m_iterations, m_tolerance); }

  /// moves the control vertices to their targets, and all other vertices of the region of interest
  /// by at most `iterations` iterations. If `tolerance` is positive, the run stops, with
  /// `Status::converged`, after an iteration whose relative change of the energy is below it.
  ///
  /// `Report::energy[0]` is the energy with the targets and the rotations of the previous run.
  /// `Report::estimated_relative_gap` is not computed.
  Report deform(unsigned int iterations, double tolerance)
  {
    const double largest = (std::numeric_limits<double>::max)();
    return m_session.deform(iterations, tolerance > 0 ? (std::min)(tolerance, largest) : 0);
  }

  /// moves the region of interest, targets included, back to the rest shape.
  void reset() { m_session.reset(); }

  /// makes the current points of the region of interest the rest shape, and recomputes the weights
  /// at its vertices.
  void overwrite_initial_geometry()
  {
    if(roi_vertices().empty() || m_session.refuse_in_a_run())
      return;
    m_session.put_back_erased();
    const auto weights =
      m_weights.recomputed_at(m_roi, [this](vertex_descriptor v) { return is_roi_vertex(v); });
    m_session.overwrite_initial_geometry();
    m_weights.take_over(weights);
  }
  /// @}

  /// \name Utilities
  /// @{

  /// returns the maximum number of iterations of `deform()`, by default 5.
  unsigned int iterations() const { return m_iterations; }

  /// returns the tolerance of `deform()`, by default 1e-4.
  double tolerance() const { return m_tolerance; }

  /// sets the maximum number of iterations of `deform()`.
  void set_iterations(unsigned int iterations) { m_iterations = iterations; }

  /// sets the tolerance of `deform()`. 0 runs all iterations.
  void set_tolerance(double tolerance) { m_tolerance = tolerance; }

  /// returns the vertices of the region of interest in the order of insertion. Linear time, or
  /// \f$O(n \log n)\f$ if vertices have left and entered again.
  const Roi_vertex_range& roi_vertices() const
  {
    Roi_vertex_range roi =
      m_session.vertices().select([](const auto& entry) { return entry.is_roi; });
    if(roi != m_roi) // else iterators stay valid
      m_roi = std::move(roi);
    return m_roi;
  }

  /// returns whether `v` is in the region of interest.
  bool is_roi_vertex(vertex_descriptor v) const { return m_session.vertices().is_roi(v); }

  /// returns whether `v` is a control vertex.
  bool is_control_vertex(vertex_descriptor v) const
  {
    return m_session.vertices().is_control(v);
  }

  /// returns the mesh.
  const Triangle_mesh& triangle_mesh() const { return m_mesh; }

#ifndef DOXYGEN_RUNNING
  const Triangle_mesh& halfedge_graph() const { return triangle_mesh(); }
#endif

  /// sets the weight of the differences of rotations for the tag `SRE_ARAP`, by default 0.02. It
  /// must be finite.
  void set_sre_arap_alpha(double alpha)
  {
    if constexpr(TAG == SRE_ARAP)
      m_session.change_cell_values([&](auto& values) {
        if(alpha == 0)
          values.set_fit_order({}, 0);
        else
          values.set_fit_order([this] { return region_of_solution(); }, alpha * m_area);
      });
  }
  /// @}

private:
  template <typename InputIterator, typename Function>
  Outcome for_each(InputIterator begin, InputIterator end, const Function& f)
  {
    m_session.put_back_erased(); // even for an empty range
    Outcome first(Status::success, "all targets are set");
    for(; begin != end; ++begin)
      if(Outcome outcome = f(*begin); first && !outcome)
        first = std::move(outcome);
    return first;
  }

  // the region of interest, and the vertices around it as CGAL's class finds them
  std::vector<vertex_descriptor> region_of_solution() const
  {
    std::vector<vertex_descriptor> region = roi_vertices();
    const std::size_t number_of_roi_vertices = region.size();
    const Domain& domain = m_session.vertices().domain();
    internal::Paged_index_map is_there;
    for(vertex_descriptor v : region)
      is_there.set(domain.index(v), 1);
    for(std::size_t k = 0; k < number_of_roi_vertices; ++k)
      for(auto e : CGAL::make_range(in_edges(region[k], m_mesh)))
        if(const vertex_descriptor v = source(e, m_mesh);
           is_there[domain.index(v)] == internal::Paged_index_map::none)
        {
          is_there.set(domain.index(v), 1);
          region.push_back(v);
        }
    return region;
  }

  using Solver = typename internal::Select_sparse_solver<Sparse_linear_solver>::type;
  using Rotation = typename internal::Select_closest_rotation<Closest_rotation_traits>::type;
  using Weights = internal::Halfedge_weights<Triangle_mesh, Vertex_index_map, Hedge_index_map,
                                             Vertex_point_map, Weight_calculator>;
  using Domain = std::conditional_t<
    TAG == SPOKES_AND_RIMS,
    internal::Triangle_domain<Triangle_mesh, Vertex_point_map, Vertex_index_map>,
    Face_graph_domain<Triangle_mesh, Vertex_point_map, Vertex_index_map>>;
  using Traits = internal::Drop_in_traits<Solver, Weights, Rotation>;

  Triangle_mesh& m_mesh;
  Weights m_weights;
  internal::Drop_in_session<Domain> m_session;
  mutable Roi_vertex_range m_roi; // for roi_vertices()
  unsigned int m_iterations = 5;
  double m_tolerance = 1e-4;
  double m_area = 0; // of the mesh at construction, for SRE_ARAP
};

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_SURFACE_MESH_DEFORMATION_H
