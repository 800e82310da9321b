/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPClosestRotation` describes a function object that finds the rotations
closest to given matrices.

This is the local step of the iteration: the matrices are the covariances
\f$C = \sum w\, e' e^T\f$ of the cells, with \f$e\f$ the edges in the rest shape and \f$e'\f$ those
in the current shape. Bending and smooth rotations add to them.

A model may have state. `CGAL::ARAP_deformation` works on a copy of the object that its traits
provide, and calls it for up to 256 cells at a time; for one where cells share a rotation
(`CGAL::ARAP_deformation::set_groups()`) and in the drop-in class with `SRE_ARAP`. In programs linked
with TBB several threads call it concurrently: a call must not change the state. It may throw; the
deformation is then as it was before.

The function `CGAL::ARAP::check_closest_rotation()` tests a model.

\cgalRefines{CopyConstructible}

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP::SVD_closest_rotation}
\cgalHasModels{CGAL::ARAP::Newton_closest_rotation}
\cgalHasModels{CGAL::ARAP::Closest_rotation_traits_adaptor<ClosestRotationTraits>}
\cgalHasModelsEnd

\sa `ARAPDeformationTraits`
*/
class ARAPClosestRotation
{
public:
  /// computes for each `k` in `[0, n)` the rotation \f$R\f$ with the smallest Frobenius norm
  /// \f$\|R - C\|_F\f$, where \f$C\f$ is `covariances[k]`, and stores it in `rotations[k]`. This is
  /// the rotation with the largest trace of \f$R^T C\f$.
  ///
  /// Each result is orthonormal and has determinant \f$+1\f$ up to rounding, even if \f$C\f$ is
  /// singular or has a negative determinant. If several rotations are equally close, any of them is
  /// valid; the choice should depend on the arguments only.
  ///
  /// On entry `rotations[k]` is the previous rotation of the same cell, initially the identity: a
  /// model may start from it. The arrays do not overlap. If `n` is 0, the pointers may be null.
  ///
  /// If positions have overflowed, a covariance may have entries that are infinite or not a number:
  /// any result is then accepted for it, but those for other cells must not depend on it, and the
  /// run fails with `CGAL::ARAP::Status::non_finite_energy`. The energy is guaranteed never to rise
  /// only if the rotations are the closest ones.
  void operator()(std::size_t n, const CGAL::ARAP::Matrix_3x3* covariances,
                  CGAL::ARAP::Matrix_3x3* rotations) const;
};
