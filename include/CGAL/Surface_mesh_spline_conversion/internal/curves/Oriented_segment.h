// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_ORIENTED_SEGMENT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_ORIENTED_SEGMENT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Curve_segment.h>

#include <CGAL/assertions.h>

#include <cmath>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Evaluates the curve of a segment in the direction of the segment, with respect to arc length.
template <typename Traits>
class Oriented_segment
{
public:
  typedef typename Traits::FT FT;
  typedef typename Traits::Point_3 Point_3;
  typedef typename Traits::Vector_3 Vector_3;
  typedef Curve_segment<Traits> Segment;

  Oriented_segment(const Traits& traits, const Segment& segment)
    : m_point(traits.construct_point_on_curve_3_object()),
      m_derivative(traits.construct_derivative_on_curve_3_object()),
      m_segment(segment)
  {}

  Point_3 point(const FT& t) const { return m_point(m_segment.curve, t); }

  FT speed(const FT& t) const
  {
    return std::sqrt(m_derivative(m_segment.curve, t, 1).squared_length());
  }

  // returns the derivative of the given order, 1 to 3, with respect to arc length at t. With the
  // speed v = |C'| the operator is (1/v) d/dt, applied one to three times.
  Vector_3 derivative(const FT& t, int order) const
  {
    CGAL_precondition(1 <= order && order <= 3);
    FT parameter = t;
    Vector_3 c1 = m_derivative(m_segment.curve, t, 1);
    FT v = std::sqrt(c1.squared_length());
    if(!(v > FT(0)))
    {
      // a cusp of the parametrization, not of the curve: the direction exists next to it
      parameter = inside(t);
      c1 = m_derivative(m_segment.curve, parameter, 1);
      v = std::sqrt(c1.squared_length());
    }
    const FT sign = (m_segment.first < m_segment.second) ? FT(1) : FT(-1);
    if(order == 1)
      return (sign / v) * c1;

    const Vector_3 c2 = m_derivative(m_segment.curve, parameter, 2);
    const FT v1 = (c1 * c2) / v;
    const Vector_3 w = v * c2 - v1 * c1; // the second derivative is w / v^3
    if(order == 2)
      return (FT(1) / (v * v * v)) * w;

    const Vector_3 c3 = m_derivative(m_segment.curve, parameter, 3);
    const FT v2 = (c2 * c2 + c1 * c3 - v1 * v1) / v;
    return (sign / (v * v * v * v)) * (v * c3 - v2 * c1 - (FT(3) * v1 / v) * w);
  }

  // The limits of tangent and curvature vector at the ends of the segment, from inside: the curve
  // may have a knot there at which the traits return the derivative of the other side.
  Vector_3 derivative_at_begin(int order) const
  {
    return derivative(inside(m_segment.first), order);
  }

  Vector_3 derivative_at_end(int order) const
  {
    return derivative(inside(m_segment.second), order);
  }

private:
  // returns a parameter next to t on the side of the middle of the segment. The offset, relative to
  // the segment, is far above the rounding of parameters and turns a tangent by far less than
  // any angle that matters.
  FT inside(const FT& t) const
  {
    const FT relative_offset(1e-7);
    const FT middle = (m_segment.first + m_segment.second) / FT(2);
    return t + relative_offset * (middle - t);
  }

  typename Traits::Construct_point_on_curve_3 m_point;
  typename Traits::Construct_derivative_on_curve_3 m_derivative;
  const Segment& m_segment;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_ORIENTED_SEGMENT_H
