// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_CHECK_SEAMLESS_MAP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_CHECK_SEAMLESS_MAP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Seamless_map.h>

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The directions of the axes, counter clockwise.
inline Fixed_point_2 axis_direction(int i)
{
  return rotate(i, Fixed_point_2{{1, 0}});
}

// Number of axis directions in the sector from `first`, included, to `last`, excluded, which is
// less than half a turn.
inline int count_axis_directions(const Fixed_point_2& first, const Fixed_point_2& last)
{
  int n = 0;
  for(int i = 0; i < 4; ++i)
  {
    const Fixed_point_2 axis = axis_direction(i);
    const Wide_integer side = determinant(first, axis);
    if(side == 0 ? first[0] * axis[0] + first[1] * axis[1] > 0
                 : side > 0 && determinant(axis, last) > 0)
      ++n;
  }
  return n;
}

inline bool is_positive(const Seamless_map& map, int f)
{
  const Fixed_point_2* x = &map.coordinates[3 * f];
  return determinant(minus(x[1], x[0]), minus(x[2], x[0])) > 0;
}

// Transition or alignment of `h` is exact.
inline bool is_seam_exact(const Seamless_map& map, int h)
{
  const Fixed_point_2& source = map.coordinates[h];
  const Fixed_point_2& target = map.coordinates[Working_mesh::next(h)];
  if(map.mesh.is_border(h))
    return (source[0] == target[0]) != (source[1] == target[1]);
  const int o = map.mesh.opposite[h];
  return ((map.rotation[h] + map.rotation[o]) & 3) == 0
         && minus(map.coordinates[o], map.coordinates[Working_mesh::next(o)])
            == rotate(map.rotation[h], minus(target, source));
}

// The number of right angles at `v`, exactly. A map can be locally injective on all triangles and
// still have a wrong cone, because seams fix angles up to full turns only.
inline int realized_cone(const Seamless_map& map, int v)
{
  int n = 0;
  map.mesh.for_each_outgoing(v, [&](int h)
  {
    const Fixed_point_2& x = map.coordinates[h];
    n += count_axis_directions(minus(map.coordinates[Working_mesh::next(h)], x),
                               minus(map.coordinates[Working_mesh::previous(h)], x));
  });
  return n;
}

// Vertices at triangles that are not positive, at inexact seams, and with wrong cones: none if the
// map is what `Seamless_map` promises.
inline std::vector<int> find_defects(const Seamless_map& map)
{
  std::vector<char> is_bad(map.mesh.number_of_vertices(), 0);
  for(int f = 0; f < map.mesh.number_of_faces(); ++f)
    if(!is_positive(map, f))
      for(int v : map.mesh.triangles[f])
        is_bad[v] = 1;
  for(int h = 0; h < map.mesh.number_of_halfedges(); ++h)
    if(!is_seam_exact(map, h))
      is_bad[map.mesh.source(h)] = 1;
  std::vector<int> defects;
  for(int v = 0; v < map.mesh.number_of_vertices(); ++v)
    if(is_bad[v] || realized_cone(map, v) != map.cone[v])
      defects.push_back(v);
  return defects;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_CHECK_SEAMLESS_MAP_H
