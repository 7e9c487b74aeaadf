// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_CONVERT_TO_T_NURCC_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_CONVERT_TO_T_NURCC_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Default_visitor.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_metric.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_curve_traits_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/conversion/Converter.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/conversion/conversion_options.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/T_NURCC_surface_3.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionFunctions

converts an open triangle mesh whose boundary lies on smooth curves to T-NURCC surfaces, one for
each connected component of the mesh.

The boundary of the surfaces meets the curves within the boundary tolerance \f$ \xi \f$ and the
corners of the boundary exactly; elsewhere the surfaces are closer to the mesh than the interior
tolerance \f$ \delta \f$. The method is that of Marinov, Amagliani and Charrot, *Boundary conforming
mesh to T-NURCC surface conversion*, Computers & Graphics 82 (2019).

\tparam TriangleMesh a model of `HalfedgeListGraph` and `FaceListGraph`
\tparam HalfedgeCurveMap a model of `ReadablePropertyMap` with
        `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` as key type and
        `Curve_segment<BoundaryCurveTraits>` as value type
\tparam BoundaryCurveTraits a model of `BoundaryCurveTraits_3` with the point type of the mesh
\tparam K a model of `Kernel` with the point type of the mesh; its number type is `double`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param tm a triangle mesh
\param halfedge_curve_map the curves at the boundary, see `Boundary_curve_network_3`
\param traits the traits of the curves
\param surfaces receives the surfaces in the order of the components. If a tolerance was not reached
       they are the best valid ones, after any other error it holds those of the components that
       were finished before.
\param report receives the figures of the conversion, and a message if something went wrong
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below. Lengths are in model units. *D* is `smallest_enclosing_sphere_diameter(tm)`.

