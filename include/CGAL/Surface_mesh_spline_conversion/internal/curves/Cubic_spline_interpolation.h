// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CUBIC_SPLINE_INTERPOLATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CUBIC_SPLINE_INTERPOLATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_3.h>

#include <CGAL/Origin.h>
#include <CGAL/assertions.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The C2 cubic spline through given points, with chord-length parameters.
//
// A closed one is periodic; an open one satisfies the not-a-knot condition at both ends (two points
// give a line, three a parabola). The unknowns are the derivatives at the points; the result is a
// B-spline curve with a simple knot at every point.
template <typename K>
class Cubic_spline_interpolation
{
public:
  typedef std::size_t size_type;
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;

  // Of a closed spline, the first point must be repeated at the end.
  // \pre consecutive points differ
  Cubic_spline_interpolation(const std::vector<Point_3>& points, bool is_closed)
    : m_points(points)
  {
    CGAL_precondition(points.size() >= (is_closed ? 3u : 2u));
    m_parameters.push_back(FT(0));
    for(size_type i = 0; i + 1 < points.size(); ++i)
      m_parameters.push_back(m_parameters.back()
                             + std::sqrt((points[i + 1] - points[i]).squared_length()));
    if(is_closed)
      find_periodic_slopes();
    else if(points.size() <= 3)
      find_parabola_slopes();
    else
      find_not_a_knot_slopes();
  }

  // returns the parameters of the points.
  const std::vector<FT>& parameters() const { return m_parameters; }

  // returns the spline.
  NURBS_curve_3<K> curve() const
  {
    const size_type last = m_points.size() - 1;
    std::vector<FT> knots(4, m_parameters.front());
    knots.insert(knots.end(), m_parameters.begin() + 1, m_parameters.end() - 1);
    knots.insert(knots.end(), 4, m_parameters.back());

    // A control point is the blossom of the cubic of a span at three consecutive knots.
    std::vector<Point_3> control_points = {m_points.front(), right_point(0)};
    for(size_type i = 0; i + 1 < last; ++i)
    {
      const Point_3 p = right_point(i), q = left_point(i + 1);
      control_points.push_back(
        p + ((m_parameters[i + 2] - m_parameters[i]) / width(i)) * (q - p));
    }
    control_points.push_back(left_point(last));
    control_points.push_back(m_points.back());
    return NURBS_curve_3<K>(3, std::move(knots), control_points);
  }

private:
  // The rows  a[i] m[i-1] + b[i] m[i] + c[i] m[i+1] = d[i]  of the system for the slopes m.
  struct Tridiagonal_system
  {
    std::vector<FT> a, b, c;
    std::vector<Vector_3> d;

    explicit Tridiagonal_system(size_type n)
      : a(n, FT(0)), b(n, FT(0)), c(n, FT(0)), d(n, Vector_3(FT(0), FT(0), FT(0)))
    {}

    // solves by elimination without pivoting; all systems below are diagonally dominant or nearly
    // so.
    std::vector<Vector_3> solve() const
    {
      const size_type n = b.size();
      std::vector<FT> factor(n);
      std::vector<Vector_3> m(n);
      for(size_type i = 0; i < n; ++i)
      {
        const FT pivot = b[i] - (i > 0 ? a[i] * factor[i - 1] : FT(0));
        factor[i] = c[i] / pivot;
        m[i] = (i > 0 ? d[i] - a[i] * m[i - 1] : d[i]) / pivot;
      }
      for(size_type i = n - 1; i-- > 0; )
        m[i] = m[i] - factor[i] * m[i + 1];
      return m;
    }
  };

  FT width(size_type i) const { return m_parameters[i + 1] - m_parameters[i]; }

  Vector_3 secant(size_type i) const { return (m_points[i + 1] - m_points[i]) / width(i); }

  // the inner Bezier points of the spans next to a point
  Point_3 right_point(size_type i) const
  {
    return m_points[i] + (width(i) / FT(3)) * m_slopes[i];
  }

  Point_3 left_point(size_type i) const
  {
    return m_points[i] - (width(i - 1) / FT(3)) * m_slopes[i];
  }

  // sets the row of equal second derivatives at a point between spans `before` and `after`.
  void set_smooth_row(Tridiagonal_system& system, size_type row, size_type before,
                      size_type after) const
  {
    const FT h = width(before), k = width(after);
    system.a[row] = k;
    system.b[row] = FT(2) * (h + k);
    system.c[row] = h;
    system.d[row] = FT(3) * (k * secant(before) + h * secant(after));
  }

  void find_parabola_slopes()
  {
    if(m_points.size() == 2)
    {
      m_slopes.assign(2, secant(0));
      return;
    }
    const FT h = width(0), k = width(1);
    const Vector_3 middle = (k * secant(0) + h * secant(1)) / (h + k);
    m_slopes = {FT(2) * secant(0) - middle, middle, FT(2) * secant(1) - middle};
  }

  // The third derivatives agree at the second point and at the last but one. The rows are those of
  // de Boor, A Practical Guide to Splines, chapter IV.
  void find_not_a_knot_slopes()
  {
    const size_type n = m_points.size();
    Tridiagonal_system system(n);
    for(size_type i = 1; i + 1 < n; ++i)
      set_smooth_row(system, i, i - 1, i);
    set_not_a_knot_row(system.b[0], system.c[0], system.d[0], 0, 1);
    set_not_a_knot_row(system.b[n - 1], system.a[n - 1], system.d[n - 1], n - 2, n - 3);
    m_slopes = system.solve();
  }

  void set_not_a_knot_row(FT& diagonal, FT& neighbor, Vector_3& right_hand_side, size_type outer,
                          size_type inner) const
  {
    const FT h = width(outer), k = width(inner);
    diagonal = k;
    neighbor = h + k;
    right_hand_side = ((h + FT(2) * (h + k)) * k * secant(outer) + h * h * secant(inner)) / (h + k);
  }

  // The cyclic system is the tridiagonal one plus a matrix of rank one (Sherman-Morrison).
  void find_periodic_slopes()
  {
    const size_type n = m_points.size() - 1;
    Tridiagonal_system system(n);
    for(size_type i = 0; i < n; ++i)
      set_smooth_row(system, i, (i + n - 1) % n, i);
    const FT top_right = system.a[0], bottom_left = system.c[n - 1];
    const FT gamma = -system.b[0];
    system.b[0] -= gamma;
    system.b[n - 1] -= top_right * bottom_left / gamma;
    m_slopes = system.solve();

    Tridiagonal_system correction = system;
    correction.d.assign(n, Vector_3(FT(0), FT(0), FT(0)));
    correction.d[0] = Vector_3(gamma, FT(0), FT(0));
    correction.d[n - 1] = Vector_3(bottom_left, FT(0), FT(0));
    const std::vector<Vector_3> z = correction.solve();
    const FT ratio = top_right / gamma;
    const Vector_3 numerator = m_slopes[0] + ratio * m_slopes[n - 1];
    const FT denominator = FT(1) + z[0].x() + ratio * z[n - 1].x();
    for(size_type i = 0; i < n; ++i)
      m_slopes[i] = m_slopes[i] - (z[i].x() / denominator) * numerator;
    m_slopes.push_back(m_slopes[0]);
  }

  const std::vector<Point_3>& m_points;
  std::vector<FT> m_parameters;
  std::vector<Vector_3> m_slopes;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_CUBIC_SPLINE_INTERPOLATION_H
