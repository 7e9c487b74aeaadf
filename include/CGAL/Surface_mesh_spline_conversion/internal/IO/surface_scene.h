// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_SURFACE_SCENE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_SURFACE_SCENE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/IO/Picture_scene.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

template <typename Triple>
Picture_scene::Point to_picture_point(const Triple& p)
{
  return {{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())}};
}

// The number of intervals per patch side with which `patches` are sampled: as many as keep the
// number of samples bearable, and at least two.
inline std::size_t sampling_density(std::size_t patches)
{
  const double bearable_samples = 200000;
  const double count = static_cast<double>((std::max)(patches, std::size_t(1)));
  const double density = (std::min)(std::sqrt(bearable_samples / count), 8.);
  return static_cast<std::size_t>((std::max)(density, 2.));
}

enum class Patch_lines { NONE, LAYOUT, PATCHES };

// Samples the patches of a surface with n x n rectangles each, and adds them to a scene, on demand
// with the sides of the patches, or only with those that lie on sides of layout quads.
template <typename Surface>
class Surface_sampler
{
public:
  Surface_sampler(const Surface& surface, std::size_t n, Picture_scene& scene)
    : m_surface(surface), m_n(n), m_scene(scene)
  {}

  void sample(Patch_lines lines)
  {
    for(std::size_t patch = 0; patch < m_surface.number_of_patches(); ++patch)
    {
      const std::size_t first = m_scene.points.size();
      add_samples(patch);
      add_triangles(first);
      if(lines != Patch_lines::NONE)
        add_lines(patch, first, lines == Patch_lines::LAYOUT);
    }
  }

private:
  void add_samples(std::size_t patch)
  {
    const auto rectangle = m_surface.patch_origin(patch);
    for(std::size_t j = 0; j <= m_n; ++j)
      for(std::size_t i = 0; i <= m_n; ++i)
      {
        const double s = static_cast<double>(i) / static_cast<double>(m_n);
        const double t = static_cast<double>(j) / static_cast<double>(m_n);
        // both ends are hit exactly: the parameters must not leave the patch
        const double u = (1 - s) * rectangle.u0 + s * rectangle.u1;
        const double v = (1 - t) * rectangle.v0 + t * rectangle.v1;
        m_scene.points.push_back(to_picture_point(m_surface.position(patch, u, v)));
        m_scene.normals.push_back(to_picture_point(m_surface.normal(patch, u, v)));
      }
  }

  std::size_t index(std::size_t first, std::size_t i, std::size_t j) const
  {
    return first + j * (m_n + 1) + i;
  }

  void add_triangles(std::size_t first)
  {
    for(std::size_t j = 0; j < m_n; ++j)
      for(std::size_t i = 0; i < m_n; ++i)
      {
        const std::size_t a = index(first, i, j), b = index(first, i + 1, j);
        const std::size_t c = index(first, i + 1, j + 1), d = index(first, i, j + 1);
        m_scene.triangles.push_back({{a, b, c}});
        m_scene.triangles.push_back({{a, c, d}});
      }
  }

  void add_lines(std::size_t patch, std::size_t first, bool only_layout)
  {
    const auto rectangle = m_surface.patch_origin(patch);
    for(std::size_t i = 0; i < m_n; ++i)
    {
      add_line(index(first, i, 0), index(first, i + 1, 0), rectangle.v0 == 0, only_layout);
      add_line(index(first, m_n, i), index(first, m_n, i + 1), rectangle.u1 == 1, only_layout);
      add_line(index(first, i, m_n), index(first, i + 1, m_n), rectangle.v1 == 1, only_layout);
      add_line(index(first, 0, i), index(first, 0, i + 1), rectangle.u0 == 0, only_layout);
    }
  }

  // sides of layout quads are drawn in black, other sides of patches thinner and in grey
  void add_line(std::size_t from, std::size_t to, bool is_on_layout, bool only_layout)
  {
    if(only_layout && !is_on_layout)
      return;
    Picture_scene::Line line;
    line.source = m_scene.points[from];
    line.target = m_scene.points[to];
    const unsigned char grey = (is_on_layout) ? 20 : 110;
    line.color = {{grey, grey, grey}};
    line.thickness = is_on_layout ? 1.3 : 0.8;
    m_scene.lines.push_back(line);
  }

  const Surface& m_surface;
  std::size_t m_n;
  Picture_scene& m_scene;
};

// Returns a scene with all surfaces of a range.
template <typename SurfaceRange>
Picture_scene surface_scene(const SurfaceRange& surfaces, Patch_lines lines)
{
  std::size_t patches = 0;
  for(const auto& surface : surfaces)
    patches += surface.number_of_patches();
  Picture_scene scene;
  for(const auto& surface : surfaces)
    Surface_sampler<std::decay_t<decltype(surface)> >(surface, sampling_density(patches), scene)
      .sample(lines);
  return scene;
}

// Marks the extraordinary points, with a colour for each valence.
template <typename SurfaceRange>
void add_extraordinary_points(const SurfaceRange& surfaces, Picture_scene& scene)
{
  const Picture_scene::Color red = {{205, 35, 30}}, blue = {{30, 80, 200}};
  const Picture_scene::Color violet = {{150, 40, 170}};
  const double radius = 4;
  for(const auto& surface : surfaces)
    for(std::size_t i = 0; i < surface.number_of_extraordinary_points(); ++i)
    {
      const auto ring = surface.extraordinary_ring(i, surface.minimum_ring_level(i));
      const auto& sector = ring.sectors.front();
      const bool is_right = sector.corner == 1 || sector.corner == 2, is_upper = sector.corner >= 2;
      const auto point = surface.position(sector.patch, is_right ? sector.u1 : sector.u0,
                                          is_upper ? sector.v1 : sector.v0);
      const int valence = ring.valence();
      scene.marks.push_back({to_picture_point(point),
                             (valence == 3) ? red : (valence == 5) ? blue : violet, radius});
    }
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_IO_SURFACE_SCENE_H
