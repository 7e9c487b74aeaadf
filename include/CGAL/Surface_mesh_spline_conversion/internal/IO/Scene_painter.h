// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_SCENE_PAINTER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_SCENE_PAINTER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/IO/Picture_scene.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/Raster_image.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/Rasterizer.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

typedef std::array<double, 3> Light; // red, green, blue in [0,1]

inline Color to_color(const Light& light)
{
  Color color;
  for(std::size_t i = 0; i < 3; ++i)
  {
    const double clamped = (std::min)((std::max)(light[i], 0.), 1.);
    color[i] = static_cast<unsigned char>(std::lround(255 * clamped));
  }
  return color;
}

inline Light scaled(const Light& light, double factor)
{
  return {{factor * light[0], factor * light[1], factor * light[2]}};
}

// The colour map for signed values in [-1,1]: blue, white, red; black beyond.
inline Light value_color(double x)
{
  static const Light blue = {{0.13, 0.35, 0.75}}, white = {{0.95, 0.95, 0.93}};
  static const Light red = {{0.80, 0.15, 0.12}}, black = {{0.08, 0.08, 0.08}};
  if(!(std::abs(x) <= 1))
    return black;
  const Light& end = (x < 0) ? blue : red;
  Light color;
  for(std::size_t i = 0; i < 3; ++i)
    color[i] = white[i] + std::abs(x) * (end[i] - white[i]);
  return color;
}

// Draws one view of a scene, twice as large as wanted, so that halving it smooths the edges.
class Scene_painter
{
public:
  Scene_painter(const Picture_scene& scene, const Picture_view& view)
    : m_scene(scene),
      m_camera(view.azimuth, view.elevation),
      m_rasterizer(2 * view.width, 2 * view.height),
      m_image(2 * view.width, 2 * view.height, Color{{255, 255, 255}})
  {
    const double margin = 0.94; // of the picture is filled at most
    m_camera.fit(scene.points, static_cast<double>(m_image.width()),
                 static_cast<double>(m_image.height()), margin * view.zoom);
  }

  Raster_image paint()
  {
    draw_triangles();
    shade();
    for(const Picture_scene::Line& line : m_scene.lines)
      draw_line(line);
    for(const Picture_scene::Mark& mark : m_scene.marks)
      draw_disc(m_camera.project(mark.point), 2 * mark.radius, mark.color);
    return m_image.half_size();
  }

private:
  void draw_triangles()
  {
    std::vector<Rasterizer::Vertex> vertices(m_scene.points.size());
    for(std::size_t i = 0; i < vertices.size(); ++i)
    {
      vertices[i].position = m_camera.project(m_scene.points[i]);
      vertices[i].normal = m_camera.rotate(m_scene.normals[i]);
      vertices[i].value = m_scene.values.empty() ? 0. : m_scene.values[i];
    }
    for(const std::array<std::size_t, 3>& t : m_scene.triangles)
      m_rasterizer.draw_triangle({{vertices[t[0]], vertices[t[1]], vertices[t[2]]}});
  }

  void shade()
  {
    for(std::size_t y = 0; y < m_rasterizer.height(); ++y)
      for(std::size_t x = 0; x < m_rasterizer.width(); ++x)
        if(m_rasterizer.is_covered(x, y))
          m_image.set_pixel(x, y, to_color(light(m_rasterizer.fragment(x, y))));
  }

  Light light(const Rasterizer::Fragment& fragment) const
  {
    Coordinates n = fragment.normal;
    const double length = std::sqrt(dot(n, n));
    const bool is_seen_from_inside = n[2] < 0;
    for(double& x : n)
      x *= (is_seen_from_inside ? -1 : 1) / ((length > 0) ? length : 1);
    switch(m_scene.shading)
    {
      case Picture_scene::Shading::VALUES:
        return scaled(value_color(fragment.value / m_scene.largest_value), 0.65 + 0.35 * n[2]);
      case Picture_scene::Shading::ZEBRA:
        return scaled(Light{{1, 0.98, 0.95}}, 0.15 + 0.85 * stripe(n));
      case Picture_scene::Shading::PLAIN:
        break;
    }
    const Light base = is_seen_from_inside ? Light{{0.62, 0.72, 0.86}} : Light{{0.93, 0.87, 0.74}};
    const Coordinates lamp = {{0.40, 0.50, 0.77}}; // from the upper right, behind the viewer
    return scaled(base, 0.40 + 0.25 * n[2] + 0.40 * (std::max)(dot(n, lamp), 0.));
  }

