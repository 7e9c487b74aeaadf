// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SPLINE_ERROR_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SPLINE_ERROR_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_cubic_spline.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// the error of a spline on a span
struct Span_error
{
  double bound = 0;   // upper bound over the span
  double sampled = 0; // largest error at a sample
  double worst = 0;   // parameter of this sample
};

// Bounds the distance between a spline and its target at equal parameters, over one span.
//
// On each of eight sub-intervals of length eta the error E is split in its cubic Hermite
// interpolant, bounded by its four Bernstein coefficients, and the remainder, which is at most
// eta^4 / 384 max |E''''| and attains eta^4 / 384 E'''' at the middle up to higher order. As the
// fourth derivative of a spline vanishes, E'''' is that of the target, and is small at this
// scale. The remainder is measured at the middle of each sub-interval; twice the largest of them
// stands for its bound.
template <typename CurveTarget>
Span_error spline_error(const Cubic_spline_basis& basis, const Control_polygon& polygon,
                        CurveTarget& target, std::size_t span)
{
  constexpr std::size_t number_of_pieces = 8;
  constexpr double safety_factor = 2;
  const double begin = basis.span_begin(span), length = basis.span_end(span) - begin;
  const double eta = length / number_of_pieces;

  Span_error result;
  double remainder = 0;
  std::array<Eigen::Vector3d, number_of_pieces + 1> error, slope;
  auto error_at = [&](const Cubic_spline_basis::Values& values, double x)
  {
    const Eigen::Vector3d e = evaluate(values, polygon, 0) - target.point(x);
    if(e.norm() > result.sampled)
    {
      result.sampled = e.norm();
      result.worst = x;
    }
    return e;
  };

  for(std::size_t i = 0; i <= number_of_pieces; ++i)
  {
    const double x = begin + length * (double(i) / number_of_pieces);
    const Cubic_spline_basis::Values values = basis.values(span, x);
    error[i] = error_at(values, x);
    slope[i] = (evaluate(values, polygon, 1) - target.derivative(x)) * eta;
  }
  for(std::size_t i = 0; i < number_of_pieces; ++i)
  {
    const double x = begin + length * ((double(i) + 0.5) / number_of_pieces);
    const Eigen::Vector3d hermite
      = (error[i] + error[i + 1]) / 2 + (slope[i] - slope[i + 1]) / 8;
    remainder = (std::max)(remainder, (error_at(basis.values(span, x), x) - hermite).norm());
    result.bound = (std::max)({result.bound, error[i].norm(), error[i + 1].norm(),
                               (error[i] + slope[i] / 3).norm(),
                               (error[i + 1] - slope[i + 1] / 3).norm()});
  }
  result.bound += safety_factor * remainder;
  return result;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SPLINE_ERROR_H
