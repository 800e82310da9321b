/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPEdgeWeight_3` describes how the edges of a shape are weighted in the energy.

Weights are computed while `CGAL::ARAP_deformation` preprocesses, from the rest shape alone, in two
steps. `simplex_weights()` gives each edge of each simplex its weight there. `edge_weight()` then
turns them into the weight of an edge in an edge set: it gets the sum over those simplices at the edge
that belong to the edge set. In the star of a vertex these are all simplices at the edge; in a simplex it
is this simplex alone.

A polygon has the average weights of all its triangulations, on its edges and on its diagonals. A model
has nothing to do for it: it is asked about the triangles. The share of a
triangle goes to zero where its corners come to lie on a line, unless those of all others do so, too.

The energy \f$\sum w \|e' - R e\|^2\f$ scales with the weights and its minima do not, so that their unit
is free. Cotangents have none in triangles and are lengths in tetrahedra: with them the energy is an
area or a volume.

The matrix of the system gets the sum of the weights that an edge has in all edge sets, so that it is
symmetric whatever they are. If no weight is negative, no cell has a negative energy. Negative weights are
allowed where the matrix is positive definite: this is tested by its factorization.

Stars are asked for in two cases: if the cells are `CGAL::ARAP::Cell_scheme::spokes()`, and for
`CGAL::ARAP::Initial_guess::laplacian` whatever the cells.

A model may hold data. `CGAL::ARAP_deformation` works on a copy of the object that its traits hand
out, and calls it from several threads at once where programs are linked with TBB: it must not change
what it holds. `CGAL::ARAP::check_edge_weight()` tests a model.

\cgalRefines{CopyConstructible,Assignable}

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP::Safe_cotangent_weight}
\cgalHasModels{CGAL::ARAP::Cotangent_weight}
\cgalHasModels{CGAL::ARAP::Clamped_cotangent_weight}
\cgalHasModels{CGAL::ARAP::Uniform_weight}
\cgalHasModels{CGAL::ARAP::Edge_map_weight}
\cgalHasModelsEnd

\sa `ARAPDeformationTraits_3`
*/
class ARAPEdgeWeight_3
{
public:
  /// returns the weights of the edges \f$(0,1)\f$, \f$(0,2)\f$ and \f$(1,2)\f$ of a triangle, given by
  /// the coordinates of its vertices in the rest shape.
  ///
  /// The order of the vertices carries no meaning: in another order the weights are those of the
  /// same edges. A weight that is infinite or not a number makes the preprocessing fail with
  /// `CGAL::ARAP::Status::non_finite_weight` and a sentence that names the triangle.
  std::array<double, 3>
  simplex_weights(const std::array<CGAL::ARAP::Coordinates, 3>& triangle) const;

  /// returns the weights of the edges \f$(0,1)\f$, \f$(0,2)\f$, \f$(0,3)\f$, \f$(1,2)\f$,
  /// \f$(1,3)\f$ and \f$(2,3)\f$ of a tetrahedron, given by the coordinates of its vertices in the
  /// rest shape. What is said about triangles holds here too.
  ///
  /// A model for surfaces only need not have this function: then it cannot be used with a domain of
  /// tetrahedra.
  std::array<double, 6>
  simplex_weights(const std::array<CGAL::ARAP::Coordinates, 4>& tetrahedron) const;

  /// returns the weight of an edge in an edge set of the given kind.
  ///
  /// \param edge_set the kind of the edge set
  /// \param i the index of one vertex of the edge in the domain; of a star, its centre
  /// \param j the index of the other vertex
  /// \param sum the sum of the weights that `simplex_weights()` gave the edge in the simplices of the
  ///        edge set
  ///
  /// If the weights at a free vertex do not add up to a positive finite number the preprocessing
  /// fails with `CGAL::ARAP::Status::singular_matrix`.
  double edge_weight(CGAL::ARAP::Edge_set edge_set, std::size_t i, std::size_t j, double sum) const;
};
