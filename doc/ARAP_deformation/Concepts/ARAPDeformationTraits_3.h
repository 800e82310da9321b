/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPDeformationTraits_3` names the numeric parts of the class
`CGAL::ARAP_deformation`, and hands out objects of them.

The class keeps a copy of its traits, and asks for each object once in every preprocessing. Whatever
data the objects need, the traits hold.

`DefaultConstructible` is asked for only where a `CGAL::ARAP_deformation` is constructed without
traits.

\cgalRefines{CopyConstructible,Assignable}

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP_deformation_traits_3}
\cgalHasModelsEnd
*/
class ARAPDeformationTraits_3
{
public:
  /// \name Types
  /// @{

  /// a model of `ARAPSparseSolver`.
  using Sparse_solver = unspecified_type;

  /// a model of `ARAPEdgeWeight_3`.
  using Edge_weight = unspecified_type;

  /// a model of `ARAPClosestRotation_3`.
  using Closest_rotation = unspecified_type;

  /// `CGAL::Sequential_tag`, `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`, which is taken
  /// where this type is missing. Results do not depend on it.
  using Concurrency_tag = unspecified_type;

  /// @}

  /// \name Objects
  /// @{

  /// returns a solver, of which a copy factorizes each matrix.
  Sparse_solver sparse_solver_object() const;

  /// returns the edge weights.
  Edge_weight edge_weight_object() const;

  /// returns the rotation fitting.
  Closest_rotation closest_rotation_object() const;

  /// @}
};
