// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_CURVE_ON_SURFACE_TRAITS_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_CURVE_ON_SURFACE_TRAITS_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Elementary_surface_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/B_spline.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Curve_member_traits.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/curves/period_crossings.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/assertions.h>

#include <algorithm>
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

The class `Curve_on_surface_3` is the curve \f$ C(t) = S(p(t)) \f$ on a plane, cylinder, cone,
sphere or torus, where \f$ p \f$ is a planar (rational) B-spline curve in the parameters of the
surface. It is a handle: copies share their data, and two curves are equal if they share it.

\tparam K a model of `Kernel` with a floating-point number type
*/
template <typename K>
class Curve_on_surface_3
{
public:
  typedef typename K::FT FT;
  typedef typename K::Point_2 Point_2;
  typedef typename K::Point_3 Point_3;
  typedef typename K::Vector_3 Vector_3;
  typedef Elementary_surface_3<K> Surface;

  /// creates a handle that refers to no curve; it can only be compared and assigned.
  Curve_on_surface_3() {}

  /// creates a curve from a surface and the degree, full knot vector, control points and weights
  /// (none if it is polynomial) of the curve in its parameters.
  /// \pre `defect(surface, degree, knots, control_points, weights).empty()`
  Curve_on_surface_3(const Surface& surface, int degree, std::vector<FT> knots,
                     const std::vector<Point_2>& control_points,
                     const std::vector<FT>& weights = std::vector<FT>())
  {
    CGAL_precondition(defect(surface, degree, knots, control_points, weights).empty());
    std::vector<Homogeneous> coefficients(control_points.size());
    for(std::size_t i = 0; i < control_points.size(); ++i)
    {
      const FT weight = weights.empty() ? FT(1) : weights[i];
      coefficients[i]
        = Homogeneous{{weight * control_points[i].x(), weight * control_points[i].y(), weight}};
    }
    m_data = std::make_shared<const Data>(
      Data{surface, Spline(degree, std::move(knots), std::move(coefficients)), !weights.empty()});
  }

  /// returns what is wrong with the data of a curve, or an empty string if they define a curve.
  static std::string defect(const Surface& surface, int degree, const std::vector<FT>& knots,
                            const std::vector<Point_2>& control_points,
                            const std::vector<FT>& weights = std::vector<FT>())
  {
    for(const Point_2& p : control_points)
      if(!std::isfinite(p.x()) || !std::isfinite(p.y()))
        return "a coordinate of a control point is not a finite number";
    const std::string surface_defect = surface.defect();
    return surface_defect.empty()
             ? internal::B_spline_defect(degree, knots, control_points.size(), weights)
             : surface_defect;
  }

  /// returns `true` if the handle refers to no curve.
  bool is_empty() const { return !m_data; }

  /// returns the surface.
  const Surface& surface() const { return m_data->surface; }

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

  /// returns a unit normal of the surface at the point at `t`; the null vector where the surface is
  /// singular.
  Vector_3 normal(const FT& t) const
  {
    CGAL_precondition(!is_empty());
    Coordinates<1> p = m_data->spline.template evaluate<1>(t);
    if(m_data->is_rational)
      for(int i = 0; i < 2; ++i)
        p[i] = p[i] / p[2];
    std::array<Vector_3, 2> derivatives; // by the parameters of the surface
    for(int i = 0; i < 2; ++i)
    {
      p[i].c[1] = FT(1);
      p[1 - i].c[1] = FT(0);
      derivatives[i] = vector(m_data->surface.evaluate(p[0], p[1]), 1);
    }
    const Vector_3 normal = CGAL::cross_product(derivatives[0], derivatives[1]);
    const FT length = std::sqrt(normal.squared_length());
    return length > FT(0) ? normal / length : Vector_3(FT(0), FT(0), FT(0));
  }

