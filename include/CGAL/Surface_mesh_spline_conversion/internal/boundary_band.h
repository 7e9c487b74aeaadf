// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_BOUNDARY_BAND_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_BOUNDARY_BAND_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <cstddef>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Returns the width of the band along the boundary of a mesh: only there a surface may leave the
// mesh, which has chords, for the curves of the boundary. An edge between two faces counts twice.
// The lengths are not those of Polygon_mesh_processing: its header cannot be read after one of Open
// CASCADE, which has a macro Handle.
template <typename TriangleMesh, typename VertexPointMap>
double boundary_band_width(const TriangleMesh& tm, const VertexPointMap& vpm)
{
  constexpr double MEAN_EDGES = 3;
  double sum = 0;
  std::size_t number_of_edges = 0;
  for(auto f : faces(tm))
    for(auto h : halfedges_around_face(halfedge(f, tm), tm))
    {
      sum += (to_eigen(get(vpm, target(h, tm))) - to_eigen(get(vpm, source(h, tm)))).norm();
      ++number_of_edges;
    }
  return MEAN_EDGES * sum / double(number_of_edges);
}

// returns the width given as named parameter, or that of the mesh.
template <typename NamedParameters, typename TriangleMesh, typename VertexPointMap>
double boundary_band_width(const NamedParameters& np, const TriangleMesh& tm,
                           const VertexPointMap& vpm)
{
  constexpr double UNKNOWN = -1;
  const double width = CGAL::to_double(parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::boundary_band), UNKNOWN));
  return width == UNKNOWN ? boundary_band_width(tm, vpm) : width;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_BOUNDARY_BAND_H