\cgalNamedParamsBegin
  \cgalParamNBegin{boundary_tolerance}
    \cgalParamDescription{\f$ \xi \f$, the largest distance between the boundary of the surfaces and
                           the curves; at least `1e-14` *D*}
    \cgalParamType{a number type convertible to `double`}
    \cgalParamDefault{1e-6 *D*}
  \cgalParamNEnd
  \cgalParamNBegin{interior_tolerance}
    \cgalParamDescription{\f$ \delta \f$, the largest distance between the surfaces and the mesh; at
                           least `1e-14` *D*}
    \cgalParamType{a number type convertible to `double`}
    \cgalParamDefault{1e-3 *D*}
  \cgalParamNEnd
  \cgalParamNBegin{quad_size_map}
    \cgalParamDescription{the wanted edge length of the quads of the layout}
    \cgalParamType{a number, or a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and a number
                    type as value type, or a function object that returns a number for a vertex}
    \cgalParamDefault{the larger of *D* / 40 and twice the mean edge length of `tm`}
    \cgalParamExtra{Sizes that would give more than a million quads are refused. On a connected
                    component where the surface would be folded over, or too far from the mesh
                    although the fit is not, quads of 0.7 of this size are tried, then of 0.49 and
                    0.34 of it; a warning tells which.}
  \cgalParamNEnd
  \cgalParamNBegin{cross_field_map}
    \cgalParamDescription{a direction at each face that the quads should follow, see
                           `compute_cross_field()`}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%face_descriptor` as key type and
                    `%Vector_3` as value type}
    \cgalParamDefault{the zero vector everywhere: no wish}
  \cgalParamNEnd
  \cgalParamNBegin{corner_angle}
    \cgalParamDescription{a boundary vertex is a corner if the tangents of its two curves
                           enclose more than this angle, in degrees}
    \cgalParamType{a number between 0 and 180}
    \cgalParamDefault{0.5}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_is_constrained_map}
    \cgalParamDescription{the boundary vertices that are corners whatever the angle}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and `bool`
                    as value type}
    \cgalParamDefault{no vertex}
  \cgalParamNEnd
  \cgalParamNBegin{boundary_tangency}
    \cgalParamDescription{a functor that returns the unit normal of the neighboring face at a point
                           of a boundary curve; the surface becomes tangent to the face there. It
                           returns the null vector where the surface need not be tangent to a face.
                           The report tells the largest angle that remains. At a corner whose two
                           curves exclude the normal, the surface is tangent behind the first patch
                           only.}
    \cgalParamType{a class with the operator `Vector_3 operator()(const Curve_3& c, const FT& t) const`,
                    with the types of `BoundaryCurveTraits`, for instance the
                    `Construct_normal_on_curve_3` of `Curve_on_surface_traits_3`}
    \cgalParamDefault{no normals}
  \cgalParamNEnd
  \cgalParamNBegin{error_metric}
    \cgalParamDescription{how the distance between surface and mesh is measured during the fit}
    \cgalParamType{`Error_metric`}
    \cgalParamDefault{`Error_metric::REPROJECTED`}
  \cgalParamNEnd
  \cgalParamNBegin{do_coarsen_patches}
    \cgalParamDescription{whether, after the fit, a surface with fewer patches is searched: patches
                           are merged, and split again where the tolerances ask for it. This takes
                           longer than the fit, and saves a few percent of the patches at most.}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
  \cgalParamNBegin{do_fair_interior}
    \cgalParamDescription{whether, after the fit, the variation of the curvature is reduced as far
                           as the interior tolerance and the normals allow. The patches stay. This
                           takes about as long as the fit.}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
  \cgalParamNBegin{use_smooth_target}
    \cgalParamDescription{whether curved triangles through the vertices take the place of the faces
                           of `tm`. Then \f$ \delta \f$ is the largest distance from them; the
                           surfaces are within \f$ \delta \f$ plus the height of the triangles of
                           the mesh, and the report tells all three. Meant for \f$ \delta \f$ below
                           the sagitta of the faces.}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
  \cgalParamNBegin{use_caps}
    \cgalParamDescription{whether the surfaces have caps at their extraordinary points, see
                           `T_NURCC_surface_3::set_caps()`, so that the fit sees the faces as
                           `extract_NURBS_faces()` makes them}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
  \cgalParamNBegin{do_certify_interior}
    \cgalParamDescription{whether an upper bound of the distance from the surfaces to the mesh is
                           proved in the end, see `bound_interior_deviation()`}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_number_of_patches}
    \cgalParamDescription{a surface is not refined if it would have more patches than that}
    \cgalParamType{`std::size_t`}
    \cgalParamDefault{200000}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `tm`}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                    `%Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
  \cgalParamNEnd
  \cgalParamNBegin{visitor}
    \cgalParamDescription{an object that is told of the progress, and may interrupt the conversion}
    \cgalParamType{a class model of `SplineConversionVisitor`, or a `std::reference_wrapper` of one}
    \cgalParamDefault{`Default_visitor`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return `Error_code::OK` if all tolerances are met, otherwise the reason; see the message of the
        report. No exception is thrown because of the data.
*/
template <typename TriangleMesh, typename HalfedgeCurveMap, typename BoundaryCurveTraits,
          typename K, typename NamedParameters = parameters::Default_named_parameters>
Error_code convert_to_T_NURCC(const TriangleMesh& tm, const HalfedgeCurveMap& halfedge_curve_map,
                              const BoundaryCurveTraits& traits,
                              std::vector<T_NURCC_surface_3<K> >& surfaces,
                              Conversion_report& report,
                              const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  using parameters::get_parameter_reference;

  typedef typename internal_np::Lookup_named_param_def<internal_np::visitor_t, NamedParameters,
                                                       Default_visitor>::reference Visitor_reference;
  typedef typename std::decay<Visitor_reference>::type Visitor;
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;

  surfaces.clear();
  report = Conversion_report();
  Default_visitor default_visitor;
  Visitor_reference visitor
    = choose_parameter(get_parameter_reference(np, internal_np::visitor), default_visitor);
  const auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                    get_const_property_map(vertex_point, tm));
  const double corner_angle = internal::corner_angle_or_default(np);

  const Boundary_curve_network_3<TriangleMesh, BoundaryCurveTraits> network(
    tm, halfedge_curve_map, traits,
    parameters::corner_angle(corner_angle)
      .vertex_point_map(vpm)
      .vertex_is_constrained_map(
        choose_parameter(get_parameter(np, internal_np::vertex_is_constrained),
                         Constant_property_map<vertex_descriptor, bool>(false))));
  if(network.error() != Error_code::OK)
    return internal::fail(network.error(), network.message(), report);

  const double diameter = CGAL::to_double(network.diameter());
  const internal::Conversion_options options
    = internal::conversion_options(np, diameter, corner_angle, report);
  const auto size_map = internal::quad_size_map(
    tm, vpm, diameter, get_parameter(np, internal_np::quad_size_map), report);
  if(report.status != Error_code::OK)
    return report.status;
  const auto cross_field_map
    = choose_parameter(get_parameter(np, internal_np::cross_field_map),
                       Constant_property_map<face_descriptor, typename K::Vector_3>(NULL_VECTOR));
  internal::Converter<TriangleMesh, std::decay_t<decltype(vpm)>, BoundaryCurveTraits,
                      std::decay_t<decltype(size_map)>, std::decay_t<decltype(cross_field_map)>,
                      T_NURCC_surface_3<K>, Visitor>
    converter(tm, vpm, network, size_map, cross_field_map, options,
              internal::normal_function<BoundaryCurveTraits>(
                get_parameter(np, internal_np::boundary_tangency)),
              visitor, surfaces, report);
  report.status = converter(halfedge_curve_map);
  return report.status;
}

/*!
\ingroup PkgSurfaceMeshSplineConversionFunctions

converts a closed triangle mesh to T-NURCC surfaces, one for each connected component. The
parameters are those of the function above, without the ones that belong to the boundary.
*/
template <typename TriangleMesh, typename K,
          typename NamedParameters = parameters::Default_named_parameters>
Error_code convert_to_T_NURCC(const TriangleMesh& tm,
                              std::vector<T_NURCC_surface_3<K> >& surfaces,
                              Conversion_report& report,
                              const NamedParameters& np = parameters::default_values())
{
  typedef NURBS_curve_traits_3<K> Traits;
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor;
  return convert_to_T_NURCC(tm, Constant_property_map<halfedge_descriptor, Curve_segment<Traits> >(),
                            Traits(), surfaces, report, np);
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_CONVERT_TO_T_NURCC_H
