// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_PLANAR_TRIANGLE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_PLANAR_TRIANGLE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A triangle in a frame of its plane, in which closest points are found with few operations: the
// first axis runs along the longest side, from corner 0 on, and corner 2 lies in the upper half
// plane.
class Planar_triangle
{
public:
  typedef Simple_cartesian<double>::Point_3 Point_3;
  typedef Simple_cartesian<double>::Vector_3 Vector_3;

  explicit Planar_triangle(const std::array<Point_3, 3>& corners)
  {
    std::size_t first = 0;
    for(std::size_t i = 1; i < 3; ++i)
      if(side(corners, i).squared_length() > side(corners, first).squared_length())
        first = i;
    const Vector_3 base = side(corners, first);
    m_origin = corners[first];
    m_u = unit(base);
    m_width = base * m_u;
    const Vector_3 apex = corners[(first + 2) % 3] - m_origin;
    m_x = (std::min)((std::max)(apex * m_u, 0.), m_width);
    m_v = unit(apex - (apex * m_u) * m_u);
    m_height = apex * m_v;
    m_normal = CGAL::cross_product(m_u, m_v);
  }

  // returns the squared distance of `p` from the plane, or zero if the triangle has no area
  double squared_distance_of_plane(const Point_3& p) const
  {
    const double height = (p - m_origin) * m_normal;
    return height * height;
  }

  // returns the point of the triangle that is closest to `p`
  Point_3 closest_point(const Point_3& p) const
  {
    const Vector_3 d = p - m_origin;
    const Planar_point q = closest_point(Planar_point{d * m_u, d * m_v});
    return m_origin + q.x * m_u + q.y * m_v;
  }

private:
  // in the frame
  struct Planar_point
  {
    double x, y;
  };

  static Vector_3 side(const std::array<Point_3, 3>& corners, std::size_t i)
  {
    return corners[(i + 1) % 3] - corners[i];
  }

  static Vector_3 unit(const Vector_3& v)
  {
    const double length = std::sqrt(v.squared_length());
    return length > 0 ? v / length : NULL_VECTOR;
  }

  // The closest point of the boundary lies on a side beyond which `p` lies. All sides are tried if
  // the triangle has no area.
  Planar_point closest_point(const Planar_point& p) const
  {
    const std::array<Planar_point, 3> corners = {{{0, 0}, {m_width, 0}, {m_x, m_height}}};
    Planar_point result = p;
    double smallest = (std::numeric_limits<double>::infinity)();
    for(std::size_t i = 0; i < 3; ++i)
    {
      const Planar_point& a = corners[i];
      const Planar_point side = difference(corners[(i + 1) % 3], a), to_p = difference(p, a);
      if(side.x * to_p.y - side.y * to_p.x > 0)
        continue;
      const double length = side.x * side.x + side.y * side.y;
      const double share = length > 0 ? (side.x * to_p.x + side.y * to_p.y) / length : 0;
      const double t = (std::min)((std::max)(share, 0.), 1.);
      const Planar_point q = {a.x + t * side.x, a.y + t * side.y}, way = difference(q, p);
      const double distance = way.x * way.x + way.y * way.y;
      if(distance < smallest)
      {
        smallest = distance;
        result = q;
      }
    }
    return result;
  }

  static Planar_point difference(const Planar_point& p, const Planar_point& q)
  {
    return Planar_point{p.x - q.x, p.y - q.y};
  }

  Point_3 m_origin;
  Vector_3 m_u, m_v, m_normal;     // of length one, or zero if the triangle is degenerate
  double m_width, m_x, m_height; // corners 1 and 2 are (width, 0) and (x, height)
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_PLANAR_TRIANGLE_H
