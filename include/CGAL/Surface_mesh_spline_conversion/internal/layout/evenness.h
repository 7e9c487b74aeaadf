// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_EVENNESS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_EVENNESS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// a point of a surface, and a normal of its face, of any length
struct Surface_sample
{
  Eigen::Vector3d point, normal;
};

// along a side of a quad
constexpr int samples_per_side = 9;

// How evenly an inverse map spreads a quad, from its points on a square grid, row by row: 1 if it is
// conformal, near 0 where it is nearly flattened or drawn out, negative where it is turned over. At
// the corners of the cells, twice the area between two sides is compared with the sum of their
// squares. Those of the quad do not count: at a corner of the boundary the angle may be above a
// straight one, see `Corner_fans`.
inline double evenness(const std::vector<Surface_sample>& samples)
{
  constexpr std::size_t n = samples_per_side;
  const std::array<std::size_t, 4> corners_of_quad = {{0, n - 1, n * n - 1, n * (n - 1)}};
  double least = 1;
  for(std::size_t k = 0; k + n < n * n; ++k)
  {
    if(k % n == n - 1)
      continue;
    const std::array<std::size_t, 4> corners = {{k, k + 1, k + n + 1, k + n}};
    Eigen::Vector3d outside = Eigen::Vector3d::Zero();
    for(const std::size_t c : corners)
      outside += samples[c].normal.normalized();
    for(std::size_t i = 0; i < 4; ++i)
    {
      const std::size_t c = corners[i];
      if(c == corners_of_quad[i])
        continue;
      const Eigen::Vector3d out = samples[corners[(i + 1) % 4]].point - samples[c].point;
      const Eigen::Vector3d in = samples[corners[(i + 3) % 4]].point - samples[c].point;
      const Eigen::Vector3d area = out.cross(in);
      const double squares = out.squaredNorm() + in.squaredNorm();
      const double ratio = squares > 0 ? 2 * area.norm() / squares : 0;
      least = (std::min)(least, area.dot(outside) > 0 ? ratio : -ratio);
    }
  }
  return least;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_EVENNESS_H
