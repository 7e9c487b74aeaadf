// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_FLAT_TRIANGLES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_FLAT_TRIANGLES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Triangles in the square [-1,1] x [-1,1], and the location of points among them.
class Flat_triangles
{
public:
  Flat_triangles() {}

  Flat_triangles(std::vector<std::array<int, 3> > triangles, std::vector<Eigen::Vector2d> points)
    : m_triangles(std::move(triangles)), m_points(std::move(points))
  {}

  const std::vector<Eigen::Vector2d>& points() const { return m_points; }

  // the point with some barycentric coordinates in a triangle
  Eigen::Vector2d point(int triangle, const Eigen::Vector3d& barycentric) const
  {
    const std::array<int, 3>& t = m_triangles[triangle];
    return barycentric[0] * m_points[t[0]] + barycentric[1] * m_points[t[1]]
           + barycentric[2] * m_points[t[2]];
  }

  // Are all triangles counter clockwise, and none next to degenerate?
  bool is_embedded() const
  {
    const double smallest_share = 1e-7; // of the mean area
    std::vector<double> areas;
    double sum = 0;
    for(const std::array<int, 3>& t : m_triangles)
    {
      const Eigen::Vector2d a = m_points[t[1]] - m_points[t[0]];
      const Eigen::Vector2d b = m_points[t[2]] - m_points[t[0]];
      areas.push_back(a[0] * b[1] - a[1] * b[0]);
      sum += areas.back();
    }
    return *std::min_element(areas.begin(), areas.end())
           > smallest_share * sum / static_cast<double>(areas.size());
  }

  // Sorts the triangles into cells. \pre `is_embedded()`
  void prepare_location()
  {
    m_cells_per_side = static_cast<int>(std::sqrt(static_cast<double>(m_triangles.size()))) + 1;
    m_cells.assign(static_cast<std::size_t>(m_cells_per_side) * m_cells_per_side,
                   std::vector<int>());
    m_coordinates.clear();
    for(int f = 0; f < static_cast<int>(m_triangles.size()); ++f)
    {
      const std::array<int, 3>& t = m_triangles[f];
      Eigen::Matrix3d corners;
      for(int i = 0; i < 3; ++i)
        corners.col(i) << 1, m_points[t[i]];
      m_coordinates.push_back(corners.inverse());
      const Eigen::Vector2d lower
        = m_points[t[0]].cwiseMin(m_points[t[1]]).cwiseMin(m_points[t[2]]);
      const Eigen::Vector2d upper
        = m_points[t[0]].cwiseMax(m_points[t[1]]).cwiseMax(m_points[t[2]]);
      for(int j = cell(lower[1]); j <= cell(upper[1]); ++j)
        for(int i = cell(lower[0]); i <= cell(upper[0]); ++i)
          m_cells[j * m_cells_per_side + i].push_back(f);
    }
  }

  // The triangle that contains a point, or, within rounding, is nearest to containing it, and the
  // barycentric coordinates there. \pre `prepare_location()` has been called
  std::pair<int, Eigen::Vector3d> locate(const Eigen::Vector2d& p) const
  {
    const std::vector<int>& near = m_cells[cell(p[1]) * m_cells_per_side + cell(p[0])];
    const double rounding = 1e-9;
    std::pair<int, Eigen::Vector3d> best = find(p, near);
    if(best.first >= 0 && best.second.minCoeff() > -rounding)
      return best;
    std::vector<int> all(m_triangles.size());
    for(std::size_t f = 0; f < all.size(); ++f)
      all[f] = static_cast<int>(f);
    return find(p, all);
  }

private:
  int cell(double x) const
  {
    const int i = static_cast<int>(std::floor((x + 1) / 2 * m_cells_per_side));
    return (std::min)(m_cells_per_side - 1, (std::max)(0, i));
  }

  std::pair<int, Eigen::Vector3d> find(const Eigen::Vector2d& p,
                                       const std::vector<int>& triangles) const
  {
    const Eigen::Vector3d homogeneous(1, p[0], p[1]);
    std::pair<int, Eigen::Vector3d> best(-1, Eigen::Vector3d::Zero());
    for(const int f : triangles)
    {
      const Eigen::Vector3d c = m_coordinates[f] * homogeneous;
      if(best.first >= 0 && c.minCoeff() <= best.second.minCoeff())
        continue;
      best = std::make_pair(f, c);
      if(c.minCoeff() >= 0)
        break;
    }
    return best;
  }

  std::vector<std::array<int, 3> > m_triangles;
  std::vector<Eigen::Vector2d> m_points;
  std::vector<Eigen::Matrix3d> m_coordinates;  // per triangle: barycentric from homogeneous ones
  int m_cells_per_side = 0;
  std::vector<std::vector<int> > m_cells;      // triangles whose boxes meet each cell
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_FLAT_TRIANGLES_H
