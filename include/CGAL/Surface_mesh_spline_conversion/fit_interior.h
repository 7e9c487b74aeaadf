// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_FIT_INTERIOR_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_FIT_INTERIOR_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Default_visitor.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_metric.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Interior_fitter.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/number_utils.h>

#include <string>
#include <type_traits>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionFunctions

fits the interior of `surface` to `target`, and refines the surface until the distance of both is
below a tolerance. The boundary control points, which `fit_boundary()` has set, are kept; where the
refinement adds boundary control points, the boundary is fitted again.

The control points are the least-squares fit to samples of the target, first at equal parameters and
then, unless the error metric is parametric, at the points of the target closest to the surface. The
distance is measured at the nodes of a 9x9 grid per patch, after the last fit; unless the error metric
is parametric, also from the points of the mesh where it is farthest from a smooth surface, see
`Transfinite_patch_network_3::mesh_point()`, and the worst patches are refined first.

\tparam Surface a `CGAL::T_NURCC_surface_3`
\tparam Target a `Transfinite_patch_network_3`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param surface the surface; its inner control points are set, and it is refined where necessary
\param target the target, made from the same layout as `surface`
\param report receives the errors reached (`interior`, and `boundary` if the boundary was fitted
              again), the entries of the iterations, and a message if something went wrong
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
          below

\cgalNamedParamsBegin
  \cgalParamNBegin{interior_tolerance}
    \cgalParamDescription{the largest distance between surface and target, in model units; at
                           least `1e-14` times the diameter of the mesh}
    \cgalParamType{a number type convertible to `double`}
    \cgalParamDefault{`1e-3` times the diameter of the mesh}
  \cgalParamNEnd
  \cgalParamNBegin{boundary_tolerance}
    \cgalParamDescription{the largest distance between the boundary and the curves, in model units;
                           at least `1e-14` times the diameter of the mesh}
    \cgalParamType{a number type convertible to `double`}
    \cgalParamDefault{`1e-6` times the diameter of the mesh}
  \cgalParamNEnd
  \cgalParamNBegin{error_metric}
    \cgalParamDescription{how the distance is measured}
    \cgalParamType{`Error_metric`}
    \cgalParamDefault{`Error_metric::REPROJECTED`}
  \cgalParamNEnd
  \cgalParamNBegin{boundary_tangency}
    \cgalParamDescription{a functor that returns the unit normal of the neighboring face at a point
                           of a boundary curve; the surface becomes tangent to the face there. It
                           returns the null vector where the surface need not be tangent to a face.}
    \cgalParamType{a class with the operator `Vector_3 operator()(const Curve_3& c, const FT& t) const`,
                    with the types of the traits of the curves, for instance the
                    `Construct_normal_on_curve_3` of `Curve_on_surface_traits_3`}
    \cgalParamDefault{no normals}
  \cgalParamNEnd
  \cgalParamNBegin{do_coarsen_patches}
    \cgalParamDescription{whether, after the fit, a surface with fewer patches is searched: patches
                           are merged, and split again where the tolerances ask for it. This takes
                           longer than the fit, and saves a few percent of the patches at most.}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_number_of_patches}
    \cgalParamDescription{the surface is not refined if it would have more patches than that}
    \cgalParamType{`std::size_t`}
    \cgalParamDefault{`200000`}
  \cgalParamNEnd
  \cgalParamNBegin{visitor}
    \cgalParamDescription{an object that is told of each iteration, and may interrupt the fit}
    \cgalParamType{a class model of `SplineConversionVisitor`}
    \cgalParamDefault{`Default_visitor`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return `Error_code::OK` if the tolerances are met; `Error_code::TOLERANCE_NOT_REACHED` if one is
        not, `Error_code::INTERRUPTED`, `Error_code::INVALID_PARAMETER`, or
        `Error_code::SINGULAR_SYSTEM`
*/
template <typename Surface, typename Target,
          typename NamedParameters = parameters::Default_named_parameters>
Error_code fit_interior(Surface& surface, const Target& target, Conversion_report& report,
                        const NamedParameters& np = parameters::default_values())
{
  typedef internal_np::Lookup_named_param_def<internal_np::visitor_t, NamedParameters,
                                              Default_visitor> Lookup_visitor;
  typedef typename Lookup_visitor::reference Visitor_reference;
  typedef typename std::decay<Visitor_reference>::type Visitor;

  Default_visitor default_visitor;
  Visitor_reference visitor = parameters::choose_parameter(
    parameters::get_parameter_reference(np, internal_np::visitor), default_visitor);
  const internal::Interior_fit_options options = internal::interior_fit_options(target, np);
  const internal::Boundary_fit_options boundary_options
    = internal::boundary_fit_options(target, np);
  const double diameter = CGAL::to_double(target.diameter());
  std::string defect = internal::tolerance_defect("interior", options.tolerance, diameter);
  if(defect.empty())
    defect = internal::tolerance_defect("boundary", boundary_options.tolerance, diameter);
  if(!defect.empty())
  {
    report.message = defect;
    return Error_code::INVALID_PARAMETER;
  }
  const internal::Boundary_normals<Target> normals = internal::boundary_normals(
    target, parameters::get_parameter(np, internal_np::boundary_tangency));
  internal::Interior_fitter<Surface, Target, Visitor> fitter(
    surface, target, options, boundary_options, normals, visitor, report);
  const Error_code code = fitter();
  if constexpr(std::is_copy_assignable<Surface>::value) // not so are some surfaces for comparisons
    if(code == Error_code::OK && options.do_coarsen)
      return fitter.coarsen();
  return code;
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_FIT_INTERIOR_H
