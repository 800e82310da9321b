/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPDeformationVisitor` describes a function object that sees each iterate of a
run, and says whether the run goes on.

`CGAL::ARAP_deformation::deform()` takes it by reference and does not copy it. The named parameter
`visitor` of `CGAL::arap_deform()` copies what it is given: pass `std::ref(visitor)` to keep state.
A visitor must not change the object whose run it visits; it may read it.
A lambda expression will do.

An exception that it throws leaves the run like `CGAL::ARAP::Visitor_action::cancel` does, with the
mesh and the deformation as they were before, and goes on to the caller.

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP::Default_visitor}
\cgalHasModelsEnd

\sa `CGAL::ARAP_deformation::Iterate`
*/
class ARAPDeformationVisitor
{
public:
  /// is called with the initial guess, and then after each iteration, the last one included.
  ///
  /// What is returned takes precedence: a run that is stopped at its last iteration ends with
  /// `CGAL::ARAP::Status::stopped`. It need not be a `const` function.
  ///
  /// \pre The call does not change the deformation, and does not read the mesh for the
  /// iterate: the mesh keeps its points until the run ends.
  CGAL::ARAP::Visitor_action operator()(const ARAPIterate& iterate);
};
