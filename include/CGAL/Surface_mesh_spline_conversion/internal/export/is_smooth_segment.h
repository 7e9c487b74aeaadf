// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_IS_SMOOTH_SEGMENT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_IS_SMOOTH_SEGMENT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/export/Cell_complex.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/blossoms.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// Do the bicubic pieces on both sides of a segment join with C2 continuity? Their first three rows
/// of blossoms across the segment, taken over the smaller width, must agree to `tolerance`.
inline bool is_smooth_segment(const Cell_complex& complex, std::size_t index, double tolerance)
{
  const Cell_complex::Segment& segment = complex.segments()[index];
  std::array<Bicubic, 2> grid;
  std::array<double, 2> extent;
  for(int k = 0; k < 2; ++k)
  {
    const auto& side = segment.sides[k];
    if(side.cell == NO_INDEX || complex.cells()[side.cell].cap != NO_INDEX)
      return false;
    const Cell& cell = complex.cells()[side.cell];
    grid[k] = rotated(*cell.points, (4 - side.side) & 3);
    extent[k] = double(cell.rectangle.extent((side.side + 1) & 1));
  }
  const double step = (std::min)(extent[0], extent[1]);
  const double inside = step / extent[0], outside = -step / extent[1];
  const auto &left = segment.sides[0], &right = segment.sides[1];
  for(int row = 0; row < 3; ++row)
    for(int i = 0; i < 4; ++i)
    {
      const Eigen::Vector3d difference
        = blossom(grid[0], bezier_arguments(left.first, left.last, i),
                  bezier_arguments(0, inside, row))
        - blossom(grid[1], bezier_arguments(right.last, right.first, i),
                  bezier_arguments(0, outside, row));
      if(!(difference.norm() <= tolerance))
        return false;
    }
  return true;
}

/// `is_smooth_segment()`, computed once for each segment
class Smooth_segments
{
public:
  /// two pieces are C2 if their blossoms agree to `tolerance`
  Smooth_segments(const Cell_complex& complex, double tolerance)
    : m_complex(complex), m_tolerance(tolerance), m_smooth(complex.segments().size(), UNKNOWN)
  {}

  bool operator()(std::size_t segment)
  {
    if(m_smooth[segment] == UNKNOWN)
      m_smooth[segment] = is_smooth_segment(m_complex, segment, m_tolerance) ? YES : NO;
    return m_smooth[segment] == YES;
  }

private:
  enum Smoothness : char { UNKNOWN, YES, NO };

  const Cell_complex& m_complex;
  double m_tolerance;
  std::vector<Smoothness> m_smooth;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_IS_SMOOTH_SEGMENT_H
