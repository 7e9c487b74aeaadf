// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_SCALED_JACOBIAN_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_SCALED_JACOBIAN_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A normal of the flat quad with the given corners, of the length of twice its area.
inline Eigen::Vector3d quad_normal(const std::array<Eigen::Vector3d, 4>& p)
{
  return (p[2] - p[0]).cross(p[3] - p[1]);
}

// The smallest sine of the corner angles of a quad, seen along its normal; not positive if the quad
// is not convex, 0 where a side has no length, as of a quad that winds around a thin part.
inline double scaled_jacobian(const std::array<Eigen::Vector3d, 4>& p)
{
  const Eigen::Vector3d normal = quad_normal(p);
  double least = 1;
  for(int i = 0; i < 4; ++i)
  {
    const Eigen::Vector3d out = p[(i + 1) % 4] - p[i], in = p[(i + 3) % 4] - p[i];
    const double scale = out.norm() * in.norm() * normal.norm();
    least = (std::min)(least, scale > 0 ? out.cross(in).dot(normal) / scale : 0.);
  }
  return least;
}

// The scaled Jacobian of a quad of a surface with the given normal near its middle. If the quad
// does not face the same side: the cosine of its angle with the surface, if that is smaller.
inline double oriented_scaled_jacobian(const std::array<Eigen::Vector3d, 4>& p,
                                       const Eigen::Vector3d& outside)
{
  const double jacobian = scaled_jacobian(p);
  const double cosine = quad_normal(p).normalized().dot(outside.normalized());
  return cosine <= 0 ? (std::min)(jacobian, cosine) : jacobian;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_SCALED_JACOBIAN_H
