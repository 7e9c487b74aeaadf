// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_FACET_SAGITTA_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_FACET_SAGITTA_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/format_number.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/boost/graph/iterator.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Returns the largest sagitta of the facets of a mesh: the distance between a facet and the arc that
// turns as much as the mesh does at one of its edges. With the heights h1 and h2 of both faces over
// the edge and the angle a between their normals, the arc has the curvature 2 a / (h1 + h2), and its
// chord the length h1 or h2.
template <typename TriangleMesh, typename VertexPointMap>
double facet_sagitta(const TriangleMesh& tm, const VertexPointMap& vpm)
{
  double result = 0;
  for(const auto e : edges(tm))
  {
    const auto h = halfedge(e, tm), o = opposite(h, tm);
    if(is_border(h, tm) || is_border(o, tm))
      continue;
    const Eigen::Vector3d p = to_eigen(get(vpm, source(h, tm)));
    const Eigen::Vector3d edge = to_eigen(get(vpm, target(h, tm))) - p;
    const auto normal = [&](const auto& g, double sign)
    {
      const Eigen::Vector3d apex = to_eigen(get(vpm, target(next(g, tm), tm))) - p;
      return Eigen::Vector3d(sign * edge.cross(apex));
    };
    const Eigen::Vector3d n1 = normal(h, 1), n2 = normal(o, -1);
    const double angle = std::atan2(n1.cross(n2).norm(), n1.dot(n2));
    const double h1 = n1.norm() / edge.norm(), h2 = n2.norm() / edge.norm();
    if(h1 + h2 > 0)
      result = (std::max)(result, angle * std::pow((std::max)(h1, h2), 2) / (4 * (h1 + h2)));
  }
  return result;
}

// Warns if the interior tolerance is so small that the surface has to follow the facets, and tells how
// many patches that took: those added since the error was half the sagitta of the facets.
inline void warn_about_facets(double tolerance, Conversion_report& report)
{
  const double half_sagitta = report.input.facet_sagitta / 2;
  if(!(tolerance < half_sagitta))
    return;
  std::size_t before = report.counts.patches;
  for(const Conversion_report::Iteration& iteration : report.iterations)
    if(iteration.interior_linf < half_sagitta)
    {
      before = (std::min)(before, iteration.patches);
      break;
    }
  report.warnings.push_back("the interior tolerance " + format_number(tolerance)
    + " is below half the sagitta of the facets of the mesh, " + format_number(half_sagitta)
    + ": the surface follows the facets; " + std::to_string(report.counts.patches - before) + " of "
    + std::to_string(report.counts.patches) + " patches were added for that");
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_FACET_SAGITTA_H
