// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_LARGE_CORNERS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_LARGE_CORNERS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/format_number.h>

#include <CGAL/number_type_config.h>
#include <CGAL/number_utils.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Warns of the corners of the boundary with an interior angle above a full turn. The surface has at
// most two quads at a corner (paper, Fig. 6(b)). Each of them is regular only if the angle between
// its two derivatives there is below a straight one, hence two of them fill less than a full turn.
//
// `Network`: a `Boundary_curve_network_3` of the mesh
template <typename TriangleMesh, typename VertexPointMap, typename Network>
void warn_about_large_corners(const TriangleMesh& tm, const VertexPointMap& vpm,
                              const Network& network, Conversion_report& report)
{
  for(const auto v : vertices(tm))
  {
    if(!network.is_corner(v))
      continue;
    const double degrees = CGAL::to_double(network.corner_angle(v)) * 180 / CGAL_PI;
    if(!(degrees >= 360))
      continue;
    const auto& p = get(vpm, v);
    report.warnings.push_back("the interior angle of the corner at ("
      + format_number(CGAL::to_double(p.x())) + ", " + format_number(CGAL::to_double(p.y())) + ", "
      + format_number(CGAL::to_double(p.z())) + ") is " + format_number(degrees) + " degrees: two "
      "quads cannot fill it, and next to the corner the surface is folded over, within the tolerances");
  }
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_LARGE_CORNERS_H
