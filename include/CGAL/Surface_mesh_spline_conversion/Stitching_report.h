// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_STITCHING_REPORT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_STITCHING_REPORT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <cstddef>
#include <limits>
#include <string>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

holds the figures of stitching a shell with the B-Rep that it bounds. Lengths are in millimetres,
the unit of Open CASCADE.

An edge is *free* if only one face uses it. The *tolerance* of an edge bounds its distance from the
faces that use it, at equal parameter; that of a vertex bounds its distance from the ends of edges.

\sa `stitch_with_BRep()`
*/
struct Stitching_report
{
  typedef std::size_t size_type;

  std::string method = "none";     ///< `"shared edges"`, `"sewing"`, or `"none"`
  size_type solids = 0;            ///< number of solids
  size_type shells = 0;            ///< number of shells
  size_type faces = 0;             ///< number of faces
  size_type edges = 0;             ///< number of edges
  size_type vertices = 0;          ///< number of vertices
  size_type free_edges = 0;        ///< edges of one face
  size_type unmatched_edges = 0;   ///< pieces of boundary edges of the shell without partner
  size_type multiple_edges = 0;    ///< edges of more than two faces
  bool is_valid = false;           ///< does the checker of Open CASCADE find no defect?
  double edge_distance = 0;        ///< largest distance of joined edges before they were joined
  double edge_deviation = 0;       ///< largest measured distance of an edge from its faces
  double edge_tolerance = 0;       ///< largest tolerance of an edge
  double vertex_tolerance = 0;     ///< largest tolerance of a vertex
  double residual_tolerance = 0;   ///< largest tolerance of edges and vertices that the B-Rep had
  /// volume of the solids in cubic millimetres; a quiet NaN if there is none
  double volume = std::numeric_limits<double>::quiet_NaN();
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_STITCHING_REPORT_H
