// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_CURVE_TRAITS_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_CURVE_TRAITS_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_3.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionCurveTraits

The class `NURBS_curve_traits_3` makes boundary curves of (rational) B-spline curves, among them
line segments and circular arcs; see `NURBS_curve_3` for their creation. Evaluation does not
allocate memory for degrees below 10.

\tparam K a model of `Kernel` with a floating-point number type

\cgalModels{BoundaryCurveTraits_3}
*/
template <typename K>
class NURBS_curve_traits_3
{
public:
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef NURBS_curve_3<K> Curve_3;

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

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_CURVE_TRAITS_3_H
