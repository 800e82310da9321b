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

#ifndef CGAL_ARAP_DEFORMATION_H
#define CGAL_ARAP_DEFORMATION_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Control_point.h>
#include <CGAL/ARAP_deformation/Default_visitor.h>
#include <CGAL/ARAP_deformation/Dynamics.h>
#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Report.h>
#include <CGAL/ARAP_deformation/internal/domain/Default_domain.h>
#include <CGAL/ARAP_deformation/internal/domain/Point_conversion.h>
#include <CGAL/ARAP_deformation/internal/domain/domain_requirements.h>
#include <CGAL/ARAP_deformation/internal/has_parameter.h>
#include <CGAL/ARAP_deformation/internal/session/Session.h>
#include <CGAL/ARAP_deformation/internal/session/from_parameters.h>
#include <CGAL/ARAP_deformation/internal/session/rotation_matrix.h>
#include <CGAL/ARAP_deformation/internal/session/traits_requirements.h>
#include <CGAL/ARAP_deformation/internal/session/vertex_maps.h>
#include <CGAL/ARAP_deformation/of_simplices.h>
#include <CGAL/ARAP_deformation/parameters.h>
#include <CGAL/ARAP_deformation_traits.h>

#include <CGAL/Default.h>
#include <CGAL/assertions.h>

#include <functional>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {

namespace ARAP {

/// \ingroup PkgARAPDeformationOptions
/// what `ARAP_deformation::transform()` transforms.
enum class Transformed
{
  targets,   ///< the current targets
  rest_shape ///< the points of the rest shape
};

namespace internal {

template <typename Quaternion, typename Vector>
using Call_turn = Requires_convertible<
  decltype(std::declval<const Quaternion&>() * std::declval<const Vector&>()), Vector>;

} // namespace internal
} // namespace ARAP

/// \ingroup PkgARAPDeformationRef
/// \brief deforms a shape as rigidly as possible \cgalCite{Sorkine2007AsRigidAs}: some vertices
/// move to target positions, and the others follow so that every small part turns and moves, but
/// stretches and shears as little as possible.
///
/// The *rest shape* of a vertex is the point that it has when it is inserted, or when a
/// preprocessing first finds it around the region of interest. Only vertices in the *region of
/// interest* move: its *control vertices* move to their targets, or are pulled toward them, see
/// `set_target_weight()`; its other vertices are *free* and are solved for. *Fixed* are vertices
/// outside the region, hard control vertices, and other vertices in the region that have no
/// incident simplex, unless a soft target pulls them.
///
/// Time and memory depend on the number n of vertices that were ever in the region of interest,
/// and not on that of the mesh, if the mesh has, or is given, an index map: an iteration takes
/// \f$O(n \log n)\f$ on surfaces, and a factorization \f$O(n^{3/2})\f$. The mesh must outlive the
/// object. While the object exists, the connectivity of the mesh must not change. A run
/// starts from the points that the mesh has then, also where others have moved them, or with an
/// output map from its own last result; the rest shape stays what it is. All computations are in
/// `double`, whatever the type of the points.
///
/// \tparam Mesh the type of the mesh, or of its domain
/// \tparam Traits a model of `ARAPDeformationTraits`, default `ARAP_deformation_traits<>`
/// \tparam Domain a model of `ARAPDomain`. The default depends on `Mesh`:
///         - if `Mesh` is itself a model of `ARAPDomain`, `Mesh`;
///         - for triangulations and complexes in them, `ARAP::Triangulation_domain`: include its
///           header;
///         - for linear cell complexes that are not models of `FaceGraph` (of dimension 3, over
///           generalized maps, or without face attributes), `ARAP::Linear_cell_complex_domain`:
///           include its header;
///         - else `ARAP::Face_graph_domain<Mesh>`.
template <typename Mesh, typename Traits = Default, typename Domain = Default>
class ARAP_deformation
{
  using Traits_ = typename Default::Get<Traits, ARAP_deformation_traits<>>::type;
  using Domain_ =
    typename Default::Lazy_get<Domain, ARAP::internal::Default_domain<Mesh>>::type;

  static_assert(ARAP::internal::Deformation_traits_requirements<Traits_>::are_met);
  static_assert(
    ARAP::internal::Domain_requirements<Domain_, typename Traits_::Edge_weight>::are_met);

public:
  /// \name Types
  /// @{
  using Deformation_traits = Traits_; ///< the traits.
  using Deformation_domain = Domain_; ///< the domain.
  using Point = typename Domain_::Point; ///< a point of the mesh.
  using vertex_descriptor = typename Domain_::vertex_descriptor; ///< a vertex of the mesh.
  using simplex_descriptor = typename Domain_::simplex_descriptor; ///< a face or tetrahedron.
#ifdef DOXYGEN_RUNNING
  using Iterate = unspecified_type; ///< the argument of a visitor, a model of `ARAPIterate`.
  using State = unspecified_type; ///< what `state()` returns: a value, which can be copied.
#else
  using Iterate = typename ARAP::internal::Session<Domain_>::Iterate;
  using State = typename ARAP::internal::Session<Domain_>::State;
#endif
  /// @}

