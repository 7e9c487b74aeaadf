// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_SURFACE_SAMPLES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_SURFACE_SAMPLES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// a place on a piece
struct Piece_sample
{
  double u;
  double v;
  std::size_t triangle; ///< of the mesh, the closest one
};

/// the end of a search uphill
struct Summit
{
  double deviation;
  Eigen::Vector3d place;
};

/// What is known of a piece. The samples lie on a grid, row by row, where the sum of column and row
/// is even: the nodes, which are two columns or rows apart, and the centres between them.
struct Piece_samples
{
  std::array<int, 2> intervals; ///< between nodes along `u` and `v`
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> triangles; ///< of the mesh, the closest ones
  std::vector<double> deviations;
  std::vector<Summit> summits; ///< that were reached from samples
  long facing = 0; ///< samples that look like the mesh minus those that look against it

  /// returns a sample
  Piece_sample sample(std::size_t k) const
  {
    const std::size_t n = std::size_t(intervals[0]), row = k / (2 * n + 1), i = k % (2 * n + 1);
    const bool is_center = i > n;
    const std::size_t column = is_center ? 2 * (i - n) - 1 : 2 * i;
    return Piece_sample{double(column) / (2. * intervals[0]),
                        double(2 * row + is_center) / (2. * intervals[1]), triangles[k]};
  }

  /// returns the index of the sample with the largest deviation
  std::size_t largest() const
  {
    return std::size_t(std::max_element(deviations.begin(), deviations.end())
                       - deviations.begin());
  }

  /// returns the index of the sample closest to a point
  std::size_t nearest(const Eigen::Vector3d& p) const
  {
    return std::size_t(std::min_element(points.begin(), points.end(),
      [&p](const Eigen::Vector3d& a, const Eigen::Vector3d& b)
      { return (a - p).squaredNorm() < (b - p).squaredNorm(); }) - points.begin());
  }
};

/// what is known of all pieces of a surface
typedef std::vector<std::shared_ptr<const Piece_samples> > Surface_samples;

/// returns for each sample whether none beside it is larger
inline std::vector<char> peaks(const Piece_samples& samples)
{
  static constexpr int OFFSETS[8][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1},
                                        {-2, 0}, {2, 0}, {0, -2}, {0, 2}};
  const int nu = samples.intervals[0], nv = samples.intervals[1];
  auto deviation = [&](int column, int row)
  {
    const int before = row / 2 * (2 * nu + 1) + (row & 1) * (nu + 1);
    return samples.deviations[std::size_t(before + column / 2)];
  };
  std::vector<char> result;
  for(int b = 0; b <= 2 * nv; ++b)
    for(int a = b & 1; a <= 2 * nu; a += 2)
    {
      bool is_peak = true;
      for(const auto& offset : OFFSETS)
      {
        const int column = a + offset[0], row = b + offset[1];
        if(0 <= column && column <= 2 * nu && 0 <= row && row <= 2 * nv)
          is_peak = is_peak && deviation(column, row) <= deviation(a, b);
      }
      result.push_back(is_peak);
    }
  return result;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_EXPORT_SURFACE_SAMPLES_H
