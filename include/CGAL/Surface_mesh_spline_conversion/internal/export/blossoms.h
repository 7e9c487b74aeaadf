// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_BLOSSOMS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_BLOSSOMS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

// Blossoms (polar forms) of cubic and bicubic Bezier pieces on the unit interval and square: the
// values f(t0,t1,t2) of the symmetric affine-linear form with f(t,t,t) = point at t. The Bezier
// points on [a,b] are f(a,a,a), f(a,a,b), f(a,b,b), f(b,b,b), the control points of a B-spline
// f(three consecutive knots).

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

typedef std::array<Eigen::Vector3d, 4> Cubic;
typedef std::array<double, 3> Blossom_arguments;

/// Bezier points of a bicubic piece, `[4*j+i]` with `i` along `u`
typedef std::array<Eigen::Vector3d, 16> Bicubic;

inline Eigen::Vector3d blossom(const Cubic& b, const Blossom_arguments& t)
{
  Cubic p = b;
  for(int r = 0; r < 3; ++r)
    for(int i = 0; i < 3 - r; ++i)
      p[i] = (1 - t[r]) * p[i] + t[r] * p[i + 1];
  return p[0];
}

inline Eigen::Vector3d blossom(const Bicubic& b, const Blossom_arguments& u,
                               const Blossom_arguments& v)
{
  Cubic rows;
  for(int j = 0; j < 4; ++j)
    rows[j] = blossom(Cubic{{b[4 * j], b[4 * j + 1], b[4 * j + 2], b[4 * j + 3]}}, u);
  return blossom(rows, v);
}

/// returns the arguments of Bezier point `i` on `[a,b]`
inline Blossom_arguments bezier_arguments(double a, double b, int i)
{
  return {{i > 2 ? b : a, i > 1 ? b : a, i > 0 ? b : a}};
}

inline Cubic restriction(const Cubic& c, double a, double b)
{
  Cubic result;
  for(int i = 0; i < 4; ++i)
    result[i] = blossom(c, bezier_arguments(a, b, i));
  return result;
}

inline Bicubic restriction(const Bicubic& c, double u0, double v0, double u1, double v1)
{
  Bicubic result;
  for(int j = 0; j < 4; ++j)
    for(int i = 0; i < 4; ++i)
      result[4 * j + i] = blossom(c, bezier_arguments(u0, u1, i), bezier_arguments(v0, v1, j));
  return result;
}

/// The matrix from the Bezier points of a polynomial to the control points of the same polynomial as a
/// B-spline with `breaks` as simple knots: blossoms at as many consecutive knots as the degree.
inline Eigen::MatrixXd knot_insertion(int degree, const std::vector<double>& breaks)
{
  const std::size_t last = breaks.size() - 1, d = static_cast<std::size_t>(degree);
  Eigen::MatrixXd result(last + d, degree + 1);
  for(std::size_t i = 0; i < last + d; ++i)
  {
    Eigen::MatrixXd p = Eigen::MatrixXd::Identity(degree + 1, degree + 1);
    for(std::size_t r = 1; r <= d; ++r)
    {
      const double knot = breaks[i + r < d ? 0 : (std::min)(i + r - d, last)];
      const double t = (knot - breaks.front()) / (breaks.back() - breaks.front());
      for(std::size_t j = 0; j + r <= d; ++j)
        p.row(j) = ((1 - t) * p.row(j) + t * p.row(j + 1)).eval();
    }
    result.row(i) = p.row(0);
  }
  return result;
}

/// returns a square grid of points after `turns` counter clockwise quarter turns of its domain
template <std::size_t N>
std::array<Eigen::Vector3d, N> rotated(const std::array<Eigen::Vector3d, N>& grid, int turns)
{
  static_assert(N == 16 || N == 36, "bicubic or biquintic");
  constexpr int n = (N == 16) ? 4 : 6;
  std::array<Eigen::Vector3d, N> from = grid, to = grid;
  for(int r = 0; r < (turns & 3); ++r)
  {
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
        to[n * i + (n - 1 - j)] = from[n * j + i];
    from = to;
  }
  return to;
}

/// returns the Bezier points along side `i` of a piece, counter clockwise
inline Cubic side_curve(const Bicubic& b, int i)
{
  const Bicubic r = rotated(b, (4 - i) & 3);
  return {{r[0], r[1], r[2], r[3]}};
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_BLOSSOMS_H