  /// \name Construction
  /// @{

#ifdef DOXYGEN_RUNNING
  /// constructs a deformation of `mesh` with its own points and an empty region of interest.
  explicit ARAP_deformation(Mesh& mesh, const Deformation_traits& traits = Deformation_traits());
#else
  template <typename Mesh_, typename = std::enable_if_t<std::is_same_v<Mesh_, Mesh> &&
                                                        !std::is_same_v<Mesh_, Domain_>>>
  explicit ARAP_deformation(Mesh_& mesh, const Deformation_traits& traits = Deformation_traits())
    : ARAP_deformation(ARAP::internal::make_domain<Deformation_domain>(mesh), traits)
  {}
#endif

  /// constructs a deformation of a domain, which defines the property maps to use.
  explicit ARAP_deformation(Deformation_domain domain,
                            const Deformation_traits& traits = Deformation_traits())
    : m_session(std::move(domain), traits)
  {}

  /// \brief constructs a deformation of `mesh` with named parameters, and deduces its type:
  /// `ARAP_deformation deformation(mesh, parameters::vertex_point_map(points));`
  ///
  /// The named parameters are those of `arap_deform()`, except for those of targets, which are set
  /// afterwards, and the visitor, which `deform()` takes: these do not compile. The region of
  /// interest is empty by default; vertices that are constrained become control vertices.
  /// \pre The options are valid, see `ARAP::Options::check()`; in Release `preprocess()` and
  /// `deform()` refuse them.
  template <typename Mesh_, typename CGAL_NP_TEMPLATE_PARAMETERS>
  ARAP_deformation(Mesh_& mesh, const CGAL_NP_CLASS& np)
    : m_session(ARAP::internal::domain_from_parameters(mesh, np),
                ARAP::internal::traits_from_parameters(np), {},
                ARAP::internal::options_from_parameters(np))
  {
    using ARAP::internal::has_parameter;
    static_assert(!has_parameter<CGAL_NP_CLASS, internal_np::visitor_t>,
                  "ARAP_deformation: pass the visitor to deform()");
    static_assert(!has_parameter<CGAL_NP_CLASS, internal_np::target_weight_t> &&
                  !has_parameter<CGAL_NP_CLASS, internal_np::target_sets_t> &&
                  !has_parameter<CGAL_NP_CLASS, internal_np::target_rotations_t> &&
                  !has_parameter<CGAL_NP_CLASS, internal_np::control_points_t>,
                  "ARAP_deformation: no target is known yet; use set_target_weight(), "
                  "set_target_set(), set_target_rotation() or insert_control_point() instead of a "
                  "named parameter");
    CGAL_precondition_msg(bool(options().check()), options().check().message.c_str());
    if constexpr(has_parameter<CGAL_NP_CLASS, internal_np::region_of_interest_t>)
      insert_roi_vertices(parameters::get_parameter(np, internal_np::region_of_interest));
    ARAP::internal::insert_constrained_vertices(*this, np);
    if constexpr(has_parameter<CGAL_NP_CLASS, internal_np::cell_stiffness_t>)
      set_stiffness(parameters::get_parameter(np, internal_np::cell_stiffness));
    if constexpr(has_parameter<CGAL_NP_CLASS, internal_np::cell_groups_t>)
      set_groups(parameters::get_parameter(np, internal_np::cell_groups));
  }

  /// moves. A moved-from object can only be assigned to or destroyed.
  ARAP_deformation(ARAP_deformation&&) = default;

  /// moves. A moved-from object can only be assigned to or destroyed.
  ARAP_deformation& operator=(ARAP_deformation&&) = default;

  /// returns the domain.
  const Deformation_domain& domain() const { return m_session.vertices().domain(); }

  /// returns the options.
  const ARAP::Options& options() const { return m_session.options(); }

  /// sets the options. Returns `ARAP::Status::invalid_option`, and changes nothing, if one of them
  /// is out of range.
  [[nodiscard]] ARAP::Outcome set_options(const ARAP::Options& options)
  {
    return m_session.set_options(options);
  }
  /// @}

  /// \name Region of Interest and Control Vertices
  /// Inserting or erasing a vertex takes constant time, amortized. After changes the next
  /// `deform()` does only what they need, see \ref ARAPDeformation_Session. What is inserted must
  /// be a vertex of the mesh. In Release a vertex that is not is refused, by `false`, where the
  /// domain can tell (\ref ARAPDeformation_Errors), and a position beyond a range throws
  /// `std::out_of_range`.
  /// @{

  /// inserts `v` in the region of interest. Returns `true` if it was not in the region.
  bool insert_roi_vertex(vertex_descriptor v)
  {
    return m_session.insert_roi(v);
  }

