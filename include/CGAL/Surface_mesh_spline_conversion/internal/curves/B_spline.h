// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_B_SPLINE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_B_SPLINE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/curves/Taylor.h>

#include <CGAL/assertions.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// returns what is wrong with the data of a (rational) B-spline, or an empty string.
// `weights` may be empty (polynomial).
template <typename FT>
std::string B_spline_defect(int degree, const std::vector<FT>& knots,
                            std::size_t number_of_control_points, const std::vector<FT>& weights)
{
  if(degree < 1)
    return "the degree is smaller than 1";
  const std::size_t p = static_cast<std::size_t>(degree), n = number_of_control_points;
  if(n < p + 1)
    return "there are fewer than degree + 1 control points";
  if(knots.size() != n + p + 1)
    return "there are " + std::to_string(knots.size()) + " knots instead of "
           + std::to_string(n + p + 1) + " (control points + degree + 1)";
  for(const FT& knot : knots)
    if(!std::isfinite(knot))
      return "a knot is not a finite number";
  if(!std::is_sorted(knots.begin(), knots.end()))
    return "the knots are not in ascending order";
  for(std::size_t i = 1; i < n; ++i)
    if(!(knots[i] < knots[i + p]))
      return "knot " + std::to_string(i) + " is repeated more than degree times";
  if(!(knots[p] < knots[n]))
    return "the knots span no interval";
  if(!weights.empty() && weights.size() != n)
    return "there are " + std::to_string(weights.size()) + " weights for "
           + std::to_string(n) + " control points";
  for(const FT& weight : weights)
    if(!(weight > FT(0)) || !std::isfinite(weight))
      return "a weight is not a positive number";
  return std::string();
}

// A B-spline function with `dimension` components. A rational curve is one in homogeneous
// coordinates. Beyond its knots it is continued by the polynomials of its end spans.
template <typename FT, int dimension>
class B_spline
{
public:
  typedef std::array<FT, dimension> Coefficients;

  B_spline(int degree, std::vector<FT> knots, std::vector<Coefficients> coefficients)
    : m_degree(degree), m_knots(std::move(knots)), m_coefficients(std::move(coefficients))
  {
    CGAL_precondition(
      B_spline_defect(m_degree, m_knots, m_coefficients.size(), std::vector<FT>()).empty());
    const auto first = m_knots.begin() + m_degree;
    const auto last = m_knots.begin() + static_cast<std::ptrdiff_t>(m_coefficients.size());
    m_second_knot = std::upper_bound(first, last, *first) - m_knots.begin();
    m_last_knot = std::lower_bound(first, last, *last) - m_knots.begin();
  }

  int degree() const { return m_degree; }
  const std::vector<FT>& knots() const { return m_knots; }
  const std::vector<Coefficients>& coefficients() const { return m_coefficients; }
  const FT& first_parameter() const { return m_knots[m_degree]; }
  const FT& last_parameter() const { return m_knots[m_coefficients.size()]; }

  // evaluates all components and their derivatives by de Boor's algorithm in truncated polynomials:
  // the blending factor at t + x is alpha + x / width.
  template <int order>
  std::array<Taylor<FT, order>, dimension> evaluate(const FT& t) const
  {
    typedef std::array<Taylor<FT, order>, dimension> Value;

    const std::size_t p = static_cast<std::size_t>(m_degree);
    const std::size_t first = span(t) - p;
    boost::container::small_vector<Value, inline_points> d(p + 1);
    for(std::size_t j = 0; j <= p; ++j)
      for(int i = 0; i < dimension; ++i)
        d[j][i] = Taylor<FT, order>::constant(m_coefficients[first + j][i]);

    for(std::size_t r = 1; r <= p; ++r)
      for(std::size_t j = p; j >= r; --j)
      {
        const FT& left = m_knots[first + j];
        const FT scale = FT(1) / (m_knots[first + p + 1 + j - r] - left);
        const FT alpha = (t - left) * scale;
        for(int i = 0; i < dimension; ++i)
          blend(d[j - 1][i], alpha, scale, d[j][i]);
      }
    return d[p];
  }

private:
  // curves of higher degree than this minus one pay one allocation per evaluation
  static constexpr std::size_t inline_points = 10;

  // b becomes (1 - a) b_previous + a b with a = alpha + scale x
  template <int order>
  static void blend(const Taylor<FT, order>& previous, const FT& alpha, const FT& scale,
                    Taylor<FT, order>& b)
  {
    for(int k = order; k >= 0; --k)
    {
      const FT slope = (k > 0) ? scale * (b.c[k - 1] - previous.c[k - 1]) : FT(0);
      b.c[k] = previous.c[k] + alpha * (b.c[k] - previous.c[k]) + slope;
    }
  }

  // returns the index i of the non-empty span with knots[i] <= t < knots[i+1], clamped to the
  // domain.
  std::size_t span(const FT& t) const
  {
    const auto first = m_knots.begin() + m_second_knot;
    const auto last = m_knots.begin() + m_last_knot;
    return static_cast<std::size_t>(std::upper_bound(first, last, t) - m_knots.begin()) - 1;
  }

  int m_degree;
  std::vector<FT> m_knots;
  std::vector<Coefficients> m_coefficients;
  std::ptrdiff_t m_second_knot; // index of the first knot after the begin of the domain
  std::ptrdiff_t m_last_knot;   // index of the first knot at the end of the domain
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_B_SPLINE_H
