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
#include <CGAL/Surface_mesh_spline_conversion/extract_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Layout_ladder.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/Padded_triangulation.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/make_working_mesh.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/run_stage.h>
#include <CGAL/Surface_mesh_spline_conversion/measure_layout_quality.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <string>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

namespace internal {

// The layout of last resort, which every mesh has: see `Padded_triangulation`.
template <typename TriangleMesh, typename BoundaryCurveNetwork, typename GeomTraits,
          typename NamedParameters>
Error_code compute_padded_layout(const TriangleMesh& tm, const BoundaryCurveNetwork& network,
                                 Quad_layout<GeomTraits>& layout, const NamedParameters& np)
{
  const auto vpm = parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::vertex_point),
    get_const_property_map(vertex_point, tm));
  Working_mesh mesh;
  std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> vertex;
  const Error_code code = make_working_mesh(tm, network, vpm, mesh, vertex);
  if(code != Error_code::OK)
    return code;
  if(!make_simplicial(mesh))
    return Error_code::NO_QUAD_LAYOUT;
  split_ears(mesh);
  std::vector<double> size;
  if(!compute_quad_sizes(mesh, vertex, parameters::get_parameter(np, internal_np::quad_size_map),
                         CGAL::to_double(network.diameter()), size))
    return Error_code::INVALID_PARAMETER;
  set_layout(Padded_triangulation(mesh, size), mesh, face_corners(tm, vpm), layout);
  return Error_code::OK;
}

// the quads of an integer grid map
template <typename TriangleMesh, typename BoundaryCurveNetwork, typename GeomTraits,
          typename Visitor, typename NamedParameters>
Error_code compute_mapped_layout(const TriangleMesh& tm, const BoundaryCurveNetwork& network,
                                 Quad_layout<GeomTraits>& layout, Conversion_report& report,
                                 Visitor& visitor, const NamedParameters& np)
{
  return Layout_ladder<TriangleMesh, BoundaryCurveNetwork, GeomTraits, Visitor, NamedParameters>(
    tm, network, layout, report, visitor, np).run();
}

} // namespace internal

/*!
\ingroup PkgSurfaceMeshSplineConversionRef

computes a quad layout of a triangle mesh: a cross field, an integer grid map that follows it, and
the quads of this map.

Where the map fails, singularities are moved, and quads that are larger than the features of the
shape are given singularities at smaller distances. Where the projection from a proxy turns out to
have folds, finer proxies are tried; then the mesh itself in place of a proxy, or the other way
round. The mesh itself comes before finer proxies if it has fewer faces than its proxy. Where there
still is no map, singularities of more than four quads that are near each other meet at one vertex
of the mesh itself: thin parts beside corners may have no room for single ones. Where there are more
than twice the quads that size, loops and handles need, smaller distances of the singularities are
tried as well, and the layout with the fewest quads is kept. Where quads of the layout are inverted
when they are drawn flat, smaller ones are tried around them, and around those that are inverted
then; the layout with the fewest of them is kept. Where less than fifty quads are wanted, but there
are at least fifty, and more than twice as many as wanted, strips of quads that share opposite sides
collapse, unless quads are nearly inverted or parts of the mesh squeezed then. Where there were too
many quads, singularities of more than four quads that are closer to each other than a quad are then
joined, to at most eight quads at one vertex; the layout with the fewest quads is kept, unless some
are inverted. If there are at least fifty quads even then, single quads away from the boundary
collapse as well: two opposite vertices of them meet. The work of all this is counted, and ends in
proportion to the numbers of triangles and of wanted quads. What cannot fail comes last, if there is
no map: the mesh is coarsened, a ring of quads is laid along each boundary loop, and each triangle in
between is divided into three quads. Such a layout is valid, but has many extraordinary points; its
corners are regular vertices even where the boundary is convex.
`Conversion_report::Map::fallback` says which of these was needed.

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

\return `Error_code::OK`, the error of the network if it has one, `Error_code::INVALID_PARAMETER`,
        `Error_code::INTERRUPTED`, or what is wrong with the mesh

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
  const std::string message = report.message;
  Error_code code = internal::compute_mapped_layout(tm, network, layout, report, visitor, np);
  if(internal::has_no_map(code))
  {
    const std::string reason = report.message;
    report.message = message;
    code = internal::run_stage("padded_layout", visitor, report, [&]()
      { return internal::compute_padded_layout(tm, network, layout, np); });
    if(code == Error_code::OK)
      report.map.fallback = "divided triangles: " + reason;
  }
  report.counts.layout_quads = layout.number_of_quads();
  if(code == Error_code::OK)
    measure_layout_quality(layout, tm, report.map, np);
  return code;
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_COMPUTE_QUAD_LAYOUT_H
