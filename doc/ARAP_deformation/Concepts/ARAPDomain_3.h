/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPDomain_3` describes a mesh as the class `CGAL::ARAP_deformation` sees it:
vertices with points, and simplices.

The class reads points where vertices are inserted and where it preprocesses, computes on arrays of
coordinates, and writes the points at the end of a run. It walks from vertex to vertex over the simplices
of the region of interest, and never over the whole mesh.

An object is a handle: copies of it stand for the same mesh. All member functions are `const`,
`set_point()` included, which changes the mesh and not the handle. As long as a
`CGAL::ARAP_deformation` uses the domain, the vertices and simplices of the mesh do not change.

A call may throw. If `set_point()` does so while a result is written, points that were written
before keep their new values; an exception from any other function leaves all points as they were.

To be constructible from a mesh alone, `CGAL::ARAP_deformation` needs a constructor of the domain
that takes a mesh.

\cgalRefines{CopyConstructible,Assignable}

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP::Face_graph_domain}
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

  /// identifies a simplex. A model of `CopyConstructible`, `Assignable` and `EqualityComparable`.
  using simplex_descriptor = unspecified_type;

  /// a point. A model of `CopyConstructible` and `Assignable`.
  ///
  /// `CGAL::ARAP_deformation::translate()`, and no other function, also needs `operator[]`, which
  /// returns a %Cartesian coordinate, and a constructor from three of them.
  using Point = unspecified_type;

  /// @}

  /// \name Constants
  /// @{

  /// the number of vertices of each simplex. It is 3: the simplices are triangles.
  static constexpr std::size_t vertices_per_simplex = 3;

  /// @}

  /// \name Vertices
  /// @{

  /// returns the index of `v`. No two vertices have the same one.
  ///
  /// The memory that tables take follows the spread of the indices that are used: they had better be
  /// 0, 1, ..., with few gaps. Sentences in reports name a vertex by its index.
  std::size_t index(vertex_descriptor v) const;

  /// returns the point of `v`.
  Point point(vertex_descriptor v) const;

  /// sets the point of `v`.
  void set_point(vertex_descriptor v, const Point& point) const;

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

  /// returns the vertices of `s`, in any order.
  std::array<vertex_descriptor, 3> simplex_vertices(simplex_descriptor s) const;

  /// calls `f(s, vertices)` once for each simplex `s` that is incident to `v`. The second argument is
  /// a `std::array<vertex_descriptor, 3>` with the vertices of `s`, in any order.
  ///
  /// Returns `true` if all of them were simplices, and `false` as soon as a face is not: then
  /// `CGAL::ARAP_deformation::preprocess()` returns `CGAL::ARAP::Status::not_a_triangle`.
  template <typename Function>
  bool for_each_incident_simplex(vertex_descriptor v, const Function& f) const;

  /// @}
};
