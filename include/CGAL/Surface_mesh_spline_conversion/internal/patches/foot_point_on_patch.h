// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_FOOT_POINT_ON_PATCH_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_FOOT_POINT_ON_PATCH_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>

#include <CGAL/number_utils.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Finds the point of the patches closest to a given point, by Gauss-Newton steps in the local
// coordinates of the quads. The patches are only continuous, hence tangents are difference
// quotients, and a step that does not decrease the distance is halved and then given up. Where
// this ends at a kink, which the remaining tangential distance shows, a pattern search goes on.
template <typename Target>
class Patch_foot_point
{
  typedef typename Target::FT FT;
  typedef typename Target::Point_3 Point_3;
  typedef typename Target::Vector_3 Vector_3;
  typedef Quad_point<FT> Place;

public:
  Patch_foot_point(const Target& target, const Point_3& query, const Place& start)
    : m_target(target), m_query(query), m_place(start),
      m_point(target.point(start.quad, start.u, start.v)),
      m_squared_distance(squared_distance(m_point, query))
  {}

  Point_3 operator()()
  {
    constexpr int maximum_number_of_steps = 3;
    for(int step = 0; step < maximum_number_of_steps; ++step)
      if(!improve())
        break;
    if(!m_is_orthogonal)
      search();
    return m_point;
  }

private:
  // width of the difference quotients, in quads
  static FT width() { return FT(1. / 64); }

  // a step stays within a quarter of a quad, as elsewhere
  static FT largest_step() { return FT(0.25); }

  bool improve()
  {
    const FT du = m_place.u > FT(0.5) ? -width() : width();
    const FT dv = m_place.v > FT(0.5) ? -width() : width();
    const Vector_3 a
      = (m_target.point(m_place.quad, m_place.u + du, m_place.v) - m_point) / du;
    const Vector_3 b
      = (m_target.point(m_place.quad, m_place.u, m_place.v + dv) - m_point) / dv;
    const Vector_3 r = m_query - m_point;
    const FT aa = a * a, ab = a * b, bb = b * b, determinant = aa * bb - ab * ab;
    if(!(determinant > FT(0)))
      return false;
    m_is_orthogonal = is_small(a * r, aa * (r * r)) && is_small(b * r, bb * (r * r));
    if(m_is_orthogonal)
      return false;
    const FT u = clamped((bb * (a * r) - ab * (b * r)) / determinant);
    const FT v = clamped((aa * (b * r) - ab * (a * r)) / determinant);
    return move(u, v) || move(u / FT(2), v / FT(2));
  }

  // compares the cosine of the angle between tangent and difference with 0.1: the distance is then
  // within one percent of that to the tangent plane
  static bool is_small(const FT& product, const FT& squared_lengths)
  {
    return product * product <= FT(0.01) * squared_lengths;
  }

  void search()
  {
    const FT first_step(1. / 32), last_step(1. / 256);
    for(FT step = first_step; step >= last_step; )
      if(!move(step, FT(0)) && !move(-step, FT(0)) && !move(FT(0), step) && !move(FT(0), -step))
        step /= FT(2);
  }

  static FT clamped(const FT& x)
  {
    return x > largest_step() ? largest_step() : (x < -largest_step() ? -largest_step() : x);
  }

  bool move(const FT& du, const FT& dv)
  {
    const Place place
      = cross_sides(m_target.layout(), Place{m_place.quad, m_place.u + du, m_place.v + dv});
    const Point_3 p = m_target.point(place.quad, place.u, place.v);
    const FT d = squared_distance(p, m_query);
    if(!(d < m_squared_distance))
      return false;
    m_place = place;
    m_point = p;
    m_squared_distance = d;
    return true;
  }

  const Target& m_target;
  const Point_3& m_query;
  Place m_place;
  Point_3 m_point;
  FT m_squared_distance;
  bool m_is_orthogonal = false;
};

template <typename Target>
typename Target::Point_3
foot_point_on_patch(const Target& target, const typename Target::Point_3& query, std::size_t quad,
                    const typename Target::FT& u, const typename Target::FT& v)
{
  return Patch_foot_point<Target>(target, query,
                                  Quad_point<typename Target::FT>{quad, u, v})();
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_PATCHES_FOOT_POINT_ON_PATCH_H
