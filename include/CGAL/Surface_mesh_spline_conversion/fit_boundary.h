// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_FIT_BOUNDARY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_FIT_BOUNDARY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Default_visitor.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/Boundary_fitter.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/fitting/fit_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/number_utils.h>

#include <string>
#include <type_traits>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionFunctions

fits the boundary of `surface` to the boundary curves of `target`, and refines the surface along the
boundary until a bound of the distance of both is below a tolerance. The distance is that to the
closest points of the curves, or, if the error metric is parametric, that at equal parameters. The
bound is that of the Bernstein coefficients of the interpolated error, plus twice the largest
remainder measured in between.

The boundary of the surface along a chain is a cubic spline that depends on the outermost row of
control points only, hence the chains are independent least-squares problems. Corners are
interpolated with the tangents of both curves, joints of curves and seams of closed curves without
them, as edges of other faces of a CAD model may end there; a curve in a plane is fitted by a curve
in this plane. Spans with a too large error are bisected, until the bound is below half of the tolerance
(below the tolerance, if the error metric is parametric): where two faces meet at a curve, sewing
them adds the deviations of both.

\tparam Surface a `CGAL::T_NURCC_surface_3`
\tparam Target a `Transfinite_patch_network_3`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param surface the surface; its outermost control points are set, and it is refined where necessary
\param target the target, made from the same layout as `surface`
\param report receives the errors reached (`boundary`), the entries of the iterations, and a message
              if something went wrong
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
          below

\cgalNamedParamsBegin
  \cgalParamNBegin{boundary_tolerance}
    \cgalParamDescription{the largest distance between the boundary and the curves, in model units;
                           at least `1e-14` times the diameter of the mesh}
    \cgalParamType{a number type convertible to `double`}
    \cgalParamDefault{`1e-6` times the diameter of the mesh}
  \cgalParamNEnd
  \cgalParamNBegin{error_metric}
    \cgalParamDescription{how the distance is measured; `REPROJECTED` and `HAUSDORFF` are the same
                           here}
    \cgalParamType{`Error_metric`}
    \cgalParamDefault{`Error_metric::REPROJECTED`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_number_of_patches}
    \cgalParamDescription{the surface is not refined to more patches than that}
    \cgalParamType{`std::size_t`}
    \cgalParamDefault{`200000`}
  \cgalParamNEnd
  \cgalParamNBegin{visitor}
    \cgalParamDescription{an object that is told of each iteration, and may interrupt the fit}
    \cgalParamType{a class model of `SplineConversionVisitor`}
    \cgalParamDefault{`Default_visitor`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return `Error_code::OK` if the tolerance is met; `Error_code::TOLERANCE_NOT_REACHED` if it is not,
        `Error_code::INTERRUPTED`, `Error_code::INVALID_PARAMETER`, or `Error_code::SINGULAR_SYSTEM`
*/
template <typename Surface, typename Target,
          typename NamedParameters = parameters::Default_named_parameters>
Error_code fit_boundary(Surface& surface, const Target& target, Conversion_report& report,
                        const NamedParameters& np = parameters::default_values())
{
  typedef internal_np::Lookup_named_param_def<internal_np::visitor_t, NamedParameters,
                                              Default_visitor> Lookup_visitor;
  typedef typename Lookup_visitor::reference Visitor_reference;
  typedef typename std::decay<Visitor_reference>::type Visitor;

  Default_visitor default_visitor;
  Visitor_reference visitor = parameters::choose_parameter(
    parameters::get_parameter_reference(np, internal_np::visitor), default_visitor);
  const internal::Boundary_fit_options options = internal::boundary_fit_options(target, np);
  const std::string defect = internal::tolerance_defect("boundary", options.tolerance,
                                                        CGAL::to_double(target.diameter()));
  if(!defect.empty())
  {
    report.message = defect;
    return Error_code::INVALID_PARAMETER;
  }
  return internal::Boundary_fitter<Surface, Target, Visitor>(surface, target, options, visitor,
                                                             report)();
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_FIT_BOUNDARY_H
