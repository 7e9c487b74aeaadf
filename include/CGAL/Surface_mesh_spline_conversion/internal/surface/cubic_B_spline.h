// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CUBIC_B_SPLINE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CUBIC_B_SPLINE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <array>
#include <cstdint>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Lengths in the T-mesh are integers, called ticks, so that the combinatorics of a refinement is
// exact. A knot interval of length zero is an edge of one tick; it vanishes in the conversion to
// parameters, because parameters are multiples of 2^20 ticks.
typedef std::int64_t Ticks;

constexpr int parameter_bits = 20;
constexpr Ticks unit_ticks = Ticks(1) << (2 * parameter_bits); // the side of a quad of the layout
constexpr Ticks zero_interval_ticks = 1;

// rounds ticks to the nearest parameter, in units of 2^-20 of a quad side
inline std::int64_t rounded_parameter(Ticks x)
{
  return (x + (Ticks(1) << (parameter_bits - 1))) >> parameter_bits;
}

// converts ticks to a parameter, where a quad side has the length one; the result is exact
inline double to_parameter(Ticks x)
{
  return double(rounded_parameter(x)) / double(std::int64_t(1) << parameter_bits);
}

typedef std::array<double, 5> Local_knots; // the knots of one cubic B-spline
typedef std::array<double, 6> Span_knots;  // three knots before and three after a span
typedef std::array<double, 4> Row;         // Bernstein or B-spline coefficients of a cubic

// computes the weights of the four B-spline coefficients of the span [t[2], t[3]] in the blossom
// value f(x, y, z) (de Boor's algorithm, run on the four unit vectors at the same time)
inline Row blossom_weights(const Span_knots& t, double x, double y, double z)
{
  const std::array<double, 3> argument = {{x, y, z}};
  std::array<Row, 4> d{};
  for(int i = 0; i < 4; ++i)
    d[i][i] = 1;
  for(int r = 1; r <= 3; ++r)
    for(int i = 3; i >= r; --i)
    {
      const double first = t[i - 1], last = t[i + 3 - r];
      const double alpha = (argument[r - 1] - first) / (last - first);
      for(int k = 0; k < 4; ++k)
        d[i][k] = (1 - alpha) * d[i - 1][k] + alpha * d[i][k];
    }
  return d[3];
}

// computes the weight of the B-spline coefficient `m` alone
inline double blossom_weight(const Span_knots& t, int m, double x, double y, double z)
{
  const std::array<double, 3> argument = {{x, y, z}};
  std::array<double, 4> d{};
  d[m] = 1;
  for(int r = 1; r <= 3; ++r)
    for(int i = 3; i >= r; --i)
      if(d[i - 1] != 0 || d[i] != 0)
      {
        const double alpha = (argument[r - 1] - t[i - 1]) / (t[i + 3 - r] - t[i - 1]);
        d[i] = (1 - alpha) * d[i - 1] + alpha * d[i];
      }
  return d[3];
}

// computes the Bernstein coefficients on [a, b] of the B-spline with the given knots, where no knot
// lies strictly between a and b; all are zero outside of the support.
inline Row bezier_row(const Local_knots& knots, double a, double b)
{
  int k = 0;
  while(k < 4 && !(knots[k] <= a && b <= knots[k + 1]))
    ++k;
  if(k == 4)
    return Row{};
  Span_knots t;
  for(int i = 0; i < 6; ++i)
  {
    const int j = k - 2 + i; // knots beyond the support have no influence
    t[i] = knots[j < 0 ? 0 : (j > 4 ? 4 : j)];
  }
  const int m = 3 - k;
  return Row{{ blossom_weight(t, m, a, a, a), blossom_weight(t, m, a, a, b),
               blossom_weight(t, m, a, b, b), blossom_weight(t, m, b, b, b) }};
}

// evaluates the four Bernstein polynomials of degree three, or their derivatives, at x in [0,1]
inline Row bernstein(double x, int derivative)
{
  const double y = 1 - x;
  switch(derivative)
  {
    case 0: return Row{{y * y * y, 3 * x * y * y, 3 * x * x * y, x * x * x}};
    case 1: return Row{{-3 * y * y, 3 * y * (y - 2 * x), 3 * x * (2 * y - x), 3 * x * x}};
    default: return Row{{6 * y, 6 * (x - 2 * y), 6 * (y - 2 * x), 6 * x}};
  }
}

// computes the weights of the Bernstein coefficients on [0,1] in the blossom value f(x, y, z)
inline Row bezier_blossom_weights(double x, double y, double z)
{
  return blossom_weights(Span_knots{{0, 0, 0, 1, 1, 1}}, x, y, z);
}

// restricts a cubic with the given Bernstein coefficients on [0,1] to [x, y]
inline Row restricted(const Row& row, double x, double y)
{
  Row result{};
  for(int i = 0; i < 4; ++i)
  {
    const Row w = bezier_blossom_weights(i < 3 ? x : y, i < 2 ? x : y, i < 1 ? x : y);
    for(int k = 0; k < 4; ++k)
      result[i] += w[k] * row[k];
  }
  return result;
}

inline double dot(const Row& a, const Row& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_SURFACE_CUBIC_B_SPLINE_H
