// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_CURVE_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_CURVE_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/curves/B_spline.h>

#include <CGAL/assertions.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionCurveTraits

The class `NURBS_curve_3` is a polynomial or rational B-spline curve of any degree. It is a handle:
copies share their data, and two curves are equal if they share their data.

The knot vector is the full one (number of control points + degree + 1 knots). It need not be
clamped; the curve is defined between knot `degree` and knot `number_of_control_points()`, and
beyond by the polynomials of its end spans.

\tparam K a model of `Kernel` with a floating-point number type
*/
template <typename K>
class NURBS_curve_3
{
public:
  typedef typename K::FT FT;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef std::size_t size_type;

  /// \name Creation
  /// @{

  /// creates a handle that refers to no curve; it can only be compared and assigned.
  NURBS_curve_3() {}

  /// creates a curve; without `weights` it is polynomial.
  /// \pre `defect(degree, knots, control_points, weights).empty()`
  NURBS_curve_3(int degree, std::vector<FT> knots, const std::vector<Point_3>& control_points,
                const std::vector<FT>& weights = std::vector<FT>())
  {
    CGAL_precondition(defect(degree, knots, control_points, weights).empty());
    std::vector<Homogeneous> coefficients(control_points.size());
    for(size_type i = 0; i < control_points.size(); ++i)
    {
      const FT weight = weights.empty() ? FT(1) : weights[i];
      for(int j = 0; j < 3; ++j)
        coefficients[i][j] = weight * control_points[i][j];
      coefficients[i][3] = weight;
    }
    m_data = std::make_shared<const Data>(
      Data{Spline(degree, std::move(knots), std::move(coefficients)), !weights.empty()});
  }

  /// returns the straight line from `p` to `q` with parameters in \f$ [0,1] \f$.
  static NURBS_curve_3 make_line_segment(const Point_3& p, const Point_3& q)
  {
    return NURBS_curve_3(1, {FT(0), FT(0), FT(1), FT(1)}, {p, q});
  }

  /*!
  returns the arc of \f$ \mathit{center} + \cos(a) x + \sin(a) y \f$ between two angles in radians,
  as a rational curve of degree 2. It is circular if `x` and `y` are perpendicular and of the same
  length, otherwise elliptical. The arc consists of equal pieces of at most a quarter turn; where
  these meet, the parameter is the angle, in between only nearly.

  \pre `0 < last - first <= 2 * CGAL_PI` up to rounding
  */
  static NURBS_curve_3 make_circular_arc(const Point_3& center, const Vector_3& x,
                                         const Vector_3& y, const FT& first, const FT& last)
  {
    CGAL_precondition(first < last);
    // at most a quarter turn per piece keeps all weights above 0.7
    const FT quarter_turn(1.57079632679489661923);
    const FT rounding_slack(1e-9);
    const int n = static_cast<int>(std::ceil((last - first) / quarter_turn - rounding_slack));
    const FT half_angle = (last - first) / FT(2 * n);
    const FT weight = std::cos(half_angle);

    std::vector<Point_3> control_points;
    std::vector<FT> weights, knots(1, first);
    for(int i = 0; i <= 2 * n; ++i)
    {
      const FT angle = first + FT(i) * half_angle;
      const FT radius = (i % 2 == 0) ? FT(1) : FT(1) / weight;
      control_points.push_back(
        center + radius * (std::cos(angle) * x + std::sin(angle) * y));
      weights.push_back(i % 2 == 0 ? FT(1) : weight);
      if(i % 2 == 0)
        knots.insert(knots.end(), 2, i == 2 * n ? last : angle);
    }
    knots.push_back(last);
    return NURBS_curve_3(2, std::move(knots), control_points, weights);
  }

  /// returns what is wrong with the data of a curve, or an empty string if they define a curve.
  static std::string defect(int degree, const std::vector<FT>& knots,
                            const std::vector<Point_3>& control_points,
                            const std::vector<FT>& weights = std::vector<FT>())
  {
    for(const Point_3& p : control_points)
      for(int i = 0; i < 3; ++i)
        if(!std::isfinite(p[i]))
          return "a coordinate of a control point is not a finite number";
    return internal::B_spline_defect(degree, knots, control_points.size(), weights);
  }

  /// @}
  /// \name Queries
  /// @{

  /// returns `true` if the handle refers to no curve.
  bool is_empty() const { return !m_data; }

  /// returns the degree.
  int degree() const { return m_data->spline.degree(); }

  /// returns the full knot vector.
  const std::vector<FT>& knots() const { return m_data->spline.knots(); }

  /// returns the number of control points.
  size_type number_of_control_points() const { return m_data->spline.coefficients().size(); }

  /// returns control point `i`.
  Point_3 control_point(size_type i) const
  {
    const Homogeneous& c = m_data->spline.coefficients()[i];
    return Point_3(c[0] / c[3], c[1] / c[3], c[2] / c[3]);
  }

  /// returns the weight of control point `i`.
  FT weight(size_type i) const { return m_data->spline.coefficients()[i][3]; }

  /// returns `true` if the curve was created with weights.
  bool is_rational() const { return m_data->is_rational; }

  /// returns the parameter at which the curve begins.
  FT first_parameter() const { return m_data->spline.first_parameter(); }

  /// returns the parameter at which the curve ends.
  FT last_parameter() const { return m_data->spline.last_parameter(); }

  /// returns the point at `t`.
  Point_3 point(const FT& t) const
  {
    const auto c = evaluate<0>(t);
    return Point_3(c[0].c[0], c[1].c[0], c[2].c[0]);
  }

  /// returns the derivative at `t`; at a knot the one from the right.
  /// \pre `1 <= order && order <= 3`
  Vector_3 derivative(const FT& t, int order) const
  {
    CGAL_precondition(1 <= order && order <= 3);
    switch(order)
    {
      case 1: return vector(evaluate<1>(t), 1);
      case 2: return vector(evaluate<2>(t), 2);
      default: return vector(evaluate<3>(t), 3);
    }
  }

  /// returns `true` if both handles refer to the same data.
  friend bool operator==(const NURBS_curve_3& a, const NURBS_curve_3& b)
  {
    return a.m_data == b.m_data;
  }

  /// returns `true` if the handles refer to different data.
  friend bool operator!=(const NURBS_curve_3& a, const NURBS_curve_3& b) { return !(a == b); }

  /// @}

private:
  typedef internal::B_spline<FT, 4> Spline;
  typedef typename Spline::Coefficients Homogeneous;

  struct Data
  {
    Spline spline;
    bool is_rational;
  };

  template <int order>
  using Coordinates = std::array<internal::Taylor<FT, order>, 4>;

  template <int order>
  Coordinates<order> evaluate(const FT& t) const
  {
    CGAL_precondition(!is_empty());
    Coordinates<order> c = m_data->spline.template evaluate<order>(t);
    if(m_data->is_rational)
      for(int i = 0; i < 3; ++i)
        c[i] = c[i] / c[3];
    return c;
  }

  template <int order>
  static Vector_3 vector(const Coordinates<order>& c, int k)
  {
    return Vector_3(c[0].derivative(k), c[1].derivative(k), c[2].derivative(k));
  }

  std::shared_ptr<const Data> m_data;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_NURBS_CURVE_3_H