  // The brightness of the mirror image of parallel stripes: a soft step function of the direction
  // of the reflected view ray, whose breaks show a jump of the normal, and whose kinks show a jump
  // of the curvature.
  static double stripe(const Coordinates& n)
  {
    const double number_of_stripes = 8, sharpness = 5;
    const Coordinates reflected = {{2 * n[2] * n[0], 2 * n[2] * n[1], 2 * n[2] * n[2] - 1}};
    const Coordinates across = {{0.75, 0.55, 0.36}};
    const double wave = std::sin(number_of_stripes * CGAL_PI * dot(reflected, across));
    return 0.5 + 0.5 * (std::min)((std::max)(sharpness * wave, -1.), 1.);
  }

  void draw_line(const Picture_scene::Line& line)
  {
    const Coordinates a = m_camera.project(line.source), b = m_camera.project(line.target);
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    const double longest = static_cast<double>(m_image.width() + m_image.height());
    if(!(length <= 4 * longest)) // also true for coordinates that are not finite
      return;
    const int steps = static_cast<int>(std::ceil(length)) + 1;
    for(int i = 0; i <= steps; ++i)
    {
      const double t = static_cast<double>(i) / steps;
      draw_disc({{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])}},
                line.thickness, line.color);
    }
  }

  // draws the pixels of a disc that are not clearly behind the triangles
  void draw_disc(const Coordinates& center, double radius, const Color& color)
  {
    // chords of the sampled surface may hide a curve on it; where it is seen under a flat angle
    // the depth changes by several pixel sizes from pixel to pixel
    const double tolerance = 4 * m_camera.pixel_size() + 0.002 * m_camera.depth();
    const double width = static_cast<double>(m_image.width());
    const double height = static_cast<double>(m_image.height());
    if(!(std::abs(center[0]) < 2 * width && std::abs(center[1]) < 2 * height))
      return; // out of sight, or not finite
    const int r = static_cast<int>(std::ceil(radius));
    const int x0 = static_cast<int>(center[0]), y0 = static_cast<int>(center[1]);
    for(int y = y0 - r; y <= y0 + r; ++y)
      for(int x = x0 - r; x <= x0 + r; ++x)
      {
        if(x < 0 || y < 0 || x >= static_cast<int>(m_image.width())
           || y >= static_cast<int>(m_image.height())
           || std::hypot(x + 0.5 - center[0], y + 0.5 - center[1]) > radius)
          continue;
        const std::size_t column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
        if(m_rasterizer.fragment(column, row).depth < center[2] + tolerance)
          m_image.set_pixel(column, row, color);
      }
  }

  const Picture_scene& m_scene;
  Orthographic_camera m_camera;
  Rasterizer m_rasterizer;
  Raster_image m_image;
};

// The colour bar from -largest to +largest.
inline void draw_legend(Raster_image& image, std::size_t x, std::size_t y, std::size_t height,
                        double largest)
{
  const std::size_t bar_width = 24, labels = 5;
  for(std::size_t row = 0; row < height; ++row)
  {
    const double value = 1 - 2 * static_cast<double>(row) / static_cast<double>(height - 1);
    image.fill_rectangle(x, y + row, bar_width, 1, to_color(value_color(value)));
  }
  for(std::size_t i = 0; i < labels; ++i)
  {
    const double value = 1 - 2 * static_cast<double>(i) / (labels - 1);
    char text[32];
    std::snprintf(text, sizeof(text), "%.2g", value * largest);
    image.draw_text(x + bar_width + 6, y + i * (height - 1) / (labels - 1) - 7, text,
                    Color{{0, 0, 0}});
  }
}

// Draws all views side by side, below them nothing, above them the title.
inline Raster_image draw_scene(const Picture_scene& scene, const std::vector<Picture_view>& views)
{
  const std::size_t title_height = 34, legend_width = 130;
  const bool has_legend = scene.shading == Picture_scene::Shading::VALUES;
  std::size_t width = has_legend ? legend_width : 0, height = 0;
  for(const Picture_view& view : views)
  {
    width += view.width;
    height = (std::max)(height, view.height);
  }
  Raster_image image(width, height + title_height, Color{{255, 255, 255}});
  std::size_t x = 0;
  for(const Picture_view& view : views)
  {
    image.paste(Scene_painter(scene, view).paint(), x, title_height);
    x += view.width;
  }
  image.draw_text(12, 10, scene.title, Color{{0, 0, 0}});
  if(has_legend && height > 0)
    draw_legend(image, x + 6, title_height + height / 10, height * 8 / 10, scene.largest_value);
  return image;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_SCENE_PAINTER_H