  /// returns the parameters, ascending, at which the curve passes through a seam of its surface:
  /// where a parameter of the surface that is the angle of a full circle is a multiple of
  /// \f$ 2 \pi \f$. The faces of a CAD model may end there. Passages that turn back within a
  /// small part of a span are left out.
  std::vector<FT> seam_parameters() const
  {
    CGAL_precondition(!is_empty());
    std::vector<FT> result;
    for(int i = 0; i < surface().number_of_periods(); ++i)
      internal::append_period_crossings([&](const FT& t) { return surface_parameter(t, i); },
                                        samples(), result);
    std::sort(result.begin(), result.end());
    return result;
  }

  /// returns `true` if both handles refer to the same data.
  friend bool operator==(const Curve_on_surface_3& a, const Curve_on_surface_3& b)
  {
    return a.m_data == b.m_data;
  }

  /// returns `true` if the handles refer to different data.
  friend bool operator!=(const Curve_on_surface_3& a, const Curve_on_surface_3& b)
  {
    return !(a == b);
  }

private:
  typedef internal::B_spline<FT, 3> Spline;
  typedef typename Spline::Coefficients Homogeneous;

  struct Data
  {
    Surface surface;
    Spline spline;
    bool is_rational;
  };

  template <int order>
  using Coordinates = std::array<internal::Taylor<FT, order>, 3>;

  // coordinate `i` of the curve in the parameters of the surface
  FT surface_parameter(const FT& t, int i) const
  {
    const auto p = m_data->spline.template evaluate<0>(t);
    return m_data->is_rational ? p[i].c[0] / p[2].c[0] : p[i].c[0];
  }

  // the ends of the spans of the curve and some parameters between them
  std::vector<FT> samples() const
  {
    constexpr int intervals_per_span = 16;
    const std::vector<FT>& knots = m_data->spline.knots();
    std::vector<FT> result(1, first_parameter());
    for(std::size_t i = 1; i < knots.size(); ++i)
      if(knots[i - 1] < knots[i] && first_parameter() <= knots[i - 1]
         && knots[i] <= last_parameter())
        for(int k = 1; k <= intervals_per_span; ++k)
          result.push_back(knots[i - 1] + (knots[i] - knots[i - 1])
                                            * (FT(k) / FT(intervals_per_span)));
    return result;
  }

  template <int order>
  Coordinates<order> evaluate(const FT& t) const
  {
    CGAL_precondition(!is_empty());
    Coordinates<order> p = m_data->spline.template evaluate<order>(t);
    if(m_data->is_rational)
      for(int i = 0; i < 2; ++i)
        p[i] = p[i] / p[2];
    return m_data->surface.evaluate(p[0], p[1]);
  }

  template <int order>
  static Vector_3 vector(const Coordinates<order>& c, int k)
  {
    return Vector_3(c[0].derivative(k), c[1].derivative(k), c[2].derivative(k));
  }

  std::shared_ptr<const Data> m_data;
};

/*!
\ingroup PkgSurfaceMeshSplineConversionCurveTraits

The class `Curve_on_surface_traits_3` makes boundary curves of curves on planes, cylinders, cones,
spheres and tori. Such a curve lies on its surface exactly, whereas a B-spline curve in space only
approximates one. `Construct_normal_on_curve_3` returns the unit normal of the surface at a
parameter of a curve, `Construct_seam_parameters_on_curve_3` the parameters at which a curve passes
through a seam of its surface. Evaluation does not allocate memory for degrees below 10.

\tparam K a model of `Kernel` with a floating-point number type

\cgalModels{BoundaryCurveTraits_3}
*/
template <typename K>
class Curve_on_surface_traits_3
#ifndef DOXYGEN_RUNNING
  : public internal::Curve_member_traits_with_normals<K, Curve_on_surface_3<K> >
#endif
{
public:
  /// The type of the curves.
  typedef Curve_on_surface_3<K> Curve_3;

#ifndef DOXYGEN_RUNNING
  struct Construct_seam_parameters_on_curve_3
  {
    std::vector<typename K::FT> operator()(const Curve_3& curve) const
    {
      return curve.seam_parameters();
    }
  };

  Construct_seam_parameters_on_curve_3 construct_seam_parameters_on_curve_3_object() const
  {
    return Construct_seam_parameters_on_curve_3();
  }
#endif
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_CURVE_ON_SURFACE_TRAITS_3_H
