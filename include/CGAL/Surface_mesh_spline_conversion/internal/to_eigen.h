// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_TO_EIGEN_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_TO_EIGEN_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// returns the coordinates of a point or vector
template <typename Triple>
Eigen::Vector3d to_eigen(const Triple& p)
{
  return Eigen::Vector3d(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_TO_EIGEN_H
