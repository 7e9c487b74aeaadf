// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CONE_NEIGHBORHOOD_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CONE_NEIGHBORHOOD_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Triangle_locator.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Seamless_map.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_set>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The faces around a singularity of a seamless map, unfolded about it: the singularity is the
// origin of the chart of each face, and the charts of neighbours agree up to turns by right angles.
class Cone_neighborhood
{
public:
  typedef std::array<Eigen::Vector2d, 3> Positions;

  struct Face
  {
    int face;
    Positions positions; // of its vertices, in quads
  };

  Cone_neighborhood(const Seamless_map& map, int cone) : m_map(map), m_cone(cone) {}

  int cone() const { return m_cone; }

  // Collects the faces that are not farther away than `radius`.
  void collect(double radius)
  {
    m_faces.clear();
    std::unordered_set<int> is_known;
    std::vector<Placed_face> queue;
    m_map.mesh.for_each_outgoing(m_cone, [&](int h)
    {
      is_known.insert(h / 3);
      queue.push_back(Placed_face{h / 3, 0, minus(Fixed_point_2{{0, 0}}, m_map.coordinates[h])});
    });
    for(std::size_t i = 0; i < queue.size(); ++i)
    {
      m_faces.push_back(Face{queue[i].face, positions(queue[i])});
      for(int h = 3 * queue[i].face; h < 3 * queue[i].face + 3; ++h)
      {
        const int o = m_map.mesh.opposite[h];
        if(o < 0 || is_known.count(o / 3) != 0)
          continue;
        const Positions& p = m_faces[i].positions;
        if(distance_to_segment(p[h % 3], p[(h + 1) % 3]) > radius)
          continue;
        is_known.insert(o / 3);
        queue.push_back(queue[i].across(m_map, h));
      }
    }
  }

  const std::vector<Face>& faces() const { return m_faces; }

  // the largest radius of a disk that does not meet the boundary, nor such disks of other
  // singularities, as far as these are in the neighborhood
  double free_radius() const
  {
    double least = std::numeric_limits<double>::infinity();
    for(const Face& f : m_faces)
      for(int i = 0; i < 3; ++i)
      {
        const int v = m_map.mesh.triangles[f.face][i];
        const double distance = f.positions[i].norm();
        if(m_map.mesh.is_border_vertex(v))
          least = (std::min)(least, distance);
        else if(v != m_cone && is_cone(m_map, v))
          least = (std::min)(least, distance / 2);
      }
    return least;
  }

  // of the origin from a segment
  static double distance_to_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
  {
    const Eigen::Vector2d e = b - a;
    const double t = (std::min)(1., (std::max)(0., -a.dot(e) / e.squaredNorm()));
    return (a + t * e).norm();
  }

  static bool is_cone(const Seamless_map& map, int v)
  {
    return map.cone[v] != 4 && !map.mesh.is_border_vertex(v);
  }

private:
  Positions positions(const Placed_face& placed) const
  {
    Positions result;
    for(int i = 0; i < 3; ++i)
    {
      const Fixed_point_2 p = placed(m_map.coordinates[3 * placed.face + i]);
      for(int j = 0; j < 2; ++j)
        result[i][j] = std::ldexp(static_cast<double>(p[j]), -m_map.fractional_bits);
    }
    return result;
  }

  const Seamless_map& m_map;
  int m_cone;
  std::vector<Face> m_faces;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_CONE_NEIGHBORHOOD_H
