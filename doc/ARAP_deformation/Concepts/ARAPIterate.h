/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPIterate` describes the state of a run after some iteration, as a visitor sees
it.

An object is valid during the call of the visitor that gets it, and no longer.

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP_deformation::Iterate}
\cgalHasModelsEnd

\sa `ARAPDeformationVisitor`
*/
class ARAPIterate
{
public:
  /// returns the number of iterations up to here: 0 for the initial guess.
  unsigned int iteration() const;

  /// returns the energy of this iterate, with the best rotations for its positions. It is what
  /// `CGAL::ARAP::Report::energy` will hold.
  double energy() const;

  /// writes the points of this iterate: calls `put(map, v, point)` for each free vertex and each
  /// control vertex `v`. All other vertices are where they were before the run, and are not written.
  ///
  /// The run does not depend on what `map` does with the points, unless it is the map of the
  /// deformation itself. Linear time in the size of the region of interest.
  ///
  /// \tparam VertexPointMap a model of `WritablePropertyMap` from vertices to points
  template <typename VertexPointMap>
  void put_points(VertexPointMap map) const;
};
