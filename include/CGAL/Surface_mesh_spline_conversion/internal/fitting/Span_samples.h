// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SPAN_SAMPLES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SPAN_SAMPLES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_cubic_spline.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A `CurveTarget` whose shape is fitted also has the functions `Curve_foot foot(double x)`, the place
// at a parameter of the spline, and by arc length `Curve_foot curve_foot(double s)` and
// `Eigen::Vector3d curve_point(double s)`.

// a place on a curve, with the unit tangent there
struct Curve_foot
{
  double arc_length;
  Eigen::Vector3d point, tangent;
};

// The points of a curve that are compared with those of a spline over one span, cut in equal
// pieces: at the ends of the pieces with the derivative with respect to the parameter of the
// spline, and in their middle.
struct Span_samples
{
  static constexpr std::size_t number_of_pieces = 8;

  std::array<Eigen::Vector3d, number_of_pieces + 1> point, derivative;
  std::array<Eigen::Vector3d, number_of_pieces> middle;
};

// samples the curve at the parameters of the spline
template <typename CurveTarget>
Span_samples sample_at_equal_parameters(double begin, double length, CurveTarget& target)
{
  constexpr std::size_t n = Span_samples::number_of_pieces;
  Span_samples result;
  for(std::size_t i = 0; i <= n; ++i)
  {
    const double x = begin + length * (double(i) / double(n));
    result.point[i] = target.point(x);
    result.derivative[i] = target.derivative(x);
  }
  for(std::size_t i = 0; i < n; ++i)
    result.middle[i] = target.point(begin + length * ((double(i) + 0.5) / double(n)));
  return result;
}

// Moves a foot along the curve to the point closest to `p`, but for a share of the way that is the
// curvature of the curve times the distance of `p`, and is small.
template <typename CurveTarget>
Curve_foot closer_foot(const Eigen::Vector3d& p, const Curve_foot& foot, CurveTarget& target)
{
  return target.curve_foot(foot.arc_length + (p - foot.point).dot(foot.tangent));
}

// Samples a curve next to the points of a spline.
//
// At the ends of the pieces, one step leads from the places at equal parameters next to the points
// that are closest to those of the spline; in between, the arc length is the cubic polynomial with
// the values and slopes there. Where it increases, the spline and the curve are compared along a
// continuous one-to-one correspondence, so that a bound of their distances is a bound of the
// Hausdorff distance, whatever points are chosen.
template <typename CurveTarget>
class Foot_sampler
{
public:
  Foot_sampler(const Cubic_spline_basis& basis, const Control_polygon& polygon, CurveTarget& target)
    : m_basis(basis), m_polygon(polygon), m_target(target)
  {}

  // Samples the curve along a span. Returns `false` if the correspondence is not increasing, or
  // further from that of equal parameters than the speed times `largest_shift`, or much slower or
  // faster.
  bool operator()(std::size_t span, double largest_shift, Span_samples& samples) const
  {
    constexpr std::size_t n = Span_samples::number_of_pieces;
    const double begin = m_basis.span_begin(span), length = m_basis.span_end(span) - begin;
    const double eta = length / double(n);
    std::array<double, n + 1> arc_length, slope;
    for(std::size_t i = 0; i <= n; ++i)
    {
      const double x = begin + length * (double(i) / double(n));
      const Cubic_spline_basis::Values values = m_basis.values(span, x);
      const Curve_foot start = m_target.foot(x);
      const Curve_foot foot = closer_foot(evaluate(values, m_polygon, 0), start, m_target);
      arc_length[i] = foot.arc_length;
      slope[i] = evaluate(values, m_polygon, 1).dot(foot.tangent);
      const double speed = m_target.derivative(x).norm();
      if(!(std::abs(foot.arc_length - start.arc_length) <= largest_shift * speed)
         || !(slope[i] >= slowest * speed && slowest * slope[i] <= speed))
        return false;
      samples.point[i] = foot.point;
      samples.derivative[i] = slope[i] * foot.tangent;
    }
    for(std::size_t i = 0; i < n; ++i)
    {
      // slopes up to three times the mean one make an increasing cubic polynomial
      const double rise = arc_length[i + 1] - arc_length[i];
      if(!((std::max)(slope[i], slope[i + 1]) * eta <= 3 * rise))
        return false;
      samples.middle[i] = m_target.curve_point(
        (arc_length[i] + arc_length[i + 1]) / 2 + (slope[i] - slope[i + 1]) * eta / 8);
    }
    return true;
  }

private:
  static constexpr double slowest = 0.5;

  const Cubic_spline_basis& m_basis;
  const Control_polygon& m_polygon;
  CurveTarget& m_target;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SPAN_SAMPLES_H
