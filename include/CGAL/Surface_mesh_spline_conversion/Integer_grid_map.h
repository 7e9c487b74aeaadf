// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTEGER_GRID_MAP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTEGER_GRID_MAP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Seamless_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/proxy/Proxy_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/Motorcycle_graph.h>

#include <memory>
#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

is the result of `compute_integer_grid_map()`: a map from a triangle mesh to the parameter plane
whose integer grid, pulled back to the mesh, is a quad layout.

The map is exact: its coordinates are integers that count a small fraction of a quad. Mapped
triangles never overlap their neighbours, boundary edges are parallel to an axis, and across every
edge the map continues up to a turn by right angles and a translation.

A map whose quads can be found comes in two forms. Preferably (`is_resolved`), the map has been
solved again such that singularities, corners and translations are integers: the quads are the unit
cells of the map, and the map is as smooth as possible. Where this fails, the map stays as it is,
and the quads are found by dividing each rectangle of its motorcycle graph into a grid, which needs
no solver: the quads then have kinks where the rectangles meet.

\sa `extract_quad_layout()`
*/
struct Integer_grid_map
{
  internal::Seamless_map map;   ///< the map
  std::shared_ptr<const internal::Proxy_mesh> proxy; ///< what stands for the input, or nothing
  bool is_resolved = false;     ///< `true` if singularities, corners and translations are integers
  internal::Motorcycle_graph graph;      ///< the motorcycle graph of the map before the re-solve
  std::vector<int> lengths;     ///< per arc of the motorcycle graph: its length in quads
  int number_of_quads = 0;      ///< number of quads of the layout
  double parameter_area = 0;    ///< number of quads if all had the wanted size
  std::string message;          ///< says what failed, or why the map has not been solved again
};

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTEGER_GRID_MAP_H
