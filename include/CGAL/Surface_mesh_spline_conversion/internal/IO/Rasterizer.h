// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_RASTERIZER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_RASTERIZER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

typedef std::array<double, 3> Coordinates;

inline double dot(const Coordinates& a, const Coordinates& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// An orthographic camera: x to the right, y upwards (both in pixels), z towards the viewer (in
// model units, relative to the centre).
class Orthographic_camera
{
public:
  Orthographic_camera(double azimuth_degrees, double elevation_degrees)
  {
    const double a = azimuth_degrees * CGAL_PI / 180, e = elevation_degrees * CGAL_PI / 180;
    m_axes[0] = {{-std::sin(a), std::cos(a), 0}};
    m_axes[1] = {{-std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), std::cos(e)}};
    m_axes[2] = {{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)}};
  }

  // makes the points fill the given share of the picture
  void fit(const std::vector<Coordinates>& points, double width, double height, double share)
  {
    const double infinity = std::numeric_limits<double>::infinity();
    Coordinates lower = {{infinity, infinity, infinity}};
    Coordinates upper = {{-infinity, -infinity, -infinity}};
    for(const Coordinates& p : points)
      for(int i = 0; i < 3; ++i)
      {
        const double x = dot(m_axes[i], p);
        lower[i] = (std::min)(lower[i], x);
        upper[i] = (std::max)(upper[i], x);
      }
    if(points.empty())
      lower = upper = Coordinates{{0, 0, 0}};
    for(int i = 0; i < 3; ++i)
      m_center[i] = (lower[i] + upper[i]) / 2;
    m_shift = {{width / 2, height / 2}};
    m_depth = upper[2] - lower[2];
    const double extent_x = upper[0] - lower[0], extent_y = upper[1] - lower[1];
    m_scale = share;
    if(extent_x > 0 || extent_y > 0)
      m_scale *= (std::min)((extent_x > 0) ? width / extent_x : infinity,
                            (extent_y > 0) ? height / extent_y : infinity);
  }

  Coordinates project(const Coordinates& p) const
  {
    return {{m_shift[0] + m_scale * (dot(m_axes[0], p) - m_center[0]),
             m_shift[1] - m_scale * (dot(m_axes[1], p) - m_center[1]),
             dot(m_axes[2], p) - m_center[2]}};
  }

  Coordinates rotate(const Coordinates& v) const
  {
    return {{dot(m_axes[0], v), dot(m_axes[1], v), dot(m_axes[2], v)}};
  }

  // model units per pixel, and the depth of the scene
  double pixel_size() const { return 1 / m_scale; }
  double depth() const { return m_depth; }

private:
  std::array<Coordinates, 3> m_axes;
  Coordinates m_center = {{0, 0, 0}};
  std::array<double, 2> m_shift = {{0, 0}};
  double m_scale = 1, m_depth = 0;
};

// A z-buffer that keeps what is needed for shading: per pixel the depth, the normal in camera
// coordinates, and the value of the frontmost point.
class Rasterizer
{
public:
  struct Vertex
  {
    Coordinates position; // projected
    Coordinates normal;   // rotated
    double value;
  };

  struct Fragment
  {
    double depth = -std::numeric_limits<double>::infinity();
    Coordinates normal = {{0, 0, 0}};
    double value = 0;
  };

  Rasterizer(std::size_t width, std::size_t height)
    : m_width(width), m_height(height), m_fragments(width * height)
  {}

  std::size_t width() const { return m_width; }
  std::size_t height() const { return m_height; }

  const Fragment& fragment(std::size_t x, std::size_t y) const
  {
    return m_fragments[y * m_width + x];
  }

  bool is_covered(std::size_t x, std::size_t y) const
  {
    return std::isfinite(fragment(x, y).depth);
  }

  void draw_triangle(const std::array<Vertex, 3>& t)
  {
    const double area = edge_function(t[0], t[1], t[2].position[0], t[2].position[1]);
    if(!std::isfinite(area) || area == 0)
      return;
    const std::array<std::size_t, 2> columns = range(t, 0, m_width), rows = range(t, 1, m_height);
    for(std::size_t y = rows[0]; y < rows[1]; ++y)
      for(std::size_t x = columns[0]; x < columns[1]; ++x)
      {
        // pixel centres are at half-integers
        const double px = static_cast<double>(x) + 0.5, py = static_cast<double>(y) + 0.5;
        const std::array<double, 3> weights = {{edge_function(t[1], t[2], px, py) / area,
                                                edge_function(t[2], t[0], px, py) / area,
                                                edge_function(t[0], t[1], px, py) / area}};
        if(weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0)
          put(m_fragments[y * m_width + x], t, weights);
      }
  }

private:
  static double edge_function(const Vertex& a, const Vertex& b, double x, double y)
  {
    return (b.position[0] - a.position[0]) * (y - a.position[1])
         - (b.position[1] - a.position[1]) * (x - a.position[0]);
  }

  // the pixels of the bounding box along one axis, clipped to the picture
  static std::array<std::size_t, 2> range(const std::array<Vertex, 3>& t, int axis,
                                          std::size_t size)
  {
    double lower = t[0].position[axis], upper = lower;
    for(const Vertex& v : t)
    {
      lower = (std::min)(lower, v.position[axis]);
      upper = (std::max)(upper, v.position[axis]);
    }
    const double limit = static_cast<double>(size);
    const double first = (std::min)((std::max)(std::floor(lower), 0.), limit);
    const double last = (std::min)((std::max)(std::ceil(upper) + 1, 0.), limit);
    return {{static_cast<std::size_t>(first), static_cast<std::size_t>(last)}};
  }

  static void put(Fragment& fragment, const std::array<Vertex, 3>& t,
                  const std::array<double, 3>& weights)
  {
    double depth = 0;
    for(int i = 0; i < 3; ++i)
      depth += weights[i] * t[i].position[2];
    if(!(depth > fragment.depth))
      return;
    fragment = Fragment();
    fragment.depth = depth;
    for(int i = 0; i < 3; ++i)
    {
      fragment.value += weights[i] * t[i].value;
      for(int k = 0; k < 3; ++k)
        fragment.normal[k] += weights[i] * t[i].normal[k];
    }
  }

  std::size_t m_width, m_height;
  std::vector<Fragment> m_fragments;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_RASTERIZER_H
