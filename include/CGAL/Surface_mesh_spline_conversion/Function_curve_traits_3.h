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

#include <functional>
#include <memory>
#include <utility>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionCurveTraits

The class `Function_curve_traits_3` makes boundary curves of function objects of the user.

\tparam K a model of `Kernel` with a floating-point number type

\cgalModels{BoundaryCurveTraits_3}
*/
template <typename K>
class Function_curve_traits_3
{
public:
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  /// is a handle to a curve given by functions. Copies share the functions, and two curves are
  /// equal if they share them.
  class Curve_3
  {
  public:
    typedef std::function<Point_3(FT)> Point_function;
    typedef std::function<Vector_3(FT, int)> Derivative_function;

    /// creates a handle that refers to no curve; it can only be compared and assigned.
    Curve_3() {}

    /// creates a curve from its point at a parameter, and its derivative at a parameter of an order
    /// from 1 to 3.
    Curve_3(Point_function point, Derivative_function derivative)
      : m_functions(std::make_shared<const Functions>(std::move(point), std::move(derivative)))
    {}

    /// returns `true` if both handles refer to the same functions.
    friend bool operator==(const Curve_3& a, const Curve_3& b)
    {
      return a.m_functions == b.m_functions;
    }

    /// returns `true` if the handles refer to different functions.
    friend bool operator!=(const Curve_3& a, const Curve_3& b) { return !(a == b); }

    /// returns the point at `t`.
    Point_3 point(const FT& t) const { return m_functions->first(t); }

    /// returns the derivative at `t`.
    Vector_3 derivative(const FT& t, int order) const { return m_functions->second(t, order); }

  private:
    typedef std::pair<Point_function, Derivative_function> Functions;

    std::shared_ptr<const Functions> m_functions;
  };

  struct Construct_point_on_curve_3
  {
    Point_3 operator()(const Curve_3& curve, const FT& t) const { return curve.point(t); }
  };

  struct Construct_derivative_on_curve_3
  {
    Vector_3 operator()(const Curve_3& curve, const FT& t, int order) const
    {
      return curve.derivative(t, order);
    }
  };

  Construct_point_on_curve_3 construct_point_on_curve_3_object() const
  {
    return Construct_point_on_curve_3();
  }

  Construct_derivative_on_curve_3 construct_derivative_on_curve_3_object() const
  {
    return Construct_derivative_on_curve_3();
  }
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_FUNCTION_CURVE_TRAITS_3_H
