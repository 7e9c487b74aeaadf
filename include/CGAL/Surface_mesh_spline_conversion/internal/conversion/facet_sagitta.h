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
#include <CGAL/Surface_mesh_spline_conversion/internal/edge_turn.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/format_number.h>

#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Returns the largest sagitta of the facets of a mesh.
template <typename TriangleMesh, typename VertexPointMap>
double facet_sagitta(const TriangleMesh& tm, const VertexPointMap& vpm)
{
  double result = 0;
  for(const auto e : edges(tm))
    result = (std::max)(result, edge_turn(halfedge(e, tm), tm, vpm).sagitta);
  return result;
}

// Warns if a surface keeps the interior tolerance to a smooth target, but not to the mesh.
inline void warn_about_smooth_target(double tolerance, Conversion_report& report)
{
  if(report.interior.max_deviation > tolerance)
    report.warnings.push_back("the interior tolerance " + format_number(tolerance)
      + " is that of the smooth target, which is up to " + format_number(report.interior.target_height)
      + " away from the mesh: the surface is within " + format_number(report.interior.target_deviation)
      + " of the target, and within " + format_number(report.interior.max_deviation) + " of the mesh");
}

// Warns if the interior tolerance is so small that the surface has to follow the facets, and tells
// how many patches that took: those added since the error was half the sagitta of the facets.
inline void warn_about_facets(double tolerance, Conversion_report& report)
{
  if(Conversion_report::is_measured(report.interior.target_height))
    return warn_about_smooth_target(tolerance, report);
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
    + std::to_string(report.counts.patches) + " patches were added for that; a smooth target "
    "(use_smooth_target, --smooth-target) avoids it");
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_FACET_SAGITTA_H
