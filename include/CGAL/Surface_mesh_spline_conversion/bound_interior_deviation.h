// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_BOUND_INTERIOR_DEVIATION_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_BOUND_INTERIOR_DEVIATION_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/boundary_band.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Interior_bound.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Mesh_distance.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/bezier_pieces.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/number_utils.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionFunctions

returns an upper bound of the distance from a shell to the mesh it was made from.

`measure_deviation()` finds the largest distance at samples, which is a lower bound; this function
proves one for all points, up to rounding errors. On each polynomial piece of the shell, the
distance from a triangle is at most that of the farthest control point. Pieces are bisected until
this is below the interior tolerance, or, where a point is farther than the tolerance, at most one
percent above its distance. Where the tolerance is met with a little to spare, it therefore is
proved to be met.

Points in a band along the boundary do not count: the mesh has chords there, and the surface has
curves.

\tparam K a model of `Kernel`
\tparam TriangleMesh a model of `FaceListGraph` and `VertexListGraph`
\tparam BoundaryCurveNetwork an instance of `Boundary_curve_network_3`
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param shell the shell
\param tm the triangle mesh
\param network the curves of its boundary
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed
       below

\cgalNamedParamsBegin
  \cgalParamNBegin{interior_tolerance}
    \cgalParamDescription{smaller bounds are not looked for, in model units}
    \cgalParamType{a positive number}
    \cgalParamDefault{\f$ 10^{-3} \f$ times the diameter of the network}
  \cgalParamNEnd
  \cgalParamNBegin{boundary_band}
    \cgalParamDescription{the width of the band along the boundary, in model units}
    \cgalParamType{a number type convertible to `double`}
    \cgalParamDefault{three mean edge lengths of `tm`}
  \cgalParamNEnd
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{a property map associating points to the vertices of `tm`}
    \cgalParamType{a class model of `ReadablePropertyMap` with
                    `boost::graph_traits<TriangleMesh>::%vertex_descriptor` as key type and
                    `%Point_3` as value type}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\pre `tm` has a face, the network has no error, and the tolerance is positive
*/
template <typename K, typename TriangleMesh, typename BoundaryCurveNetwork,
          typename NamedParameters = parameters::Default_named_parameters>
typename K::FT bound_interior_deviation(const NURBS_shell_3<K>& shell, const TriangleMesh& tm,
                                        const BoundaryCurveNetwork& network,
                                        const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;

  constexpr double DEFAULT_RELATIVE_TOLERANCE = 1e-3;
  const auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                    get_const_property_map(CGAL::vertex_point, tm));
  const double tolerance
    = CGAL::to_double(choose_parameter(get_parameter(np, internal_np::interior_tolerance),
                                       DEFAULT_RELATIVE_TOLERANCE * network.diameter()));
  CGAL_precondition(tolerance > 0);
  const internal::Mesh_distance mesh(tm, vpm, network);
  return internal::Interior_bound(internal::bezier_pieces(shell), mesh,
                                  internal::boundary_band_width(np, tm, vpm), tolerance).value();
}

} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_BOUND_INTERIOR_DEVIATION_H
