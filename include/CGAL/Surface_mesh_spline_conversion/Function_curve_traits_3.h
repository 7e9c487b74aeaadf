// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_FUNCTION_CURVE_TRAITS_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_FUNCTION_CURVE_TRAITS_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Curve_member_traits.h>

#include <functional>
#include <memory>
#include <utility>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionCurveTraits

The class `Function_curve_3` is a handle to a curve given by functions. Copies share the functions,
and two curves are equal if they share them.

\tparam K a model of `Kernel` with a floating-point number type
*/
template <typename K>
class Function_curve_3
{
public:
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  typedef std::function<Point_3(FT)> Point_function;
  typedef std::function<Vector_3(FT, int)> Derivative_function;

  /// creates a handle that refers to no curve; it can only be compared and assigned.
  Function_curve_3() {}

  /// creates a curve from its point at a parameter, and its derivative at a parameter of an order
  /// from 1 to 3.
  Function_curve_3(Point_function point, Derivative_function derivative)
    : m_functions(std::make_shared<const Functions>(std::move(point), std::move(derivative)))
  {}

  /// returns `true` if both handles refer to the same functions.
  friend bool operator==(const Function_curve_3& a, const Function_curve_3& b)
  {
    return a.m_functions == b.m_functions;
  }

  /// returns `true` if the handles refer to different functions.
  friend bool operator!=(const Function_curve_3& a, const Function_curve_3& b) { return !(a == b); }

  /// returns the point at `t`.
  Point_3 point(const FT& t) const { return m_functions->first(t); }

  /// returns the derivative at `t`.
  Vector_3 derivative(const FT& t, int order) const { return m_functions->second(t, order); }

private:
  typedef std::pair<Point_function, Derivative_function> Functions;

  std::shared_ptr<const Functions> m_functions;
};

/*!
\ingroup PkgSurfaceMeshSplineConversionCurveTraits

The class `Function_curve_traits_3` makes boundary curves of function objects of the user.

\tparam K a model of `Kernel` with a floating-point number type

\cgalModels{BoundaryCurveTraits_3}
*/
template <typename K>
class Function_curve_traits_3
#ifndef DOXYGEN_RUNNING
  : public internal::Curve_member_traits<K, Function_curve_3<K> >
#endif
{
public:
  /// The type of the curves.
  typedef Function_curve_3<K> Curve_3;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_FUNCTION_CURVE_TRAITS_3_H
