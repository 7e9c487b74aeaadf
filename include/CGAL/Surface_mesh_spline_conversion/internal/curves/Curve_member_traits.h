// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CURVE_MEMBER_TRAITS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CURVE_MEMBER_TRAITS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// makes boundary curves of a class of curves with the members `point(t)` and
/// `derivative(t, order)`.
template <typename K, typename Curve>
class Curve_member_traits
{
public:
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef Curve Curve_3;

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

/// adds the normals of a surface along its curves, which have the member `normal(t)`.
template <typename K, typename Curve>
class Curve_member_traits_with_normals : public Curve_member_traits<K, Curve>
{
public:
  struct Construct_normal_on_curve_3
  {
    typename K::Vector_3 operator()(const Curve& curve, const typename K::FT& t) const
    {
      return curve.normal(t);
    }
  };

  Construct_normal_on_curve_3 construct_normal_on_curve_3_object() const
  {
    return Construct_normal_on_curve_3();
  }
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CURVE_MEMBER_TRAITS_H
