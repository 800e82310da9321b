/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPSparseSolver` describes a solver for sparse symmetric positive definite
matrices and right-hand sides of three columns.

The solver may be direct or iterative. What it solves for are corrections, so that the result does
not depend on its accuracy; how many iterations it takes may.

The calls come in the order `analyze()`, `factorize()`, and then `solve()` any number of times, and
`set_border()` between them where there is one. `factorize()` may follow again at any time, without
`analyze()`, with other values of the same pattern: also after `solve()` and `set_border()`, and after
it has returned `false`. `solve()` and `set_border()` may follow again after they have failed or
thrown. No two calls of one solver overlap; they may come from different threads one after the other.

`CGAL::ARAP_deformation` copies the solver that its traits hand out, once for each pattern that it
analyzes, and it does so before the first call of `analyze()`. A copy of a solver that has a factor
need not have it too. Eigen's solvers cannot be copied; `CGAL::ARAP::Eigen_sparse_solver` makes a
model of any of them.

Smooth rotations and coarse starts have solvers of their own; harmonic rotations and the second look
at a minimum solve the system of the deformation once more. Where one of these fails, the run goes on
without what it is for. Other failures have the status that is named below.

The function `CGAL::ARAP::check_sparse_solver()` tests a model.

A call may throw, for example `std::bad_alloc`; the deformation is then as it was before.

\cgalRefines{CopyConstructible}

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP::Multifrontal_cholesky_solver}
\cgalHasModels{CGAL::ARAP::Cholmod_solver}
\cgalHasModels{CGAL::ARAP::Petsc_solver}
\cgalHasModels{CGAL::ARAP::Eigen_sparse_solver<EigenSolver>}
\cgalHasModels{CGAL::ARAP::Sparse_linear_algebra_adaptor<SparseLinearAlgebra>}
\cgalHasModelsEnd

\sa `ARAPDeformationTraits`
*/
class ARAPSparseSolver
{
public:
  /// prepares the factorization of matrices with the pattern of `a`. An iterative solver may have
  /// nothing to do here.
  ///
  /// Only the lower triangle of `a` is stored, in Eigen's compressed form, and `a` has at least one row.
  /// Its values need not be looked at. Some of them may be zero. The matrix does not outlive
  /// the call.
  ///
  /// Returns whether it succeeded. If not, the call of the deformation returns
  /// `CGAL::ARAP::Status::singular_matrix`.
  bool analyze(const CGAL::ARAP::Sparse_matrix& a);

  /// factorizes `a`, which has the pattern of the last call of `analyze()`. The matrix does not outlive
  /// the call.
  ///
  /// Returns whether it succeeded; it does not if `a` is found not to be positive definite. Then the
  /// call of the deformation returns `CGAL::ARAP::Status::singular_matrix`.
  bool factorize(const CGAL::ARAP::Sparse_matrix& a);

  /// replaces the rows `x[0]`, ..., `x[n-1]` of a matrix \f$X\f$ with three columns by the solution of
  /// \f$A Y = X\f$, where \f$A\f$ is the matrix of the last call of `factorize()` and `n` the number
  /// of its rows.
  ///
  /// Returns whether it succeeded. If not, `x` may hold anything, and the call of the deformation
  /// returns `CGAL::ARAP::Status::solver_failed`. So does a run in which a solution \f$y\f$ for the
  /// force \f$f\f$ makes the energy rise by more than a hundredth, or has \f$f^T y < 0\f$, by more than
  /// rounding errors and the tolerance. If the solution is not finite, the run ends with
  /// `CGAL::ARAP::Status::non_finite_energy`, as with targets that are too far away. The iteration
  /// solves for corrections, so that rounding errors of a solution are made up for by the next one.
  bool solve(std::size_t n, CGAL::ARAP::Coordinates* x);

  /// gives the matrix \f$A\f$ of the last call of `factorize()` a border, or removes it if `b` has no
  /// columns; `factorize()` removes it too. Optional: without it each change of control vertices needs
  /// a factorization.
  ///
  /// With a border, `x` in `solve()` has as many more rows as `b` has columns, and the system is
  /// \f[ \begin{pmatrix} A & B \\ B^T & D \end{pmatrix} \begin{pmatrix} x \\ z \end{pmatrix}
  /// = \begin{pmatrix} f \\ g \end{pmatrix}. \f]
  /// All entries of `b` are stored, in Eigen's compressed form; of `d` the lower triangle counts. The
  /// solver must not refer to them after the call.
  ///
  /// The rows of the border whose diagonal entry in `d` is zero or negative are multipliers: with zero
  /// their row is a constraint \f$b^T x = g\f$, with \f$-1/w\f$ a penalty \f$w (b^T x - g)^2\f$
  /// that is added to \f$x^T A x - 2 f^T x\f$, of which the solution is the minimum. The other rows
  /// belong to further unknowns.
  ///
  /// Returns whether the bordered matrix has exactly as many negative eigenvalues as there are
  /// multipliers, and can be solved safely. If not, there is no border.
  bool set_border(const CGAL::ARAP::Sparse_matrix& b, const CGAL::ARAP::Dense_matrix& d);
};
