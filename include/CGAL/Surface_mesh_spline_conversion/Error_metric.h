// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_ERROR_METRIC_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_ERROR_METRIC_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is how `fit_boundary()` and `fit_interior()` measure the distance between the surface and its
target.
*/
enum class Error_metric
{
  /// between points with equal parameters, as in the paper; the parametrization of the mesh is
  /// approximated along with its shape
  PARAMETRIC,

  /// between each sample and the closest point on the other side; the surface is fitted twice per
  /// refinement level, the second time to the closest points of the first fit
  REPROJECTED,

  /// as `REPROJECTED`, with more fits to closest points per level: fewest patches, longest time
  HAUSDORFF
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_ERROR_METRIC_H
