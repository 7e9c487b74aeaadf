// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_CONVERSION_OPTIONS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_CONVERSION_OPTIONS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_metric.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/format_number.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// What the user may choose, in model units.
struct Conversion_options
{
  double boundary_tolerance;
  double interior_tolerance;
  double corner_angle; // in degrees
  Error_metric error_metric;
  std::size_t maximum_number_of_patches;
  bool do_coarsen;
  bool do_fair;
  bool do_certify;
  bool use_smooth_target;
  bool use_caps;
};

// the normals beyond the boundary that the user gave, or an empty function
template <typename BoundaryCurveTraits>
using Normal_function
  = std::function<typename BoundaryCurveTraits::Vector_3(
      const typename BoundaryCurveTraits::Curve_3&, const typename BoundaryCurveTraits::FT&)>;

template <typename BoundaryCurveTraits, typename Normal>
Normal_function<BoundaryCurveTraits> normal_function(const Normal& normal)
{
  if constexpr(std::is_same<Normal, internal_np::Param_not_found>::value)
    return Normal_function<BoundaryCurveTraits>();
  else
    return normal;
}

inline Error_code fail(Error_code code, const std::string& message, Conversion_report& report)
{
  report.status = code;
  report.message = message;
  return code;
}

template <typename NamedParameters>
double corner_angle_or_default(const NamedParameters& np)
{
  const double default_corner_angle = 0.5;
  return CGAL::to_double(parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::corner_angle), default_corner_angle));
}

// reads the tolerances; one that cannot be met by any surface is an error of the report.
template <typename NamedParameters>
Conversion_options conversion_options(const NamedParameters& np, double diameter,
                                      double corner_angle, Conversion_report& report)
{
  using parameters::choose_parameter;
  using parameters::get_parameter;

  Conversion_options options;
  options.boundary_tolerance
    = CGAL::to_double(choose_parameter(get_parameter(np, internal_np::boundary_tolerance),
                                       default_relative_boundary_tolerance * diameter));
  options.interior_tolerance
    = CGAL::to_double(choose_parameter(get_parameter(np, internal_np::interior_tolerance),
                                       default_relative_interior_tolerance * diameter));
  options.corner_angle = corner_angle;
  options.error_metric = choose_parameter(get_parameter(np, internal_np::error_metric),
                                          Error_metric::REPROJECTED);
  options.maximum_number_of_patches = maximum_number_of_patches(np);
  options.do_coarsen = do_coarsen(np);
  options.do_fair
    = choose_parameter(get_parameter(np, internal_np::do_fair_interior), false);
  options.do_certify
    = choose_parameter(get_parameter(np, internal_np::do_certify_interior), false);
  options.use_smooth_target
    = choose_parameter(get_parameter(np, internal_np::use_smooth_target), false);
  options.use_caps = choose_parameter(get_parameter(np, internal_np::use_caps), false);
  report.boundary_tolerance = options.boundary_tolerance;
  report.interior_tolerance = options.interior_tolerance;
  for(const std::string& defect
      : {tolerance_defect("boundary", options.boundary_tolerance, diameter),
         tolerance_defect("interior", options.interior_tolerance, diameter)})
    if(!defect.empty())
      fail(Error_code::INVALID_PARAMETER, defect, report);
  return options;
}

template <typename TriangleMesh, typename VertexPointMap>
double mean_edge_length(const TriangleMesh& tm, const VertexPointMap& vpm)
{
  double sum = 0;
  for(const auto h : halfedges(tm))
    sum += std::sqrt(CGAL::to_double(
      (get(vpm, target(h, tm)) - get(vpm, source(h, tm))).squared_length()));
  return sum / double(num_halfedges(tm));
}

// not that of Polygon_mesh_processing, see boundary_band_width()
template <typename TriangleMesh, typename VertexPointMap>
double surface_area(const TriangleMesh& tm, const VertexPointMap& vpm)
{
  double sum = 0;
  for(const auto f : faces(tm))
  {
    const auto h = halfedge(f, tm);
    const auto& p = get(vpm, source(h, tm));
    const auto& q = get(vpm, target(h, tm));
    sum += std::sqrt(CGAL::to_double(
      CGAL::squared_area(p, q, get(vpm, target(next(h, tm), tm)))));
  }
  return sum;
}

// below one mean edge a quad would copy the facets
template <typename TriangleMesh, typename VertexPointMap>
void check_quad_size(double size, const TriangleMesh& tm, const VertexPointMap& vpm,
                     Conversion_report& report)
{
  report.quad_size = size;
  if(size > 0 && surface_area(tm, vpm) > largest_number_of_quads * size * size)
    fail(Error_code::INVALID_PARAMETER, "the quad size " + format_number(size)
         + " would give more than a million quads", report);
  if(size < mean_edge_length(tm, vpm))
    report.warnings.push_back("the quad size is below the mean edge length of the mesh: the surface "
                              "may copy the facets");
}

// the size that the user gave as a number or map, or the default
template <typename TriangleMesh, typename VertexPointMap, typename Size>
auto quad_size_map(const TriangleMesh& tm, const VertexPointMap& vpm, double diameter,
                   const Size& size, Conversion_report& report)
{
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  if constexpr(std::is_arithmetic<Size>::value)
  {
    // no quad is larger than the mesh, and shares of this size are tried, too
    const double used = (std::min)(double(size), diameter);
    check_quad_size(used, tm, vpm, report);
    return Constant_property_map<vertex_descriptor, double>(used);
  }
  else if constexpr(std::is_invocable<const Size&, vertex_descriptor>::value)
    return boost::make_function_property_map<vertex_descriptor>(size);
  else
    return size;
}

template <typename TriangleMesh, typename VertexPointMap>
auto quad_size_map(const TriangleMesh& tm, const VertexPointMap& vpm, double diameter,
                   internal_np::Param_not_found, Conversion_report& report)
{
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  const double quads_per_diameter = 40, edges_per_quad = 2;
  report.quad_size = (std::max)(diameter / quads_per_diameter,
                                edges_per_quad * mean_edge_length(tm, vpm));
  return Constant_property_map<vertex_descriptor, double>(report.quad_size);
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CONVERSION_CONVERSION_OPTIONS_H
