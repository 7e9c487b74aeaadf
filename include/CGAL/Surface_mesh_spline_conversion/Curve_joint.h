// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_CURVE_JOINT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_CURVE_JOINT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is a place on a boundary chain where a curve ends and another begins, or where the curvature jumps,
but the tangents agree; the seam of a closed curve is one, too.
*/
template <typename FT>
struct Curve_joint
{
  std::size_t edge;   ///< index in the chain of the edge that begins at the joint
  FT arc_length;      ///< arc length of the joint
  int continuity;     ///< 2 if also the curvature vectors agree, else 1
  FT turning_angle;   ///< angle between the tangents, in radians, at most the corner angle
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_CURVE_JOINT_H
