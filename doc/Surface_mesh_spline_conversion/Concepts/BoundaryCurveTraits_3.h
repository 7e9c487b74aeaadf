/*!
\ingroup PkgSurfaceMeshSplineConversionConcepts
\cgalConcept

\cgalRefines{CopyConstructible}

The concept `BoundaryCurveTraits_3` describes the parametric curves in space that bound a triangle
mesh, as far as the conversion to a T-NURCC surface evaluates them: points and derivatives.

A curve should be twice continuously differentiable with a derivative that does not vanish, between
the parameters of any two consecutive boundary vertices; knots where it is less smooth are allowed,
and cost more patches. Where the tangent of the boundary jumps, there must be a vertex of the mesh.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Surface_mesh_spline_conversion::NURBS_curve_traits_3<K>}
\cgalHasModels{CGAL::Surface_mesh_spline_conversion::Curve_on_surface_traits_3<K>}
\cgalHasModels{CGAL::Surface_mesh_spline_conversion::Function_curve_traits_3<K>}
\cgalHasModels{CGAL::Surface_mesh_spline_conversion::Open_cascade_curve_traits_3<K>}
\cgalHasModels{CGAL::Surface_mesh_spline_conversion::Variant_curve_traits_3<Traits...>}
\cgalHasModelsEnd

\sa `CGAL::Surface_mesh_spline_conversion::Boundary_curve_network_3`
\sa `CGAL::Surface_mesh_spline_conversion::Curve_segment`
*/
class BoundaryCurveTraits_3
{
public:
  /// \name Types
  /// @{

  /// The number type, a floating-point type. It is also the type of the parameters of curves.
  typedef unspecified_type FT;

  /// The point type of a model of `Kernel` with the number type `FT`. It is the point type of the
  /// mesh.
  typedef unspecified_type Point_3;

  /// The vector type of the same kernel.
  typedef unspecified_type Vector_3;

  /// The type of a curve. It must be a model of `DefaultConstructible`, `CopyConstructible`,
  /// `Assignable` and `EqualityComparable`, and cheap to copy: usually a handle. Consecutive
  /// boundary edges with equal curves are taken as parts of one curve.
  typedef unspecified_type Curve_3;

  /// A construction object that must provide the operator
  ///
  /// `Point_3 operator()(const Curve_3& c, FT t) const`, which returns the point of `c` at the
  /// parameter `t`.
  typedef unspecified_type Construct_point_on_curve_3;

  /// A construction object that must provide the operator
  ///
  /// `Vector_3 operator()(const Curve_3& c, FT t, int order) const`, which returns the derivative
  /// of `c` at the parameter `t`, for `order` 1, 2 and 3. Where the derivative jumps, it may be
  /// that of either side.
  typedef unspecified_type Construct_derivative_on_curve_3;

  /// @}
  /// \name Operations
  /// The functors may be used by several threads at a time.
  /// @{

  /// returns the functor for points.
  Construct_point_on_curve_3 construct_point_on_curve_3_object() const;

  /// returns the functor for derivatives.
  Construct_derivative_on_curve_3 construct_derivative_on_curve_3_object() const;

  /// @}
};