  /// inserts the vertices of a range in the region of interest.
  template <typename InputIterator>
  void insert_roi_vertices(InputIterator begin, InputIterator end)
  {
    m_session.insert_roi(begin, end);
  }

  /// inserts the vertices of a range in the region of interest.
  template <typename VertexRange>
  void insert_roi_vertices(const VertexRange& vertices)
  {
    insert_roi_vertices(std::begin(vertices), std::end(vertices));
  }

  /// erases `v` from the region of interest and the control vertices. Returns `true` if it was in
  /// the region. The vertex stays where it is; `reset()` moves it back to the rest shape. Control
  /// points in simplices at `v` remain.
  bool erase_roi_vertex(vertex_descriptor v)
  {
    return m_session.erase_roi(v);
  }

  /// erases all vertices from the region of interest and the control vertices, and all control
  /// points. Linear time.
  void clear_roi_vertices()
  {
    m_session.clear_roi();
  }

  /// makes `v` a control vertex, and inserts it in the region of interest if needed. Its target is
  /// its current position, with infinite weight. Returns `true` if it was not a control vertex;
  /// otherwise nothing changes.
  bool insert_control_vertex(vertex_descriptor v)
  {
    return m_session.insert_control(v);
  }

  /// makes `v` a control vertex, if it is none, and sets its target. Returns `true` if it was not a
  /// control vertex.
  bool insert_control_vertex(vertex_descriptor v, const Point& target)
  {
    const bool is_new = m_session.insert_control(v);
    m_session.change_target(v, [&target] { return target; });
    return is_new;
  }

  /// makes the vertices of a range control vertices.
  template <typename VertexRange>
  void insert_control_vertices(const VertexRange& vertices)
  {
    insert_control_vertices(std::begin(vertices), std::end(vertices));
  }

  /// makes the vertices of a range control vertices.
  template <typename InputIterator>
  void insert_control_vertices(InputIterator begin, InputIterator end)
  {
    for(; begin != end; ++begin) insert_control_vertex(*begin);
  }

  /// makes the control vertex `v` a free vertex. Returns `true` if it was a control vertex.
  bool erase_control_vertex(vertex_descriptor v)
  {
    return m_session.erase_control(v);
  }

  /// makes all control vertices free, and erases all control points. Linear time.
  void clear_control_vertices()
  {
    m_session.clear_control();
  }

  /// returns whether `v` is in the region of interest.
  bool is_roi_vertex(vertex_descriptor v) const { return m_session.vertices().is_roi(v); }

  /// returns whether `v` is a control vertex.
  bool is_control_vertex(vertex_descriptor v) const { return m_session.vertices().is_control(v); }

  /// returns the vertices of the region of interest, control vertices included, in the order in
  /// which they entered it. Linear time, or \f$O(n \log n)\f$ if vertices have left and entered
  /// again.
  std::vector<vertex_descriptor> roi_vertices() const
  {
    return m_session.vertices().select([](const auto& entry) { return entry.is_roi; });
  }

  /// returns the control vertices, in the order in which they entered the region of interest. Time
  /// as for `roi_vertices()`.
  std::vector<vertex_descriptor> control_vertices() const
  {
    return m_session.vertices().select([](const auto& entry) { return entry.is_control; });
  }
  /// @}

  /// \name Control Points
  /// A control point is a handle inside a face or a tetrahedron: \f$\sum_k \lambda_k p'_k\f$, where
  /// \f$p'_k\f$ are the corners and \f$\lambda_k\f$ its barycentric coordinates. Its target, hard
  /// or soft, has all the functions below that the target of a control vertex has. `ARAP::locate()`
  /// finds the simplex and the coordinates of a point.
  ///
  /// Inserting a control point does not change the region of interest if its corners are in it.
  /// Hard ones must not determine each other: otherwise a run fails with
  /// `ARAP::Status::dependent_target`, for example if all corners of the triangle of a control
  /// point have hard targets. There may be up to 3000 hard control points.
  /// @{

  /// \brief inserts a control point in the simplex `s`, and the corners of `s` with non-zero
  /// coordinates in the region of interest, as free vertices if they are not in it.
  ///
  /// Its target is its current position, with infinite weight. Refuses a nonexistent simplex
  /// (`ARAP::Status::not_a_simplex`) if the domain can tell, and coordinates that are not finite,
  /// do not add up to one within 1e-9, or 1e-14 times the largest if that is more, or are too few
  /// or too many (`ARAP::Status::invalid_coordinates`). Divide coordinates that were computed in
  /// `float` by their sum first.
  /// \param s a simplex
  /// \param coordinates a range of numbers, or a list in braces: the barycentric coordinates, in
  ///        the order of `domain().simplex_vertices(s)`
  template <typename CoordinateRange = std::initializer_list<double>>
  [[nodiscard]] ARAP::Control_point_insertion
  insert_control_point(simplex_descriptor s, const CoordinateRange& coordinates)
  {
    return m_session.insert_point(s, coordinates);
  }

