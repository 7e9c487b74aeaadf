// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_COMPUTE_QUAD_LAYOUT_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_COMPUTE_QUAD_LAYOUT_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Default_visitor.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_integer_grid_map.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/run_stage.h>
#include <CGAL/Surface_mesh_spline_conversion/measure_layout_quality.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

computes a quad layout of a triangle mesh: a cross field, an integer grid map that follows it, and
the quads of this map.

\tparam TriangleMesh a model of `HalfedgeListGraph` and `FaceListGraph`
\tparam BoundaryCurveNetwork an instance of `Boundary_curve_network_3`
\tparam GeomTraits a model of `Kernel`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param tm a triangle mesh with one connected component
\param network the curves at the boundary of `tm`
\param layout the result
\param report receives the times of the stages, the number of quads and their quality, the fallback
              that was needed, and a message if there is no layout
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters": those of
       `compute_cross_field()`, and

\cgalNamedParamsBegin
  \cgalParamNBegin{visitor}
    \cgalParamDescription{an object that is told of each stage, and may interrupt}
    \cgalParamType{a class model of `SplineConversionVisitor`}
    \cgalParamDefault{`Default_visitor`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return `Error_code::OK`, or that of the stage that failed

\pre `network` has been created from `tm`

\sa `compute_cross_field()`
\sa `compute_integer_grid_map()`
\sa `extract_quad_layout()`
\sa `measure_layout_quality()`
*/
template <typename TriangleMesh, typename BoundaryCurveNetwork, typename GeomTraits,
          typename NamedParameters = parameters::Default_named_parameters>
Error_code compute_quad_layout(const TriangleMesh& tm, const BoundaryCurveNetwork& network,
                               Quad_layout<GeomTraits>& layout, Conversion_report& report,
                               const NamedParameters& np = parameters::default_values())
{
  typedef internal_np::Lookup_named_param_def<internal_np::visitor_t, NamedParameters,
                                              Default_visitor> Lookup_visitor;

  Default_visitor default_visitor;
  typename Lookup_visitor::reference visitor = parameters::choose_parameter(
    parameters::get_parameter_reference(np, internal_np::visitor), default_visitor);
  Cross_field field;
  Integer_grid_map map;
  Error_code code = internal::run_stage("cross_field", visitor, report, [&]()
    { return compute_cross_field(tm, network, field, np); });
  if(code == Error_code::OK)
    code = internal::run_stage("integer_grid_map", visitor, report, [&]()
      { return compute_integer_grid_map(field, map, np); });
  if(code != Error_code::OK && !map.message.empty())
    report.message = map.message;
  else if(code == Error_code::OK && !map.is_resolved)
    report.map.fallback = "rectangle composition: " + map.message;
  if(code == Error_code::OK)
    code = internal::run_stage("quad_layout", visitor, report, [&]()
      { return extract_quad_layout(map, tm, network, layout, np); });
  report.counts.layout_quads = layout.number_of_quads();
  if(code == Error_code::OK)
    measure_layout_quality(layout, tm, report.map, np);
  return code;
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_COMPUTE_QUAD_LAYOUT_H
