// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_BOUNDARY_CORRESPONDENCE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_BOUNDARY_CORRESPONDENCE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The arc length s(x) of a boundary chain as a function of its parameter x, which runs by one
// along each quad side: a monotone piecewise cubic polynomial given by values and slopes at the
// integers, or a piecewise linear one. On a closed chain s(x + number of sides) = s(x) + length.
class Boundary_correspondence
{
public:
  typedef std::size_t size_type;

  Boundary_correspondence() {}

  // \pre as many slopes as values, at least two
  Boundary_correspondence(std::vector<double> values, std::vector<double> slopes, bool is_closed)
    : m_values(std::move(values)), m_slopes(std::move(slopes)), m_is_closed(is_closed)
  {
    CGAL_precondition(m_values.size() >= 2 && m_values.size() == m_slopes.size());
  }

  // the correspondence that is linear between the values, as in section 2.2 of the paper; at the
  // integers, its derivative is that from the right
  Boundary_correspondence(std::vector<double> values, bool is_closed)
    : m_values(std::move(values)), m_is_closed(is_closed)
  {
    CGAL_precondition(m_values.size() >= 2);
  }

  size_type number_of_sides() const { return m_values.size() - 1; }

  bool is_closed() const { return m_is_closed; }

  // returns the arc length at `x`, or a derivative of order 1 or 2; `x` is clamped to the range of
  // an open chain
  double operator()(double x, int order = 0) const
  {
    const double n = static_cast<double>(number_of_sides());
    const double turn = m_is_closed ? std::floor(x / n) : 0;
    x = (std::min)((std::max)(x - turn * n, 0.), n);
    const size_type k = (std::min)(static_cast<size_type>(x), number_of_sides() - 1);
    const double t = x - static_cast<double>(k);
    const double d = m_values[k + 1] - m_values[k];
    const double a = begin_slope(k), b = end_slope(k);
    // the interpolant is value + t (a + t (c2 + t c3))
    const double c2 = 3 * d - 2 * a - b, c3 = a + b - 2 * d;
    if(order == 1)
      return a + t * (2 * c2 + 3 * t * c3);
    if(order == 2)
      return 2 * c2 + 6 * t * c3;
    // from the nearer end, so that both ends are exact
    const double period = m_values.back() - m_values.front();
    const double value = t < 0.5
      ? m_values[k] + t * (a + t * (c2 + t * c3))
      : m_values[k + 1] - (1 - t) * (b - (1 - t) * ((a + 2 * b - 3 * d) - (1 - t) * c3));
    return value + turn * period;
  }

  // returns the smallest slope on side `k`
  double smallest_slope(size_type k) const
  {
    // Bernstein coefficients of the derivative, a quadratic polynomial
    const double b0 = begin_slope(k), b2 = end_slope(k);
    const double b1 = 3 * (m_values[k + 1] - m_values[k]) - b0 - b2;
    if(b1 >= b0 || b1 >= b2)
      return (std::min)(b0, b2);
    return (b0 * b2 - b1 * b1) / (b0 - 2 * b1 + b2);
  }

private:
  double begin_slope(size_type k) const
  {
    return m_slopes.empty() ? m_values[k + 1] - m_values[k] : m_slopes[k];
  }

  double end_slope(size_type k) const
  {
    return m_slopes.empty() ? m_values[k + 1] - m_values[k] : m_slopes[k + 1];
  }

  std::vector<double> m_values;
  std::vector<double> m_slopes; // empty: linear
  bool m_is_closed = false;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_BOUNDARY_CORRESPONDENCE_H
