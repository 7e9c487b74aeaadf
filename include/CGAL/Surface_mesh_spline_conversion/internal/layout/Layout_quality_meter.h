// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LAYOUT_QUALITY_METER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LAYOUT_QUALITY_METER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/scaled_jacobian.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/number_type_config.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Collects values with weights.
class Weighted_statistics
{
public:
  void add(double value, double weight = 1)
  {
    m_least = m_weight > 0 ? (std::min)(m_least, value) : value;
    m_largest = m_weight > 0 ? (std::max)(m_largest, value) : value;
    m_sum += weight * value;
    m_weight += weight;
  }

  bool is_empty() const { return !(m_weight > 0); }
  double least() const { return m_least; }
  double mean() const { return m_sum / m_weight; }
  double largest() const { return m_largest; }

private:
  double m_least = 0, m_largest = 0, m_sum = 0, m_weight = 0;
};

inline double angle_in_degrees(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / CGAL_PI;
}

// Measures a layout by its vertices and samples of its inverse map.
template <typename GeomTraits>
class Layout_quality_meter
{
  typedef Quad_layout<GeomTraits> Layout;
  typedef typename Layout::Location Location;
  typedef typename Layout::Side Side;
  typedef Conversion_report::Map Report;

public:
  // a face of the mesh, its vertices in the order of `Surface_location`
  struct Face
  {
    std::array<Eigen::Vector3d, 3> points;
    std::array<double, 3> sizes; // wanted size of the quads at the vertices

    double area() const { return (points[1] - points[0]).cross(points[2] - points[0]).norm() / 2; }
  };

  Layout_quality_meter(const Layout& layout, const std::vector<Face>& mesh, Report& report)
    : m_layout(layout), m_mesh(mesh), m_report(report)
  {}

  void measure()
  {
    count();
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
    {
      measure_flat_quad(q);
      measure_map(q);
      for(int i = 0; i < 4; ++i)
        if(!m_layout.is_border(q, i))
          measure_kinks(q, i);
    }
    m_report.min_scaled_jacobian = m_jacobians.least();
    m_report.mean_angle_deviation_degrees = m_angles.mean();
    m_report.max_angle_deviation_degrees = m_angles.largest();
    m_report.min_size_ratio = m_sizes.least();
    m_report.mean_size_ratio = m_sizes.mean();
    m_report.max_size_ratio = m_sizes.largest();
    m_report.mean_singular_value_ratio = m_stretches.mean();
    m_report.max_singular_value_ratio = m_stretches.largest();
    m_report.mean_area_ratio = m_areas.mean();
    m_report.max_area_ratio = m_areas.largest();
    m_report.mean_kink_degrees = m_kinks.is_empty() ? 0 : m_kinks.mean();
    m_report.max_kink_degrees = m_kinks.is_empty() ? 0 : m_kinks.largest();
  }

private:
  // the inner vertices with other than four quads, and the number of quads
  void count()
  {
    std::vector<int> valence(m_layout.number_of_vertices(), 0);
    for(std::size_t q = 0; q < m_layout.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        const int border = -1000; // less than any valence
        ++valence[m_layout.vertex(q, i)];
        if(m_layout.is_border(q, i))
        {
          valence[m_layout.vertex(q, i)] += border;
          valence[m_layout.vertex(q, i + 1)] += border;
        }
      }
    m_report.extraordinary_points = std::size_t(std::count_if(
      valence.begin(), valence.end(), [](int n) { return n >= 0 && n != 4; }));
    double wanted = 0;
    for(const Face& face : m_mesh)
      for(const double size : face.sizes)
        wanted += face.area() / (3 * size * size);
    m_report.relative_number_of_quads = static_cast<double>(m_layout.number_of_quads()) / wanted;
  }

  Eigen::Vector3d point(std::size_t quad, int i) const
  {
    return to_eigen(m_layout.point(m_layout.vertex(quad, i)));
  }

  Location locate(std::size_t quad, double u, double v) const
  {
    typedef typename Layout::FT FT;
    return m_layout.inverse_map()(quad, FT(u), FT(v));
  }

  double size_at(const Location& location) const
  {
    double size = 0;
    for(std::size_t i = 0; i < 3; ++i)
      size += CGAL::to_double(location.barycentric[i]) * m_mesh[location.face].sizes[i];
    return size;
  }

  void measure_flat_quad(std::size_t quad)
  {
    std::array<Eigen::Vector3d, 4> points;
    for(int i = 0; i < 4; ++i)
      points[i] = point(quad, i);
    m_jacobians.add(scaled_jacobian(points));
    for(int i = 0; i < 4; ++i)
    {
      const Eigen::Vector3d out = points[(i + 1) % 4] - points[i];
      const Eigen::Vector3d in = points[(i + 3) % 4] - points[i];
      m_angles.add(std::abs(angle_in_degrees(out, in) - 90));
      const std::array<double, 2> middle = on_side(i, 0.5, 0);
      m_sizes.add(out.norm() / size_at(locate(quad, middle[0], middle[1])));
    }
  }

  // the derivatives of the inverse map at the middles of n x n parts of a quad
  void measure_map(std::size_t quad)
  {
    const int n = 4;
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
      {
        const double u = (i + 0.5) / n, v = (j + 0.5) / n;
        const Location at = locate(quad, u, v);
        const Eigen::Vector3d p = to_eigen(at.point);
        const Eigen::Vector3d du = (to_eigen(locate(quad, u + step, v).point) - p) / step;
        const Eigen::Vector3d dv = (to_eigen(locate(quad, u, v + step).point) - p) / step;
        // singular values from the first fundamental form
        const double e = du.squaredNorm(), f = du.dot(dv), g = dv.squaredNorm();
        const double area = du.cross(dv).norm();
        if(!(area > 0))
          continue;
        const double largest = (e + g + std::hypot(e - g, 2 * f)) / 2; // its square
        const double size = size_at(at), ratio = area / (size * size);
        m_stretches.add(largest / area, area);
        m_areas.add((std::max)(ratio, 1 / ratio), area);
      }
  }

  // the place with parameter `t` of a side, moved into the quad by `depth`
  static std::array<double, 2> on_side(int i, double t, double depth)
  {
    switch(i)
    {
      case 0: return {{t, depth}};
      case 1: return {{1 - depth, t}};
      case 2: return {{1 - t, 1 - depth}};
      default: return {{depth, 1 - t}};
    }
  }

  Eigen::Vector3d inward(const Side& side, double t) const
  {
    const std::array<double, 2> at = on_side(side.second, t, 0), next = on_side(side.second, t, step);
    return to_eigen(locate(side.first, next[0], next[1]).point)
           - to_eigen(locate(side.first, at[0], at[1]).point);
  }

  void measure_kinks(std::size_t quad, int i)
  {
    const Side side(quad, i), other = m_layout.neighbor(quad, i);
    if(other < side)
      return; // measured from the other side
    for(const double t : {0.25, 0.5, 0.75})
      m_kinks.add(angle_in_degrees(-inward(side, t), inward(other, 1 - t)));
  }

  // for difference quotients, in units of a quad: most steps stay in their triangle
  static constexpr double step = 1e-5;

  const Layout& m_layout;
  const std::vector<Face>& m_mesh;
  Report& m_report;
  Weighted_statistics m_jacobians, m_angles, m_sizes, m_stretches, m_areas, m_kinks;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LAYOUT_QUALITY_METER_H