  /// inserts a control point at a location, as `ARAP::locate()` returns it.
  [[nodiscard]] ARAP::Control_point_insertion
  insert_control_point(const ARAP::Location<simplex_descriptor>& location)
  {
    return insert_control_point(location.simplex, location.coordinates);
  }

  /// erases a control point. Returns `true` if it was there.
  bool erase_control_point(ARAP::Control_point point) { return m_session.erase_point(point); }

  /// erases all control points.
  void clear_control_points() { m_session.clear_points(); }

  /// returns whether `point` is a control point of this object; control points of another one may
  /// be equal to its own.
  bool is_control_point(ARAP::Control_point point) const
  {
    return m_session.vertices().is_control(point);
  }

  /// returns the control points, in the order in which they were inserted. Linear time.
  std::vector<ARAP::Control_point> control_points() const
  {
    std::vector<ARAP::Control_point> points;
    for(const auto& point : m_session.vertices().points())
      points.push_back(point.first);
    return points;
  }

  /// returns where a control point is now; in Release, the origin for what is no control point.
  /// \pre `is_control_point(point)`
  Point control_point_position(ARAP::Control_point point) const
  {
    CGAL_precondition(is_control_point(point));
    return m_session.present(point);
  }
  /// @}

  /// \name Targets
  /// Targets are absolute positions; `translate()` and `rotate()` move the current target. The type
  /// `Handles` is of a control vertex, a control point, or a range of either. Passing what is
  /// neither violates a precondition; in Release the call returns
  /// `ARAP::Status::not_a_control_vertex`. Functions on ranges stop at the first error.
  /// @{

  /// sets the target of a control vertex or a control point. A hard target becomes the point of the
  /// vertex without any rounding.
  template <typename Handle>
  ARAP::Outcome set_target_position(const Handle& handle, const Point& target)
  {
    return change_targets(handle, [&target](auto) { return target; });
  }

  /// \brief makes the target of a control vertex or a control point a set, such as a plane or a
  /// surface: it is pulled toward the nearest point of the set, along which it can glide.
  ///
  /// `projection(p)` returns the point of the set that is nearest to `p`, such as
  /// `ARAP::projection_onto(plane)`; with any other point the energy may rise, and the run may fail
  /// with `ARAP::Status::solver_failed`. Each evaluation of the energy calls it for the present
  /// position, one after the other for all targets; it must not change this object. The system
  /// remains as it is, and the energy, with the term \f$m \|p'_v - \pi(p'_v)\|^2\f$, still never
  /// rises. An exception from it ends the run and changes nothing. With points of type
  /// `float` its argument and its result are rounded: far from the origin, a run may end too soon.
  ///
  /// The weight must be finite, see `set_target_weight()`; if not, the call returns
  /// `ARAP::Status::invalid_weight` and leaves this target, and in a range those after it, as they
  /// were. An empty `std::function` throws `std::bad_function_call`, and changes as little. What
  /// the function refers to must outlive the target and all states that have it. Functions that set
  /// or move a target, and `reset()`, make it a point again.
  template <typename Handles, typename Projection>
  [[nodiscard]] ARAP::Outcome set_target_set(const Handles& handles, const Projection& projection)
  {
    return for_each_handle(handles, [&](auto handle) {
      return m_session.set_target_set(handle, projection);
    });
  }

  /// translates targets by `t`, whose type has `operator[]`.
  template <typename Handles, typename Vector>
  ARAP::Outcome translate(const Handles& handles, const Vector& t)
  {
    return change_targets(handles, [&](auto handle) {
      return ARAP::internal::translated<is_planar>(m_session.target(handle), t);
    });
  }

  /// rotates targets about `center`, to `center + q * (target - center)`. `Vector` has `operator[]`
  /// and a constructor from three coordinates, and `q * vector` is a `Vector`, as with Eigen's
  /// quaternions and vectors.
  template <typename Handles, typename Vector, typename Quaternion>
  ARAP::Outcome rotate(const Handles& handles, const Vector& center, const Quaternion& q)
  {
    constexpr bool can_turn =
      ARAP::internal::is_valid<ARAP::internal::Call_turn, Quaternion, Vector>;
    static_assert(can_turn, "rotate() needs a quaternion or matrix q for which q * center is a "
                            "vector of the type of center, as with Eigen; for a transformation of "
                            "CGAL use transform()");
    return change_targets(handles, [&](auto handle) {
      if constexpr(!can_turn)
        return m_session.target(handle);
      else
      {
        const ARAP::Coordinates p = Domain_::coordinates(m_session.target(handle));
        const Vector r = q * Vector(p[0] - center[0], p[1] - center[1], p[2] - center[2]);
        return Domain_::make_point({center[0] + r[0], center[1] + r[1], center[2] + r[2]});
      }
    });
  }

