/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPClosestRotation_3` describes a function object that finds the rotations
closest to given matrices.

It is the local step of the iteration: the matrices are the covariances
\f$C = \sum w\, e' e^T\f$ of the cells, with \f$e\f$ the edges in the rest shape and \f$e'\f$ the
present ones.

A model may hold data. `CGAL::ARAP_deformation` works on a copy of the object that its traits hand
out, and calls it for some hundred cells at a time, from several threads at once where programs are
linked with TBB: it must not change what it holds.

The function `CGAL::ARAP::check_closest_rotation()` tells which identities a model violates.

\cgalRefines{CopyConstructible,Assignable}

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP::SVD_closest_rotation}
\cgalHasModels{CGAL::ARAP::Newton_closest_rotation}
\cgalHasModels{CGAL::ARAP::Closest_rotation_traits_adaptor<ClosestRotationTraits>}
\cgalHasModelsEnd

\sa `ARAPDeformationTraits_3`
*/
class ARAPClosestRotation_3
{
public:
  /// computes for each `k` in `[0, n)` the rotation \f$R\f$ with the smallest Frobenius norm
  /// \f$\|R - C\|_F\f$, where \f$C\f$ is `covariances[k]`, and stores it in `rotations[k]`. This is the
  /// rotation with the largest trace of \f$R^T C\f$.
  ///
  /// Each result is orthonormal and has determinant \f$+1\f$ up to rounding, also where \f$C\f$ is
  /// singular or its determinant is negative. Where several rotations are equally close any of them
  /// will do; the choice should be a function of the arguments alone.
  ///
  /// On entry `rotations[k]` is the rotation that was found for the same cell before, the identity at
  /// first: a model may start from it. The arrays do not overlap. `n` may be 0, and then the pointers
  /// may be null.
  ///
  /// There is no way to report failure. If positions have overflowed, a covariance has entries that
  /// are infinite or not a number: then any result is accepted, and the run ends with
  /// `CGAL::ARAP::Status::non_finite_energy`. That the energy never rises rests on the
  /// rotations being the closest ones.
  void operator()(std::size_t n, const CGAL::ARAP::Matrix_3x3* covariances,
                  CGAL::ARAP::Matrix_3x3* rotations) const;
};
