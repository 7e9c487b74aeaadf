// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_INTERIOR_BOUND_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_INTERIOR_BOUND_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Interior_deviation.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Mesh_distance.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// cuts a piece in two halves along `u` (axis 0) or `v` (axis 1), by de Casteljau's algorithm
inline std::array<Bezier_piece, 2> bisected(const Bezier_piece& piece, int axis)
{
  std::array<Bezier_piece, 2> result = {{piece, piece}};
  const int n = piece.degree[axis], row = piece.degree[0] + 1;
  const int step = axis == 0 ? 1 : row, lines = piece.degree[1 - axis] + 1;
  for(int line = 0; line < lines; ++line)
  {
    const int first = line * (axis == 0 ? row : 1);
    const auto point = [&](int half, int i) -> Eigen::Vector3d&
    { return result[half].points[first + i * step]; };
    for(int r = 1; r <= n; ++r)
    {
      for(int i = n; i >= r; --i)
        point(0, i) = (point(0, i - 1) + point(0, i)) / 2;
      point(1, n - r) = point(0, n);
    }
  }
  return result;
}

/// An upper bound of the distance from the pieces of a surface to a mesh, outside the band along
/// the boundary where the mesh has chords and the surface has curves, see `Interior_deviation`.
///
/// The distance to a triangle is a convex function: on a piece, it is at most the largest one of
/// its control points, whatever triangle is taken. It is also at most the distance of one point and
/// the radius of the control points around it. Pieces are bisected until one of both bounds is
/// below the tolerance, or, if a point is farther than the tolerance, hardly above the distance of
/// that.
class Interior_bound
{
public:
  /// \param band the width of the band along the boundary where points do not count
  /// \param tolerance smaller bounds are not looked for
  Interior_bound(const std::vector<Bezier_piece>& pieces, const Mesh_distance& mesh, double band,
                 double tolerance)
    : m_mesh(mesh), m_band(band), m_tolerance(tolerance)
  {
    std::vector<double> bounds(pieces.size(), 0);
    for_each_index(pieces.size(), [&](std::size_t i) { bounds[i] = bound(pieces[i]); });
    for(const double b : bounds)
      m_bound = (std::max)(m_bound, b);
  }

  double value() const { return m_bound; }

private:
  // a bound that exceeds the distance at a point by less than this share is good enough
  static constexpr double RELATIVE_PRECISION = 0.01;

  // pieces of a piece; what is left then keeps its bound
  static constexpr std::size_t MAXIMUM_NUMBER_OF_PIECES = 100000;

  struct Part
  {
    double bound, distance; // of all points, and at the center
    bool is_in_band;        // all of it
  };

  double bound(const Bezier_piece& piece) const
  {
    double result = 0, largest_distance = 0;
    std::size_t hint = 0, number_of_pieces = 0;
    std::vector<Bezier_piece> stack(1, piece);
    while(!stack.empty())
    {
      const Bezier_piece top = std::move(stack.back());
      stack.pop_back();
      const Part part = estimate(top, hint);
      if(part.is_in_band)
        continue;
      largest_distance = (std::max)(largest_distance, part.distance);
      const double enough = largest_distance > m_tolerance
                            ? (1 + RELATIVE_PRECISION) * largest_distance : m_tolerance;
      if(part.bound <= enough || ++number_of_pieces > MAXIMUM_NUMBER_OF_PIECES)
        result = (std::max)(result, part.bound);
      else
        for(Bezier_piece& half : bisected(top, longer_axis(top)))
          stack.push_back(std::move(half));
    }
    return result;
  }

  Part estimate(const Bezier_piece& piece, std::size_t& hint) const
  {
    const Eigen::Vector3d center = piece.point(0.5, 0.5);
    double radius = 0, gap;
    for(const Eigen::Vector3d& p : piece.points)
      radius = (std::max)(radius, (p - center).norm());
    const double boundary_distance = m_mesh.boundary_distance(center, m_band, gap);
    Part result{0, 0, boundary_distance + radius <= m_band};
    if(result.is_in_band)
      return result;
    const double distance = m_mesh.foot(center, hint).distance;
    double largest = 0;
    for(const Eigen::Vector3d& p : piece.points)
      largest = (std::max)(largest, m_mesh.distance_to_triangle(p, hint));
    result.bound = (std::min)(largest, distance + radius);
    result.distance = boundary_distance > m_band ? distance : 0;
    return result;
  }

  static int longer_axis(const Bezier_piece& piece)
  {
    const double u = (piece.point(1, 0.5) - piece.point(0, 0.5)).squaredNorm();
    const double v = (piece.point(0.5, 1) - piece.point(0.5, 0)).squaredNorm();
    return u >= v ? 0 : 1;
  }

  const Mesh_distance& m_mesh;
  double m_band, m_tolerance, m_bound = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_INTERIOR_BOUND_H