  /// transforms targets, or puts them where the transformation takes the points of the rest shape:
  /// that always starts there, so that repeated calls do not add up. `t(point)` is a `Point`, as
  /// for `CGAL::Aff_transformation_3`.
  template <typename Handles, typename Transformation>
  ARAP::Outcome transform(const Handles& handles, const Transformation& t,
                          ARAP::Transformed transformed = ARAP::Transformed::targets)
  {
    return change_targets(handles, [&](auto handle) -> Point {
      return t(transformed == ARAP::Transformed::targets ? m_session.target(handle)
                                                         : m_session.rest_point(handle));
    });
  }

  /// \brief sets the weight \f$m \geq 0\f$ of the target \f$t\f$ of a control vertex or a control
  /// point.
  ///
  /// An infinite weight, the default, makes the target *hard*: the vertex moves exactly there. A
  /// finite weight makes it *soft*: the vertex is solved for with the free vertices, and the energy
  /// gains the term \f$m \|p'_v - t\|^2\f$. A target that is a set needs a finite weight.
  /// Choose the weight relative to that of an edge (\ref ARAPDeformation_Soft): on a surface with
  /// cotangents about 1, in a volume about a length.
  ///
  /// A new weight costs what other control vertices do (\ref ARAPDeformation_Session), a new target
  /// nothing. Returns `ARAP::Status::invalid_weight`, and changes nothing, if `weight` is negative
  /// or not a number.
  template <typename Handles>
  [[nodiscard]] ARAP::Outcome set_target_weight(const Handles& handles, double weight)
  {
    return for_each_handle(handles, [&](auto handle) {
      return m_session.set_weight(handle, weight);
    });
  }

  /// returns the weight of the target of a control vertex or a control point; in Release, 0 for
  /// what is neither. \pre `handle` is a control vertex or a control point.
  template <typename Handle>
  double target_weight(const Handle& handle) const
  {
    return m_session.weight(control(handle));
  }

  /// returns the target of a control vertex or a control point, or if it is a set, the projection
  /// of the current position; in Release, the point of any other vertex, and the origin for what is
  /// no control point. \pre `handle` is a control vertex or a control point.
  template <typename Handle>
  Point target_position(const Handle& handle) const
  {
    return m_session.target(control(handle));
  }

  /// \brief makes the control vertex `v` a *frame*: it prescribes the rotation of its cell, or of
  /// all simplices at it if cells are simplices, so that it turns what is around it.
  ///
  /// \tparam Rotation a quaternion, angle and axis or matrix as Eigen's, a
  ///         `CGAL::Aff_transformation_3`, or an `ARAP::Matrix_3x3`
  ///
  /// The rotation is that from the rest shape; it counts for soft control vertices too. A simplex
  /// with several frames gets the mean of their rotations, and a group (`set_groups()`) the mean of
  /// those that its cells have. A new rotation costs no preprocessing. It stays when the target
  /// changes, by `rotate()` for example; `erase_target_rotation()`, `reset()` and
  /// `overwrite_initial_geometry()` erase it.
  /// Returns `ARAP::Status::invalid_rotation`, and changes nothing, if it is not a rotation up to
  /// \f$10^{-5}\f$ in \f$\det R\f$ and each entry of \f$R R^T\f$, or turns points with two
  /// coordinates out of their plane. The closest rotation to it is taken. \pre
  /// `is_control_vertex(v)`
  template <typename Rotation>
  [[nodiscard]] ARAP::Outcome set_target_rotation(vertex_descriptor v, const Rotation& rotation)
  {
    CGAL_precondition(is_control_vertex(v));
    return m_session.set_rotation(v, ARAP::internal::rotation_matrix(rotation));
  }

  /// makes all control vertices of a range frames, with the rotation of the rigid motion that takes
  /// them from the rest shape to their current targets. When the targets have moved, by `rotate()`
  /// for example, call it again. Returns `ARAP::Status::invalid_rotation`, and changes nothing, if
  /// there is no such motion up to \f$10^{-4}\f$ of their size, or if they lie on a line, which
  /// leaves the rotation open, and `ARAP::Status::not_a_control_vertex` if one of them is none. An
  /// empty range changes nothing.
  template <typename VertexRange>
  [[nodiscard]] ARAP::Outcome set_target_rotations(const VertexRange& vertices)
  {
    return m_session.set_rotations_of_motion(
      std::vector<vertex_descriptor>(std::begin(vertices), std::end(vertices)));
  }

  /// lets the rotation at the control vertex `v` be fitted again. \pre `is_control_vertex(v)`
  ARAP::Outcome erase_target_rotation(vertex_descriptor v)
  {
    CGAL_precondition(is_control_vertex(v));
    return m_session.set_rotation(v, std::nullopt);
  }
  /// @}

