// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_CUBIC_SPLINE_BASIS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_CUBIC_SPLINE_BASIS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The cubic B-spline functions on a knot vector, open or periodic.
//
// Open: function `i` has the knots `i, ..., i+4` of the knot vector, whose ends are 4-fold.
// Periodic: there is one function per knot of a period, centred at its knot: function `i` has the
// knots `i-2, ..., i+2` of the periodic sequence.
//
// A span is an interval of positive length between consecutive knots. Spans are numbered along
// the parameter; on each of them exactly four functions are not zero.
class Cubic_spline_basis
{
public:
  typedef std::size_t size_type;

  // the values or derivatives of the four functions that live on a span
  typedef std::array<double, 4> Row;

  struct Values
  {
    std::array<size_type, 4> functions;
    std::array<Row, 3> derivatives; // orders 0, 1, 2
  };

  // the open basis on a knot vector with 4-fold ends
  explicit Cubic_spline_basis(std::vector<double> knots)
    : m_knots(std::move(knots)), m_size(m_knots.size() - 4), m_is_periodic(false)
  {
    CGAL_precondition(m_knots.size() >= 8);
    find_spans();
  }

  // the periodic basis on the increasing knots of one period
  Cubic_spline_basis(const std::vector<double>& knots, double period)
    : m_size(knots.size()), m_is_periodic(true)
  {
    CGAL_precondition(!knots.empty() && period > 0);
    // positions -3 ... n+3 of the periodic sequence
    const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(m_size);
    for(std::ptrdiff_t i = -3; i <= n + 3; ++i)
    {
      std::ptrdiff_t turn = i / n - (i % n < 0 ? 1 : 0);
      m_knots.push_back(knots[static_cast<size_type>(i - turn * n)] + period * double(turn));
    }
    find_spans();
  }

  size_type size() const { return m_size; }

  bool is_periodic() const { return m_is_periodic; }

  size_type number_of_spans() const { return m_spans.size(); }

  double span_begin(size_type span) const { return m_knots[m_spans[span]]; }

  double span_end(size_type span) const { return m_knots[m_spans[span] + 1]; }

  // returns the span that contains `x`, where `x` is in the parameter range
  size_type span_of(double x) const
  {
    auto is_before = [this](double y, size_type knot) { return y < m_knots[knot]; };
    auto it = std::upper_bound(m_spans.begin(), m_spans.end(), x, is_before);
    return it == m_spans.begin() ? 0 : static_cast<size_type>(it - m_spans.begin()) - 1;
  }

  // returns the functions on `span` and their derivatives at `x`
  Values values(size_type span, double x) const
  {
    const size_type last = m_spans[span]; // m_knots[last] <= x <= m_knots[last + 1]
    // divided for the next degree; of degree 0 there is the function `last` only
    const Row linear = divide(raise(divide({{0, 0, 0, 1}}, 1, last), 1, last, x), 2, last);
    const Row quadratic = divide(raise(linear, 2, last, x), 3, last);

    Values result;
    for(size_type i = 0; i < 4; ++i)
      result.functions[i] = control_index(last - 3 + i);
    result.derivatives[0] = raise(quadratic, 3, last, x);
    result.derivatives[1] = differentiate(quadratic, 3);
    result.derivatives[2] = differentiate(divide(differentiate(linear, 2), 3, last), 3);
    return result;
  }

private:
  void find_spans()
  {
    for(size_type i = 3; i + 4 < m_knots.size(); ++i)
      if(m_knots[i] < m_knots[i + 1])
        m_spans.push_back(i);
  }

  size_type control_index(size_type function) const
  {
    // position 0 of the periodic knots is knot -3, so that function 0 is centred at knot -1
    return m_is_periodic ? (function + m_size - 1) % m_size : function;
  }

  // Functions of one degree less than `degree`, over the lengths of their supports: both formulas
  // below are made of these. Entry i of a row belongs to the function `last - 3 + i`.
  Row divide(const Row& lower, size_type degree, size_type last) const
  {
    Row result = {{0, 0, 0, 0}};
    for(size_type i = 4 - degree; i < 4; ++i)
    {
      const size_type f = last - 3 + i;
      if(lower[i] != 0) // else the support may be empty
        result[i] = lower[i] / (m_knots[f + degree] - m_knots[f]);
    }
    return result;
  }

  // returns the functions of `degree` (Cox, de Boor)
  Row raise(const Row& divided, size_type degree, size_type last, double x) const
  {
    Row result = {{0, 0, 0, 0}};
    for(size_type i = 3 - degree; i < 4; ++i)
    {
      const size_type f = last - 3 + i;
      result[i] = divided[i] * (x - m_knots[f]);
      if(i < 3)
        result[i] += divided[i + 1] * (m_knots[f + degree + 1] - x);
    }
    return result;
  }

  // returns the derivatives of the functions of `degree`, or one more derivative of them
  static Row differentiate(const Row& divided, size_type degree)
  {
    Row result = {{0, 0, 0, 0}};
    for(size_type i = 3 - degree; i < 4; ++i)
      result[i] = double(degree) * (divided[i] - (i < 3 ? divided[i + 1] : 0));
    return result;
  }

  std::vector<double> m_knots;
  std::vector<size_type> m_spans;
  size_type m_size;
  bool m_is_periodic;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_CUBIC_SPLINE_BASIS_H
