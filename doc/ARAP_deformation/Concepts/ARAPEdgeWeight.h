/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPEdgeWeight` describes how the edges of a shape are weighted in the energy.

`CGAL::ARAP_deformation` computes the weights in preprocessing, from the rest shape alone, in two
steps. `simplex_weights()` returns the weight of each edge in each simplex. `edge_weight()` then
returns the weight of an edge in an edge set, given the sum over the simplices that contain the edge
and belong to the edge set. In the star of a vertex these are all simplices at the edge; in a
simplex it is this simplex alone.

The weights of the edges and diagonals of a polygon are averages over all its triangulations, with
more than 64 corners over those that are fans. A model need not support polygons: it is called for
their triangles. The share of a triangle goes to zero as its corners become collinear, unless all
other triangles degenerate too.

The energy \f$\sum w \|e' - R e\|^2\f$ scales with the weights, but its minima do not: the unit of
the weights is arbitrary. Cotangent weights are dimensionless in triangles and lengths in
tetrahedra: the energy is then an area or a volume.

The matrix of the system sums the weights of an edge over all edge sets, so it is always symmetric.
If no weight is negative, no cell has a negative energy. Negative weights are allowed as long as the
matrix is positive definite, which the factorization checks.

Weights in stars are needed for the cells `CGAL::ARAP::Cell_scheme::spokes()` and `k_ring()`, and
for `CGAL::ARAP::Initial_guess::laplacian` with any cells.

What a weight depends on besides the shape of a simplex, such as data at faces, has to come by way
of the indices \f$i\f$ and \f$j\f$, or of the stiffness of cells
(`CGAL::ARAP_deformation::set_stiffness()`).

A model may have state. `CGAL::ARAP_deformation` works on a copy of the object that its traits
provide. If copies share their state, and it may change, the model tells so by `version()`. In
programs linked with TBB several threads call it concurrently: a call must not change the state. It
may throw; the deformation is then as it was before.

The function `CGAL::ARAP::check_edge_weight()` tests a model.

\cgalRefines{CopyConstructible}

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP::Safe_cotangent_weight}
\cgalHasModels{CGAL::ARAP::Cotangent_weight}
\cgalHasModels{CGAL::ARAP::Clamped_cotangent_weight}
\cgalHasModels{CGAL::ARAP::Uniform_weight}
\cgalHasModels{CGAL::ARAP::Edge_map_weight}
\cgalHasModels{CGAL::ARAP::Chosen_edge_weight}
\cgalHasModelsEnd

\sa `ARAPDeformationTraits`
*/
class ARAPEdgeWeight
{
public:
  /// returns the weights of the edges \f$(0,1)\f$, \f$(0,2)\f$ and \f$(1,2)\f$ of a triangle, given
  /// by the coordinates of its vertices in the rest shape.
  ///
  /// The weight of an edge must not depend on the order of the vertices. If a weight is infinite or
  /// not a number, preprocessing fails with `CGAL::ARAP::Status::non_finite_weight` and a message
  /// that names the triangle.
  std::array<double, 3>
  simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>& triangle) const;

  /// returns the weights of the edges \f$(0,1)\f$, \f$(0,2)\f$, \f$(0,3)\f$, \f$(1,2)\f$,
  /// \f$(1,3)\f$ and \f$(2,3)\f$ of a tetrahedron, given by the coordinates of its vertices in the
  /// rest shape. The same rules as for triangles apply.
  ///
  /// Optional: without it a model cannot be used with tetrahedra.
  std::array<double, 6>
  simplex_weights(const std::array<CGAL::ARAP::Coordinates, 4>& tetrahedron) const;

  /// returns the weight of an edge, or of a diagonal of a polygon, in an edge set of the given kind.
  /// In a simplex it must not depend on which vertex comes first.
  ///
  /// \param edge_set the kind of the edge set
  /// \param i the domain's index of one vertex of the edge; in a star, of its center
  /// \param j the index of the other vertex
  /// \param sum the sum of the weights of the edge, as returned by `simplex_weights()`, over the
  ///        simplices of the edge set
  ///
  /// Preprocessing fails with `CGAL::ARAP::Status::non_finite_weight` if a weight is infinite or not
  /// a number, and with `CGAL::ARAP::Status::singular_matrix` if the weights at a free vertex that
  /// is connected by non-zero ones do not add up to a positive number. Weights in stars that only
  /// `CGAL::ARAP::Initial_guess::laplacian` needs are computed, and tested, when a run begins.
  double edge_weight(CGAL::ARAP::Edge_set edge_set, std::size_t i, std::size_t j, double sum) const;

  /// returns a number that changes when weights do: the next `deform()` computes all weights again.
  ///
  /// Optional: without it the weights of a rest shape must not change.
  std::size_t version() const;
};
