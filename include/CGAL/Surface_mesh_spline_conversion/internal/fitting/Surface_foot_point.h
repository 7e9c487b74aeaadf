// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SURFACE_FOOT_POINT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SURFACE_FOOT_POINT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Bezier_patches.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <Eigen/Core>
#include <Eigen/LU>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Finds the point of the surface closest to a point of the target, by Gauss-Newton steps in the
// local coordinates of the quads.
template <typename Surface, typename Layout, typename Place>
class Surface_foot_point
{
  typedef decltype(Place::u) FT;
  typedef typename Bezier_patches<Surface>::Point_and_tangents Point_and_tangents;

public:
  Surface_foot_point(const Bezier_patches<Surface>& patches, const Layout& layout,
                     const Eigen::Vector3d& query, const Place& place)
    : m_patches(patches), m_surface(patches.surface()), m_layout(layout), m_query(query),
      m_place(place), m_at_place(evaluate(place))
  {}

  const Eigen::Vector3d& operator()()
  {
    constexpr int maximum_number_of_steps = 6;
    if(!improve(m_place, m_at_place) && !improve_from_inside())
      return m_at_place.point;
    for(int step = 1; step < maximum_number_of_steps && improve(m_place, m_at_place); ++step)
      continue;
    return m_at_place.point;
  }

  // returns where the point found lies
  const Place& place() const { return m_place; }

private:
  // steps that gain less than this share of the distance are not worth while
  static constexpr double smallest_gain = 1e-3;

  Point_and_tangents evaluate(const Place& p) const
  {
    return m_patches.point_and_tangents(p.patch, p.u, p.v);
  }

  // At an extraordinary point the parametrization has no regular derivative; a place a little
  // inside of its patch has.
  bool improve_from_inside()
  {
    constexpr double share = 1. / 16;
    Place p = m_place;
    const auto o = m_surface.patch_origin(p.patch);
    p.u += FT(share) * ((o.u0 + o.u1) / FT(2) - p.u);
    p.v += FT(share) * ((o.v0 + o.v1) / FT(2) - p.v);
    return improve(p, evaluate(p));
  }

  // A step from `start`; halved twice if it does not decrease the distance. Returns `false` if
  // another step would gain little.
  bool improve(const Place& start, const Point_and_tangents& at_start)
  {
    constexpr double largest_step = 0.25; // in quads
    const Eigen::Vector3d difference = m_query - at_start.point;
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << at_start.u, at_start.v;
    const Eigen::Matrix2d gram = tangents.transpose() * tangents;
    if(!(gram.determinant() > 0))
      return false;
    const Eigen::Vector2d tangential = tangents.transpose() * difference;
    Eigen::Vector2d step = gram.inverse() * tangential;
    if(!step.allFinite())
      return false;
    // the step removes this part of the squared distance, if the surface is flat
    if(step.dot(tangential) < 2 * smallest_gain * difference.squaredNorm())
      return false;
    step = step.cwiseMax(-largest_step).cwiseMin(largest_step);
    return move(start, step) || move(start, step / 2) || move(start, step / 4);
  }

  bool move(const Place& start, const Eigen::Vector2d& step)
  {
    const Quad_point<FT> q = cross_sides(
      m_layout, Quad_point<FT>{start.quad, start.u + FT(step[0]), start.v + FT(step[1])});
    const Place next{m_surface.patch_at(q.quad, q.u, q.v), q.quad, q.u, q.v};
    const Point_and_tangents at_next = evaluate(next);
    const double before = (m_at_place.point - m_query).norm();
    const double after = (at_next.point - m_query).norm();
    if(!(after < before))
      return false;
    m_at_place = at_next;
    m_place = next;
    return after < (1 - smallest_gain) * before;
  }

  const Bezier_patches<Surface>& m_patches;
  const Surface& m_surface;
  const Layout& m_layout;
  const Eigen::Vector3d& m_query;
  Place m_place;
  Point_and_tangents m_at_place;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_SURFACE_FOOT_POINT_H
