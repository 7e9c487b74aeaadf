// Fig. 2 of the paper: how far the boundary curves reach inwards, for three quad sizes, without
// any fit.
#ifndef QUALITY_FIGURE_2_H
#define QUALITY_FIGURE_2_H

#include "surface_picture.h"
#include "surface_stages.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/IO/Signed_mesh_distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

// the area of the triangles of a scene, and the largest distance from the mesh, in quads with and
// without a boundary side
struct Influence
{
  double area[2] = {0, 0}, distance[2] = {0, 0};
};

inline Influence measure_influence(const Target& target, const SC::Picture_scene& scene)
{
  Influence result;
  const std::size_t triangles_per_quad
    = scene.triangles.size() / target.layout().number_of_quads();
  for(std::size_t i = 0; i < scene.triangles.size(); ++i)
  {
    const int is_inner = target.is_boundary_quad(i / triangles_per_quad) ? 0 : 1;
    std::array<Kernel::Point_3, 3> p;
    for(std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t v = scene.triangles[i][k];
      p[k] = Kernel::Point_3(scene.points[v][0], scene.points[v][1], scene.points[v][2]);
      result.distance[is_inner] = (std::max)(result.distance[is_inner], scene.values[v]);
    }
    result.area[is_inner] += std::sqrt(CGAL::squared_area(p[0], p[1], p[2]));
  }
  return result;
}

inline bool print_figure_2(const Input& input, const std::string& folder)
{
  const double d = input.diameter(), end_of_colours = 2e-3;
  std::printf("Fig. 2: the part of the surface that the curves change (lengths relative to D)\n"
              "  %9s %6s %15s %13s %17s %17s\n", "quad size", "quads", "boundary quads",
              "area changed", "distance there", "elsewhere");
  for(const double quad_size : {0.16, 0.08, 0.04})
  {
    Layout layout;
    if(!input.make_layout(quad_size, layout))
      return false;
    const Target target(layout, input.network.front(), input.data.mesh);
    auto scene = SC::internal::surface_scene(
      std::vector<Transfinite_surface>{Transfinite_surface(target)},
      SC::internal::Patch_lines::LAYOUT);
    const auto np = CGAL::parameters::default_values();
    scene.values = SC::internal::Signed_mesh_distance<Case::Triangle_mesh,
      CGAL::parameters::Default_named_parameters>(input.data.mesh, np).of_points(scene.points);
    for(double& value : scene.values)
      value = std::abs(value);
    const Influence influence = measure_influence(target, scene);
    std::size_t boundary_quads = 0;
    for(std::size_t q = 0; q < layout.number_of_quads(); ++q)
      boundary_quads += target.is_boundary_quad(q) ? 1 : 0;
    std::printf("  %9.2f %6zu %15zu %12.1f%% %17.3g %17.3g\n", quad_size,
                layout.number_of_quads(), boundary_quads,
                100 * influence.area[0] / (influence.area[0] + influence.area[1]),
                influence.distance[0] / d, influence.distance[1] / d);
    std::fflush(stdout);
    scene.shading = SC::Picture_scene::Shading::VALUES;
    scene.largest_value = end_of_colours * d;
    const std::string size = std::to_string(int(std::lround(100 * quad_size)));
    scene.title = "distance of the transfinite patches from the mesh, quad size 0." +
                  std::string(2 - size.size(), '0') + size;
    if(!CGAL::IO::write_PNG(folder + "/figure_2_size_" + size + ".png", scene))
      return false;
  }
  return true;
}

#endif // QUALITY_FIGURE_2_H
