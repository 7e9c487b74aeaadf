// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CONE_SMOOTHING_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CONE_SMOOTHING_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Cone_disk.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Quad_grid.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// the smallest sine of the corner angles of a quad, seen along its normal; not positive if the quad
// is not convex
inline double scaled_jacobian(const std::array<Eigen::Vector3d, 4>& p)
{
  const Eigen::Vector3d normal = (p[2] - p[0]).cross(p[3] - p[1]);
  double least = 1;
  for(int i = 0; i < 4; ++i)
  {
    const Eigen::Vector3d out = p[(i + 1) % 4] - p[i], in = p[(i + 3) % 4] - p[i];
    const double scale = out.norm() * in.norm() * normal.norm();
    least = (std::min)(least, scale > 0 ? out.cross(in).dot(normal) / scale : -1.);
  }
  return least;
}

// Motions of the surface around the singularities of a map, where these make the flat quads there
// better shaped: see `Cone_disk`.
class Cone_smoothing
{
public:
  Cone_smoothing() {}

  // `locate`: the point of the working mesh at the local coordinates of a quad, without motions
  template <typename Locate>
  Cone_smoothing(const Seamless_map& map, const Quad_grid& grid, const Locate& locate)
    : m_disks_at(map.mesh.number_of_faces()), m_mesh(&map.mesh)
  {
    locate_vertices(grid, locate);
    for(int v = 0; v < map.mesh.number_of_vertices(); ++v)
      if(Cone_neighborhood::is_cone(map, v))
        smooth(map, grid, v);
    m_mesh = nullptr;
    m_vertices.clear();
    m_quads_at.clear();
  }

  Working_location operator()(const Working_location& at) const
  {
    if(m_disks_at.empty())
      return at;
    // disks do not meet: at most one moves the point
    Working_location result = at;
    for(const int disk : m_disks_at[at.face])
      if(result.face == at.face && result.barycentric == at.barycentric)
        result = (*m_disks[disk])(at);
    return result;
  }

private:
  template <typename Locate>
  void locate_vertices(const Quad_grid& grid, const Locate& locate)
  {
    m_vertices.assign(grid.number_of_vertices(), Working_location{-1, {{0, 0, 0}}});
    m_quads_at.resize(grid.number_of_vertices());
    for(int q = 0; q < grid.number_of_quads(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        const int v = grid.vertices[q][i];
        m_quads_at[v].push_back(q);
        if(m_vertices[v].face < 0)
          m_vertices[v] = locate(q, i == 1 || i == 2, i >= 2);
      }
  }

  // Takes the first disk that makes the quads good, or else the best one if it is better than none.
  void smooth(const Seamless_map& map, const Quad_grid& grid, int cone)
  {
    const std::array<double, 3> radii = {{1.6, 2.4, 0.8}}; // in quads
    const double least_radius = 0.2, good_jacobian = 0.5;
    Cone_neighborhood neighborhood(map, cone);
    neighborhood.collect(2 * radii[1]);
    const double free_radius = neighborhood.free_radius();
    if(!(free_radius >= least_radius))
      return;
    std::shared_ptr<const Cone_disk> best;
    double best_jacobian = 0;
    for(const double wanted : radii)
    {
      const double radius = (std::min)(wanted, free_radius);
      neighborhood.collect(radius);
      const auto disk = std::make_shared<const Cone_disk>(map, neighborhood, radius);
      if(!disk->is_valid() || meets_others(*disk))
        continue;
      const std::vector<int> quads = quads_at(*disk, grid);
      const double jacobian = least_jacobian(quads, grid, disk.get());
      if(best ? jacobian <= best_jacobian : jacobian <= least_jacobian(quads, grid, nullptr))
        continue;
      best_jacobian = jacobian;
      best = disk;
      if(jacobian > good_jacobian)
        break;
    }
    if(!best)
      return;
    for(const int f : best->faces())
      m_disks_at[f].push_back(static_cast<int>(m_disks.size()));
    m_disks.push_back(best);
  }

  bool meets_others(const Cone_disk& disk) const
  {
    std::set<int> others;
    for(const int f : disk.faces())
      others.insert(m_disks_at[f].begin(), m_disks_at[f].end());
    return std::any_of(others.begin(), others.end(),
                       [&](int other) { return disk.meets(*m_disks[other]); });
  }

  // those with a vertex in a face of the disk
  std::vector<int> quads_at(const Cone_disk& disk, const Quad_grid& grid) const
  {
    std::vector<int> quads;
    for(int v = 0; v < grid.number_of_vertices(); ++v)
      if(is_at(disk, m_vertices[v]))
        quads.insert(quads.end(), m_quads_at[v].begin(), m_quads_at[v].end());
    return quads;
  }

  static bool is_at(const Cone_disk& disk, const Working_location& at)
  {
    return std::binary_search(disk.faces().begin(), disk.faces().end(), at.face);
  }

  // of some quads, with the motions so far and that of `disk`, if there is one
  double least_jacobian(const std::vector<int>& quads, const Quad_grid& grid,
                        const Cone_disk* disk) const
  {
    double least = 1;
    for(const int q : quads)
    {
      std::array<Eigen::Vector3d, 4> points;
      for(int i = 0; i < 4; ++i)
      {
        const Working_location at = (*this)(m_vertices[grid.vertices[q][i]]);
        points[i] = point(disk != nullptr && is_at(*disk, at) ? (*disk)(at) : at);
      }
      least = (std::min)(least, scaled_jacobian(points));
    }
    return least;
  }

  Eigen::Vector3d point(const Working_location& at) const
  {
    const std::array<int, 3>& t = m_mesh->triangles[at.face];
    return at.barycentric[0] * m_mesh->points[t[0]] + at.barycentric[1] * m_mesh->points[t[1]]
           + at.barycentric[2] * m_mesh->points[t[2]];
  }

  std::vector<std::vector<int> > m_disks_at; // per face of the working mesh
  std::vector<std::shared_ptr<const Cone_disk> > m_disks;
  // during construction only
  const Working_mesh* m_mesh = nullptr;
  std::vector<Working_location> m_vertices;    // per vertex of the grid, without motions
  std::vector<std::vector<int> > m_quads_at;   // per vertex of the grid
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CONE_SMOOTHING_H
