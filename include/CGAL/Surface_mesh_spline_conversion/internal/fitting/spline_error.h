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

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Span_samples.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_cubic_spline.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
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

// Bounds the distance between a spline and a curve over one span, along the correspondence of the
// samples.
//
// On each piece, of length eta, the error E is split in its cubic Hermite interpolant, bounded by
// its four Bernstein coefficients, and the remainder, which is at most eta^4 / 384 max |E''''| and
// attains eta^4 / 384 E'''' at the middle up to higher order. As the fourth derivative of a spline
// vanishes, E'''' is that of the curve, and is small at this scale. The remainder is measured at
// the middle of each piece; twice the largest of them stands for its bound.
inline Span_error spline_error(const Cubic_spline_basis& basis, const Control_polygon& polygon,
                               const Span_samples& samples, std::size_t span)
{
  constexpr std::size_t n = Span_samples::number_of_pieces;
  constexpr double safety_factor = 2;
  const double begin = basis.span_begin(span), length = basis.span_end(span) - begin;
  const double eta = length / double(n);

  Span_error result;
  double remainder = 0;
  std::array<Eigen::Vector3d, n + 1> error, slope;
  auto measure = [&](const Eigen::Vector3d& e, double x)
  {
    if(e.norm() > result.sampled)
    {
      result.sampled = e.norm();
      result.worst = x;
    }
  };

  for(std::size_t i = 0; i <= n; ++i)
  {
    const double x = begin + length * (double(i) / double(n));
    const Cubic_spline_basis::Values values = basis.values(span, x);
    error[i] = evaluate(values, polygon, 0) - samples.point[i];
    slope[i] = (evaluate(values, polygon, 1) - samples.derivative[i]) * eta;
    measure(error[i], x);
  }
  for(std::size_t i = 0; i < n; ++i)
  {
    const double x = begin + length * ((double(i) + 0.5) / double(n));
    const Eigen::Vector3d middle = evaluate(basis.values(span, x), polygon, 0) - samples.middle[i];
    const Eigen::Vector3d hermite
      = (error[i] + error[i + 1]) / 2 + (slope[i] - slope[i + 1]) / 8;
    measure(middle, x);
    remainder = (std::max)(remainder, (middle - hermite).norm());
    result.bound = (std::max)({result.bound, error[i].norm(), error[i + 1].norm(),
                               (error[i] + slope[i] / 3).norm(),
                               (error[i + 1] - slope[i + 1] / 3).norm()});
  }
  result.bound += safety_factor * remainder;
  return result;
}

// the largest parts of the error of a spline at the samples
struct Error_parts
{
  double normal = 0;     // at right angles to the curve
  double tangential = 0; // along the curve

  void add(const Error_parts& other)
  {
    normal = (std::max)(normal, other.normal);
    tangential = (std::max)(tangential, other.tangential);
  }
};

// splits the error at the ends of the pieces of a span
inline Error_parts error_parts(const Cubic_spline_basis& basis, const Control_polygon& polygon,
                               const Span_samples& samples, std::size_t span)
{
  constexpr std::size_t n = Span_samples::number_of_pieces;
  const double begin = basis.span_begin(span), length = basis.span_end(span) - begin;
  Error_parts result;
  for(std::size_t i = 0; i <= n; ++i)
  {
    const double x = begin + length * (double(i) / double(n));
    const Eigen::Vector3d error = evaluate(basis.values(span, x), polygon, 0) - samples.point[i];
    const Eigen::Vector3d tangent = samples.derivative[i].normalized();
    const double along = error.dot(tangent);
    result.add(Error_parts{(error - along * tangent).norm(), std::abs(along)});
  }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SPLINE_ERROR_H
