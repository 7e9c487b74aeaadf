// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_CHART_NAVIGATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_CHART_NAVIGATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Seamless_map.h>

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Directions are numbered 0..3 for +u, +v, -u, -v. All decisions in this file are exact.

inline int sign_of(const Wide_integer& x) { return (x > 0) - (x < 0); }

inline Fixed_point_2 axis_vector(int direction)
{
  return rotate(direction, Fixed_point_2{{1, 0}});
}

// the coordinate that grows or falls along `direction`; the other one is constant
inline int along_axis(int direction) { return direction & 1; }
inline int across_axis(int direction) { return 1 - (direction & 1); }
inline int axis_sign(int direction) { return (direction & 2) ? -1 : 1; }

// a point in the chart of a face with an axis direction
struct Chart_ray
{
  int face;
  Fixed_point_2 point;
  int direction;
};

// position of a point relative to the line through the halfedge `h`: > 0 on the side of its face
inline int side_of_halfedge(const Seamless_map& map, int h, const Fixed_point_2& p)
{
  const Fixed_point_2& a = map.coordinates[h];
  const Fixed_point_2& b = map.coordinates[Working_mesh::next(h)];
  return sign_of(determinant(minus(b, a), minus(p, a)));
}

// `true` if `p` lies in the closed triangle of the face `f`
inline bool is_in_triangle(const Seamless_map& map, int f, const Fixed_point_2& p)
{
  for(int h = 3 * f; h < 3 * f + 3; ++h)
    if(side_of_halfedge(map, h, p) < 0)
      return false;
  return true;
}

// how a direction lies in the sector of a corner, which is closed at the halfedge of the corner
// and open at the edge that follows counter clockwise
enum class Sector_position { OUTSIDE, INSIDE, ALONG_HALFEDGE };

inline Sector_position position_in_sector(const Seamless_map& map, int corner, int direction)
{
  const Fixed_point_2& apex = map.coordinates[corner];
  const Fixed_point_2 first = minus(map.coordinates[Working_mesh::next(corner)], apex);
  const Fixed_point_2 second = minus(map.coordinates[Working_mesh::previous(corner)], apex);
  const Fixed_point_2 d = axis_vector(direction);
  const int left_of_first = sign_of(determinant(first, d));
  if(left_of_first == 0)
  {
    const int a = along_axis(direction);
    return (first[a] > 0) == (d[a] > 0) ? Sector_position::ALONG_HALFEDGE
                                        : Sector_position::OUTSIDE;
  }
  return (left_of_first > 0 && determinant(d, second) > 0) ? Sector_position::INSIDE
                                                           : Sector_position::OUTSIDE;
}

// coordinates in the chart beyond the halfedge `h`
inline Fixed_point_2 cross_edge(const Seamless_map& map, int h, const Fixed_point_2& p)
{
  return plus(rotate(map.rotation[h], p), map.translation(h));
}

inline Chart_ray cross_edge(const Seamless_map& map, int h, const Chart_ray& ray)
{
  return Chart_ray{Working_mesh::face(map.mesh.opposite[h]), cross_edge(map, h, ray.point),
                   (ray.direction + map.rotation[h]) & 3};
}

// `ray` seen from the last face of `path`, a list of crossed halfedges
inline Chart_ray develop(const Seamless_map& map, Chart_ray ray, const std::vector<int>& path)
{
  for(int h : path)
    ray = cross_edge(map, h, ray);
  return ray;
}

inline std::vector<int> reversed_path(const Seamless_map& map, const std::vector<int>& path)
{
  std::vector<int> reversed;
  reversed.reserve(path.size());
  for(auto it = path.rbegin(); it != path.rend(); ++it)
    reversed.push_back(map.mesh.opposite[*it]);
  return reversed;
}

inline int corner_of_vertex(const Working_mesh& mesh, int f, int v)
{
  for(int c = 3 * f; c < 3 * f + 3; ++c)
    if(mesh.source(c) == v)
      return c;
  return -1;
}

// A corner to which a walk around its vertex has led, with a direction carried along.
struct Fan_position
{
  int corner;
  int direction;
  std::vector<int> crossed;
};

// Steps to the next corner in counter clockwise order; `false` at the boundary.
inline bool step_counterclockwise(const Seamless_map& map, Fan_position& position)
{
  const int crossed = Working_mesh::previous(position.corner);
  if(map.mesh.is_border(crossed))
    return false;
  position.crossed.push_back(crossed);
  position.direction = (position.direction + map.rotation[crossed]) & 3;
  position.corner = map.mesh.opposite[crossed];
  return true;
}

inline bool step_clockwise(const Seamless_map& map, Fan_position& position)
{
  const int crossed = position.corner;
  if(map.mesh.is_border(crossed))
    return false;
  position.crossed.push_back(crossed);
  position.direction = (position.direction + map.rotation[crossed]) & 3;
  position.corner = Working_mesh::next(map.mesh.opposite[crossed]);
  return true;
}

// Walks counter clockwise from `corner` to the first corner whose sector contains `direction`;
// the corner is -1 if there is none.
inline Fan_position find_sector(const Seamless_map& map, int corner, int direction)
{
  Fan_position position{corner, direction, {}};
  do
  {
    if(position_in_sector(map, position.corner, position.direction) != Sector_position::OUTSIDE)
      return position;
  }
  while(step_counterclockwise(map, position) && position.corner != corner);
  position.corner = -1;
  return position;
}

// Moves a ray to the face that contains the points slightly to the left of the ray. Where the point
// is a vertex, the walk is counter clockwise; at a cone the ray must touch the given face.
inline bool move_to_face_on_the_left(const Seamless_map& map, Chart_ray& ray)
{
  for(int c = 3 * ray.face; c < 3 * ray.face + 3; ++c)
    if(map.coordinates[c] == ray.point)
    {
      const Fan_position position = find_sector(map, c, ray.direction);
      if(position.corner < 0)
        return false;
      ray = develop(map, ray, position.crossed);
      return true;
    }
  for(int h = 3 * ray.face; h < 3 * ray.face + 3; ++h)
    if(side_of_halfedge(map, h, ray.point) == 0)
    {
      const Fixed_point_2 edge
        = minus(map.coordinates[Working_mesh::next(h)], map.coordinates[h]);
      const Fixed_point_2 d = axis_vector(ray.direction);
      int side = sign_of(determinant(edge, d));
      if(side == 0)
        side = sign_of(determinant(edge, rotate(1, d)));
      if(side > 0)
        return true;
      if(map.mesh.is_border(h))
        return false;
      ray = cross_edge(map, h, ray);
      return true;
    }
  return is_in_triangle(map, ray.face, ray.point);
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_CHART_NAVIGATION_H