  /// \name Stiffness and Rigid Parts
  /// A map is a function object, a property map, an associative container, or a vector by indices.
  /// It is copied, and asked whenever the region or its weights are prepared, by any later run:
  /// call the function again after a change of its values. What it refers to, as a lambda that
  /// captures by reference does, must live until other values are set. Its keys are vertices if
  /// cells are at vertices, and simplices if cells are simplices; a map whose type says that its
  /// keys are the others has no effect. Where both have the same type, as in ranges, it is taken
  /// for what the cells are. A generic lambda, or another function object without a unique
  /// `operator()`, counts as a map of vertices: `ARAP::of_simplices()` makes it one of simplices. A
  /// vector does, too, unless simplices are numbers, as in ranges and linear cell complexes. Where
  /// cells are simplices, a run refuses both, with `ARAP::Status::undeclared_map`. The functions
  /// themselves return `ARAP::Status::success`, or `ARAP::Status::in_a_run` where a run calls them.
  /// @{

  /// sets the stiffness \f$k_c \geq 0\f$ of cells, a number without unit, the weights \f$w_i\f$ of
  /// Equation (3) of the paper; where the map has no value it is 1. The map is asked for cells
  /// around the region of interest, too. Takes new weights and a numeric factorization.
  /// `ARAP::Status::invalid_stiffness` is what a run returns if a value is negative or not finite.
  template <typename StiffnessMap>
  ARAP::Outcome set_stiffness(StiffnessMap stiffness)
  {
    return m_session.change_cell_values([&](auto& values) {
      values.set_stiffness(std::move(stiffness));
    });
  }

  /// makes all cells equally stiff again.
  ARAP::Outcome clear_stiffness()
  {
    return m_session.change_cell_values([](auto& values) { values.clear_stiffness(); });
  }

  /// lets all cells to which the map gives the same number from 0 on share one rotation; those with
  /// a negative number, or none, have their own. The part can still stretch: a rigid one has a
  /// large stiffness, too. 0 is the number of a group:
  /// a map to `bool` makes one of all cells with `false`. Numbers are at most
  /// \f$2^{63}-1\f$. What is not in the region of interest or next to it does not count.
  /// Takes new weights and a numeric factorization.
  template <typename GroupMap>
  ARAP::Outcome set_groups(GroupMap groups)
  {
    return m_session.change_cell_values([&](auto& values) {
      values.set_groups(std::move(groups));
    });
  }

  /// gives each cell its own rotation again.
  ARAP::Outcome clear_groups()
  {
    return m_session.change_cell_values([](auto& values) { values.clear_groups(); });
  }
  /// @}

  /// \name Deformation
  /// If a call fails or throws, the mesh and the object are as they were before. (If writing the
  /// result throws, only the object is: points written before keep their new values until a
  /// `deform()`, `advance()`, `reset()` or `restore()` succeeds. But if `restore()` itself threw,
  /// vertices that are in the state and not in the object keep them until that state is restored.)
  /// A visitor must not change the object, nor must a map or a function that a run calls
  /// or that points are written by. This is a precondition; in Release such calls fail. An object
  /// and its mesh are for one thread at a time: `ARAP::Status::in_a_run` does not tell that another
  /// thread runs it.
  /// @{

  /// collects the region, computes the weights and the matrix, and factorizes it, or reuses the
  /// last factorization if few vertices have changed. Does nothing if all is up to date.
  /// `deform()` calls it where needed. Do not call it between time steps: they use another matrix,
  /// which `advance()` prepares. `ARAP::Status` lists the failures. The message of a success names
  /// the unconstrained components, if there are any.
  [[nodiscard]] ARAP::Outcome preprocess() { return m_session.preprocess(); }

  /// moves the control vertices to their targets, or toward soft ones, and the free vertices with
  /// them, using the iterations and the tolerance of the options.
  [[nodiscard]] ARAP::Report deform() { return deform(ARAP::Default_visitor()); }

  /// deforms with a visitor, a model of `ARAPDeformationVisitor`, that is called at each iterate.
  template <typename Visitor>
  [[nodiscard]] ARAP::Report deform(Visitor&& visitor)
  {
    static_assert(std::is_invocable_r_v<ARAP::Visitor_action, Visitor&, const Iterate&>,
                  "the visitor must take an iterate and return an ARAP::Visitor_action; to set the "
                  "number of iterations, also pass a tolerance: deform(iterations, tolerance)");
    return deform(options().iterations, options().tolerance, std::forward<Visitor>(visitor));
  }

  /// deforms with a number of iterations and a tolerance for this call only, see `ARAP::Options`.
  /// With `ARAP::Minimizer::automatic` a tolerance of 0 also selects local/global. Take it for the
  /// frames of a drag (\ref ARAPDeformation_Iterations); when that has ended, `deform()` goes on to
  /// the minimum.
  [[nodiscard]] ARAP::Report deform(unsigned int iterations, double tolerance)
  {
    return deform(iterations, tolerance, ARAP::Default_visitor());
  }

