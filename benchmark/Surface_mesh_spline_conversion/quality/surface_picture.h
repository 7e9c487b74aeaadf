// Draws surfaces and transfinite patches.
#ifndef QUALITY_SURFACE_PICTURE_H
#define QUALITY_SURFACE_PICTURE_H

#include "surface_stages.h"

#include <CGAL/Surface_mesh_spline_conversion/IO/PNG.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/Picture_scene.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/IO/surface_scene.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

// The transfinite patches M~ with the interface that pictures of a surface need: a patch per quad.
class Transfinite_surface
{
public:
  explicit Transfinite_surface(const Target& target) : m_target(&target) {}

  std::size_t number_of_patches() const { return m_target->layout().number_of_quads(); }
  Surface::Patch_origin patch_origin(std::size_t quad) const { return {quad, 0, 0, 1, 1}; }

  Kernel::Point_3 position(std::size_t quad, double u, double v) const
  {
    return m_target->point(quad, u, v);
  }

  // of a square of two percent of the quad, as the mesh has no unique normal at its edges
  Kernel::Vector_3 normal(std::size_t quad, double u, double v) const
  {
    const double h = 0.01, s = inside(u, h), t = inside(v, h);
    const Kernel::Vector_3 n
      = CGAL::cross_product(position(quad, s + h, t) - position(quad, s - h, t),
                            position(quad, s, t + h) - position(quad, s, t - h));
    const double length = std::sqrt(n.squared_length());
    return length > 0 ? n / length : n;
  }

private:
  static double inside(double x, double h) { return x < h ? h : (x > 1 - h ? 1 - h : x); }

  const Target* m_target;
};

// the patches of a surface; one view from above if it is flat, else two
inline bool draw_patches(const std::string& filename, const Surface& surface,
                         const std::string& title, bool is_flat = false)
{
  using CGAL::Surface_mesh_spline_conversion::Picture_view;
  auto scene = SC::internal::surface_scene(std::vector<Surface>{surface},
                                           SC::internal::Patch_lines::PATCHES);
  scene.title = title;
  if(!is_flat)
    return CGAL::IO::write_PNG(filename, scene);
  Picture_view view;
  view.azimuth = -90;
  view.elevation = 90;
  return CGAL::IO::write_PNG(filename, scene, {view});
}

#endif // QUALITY_SURFACE_PICTURE_H
