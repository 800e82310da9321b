/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPDeformationTraits` defines the types of the numeric parts of the class
`CGAL::ARAP_deformation`, and provides objects of them.

The class keeps a copy of its traits, and requests the objects anew whenever it collects the region
(`CGAL::ARAP::Stages::region`). The traits store any data that the objects need. Weights that change
between these times have an `ARAPEdgeWeight::version()`.

A model must be `DefaultConstructible` only if a `CGAL::ARAP_deformation` is constructed without
traits.

\cgalRefines{CopyConstructible}

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP_deformation_traits}
\cgalHasModelsEnd
*/
class ARAPDeformationTraits
{
public:
  /// \name Types
  /// @{

  /// a model of `ARAPSparseSolver`.
  using Sparse_solver = unspecified_type;

  /// a model of `ARAPEdgeWeight`.
  using Edge_weight = unspecified_type;

  /// a model of `ARAPClosestRotation`.
  using Closest_rotation = unspecified_type;

  /// `CGAL::Sequential_tag`, `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`. Optional;
  /// the last one is the default. Results do not depend on it.
  using Concurrency_tag = unspecified_type;

  /// @}

  /// \name Objects
  /// @{

  /// returns the solver, which is copied for each pattern of a matrix.
  Sparse_solver sparse_solver_object() const;

  /// returns the edge weights.
  Edge_weight edge_weight_object() const;

  /// returns the rotation fitting.
  Closest_rotation closest_rotation_object() const;

  /// @}
};
