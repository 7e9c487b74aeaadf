// Draws layouts on their meshes.
#ifndef QUALITY_LAYOUT_PICTURE_H
#define QUALITY_LAYOUT_PICTURE_H

#include "../robustness/Plain_meshes.h"

#include <CGAL/Surface_mesh_spline_conversion/IO/PNG.h>
#include <CGAL/Surface_mesh_spline_conversion/IO/Picture_scene.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

// the triangles, with normals that are smooth except at sharp edges
inline void add_mesh(const Check::Triangle_mesh& mesh,
                     CGAL::Surface_mesh_spline_conversion::Picture_scene& scene)
{
  std::vector<Check::Point> smooth(mesh.points.size(), Check::Point{{0, 0, 0}});
  for(std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for(const std::size_t v : mesh.triangles[f])
      smooth[v] = Check::sum(smooth[v], mesh.normal(f));
  for(std::size_t f = 0; f < mesh.triangles.size(); ++f)
  {
    const Check::Point flat = Check::unit(mesh.normal(f));
    for(const std::size_t v : mesh.triangles[f])
    {
      const double cosine_of_sharp_edge = 0.8;
      const Check::Point normal = Check::unit(smooth[v]);
      scene.points.push_back(mesh.points[v]);
      scene.normals.push_back(Check::dot(normal, flat) < cosine_of_sharp_edge ? flat : normal);
    }
    const std::size_t n = scene.points.size();
    scene.triangles.push_back({{n - 3, n - 2, n - 1}});
  }
}

// the sides of the quads as they lie on the mesh, or straight if there is no inverse map
inline void add_sides(const Check::Quad_mesh& layout,
                      CGAL::Surface_mesh_spline_conversion::Picture_scene& scene)
{
  const double bearable_segments = 200000, sides = 4 * double(layout.quads.size());
  const int segments = layout.inverse_map
                         ? int((std::max)(1., (std::min)(24., bearable_segments / sides))) : 1;
  const double ends[4][4] = {{0, 0, 1, 0}, {1, 0, 1, 1}, {1, 1, 0, 1}, {0, 1, 0, 0}};
  for(std::size_t q = 0; q < layout.quads.size(); ++q)
    for(int i = 0; i < 4; ++i)
    {
      const Check::Quad_mesh::Side other = layout.neighbors[q][i];
      const bool is_border = other.first == Check::Quad_mesh::null;
      if(!is_border && other < Check::Quad_mesh::Side(q, i))
        continue; // drawn from the other side
      Check::Point last = layout.points[layout.quads[q][i]];
      for(int k = 1; k <= segments; ++k)
      {
        const double t = double(k) / segments;
        const Check::Point next = k == segments
          ? layout.points[layout.quads[q][(i + 1) & 3]]
          : layout.inverse_map(q, (1 - t) * ends[i][0] + t * ends[i][2],
                               (1 - t) * ends[i][1] + t * ends[i][3]).point;
        scene.lines.push_back({last, next, {{20, 20, 20}}, is_border ? 2.2 : 1.2});
        last = next;
      }
    }
}

// marks extraordinary points: red with three quads, blue with five, violet with others
inline void add_extraordinary_points(const Check::Quad_mesh& layout,
                                     CGAL::Surface_mesh_spline_conversion::Picture_scene& scene)
{
  std::vector<int> valence(layout.points.size(), 0);
  std::vector<bool> is_border(layout.points.size(), false);
  for(std::size_t q = 0; q < layout.quads.size(); ++q)
    for(std::size_t i = 0; i < 4; ++i)
    {
      ++valence[layout.quads[q][i]];
      if(layout.neighbors[q][i].first == Check::Quad_mesh::null)
        is_border[layout.quads[q][i]] = is_border[layout.quads[q][(i + 1) % 4]] = true;
    }
  for(std::size_t v = 0; v < valence.size(); ++v)
  {
    if(is_border[v] || valence[v] == 4)
      continue;
    const CGAL::Surface_mesh_spline_conversion::Picture_scene::Color red = {{205, 35, 30}},
      blue = {{30, 80, 200}}, violet = {{150, 40, 170}};
    scene.marks.push_back({layout.points[v],
                           valence[v] == 3 ? red : (valence[v] == 5 ? blue : violet), 4});
  }
}

// Draws a layout from two opposite directions.
inline bool draw_layout(const std::string& filename, const Check::Triangle_mesh& mesh,
                        const Check::Quad_mesh& layout, const std::string& title)
{
  CGAL::Surface_mesh_spline_conversion::Picture_scene scene;
  add_mesh(mesh, scene);
  add_sides(layout, scene);
  add_extraordinary_points(layout, scene);
  scene.title = title;
  return CGAL::IO::write_PNG(filename, scene);
}

#endif // QUALITY_LAYOUT_PICTURE_H
