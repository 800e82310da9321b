/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPDomain_3` describes a mesh as the class `CGAL::ARAP_deformation` sees it:
vertices with points, and simplices of one dimension.

The simplices are the triangles and polygons of a surface, or the tetrahedra of a volume. Nothing is
asked about how they are connected beyond which of them are at a vertex.

The class reads points where vertices are inserted and where it preprocesses, computes on arrays of
coordinates, and writes the points at the end of a run. It walks from vertex to vertex over the simplices
of the region of interest, and never over the whole mesh.

An object is a handle: copies of it stand for the same mesh. All member functions are `const`,
`set_point()` included, which changes the mesh and not the handle. As long as a
`CGAL::ARAP_deformation` uses the domain, the vertices and simplices of the mesh do not change.

A call may throw. If `set_point()` does so while a result is written, points that were written
before keep their new values; an exception from any other function leaves all points as they were.

To be constructible from a mesh, `CGAL::ARAP_deformation` needs a constructor of the domain that takes
a mesh. `CGAL::ARAP::check_domain()` tests a model on a mesh: programs that have a domain of their own
can call it in their tests.

\cgalRefines{CopyConstructible,Assignable}

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP::Face_graph_domain}
\cgalHasModels{CGAL::ARAP::Triangulation_domain_3}
\cgalHasModels{CGAL::ARAP::Linear_cell_complex_domain_3}
\cgalHasModels{CGAL::ARAP::Simplex_soup_domain}
\cgalHasModelsEnd

\sa `CGAL::ARAP_deformation`
*/
class ARAPDomain_3
{
public:
  /// \name Types
  /// @{

  /// identifies a vertex. A model of `CopyConstructible` and `Assignable`.
  using vertex_descriptor = unspecified_type;

  /// identifies a simplex. A model of `CopyConstructible`, `Assignable` and `EqualityComparable`: a
  /// simplex has the same descriptor wherever it is met.
  using simplex_descriptor = unspecified_type;

  /// a point. A model of `CopyConstructible` and `Assignable`. Copies may throw; if to move a point
  /// throws, the mesh and the object may be left with a part of what was to change.
  ///
  /// `CGAL::ARAP_deformation::translate()`, and no other function, also needs `operator[]`, which
  /// returns a %Cartesian coordinate, and to be constructed from three of them.
  using Point = unspecified_type;

  /// @}

  /// \name Constants
  /// @{

  /// the dimension of the simplices: 2 for triangles and polygons, 3 for tetrahedra.
  static constexpr int dimension = unspecified_value;

  /// @}

  /// \name Vertices
  /// @{

  /// returns all vertices: a range whose iterators have the value type `vertex_descriptor`.
  ///
  /// It is used by `CGAL::arap_deform()`, and by functions that look at a whole mesh; the class
  /// `CGAL::ARAP_deformation` does not call it.
  unspecified_type vertices() const;

  /// returns the index of `v`. No two vertices have the same one.
  ///
  /// The memory that tables take follows the spread of the indices that are used: they had better be
  /// 0, 1, ..., with few gaps. Sentences in reports name a vertex by its index, and models of
  /// `ARAPEdgeWeight_3` know it by this number.
  std::size_t index(vertex_descriptor v) const;

  /// returns the point of `v`.
  Point point(vertex_descriptor v) const;

  /// sets the point of `v`, in the mesh or in another place that was given for the output.
  void set_point(vertex_descriptor v, const Point& point) const;

  /// returns whether `point()` returns what `set_point()` has set. If not, points are read only once,
  /// and what `point()` returns does not change.
  bool is_in_place() const;

  /// returns whether no simplex is incident to `v`.
  bool is_isolated(vertex_descriptor v) const;

  /// @}

  /// \name Points
  /// @{

  /// returns the coordinates of `point`, rounded to `double`.
  static CGAL::ARAP::Coordinates coordinates(const Point& point);

  /// returns the point with the given coordinates.
  static Point make_point(const CGAL::ARAP::Coordinates& coordinates);

  /// @}

  /// \name Simplices
  /// @{

  /// returns the corners of `s`: a range whose iterators have the value type `vertex_descriptor`, which
  /// is valid until the next call. The corners of a polygon are in their order around it, from any
  /// of them on and in either direction; those of a tetrahedron are in any order.
  unspecified_type simplex_vertices(simplex_descriptor s) const;

  /// calls `f(s, corners)` once for each simplex `s` that is incident to `v`, with a range `corners` as
  /// `simplex_vertices()` returns it.
  ///
  /// What is given need not be a simplex: a face with fewer than three corners, a volume that does not
  /// have four, or one with a corner twice makes `CGAL::ARAP_deformation::preprocess()`
  /// return `CGAL::ARAP::Status::not_a_simplex`. A model gives an empty range where a corner does
  /// not exist.
  template <typename Function>
  void for_each_incident_simplex(vertex_descriptor v, const Function& f) const;

  /// @}
};
