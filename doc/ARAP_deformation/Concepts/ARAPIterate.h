/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPIterate` describes the state of a run that a visitor is called with.

An object is valid only during the call of the visitor.

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP_deformation::Iterate}
\cgalHasModelsEnd

\sa `ARAPDeformationVisitor`
*/
class ARAPIterate
{
public:
  /// returns the number of iterations so far: 0 for the initial guess.
  unsigned int iteration() const;

  /// returns the energy of this iterate, with the rotations fitted to its positions. The report will
  /// have the same value in `CGAL::ARAP::Report::energy`.
  double energy() const;

  /// writes the points of this iterate: calls `put(map, v, point)` for each vertex `v` of the region
  /// of interest and each control vertex. All other vertices are where they were before the run,
  /// and are not written.
  ///
  /// Does not affect the run, unless `map` is the point map of the deformation itself. Linear time
  /// in the size of the region of interest.
  ///
  /// \tparam VertexPointMap a model of `WritablePropertyMap` from vertices to points
  template <typename VertexPointMap>
  void put_points(VertexPointMap map) const;
};
