// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_VARIANT_CURVE_TRAITS_3_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_VARIANT_CURVE_TRAITS_3_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/curves/seam_parameters.h>

#include <cstddef>
#include <tuple>
#include <variant>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionCurveTraits

The class `Variant_curve_traits_3` lets one mesh be bounded by curves of several kinds: its curves
are `std::variant`s of the curves of other traits classes.

\tparam FirstTraits a model of `BoundaryCurveTraits_3`
\tparam OtherTraits models of `BoundaryCurveTraits_3` with the same number, point and vector types,
        and pairwise different curve types

\cgalModels{BoundaryCurveTraits_3}
*/
template <typename FirstTraits, typename... OtherTraits>
class Variant_curve_traits_3
{
  typedef std::tuple<FirstTraits, OtherTraits...> Traits_tuple;

public:
  typedef typename FirstTraits::FT FT;
  typedef typename FirstTraits::Point_3 Point_3;
  typedef typename FirstTraits::Vector_3 Vector_3;
  typedef std::variant<typename FirstTraits::Curve_3, typename OtherTraits::Curve_3...> Curve_3;

  /// creates traits from default traits of each kind.
  Variant_curve_traits_3() {}

  /// creates traits from those of each kind.
  explicit Variant_curve_traits_3(const FirstTraits& first, const OtherTraits&... others)
    : m_traits(first, others...)
  {}

#ifndef DOXYGEN_RUNNING
  class Construct_point_on_curve_3
  {
  public:
    explicit Construct_point_on_curve_3(const Traits_tuple& traits)
      : m_functors(traits_functors(traits))
    {}

    Point_3 operator()(const Curve_3& curve, const FT& t) const { return dispatch<0>(curve, t); }

  private:
    static auto traits_functors(const Traits_tuple& traits)
    {
      return std::apply([](const auto&... t)
        { return std::make_tuple(t.construct_point_on_curve_3_object()...); }, traits);
    }

    template <std::size_t i>
    Point_3 dispatch(const Curve_3& curve, const FT& t) const
    {
      if constexpr(i < sizeof...(OtherTraits))
        if(curve.index() != i)
          return dispatch<i + 1>(curve, t);
      return std::get<i>(m_functors)(std::get<i>(curve), t);
    }

    std::tuple<typename FirstTraits::Construct_point_on_curve_3,
               typename OtherTraits::Construct_point_on_curve_3...> m_functors;
  };

  class Construct_derivative_on_curve_3
  {
  public:
    explicit Construct_derivative_on_curve_3(const Traits_tuple& traits)
      : m_functors(traits_functors(traits))
    {}

    Vector_3 operator()(const Curve_3& curve, const FT& t, int order) const
    {
      return dispatch<0>(curve, t, order);
    }

  private:
    static auto traits_functors(const Traits_tuple& traits)
    {
      return std::apply([](const auto&... t)
        { return std::make_tuple(t.construct_derivative_on_curve_3_object()...); }, traits);
    }

    template <std::size_t i>
    Vector_3 dispatch(const Curve_3& curve, const FT& t, int order) const
    {
      if constexpr(i < sizeof...(OtherTraits))
        if(curve.index() != i)
          return dispatch<i + 1>(curve, t, order);
      return std::get<i>(m_functors)(std::get<i>(curve), t, order);
    }

    std::tuple<typename FirstTraits::Construct_derivative_on_curve_3,
               typename OtherTraits::Construct_derivative_on_curve_3...> m_functors;
  };

  // A curve of a kind without surface has no seam.
  class Construct_seam_parameters_on_curve_3
  {
  public:
    explicit Construct_seam_parameters_on_curve_3(const Traits_tuple& traits) : m_traits(traits) {}

    std::vector<FT> operator()(const Curve_3& curve) const { return dispatch<0>(curve); }

  private:
    template <std::size_t i>
    std::vector<FT> dispatch(const Curve_3& curve) const
    {
      if constexpr(i < sizeof...(OtherTraits))
        if(curve.index() != i)
          return dispatch<i + 1>(curve);
      return internal::seam_parameters(std::get<i>(m_traits), std::get<i>(curve));
    }

    Traits_tuple m_traits;
  };
#endif

  Construct_point_on_curve_3 construct_point_on_curve_3_object() const
  {
    return Construct_point_on_curve_3(m_traits);
  }

  Construct_derivative_on_curve_3 construct_derivative_on_curve_3_object() const
  {
    return Construct_derivative_on_curve_3(m_traits);
  }

#ifndef DOXYGEN_RUNNING
  Construct_seam_parameters_on_curve_3 construct_seam_parameters_on_curve_3_object() const
  {
    return Construct_seam_parameters_on_curve_3(m_traits);
  }
#endif

private:
  Traits_tuple m_traits;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_VARIANT_CURVE_TRAITS_3_H
