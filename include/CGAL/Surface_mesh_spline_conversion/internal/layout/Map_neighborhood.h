// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_MAP_NEIGHBORHOOD_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_MAP_NEIGHBORHOOD_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Triangle_locator.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Seamless_map.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The faces near some places of a seamless map, unfolded about the place that is nearest to each,
// which is the origin of the chart of the face. Behind singularities, the position depends on the
// way by which a face has been reached, and is an estimate.
class Map_neighborhood
{
public:
  typedef std::array<Eigen::Vector2d, 3> Positions;

  struct Face
  {
    int face;
    Positions positions; // of its vertices, in quads
  };

  // `radius`: how far away a face may be, in quads
  Map_neighborhood(const Seamless_map& map, const std::vector<Working_location>& places,
                   double radius)
    : m_map(map), m_radius(radius), m_position(map.mesh.number_of_faces(), -1),
      m_last_place(map.mesh.number_of_faces(), -1)
  {
    for(const Working_location& place : places)
      add_place(place);
  }

  // Adds the faces near a place, by way of their neighbours, in a chart with the place as origin.
  void add_place(const Working_location& place)
  {
    std::vector<Placed_face> queue;
    ++m_number_of_places;
    is_first_visit(place.face);
    queue.push_back(Placed_face{place.face, 0, origin_at(place)});
    for(std::size_t i = 0; i < queue.size(); ++i)
    {
      const Positions p = positions(queue[i]);
      add(Face{queue[i].face, p});
      for(int h = 3 * queue[i].face; h < 3 * queue[i].face + 3; ++h)
      {
        const int o = m_map.mesh.opposite[h];
        if(o < 0 || distance_to_segment(p[h % 3], p[(h + 1) % 3]) > m_radius
           || !is_first_visit(o / 3))
          continue;
        queue.push_back(queue[i].across(m_map, h));
      }
    }
  }

  const Seamless_map& map() const { return m_map; }
  const std::vector<Face>& faces() const { return m_faces; }

  // Halfedge i of face number f has the number 3 f + i. Returns the number of the opposite one, or
  // -1 if it does not belong to the faces.
  int opposite(int h) const
  {
    const int o = m_map.mesh.opposite[3 * m_faces[h / 3].face + h % 3];
    const int position = o < 0 ? -1 : m_position[o / 3];
    return position < 0 ? -1 : 3 * position + o % 3;
  }

  // `true` if some of the boundary is not farther away than the radius
  bool reaches_border() const
  {
    return std::any_of(m_faces.begin(), m_faces.end(), [this](const Face& f)
    {
      for(int i = 0; i < 3; ++i)
        if(m_map.mesh.is_border(3 * f.face + i)
           && distance_to_segment(f.positions[i], f.positions[(i + 1) % 3]) <= m_radius)
          return true;
      return false;
    });
  }

  // of the origin from a segment
  static double distance_to_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
  {
    const Eigen::Vector2d e = b - a;
    const double t = (std::min)(1., (std::max)(0., -a.dot(e) / e.squaredNorm()));
    return (a + t * e).norm();
  }

private:
  // the translation that moves the place to the origin
  Fixed_point_2 origin_at(const Working_location& place) const
  {
    std::array<double, 2> p = {{0, 0}};
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j < 2; ++j)
        p[j] += place.barycentric[i]
                * static_cast<double>(m_map.coordinates[3 * place.face + i][j]);
    return {{-std::llround(p[0]), -std::llround(p[1])}};
  }

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

  void add(const Face& face)
  {
    int& position = m_position[face.face];
    if(position < 0)
    {
      position = static_cast<int>(m_faces.size());
      m_faces.push_back(face);
    }
    else if(Positions& known = m_faces[position].positions;
            middle(face.positions).norm() < middle(known).norm())
      known = face.positions;
  }

  // by way of the present place
  bool is_first_visit(int face)
  {
    const bool is_first = m_last_place[face] != m_number_of_places;
    m_last_place[face] = m_number_of_places;
    return is_first;
  }

  static Eigen::Vector2d middle(const Positions& p) { return (p[0] + p[1] + p[2]) / 3; }

  const Seamless_map& m_map;
  const double m_radius;
  std::vector<Face> m_faces;
  std::vector<int> m_position;   // per face of the map: in `m_faces`, or -1
  std::vector<int> m_last_place; // per face of the map: the last place that has reached it
  int m_number_of_places = 0;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_MAP_NEIGHBORHOOD_H
