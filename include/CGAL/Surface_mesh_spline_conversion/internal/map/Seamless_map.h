// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_SEAMLESS_MAP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_SEAMLESS_MAP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Working_mesh.h>

#ifndef __SIZEOF_INT128__
#  include <boost/multiprecision/cpp_int.hpp>
#endif

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// holds products of two coordinates exactly
#ifdef __SIZEOF_INT128__
__extension__ typedef __int128 Wide_integer;
#else
typedef boost::multiprecision::int128_t Wide_integer;
#endif

// point or vector of the parameter plane, in units of 2^-fractional_bits quads
typedef std::array<std::int64_t, 2> Fixed_point_2;

inline Fixed_point_2 plus(const Fixed_point_2& a, const Fixed_point_2& b)
{
  return {{a[0] + b[0], a[1] + b[1]}};
}

inline Fixed_point_2 minus(const Fixed_point_2& a, const Fixed_point_2& b)
{
  return {{a[0] - b[0], a[1] - b[1]}};
}

inline Wide_integer determinant(const Fixed_point_2& a, const Fixed_point_2& b)
{
  return static_cast<Wide_integer>(a[0]) * b[1] - static_cast<Wide_integer>(a[1]) * b[0];
}

// `x` turned counter clockwise by `quarter_turns` right angles
template <typename Vector>
Vector rotate(int quarter_turns, const Vector& x)
{
  Vector y = x;
  switch(quarter_turns & 3)
  {
    case 1: y[0] = -x[1]; y[1] = x[0]; break;
    case 2: y[0] = -x[0]; y[1] = -x[1]; break;
    case 3: y[0] = x[1]; y[1] = -x[0]; break;
    default: break;
  }
  return y;
}

// A locally injective map of the working mesh to the parameter plane, piecewise linear on
// triangles, one chart per triangle, exact: transitions across edges are turns by right angles
// followed by translations, boundary edges are parallel to an axis, and all triangles are positive.
struct Seamless_map
{
  Working_mesh mesh;
  int fractional_bits = 0;                 // coordinates are multiples of 2^-fractional_bits quads
  std::vector<Fixed_point_2> coordinates;  // per corner 3 * f + i
  std::vector<int> rotation;               // per halfedge h of f with opposite in g:
                                           // x_g = R^rotation[h] x_f + t, in 0..3; 0 on the
                                           // boundary
  std::vector<int> cone;                   // per vertex: total angle in quarter turns
  std::vector<double> size;                // per vertex: wanted edge length of the quads
  int repairs = 0;                         // rung of the repair ladder that gave the map, 0: none

  // the translation t in x_g = R^rotation[h] x_f + t
  // \pre `h` is not a border halfedge
  Fixed_point_2 translation(int h) const
  {
    const int o = mesh.opposite[h];
    return minus(coordinates[Working_mesh::next(o)], rotate(rotation[h], coordinates[h]));
  }
};

// The developed difference of the coordinates of two critical vertices is prescribed.
struct Integer_constraint
{
  int from_corner;               // corner 3 * f + i at the critical vertex a
  int to_corner;                 // corner 3 * g + j at the critical vertex b
  std::vector<int> path;         // halfedges crossed on the way from f to g
  std::array<int, 2> difference; // x_f(b) - x_f(a) in quads, with b developed along the path
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_MAP_SEAMLESS_MAP_H
