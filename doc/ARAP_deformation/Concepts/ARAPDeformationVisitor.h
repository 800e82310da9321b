/*!
\ingroup PkgARAPDeformationConcepts
\cgalConcept

\brief The concept `ARAPDeformationVisitor` describes a function object, for example a lambda, that
is called at each iterate of a run and decides whether the run continues.

`CGAL::ARAP_deformation::deform()` takes the visitor by reference and does not copy it. The named
parameter `visitor` of `CGAL::arap_deform()` copies its argument: pass `std::ref(visitor)` to keep
state. A visitor may read the object whose run it visits, but must not change it.

An exception that a visitor throws ends the run, leaves the mesh and the deformation unchanged, as
`CGAL::ARAP::Visitor_action::cancel` does, and propagates to the caller.

\cgalHasModelsBegin
\cgalHasModels{CGAL::ARAP::Default_visitor}
\cgalHasModelsEnd

\sa `CGAL::ARAP_deformation::Iterate`
*/
class ARAPDeformationVisitor
{
public:
  /// is called with the initial guess and after each iteration, including the last one. Need not be
  /// `const`.
  ///
  /// The returned action takes precedence: a run that is stopped at its last iteration ends with
  /// `CGAL::ARAP::Status::stopped`. The mesh keeps its points until the run ends: read the iterate
  /// from `iterate`, not from the mesh.
  ///
  /// \pre The call does not change the deformation.
  CGAL::ARAP::Visitor_action operator()(const ARAPIterate& iterate);
};
