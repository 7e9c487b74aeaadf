/*!
\ingroup PkgSurfaceMeshSplineConversionConcepts
\cgalConcept

The concept `SplineConversionVisitor` describes an object that follows a conversion and may
interrupt it. It is passed to `convert_to_T_NURCC()` by the named parameter `visitor`; a visitor
with a state is passed by `std::ref()`.

The functions are called from the thread that called `convert_to_T_NURCC()`.

\cgalRefines{CopyConstructible}
\cgalHasModelsBegin
\cgalHasModels{CGAL::Surface_mesh_spline_conversion::Default_visitor}
\cgalHasModelsEnd

\sa `CGAL::Surface_mesh_spline_conversion::convert_to_T_NURCC()`
*/
class SplineConversionVisitor
{
public:
  /// \name Progress
  /// @{

  /// is called when the stage `name` begins. The names are those of the entries `stages` of
  /// `CGAL::Surface_mesh_spline_conversion::Conversion_report`.
  void on_stage_begin(const std::string& name);

  /// is called when the stage `name` has ended after `seconds`.
  void on_stage_end(const std::string& name, double seconds);

  /// is called after each iteration of the boundary fit and of the interior fit.
  void on_iteration(
    const CGAL::Surface_mesh_spline_conversion::Conversion_report::Iteration& record);

  /// @}
  /// \name Interruption
  /// @{

  /// returns `false` if the conversion shall stop. It is called at least once in every stage and in
  /// every iteration; the conversion then returns
  /// `CGAL::Surface_mesh_spline_conversion::Error_code::INTERRUPTED`.
  bool go_further();

  /// @}
};