  /// deforms with a number of iterations, a tolerance and a visitor for this call only.
  template <typename Visitor>
  [[nodiscard]] ARAP::Report deform(unsigned int iterations, double tolerance, Visitor&& visitor)
  {
    return m_session.deform(iterations, tolerance, std::ref(visitor));
  }

  /// \brief advances by a time step with inertia, of implicit Euler, from the current positions
  /// and velocities; see \ref ARAPDeformation_Dynamics.
  ///
  /// Hard control vertices are at their targets after the step. All other vertices of the region of
  /// interest move freely, also where no control vertex holds them. Steps with the same dynamics
  /// share a factorization; `deform()` needs another one. Fails as `deform()` does, and with
  /// `ARAP::Status::invalid_option` if the dynamics are out of range.
  ///
  /// \param dynamics the length of the step, masses and accelerations
  /// \param forces a map of vertices, as for stiffness: the external forces, which have
  ///        `operator[]` for as many coordinates as the points have; where it has no value there is
  ///        none
  /// \param visitor a model of `ARAPDeformationVisitor`, which is called at each iterate; a step
  ///        that it cancels changes nothing
  template <typename ForceMap, typename Visitor>
  [[nodiscard]] ARAP::Step_report advance(const ARAP::Dynamics& dynamics, const ForceMap& forces,
                                          Visitor&& visitor)
  {
    const auto force_at = [&](vertex_descriptor v) {
      ARAP::Coordinates force = {0, 0, 0};
      ARAP::internal::with_value(forces, v, domain().index(v), [&](const auto& f) {
        force = ARAP::internal::coordinates_of<is_planar>(f);
      });
      return force;
    };
    return m_session.advance(dynamics, force_at, std::ref(visitor));
  }

  /// advances by a time step without a visitor.
  template <typename ForceMap>
  [[nodiscard]] ARAP::Step_report advance(const ARAP::Dynamics& dynamics, const ForceMap& forces)
  {
    return advance(dynamics, forces, ARAP::Default_visitor());
  }

  /// advances without forces other than the acceleration of the dynamics.
  [[nodiscard]] ARAP::Step_report advance(const ARAP::Dynamics& dynamics)
  {
    return m_session.advance(dynamics, {}, ARAP::Default_visitor());
  }

  /// returns the velocity of `v`: its displacement in the last `advance()` divided by the time
  /// step, or the velocity that was set since. Zero at first, after `deform()` and `reset()`, and
  /// when `v` has left the region of interest.
  ARAP::Coordinates velocity(vertex_descriptor v) const { return m_session.velocity(v); }

  /// sets the velocity with which the next step begins, whose type has `operator[]` for as many
  /// coordinates as the points have. Returns `false`, and changes nothing, if `v` is not in the
  /// region of interest.
  template <typename Vector>
  bool set_velocity(vertex_descriptor v, const Vector& velocity)
  {
    return m_session.set_velocity(v, ARAP::internal::coordinates_of<is_planar>(velocity));
  }

  /// moves all vertices that were ever in the region of interest, whoever has moved them, and all
  /// targets back to the rest shape. Keeps the weights of the targets, but erases the rotations
  /// that control vertices prescribe. Targets that are sets become points.
  void reset() { m_session.reset(); }

  /// makes the current shape the rest shape. Keeps the targets and their weights, but erases the
  /// rotations that control vertices prescribe.
  void overwrite_initial_geometry() { m_session.overwrite_initial_geometry(); }

  /// returns the region of interest, the control vertices and control points, their targets
  /// (points, sets and rotations) and weights, the rest shape, the positions and velocities, for
  /// undo and redo. Linear time and memory: take one for a drag, not for each of its frames. What
  /// functions of target sets refer to must live as long as a state that has them. It does not hold
  /// options, stiffness, groups or edge weights: if they have changed since, set the old ones
  /// first, and then restore, as the rotations in a state belong to the cells of that time;
  /// `energy()` is not a number until the next run. Nor does it hold the factor: if it, or the
  /// region, was computed again since, runs from a restored state have the same iterates only up to
  /// rounding.
  State state() const { return m_session.state(); }

  /// returns the object and the mesh to a state of this object, exactly; see `state()` for the runs
  /// from it. If the region is the same, its preprocessing is used again. Vertices that have
  /// entered the region of interest since return to where they were before. Linear time, and
  /// \f$O(k \log k)\f$ for \f$k\f$ of these, and of those that enter it again. Returns
  /// `ARAP::Status::foreign_state`, and changes nothing, if the state is of another object.
  [[nodiscard]] ARAP::Outcome restore(State state) { return m_session.restore(std::move(state)); }
  /// @}

  /// \name Results
  /// @{

  /// returns the energy after the last `deform()` or `advance()`, without inertia; not a number
  /// before the first one, after `reset()`, and after a change of what it depends on: the region of
  /// interest, the control vertices and control points, the weight of a target, the rest shape, the
  /// cells, their stiffness and groups, the bending and the smoothing length; and after a call that
  /// has taken changed edge weights of the user.
  double energy() const { return m_session.energy(); }

