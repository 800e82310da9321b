/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPDomain` describes a mesh as the class `CGAL::ARAP_deformation` sees it:
vertices with points, and simplices of one dimension.

The simplices are the triangles and polygons of a surface, or the tetrahedra of a volume. The only
connectivity needed is which simplices are incident to a vertex.

The class reads points when vertices are inserted and when it preprocesses. If `is_in_place()`, it
also reads them, as others may have moved them, at the start of each run, where a control vertex or a
control point is inserted, in `state()`, `overwrite_initial_geometry()` and
`control_point_position()`, and where a target is asked for, or changed, that is a set.
`rest_position()` reads those of vertices that it does not know. The class computes on arrays of
coordinates, and writes the points at the end of a run, in `reset()` and in `restore()`. It traverses
the simplices of the region of interest from vertex to vertex, and never the whole mesh.

An object is a handle: its copies refer to the same mesh. All member functions are `const`,
including `set_point()`, which changes the mesh and not the handle. While a `CGAL::ARAP_deformation`
uses the domain, the vertices and simplices of the mesh must not change.

Any function may throw. If `set_point()` throws while a result is written, points that were written
before keep their new values; an exception from any other function leaves all points unchanged.

To construct a `CGAL::ARAP_deformation` directly from a mesh, the domain needs a constructor that
takes a mesh. `CGAL::ARAP::check_domain()` tests a model on a mesh.

\cgalRefines{CopyConstructible,Assignable}

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP::Face_graph_domain}
\cgalHasModels{CGAL::ARAP::Triangulation_domain}
\cgalHasModels{CGAL::ARAP::Linear_cell_complex_domain}
\cgalHasModels{CGAL::ARAP::Simplex_soup_domain}
\cgalHasModelsEnd

\sa `CGAL::ARAP_deformation`
*/
class ARAPDomain
{
public:
  /// \name Types
  /// @{

  /// identifies a vertex. A model of `CopyConstructible`, `Assignable` and `EqualityComparable`.
  using vertex_descriptor = unspecified_type;

  /// identifies a simplex. A model of `CopyConstructible`, `Assignable` and `EqualityComparable`: a
  /// simplex has the same descriptor at each of its vertices.
  using simplex_descriptor = unspecified_type;

  /// a point. A model of `CopyConstructible` and `Assignable`. Copying may throw; if moving a point
  /// throws, the mesh and the object may be left partially changed.
  ///
  /// Only `CGAL::ARAP_deformation::translate()` also needs `operator[]`, which returns a %Cartesian
  /// coordinate, and a constructor from as many coordinates as a point has.
  using Point = unspecified_type;

  /// @}

  /// \name Constants
  /// @{

  /// the dimension of the simplices: 2 for triangles and polygons, 3 for tetrahedra.
  static constexpr int dimension = unspecified_value;

  /// whether points have two coordinates: nothing then leaves the plane z = 0.
  ///
  /// Optional: without it they have three.
  static constexpr bool is_planar = unspecified_value;

  /// @}

  /// \name Vertices
  /// @{

  /// returns all vertices: a range whose iterators have the value type `vertex_descriptor`, also
  /// where it is `const`.
  ///
  /// Used by `CGAL::arap_deform()` and by functions that process a whole mesh. The class
  /// `CGAL::ARAP_deformation` uses it only for the named parameter `vertex_is_constrained_map`.
  unspecified_type vertices() const;

  /// returns the index of `v`, which is unique.
  ///
  /// Use indices 0, 1, ... with few gaps: the memory of index tables grows with the largest index.
  /// Messages and models of `ARAPEdgeWeight` identify a vertex by its index.
  std::size_t index(vertex_descriptor v) const;

  /// returns the point of `v`.
  Point point(vertex_descriptor v) const;

  /// sets the point of `v`, in the mesh or in a separate output.
  void set_point(vertex_descriptor v, const Point& point) const;

  /// returns whether `point()` returns what `set_point()` has set. If not, the result of `point()`
  /// must not change.
  bool is_in_place() const;

  /// returns whether `v` is a vertex of the mesh; one that is not enters neither the region of
  /// interest nor the control vertices.
  ///
  /// Optional: without it every `v` counts as one.
  bool is_vertex(vertex_descriptor v) const;

  /// returns whether no simplex is incident to `v`.
  bool is_isolated(vertex_descriptor v) const;

  /// @}

  /// \name Points
  /// @{

  /// returns the coordinates of `point`, rounded to `double`; z = 0 if points have two coordinates.
  static CGAL::ARAP::Coordinates coordinates(const Point& point);

  /// returns the point with the given coordinates, without z if points have two coordinates.
  static Point make_point(const CGAL::ARAP::Coordinates& coordinates);

  /// @}

  /// \name Simplices
  /// @{

  /// returns the corners of `s`: a range whose iterators have the value type `vertex_descriptor`,
  /// also where it is `const`, valid until the next call of this function or of
  /// `for_each_incident_simplex()`. The corners of a polygon are in cyclic order, starting anywhere
  /// and in either direction; those of a tetrahedron are in any order.
  unspecified_type simplex_vertices(simplex_descriptor s) const;

  /// returns whether `s` is a simplex of the mesh; a control point in one that is not is refused.
  ///
  /// Optional: without it `simplex_vertices(s)` and the simplices at the first corner tell.
  bool is_simplex(simplex_descriptor s) const;

  /// calls `f(s, corners)` once for each simplex `s` incident to `v`, with the range `corners` that
  /// `simplex_vertices(s)` returns, or one that begins with another corner. `f` may throw, and may
  /// call any function of the domain, also this one.
  ///
  /// The cells need not be valid simplices: for a face with fewer than three corners, a volume
  /// without exactly four, or a repeated corner, `CGAL::ARAP_deformation::preprocess()` returns
  /// `CGAL::ARAP::Status::not_a_simplex`. If a corner does not exist, a model passes an empty
  /// range.
  template <typename Function>
  void for_each_incident_simplex(vertex_descriptor v, const Function& f) const;

  /// @}
};
