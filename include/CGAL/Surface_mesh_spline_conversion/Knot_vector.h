// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_KNOT_VECTOR_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_KNOT_VECTOR_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is the clamped knot vector of a B-spline: increasing knots with multiplicities, of which the first
and the last are `degree + 1`.
*/
template <typename FT>
class Knot_vector
{
public:
  /// largest degree that can be evaluated.
  static constexpr int MAXIMUM_DEGREE = 7;

  /// the values of the `degree + 1` basis functions on a span, and their derivatives by order.
  typedef std::array<std::array<FT, MAXIMUM_DEGREE + 1>, 3> Basis;

  /// creates the knot vector of the polynomials of degree zero on [0,1].
  Knot_vector() : Knot_vector(0, {FT(0), FT(1)}, {1, 1}) {}

  /// creates a knot vector.
  /// \pre `knots` increases strictly, `multiplicities` is as described above
  Knot_vector(int degree, std::vector<FT> knots, std::vector<int> multiplicities)
    : m_degree(degree), m_knots(std::move(knots)), m_multiplicities(std::move(multiplicities))
  {
    CGAL_precondition(degree >= 0 && degree <= MAXIMUM_DEGREE);
    CGAL_precondition(m_knots.size() >= 2 && m_knots.size() == m_multiplicities.size());
    CGAL_precondition(m_multiplicities.front() == degree + 1);
    CGAL_precondition(m_multiplicities.back() == degree + 1);
    for(std::size_t i = 0; i < m_knots.size(); ++i)
      m_full.insert(m_full.end(), m_multiplicities[i], m_knots[i]);
  }

  /// creates a knot vector whose inner knots are simple.
  Knot_vector(int degree, std::vector<FT> knots)
    : Knot_vector(degree, knots, simple_multiplicities(degree, knots.size()))
  {}

  /// returns the degree.
  int degree() const { return m_degree; }

  /// returns the distinct knots.
  const std::vector<FT>& knots() const { return m_knots; }

  /// returns the multiplicities of `knots()`.
  const std::vector<int>& multiplicities() const { return m_multiplicities; }

  /// returns the knots repeated by their multiplicities.
  const std::vector<FT>& full() const { return m_full; }

  /// returns the number of basis functions.
  std::size_t number_of_functions() const { return m_full.size() - m_degree - 1; }

  /// returns the number of nonempty spans.
  std::size_t number_of_spans() const { return m_knots.size() - 1; }

  /// returns the index `i` with `full()[i] <= t < full()[i+1]`, the last nonempty span at the end;
  /// the functions `i - degree, ..., i` live there. Parameters outside are taken to the ends.
  std::size_t find_span(FT t) const
  {
    const auto begin = m_full.begin() + m_degree + 1, end = m_full.end() - m_degree - 1;
    return std::upper_bound(begin, end, t) - m_full.begin() - 1;
  }

  /// computes the basis functions of `span` at `t` and their derivatives up to `order <= 2`
  /// (Piegl and Tiller, The NURBS Book, sections 2.2 and 2.3).
  void evaluate(std::size_t span, FT t, int order, Basis& basis) const
  {
    for(int k = 0; k <= order; ++k)
    {
      basis[k].fill(FT(0));
      if(k > m_degree)
        continue;
      evaluate_lower_degree(span, t, m_degree - k, basis[k]);
      for(int d = m_degree - k + 1; d <= m_degree; ++d)
        differentiate(span, d, basis[k]);
    }
  }

private:
  static std::vector<int> simple_multiplicities(int degree, std::size_t n)
  {
    std::vector<int> m(n, 1);
    m.front() = m.back() = degree + 1;
    return m;
  }

  // the values of the functions of degree d on the span, by the recursion of Cox and de Boor
  void evaluate_lower_degree(std::size_t span, FT t, int d,
                             std::array<FT, MAXIMUM_DEGREE + 1>& value) const
  {
    value[0] = FT(1);
    for(int r = 1; r <= d; ++r)
    {
      FT saved(0);
      for(int i = 0; i < r; ++i)
      {
        const FT right = m_full[span + 1 + i], left = m_full[span + 1 + i - r];
        const FT quotient = value[i] / (right - left);
        value[i] = saved + (right - t) * quotient;
        saved = (t - left) * quotient;
      }
      value[r] = saved;
    }
  }

  // turns the k-th derivatives of the functions of degree d-1 into the (k+1)-st of those of degree
  // d
  void differentiate(std::size_t span, int d, std::array<FT, MAXIMUM_DEGREE + 1>& value) const
  {
    FT saved(0);
    for(int i = 0; i < d; ++i)
    {
      const FT quotient = value[i] * FT(d) / (m_full[span + 1 + i] - m_full[span + 1 + i - d]);
      value[i] = saved - quotient;
      saved = quotient;
    }
    value[d] = saved;
  }

  int m_degree;
  std::vector<FT> m_knots;
  std::vector<int> m_multiplicities;
  std::vector<FT> m_full;
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_KNOT_VECTOR_H