  /// returns the rotation of the cell of `v` after the last `deform()` or `advance()`. It is the
  /// identity where `v` has no cell in the region, and where no vertex of the cell is free, as
  /// inside a handle that has turned: there take the rotation of the handle. (Not so if rotations
  /// are smoothed, or the cell shares its rotation with others.) It is the identity, too, until the
  /// next call, also one that fails, after `reset()`, `overwrite_initial_geometry()` and a change
  /// of the region of interest or the cells, also by `restore()`.
  /// \pre `options().cells.has_vertex_cells()`
  ARAP::Matrix_3x3 rotation(vertex_descriptor v) const
  {
    CGAL_precondition_msg(options().cells.has_vertex_cells(),
                          "cells are simplices: call simplex_rotation()");
    return m_session.rotation_of_vertex(v);
  }

  /// returns the rotation of the cell of `s` after the last `deform()` or `advance()`; the identity
  /// in the same cases as `rotation()`, and if the domain can tell that `s` is no simplex of it.
  /// \pre `!options().cells.has_vertex_cells()`
  ARAP::Matrix_3x3 simplex_rotation(simplex_descriptor s) const
  {
    CGAL_precondition_msg(!options().cells.has_vertex_cells(),
                          "cells are at vertices: call rotation()");
    return m_session.rotation_of_simplex(s);
  }

  /// returns the point of `v` in the rest shape. Of a vertex that has never been in the region of
  /// interest, nor next to it in a run, this is the one that the mesh has now, and so it is where
  /// the point in the rest shape is not finite. \pre `v` is a vertex of the mesh.
  Point rest_position(vertex_descriptor v) const
  {
    CGAL_precondition(ARAP::internal::is_vertex_of(domain(), v));
    return m_session.rest_point(v);
  }
  /// @}

private:
  static constexpr bool is_planar = ARAP::internal::is_planar<Domain_>;

  // a handle as the type that the session knows, which is a control vertex or a control point
  template <typename Handle>
  auto control(const Handle& handle) const
  {
    using Known = std::conditional_t<std::is_same_v<Handle, ARAP::Control_point>,
                                     ARAP::Control_point, vertex_descriptor>;
    static_assert(std::is_convertible_v<const Handle&, Known> || std::is_integral_v<Handle>,
                  "ARAP_deformation: what has a target is a vertex or a control point");
    const Known known = static_cast<Known>(handle);
    CGAL_precondition_msg(m_session.vertices().is_control(known),
                          "neither a control vertex nor a control point: insert it first");
    return known;
  }

  // calls f with a handle, or those of a range, until it refuses one
  template <typename Handles, typename Function>
  ARAP::Outcome for_each_handle(const Handles& handles, const Function& f)
  {
    if constexpr(ARAP::internal::is_range<Handles>)
    {
      ARAP::Outcome outcome(ARAP::Status::success, std::string());
      for(auto handle = std::begin(handles); handle != std::end(handles) && outcome; ++handle)
        outcome = f(control(*handle));
      return outcome;
    }
    else
      return f(control(handles));
  }

  // replaces each target by f(handle)
  template <typename Handles, typename Function>
  ARAP::Outcome change_targets(const Handles& handles, const Function& f)
  {
    return for_each_handle(handles, [&](auto handle) {
      return m_session.change_target(handle, [&] { return f(handle); });
    });
  }

  ARAP::internal::Session<Domain_> m_session;
};

#ifndef DOXYGEN_RUNNING
template <typename Mesh, typename CGAL_NP_TEMPLATE_PARAMETERS>
ARAP_deformation(Mesh&, const CGAL_NP_CLASS&)
  -> ARAP_deformation<
    Mesh,
    decltype(ARAP::internal::traits_from_parameters(std::declval<const CGAL_NP_CLASS&>())),
    decltype(ARAP::internal::domain_from_parameters(std::declval<Mesh&>(),
                                                    std::declval<const CGAL_NP_CLASS&>()))>;

template <typename Mesh>
ARAP_deformation(Mesh&) -> ARAP_deformation<Mesh>;

template <typename Domain>
ARAP_deformation(const Domain&) -> ARAP_deformation<Domain>;

template <typename Mesh, typename DeformationTraits,
          typename = std::enable_if_t<!ARAP::internal::is_named_parameters<DeformationTraits>>>
ARAP_deformation(Mesh&, const DeformationTraits&) -> ARAP_deformation<Mesh, DeformationTraits>;

template <typename Domain, typename DeformationTraits,
          typename = std::enable_if_t<!ARAP::internal::is_named_parameters<DeformationTraits>>>
ARAP_deformation(const Domain&, const DeformationTraits&)
  -> ARAP_deformation<Domain, DeformationTraits>;
#endif

} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_H
