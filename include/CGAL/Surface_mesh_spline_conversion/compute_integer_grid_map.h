// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_COMPUTE_INTEGER_GRID_MAP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_COMPUTE_INTEGER_GRID_MAP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Integer_grid_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Integer_grid_map_builder.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/compute_seamless_map.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

namespace internal {

// See below. A map that is not valid leads to at most so many repairs of the field.
inline Error_code compute_integer_grid_map(const Cross_field& field, int most_repairs,
                                           const Work_budget& budget, Integer_grid_map& map)
{
  map = Integer_grid_map();
  map.proxy = field.proxy;
  Seamless_map seamless;
  const Error_code code = compute_seamless_map(field, seamless, most_repairs, budget);
  if(code != Error_code::OK)
  {
    map.message = error_message(code);
    return code;
  }
  return Integer_grid_map_builder(map, budget).build(seamless) ? Error_code::OK
                                                               : Error_code::NO_QUAD_LAYOUT;
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

computes an integer grid map that follows a cross field.

First, a seamless map is computed, which is locally injective and exact. Its motorcycle graph, the
isolines through singularities and corners up to where they meet each other, divides the mesh into
rectangles. The sides of these get integer lengths near the real ones, such that no singularities,
corners or boundary loops fall together and every boundary loop has at least four sides. Last, the
map is solved again with these lengths, or with those for smaller quads where it cannot.

\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param field the cross field
\param map the result; if there is none, `map.message` says why
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters"; there are none so far

\return `Error_code::OK`, `Error_code::NO_SEAMLESS_MAP`, `Error_code::SINGULAR_SYSTEM`, or
        `Error_code::NO_QUAD_LAYOUT`.

\sa `compute_cross_field()`
\sa `extract_quad_layout()`
*/
template <typename NamedParameters = parameters::Default_named_parameters>
Error_code compute_integer_grid_map(const Cross_field& field, Integer_grid_map& map,
                                    const NamedParameters& np = parameters::default_values())
{
  CGAL_USE(np);
  return internal::compute_integer_grid_map(field, internal::number_of_rungs,
                                            internal::Work_budget(), map);
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_COMPUTE_INTEGER_GRID_MAP_H
